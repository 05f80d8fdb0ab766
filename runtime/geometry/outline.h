/* Does a closed line in the plane cross itself? */
#ifndef TARTAN_GROWTH_OUTLINE_H
#define TARTAN_GROWTH_OUTLINE_H

#include "runtime/base/watch.h"

/* An outline's corners and the memory to look at it, which a thread uses again and again. Starts all zero. */
typedef struct tn_outline {
    double (*points)[2]; /* [count], filled by the caller after tn_outline_reserve */
    uint32_t count;
    uint32_t *cells, *next, *side; /* sides by cell of a grid, as linked lists */
    size_t point_room, cell_room, link_room;
    tn_watch *watch; /* borrowed, or NULL: what is found means nothing once this says so */
} tn_outline;

/* Room for the points of an outline; false without memory. */
bool tn_outline_reserve(tn_outline *outline, uint32_t count);

/* Do two sides cross, in their insides? *crossed says. Sides are compared with those that a grid has near them, so that
 * the time is linear in the corners where the outline does not lie upon itself. False without memory. */
bool tn_outline_crosses(tn_outline *outline, bool *crossed);

void tn_outline_clear(tn_outline *outline);

#endif
