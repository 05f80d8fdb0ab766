/* A step in four stages: state -> exit state -> entry state -> slice state -> next state.
 *
 * A step as a whole tries each slice after each state. But most of what tells two states apart does not matter to the
 * right of the interface, and most of what tells two slices apart does not matter to rooms, walks and clauses. So equal
 * things are merged after each stage, and the product of the four stages is much smaller than that of states and
 * slices.
 *
 * ==== from a state to its exit states
 *
 * The outcomes of the interface after a state are grouped by what the left side can tell apart. For each group the
 * state leads to one exit state: its near side, which is what rooms, walks and clauses know at the interface, and its
 * far list, which is the far sides that the group's outcomes have. The edge and the tiles of the state's slice are not
 * needed any more. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/states.h"

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

static uint32_t number_left(tn_frontier *frontier, const uint32_t *words, const uint32_t *sides, uint32_t cells)
{
    bool ok = true;
    frontier->key.size = 0;
    for (const uint32_t *word = words + 2; ok && word < sides; word++)
        ok = tn_key_push(&frontier->key, *word);
    ok = ok && push_sides(sides, cells, &frontier->key) && tn_key_push(&frontier->key, cells);
    return ok ? tn_intern(&frontier->stages.lefts, frontier->key.data, frontier->key.size) : UINT32_MAX;
}

static uint32_t number_right(tn_frontier *frontier, const uint32_t *words, uint32_t sides, uint32_t fits)
{
    const uint32_t right[RIGHT_WORDS] = {words[0], words[1], sides, fits};
    return tn_intern(&frontier->stages.rights, right, RIGHT_WORDS);
}

bool tn_frontier_split_outcome(tn_frontier *frontier, const uint32_t *words, uint32_t left_cells, uint32_t right_cells,
                               tn_frontier_outcome *parts)
{
    const uint32_t *sides = words + 3 + (size_t)STEP_WORDS * words[2];
    parts->left = number_left(frontier, words, sides, left_cells);
    frontier->key.size = 0;
    bool ok = push_sides(sides + (size_t)SIDE_WORDS * left_cells, right_cells, &frontier->key);
    uint32_t seen = ok ? tn_intern(&frontier->stages.views, frontier->key.data, frontier->key.size) : UINT32_MAX;
    if (seen == UINT32_MAX)
        return false;
    parts->right = number_right(frontier, words, seen, parts->right_fits);
    parts->plain = number_right(frontier, words, seen, 0);
    return parts->left != UINT32_MAX && parts->right != UINT32_MAX && parts->plain != UINT32_MAX;
}

/* While tiles are left aside, nothing matters to them. */
uint32_t tn_frontier_right_seen(const tn_frontier *frontier, uint32_t outcome)
{
    return frontier->scouting ? frontier->outcomes.items[outcome].plain : frontier->outcomes.items[outcome].right;
}

uint32_t tn_frontier_left_fits(const tn_frontier *frontier, uint32_t outcome)
{
    return frontier->scouting ? 0 : frontier->outcomes.items[outcome].left_fits;
}

/* ---- interfaces grouped by what the left side can tell apart */

/* An outcome of an interface at the right of an edge, split into what its two sides can tell apart. */
typedef struct tn_frontier_split {
    uint32_t left, fits, far_side;
    uint64_t times;
} tn_frontier_split;

typedef struct tn_frontier_splits {
    tn_frontier_split *items;
    size_t count, room;
} tn_frontier_splits;

static int compare_splits(const void *a, const void *b)
{
    const tn_frontier_split *p = a, *q = b;
    return p->left != q->left   ? (p->left > q->left) - (p->left < q->left)
           : p->fits != q->fits ? (p->fits > q->fits) - (p->fits < q->fits)
                                : (p->far_side > q->far_side) - (p->far_side < q->far_side);
}

static bool same_left(const tn_frontier_split *a, const tn_frontier_split *b)
{
    return a->left == b->left && a->fits == b->fits;
}

