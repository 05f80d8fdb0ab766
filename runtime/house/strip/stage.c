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
    return strip->added->count == 0 && !strip->prices.asked && strip->questions.placed_count == 0 &&
           strip->questions.placed_walks == 0;
}

void tn_strip_stages_forget(tn_strip_stages *stages)
{
    tn_interner_clear(&stages->thresholds);
    tn_interner_clear(&stages->arrivals);
    stages->left = 0;
}

void tn_strip_stages_clear(tn_strip_stages *stages)
{
    tn_strip_stages_forget(stages);
    tn_interner_clear(&stages->groups);
    tn_interner_clear(&stages->views);
    tn_strip_known_clear(&stages->room_views);
    tn_strip_known_clear(&stages->sides);
    for (uint32_t w = 0; w < TN_STRIP_MEETINGS_MAX; w++)
        tn_strip_known_clear(&stages->walk_views[w]);
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

/* What rooms see of the plane from its right: marks and glass of each cell there. */
static bool push_sides(const uint32_t *outcome, uint32_t left_cells, size_t size, tn_key *key)
{
    const uint32_t *sides = outcome + 3 + (size_t)STEP_WORDS * outcome[2] + (size_t)SIDE_WORDS * left_cells;
    bool ok = true;
    for (; ok && sides + SIDE_WORDS <= outcome + size; sides += SIDE_WORDS)
        ok = tn_key_push(key, sides[SIDE_MARKS]) && tn_key_push(key, sides[SIDE_MARKS_HIGH]) &&
             tn_key_push(key, sides[SIDE_GLASS]);
    return ok;
}

typedef struct tn_leaving_by {
    tn_strip *strip;
    const uint32_t *state; /* words, or NULL */
    const tn_strip_edge *left;
    uint32_t outcome, through;
} tn_leaving_by;

/* What can be seen of the plane behind it: of a walk, or (TN_STRIP_NONE) of the rooms. */
static tn_status push_view(const tn_leaving_by *by, uint32_t walk, tn_key *key, tn_error *error)
{
    size_t size;
    const uint32_t *outcome = tn_interned(&by->strip->outcome_keys, by->outcome, &size);
    return walk == TN_STRIP_NONE
               ? tn_strip_rooms_view(by->strip, by->state[STATE_ROOMS], by->left, outcome, key, error)
               : tn_strip_walk_view(by->strip, walk, by->state[STATE_WALKS + walk], by->left, outcome, key, error);
}

static tn_status find_view(const tn_leaving_by *by, uint32_t walk, uint32_t *view, tn_error *error)
{
    tn_strip *strip = by->strip;
    bool rooms = walk == TN_STRIP_NONE, met;
    uint32_t before = strip->stages.befores[rooms ? 0 : 1 + walk], *result;
    tn_strip_known *known = rooms ? &strip->stages.room_views : &strip->stages.walk_views[walk];
    tn_status status = tn_strip_known_at(known, before, by->through, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        strip->key.size = 0;
        status = push_view(by, walk, &strip->key, error);
        *result = status == TN_OK ? tn_intern(&strip->stages.views, strip->key.data, strip->key.size) : UINT32_MAX;
        if (status == TN_OK && *result == UINT32_MAX)
            status = tn_fail_memory(error);
    }
    *view = status == TN_OK ? *result : 0;
    return status;
}

static tn_status find_sides(const tn_leaving_by *by, uint32_t *sides, tn_error *error)
{
    tn_strip *strip = by->strip;
    uint32_t cells = by->left ? by->left->count : 0, *result;
    size_t size;
    bool met;
    tn_status status = tn_strip_known_at(&strip->stages.sides, cells, by->through, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        const uint32_t *outcome = tn_interned(&strip->outcome_keys, by->outcome, &size);
        strip->key.size = 0;
        bool ok = push_sides(outcome, cells, size, &strip->key);
        *result = ok ? tn_intern(&strip->stages.views, strip->key.data, strip->key.size) : UINT32_MAX;
        if (*result == UINT32_MAX)
            status = tn_fail_memory(error);
    }
    *sides = status == TN_OK ? *result : 0;
    return status;
}

/* Views of rooms and walks, and what the clauses have read: before the first slice, nothing. */
static tn_status push_before(const tn_leaving_by *by, tn_key *key, tn_error *error)
{
    const tn_strip_questions *q = &by->strip->questions;
    uint32_t view = 0, read = by->state ? by->state[tn_strip_waiting_word(by->strip) - 1] : TN_STRIP_NONE;
    tn_status status = by->state && q->room_count > 0 ? find_view(by, TN_STRIP_NONE, &view, error) : TN_OK;
    if (status == TN_OK && !tn_key_push(key, view))
        status = tn_fail_memory(error);
    for (uint32_t w = 0; status == TN_OK && w < q->walk_count; w++) {
        status = by->state ? find_view(by, w, &view, error) : TN_OK;
        if (status == TN_OK && !tn_key_push(key, by->state ? view : 0))
            status = tn_fail_memory(error);
    }
    return status == TN_OK && !tn_key_push(key, read) ? tn_fail_memory(error) : status;
}

static tn_status push_threshold(const tn_leaving_by *by, uint32_t entry, tn_key *key, tn_error *error)
{
    size_t size;
    const uint32_t *meetings = tn_interned(&by->strip->outcome_keys, by->outcome, &size);
    uint32_t fits = by->strip->scouting ? 0 : by->strip->outcomes[by->outcome].right_fits, sides = 0;
    key->size = 0;
    if (!tn_key_push(key, by->state ? 0 : TN_STRIP_NONE))
        return tn_fail_memory(error);
    tn_status status = push_before(by, key, error);
    if (status == TN_OK)
        status = find_sides(by, &sides, error);
    bool ok = status == TN_OK && tn_key_push(key, entry) && tn_key_push(key, meetings[0]) &&
              tn_key_push(key, meetings[1]) && tn_key_push(key, sides) && tn_key_push(key, fits);
    return status == TN_OK && !ok ? tn_fail_memory(error) : status;
}

static tn_status number_threshold(const tn_leaving_by *by, uint32_t state, uint32_t entry, uint32_t *number,
                                  tn_error *error)
{
    tn_strip_stages *stages = &by->strip->stages;
    tn_key *key = &by->strip->joined;
    uint32_t before = stages->thresholds.count;
    tn_status status = push_threshold(by, entry, key, error);
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve(&stages->of, &stages->room, before, 1, sizeof *stages->of))
        return tn_fail_memory(error);
    *number = tn_intern(&stages->thresholds, key->data, key->size);
    if (*number == before)
        stages->of[before] = (tn_strip_threshold){state, by->outcome};
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* The words may move where states are made. */
static const uint32_t *words_of(const tn_strip *strip, uint32_t state)
{
    size_t size;
    return state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, state, &size);
}

