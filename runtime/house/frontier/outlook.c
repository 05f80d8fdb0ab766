/* From a state to what can be seen of the plane behind it.
 *
 * Most of what tells states apart does not matter to what stands at the right of the plane, and the other way round. So
 * a state leads to leavings, of which each stands for all that can face what is seen from the left. All states that
 * see this are one. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

/* ---- both sides of an outcome */

/* Marks and glass of cells, as rooms see them. */
static bool push_sides(const uint32_t *sides, uint32_t cells, tn_key *key)
{
    bool ok = true;
    for (uint32_t i = 0; ok && i < cells; i++, sides += SIDE_WORDS)
        ok = tn_key_push(key, sides[SIDE_MARKS]) && tn_key_push(key, sides[SIDE_MARKS_HIGH]) &&
             tn_key_push(key, sides[SIDE_GLASS]);
    return ok;
}

static uint32_t number_left(tn_strip *strip, const uint32_t *words, const uint32_t *sides, uint32_t cells)
{
    bool ok = true;
    strip->key.size = 0;
    for (const uint32_t *word = words + 2; ok && word < sides; word++)
        ok = tn_key_push(&strip->key, *word);
    ok = ok && push_sides(sides, cells, &strip->key) && tn_key_push(&strip->key, cells);
    return ok ? tn_intern(&strip->stages.lefts, strip->key.data, strip->key.size) : UINT32_MAX;
}

static uint32_t number_right(tn_strip *strip, const uint32_t *words, uint32_t sides, uint32_t fits)
{
    const uint32_t right[RIGHT_WORDS] = {words[0], words[1], sides, fits};
    return tn_intern(&strip->stages.rights, right, RIGHT_WORDS);
}

bool tn_strip_split_outcome(tn_strip *strip, const uint32_t *words, uint32_t left_cells, uint32_t right_cells,
                            tn_strip_outcome *parts)
{
    const uint32_t *sides = words + 3 + (size_t)STEP_WORDS * words[2];
    parts->left = number_left(strip, words, sides, left_cells);
    strip->key.size = 0;
    bool ok = push_sides(sides + (size_t)SIDE_WORDS * left_cells, right_cells, &strip->key);
    uint32_t seen = ok ? tn_intern(&strip->stages.views, strip->key.data, strip->key.size) : UINT32_MAX;
    if (seen == UINT32_MAX)
        return false;
    parts->right = number_right(strip, words, seen, parts->right_fits);
    parts->plain = number_right(strip, words, seen, 0);
    return parts->left != UINT32_MAX && parts->right != UINT32_MAX && parts->plain != UINT32_MAX;
}

/* While tiles are left aside, nothing matters to them. */
uint32_t tn_strip_right_seen(const tn_strip *strip, uint32_t outcome)
{
    return strip->scouting ? strip->outcomes[outcome].plain : strip->outcomes[outcome].right;
}

uint32_t tn_strip_left_fits(const tn_strip *strip, uint32_t outcome)
{
    return strip->scouting ? 0 : strip->outcomes[outcome].left_fits;
}

/* ---- prospects behind an edge */

/* An outcome of a plane behind an edge, with what is seen of it. */
typedef struct tn_strip_sight {
    uint32_t left, fits, facing;
    uint64_t times;
} tn_strip_sight;

typedef struct tn_strip_sights {
    tn_strip_sight *items;
    size_t count, room;
} tn_strip_sights;

static int compare_sights(const void *a, const void *b)
{
    const tn_strip_sight *p = a, *q = b;
    return p->left != q->left   ? (p->left > q->left) - (p->left < q->left)
           : p->fits != q->fits ? (p->fits > q->fits) - (p->fits < q->fits)
                                : (p->facing > q->facing) - (p->facing < q->facing);
}

static bool same_left(const tn_strip_sight *a, const tn_strip_sight *b)
{
    return a->left == b->left && a->fits == b->fits;
}

static tn_status see_plane(tn_strip *strip, uint32_t edge, uint32_t entry, tn_strip_sights *sights, tn_error *error)
{
    const tn_strip_list *plane;
    tn_status status = tn_strip_plane(strip, edge, entry, &plane, error);
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve(&sights->items, &sights->room, sights->count, plane->count, sizeof *sights->items))
        return tn_fail_memory(error);
    for (size_t i = 0; i < plane->count; i++) {
        uint32_t outcome = plane->items[i].slice;
        uint32_t facing =
            tn_number(&strip->stages.facings, (uint64_t)entry << 32 | tn_strip_right_seen(strip, outcome));
        if (facing == UINT32_MAX)
            return tn_fail_memory(error);
        sights->items[sights->count++] = (tn_strip_sight){
            strip->outcomes[outcome].left, tn_strip_left_fits(strip, outcome), facing, plane->items[i].times};
    }
    return TN_OK;
}