static tn_status split_interface(tn_frontier *frontier, uint32_t edge, uint32_t entry, tn_frontier_splits *splits,
                                 tn_error *error)
{
    const tn_frontier_list *interface;
    tn_status status = tn_frontier_interface(frontier, edge, entry, &interface, error);
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve(&splits->items, &splits->room, splits->count, interface->count, sizeof *splits->items))
        return tn_fail_memory(error);
    for (size_t i = 0; i < interface->count; i++) {
        uint32_t outcome = interface->items[i].slice;
        uint32_t far_side =
            tn_number(&frontier->stages.far_sides, (uint64_t)entry << 32 | tn_frontier_right_seen(frontier, outcome));
        if (far_side == UINT32_MAX)
            return tn_fail_memory(error);
        splits->items[splits->count++] =
            (tn_frontier_split){frontier->outcomes.items[outcome].left, tn_frontier_left_fits(frontier, outcome),
                                far_side, interface->items[i].times};
    }
    return TN_OK;
}

/* The far list of the first splits with one left side; *count: how many splits these are. */
static uint32_t number_far_list(tn_frontier *frontier, const tn_frontier_split *splits, size_t most, size_t *count)
{
    tn_key *key = &frontier->key;
    bool ok = true;
    key->size = 0;
    size_t i = 0;
    while (ok && i < most && same_left(&splits[i], &splits[0])) {
        uint32_t far_side = splits[i].far_side;
        uint64_t times = 0;
        for (; i < most && same_left(&splits[i], &splits[0]) && splits[i].far_side == far_side; i++)
            times += splits[i].times;
        ok = tn_key_push(key, far_side) && tn_push_long(key, times);
    }
    *count = i;
    return ok ? tn_intern(&frontier->stages.far_lists, key->data, key->size) : UINT32_MAX;
}

/* splits: sorted. */
static tn_status list_interface_groups(tn_frontier *frontier, const tn_frontier_splits *splits,
                                       tn_frontier_interface_groups *interface_groups, tn_error *error)
{
    size_t room = 0, same;
    for (size_t i = 0; i < splits->count; i += same) {
        const tn_frontier_split *split = &splits->items[i];
        uint32_t far_list = number_far_list(frontier, split, splits->count - i, &same);
        if (far_list == UINT32_MAX ||
            !tn_array_reserve_from(&interface_groups->items, &room, 4, interface_groups->count, 1,
                                   sizeof *interface_groups->items))
            return tn_fail_memory(error);
        interface_groups->items[interface_groups->count++] =
            (tn_frontier_interface_group){split->left, split->fits, far_list};
    }
    return TN_OK;
}

static tn_status find_interface_groups(tn_frontier *frontier, uint32_t edge, uint32_t entries,
                                       tn_frontier_interface_groups *interface_groups, tn_error *error)
{
    tn_frontier_splits splits = {0};
    size_t count;
    tn_interned(&frontier->stages.lists, entries, &count);
    tn_status status = TN_OK;
    for (size_t i = 0, size; status == TN_OK && i < count; i++)
        status =
            split_interface(frontier, edge, tn_interned(&frontier->stages.lists, entries, &size)[i], &splits, error);
    if (status == TN_OK && splits.count > 0)
        qsort(splits.items, splits.count, sizeof *splits.items, compare_splits);
    if (status == TN_OK)
        status = list_interface_groups(frontier, &splits, interface_groups, error);
    free(splits.items);
    return status;
}

/* edge: TN_FRONTIER_NONE if the row begins. *interface_groups: good until the next call. */
static tn_status interface_groups_of(tn_frontier *frontier, uint32_t edge, uint32_t entries,
                                     const tn_frontier_interface_groups **interface_groups, tn_error *error)
{
    tn_frontier_stages *stages = &frontier->stages;
    uint32_t before = stages->interface_group_keys.count;
    if (!tn_array_reserve(&stages->interface_groups, &stages->interface_group_room, before, 1,
                          sizeof *stages->interface_groups))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&stages->interface_group_keys, (uint64_t)edge << 32 | entries);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    *interface_groups = &stages->interface_groups[at];
    if (at < before)
        return TN_OK;
    stages->interface_groups[at] = (tn_frontier_interface_groups){0};
    return find_interface_groups(frontier, edge, entries, &stages->interface_groups[at], error);
}

