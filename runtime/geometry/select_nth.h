/* Selection by Hoare's method: orders a range so that its n-th element stands where sorting would put it. */
#ifndef TARTAN_GEOMETRY_SELECT_NTH_H
#define TARTAN_GEOMETRY_SELECT_NTH_H

#include <stdbool.h>
#include <stdint.h>

/* Does `a` come before `b` on this axis? A strict order in which no two are equal. */
typedef bool tn_comes_before(const void *context, uint32_t a, uint32_t b, int axis);

/* Orders order[first .. end) so that what comes before its element `nth` lies before it. Pivots are drawn, as places
 * along an outline rise and fall in ways that fixed choices are slow on. Inlined, so that the comparison is too. */
static inline void tn_select_nth(uint32_t *order, uint32_t first, uint32_t end, uint32_t nth, int axis,
                                 tn_comes_before *before, const void *context)
{
    while (end - first > 1) {
        uint32_t pivot = order[first + (end * 0x9e3779b1u ^ first * 0x85ebca77u) % (end - first)];
        uint32_t i = first, j = end - 1;
        for (;;) {
            while (before(context, order[i], pivot, axis))
                i++;
            while (before(context, pivot, order[j], axis))
                j--;
            if (i >= j)
                break;
            uint32_t swap = order[i];
            order[i++] = order[j];
            order[j--] = swap;
        }
        if (i == j && nth == i)
            return; /* the pivot is in its place */
        if (nth < i)
            end = i;
        else
            first = i == j ? i + 1 : i;
    }
}

#endif
