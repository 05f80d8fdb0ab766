/* A cell: a convex part of a box, often all of it, or a box clipped by one plane. Faces that are in no plane of the box
 * are caps. Plain values; faces are counter-clockwise seen from outside. */
#ifndef TARTAN_GEOMETRY_CUT_BOX_H
#define TARTAN_GEOMETRY_CUT_BOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TN_CUT_BOX_CORNERS = 10, TN_CUT_BOX_FACES = 7, TN_CUT_BOX_CAP = 6 };

typedef struct tn_cut_box_face {
    uint8_t side; /* 2 * axis, + 1 for the high one; TN_CUT_BOX_CAP */
    uint8_t count;
    uint8_t corner[8];
} tn_cut_box_face;

typedef struct tn_cut_box {
    double low[3], high[3]; /* of its box */
    double at[TN_CUT_BOX_CORNERS][3];
    uint32_t corner_count, face_count; /* 0: nothing is left */
    tn_cut_box_face faces[TN_CUT_BOX_FACES];
} tn_cut_box;

/* What of the box n.(p - centre) <= distance keeps, n of unit length. A corner within 1e-9 of the box's diagonal of the
 * plane is on it. NULL for n: all of it. */
void tn_cut_box_clip(const double low[3], const double high[3], const double *n, double distance, tn_cut_box *cell);

/* Its image in the plane through the origin across the axis. */
void tn_cut_box_mirror(tn_cut_box *cell, int axis);

/* Bounds of cells' corners; of no cells, low is above high. */
void tn_cut_boxes_bounds(const tn_cut_box *cells, size_t count, double low[3], double high[3]);

/* The step in which coordinates of a union are counted: a power of two, such that none has more than 2^52. */
double tn_cut_boxes_step(const tn_cut_box *cells, size_t count);

typedef struct tn_moments {
    double volume;
    double first[3];  /* integrals of x, y, z */
    double second[3]; /* integrals of x^2, y^2, z^2 */
} tn_moments;

/* Adds those of the cell. */
void tn_cut_box_moments(const tn_cut_box *cell, tn_moments *moments);

/* Boxes as lists of nine genes: centre, size, and the plane that clips it by its distance from the centre and two
 * angles in degrees (Bentley, 4.2.5). */

#define TN_BOX_GENES 9u

/* Centres of bred boxes are whole numbers of these parts of a unit, and sizes even ones: then faces are whole numbers
 * of them too, and the text of a design has the same faces, to the last bit. */
#define TN_GENE_STEPS 1000.0

/* The unit normal at these angles: (cos b sin a, sin b, cos b cos a). */
void tn_normal_of_angles(double a, double b, double normal[3]);

#endif