/* ---- the near side of an interface */

typedef struct tn_exit_by {
    tn_frontier *frontier;
    uint32_t number;       /* of the state */
    const uint32_t *state; /* words, or NULL */
    const tn_frontier_edge *edge;
    uint32_t left, fits;
} tn_exit_by;

/* An outcome that looks like this from the left, as far as views read it: its meetings are not filled in. */
static const uint32_t *left_as_outcome(const tn_exit_by *by, tn_key *key)
{
    size_t size;
    const uint32_t *left = tn_interned(&by->frontier->stages.lefts, by->left, &size);
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

/* What the right side can still tell of a walk, or (TN_FRONTIER_NONE) of the rooms, of the state. */
static tn_status push_view(const tn_exit_by *by, uint32_t walk, tn_key *key, tn_error *error)
{
    const uint32_t *outcome = left_as_outcome(by, &by->frontier->joined);
    if (!outcome)
        return tn_fail_memory(error);
    return walk == TN_FRONTIER_NONE
               ? tn_frontier_rooms_view(by->frontier, by->state[STATE_ROOMS], by->edge, outcome, key, error)
               : tn_frontier_walk_view(by->frontier, walk, by->state[STATE_WALKS + walk], by->edge, outcome, key,
                                       error);
}

static tn_status find_view(const tn_exit_by *by, uint32_t walk, uint32_t *view, tn_error *error)
{
    tn_frontier *frontier = by->frontier;
    bool rooms = walk == TN_FRONTIER_NONE, met;
    uint32_t before = frontier->stages.befores[rooms ? 0 : 1 + walk], *result;
    tn_frontier_known *known = rooms ? &frontier->stages.room_views : &frontier->stages.walk_views[walk];
    tn_status status = tn_frontier_known_at(known, before, by->left, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        frontier->key.size = 0;
        status = push_view(by, walk, &frontier->key, error);
        *result =
            status == TN_OK ? tn_intern(&frontier->stages.views, frontier->key.data, frontier->key.size) : UINT32_MAX;
        if (status == TN_OK && *result == UINT32_MAX)
            status = tn_fail_memory(error);
    }
    *view = status == TN_OK ? *result : 0;
    return status;
}

/* Before the first slice the near side is empty. */
static tn_status push_near_side(const tn_exit_by *by, uint32_t *words, tn_error *error)
{
    const tn_frontier_questions *q = &by->frontier->questions;
    uint32_t last = tn_frontier_pending_word(by->frontier) - 1;
    tn_status status = TN_OK;
    memset(words, 0, last * sizeof *words);
    words[NEAR_BEGUN] = by->state ? 0 : TN_FRONTIER_NONE;
    words[last] = by->state ? by->state[last] : TN_FRONTIER_NONE;
    if (by->state && q->room_count > 0)
        status = find_view(by, TN_FRONTIER_NONE, &words[STATE_ROOMS], error);
    for (uint32_t w = 0; by->state && status == TN_OK && w < q->walk_count; w++)
        status = find_view(by, w, &words[STATE_WALKS + w], error);
    return status;
}

static tn_status number_exit_state(const tn_exit_by *by, uint32_t far_list, uint32_t *number, tn_error *error)
{
    tn_frontier_stages *stages = &by->frontier->stages;
    uint32_t words[STATE_WALKS + TN_FRONTIER_MEETINGS_MAX + 1], before = stages->exit_states.count;
    tn_status status = push_near_side(by, words, error);
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve(&stages->exit_from, &stages->exit_state_room, before, 1, sizeof *stages->exit_from))
        return tn_fail_memory(error);
    uint32_t near_side = tn_intern(&stages->near_sides, words, tn_frontier_pending_word(by->frontier));
    *number =
        near_side != UINT32_MAX ? tn_number(&stages->exit_states, (uint64_t)near_side << 32 | far_list) : UINT32_MAX;
    if (*number == before)
        stages->exit_from[before] = (tn_frontier_exit_state){by->number, by->left, by->fits};
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- from a state */

/* What is before the interface is numbered once for all outcomes after a state. */
static tn_status begin_state(tn_frontier *frontier, uint32_t state, const uint32_t *words, tn_error *error)
{
    tn_frontier_stages *stages = &frontier->stages;
    if (!words || stages->last == state + 1)
        return TN_OK;
    stages->last = 0;
    for (uint32_t i = 0; i <= frontier->questions.walk_count; i++) {
        uint64_t asked = frontier->edges.items[words[STATE_EDGE]].asked;
        stages->befores[i] = tn_number(&frontier->crossed.befores, asked << 32 | words[STATE_ROOMS + i]);
        if (stages->befores[i] == UINT32_MAX)
            return tn_fail_memory(error);
    }
    stages->last = state + 1;
    return TN_OK;
}

tn_status tn_frontier_stage_exit(tn_frontier *frontier, uint32_t state, uint32_t entries, tn_frontier_seen *seen,
                                 void *context, tn_error *error)
{
    size_t size;
    const uint32_t *words = state == TN_FRONTIER_NONE ? NULL : tn_interned(&frontier->states, state, &size);
    const tn_frontier_interface_groups *interface_groups = NULL;
    tn_exit_by by = {.frontier = frontier,
                     .number = state,
                     .state = words,
                     .edge = words ? &frontier->edges.items[words[STATE_EDGE]] : NULL};
    tn_status status = begin_state(frontier, state, words, error);
    if (status == TN_OK)
        status = interface_groups_of(frontier, words ? words[STATE_EDGE] : TN_FRONTIER_NONE, entries, &interface_groups,
                                     error);
    for (size_t i = 0; status == TN_OK && i < interface_groups->count; i++) {
        const tn_frontier_interface_group *interface_group = &interface_groups->items[i];
        uint32_t exit_state;
        uint64_t tiles = 1;
        by.left = interface_group->left;
        by.fits = interface_group->fits;
        if (words && !frontier->scouting)
            status =
                tn_frontier_end_pending(frontier, words[tn_frontier_pending_word(frontier)], by.fits, &tiles, error);
        if (status != TN_OK || tiles == 0)
            continue;
        status = number_exit_state(&by, interface_group->far_list, &exit_state, error);
        if (status == TN_OK)
            status = seen(context, exit_state, tiles, 1, &(tn_house_gain){{0}}, error);
    }
    return status;
}

/* ==== into the slices
 *
 * From an exit state across the interface into the next slice, in two stages: to entry states (the interface is known,
 * the slice is not), then to slice states (the slice's group is known, its exit is not).
 *
 * Most entry states have no slice state, and those are not shown. So the slice states of an entry state are found
 * before it is shown, and kept while steps begin after the same number of trays. */

void tn_frontier_entered_forget(tn_frontier_entered *entered)
{
    tn_numbering_clear(&entered->keys);
    free(entered->spans);
    free(entered->slice_states);
    *entered = (tn_frontier_entered){0};
}

/* ---- entry states */

/* An outcome of the interface after the exit state's first state that has these two sides. */
static tn_status find_outcome(tn_frontier *frontier, const tn_frontier_exit_state *by, uint64_t far_side,
                              uint32_t *outcome, tn_error *error)
{
    size_t size;
    const tn_frontier_list *interface;
    bool begins = by->state == TN_FRONTIER_NONE;
    uint32_t edge = begins ? TN_FRONTIER_NONE : tn_interned(&frontier->states, by->state, &size)[STATE_EDGE];
    tn_status status = tn_frontier_interface(frontier, edge, tn_high(far_side), &interface, error);
    for (size_t i = 0; status == TN_OK && i < interface->count; i++) {
        *outcome = interface->items[i].slice;
        if (frontier->outcomes.items[*outcome].left == by->left &&
            tn_frontier_left_fits(frontier, *outcome) == by->fits &&
            tn_frontier_right_seen(frontier, *outcome) == tn_low(far_side))
            break;
    }
    return status;
}

static tn_status number_entry_state(tn_frontier *frontier, uint32_t exit_state, uint32_t far_side, uint32_t *number,
                                    tn_error *error)
{
    tn_frontier_stages *stages = &frontier->stages;
    uint32_t before = stages->entry_states.count, near_side = tn_high(stages->exit_states.keys[exit_state]);
    if (!tn_array_reserve(&stages->entry_from, &stages->entry_state_room, before, 1, sizeof *stages->entry_from))
        return tn_fail_memory(error);
    *number = tn_number(&stages->entry_states, (uint64_t)near_side << 32 | far_side);
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (*number < before)
        return TN_OK;
    const tn_frontier_exit_state *by = &stages->exit_from[exit_state];
    stages->entry_from[before].state = by->state;
    return find_outcome(frontier, by, stages->far_sides.keys[far_side], &stages->entry_from[before].outcome, error);
}

/* ---- into the slices */

typedef struct tn_entering_by {
    tn_frontier *frontier;
    const uint32_t *state, *near_side; /* words; state: or NULL */
    uint32_t trays, outcome, fits;
} tn_entering_by;

static tn_status number_slice_state(const tn_entering_by *by, uint32_t group, const uint32_t *crossed, uint32_t read,
                                    uint32_t *number, tn_error *error)
{
    tn_frontier *frontier = by->frontier;
    tn_key *key = &frontier->joined;
    key->size = 0;
    bool ok = tn_key_push(key, group);
    for (uint32_t w = 0; ok && w <= frontier->questions.walk_count; w++)
        ok = tn_key_push(key, crossed[CROSSED_ROOMS + w]);
    ok = ok && tn_key_push(key, read) && tn_key_push(key, by->fits);
    *number = ok ? tn_intern(&frontier->stages.slice_states, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status keep_slice_state(tn_frontier_entered *entered, uint32_t slice_state, tn_error *error)
{
    if (!tn_array_reserve(&entered->slice_states, &entered->slice_state_room, entered->slice_state_count, 1,
                          sizeof *entered->slice_states))
        return tn_fail_memory(error);
    entered->slice_states[entered->slice_state_count++] = slice_state;
    return TN_OK;
}

/* between: what clauses have read of the group's slices by themselves. */
static tn_status enter_group(const tn_entering_by *by, uint32_t group, uint32_t between, tn_error *error)
{
    uint32_t crossed[CROSSED_WALKS + TN_FRONTIER_MEETINGS_MAX + TN_FRONTIER_QUESTIONS_MAX], read, slice_state;
    tn_frontier *frontier = by->frontier;
    tn_status status = tn_frontier_cross_outcome(frontier, by->state, frontier->stages.slices[group], by->outcome,
                                                 by->near_side, crossed, error);
    if (status == TN_OK)
        status = tn_frontier_read_interface(frontier, by->trays, between, crossed[CROSSED_VALUES], &read, error);
    if (status != TN_OK || read == TN_FRONTIER_NONE)
        return status;
    status = number_slice_state(by, group, crossed, read, &slice_state, error);
    return status == TN_OK ? keep_slice_state(&frontier->stages.entered, slice_state, error) : status;
}

/* groups: a list, in which groups that clauses read alike follow one another. */
static tn_status enter(tn_frontier *frontier, uint32_t trays, uint32_t entry_state, uint32_t groups, tn_error *error)
{
    size_t size, count;
    const tn_frontier_stages *stages = &frontier->stages;
    uint64_t place = stages->entry_states.keys[entry_state];
    const tn_frontier_entry_state *crossed = &stages->entry_from[entry_state];
    const uint32_t *near_side = tn_interned(&stages->near_sides, tn_high(place), &size);
    const uint32_t *list = tn_interned(&stages->lists, groups, &count);
    const tn_entering_by by = {
        .frontier = frontier,
        .state = crossed->state == TN_FRONTIER_NONE ? NULL : tn_interned(&frontier->states, crossed->state, &size),
        .near_side = near_side,
        .trays = trays,
        .outcome = crossed->outcome,
        .fits = tn_interned(&stages->rights, tn_low(stages->far_sides.keys[tn_low(place)]), &size)[RIGHT_FITS]};
    uint32_t bases = TN_FRONTIER_NONE, between = TN_FRONTIER_NONE, last = tn_frontier_pending_word(frontier) - 1;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t slice = stages->slices[list[i]];
        if (i == 0 || frontier->slices.items[slice].bases != bases)
            status = tn_frontier_read_slice(frontier, trays, near_side[last], slice, &between, error);
        bases = frontier->slices.items[slice].bases;
        if (status == TN_OK && between != TN_FRONTIER_NONE)
            status = enter_group(&by, list[i], between, error);
    }
    return status;
}

static tn_status enter_once(tn_frontier *frontier, uint32_t trays, uint32_t entry_state, uint32_t groups,
                            tn_frontier_span *span, tn_error *error)
{
    tn_frontier_entered *entered = &frontier->stages.entered;
    uint32_t before = entered->keys.count;
    if (!tn_array_reserve(&entered->spans, &entered->span_room, before, 1, sizeof *entered->spans))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&entered->keys, (uint64_t)entry_state << 32 | groups);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before) {
        size_t first = entered->slice_state_count;
        status = enter(frontier, trays, entry_state, groups, error);
        entered->spans[at] = (tn_frontier_span){first, entered->slice_state_count - first};
    }
    *span = entered->spans[at];
    return status;
}

