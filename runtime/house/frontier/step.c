/* From a state to those after one more slice.
 *
 * ==== crossing an interface
 *
 * What comes of rooms and walks at an interface, and what the interface is to the clauses: each combination is worked
 * out once.
 *
 * Rooms and walks know of an edge only what is asked of its cells, so they cross all edges that are asked alike at
 * once. States that have an edge, rooms and walks in common cross each interface alike. What came of it is kept as long
 * as such states follow one another. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"

/* An interface that is being crossed: what is at its left is known by the state, what is at its right by the slice,
 * what is in it by the outcome. */
typedef struct tn_passing {
    tn_frontier *frontier;
    const uint32_t *state;     /* words, or NULL */
    const uint32_t *near_side; /* words, if views are crossed (stage.c); or NULL */
    uint32_t move, met;        /* met: what views of walks meet; rooms: sides, too */
    uint32_t sided;
    tn_frontier_crossing crossing;
    uint32_t *crossed;                                                 /* words, to be filled in */
    const uint32_t *seen_rooms, *seen_walks[TN_FRONTIER_MEETINGS_MAX]; /* SEEN_WORDS of what is placed in the row */
} tn_passing;

static void clear_row(tn_frontier_row *row)
{
    free(row->before);
    free(row->mark);
    free(row->interface);
    free(row->first);
    free(row->words);
}

void tn_frontier_crossed_clear(tn_frontier_crossed *crossed)
{
    tn_interner_clear(&crossed->rooms);
    tn_interner_clear(&crossed->walks);
    tn_numbering_clear(&crossed->befores);
    tn_numbering_clear(&crossed->moves);
    tn_frontier_known_clear(&crossed->of_rooms);
    for (uint32_t w = 0; w < TN_FRONTIER_MEETINGS_MAX; w++)
        tn_frontier_known_clear(&crossed->of_walks[w]);
    clear_row(&crossed->row);
}

/* ---- rooms and walks */

