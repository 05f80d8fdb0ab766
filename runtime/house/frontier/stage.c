/* A step in four stages, so that what is equal half way is gone on from once.
 *
 * ==== from a state to what can be seen of the plane behind it
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

/* ==== into the slices
 *
 * From a leaving over the plane into the slices behind it, in two stages: to thresholds, where the plane is
 * known and the slice is not, then to arrivals.
 *
 * Most thresholds lead nowhere, and those are not shown. So it is known what each leads to before it is gone on from;
 * that is kept as long as steps begin after the same number of trays. */

void tn_strip_entered_forget(tn_strip_entered *entered)
{
    tn_numbering_clear(&entered->keys);
    free(entered->spans);
    free(entered->arrivals);
    *entered = (tn_strip_entered){0};
}

/* ---- thresholds */

/* An outcome of the plane of the leaving's first state with what is seen from both sides. */
static tn_status find_outcome(tn_strip *strip, const tn_strip_leaving *by, uint64_t facing, uint32_t *outcome,
                              tn_error *error)
{
    size_t size;
    const tn_strip_list *plane;
    bool begins = by->state == TN_STRIP_NONE;
    uint32_t edge = begins ? TN_STRIP_NONE : tn_interned(&strip->states, by->state, &size)[STATE_EDGE];
    tn_status status = tn_strip_plane(strip, edge, tn_high(facing), &plane, error);
    for (size_t i = 0; status == TN_OK && i < plane->count; i++) {
        *outcome = plane->items[i].slice;
        if (strip->outcomes[*outcome].left == by->left && tn_strip_left_fits(strip, *outcome) == by->fits &&
            tn_strip_right_seen(strip, *outcome) == tn_low(facing))
            break;
    }
    return status;
}

static tn_status number_threshold(tn_strip *strip, uint32_t leaving, uint32_t facing, uint32_t *number, tn_error *error)
{
    tn_strip_stages *stages = &strip->stages;
    uint32_t before = stages->thresholds.count, behind = tn_high(stages->leavings.keys[leaving]);
    if (!tn_array_reserve(&stages->crossed_by, &stages->threshold_room, before, 1, sizeof *stages->crossed_by))
        return tn_fail_memory(error);
    *number = tn_number(&stages->thresholds, (uint64_t)behind << 32 | facing);
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (*number < before)
        return TN_OK;
    const tn_strip_leaving *by = &stages->left_by[leaving];
    stages->crossed_by[before].state = by->state;
    return find_outcome(strip, by, stages->facings.keys[facing], &stages->crossed_by[before].outcome, error);
}

/* ---- into the slices */

typedef struct tn_entering_by {
    tn_strip *strip;
    const uint32_t *state, *behind; /* words; state: or NULL */
    uint32_t trays, outcome, fits;
} tn_entering_by;

static tn_status number_arrival(const tn_entering_by *by, uint32_t group, const uint32_t *crossed, uint32_t read,
                                uint32_t *number, tn_error *error)
{
    tn_strip *strip = by->strip;
    tn_key *key = &strip->joined;
    key->size = 0;
    bool ok = tn_key_push(key, group);
    for (uint32_t w = 0; ok && w <= strip->questions.walk_count; w++)
        ok = tn_key_push(key, crossed[CROSSED_ROOMS + w]);
    ok = ok && tn_key_push(key, read) && tn_key_push(key, by->fits);
    *number = ok ? tn_intern(&strip->stages.arrivals, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status keep_arrival(tn_strip_entered *entered, uint32_t arrival, tn_error *error)
{
    if (!tn_array_reserve(&entered->arrivals, &entered->arrival_room, entered->arrival_count, 1,
                          sizeof *entered->arrivals))
        return tn_fail_memory(error);
    entered->arrivals[entered->arrival_count++] = arrival;
    return TN_OK;
}

/* between: what clauses have read of the group's slices by themselves. */
static tn_status enter_group(const tn_entering_by *by, uint32_t group, uint32_t between, tn_error *error)
{
    uint32_t crossed[CROSSED_WALKS + TN_STRIP_MEETINGS_MAX + TN_STRIP_QUESTIONS_MAX], read, arrival;
    tn_strip *strip = by->strip;
    tn_status status =
        tn_strip_cross_outcome(strip, by->state, strip->stages.slices[group], by->outcome, by->behind, crossed, error);
    if (status == TN_OK)
        status = tn_strip_read_plane(strip, by->trays, between, crossed[CROSSED_VALUES], &read, error);
    if (status != TN_OK || read == TN_STRIP_NONE)
        return status;
    status = number_arrival(by, group, crossed, read, &arrival, error);
    return status == TN_OK ? keep_arrival(&strip->stages.entered, arrival, error) : status;
}

/* groups: a list, those together of which clauses read the same. */
static tn_status enter(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t groups, tn_error *error)
{
    size_t size, count;
    const tn_strip_stages *stages = &strip->stages;
    uint64_t place = stages->thresholds.keys[threshold];
    const tn_strip_threshold *crossed = &stages->crossed_by[threshold];
    const uint32_t *behind = tn_interned(&stages->behinds, tn_high(place), &size);
    const uint32_t *list = tn_interned(&stages->lists, groups, &count);
    const tn_entering_by by = {
        .strip = strip,
        .state = crossed->state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, crossed->state, &size),
        .behind = behind,
        .trays = trays,
        .outcome = crossed->outcome,
        .fits = tn_interned(&stages->rights, tn_low(stages->facings.keys[tn_low(place)]), &size)[RIGHT_FITS]};
    uint32_t bases = TN_STRIP_NONE, between = TN_STRIP_NONE, last = tn_strip_waiting_word(strip) - 1;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t slice = stages->slices[list[i]];
        if (i == 0 || strip->slices[slice].bases != bases)
            status = tn_strip_read_slice(strip, trays, behind[last], slice, &between, error);
        bases = strip->slices[slice].bases;
        if (status == TN_OK && between != TN_STRIP_NONE)
            status = enter_group(&by, list[i], between, error);
    }
    return status;
}