/* The slice states of an entry state, in the groups that its entry edge has in the list; none if it has none there. */
static tn_status find_slice_states(tn_frontier *frontier, uint32_t trays, uint32_t entry_state, uint32_t entry_groups,
                                   tn_frontier_span *span, tn_error *error)
{
    size_t words;
    const tn_frontier_stages *stages = &frontier->stages;
    const uint32_t *lists = tn_interned(&stages->lists, entry_groups, &words);
    uint32_t entry = tn_high(stages->far_sides.keys[tn_low(stages->entry_states.keys[entry_state])]);
    const uint32_t *own = words > 0 ? bsearch(&entry, lists, words / 2, 2 * sizeof *lists, tn_words_compare) : NULL;
    *span = (tn_frontier_span){0};
    if (!own)
        return TN_OK;
    if (frontier->stages.entered.trays != trays + 1)
        tn_frontier_entered_forget(&frontier->stages.entered);
    frontier->stages.entered.trays = trays + 1;
    tn_status status = enter_once(frontier, trays, entry_state, own[1], span, error);
    if (status != TN_OK) /* its span is not known */
        tn_frontier_entered_forget(&frontier->stages.entered);
    return status;
}

/* ---- the two stages */

tn_status tn_frontier_stage_cross(tn_frontier *frontier, uint32_t trays, uint32_t exit_state, uint32_t entry_groups,
                                  tn_frontier_seen *seen, void *context, tn_error *error)
{
    const tn_frontier_stages *stages = &frontier->stages;
    size_t size;
    const uint32_t *far_list = tn_interned(&stages->far_lists, tn_low(stages->exit_states.keys[exit_state]), &size);
    tn_status status = TN_OK;
    for (const uint32_t *end = far_list + size; status == TN_OK && far_list < end; far_list += FAR_WORDS) {
        uint32_t entry_state;
        uint64_t times = tn_both(far_list + FAR_TIMES);
        tn_frontier_span span = {0};
        status = number_entry_state(frontier, exit_state, far_list[FAR_SIDE], &entry_state, error);
        if (status == TN_OK)
            status = find_slice_states(frontier, trays, entry_state, entry_groups, &span, error);
        if (status == TN_OK && span.count > 0)
            status = seen(context, entry_state, times, times, &(tn_house_gain){{0}}, error);
    }
    return status;
}