/* The outlook of the first sights that are the same from the left; *count: how many these are. */
static uint32_t number_outlook(tn_strip *strip, const tn_strip_sight *sights, size_t most, size_t *count)
{
    tn_key *key = &strip->key;
    bool ok = true;
    key->size = 0;
    size_t i = 0;
    while (ok && i < most && same_left(&sights[i], &sights[0])) {
        uint32_t facing = sights[i].facing;
        uint64_t times = 0;
        for (; i < most && same_left(&sights[i], &sights[0]) && sights[i].facing == facing; i++)
            times += sights[i].times;
        ok = tn_key_push(key, facing) && tn_push_long(key, times);
    }
    *count = i;
    return ok ? tn_intern(&strip->stages.outlooks, key->data, key->size) : UINT32_MAX;
}

/* sights: in order. */
static tn_status list_prospects(tn_strip *strip, const tn_strip_sights *sights, tn_strip_prospects *prospects,
                                tn_error *error)
{
    size_t room = 0, same;
    for (size_t i = 0; i < sights->count; i += same) {
        const tn_strip_sight *sight = &sights->items[i];
        uint32_t outlook = number_outlook(strip, sight, sights->count - i, &same);
        if (outlook == UINT32_MAX ||
            !tn_array_reserve_from(&prospects->items, &room, 4, prospects->count, 1, sizeof *prospects->items))
            return tn_fail_memory(error);
        prospects->items[prospects->count++] = (tn_strip_prospect){sight->left, sight->fits, outlook};
    }
    return TN_OK;
}

static tn_status find_prospects(tn_strip *strip, uint32_t edge, uint32_t entries, tn_strip_prospects *prospects,
                                tn_error *error)
{
    tn_strip_sights sights = {0};
    size_t count;
    tn_interned(&strip->stages.lists, entries, &count);
    tn_status status = TN_OK;
    for (size_t i = 0, size; status == TN_OK && i < count; i++)
        status = see_plane(strip, edge, tn_interned(&strip->stages.lists, entries, &size)[i], &sights, error);
    if (status == TN_OK && sights.count > 0)
        qsort(sights.items, sights.count, sizeof *sights.items, compare_sights);
    if (status == TN_OK)
        status = list_prospects(strip, &sights, prospects, error);
    free(sights.items);
    return status;
}

/* edge: TN_STRIP_NONE where the row begins. *prospects: good until the next call. */
static tn_status prospects_of(tn_strip *strip, uint32_t edge, uint32_t entries, const tn_strip_prospects **prospects,
                              tn_error *error)
{
    tn_strip_stages *stages = &strip->stages;
    uint32_t before = stages->prospect_keys.count;
    if (!tn_array_reserve(&stages->prospects, &stages->prospect_room, before, 1, sizeof *stages->prospects))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&stages->prospect_keys, (uint64_t)edge << 32 | entries);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    *prospects = &stages->prospects[at];
    if (at < before)
        return TN_OK;
    stages->prospects[at] = (tn_strip_prospects){0};
    return find_prospects(strip, edge, entries, &stages->prospects[at], error);
}

/* ---- what is behind a plane */

typedef struct tn_leaving_by {
    tn_strip *strip;
    uint32_t number;       /* of the state */
    const uint32_t *state; /* words, or NULL */
    const tn_strip_edge *edge;
    uint32_t left, fits;
} tn_leaving_by;

/* An outcome of which this is seen from the left, as far as views look at it: its meetings are not among that. */
static const uint32_t *left_as_outcome(const tn_leaving_by *by, tn_key *key)
{
    size_t size;
    const uint32_t *left = tn_interned(&by->strip->stages.lefts, by->left, &size);
    uint32_t steps = STEP_WORDS * left[0];
    bool ok = true;
    key->size = 0;
    ok = tn_push_long(key, 0);
    for (uint32_t i = 0; ok && i <= steps; i++)
        ok = tn_key_push(key, left[i]);
    for (const uint32_t *side = left + 1 + steps; ok && side + 3 < left + size; side += 3)
        ok = tn_key_push(key, side[0]) && tn_key_push(key, side[1]) && tn_key_push(key, 0) && tn_key_push(key, side[2]);
    return ok ? key->data : NULL;
}