/* Many entries are met from one state. */
static tn_status begin_state(tn_strip *strip, uint32_t state, const uint32_t *words, tn_error *error)
{
    tn_strip_stages *stages = &strip->stages;
    if (!words || stages->left == state + 1)
        return TN_OK;
    stages->left = 0;
    for (uint32_t i = 0; i <= strip->questions.walk_count; i++) {
        uint64_t asked = strip->edges[words[STATE_EDGE]].asked;
        stages->befores[i] = tn_number(&strip->befores, asked << 32 | words[STATE_ROOMS + i]);
        if (stages->befores[i] == UINT32_MAX)
            return tn_fail_memory(error);
    }
    stages->left = state + 1;
    return TN_OK;
}

tn_status tn_strip_leave(tn_strip *strip, uint32_t state, uint32_t entry, tn_strip_seen *seen, void *context,
                         tn_error *error)
{
    const tn_strip_list *plane;
    const uint32_t *words = words_of(strip, state);
    tn_leaving_by by = {.strip = strip, .state = words, .left = words ? &strip->edges[words[STATE_EDGE]] : NULL};
    tn_status status = begin_state(strip, state, words, error);
    if (status == TN_OK)
        status = tn_strip_plane(strip, words ? words[STATE_EDGE] : TN_STRIP_NONE, entry, &plane, error);
    for (size_t i = 0; status == TN_OK && i < plane->count; i++) {
        const tn_strip_choice *choice = &plane->items[i];
        uint32_t threshold;
        uint64_t tiles = 1, times;
        by.outcome = choice->slice;
        by.through = strip->outcomes[choice->slice].through;
        if (words && !strip->scouting)
            status = tn_strip_end_waiting(strip, words[tn_strip_waiting_word(strip)],
                                          strip->outcomes[choice->slice].left_fits, &tiles, error);
        if (status != TN_OK || tiles == 0)
            continue;
        if (__builtin_mul_overflow(choice->times, tiles, &times))
            return tn_strip_limit(strip, NULL, "a tray has more than 2^64 choices", error);
        status = number_threshold(&by, state, entry, &threshold, error);
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
    const uint32_t *state = words_of(strip, of->state);
    uint32_t last = tn_strip_waiting_word(strip), fits = words[last + THRESHOLD_FITS];
    slice = strip->stages.slices[group];
    tn_status status = tn_strip_read_slice(strip, trays, words[last - 1], slice, &between, error);
    if (status != TN_OK || between == TN_STRIP_NONE)
        return status;
    status = tn_strip_cross_outcome(strip, state, slice, of->outcome, crossed, error);
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