tn_status tn_frontier_stage_enter(tn_frontier *frontier, uint32_t trays, uint32_t entry_state, uint32_t entry_groups,
                                  tn_frontier_seen *seen, void *context, tn_error *error)
{
    tn_frontier_span span;
    tn_status status = find_slice_states(frontier, trays, entry_state, entry_groups, &span, error);
    for (size_t i = 0; status == TN_OK && i < span.count; i++)
        status =
            seen(context, frontier->stages.entered.slice_states[span.first + i], 1, 1, &(tn_house_gain){{0}}, error);
    return status;
}

/* ==== groups of slices, and what is kept */

bool tn_frontier_has_stages(const tn_frontier *frontier)
{
    return frontier->added->count == 0 && !frontier->prices.asked && frontier->questions.placed_count == 0 &&
           frontier->questions.placed_walks == 0;
}

void tn_frontier_stages_forget(tn_frontier_stages *stages)
{
    for (uint32_t i = 0; i < stages->interface_group_keys.count; i++)
        free(stages->interface_groups[i].items);
    tn_numbering_clear(&stages->interface_group_keys);
    tn_numbering_clear(&stages->exit_states);
    tn_numbering_clear(&stages->entry_states);
    tn_interner_clear(&stages->slice_states);
    tn_frontier_entered_forget(&stages->entered);
    stages->last = 0;
}

