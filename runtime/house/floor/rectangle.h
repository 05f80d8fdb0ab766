/* Rectangles in whole nanometres, which lie along the axes: x along a row of trays, y to the front. */
#ifndef TARTAN_HOUSE_FLOOR_RECTANGLE_H
#define TARTAN_HOUSE_FLOOR_RECTANGLE_H

#include <stdbool.h>
#include <stdint.h>

#include "runtime/base/int128.h"

typedef struct tn_rectangle {
    int64_t x0, x1, y0, y1;
} tn_rectangle;

typedef struct tn_point {
    int64_t x, y;
} tn_point;

/* Its middle, rounded down. */
tn_point tn_rectangle_middle(const tn_rectangle *r);

/* The root, rounded up; of what is not below 0. */
int64_t tn_root_up(tn_int128 square);

/* How far two points are apart, rounded up. */
int64_t tn_distance_up(tn_point a, tn_point b);

/* Have they more in common than edges? */
static inline bool tn_rectangles_meet(const tn_rectangle *a, const tn_rectangle *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

/* What both have in common; turned round where that is nothing. */
static inline tn_rectangle tn_rectangles_common(const tn_rectangle *a, const tn_rectangle *b)
{
    return (tn_rectangle){a->x0 > b->x0 ? a->x0 : b->x0, a->x1 < b->x1 ? a->x1 : b->x1, a->y0 > b->y0 ? a->y0 : b->y0,
                          a->y1 < b->y1 ? a->y1 : b->y1};
}

/* Does the first lie in the second? Edges may be the same. */
static inline bool tn_rectangle_within(const tn_rectangle *a, const tn_rectangle *b)
{
    return b->x0 <= a->x0 && a->x1 <= b->x1 && b->y0 <= a->y0 && a->y1 <= b->y1;
}

/* With so much more on each side. */
static inline tn_rectangle tn_rectangle_grown(const tn_rectangle *a, int64_t by)
{
    return (tn_rectangle){a->x0 - by, a->x1 + by, a->y0 - by, a->y1 + by};
}

#endif
