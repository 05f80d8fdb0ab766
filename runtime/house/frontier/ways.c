/* Keeps the ways that a step goes on, as ranks go the same steps again and again: by the state before and the slice,
 * with each outcome of the plane by itself, of which a caller may ask for some. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

tn_status tn_strip_ways_want(tn_strip *strip, tn_error *error)
{
    tn_strip_ways *ways = &strip->ways;
    if (!ways->after)
        ways->after = calloc((size_t)strip->trays_most + 1, sizeof *ways->after);
    ways->wanted = ways->after != NULL;
    return ways->wanted ? TN_OK : tn_fail_memory(error);
}

const tn_strip_ways_of_step *tn_strip_ways_find(const tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice)
{
    if (!strip->ways.after)
        return NULL;
    const tn_strip_ways_after *steps = &strip->ways.after[trays];
    uint32_t at = tn_number_find(&steps->keys, (uint64_t)state << 32 | slice);
    return at == UINT32_MAX ? NULL : &steps->of[at];
}

bool tn_strip_ways_begin(tn_strip *strip)
{
    enum { MOST = 1 << 18 }; /* ways and steps: 10 MB */
    tn_strip_ways *ways = &strip->ways;
    ways->first = ways->count;
    return ways->wanted && !strip->scouting && strip->added->count == 0 && ways->count + ways->steps < MOST;
}

tn_status tn_strip_ways_add(tn_strip *strip, const tn_strip_way *way, tn_error *error)
{
    tn_strip_ways *ways = &strip->ways;
    if (!tn_array_reserve(&ways->items, &ways->room, ways->count, 1, sizeof *ways->items))
        return tn_fail_memory(error);
    ways->items[ways->count++] = *way;
    return TN_OK;
}

void tn_strip_ways_drop(tn_strip *strip)
{
    strip->ways.count = strip->ways.first;
}

static int compare_ways(const void *a, const void *b)
{
    const tn_strip_way *p = a, *q = b;
    return (p->outcome > q->outcome) - (p->outcome < q->outcome);
}

tn_status tn_strip_ways_end(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, tn_error *error)
{
    tn_strip_ways *ways = &strip->ways;
    tn_strip_ways_after *steps = &ways->after[trays];
    uint32_t before = steps->keys.count;
    bool ok = tn_array_reserve(&steps->of, &steps->room, before, 1, sizeof *steps->of) &&
              tn_number(&steps->keys, (uint64_t)state << 32 | slice) == before;
    if (!ok) {
        tn_strip_ways_drop(strip);
        return tn_fail_memory(error);
    }
    size_t count = ways->count - ways->first;
    if (count > 0)
        qsort(ways->items + ways->first, count, sizeof *ways->items, compare_ways);
    steps->of[before] = (tn_strip_ways_of_step){ways->first, count};
    ways->steps++;
    return TN_OK;
}

void tn_strip_ways_forget(tn_strip *strip)
{
    tn_strip_ways *ways = &strip->ways;
    for (uint32_t k = 0; ways->after && k <= strip->trays_most; k++) {
        tn_numbering_clear(&ways->after[k].keys);
        free(ways->after[k].of);
    }
    free(ways->after);
    free(ways->items);
    *ways = (tn_strip_ways){0};
}
