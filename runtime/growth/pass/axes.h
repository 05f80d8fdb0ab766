/* The frame of an edge that is replaced: H along it, L to its left, U out of the surface (internal to the growth
 * engine). Source: "Genr8", 4.4; docs/growth.md for where the normals say nothing. */
#ifndef TARTAN_GROWTH_PASS_AXES_H
#define TARTAN_GROWTH_PASS_AXES_H

#include "runtime/growth/pass/rows.h"

typedef struct tn_axes {
    tn_vector heading, left, up; /* unit vectors; left and up are zero where there is no such direction */
    double length;               /* of the edge */
} tn_axes;

/* `left` and `right` are the unit normals of the edge's faces, or zero; `centre` is that of the seed. */
tn_axes tn_axes_of(tn_vector from, tn_vector to, tn_vector left, tn_vector right, tn_vector centre);

/* Of many edges at once: the same numbers as one by one. */
typedef struct tn_axes_rows {
    tn_row from[3], to[3], left_normal[3], right_normal[3]; /* taken: [coordinate][edge] */
    tn_row heading[3], left[3], up[3], length;              /* made */
} tn_axes_rows;

/* The first `count` edges. */
void tn_axes_of_rows(tn_axes_rows *rows, uint32_t count, tn_vector centre);

/* Of each of them: a direction in the frame (along the edge, to its left, out of the surface); */
void tn_axes_turn(const tn_axes_rows *rows, uint32_t count, const double turn[3], tn_row *result);

/* and a place: so far from where the edge begins, in lengths of the edge. */
void tn_axes_place(const tn_axes_rows *rows, uint32_t count, const double turn[3], tn_row *result);

#endif