void tn_frontier_stages_clear(tn_frontier_stages *stages)
{
    tn_interner *const interners[] = {&stages->groups,    &stages->lefts,      &stages->rights, &stages->lists,
                                      &stages->far_lists, &stages->near_sides, &stages->views};
    tn_frontier_stages_forget(stages);
    for (size_t i = 0; i < sizeof interners / sizeof *interners; i++)
        tn_interner_clear(interners[i]);
    tn_numbering_clear(&stages->far_sides);
    tn_numbering_clear(&stages->sided);
    tn_frontier_known_clear(&stages->room_views);
    tn_frontier_known_clear(&stages->crossed_rooms);
    for (uint32_t w = 0; w < TN_FRONTIER_MEETINGS_MAX; w++) {
        tn_frontier_known_clear(&stages->walk_views[w]);
        tn_frontier_known_clear(&stages->crossed_walks[w]);
    }
    free(stages->interface_groups);
    free(stages->exit_from);
    free(stages->entry_from);
    free(stages->slices);
}

bool tn_frontier_find_group(tn_frontier *frontier, uint32_t slice)
{
    tn_frontier_stages *stages = &frontier->stages;
    tn_frontier_slice *parts = &frontier->slices.items[slice];
    const uint32_t words[] = {parts->entry, parts->met, parts->bases};
    uint32_t before = stages->groups.count;
    if (!tn_array_reserve(&stages->slices, &stages->slice_room, before, 1, sizeof *stages->slices))
        return false;
    parts->group = tn_intern(&stages->groups, words, sizeof words / sizeof *words);
    if (parts->group == before)
        stages->slices[before] = slice;
    return parts->group != UINT32_MAX;
}