/* What can be seen of the plane behind it: of a walk, or (TN_STRIP_NONE) of the rooms. */
static tn_status push_view(const tn_leaving_by *by, uint32_t walk, tn_key *key, tn_error *error)
{
    const uint32_t *outcome = left_as_outcome(by, &by->strip->joined);
    if (!outcome)
        return tn_fail_memory(error);
    return walk == TN_STRIP_NONE
               ? tn_strip_rooms_view(by->strip, by->state[STATE_ROOMS], by->edge, outcome, key, error)
               : tn_strip_walk_view(by->strip, walk, by->state[STATE_WALKS + walk], by->edge, outcome, key, error);
}

static tn_status find_view(const tn_leaving_by *by, uint32_t walk, uint32_t *view, tn_error *error)
{
    tn_strip *strip = by->strip;
    bool rooms = walk == TN_STRIP_NONE, met;
    uint32_t before = strip->stages.befores[rooms ? 0 : 1 + walk], *result;
    tn_strip_known *known = rooms ? &strip->stages.room_views : &strip->stages.walk_views[walk];
    tn_status status = tn_strip_known_at(known, before, by->left, 1, &result, &met, error);
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

/* Before the first slice nothing is behind. */
static tn_status push_behind(const tn_leaving_by *by, uint32_t *words, tn_error *error)
{
    const tn_strip_questions *q = &by->strip->questions;
    uint32_t last = tn_strip_waiting_word(by->strip) - 1;
    tn_status status = TN_OK;
    memset(words, 0, last * sizeof *words);
    words[BEHIND_BEGUN] = by->state ? 0 : TN_STRIP_NONE;
    words[last] = by->state ? by->state[last] : TN_STRIP_NONE;
    if (by->state && q->room_count > 0)
        status = find_view(by, TN_STRIP_NONE, &words[STATE_ROOMS], error);
    for (uint32_t w = 0; by->state && status == TN_OK && w < q->walk_count; w++)
        status = find_view(by, w, &words[STATE_WALKS + w], error);
    return status;
}

static tn_status number_leaving(const tn_leaving_by *by, uint32_t outlook, uint32_t *number, tn_error *error)
{
    tn_strip_stages *stages = &by->strip->stages;
    uint32_t words[STATE_WALKS + TN_STRIP_MEETINGS_MAX + 1], before = stages->leavings.count;
    tn_status status = push_behind(by, words, error);
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve(&stages->left_by, &stages->leaving_room, before, 1, sizeof *stages->left_by))
        return tn_fail_memory(error);
    uint32_t behind = tn_intern(&stages->behinds, words, tn_strip_waiting_word(by->strip));
    *number = behind != UINT32_MAX ? tn_number(&stages->leavings, (uint64_t)behind << 32 | outlook) : UINT32_MAX;
    if (*number == before)
        stages->left_by[before] = (tn_strip_leaving){by->number, by->left, by->fits};
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- from a state */

/* What is before each walk is numbered once for all that is met from a state. */
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

tn_status tn_strip_leave(tn_strip *strip, uint32_t state, uint32_t entries, tn_strip_seen *seen, void *context,
                         tn_error *error)
{
    size_t size;
    const uint32_t *words = state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, state, &size);
    const tn_strip_prospects *prospects = NULL;
    tn_leaving_by by = {
        .strip = strip, .number = state, .state = words, .edge = words ? &strip->edges[words[STATE_EDGE]] : NULL};
    tn_status status = begin_state(strip, state, words, error);
    if (status == TN_OK)
        status = prospects_of(strip, words ? words[STATE_EDGE] : TN_STRIP_NONE, entries, &prospects, error);
    for (size_t i = 0; status == TN_OK && i < prospects->count; i++) {
        const tn_strip_prospect *prospect = &prospects->items[i];
        uint32_t leaving;
        uint64_t tiles = 1;
        by.left = prospect->left;
        by.fits = prospect->fits;
        if (words && !strip->scouting)
            status = tn_strip_end_waiting(strip, words[tn_strip_waiting_word(strip)], by.fits, &tiles, error);
        if (status != TN_OK || tiles == 0)
            continue;
        status = number_leaving(&by, prospect->outlook, &leaving, error);
        if (status == TN_OK)
            status = seen(context, leaving, tiles, 1, &(tn_house_gain){{0}}, error);
    }
    return status;
}
