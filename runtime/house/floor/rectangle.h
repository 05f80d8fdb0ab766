/* Rectangles in whole nanometres, which lie along the axes: x along a row of trays, y to the front. */
#ifndef TARTAN_HOUSE_FLOOR_RECTANGLE_H
#define TARTAN_HOUSE_FLOOR_RECTANGLE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tn_rectangle {
    int64_t x0, x1, y0, y1;
} tn_rectangle;

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
