/* A cell: a box, perhaps clipped by one plane. Plain values; faces are counter-clockwise seen from outside. */
#ifndef TARTAN_GEOMETRY_CELL_H
#define TARTAN_GEOMETRY_CELL_H

#include <stdbool.h>
#include <stdint.h>

enum { TN_CELL_CORNERS = 10, TN_CELL_FACES = 7, TN_CELL_CAP = 6 };

typedef struct tn_cell_face {
    uint8_t side; /* 2 * axis, + 1 for the high one; TN_CELL_CAP */
    uint8_t count;
    uint8_t corner[8];
} tn_cell_face;

typedef struct tn_cell {
    double low[3], high[3]; /* of its box */
    double at[TN_CELL_CORNERS][3];
    uint32_t corner_count, face_count; /* 0: nothing is left */
    tn_cell_face faces[TN_CELL_FACES];
} tn_cell;

/* What of the box n.(p - centre) <= distance keeps, n of unit length. A corner within 1e-9 of the box's diagonal of the
 * plane is on it. NULL for n: all of it. */
void tn_cell_clip(const double low[3], const double high[3], const double *n, double distance, tn_cell *cell);

/* Its image in the plane through the origin across the axis. */
void tn_cell_mirror(tn_cell *cell, int axis);

typedef struct tn_moments {
    double volume;
    double first[3];  /* integrals of x, y, z */
    double second[3]; /* integrals of x^2, y^2, z^2 */
} tn_moments;

/* Adds those of the cell. */
void tn_cell_moments(const tn_cell *cell, tn_moments *moments);

#endif
