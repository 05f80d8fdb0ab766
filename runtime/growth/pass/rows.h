/* Rows of numbers, one for each of some edges or faces, which compilers work out in one go (internal to the growth
 * engine). The same operations in the same order as vector.h's, and so the same numbers. */
#ifndef TARTAN_GROWTH_PASS_ROWS_H
#define TARTAN_GROWTH_PASS_ROWS_H

#include <stdint.h>

#include "runtime/geometry/vector.h"
#include "runtime/growth/model/map.h"
#include "runtime/math/any_width.h"

#define TN_ROW 32u
typedef double tn_row[TN_ROW];

/* How much of a row is worked out where `count` are needed: one of three lengths, so that all are constants where the
 * work is inlined: TN_EACH_LENGTH. */
static inline uint32_t tn_row_length(uint32_t count)
{
    return count <= 8 ? 8 : count <= 16 ? 16 : TN_ROW;
}

#define TN_EACH_LENGTH(count, work, ...)                                                                               \
    (count) <= 8 ? work(__VA_ARGS__, 8) : (count) <= 16 ? work(__VA_ARGS__, 16) : work(__VA_ARGS__, TN_ROW)

#define TN_INLINED static inline __attribute__((always_inline))

/* Vectors are three rows. */
static inline tn_vector tn_rows_at(tn_row rows[3], uint32_t i)
{
    return (tn_vector){rows[0][i], rows[1][i], rows[2][i]};
}

static inline void tn_rows_put(tn_row rows[3], uint32_t i, tn_vector a)
{
    rows[0][i] = a.x;
    rows[1][i] = a.y;
    rows[2][i] = a.z;
}

/* Zeros after the first `count`, as far as the row is worked out. */
static inline void tn_rows_fill(tn_row rows[3], uint32_t count)
{
    for (uint32_t length = tn_row_length(count); count < length; count++)
        tn_rows_put(rows, count, (tn_vector){0, 0, 0});
}

/* The frame of an edge that is replaced: H along it, L to its left, U out of the surface (internal to the growth
 * engine). Source: "Genr8", 4.4; docs/growth.md for where the normals say nothing. */

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

/* Unit normals of faces, many at once (internal to the growth engine). */

/* Faces of one size that wait until they are many. */
typedef struct tn_normals {
    const tn_map *map;
    double *normals;                       /* [face][3] where they go */
    uint32_t faces[TN_ROW], darts[TN_ROW]; /* each one's first dart */
    uint32_t count, size;
    tn_row first[3], before[3], point[3], sum[3], span;
} tn_normals;

/* Normals of this map's faces go to normals[3 * face]. */
void tn_normals_start(tn_normals *normals, const tn_map *map, double *result);

/* The normal of an interior face, now or later; */
void tn_normals_add(tn_normals *normals, uint32_t face);

/* and of all that wait. */
void tn_normals_finish(tn_normals *normals);

#endif