/* What crosses an interface: what was before it, with what is asked of the edge there. word: its place in a state. */
static tn_status number_before(const tn_passing *p, size_t word, uint32_t *number, tn_error *error)
{
    *number = TN_FRONTIER_NONE;
    if (!p->state)
        return TN_OK;
    *number = p->near_side
                  ? p->near_side[word]
                  : tn_number(&p->frontier->crossed.befores, (uint64_t)p->crossing.left->asked << 32 | p->state[word]);
    return *number == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

/* closed: of the questions about rooms. */
static tn_status cross_rooms(tn_passing *p, uint32_t *rooms, uint32_t *closed, tn_error *error)
{
    tn_frontier *frontier = p->frontier;
    tn_frontier_known *known = p->near_side ? &frontier->stages.crossed_rooms : &frontier->crossed.of_rooms;
    uint32_t questions = frontier->questions.room_count, number, *result;
    size_t words = 1 + questions + SEEN_WORDS * (size_t)frontier->questions.placed_count;
    bool met;
    *rooms = 0;
    if (questions == 0)
        return TN_OK;
    tn_status status = number_before(p, STATE_ROOMS, &number, error);
    if (status == TN_OK)
        status = tn_frontier_known_at(known, number, p->near_side ? p->sided : p->move, words, &result, &met, error);
    if (status == TN_OK && !met)
        status = tn_frontier_rooms_cross(frontier, p->state ? p->state[STATE_ROOMS] : 0, &p->crossing, &result[0],
                                         result + 1, error);
    if (status != TN_OK)
        return status;
    *rooms = result[0];
    memcpy(closed, result + 1, questions * sizeof *closed);
    p->seen_rooms = result + 1 + questions;
    return TN_OK;
}

static tn_status cross_walk(tn_passing *p, uint32_t walk, uint32_t *after, bool *apart, tn_error *error)
{
    tn_frontier *frontier = p->frontier;
    tn_frontier_known *known = p->near_side ? &frontier->stages.crossed_walks[walk] : &frontier->crossed.of_walks[walk];
    uint32_t before = p->state ? p->state[STATE_WALKS + walk] : 0, number, *result;
    bool met;
    size_t words = 2 + (tn_frontier_walk_placed(frontier, walk) ? SEEN_WORDS : 0);
    tn_status status = number_before(p, STATE_WALKS + walk, &number, error);
    if (status == TN_OK)
        status = tn_frontier_known_at(known, number, p->near_side ? p->met : p->move, words, &result, &met, error);
    if (status == TN_OK && !met) {
        status = tn_frontier_walk_cross(frontier, walk, before, &p->crossing, &result[0], apart, result + 2, error);
        result[1] = *apart;
    }
    if (status != TN_OK)
        return status;
    *after = result[0];
    *apart = result[1];
    p->seen_walks[walk] = result + 2;
    return TN_OK;
}

/* ---- clauses */

static uint32_t seen_of(const tn_passing *p, const tn_frontier_atom *atom)
{
    bool walk = atom->op.opcode == TN_OP_APART;
    return tn_frontier_span_value(atom, walk ? p->seen_walks[atom->of] : p->seen_rooms + SEEN_WORDS * atom->place);
}

/* What the interface says of the atoms of a clause; UINT32_MAX: more than it tells apart. */
static uint32_t value_of(const tn_passing *p, const tn_frontier_clause *clause, const uint32_t *closed,
                         const bool *apart)
{
    uint32_t value = 0;
    for (size_t i = clause->atom_count; i-- > 0;) {
        const tn_frontier_atom *atom = &clause->atoms[i];
        uint32_t of = atom->of, one = 0;
        if (atom->placed)
            one = seen_of(p, atom);
        else if (atom->op.opcode == TN_OP_MEETS)
            one = tn_both(p->crossing.outcome) >> of & 1;
        else if (atom->op.opcode == TN_OP_APART)
            one = apart[of];
        else if (atom->op.opcode == TN_OP_SOME_ROOM)
            one = closed[of] > 0;
        else if (atom->op.opcode == TN_OP_ROOMS)
            one = closed[of];
        if (one == UINT32_MAX)
            return one;
        value = value * atom->radix + one;
    }
    return value;
}

static tn_status too_many_slots(const tn_frontier *frontier, uint32_t clause, tn_error *error)
{
    const tn_module *module = frontier->form->module;
    const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[frontier->library->clause_first + clause];
    tn_frontier_limit(frontier, tn_text(module, record->name),
                      "asks where more rooms or walks are than can be told apart at once", error);
    tn_error_help(error, "ask where cells are, as in `neighbour(cell(...), cell(...))`, or whether they meet, as in "
                         "`touch(cell(...), cell(...))`; or ask about one plan (--plan PLAN or '#P')");
    return TN_LIMIT;
}

static tn_status find_values(const tn_passing *p, const uint32_t *closed, const bool *apart, uint32_t *values,
                             tn_error *error)
{
    tn_frontier *frontier = p->frontier;
    bool ok = true;
    *values = TN_FRONTIER_NONE;
    if (!p->state)
        return TN_OK;
    frontier->key.size = 0;
    for (uint32_t i = 0; ok && i < frontier->clause_count; i++) {
        const tn_frontier_clause *clause = &frontier->clauses[i];
        uint32_t value = clause->radix > 1 ? value_of(p, clause, closed, apart) : 0;
        if (value == UINT32_MAX)
            return too_many_slots(frontier, i, error);
        ok = tn_key_push(&frontier->key, value);
    }
    *values = ok ? tn_intern(&frontier->reading.values, frontier->key.data, frontier->key.size) : UINT32_MAX;
    return *values != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- an interface */

static tn_status cross_outcome(tn_passing *p, tn_error *error)
{
    tn_frontier *frontier = p->frontier;
    uint32_t *walks = p->crossed + CROSSED_WALKS, *closed = walks + frontier->questions.walk_count;
    bool apart[TN_FRONTIER_MEETINGS_MAX] = {false};
    tn_status status = cross_rooms(p, &p->crossed[CROSSED_ROOMS], closed, error);
    for (uint32_t w = 0; status == TN_OK && w < frontier->questions.walk_count; w++)
        status = cross_walk(p, w, &walks[w], &apart[w], error);
    return status == TN_OK ? find_values(p, closed, apart, &p->crossed[CROSSED_VALUES], error) : status;
}

static tn_passing begin_passing(tn_frontier *frontier, const uint32_t *state, uint32_t slice)
{
    size_t size;
    bool last = slice == TN_FRONTIER_NONE;
    tn_passing p = {.frontier = frontier, .state = state};
    p.crossing =
        (tn_frontier_crossing){.left = state ? &frontier->edges.items[state[STATE_EDGE]] : NULL,
                               .right = last ? NULL : &frontier->edges.items[frontier->slices.items[slice].entry],
                               .slice = last ? NULL : tn_interned(&frontier->slices.keys, slice, &size)};
    return p;
}

static tn_status pass(tn_passing *p, uint32_t slice, uint32_t outcome, tn_error *error)
{
    tn_frontier *frontier = p->frontier;
    size_t size;
    p->crossing.outcome = tn_interned(&frontier->outcomes.keys, outcome, &size);
    p->move = tn_number(&frontier->crossed.moves,
                        (uint64_t)frontier->outcomes.items[outcome].through << 32 |
                            (slice == TN_FRONTIER_NONE ? slice : frontier->slices.items[slice].met));
    return p->move == UINT32_MAX ? tn_fail_memory(error) : cross_outcome(p, error);
}

/* The same by the interface's right side and a near side. */
static tn_status pass_seen(tn_passing *p, uint32_t slice, uint32_t outcome, tn_error *error)
{
    tn_frontier *frontier = p->frontier;
    size_t size;
    uint32_t sides = tn_interned(&frontier->stages.rights, frontier->outcomes.items[outcome].right, &size)[RIGHT_SIDES];
    p->crossing.outcome = tn_interned(&frontier->outcomes.keys, outcome, &size);
    p->met = frontier->slices.items[slice].met;
    p->sided = tn_number(&frontier->stages.sided, (uint64_t)sides << 32 | p->met);
    return p->sided == UINT32_MAX ? tn_fail_memory(error) : cross_outcome(p, error);
}

static tn_status cross_interface(tn_frontier *frontier, const uint32_t *state, uint32_t slice,
                                 const tn_frontier_list *interface, uint32_t *crossed, tn_error *error)
{
    tn_passing p = begin_passing(frontier, state, slice);
    tn_status status = TN_OK;
    p.crossed = crossed;
    for (size_t i = 0; status == TN_OK && i < interface->count; i++, p.crossed += tn_frontier_crossed_words(frontier))
        status = pass(&p, slice, interface->items[i].slice, error);
    return status;
}

tn_status tn_frontier_cross_outcome(tn_frontier *frontier, const uint32_t *state, uint32_t slice, uint32_t outcome,
                                    const uint32_t *near_side, uint32_t *crossed, tn_error *error)
{
    tn_passing p = begin_passing(frontier, state, slice);
    p.crossed = crossed;
    p.near_side = near_side;
    return pass_seen(&p, slice, outcome, error);
}

/* ---- interfaces that states with the same before them have crossed */

static tn_status begin_row(tn_frontier *frontier, const uint32_t *state, tn_error *error)
{
    tn_frontier_row *row = &frontier->crossed.row;
    size_t words = tn_frontier_pending_word(frontier) - 1, moves = (size_t)frontier->slices.insides.count + 1;
    if (!row->mark) {
        row->before = malloc(words * sizeof *row->before);
        row->mark = calloc(moves, sizeof *row->mark);
        row->interface = malloc(moves * sizeof *row->interface);
        row->first = malloc(moves * sizeof *row->first);
        if (!row->before || !row->mark || !row->interface || !row->first)
            return tn_fail_memory(error);
    } else if (state ? memcmp(row->before, state, words * sizeof *state) == 0 : row->before[0] == TN_FRONTIER_NONE) {
        return TN_OK;
    }
    if (state)
        memcpy(row->before, state, words * sizeof *state);
    else
        row->before[0] = TN_FRONTIER_NONE;
    row->used = 0;
    row->stamp++;
    if (row->stamp == 0) { /* an old mark must not look new */
        memset(row->mark, 0, moves * sizeof *row->mark);
        row->stamp = 1;
    }
    return TN_OK;
}

tn_status tn_frontier_cross(tn_frontier *frontier, const uint32_t *state, uint32_t slice, tn_frontier_list *interface,
                            const uint32_t **crossed, tn_error *error)
{
    tn_frontier_row *row = &frontier->crossed.row;
    tn_status status = begin_row(frontier, state, error);
    if (status != TN_OK)
        return status;
    uint32_t at = slice == TN_FRONTIER_NONE ? frontier->slices.insides.count : frontier->slices.items[slice].inside;
    if (row->mark[at] != row->stamp) {
        const tn_frontier_list *list;
        status = tn_frontier_interface(frontier, state ? state[STATE_EDGE] : TN_FRONTIER_NONE,
                                       slice == TN_FRONTIER_NONE ? slice : frontier->slices.items[slice].entry, &list,
                                       error);
        if (status != TN_OK)
            return status;
        row->interface[at] = *list;
        row->first[at] = row->used;
        size_t words = list->count * tn_frontier_crossed_words(frontier);
        if (!tn_array_reserve(&row->words, &row->room, row->used, words + 1, sizeof *row->words))
            return tn_fail_memory(error);
        status = cross_interface(frontier, state, slice, &row->interface[at], row->words + row->used, error);
        row->used += words;
        row->mark[at] = status == TN_OK ? row->stamp : 0;
    }
    *interface = row->interface[at];
    *crossed = row->words + row->first[at];
    return status;
}

/* ==== steps that are kept
 *
 * Keeps the ways that a step goes on, as ranks go the same steps again and again: by the state before and the
 * slice, with each outcome of the interface by itself, of which a caller may ask for some. */

tn_status tn_frontier_ways_want(tn_frontier *frontier, tn_error *error)
{
    tn_frontier_ways *ways = &frontier->ways;
    if (!ways->after)
        ways->after = calloc((size_t)frontier->trays_most + 1, sizeof *ways->after);
    ways->wanted = ways->after != NULL;
    return ways->wanted ? TN_OK : tn_fail_memory(error);
}

const tn_frontier_ways_of_step *tn_frontier_ways_find(const tn_frontier *frontier, uint32_t trays, uint32_t state,
                                                      uint32_t slice)
{
    if (!frontier->ways.after)
        return NULL;
    const tn_frontier_ways_after *steps = &frontier->ways.after[trays];
    uint32_t at = tn_number_find(&steps->keys, (uint64_t)state << 32 | slice);
    return at == UINT32_MAX ? NULL : &steps->of[at];
}

bool tn_frontier_ways_begin(tn_frontier *frontier)
{
    enum { MOST = 1 << 18 }; /* ways and steps: 10 MB */
    tn_frontier_ways *ways = &frontier->ways;
    ways->first = ways->count;
    return ways->wanted && !frontier->scouting && frontier->added->count == 0 && ways->count + ways->steps < MOST;
}

tn_status tn_frontier_ways_add(tn_frontier *frontier, const tn_frontier_way *way, tn_error *error)
{
    tn_frontier_ways *ways = &frontier->ways;
    if (!tn_array_reserve(&ways->items, &ways->room, ways->count, 1, sizeof *ways->items))
        return tn_fail_memory(error);
    ways->items[ways->count++] = *way;
    return TN_OK;
}

void tn_frontier_ways_drop(tn_frontier *frontier)
{
    frontier->ways.count = frontier->ways.first;
}

static int compare_ways(const void *a, const void *b)
{
    const tn_frontier_way *p = a, *q = b;
    return (p->outcome > q->outcome) - (p->outcome < q->outcome);
}

tn_status tn_frontier_ways_end(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice, tn_error *error)
{
    tn_frontier_ways *ways = &frontier->ways;
    tn_frontier_ways_after *steps = &ways->after[trays];
    uint32_t before = steps->keys.count;
    bool ok = tn_array_reserve(&steps->of, &steps->room, before, 1, sizeof *steps->of) &&
              tn_number(&steps->keys, (uint64_t)state << 32 | slice) == before;
    if (!ok) {
        tn_frontier_ways_drop(frontier);
        return tn_fail_memory(error);
    }
    size_t count = ways->count - ways->first;
    if (count > 0)
        qsort(ways->items + ways->first, count, sizeof *ways->items, compare_ways);
    steps->of[before] = (tn_frontier_ways_of_step){ways->first, count};
    ways->steps++;
    return TN_OK;
}

void tn_frontier_ways_forget(tn_frontier *frontier)
{
    tn_frontier_ways *ways = &frontier->ways;
    for (uint32_t k = 0; ways->after && k <= frontier->trays_most; k++) {
        tn_numbering_clear(&ways->after[k].keys);
        free(ways->after[k].of);
    }
    free(ways->after);
    free(ways->items);
    *ways = (tn_frontier_ways){0};
}

/* ==== steps */

typedef struct tn_stepping {
    tn_frontier *frontier;
    const uint32_t *state; /* words; NULL: before the first slice */
    uint32_t slice;        /* TN_FRONTIER_NONE: after the last */
    uint32_t trays;        /* before the slice */
    const tn_frontier_outcome *outcome;
    const uint32_t *crossed;     /* words: what came of rooms and walks at the outcome */
    tn_frontier_pending pending; /* the same */
    bool keeping;                /* ways are not shown, but kept */
} tn_stepping;

/* ---- tiles */

/* The sums of the tiles of the slice before, which are known with the outcome. */
static tn_status count_tiles(const tn_stepping *s, tn_error *error)
{
    tn_frontier *frontier = s->frontier;
    if (!s->state || frontier->scouting)
        return tn_frontier_sum_one(frontier, 1, error);
    return tn_frontier_sum_tiles(frontier, s->state[tn_frontier_pending_word(frontier)], s->outcome->left_fits, error);
}

static tn_status list_pending(tn_frontier *frontier, uint32_t bases, uint32_t sides, tn_frontier_pending *pending,
                              tn_error *error)
{
    size_t cells;
    tn_key *key = &frontier->joined;
    const uint32_t *base = tn_interned(&frontier->tiles.lists, bases, &cells);
    const uint32_t *fits = tn_interned(&frontier->tiles.lists, sides, &cells);
    key->size = 0;
    *pending = (tn_frontier_pending){TN_FRONTIER_NONE, 1};
    for (uint32_t i = 0; i < cells; i++) {
        tn_frontier_cell_class class_of;
        if (base[i] == 0)
            continue;
        tn_status status = tn_frontier_pending_class(frontier, base[i] - 1, fits[i] - 1, &class_of, error);
        if (status != TN_OK || class_of.class == TN_FRONTIER_NONE)
            return status;
        if (class_of.ever && (!tn_key_push(key, i) || !tn_key_push(key, class_of.class)))
            return tn_fail_memory(error);
        if (__builtin_mul_overflow(pending->times, (uint64_t)class_of.factor, &pending->times))
            return tn_frontier_limit(frontier, NULL, "a tray has more than 2^64 arrangements of tiles", error);
    }
    pending->number = tn_intern(&frontier->tiles.pending, key->data, key->size);
    return pending->number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* At the end of the row no tile is pending. */
tn_status tn_frontier_find_pending(tn_frontier *frontier, uint32_t slice, uint32_t right_fits,
                                   tn_frontier_pending *pending, tn_error *error)
{
    bool met;
    *pending = (tn_frontier_pending){0, 1};
    if (frontier->scouting || slice == TN_FRONTIER_NONE)
        return TN_OK;
    uint32_t *result, bases = frontier->slices.items[slice].tiles;
    tn_status status = tn_frontier_known_at(&frontier->tiles.pending_of, bases, right_fits, 3, &result, &met, error);
    if (status == TN_OK && !met) {
        status = list_pending(frontier, bases, right_fits, pending, error);
        memcpy(result, (const uint32_t[]){pending->number, tn_low(pending->times), tn_high(pending->times)},
               3 * sizeof *result);
    }
    if (status == TN_OK)
        *pending = (tn_frontier_pending){result[0], tn_both(result + 1)};
    return status;
}

/* ---- states */

/* Do states hold totals of what clauses compare? */
static bool counts_totals(const tn_frontier *frontier)
{
    return tn_frontier_compares(frontier) && frontier->units && !frontier->compared.looking_ahead;
}

static tn_status make_state(const tn_stepping *s, uint32_t read, uint32_t total, uint32_t *after, tn_error *error)
{
    tn_frontier *frontier = s->frontier;
    tn_key *key = &frontier->joined;
    uint32_t edge = frontier->slices.items[s->slice].exit;
    key->size = 0;
    bool ok = tn_key_push(key, frontier->merged.edges ? frontier->merged.edges[edge] : edge);
    for (uint32_t w = 0; ok && w <= frontier->questions.walk_count; w++)
        ok = tn_key_push(key, s->crossed[CROSSED_ROOMS + w]);
    ok = ok && tn_key_push(key, read) && tn_key_push(key, s->pending.number);
    if (counts_totals(frontier))
        ok = ok && tn_key_push(key, total);
    *after = ok ? tn_intern(&frontier->states, key->data, key->size) : UINT32_MAX;
    return *after != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* What the step adds to a number, but for costs: the right slice's cells, and the rooms that end at the interface. */
static int64_t others_of(const tn_stepping *s, uint32_t number)
{
    const tn_house_weights *w = s->frontier->added->of[number];
    const uint32_t *closed = s->crossed + CROSSED_WALKS + s->frontier->questions.walk_count;
    int64_t gain = s->slice != TN_FRONTIER_NONE ? s->frontier->slices.items[s->slice].gains[number] : 0;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->terms[i].kind == TN_HOUSE_ROOMS)
            gain += (int64_t)closed[s->frontier->compared.weighed_rooms[number][i]] * w->terms[i].each;
    return gain;
}

/* What the step costs, in steps: the right slice and the interface. */
static tn_int128 cost_of(const tn_stepping *s)
{
    const tn_frontier *frontier = s->frontier;
    if (!frontier->prices.asked)
        return 0;
    tn_int128 cost = frontier->prices.steps[s->outcome->cost];
    if (s->slice != TN_FRONTIER_NONE)
        cost += frontier->prices.steps[frontier->slices.items[s->slice].cost];
    return cost;
}

static tn_house_gain gain_of(const tn_stepping *s)
{
    const tn_frontier_units *units = s->frontier->units;
    tn_house_gain gain = {{0}};
    tn_int128 cost = units ? cost_of(s) : 0;
    for (uint32_t k = 0; units && k < s->frontier->added->measures; k++) {
        tn_int128 value = others_of(s, k) * units->others[k] + cost * units->costs[k];
        gain.by[k] = s->frontier->measures->most[k] ? -value : value;
    }
    return gain;
}

/* ---- steps */

typedef struct tn_showing {
    tn_frontier_seen *seen;
    void *context;
    uint64_t faced;
    tn_house_gain gain; /* without tiles */
} tn_showing;

static tn_status too_many_choices(const tn_frontier *frontier, tn_error *error)
{
    return tn_frontier_limit(frontier, NULL, "a tray has more than 2^64 choices", error);
}

/* Shows what the step leads to with a sum of the tiles. */
static tn_status show_sum(const tn_stepping *s, const tn_showing *to, uint32_t after, size_t i, tn_error *error)
{
    const tn_frontier_sum *tiles = &s->frontier->sums.found[i];
    const tn_frontier_units *units = s->frontier->units;
    tn_house_gain sum = to->gain;
    uint64_t times;
    if (__builtin_mul_overflow(tiles->times, to->faced, &times) ||
        __builtin_mul_overflow(times, s->pending.times, &times))
        return too_many_choices(s->frontier, error);
    if (s->keeping) {
        const tn_frontier_way way = {(uint32_t)(s->outcome - s->frontier->outcomes.items), after, to->faced,
                                     times / to->faced};
        return tn_frontier_ways_add(s->frontier, &way, error);
    }
    for (uint32_t k = 0; units && k < s->frontier->added->measures; k++)
        sum.by[k] += tiles->cost * units->costs[k] * (s->frontier->measures->most[k] ? -1 : 1);
    return to->seen(to->context, after, times, i == 0 ? to->faced : 0, &sum, error);
}

static tn_status show(const tn_stepping *s, const tn_showing *to, uint32_t after, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < s->frontier->sums.found_count; i++)
        status = show_sum(s, to, after, i, error);
    return status;
}

/* ---- if clauses compare, each sum of the tiles has totals of its own */

static tn_status total_after(const tn_stepping *s, uint32_t before, tn_int128 tiles, uint32_t *total, tn_error *error)
{
    tn_frontier *frontier = s->frontier;
    tn_int128 gains[TN_COMPARED_MAX], cost = cost_of(s) + tiles;
    for (uint32_t k = frontier->added->measures; k < frontier->added->count; k++)
        gains[k - frontier->added->measures] =
            others_of(s, k) * frontier->units->others[k] + cost * frontier->units->costs[k];
    uint32_t trays = s->slice == TN_FRONTIER_NONE ? frontier->trays_most + 1 : s->trays + 1;
    return tn_frontier_next_total(frontier, trays, before, gains, total, error);
}

/* The sums of the tiles are by what they cost. */
static void note_ahead(const tn_stepping *s)
{
    tn_frontier *frontier = s->frontier;
    const tn_frontier_sum *sums = frontier->sums.found;
    for (uint32_t k = frontier->added->measures; k < frontier->added->count; k++) {
        tn_int128 each = frontier->units->costs[k],
                  gain = others_of(s, k) * frontier->units->others[k] + cost_of(s) * each,
                  least = gain + sums[0].cost * each, most = gain + sums[frontier->sums.found_count - 1].cost * each;
        tn_frontier_ahead_note(frontier, s->trays, s->slice == TN_FRONTIER_NONE, k - frontier->added->measures,
                               least < most ? least : most, least < most ? most : least);
    }
}

static tn_status try_total(const tn_stepping *s, const tn_showing *to, uint32_t between, uint32_t before, size_t i,
                           tn_error *error)
{
    tn_frontier *frontier = s->frontier;
    uint32_t total = 0, values = s->crossed[CROSSED_VALUES], read = TN_FRONTIER_NONE, after = 0;
    tn_status status = total_after(s, before, frontier->sums.found[i].cost, &total, error);
    if (status == TN_OK && s->slice == TN_FRONTIER_NONE)
        status = tn_frontier_end_values(frontier, values, total, 0, &values, error);
    if (status == TN_OK)
        status = tn_frontier_read_interface(frontier, s->trays, between, values, &read, error);
    if (status != TN_OK || read == TN_FRONTIER_NONE)
        return status;
    if (s->slice != TN_FRONTIER_NONE)
        status = make_state(s, read, total, &after, error);
    return status == TN_OK ? show_sum(s, to, after, i, error) : status;
}

static tn_status try_totals(const tn_stepping *s, const tn_showing *to, uint32_t between, tn_error *error)
{
    uint32_t before = 0;
    tn_status status = TN_OK;
    if (s->state)
        before = s->state[tn_frontier_pending_word(s->frontier) + 1];
    else
        status = tn_frontier_first_total(s->frontier, &before, error);
    for (size_t i = 0; status == TN_OK && i < s->frontier->sums.found_count; i++)
        status = try_total(s, to, between, before, i, error);
    return status;
}

/* While totals are not counted, the row may end if the clauses keep it for some outcome of the comparisons. */
static tn_status guess_end(const tn_stepping *s, uint32_t between, uint32_t *read, tn_error *error)
{
    tn_status status = TN_OK;
    *read = TN_FRONTIER_NONE;
    for (uint32_t guess = 0; status == TN_OK && *read == TN_FRONTIER_NONE && guess < tn_frontier_guesses(s->frontier);
         guess++) {
        uint32_t values;
        status = tn_frontier_end_values(s->frontier, s->crossed[CROSSED_VALUES], 0, guess, &values, error);
        if (status == TN_OK)
            status = tn_frontier_read_interface(s->frontier, s->trays, between, values, read, error);
    }
    return status;
}

/* One outcome of the interface. between: what the clauses have read of the slice. */
static tn_status try_outcome(tn_stepping *s, const tn_frontier_choice *choice, uint32_t between, tn_frontier_seen *seen,
                             void *context, tn_error *error)
{
    tn_frontier *frontier = s->frontier;
    uint32_t after = 0, read;
    s->outcome = &frontier->outcomes.items[choice->slice];
    tn_status status = count_tiles(s, error);
    if (status != TN_OK || frontier->sums.found_count == 0)
        return status;
    const tn_showing to = {seen, context, choice->times, gain_of(s)};
    if (counts_totals(frontier)) {
        status = tn_frontier_find_pending(frontier, s->slice, s->outcome->right_fits, &s->pending, error);
        return status == TN_OK && s->pending.number != TN_FRONTIER_NONE ? try_totals(s, &to, between, error) : status;
    }
    bool guesses = tn_frontier_compares(frontier) && s->slice == TN_FRONTIER_NONE;
    status = guesses
                 ? guess_end(s, between, &read, error)
                 : tn_frontier_read_interface(frontier, s->trays, between, s->crossed[CROSSED_VALUES], &read, error);
    if (status == TN_OK && read != TN_FRONTIER_NONE)
        status = tn_frontier_find_pending(frontier, s->slice, s->outcome->right_fits, &s->pending, error);
    if (status != TN_OK || read == TN_FRONTIER_NONE || s->pending.number == TN_FRONTIER_NONE)
        return status;
    if (s->slice != TN_FRONTIER_NONE)
        status = make_state(s, read, 0, &after, error);
    if (status != TN_OK)
        return status;
    if (frontier->compared.looking_ahead)
        note_ahead(s);
    return show(s, &to, after, error);
}

static bool keeps_no_trays(const tn_frontier *frontier)
{
    for (uint32_t i = 0; i < frontier->clause_count; i++)
        if (!frontier->clauses[i].dfa->accept[0])
            return false;
    return true;
}

/* The words may move when states are made. */
static const uint32_t *words_of(const tn_frontier *frontier, uint32_t state)
{
    size_t size;
    return state == TN_FRONTIER_NONE ? NULL : tn_interned(&frontier->states, state, &size);
}

static int compare_choices(const void *a, const void *b)
{
    const tn_frontier_choice *p = a, *q = b;
    return (p->slice > q->slice) - (p->slice < q->slice);
}

/* One of the outcomes that are looked at, in order; NULL: of all. */
static const tn_frontier_choice *choice_of(const tn_frontier_choice *choice, const tn_frontier_list *only)
{
    return only ? bsearch(choice, only->items, only->count, sizeof *choice, compare_choices) : choice;
}

/* seen: NULL if the ways are kept. */
static tn_status go(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice, const tn_frontier_list *only,
                    tn_frontier_seen *seen, void *context, tn_error *error)
{
    tn_frontier_list interface = {0};
    tn_stepping s = {.frontier = frontier,
                     .trays = trays,
                     .slice = slice,
                     .state = words_of(frontier, state),
                     .keeping = seen == NULL};
    uint32_t between, read = s.state ? s.state[tn_frontier_pending_word(frontier) - 1] : TN_FRONTIER_NONE;
    tn_status status = tn_frontier_read_slice(frontier, trays, read, slice, &between, error);
    if (status != TN_OK || between == TN_FRONTIER_NONE)
        return status;
    status = tn_frontier_cross(frontier, s.state, slice, &interface, &s.crossed, error);
    for (size_t i = 0; status == TN_OK && i < interface.count; i++, s.crossed += tn_frontier_crossed_words(frontier)) {
        const tn_frontier_choice *choice = choice_of(&interface.items[i], only);
        s.state = words_of(frontier, state);
        if (choice)
            status = try_outcome(&s, choice, between, seen, context, error);
    }
    return status;
}

/* ---- steps that are kept */

static tn_status keep(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice, tn_error *error)
{
    tn_status status = go(frontier, trays, state, slice, NULL, NULL, NULL, error);
    if (status == TN_OK)
        return tn_frontier_ways_end(frontier, trays, state, slice, error);
    tn_frontier_ways_drop(frontier);
    return status;
}

/* Shows the ways of a step over the outcomes that are looked at; both are by outcome. What sees them may keep other
 * steps. */
static tn_status show_kept(const tn_frontier *frontier, tn_frontier_ways_of_step ways, const tn_frontier_list *only,
                           tn_frontier_seen *seen, void *context, tn_error *error)
{
    const tn_house_gain none = {{0}};
    tn_status status = TN_OK;
    for (size_t i = 0, at = 0; status == TN_OK && i < ways.count; i++) {
        const tn_frontier_way way = frontier->ways.items[ways.first + i];
        uint64_t choices = way.choices, times;
        while (only && at < only->count && only->items[at].slice < way.outcome)
            at++;
        if (only && (at == only->count || only->items[at].slice != way.outcome))
            continue;
        choices = only ? only->items[at].times : choices;
        if (__builtin_mul_overflow(choices, way.tiles, &times))
            return too_many_choices(frontier, error);
        status = seen(context, way.after, times, choices, &none, error);
    }
    return status;
}

static tn_status step(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice,
                      const tn_frontier_list *only, tn_frontier_seen *seen, void *context, tn_error *error)
{
    if (state == TN_FRONTIER_NONE && slice == TN_FRONTIER_NONE) /* a row without trays */
        return keeps_no_trays(frontier) ? seen(context, 0, 1, 1, &(tn_house_gain){{0}}, error) : TN_OK;
    const tn_frontier_ways_of_step *kept = tn_frontier_ways_find(frontier, trays, state, slice);
    tn_status status = TN_OK;
    if (!kept && tn_frontier_ways_begin(frontier)) {
        status = keep(frontier, trays, state, slice, error);
        kept = tn_frontier_ways_find(frontier, trays, state, slice);
    }
    if (status != TN_OK)
        return status;
    return kept ? show_kept(frontier, *kept, only, seen, context, error)
                : go(frontier, trays, state, slice, only, seen, context, error);
}

tn_status tn_frontier_step(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice,
                           tn_frontier_seen *seen, void *context, tn_error *error)
{
    return step(frontier, trays, state, slice, NULL, seen, context, error);
}

tn_status tn_frontier_step_by(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice,
                              const tn_frontier_list *interface, tn_frontier_seen *seen, void *context, tn_error *error)
{
    return step(frontier, trays, state, slice, interface, seen, context, error);
}

static tn_status see_end(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                         tn_error *error)
{
    (void)state;
    (void)times;
    (void)faced;
    (void)gain;
    (void)error;
    *(bool *)context = true;
    return TN_OK;
}

tn_status tn_frontier_ends(tn_frontier *frontier, uint32_t trays, uint32_t state, bool *ends, tn_error *error)
{
    enum { UNKNOWN, NO, YES };
    size_t before = frontier->end_room;
    *ends = false;
    if (!tn_array_reserve(&frontier->ends, &frontier->end_room, state, 1, sizeof *frontier->ends))
        return tn_fail_memory(error);
    memset(frontier->ends + before, UNKNOWN, frontier->end_room - before);
    tn_status status = TN_OK;
    if (frontier->ends[state] == UNKNOWN) {
        status = tn_frontier_step(frontier, trays, state, TN_FRONTIER_NONE, see_end, ends, error);
        frontier->ends[state] = status != TN_OK ? UNKNOWN : *ends ? YES : NO;
    }
    *ends = frontier->ends[state] == YES;
    return status;
}
