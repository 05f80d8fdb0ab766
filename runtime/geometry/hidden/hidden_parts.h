/* The parts of finding out what hides what (internal to hidden.c and its neighbours). */
#ifndef TARTAN_GEOMETRY_HIDDEN_PARTS_H
#define TARTAN_GEOMETRY_HIDDEN_PARTS_H

#include "runtime/geometry/hidden/hidden.h"

/* Adds what is painted next. */
tn_status tn_painting_add(tn_painting *painting, tn_patch patch, tn_error *error);

/* ---- overlap.c */

/* A triangle of a face, as seen. */
typedef struct tn_seen_triangle {
    uint32_t corner[3]; /* of the scene, counter-clockwise as seen */
    uint32_t face;
    double slope[2], height; /* its plane: depth = height + slope[0] x + slope[1] y */
    bool edge_on;            /* no plane: it is seen as a line */
} tn_seen_triangle;

typedef struct tn_pair {
    uint32_t a, b;
} tn_pair;

typedef struct tn_face_pairs {
    tn_pair *items;
    size_t count, room;
} tn_face_pairs;

/* Compares all triangles of different faces that overlap in the picture: pairs of faces of which the first is farther
 * somewhere. The caller frees the items. */
tn_status tn_overlaps_find(const tn_scene *scene, const tn_seen_triangle *triangles, size_t count,
                           tn_face_pairs *befores, tn_error *error);

/* ---- order.c */

/* Faces, and from each an arrow to every face that has to be painted after it. Faces that lead to one another have no
 * order: they are one knot. */
typedef struct tn_order {
    uint32_t count;
    uint32_t *arrow_first; /* [count + 1] */
    uint32_t *arrows;
    uint32_t *knot;       /* [face] */
    uint32_t *knot_first; /* [knot_count + 1] into members */
    uint32_t *members;    /* faces by knot */
    uint32_t knot_count;
    double *depth; /* [face] mean */
} tn_order;

/* Makes the order of a scene's faces. TN_LIMIT (E0820) for more than 2^32 pairs. Clear it in any case. */
tn_status tn_order_make(const tn_scene *scene, const tn_face_pairs *befores, tn_order *order, tn_error *error);
void tn_order_clear(tn_order *order);

/* Calls `paint` for each knot, the farthest of those first that nothing has to come before any more. */
typedef tn_status tn_paint_knot(void *user, uint32_t knot, tn_error *error);
tn_status tn_order_walk(const tn_order *order, tn_paint_knot *paint, void *user, tn_error *error);

/* ---- cut.c */

/* Cuts the faces of a knot into pieces that have an order, and adds these to the painting. `list` holds the faces'
 * triangles. TN_LIMIT, without a message, where that would take too many pieces. */
tn_status tn_painting_cut(const tn_scene *scene, const tn_seen_triangle *triangles, const uint32_t *list, size_t count,
                          tn_painting *painting, tn_error *error);

#endif
