/* A step from a state to one behind the next slice, in three stages: over the plane, into the slice, to its right side.
 *
 * Many states are one at the plane, as their edges are behind it and their tiles are counted; many slices are one to
 * rooms, walks and clauses. So the step is the product of three that are much smaller. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/strip/parts.h"

bool tn_strip_has_stages(const tn_strip *strip)
{
    return strip->added->count == 0 && !strip->prices.asked;
}

void tn_strip_stages_forget(tn_strip_stages *stages)
{
    tn_interner_clear(&stages->thresholds);
    tn_interner_clear(&stages->arrivals);
}

void tn_strip_stages_clear(tn_strip_stages *stages)
{
    tn_strip_stages_forget(stages);
    tn_interner_clear(&stages->groups);
    free(stages->of);
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

uint32_t tn_strip_threshold_entry(const tn_strip *strip, uint32_t threshold)
{
    size_t size;
    return tn_interned(&strip->stages.thresholds, threshold, &size)[tn_strip_waiting_word(strip) + THRESHOLD_ENTRY];
}

uint32_t tn_strip_arrival_group(const tn_strip *strip, uint32_t arrival)
{
    size_t size;
    return tn_interned(&strip->stages.arrivals, arrival, &size)[ARRIVAL_GROUP];
}

/* ---- over the plane */

/* Rooms, walks and what the clauses have read: as they are in the state, 0 before the first slice, when nothing has
 * been read. */
static bool push_before(const tn_strip *strip, const uint32_t *state, tn_key *key)
{
    uint32_t last = tn_strip_waiting_word(strip) - 1;
    bool ok = true;
    for (uint32_t i = STATE_ROOMS; ok && i < last; i++)
        ok = tn_key_push(key, state ? state[i] : 0);
    return ok && tn_key_push(key, state ? state[last] : TN_STRIP_NONE);
}

static tn_status number_threshold(tn_strip *strip, const uint32_t *state, uint32_t entry, uint32_t outcome,
                                  uint32_t *number, tn_error *error)
{
    tn_strip_stages *stages = &strip->stages;
    tn_key *key = &strip->joined;
    size_t size;
    const uint32_t *meetings = tn_interned(&strip->outcome_keys, outcome, &size);
    const tn_strip_outcome *parts = &strip->outcomes[outcome];
    uint32_t before = stages->thresholds.count;
    if (!tn_array_reserve(&stages->of, &stages->room, before, 1, sizeof *stages->of))
        return tn_fail_memory(error);
    key->size = 0;
    bool ok = tn_key_push(key, state ? strip->edges[state[STATE_EDGE]].asked : TN_STRIP_NONE) &&
              push_before(strip, state, key) && tn_key_push(key, entry) && tn_key_push(key, meetings[0]) &&
              tn_key_push(key, meetings[1]) && tn_key_push(key, parts->through) &&
              tn_key_push(key, strip->scouting ? 0 : parts->right_fits);
    *number = ok ? tn_intern(&stages->thresholds, key->data, key->size) : UINT32_MAX;
    if (*number == before)
        stages->of[before] = (tn_strip_threshold){state ? state[STATE_EDGE] : TN_STRIP_NONE, outcome};
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* The words may move where states are made. */
static const uint32_t *words_of(const tn_strip *strip, uint32_t state)
{
    size_t size;
    return state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, state, &size);
}

tn_status tn_strip_leave(tn_strip *strip, uint32_t state, uint32_t entry, tn_strip_seen *seen, void *context,
                         tn_error *error)
{
    const tn_strip_list *plane;
    const uint32_t *words = words_of(strip, state);
    tn_status status = tn_strip_plane(strip, words ? words[STATE_EDGE] : TN_STRIP_NONE, entry, &plane, error);
    for (size_t i = 0; status == TN_OK && i < plane->count; i++) {
        const tn_strip_choice *choice = &plane->items[i];
        uint32_t threshold;
        uint64_t tiles = 1, times;
        if (words && !strip->scouting)
            status = tn_strip_end_waiting(strip, words[tn_strip_waiting_word(strip)],
                                          strip->outcomes[choice->slice].left_fits, &tiles, error);
        if (status != TN_OK || tiles == 0)
            continue;
        if (__builtin_mul_overflow(choice->times, tiles, &times))
            return tn_strip_limit(strip, NULL, "a tray has more than 2^64 choices", error);
        status = number_threshold(strip, words, entry, choice->slice, &threshold, error);
        if (status == TN_OK)
            status = seen(context, threshold, times, choice->times, &(tn_house_gain){{0}}, error);
    }
    return status;
}

/* ---- into the slice */

static tn_status number_arrival(tn_strip *strip, uint32_t group, const uint32_t *crossed, uint32_t read, uint32_t fits,
                                uint32_t *number, tn_error *error)
{
    tn_key *key = &strip->joined;
    key->size = 0;
    bool ok = tn_key_push(key, group);
    for (uint32_t w = 0; ok && w <= strip->questions.walk_count; w++)
        ok = tn_key_push(key, crossed[CROSSED_ROOMS + w]);
    ok = ok && tn_key_push(key, read) && tn_key_push(key, fits);
    *number = ok ? tn_intern(&strip->stages.arrivals, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

tn_status tn_strip_enter(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t group, tn_strip_seen *seen,
                         void *context, tn_error *error)
{
    size_t size;
    uint32_t crossed[CROSSED_WALKS + TN_STRIP_MEETINGS_MAX + TN_STRIP_QUESTIONS_MAX], slice, between, read, arrival;
    const tn_strip_threshold *of = &strip->stages.of[threshold];
    const uint32_t *words = tn_interned(&strip->stages.thresholds, threshold, &size);
    uint32_t last = tn_strip_waiting_word(strip), fits = words[last + THRESHOLD_FITS];
    slice = strip->stages.slices[group];
    tn_status status = tn_strip_read_slice(strip, trays, words[last - 1], slice, &between, error);
    if (status != TN_OK || between == TN_STRIP_NONE)
        return status;
    status = tn_strip_cross_outcome(strip, words[THRESHOLD_ASKED] == TN_STRIP_NONE ? NULL : words, of->left, slice,
                                    of->outcome, crossed, error);
    if (status == TN_OK)
        status = tn_strip_read_plane(strip, trays, between, crossed[CROSSED_VALUES], &read, error);
    if (status != TN_OK || read == TN_STRIP_NONE)
        return status;
    status = number_arrival(strip, group, crossed, read, fits, &arrival, error);
    return status == TN_OK ? seen(context, arrival, 1, 1, &(tn_house_gain){{0}}, error) : status;
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
