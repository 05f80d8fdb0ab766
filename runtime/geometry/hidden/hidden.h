/* Which faces hide which: the order in which a picture of them is painted.
 *
 * Painting nearer faces over farther ones shows what is visible - once there is such an order. Faces that overlap in
 * the picture are compared where they do (overlap.c), and an order is made of that. Faces that pass through
 * one another, or lie over one another in a circle, have none: they are cut into pieces that have. The result
 * is exact for flat faces; a warped one is compared and cut by the triangles that fill it.
 *
 * Costs: comparisons grow with the overlaps in the picture; only faces without an order are cut, which can take the
 * square of their number: where it takes more than TN_PIECE_CORNERS_MAX corners they are painted by their depth.
 */
#ifndef TARTAN_GEOMETRY_HIDDEN_HIDDEN_H
#define TARTAN_GEOMETRY_HIDDEN_HIDDEN_H

#include "runtime/base/watch.h"

/* What is seen, from infinitely far away. The arrays belong to whoever made the scene. */
typedef struct tn_scene {
    double (*points)[3]; /* [corner] to the right, up, and towards the eye; the whole not much larger than 1 */
    uint32_t *first;     /* [face_count + 1] each face's first corner; faces have three or more */
    uint32_t face_count;
    int threads;     /* that may work on it, which changes nothing; 0 counts as 1 */
    tn_watch *watch; /* or NULL: the work is given up (TN_STOPPED) once this says so */
} tn_scene;

#define TN_CUT UINT32_MAX

/* A face, or a piece of one, to be painted. */
typedef struct tn_patch {
    uint32_t face;
    uint32_t first, count; /* corners: of the scene for a whole face, of the painting for a piece */
    bool piece;
} tn_patch;

typedef struct tn_painting {
    tn_patch *patches; /* the farthest first */
    size_t patch_count, patch_room;
    double (*points)[3]; /* corners of pieces */
    uint32_t *sides;     /* [corner of pieces] the corner of the scene where the side of the face starts that leaves the
                            corner, or TN_CUT if the face was cut */
    size_t corner_count, corner_room;
    uint32_t by_depth; /* faces painted by their depth, since cutting them would take too many pieces */
} tn_painting;

/* Finds the order. TN_LIMIT (E0820) for more overlaps than 2^32. Clear the painting in any case. */
tn_status tn_painting_make(const tn_scene *scene, tn_painting *painting, tn_error *error);
void tn_painting_clear(tn_painting *painting);

/* The most corners that pieces have in all: about 200 MB. */
#define TN_PIECE_CORNERS_MAX 4000000u

#endif
