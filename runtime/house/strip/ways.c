/* Keeps the ways that a step goes on, as ranks go the same steps again and again: by the state before and the slice,
 * with each outcome of the plane by itself, of which a caller may ask for some. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/strip/parts.h"

enum { WAYS_MOST = 1 << 18 }; /* 6 MB */

tn_strip_ways_of_step *tn_strip_ways_find(const tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice)
{
    const tn_strip_ways *ways = &strip->ways[trays];
    uint32_t at = tn_number_find(&ways->steps, (uint64_t)state << 32 | slice);
    return at == UINT32_MAX ? NULL : &ways->of[at];
}

bool tn_strip_ways_begin(tn_strip *strip)
{
    strip->way_first = strip->way_count;
    return !strip->scouting && strip->added->count == 0 && strip->way_count < WAYS_MOST;
}

tn_status tn_strip_ways_add(tn_strip *strip, const tn_strip_way *way, tn_error *error)
{
    if (!tn_array_reserve(&strip->way_items, &strip->way_room, strip->way_count, 1, sizeof *strip->way_items))
        return tn_fail_memory(error);
    strip->way_items[strip->way_count++] = *way;
    return TN_OK;
}

void tn_strip_ways_drop(tn_strip *strip)
{
    strip->way_count = strip->way_first;
}

static int compare_ways(const void *a, const void *b)
{
    const tn_strip_way *p = a, *q = b;
    return (p->outcome > q->outcome) - (p->outcome < q->outcome);
}

tn_status tn_strip_ways_end(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, tn_error *error)
{
    tn_strip_ways *ways = &strip->ways[trays];
    uint32_t before = ways->steps.count;
    bool ok = tn_array_reserve(&ways->of, &ways->room, before, 1, sizeof *ways->of) &&
              tn_number(&ways->steps, (uint64_t)state << 32 | slice) == before;
    if (!ok) {
        tn_strip_ways_drop(strip);
        return tn_fail_memory(error);
    }
    size_t count = strip->way_count - strip->way_first;
    if (count > 0)
        qsort(strip->way_items + strip->way_first, count, sizeof *strip->way_items, compare_ways);
    ways->of[before] = (tn_strip_ways_of_step){strip->way_first, count};
    return TN_OK;
}

void tn_strip_ways_forget(tn_strip *strip)
{
    for (uint32_t k = 0; strip->ways && k <= strip->trays_most; k++) {
        tn_numbering_clear(&strip->ways[k].steps);
        free(strip->ways[k].of);
        strip->ways[k] = (tn_strip_ways){0};
    }
    free(strip->way_items);
    strip->way_items = NULL;
    strip->way_count = strip->way_room = 0;
}