static tn_status enter_once(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t groups, tn_strip_span *span,
                            tn_error *error)
{
    tn_strip_entered *entered = &strip->stages.entered;
    uint32_t before = entered->keys.count;
    if (!tn_array_reserve(&entered->spans, &entered->span_room, before, 1, sizeof *entered->spans))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&entered->keys, (uint64_t)threshold << 32 | groups);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before) {
        size_t first = entered->arrival_count;
        status = enter(strip, trays, threshold, groups, error);
        entered->spans[at] = (tn_strip_span){first, entered->arrival_count - first};
    }
    *span = entered->spans[at];
    return status;
}

/* The arrivals behind a threshold by the groups that its entry has there; none where it has none. */
static tn_status find_arrivals(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t entering,
                               tn_strip_span *span, tn_error *error)
{
    size_t words;
    const tn_strip_stages *stages = &strip->stages;
    const uint32_t *lists = tn_interned(&stages->lists, entering, &words);
    uint32_t entry = tn_high(stages->facings.keys[tn_low(stages->thresholds.keys[threshold])]);
    const uint32_t *own = words > 0 ? bsearch(&entry, lists, words / 2, 2 * sizeof *lists, tn_words_compare) : NULL;
    *span = (tn_strip_span){0};
    if (!own)
        return TN_OK;
    if (strip->stages.entered.trays != trays + 1)
        tn_strip_entered_forget(&strip->stages.entered);
    strip->stages.entered.trays = trays + 1;
    tn_status status = enter_once(strip, trays, threshold, own[1], span, error);
    if (status != TN_OK) /* its span is not known */
        tn_strip_entered_forget(&strip->stages.entered);
    return status;
}

/* ---- the two stages */

tn_status tn_strip_face(tn_strip *strip, uint32_t trays, uint32_t leaving, uint32_t entering, tn_strip_seen *seen,
                        void *context, tn_error *error)
{
    const tn_strip_stages *stages = &strip->stages;
    size_t size;
    const uint32_t *outlook = tn_interned(&stages->outlooks, tn_low(stages->leavings.keys[leaving]), &size);
    tn_status status = TN_OK;
    for (const uint32_t *end = outlook + size; status == TN_OK && outlook < end; outlook += OUTLOOK_WORDS) {
        uint32_t threshold;
        uint64_t times = tn_both(outlook + OUTLOOK_TIMES);
        tn_strip_span span = {0};
        status = number_threshold(strip, leaving, outlook[OUTLOOK_FACING], &threshold, error);
        if (status == TN_OK)
            status = find_arrivals(strip, trays, threshold, entering, &span, error);
        if (status == TN_OK && span.count > 0)
            status = seen(context, threshold, times, times, &(tn_house_gain){{0}}, error);
    }
    return status;
}

tn_status tn_strip_enter(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t entering, tn_strip_seen *seen,
                         void *context, tn_error *error)
{
    tn_strip_span span;
    tn_status status = find_arrivals(strip, trays, threshold, entering, &span, error);
    for (size_t i = 0; status == TN_OK && i < span.count; i++)
        status = seen(context, strip->stages.entered.arrivals[span.first + i], 1, 1, &(tn_house_gain){{0}}, error);
    return status;
}

/* ==== to the right side
 *
 * A step from a state to one behind the next slice, in four stages: to what can be seen of the plane behind it,
 * to what faces it, into the slice, to its right side.
 *
 * Many states are one at the plane, as their edges are behind it and their tiles are counted; many slices are one to
 * rooms, walks and clauses. So the step is the product of four that are much smaller. */

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