uint32_t tn_frontier_number_list(tn_frontier *frontier, const uint32_t *items, size_t count)
{
    return tn_intern(&frontier->stages.lists, items, count);
}

uint32_t tn_frontier_slice_state_group(const tn_frontier *frontier, uint32_t slice_state)
{
    size_t size;
    return tn_interned(&frontier->stages.slice_states, slice_state, &size)[SLICE_STATE_GROUP];
}

/* ==== from a slice state to the next state: the slice's exit and its pending tiles become known */

tn_status tn_frontier_stage_pass(tn_frontier *frontier, uint32_t slice_state, uint32_t slice, tn_frontier_seen *seen,
                                 void *context, tn_error *error)
{
    size_t size;
    tn_frontier_pending pending;
    tn_key *key = &frontier->joined;
    const uint32_t *words = tn_interned(&frontier->stages.slice_states, slice_state, &size);
    uint32_t last = tn_frontier_pending_word(frontier), edge = frontier->slices.items[slice].exit;
    tn_status status = tn_frontier_find_pending(frontier, slice, words[last], &pending, error);
    if (status != TN_OK || pending.number == TN_FRONTIER_NONE)
        return status;
    key->size = 0;
    bool ok = tn_key_push(key, frontier->merged.edges ? frontier->merged.edges[edge] : edge);
    for (uint32_t i = STATE_ROOMS; ok && i < last; i++)
        ok = tn_key_push(key, words[i]);
    ok = ok && tn_key_push(key, pending.number);
    uint32_t state = ok ? tn_intern(&frontier->states, key->data, key->size) : UINT32_MAX;
    return state != UINT32_MAX ? seen(context, state, pending.times, 1, &(tn_house_gain){{0}}, error)
                               : tn_fail_memory(error);
}
