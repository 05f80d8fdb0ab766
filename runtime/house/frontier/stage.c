/* A step from a state to one behind the next slice, in four stages: to what can be seen of the plane behind it
 * (outlook.c), to what faces it, into the slice (threshold.c), to its right side.
 *
 * Many states are one at the plane, as their edges are behind it and their tiles are counted; many slices are one to
 * rooms, walks and clauses. So the step is the product of four that are much smaller. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

bool tn_strip_has_stages(const tn_strip *strip)
{
    return strip->added->count == 0 && !strip->prices.asked && strip->questions.placed_count == 0 &&
           strip->questions.placed_walks == 0;
}

void tn_strip_stages_forget(tn_strip_stages *stages)
{
    for (uint32_t i = 0; i < stages->prospect_keys.count; i++)
        free(stages->prospects[i].items);
    tn_numbering_clear(&stages->prospect_keys);
    tn_numbering_clear(&stages->leavings);
    tn_numbering_clear(&stages->thresholds);
    tn_interner_clear(&stages->arrivals);
    tn_strip_entered_forget(&stages->entered);
    stages->left = 0;
}

void tn_strip_stages_clear(tn_strip_stages *stages)
{
    tn_interner *const interners[] = {&stages->groups,   &stages->lefts,   &stages->rights, &stages->lists,
                                      &stages->outlooks, &stages->behinds, &stages->views};
    tn_strip_stages_forget(stages);
    for (size_t i = 0; i < sizeof interners / sizeof *interners; i++)
        tn_interner_clear(interners[i]);
    tn_numbering_clear(&stages->facings);
    tn_numbering_clear(&stages->sided);
    tn_strip_known_clear(&stages->room_views);
    tn_strip_known_clear(&stages->crossed_rooms);
    for (uint32_t w = 0; w < TN_STRIP_MEETINGS_MAX; w++) {
        tn_strip_known_clear(&stages->walk_views[w]);
        tn_strip_known_clear(&stages->crossed_walks[w]);
    }
    free(stages->prospects);
    free(stages->left_by);
    free(stages->crossed_by);
    free(stages->slices);
}

bool tn_strip_find_group(tn_strip *strip, uint32_t slice)
{
    tn_strip_stages *stages = &strip->stages;
    tn_strip_slice *parts = &strip->slices[slice];
    const uint32_t words[] = {parts->entry, parts->met, parts->bases};
    uint32_t before = stages->groups.count;
    if (!tn_array_reserve(&stages->slices, &stages->slice_room, before, 1, sizeof *stages->slices))
        return false;
    parts->group = tn_intern(&stages->groups, words, sizeof words / sizeof *words);
    if (parts->group == before)
        stages->slices[before] = slice;
    return parts->group != UINT32_MAX;
}

uint32_t tn_strip_number_list(tn_strip *strip, const uint32_t *items, size_t count)
{
    return tn_intern(&strip->stages.lists, items, count);
}

uint32_t tn_strip_arrival_group(const tn_strip *strip, uint32_t arrival)
{
    size_t size;
    return tn_interned(&strip->stages.arrivals, arrival, &size)[ARRIVAL_GROUP];
}

/* ---- to its right side */

tn_status tn_strip_arrive(tn_strip *strip, uint32_t arrival, uint32_t slice, tn_strip_seen *seen, void *context,
                          tn_error *error)
{
    size_t size;
    tn_strip_waiting waiting;
    tn_key *key = &strip->joined;
    const uint32_t *words = tn_interned(&strip->stages.arrivals, arrival, &size);
    uint32_t last = tn_strip_waiting_word(strip), edge = strip->slices[slice].exit;
    tn_status status = tn_strip_find_waiting(strip, slice, words[last], &waiting, error);
    if (status != TN_OK || waiting.number == TN_STRIP_NONE)
        return status;
    key->size = 0;
    bool ok = tn_key_push(key, strip->merged.edges ? strip->merged.edges[edge] : edge);
    for (uint32_t i = STATE_ROOMS; ok && i < last; i++)
        ok = tn_key_push(key, words[i]);
    ok = ok && tn_key_push(key, waiting.number);
    uint32_t state = ok ? tn_intern(&strip->states, key->data, key->size) : UINT32_MAX;
    return state != UINT32_MAX ? seen(context, state, waiting.times, 1, &(tn_house_gain){{0}}, error)
                               : tn_fail_memory(error);
}
