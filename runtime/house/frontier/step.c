/* From a state to those after one more slice.
 *
 * ==== crossing a plane
 *
 * What comes of rooms and walks at a plane, and what the plane is to the clauses: each combination is worked out once.
 *
 * Rooms and walks know of an edge only what is asked of its cells, so they cross all edges that are asked alike at
 * once. States that have an edge, rooms and walks in common cross each plane alike. What came of it is kept as long as
 * such states follow one another. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"
#include "runtime/house/frontier/placed.h"

/* What is behind is known by the slice, what is between by the outcome. */
typedef struct tn_passing {
    tn_strip *strip;
    const uint32_t *state;  /* words, or NULL */
    const uint32_t *behind; /* its words, where what comes of views is asked for (stage.c), or NULL */
    uint32_t move, met;     /* met: what views of walks meet; rooms: sides, too */
    uint32_t sided;
    tn_strip_crossing crossing;
    uint32_t *crossed;                                              /* words, to be filled in */
    const uint32_t *seen_rooms, *seen_walks[TN_STRIP_MEETINGS_MAX]; /* SEEN_WORDS of what is placed in the row */
} tn_passing;

void tn_strip_row_clear(tn_strip_row *row)
{
    free(row->before);
    free(row->mark);
    free(row->plane);
    free(row->first);
    free(row->words);
}

/* ---- rooms and walks */

/* What crosses a plane: what was before it, with what is asked of the edge there. word: its place in a state. */
static tn_status number_before(const tn_passing *p, size_t word, uint32_t *number, tn_error *error)
{
    *number = TN_STRIP_NONE;
    if (!p->state)
        return TN_OK;
    *number = p->behind ? p->behind[word]
                        : tn_number(&p->strip->befores, (uint64_t)p->crossing.left->asked << 32 | p->state[word]);
    return *number == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

/* closed: of the questions about rooms. */
static tn_status cross_rooms(tn_passing *p, uint32_t *rooms, uint32_t *closed, tn_error *error)
{
    tn_strip *strip = p->strip;
    tn_strip_known *known = p->behind ? &strip->stages.crossed_rooms : &strip->crossed_rooms;
    uint32_t questions = strip->questions.room_count, number, *result;
    size_t words = 1 + questions + SEEN_WORDS * (size_t)strip->questions.placed_count;
    bool met;
    *rooms = 0;
    if (questions == 0)
        return TN_OK;
    tn_status status = number_before(p, STATE_ROOMS, &number, error);
    if (status == TN_OK)
        status = tn_strip_known_at(known, number, p->behind ? p->sided : p->move, words, &result, &met, error);
    if (status == TN_OK && !met)
        status = tn_strip_rooms_cross(strip, p->state ? p->state[STATE_ROOMS] : 0, &p->crossing, &result[0], result + 1,
                                      error);
    if (status != TN_OK)
        return status;
    *rooms = result[0];
    memcpy(closed, result + 1, questions * sizeof *closed);
    p->seen_rooms = result + 1 + questions;
    return TN_OK;
}

static tn_status cross_walk(tn_passing *p, uint32_t walk, uint32_t *after, bool *apart, tn_error *error)
{
    tn_strip *strip = p->strip;
    tn_strip_known *known = p->behind ? &strip->stages.crossed_walks[walk] : &strip->crossed_walks[walk];
    uint32_t before = p->state ? p->state[STATE_WALKS + walk] : 0, number, *result;
    bool met;
    size_t words = 2 + (tn_strip_walk_placed(strip, walk) ? SEEN_WORDS : 0);
    tn_status status = number_before(p, STATE_WALKS + walk, &number, error);
    if (status == TN_OK)
        status = tn_strip_known_at(known, number, p->behind ? p->met : p->move, words, &result, &met, error);
    if (status == TN_OK && !met) {
        status = tn_strip_walk_cross(strip, walk, before, &p->crossing, &result[0], apart, result + 2, error);
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

static uint32_t seen_of(const tn_passing *p, const tn_strip_atom *atom)
{
    bool walk = atom->op.opcode == TN_OP_APART;
    return tn_strip_span_value(atom, walk ? p->seen_walks[atom->of] : p->seen_rooms + SEEN_WORDS * atom->place);
}

/* What the plane says of the atoms of a clause; UINT32_MAX: more than it tells apart. */
static uint32_t value_of(const tn_passing *p, const tn_strip_clause *clause, const uint32_t *closed, const bool *apart)
{
    uint32_t value = 0;
    for (size_t i = clause->atom_count; i-- > 0;) {
        const tn_strip_atom *atom = &clause->atoms[i];
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

static tn_status too_many_slots(const tn_strip *strip, uint32_t clause, tn_error *error)
{
    const tn_module *module = strip->form->module;
    const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[strip->library->clause_first + clause];
    tn_strip_limit(strip, tn_text(module, record->name),
                   "asks where more rooms or walks are than can be told apart at once", error);
    tn_error_help(error, "ask where cells are, as in `neighbour(cell(...), cell(...))`, or whether they meet, as in "
                         "`touch(cell(...), cell(...))`; or ask about one plan (--plan PLAN or '#P')");
    return TN_LIMIT;
}

static tn_status find_values(const tn_passing *p, const uint32_t *closed, const bool *apart, uint32_t *values,
                             tn_error *error)
{
    tn_strip *strip = p->strip;
    bool ok = true;
    *values = TN_STRIP_NONE;
    if (!p->state)
        return TN_OK;
    strip->key.size = 0;
    for (uint32_t i = 0; ok && i < strip->clause_count; i++) {
        const tn_strip_clause *clause = &strip->clauses[i];
        uint32_t value = clause->radix > 1 ? value_of(p, clause, closed, apart) : 0;
        if (value == UINT32_MAX)
            return too_many_slots(strip, i, error);
        ok = tn_key_push(&strip->key, value);
    }
    *values = ok ? tn_intern(&strip->values, strip->key.data, strip->key.size) : UINT32_MAX;
    return *values != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- a plane */

static tn_status cross_outcome(tn_passing *p, tn_error *error)
{
    tn_strip *strip = p->strip;
    uint32_t *walks = p->crossed + CROSSED_WALKS, *closed = walks + strip->questions.walk_count;
    bool apart[TN_STRIP_MEETINGS_MAX] = {false};
    tn_status status = cross_rooms(p, &p->crossed[CROSSED_ROOMS], closed, error);
    for (uint32_t w = 0; status == TN_OK && w < strip->questions.walk_count; w++)
        status = cross_walk(p, w, &walks[w], &apart[w], error);
    return status == TN_OK ? find_values(p, closed, apart, &p->crossed[CROSSED_VALUES], error) : status;
}

static tn_passing begin_passing(tn_strip *strip, const uint32_t *state, uint32_t slice)
{
    size_t size;
    bool last = slice == TN_STRIP_NONE;
    tn_passing p = {.strip = strip, .state = state};
    p.crossing = (tn_strip_crossing){.left = state ? &strip->edges[state[STATE_EDGE]] : NULL,
                                     .right = last ? NULL : &strip->edges[strip->slices[slice].entry],
                                     .slice = last ? NULL : tn_interned(&strip->slice_keys, slice, &size)};
    return p;
}

static tn_status pass(tn_passing *p, uint32_t slice, uint32_t outcome, tn_error *error)
{
    tn_strip *strip = p->strip;
    size_t size;
    p->crossing.outcome = tn_interned(&strip->outcome_keys, outcome, &size);
    p->move = tn_number(&strip->moves, (uint64_t)strip->outcomes[outcome].through << 32 |
                                           (slice == TN_STRIP_NONE ? slice : strip->slices[slice].met));
    return p->move == UINT32_MAX ? tn_fail_memory(error) : cross_outcome(p, error);
}

/* The same by what can be seen of the plane and of what is behind it. */
static tn_status pass_seen(tn_passing *p, uint32_t slice, uint32_t outcome, tn_error *error)
{
    tn_strip *strip = p->strip;
    size_t size;
    uint32_t sides = tn_interned(&strip->stages.rights, strip->outcomes[outcome].right, &size)[RIGHT_SIDES];
    p->crossing.outcome = tn_interned(&strip->outcome_keys, outcome, &size);
    p->met = strip->slices[slice].met;
    p->sided = tn_number(&strip->stages.sided, (uint64_t)sides << 32 | p->met);
    return p->sided == UINT32_MAX ? tn_fail_memory(error) : cross_outcome(p, error);
}

static tn_status cross_plane(tn_strip *strip, const uint32_t *state, uint32_t slice, const tn_strip_list *plane,
                             uint32_t *crossed, tn_error *error)
{
    tn_passing p = begin_passing(strip, state, slice);
    tn_status status = TN_OK;
    p.crossed = crossed;
    for (size_t i = 0; status == TN_OK && i < plane->count; i++, p.crossed += tn_strip_crossed_words(strip))
        status = pass(&p, slice, plane->items[i].slice, error);
    return status;
}

tn_status tn_strip_cross_outcome(tn_strip *strip, const uint32_t *state, uint32_t slice, uint32_t outcome,
                                 const uint32_t *behind, uint32_t *crossed, tn_error *error)
{
    tn_passing p = begin_passing(strip, state, slice);
    p.crossed = crossed;
    p.behind = behind;
    return pass_seen(&p, slice, outcome, error);
}

/* ---- planes that states with the same before them have crossed */

static tn_status begin_row(tn_strip *strip, const uint32_t *state, tn_error *error)
{
    tn_strip_row *row = &strip->row;
    size_t words = tn_strip_waiting_word(strip) - 1, moves = (size_t)strip->insides.count + 1;
    if (!row->mark) {
        row->before = malloc(words * sizeof *row->before);
        row->mark = calloc(moves, sizeof *row->mark);
        row->plane = malloc(moves * sizeof *row->plane);
        row->first = malloc(moves * sizeof *row->first);
        if (!row->before || !row->mark || !row->plane || !row->first)
            return tn_fail_memory(error);
    } else if (state ? memcmp(row->before, state, words * sizeof *state) == 0 : row->before[0] == TN_STRIP_NONE) {
        return TN_OK;
    }
    if (state)
        memcpy(row->before, state, words * sizeof *state);
    else
        row->before[0] = TN_STRIP_NONE;
    row->used = 0;
    row->stamp++;
    if (row->stamp == 0) { /* a mark of long ago must not look new */
        memset(row->mark, 0, moves * sizeof *row->mark);
        row->stamp = 1;
    }
    return TN_OK;
}

tn_status tn_strip_cross(tn_strip *strip, const uint32_t *state, uint32_t slice, tn_strip_list *plane,
                         const uint32_t **crossed, tn_error *error)
{
    tn_strip_row *row = &strip->row;
    tn_status status = begin_row(strip, state, error);
    if (status != TN_OK)
        return status;
    uint32_t at = slice == TN_STRIP_NONE ? strip->insides.count : strip->slices[slice].inside;
    if (row->mark[at] != row->stamp) {
        const tn_strip_list *list;
        status = tn_strip_plane(strip, state ? state[STATE_EDGE] : TN_STRIP_NONE,
                                slice == TN_STRIP_NONE ? slice : strip->slices[slice].entry, &list, error);
        if (status != TN_OK)
            return status;
        row->plane[at] = *list;
        row->first[at] = row->used;
        size_t words = list->count * tn_strip_crossed_words(strip);
        if (!tn_array_reserve(&row->words, &row->room, row->used, words + 1, sizeof *row->words))
            return tn_fail_memory(error);
        status = cross_plane(strip, state, slice, &row->plane[at], row->words + row->used, error);
        row->used += words;
        row->mark[at] = status == TN_OK ? row->stamp : 0;
    }
    *plane = row->plane[at];
    *crossed = row->words + row->first[at];
    return status;
}

/* ==== steps that are kept
 *
 * Keeps the ways that a step goes on, as ranks go the same steps again and again: by the state before and the
 * slice, with each outcome of the plane by itself, of which a caller may ask for some. */

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

/* ==== steps
 *
 * Goes from a state to those after one more slice. */

typedef struct tn_stepping {
    tn_strip *strip;
    const uint32_t *state; /* words; NULL: before the first slice */
    uint32_t slice;        /* TN_STRIP_NONE: after the last */
    uint32_t trays;        /* before the slice */
    const tn_strip_outcome *outcome;
    const uint32_t *crossed;  /* words: what came of rooms and walks at the outcome */
    tn_strip_waiting waiting; /* the same */
    bool keeping;             /* ways are not shown, but kept */
} tn_stepping;

/* ---- tiles */

/* The sums of the tiles of the slice before, which are known with the outcome. */
static tn_status count_tiles(const tn_stepping *s, tn_error *error)
{
    tn_strip *strip = s->strip;
    if (!s->state || strip->scouting)
        return tn_strip_sum_one(strip, 1, error);
    return tn_strip_sum_tiles(strip, s->state[tn_strip_waiting_word(strip)], s->outcome->left_fits, error);
}

static tn_status list_waiting(tn_strip *strip, uint32_t bases, uint32_t sides, tn_strip_waiting *waiting,
                              tn_error *error)
{
    size_t cells;
    tn_key *key = &strip->joined;
    const uint32_t *base = tn_interned(&strip->fit_lists, bases, &cells);
    const uint32_t *fits = tn_interned(&strip->fit_lists, sides, &cells);
    key->size = 0;
    *waiting = (tn_strip_waiting){TN_STRIP_NONE, 1};
    for (uint32_t i = 0; i < cells; i++) {
        tn_strip_wait wait;
        if (base[i] == 0)
            continue;
        tn_status status = tn_strip_waits(strip, base[i] - 1, fits[i] - 1, &wait, error);
        if (status != TN_OK || wait.class == TN_STRIP_NONE)
            return status;
        if (wait.ever && (!tn_key_push(key, i) || !tn_key_push(key, wait.class)))
            return tn_fail_memory(error);
        if (__builtin_mul_overflow(waiting->times, (uint64_t)wait.factor, &waiting->times))
            return tn_strip_limit(strip, NULL, "a tray has more than 2^64 arrangements of tiles", error);
    }
    waiting->number = tn_intern(&strip->waiting, key->data, key->size);
    return waiting->number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* The tiles of the row's last cells, where a row ends, wait for nothing. */
tn_status tn_strip_find_waiting(tn_strip *strip, uint32_t slice, uint32_t right_fits, tn_strip_waiting *waiting,
                                tn_error *error)
{
    bool met;
    *waiting = (tn_strip_waiting){0, 1};
    if (strip->scouting || slice == TN_STRIP_NONE)
        return TN_OK;
    uint32_t *result, bases = strip->slices[slice].tiles;
    tn_status status = tn_strip_known_at(&strip->waits, bases, right_fits, 3, &result, &met, error);
    if (status == TN_OK && !met) {
        status = list_waiting(strip, bases, right_fits, waiting, error);
        memcpy(result, (const uint32_t[]){waiting->number, tn_low(waiting->times), tn_high(waiting->times)},
               3 * sizeof *result);
    }
    if (status == TN_OK)
        *waiting = (tn_strip_waiting){result[0], tn_both(result + 1)};
    return status;
}

/* ---- states */

/* Have states totals of what clauses compare? */
static bool counts_totals(const tn_strip *strip)
{
    return tn_strip_compares(strip) && strip->units && !strip->looking_ahead;
}

static tn_status make_state(const tn_stepping *s, uint32_t read, uint32_t total, uint32_t *after, tn_error *error)
{
    tn_strip *strip = s->strip;
    tn_key *key = &strip->joined;
    uint32_t edge = strip->slices[s->slice].exit;
    key->size = 0;
    bool ok = tn_key_push(key, strip->merged.edges ? strip->merged.edges[edge] : edge);
    for (uint32_t w = 0; ok && w <= strip->questions.walk_count; w++)
        ok = tn_key_push(key, s->crossed[CROSSED_ROOMS + w]);
    ok = ok && tn_key_push(key, read) && tn_key_push(key, s->waiting.number);
    if (counts_totals(strip))
        ok = ok && tn_key_push(key, total);
    *after = ok ? tn_intern(&strip->states, key->data, key->size) : UINT32_MAX;
    return *after != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* What the step adds to a number, but for costs: the right slice's cells, and the rooms that end at the plane. */
static int64_t others_of(const tn_stepping *s, uint32_t number)
{
    const tn_house_weights *w = s->strip->added->of[number];
    const uint32_t *closed = s->crossed + CROSSED_WALKS + s->strip->questions.walk_count;
    int64_t gain = s->slice != TN_STRIP_NONE ? s->strip->slices[s->slice].gains[number] : 0;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->terms[i].kind == TN_HOUSE_ROOMS)
            gain += (int64_t)closed[s->strip->weighed_rooms[number][i]] * w->terms[i].each;
    return gain;
}

/* What the step costs, in steps: the right slice and the plane. */
static tn_int128 cost_of(const tn_stepping *s)
{
    const tn_strip *strip = s->strip;
    if (!strip->prices.asked)
        return 0;
    tn_int128 cost = strip->prices.steps[s->outcome->cost];
    if (s->slice != TN_STRIP_NONE)
        cost += strip->prices.steps[strip->slices[s->slice].cost];
    return cost;
}

static tn_house_gain gain_of(const tn_stepping *s)
{
    const tn_strip_units *units = s->strip->units;
    tn_house_gain gain = {{0}};
    tn_int128 cost = units ? cost_of(s) : 0;
    for (uint32_t k = 0; units && k < s->strip->added->measures; k++) {
        tn_int128 value = others_of(s, k) * units->others[k] + cost * units->costs[k];
        gain.by[k] = s->strip->measures->most[k] ? -value : value;
    }
    return gain;
}

/* ---- steps */

typedef struct tn_showing {
    tn_strip_seen *seen;
    void *context;
    uint64_t faced;
    tn_house_gain gain; /* without tiles */
} tn_showing;

static tn_status too_many_choices(const tn_strip *strip, tn_error *error)
{
    return tn_strip_limit(strip, NULL, "a tray has more than 2^64 choices", error);
}

/* Shows what the step leads to with a sum of the tiles. */
static tn_status show_sum(const tn_stepping *s, const tn_showing *to, uint32_t after, size_t i, tn_error *error)
{
    const tn_strip_sum *tiles = &s->strip->sums.found[i];
    const tn_strip_units *units = s->strip->units;
    tn_house_gain sum = to->gain;
    uint64_t times;
    if (__builtin_mul_overflow(tiles->times, to->faced, &times) ||
        __builtin_mul_overflow(times, s->waiting.times, &times))
        return too_many_choices(s->strip, error);
    if (s->keeping) {
        const tn_strip_way way = {(uint32_t)(s->outcome - s->strip->outcomes), after, to->faced, times / to->faced};
        return tn_strip_ways_add(s->strip, &way, error);
    }
    for (uint32_t k = 0; units && k < s->strip->added->measures; k++)
        sum.by[k] += tiles->cost * units->costs[k] * (s->strip->measures->most[k] ? -1 : 1);
    return to->seen(to->context, after, times, i == 0 ? to->faced : 0, &sum, error);
}

static tn_status show(const tn_stepping *s, const tn_showing *to, uint32_t after, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < s->strip->sums.found_count; i++)
        status = show_sum(s, to, after, i, error);
    return status;
}

/* ---- where clauses compare: each sum of the tiles has totals of its own */

static tn_status total_after(const tn_stepping *s, uint32_t before, tn_int128 tiles, uint32_t *total, tn_error *error)
{
    tn_strip *strip = s->strip;
    tn_int128 gains[TN_COMPARED_MAX], cost = cost_of(s) + tiles;
    for (uint32_t k = strip->added->measures; k < strip->added->count; k++)
        gains[k - strip->added->measures] = others_of(s, k) * strip->units->others[k] + cost * strip->units->costs[k];
    uint32_t trays = s->slice == TN_STRIP_NONE ? strip->trays_most + 1 : s->trays + 1;
    return tn_strip_next_total(strip, trays, before, gains, total, error);
}

/* The sums of the tiles are by what they cost. */
static void note_ahead(const tn_stepping *s)
{
    tn_strip *strip = s->strip;
    const tn_strip_sum *sums = strip->sums.found;
    for (uint32_t k = strip->added->measures; k < strip->added->count; k++) {
        tn_int128 each = strip->units->costs[k], gain = others_of(s, k) * strip->units->others[k] + cost_of(s) * each,
                  least = gain + sums[0].cost * each, most = gain + sums[strip->sums.found_count - 1].cost * each;
        tn_strip_ahead_note(strip, s->trays, s->slice == TN_STRIP_NONE, k - strip->added->measures,
                            least < most ? least : most, least < most ? most : least);
    }
}

static tn_status try_total(const tn_stepping *s, const tn_showing *to, uint32_t between, uint32_t before, size_t i,
                           tn_error *error)
{
    tn_strip *strip = s->strip;
    uint32_t total = 0, values = s->crossed[CROSSED_VALUES], read = TN_STRIP_NONE, after = 0;
    tn_status status = total_after(s, before, strip->sums.found[i].cost, &total, error);
    if (status == TN_OK && s->slice == TN_STRIP_NONE)
        status = tn_strip_end_values(strip, values, total, 0, &values, error);
    if (status == TN_OK)
        status = tn_strip_read_plane(strip, s->trays, between, values, &read, error);
    if (status != TN_OK || read == TN_STRIP_NONE)
        return status;
    if (s->slice != TN_STRIP_NONE)
        status = make_state(s, read, total, &after, error);
    return status == TN_OK ? show_sum(s, to, after, i, error) : status;
}

static tn_status try_totals(const tn_stepping *s, const tn_showing *to, uint32_t between, tn_error *error)
{
    uint32_t before = 0;
    tn_status status = TN_OK;
    if (s->state)
        before = s->state[tn_strip_waiting_word(s->strip) + 1];
    else
        status = tn_strip_first_total(s->strip, &before, error);
    for (size_t i = 0; status == TN_OK && i < s->strip->sums.found_count; i++)
        status = try_total(s, to, between, before, i, error);
    return status;
}

/* As long as totals are not counted, the row ends if the clauses keep it with anything that comparisons may say. */
static tn_status guess_end(const tn_stepping *s, uint32_t between, uint32_t *read, tn_error *error)
{
    tn_status status = TN_OK;
    *read = TN_STRIP_NONE;
    for (uint32_t guess = 0; status == TN_OK && *read == TN_STRIP_NONE && guess < tn_strip_guesses(s->strip); guess++) {
        uint32_t values;
        status = tn_strip_end_values(s->strip, s->crossed[CROSSED_VALUES], 0, guess, &values, error);
        if (status == TN_OK)
            status = tn_strip_read_plane(s->strip, s->trays, between, values, read, error);
    }
    return status;
}

/* One outcome of the plane. between: what the clauses have read of the slice. */
static tn_status try_outcome(tn_stepping *s, const tn_strip_choice *choice, uint32_t between, tn_strip_seen *seen,
                             void *context, tn_error *error)
{
    tn_strip *strip = s->strip;
    uint32_t after = 0, read;
    s->outcome = &strip->outcomes[choice->slice];
    tn_status status = count_tiles(s, error);
    if (status != TN_OK || strip->sums.found_count == 0)
        return status;
    const tn_showing to = {seen, context, choice->times, gain_of(s)};
    if (counts_totals(strip)) {
        status = tn_strip_find_waiting(strip, s->slice, s->outcome->right_fits, &s->waiting, error);
        return status == TN_OK && s->waiting.number != TN_STRIP_NONE ? try_totals(s, &to, between, error) : status;
    }
    bool guesses = tn_strip_compares(strip) && s->slice == TN_STRIP_NONE;
    status = guesses ? guess_end(s, between, &read, error)
                     : tn_strip_read_plane(strip, s->trays, between, s->crossed[CROSSED_VALUES], &read, error);
    if (status == TN_OK && read != TN_STRIP_NONE)
        status = tn_strip_find_waiting(strip, s->slice, s->outcome->right_fits, &s->waiting, error);
    if (status != TN_OK || read == TN_STRIP_NONE || s->waiting.number == TN_STRIP_NONE)
        return status;
    if (s->slice != TN_STRIP_NONE)
        status = make_state(s, read, 0, &after, error);
    if (status != TN_OK)
        return status;
    if (strip->looking_ahead)
        note_ahead(s);
    return show(s, &to, after, error);
}

static bool keeps_no_trays(const tn_strip *strip)
{
    for (uint32_t i = 0; i < strip->clause_count; i++)
        if (!strip->clauses[i].dfa->accept[0])
            return false;
    return true;
}

/* The words may move where states are made. */
static const uint32_t *words_of(const tn_strip *strip, uint32_t state)
{
    size_t size;
    return state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, state, &size);
}

static int compare_choices(const void *a, const void *b)
{
    const tn_strip_choice *p = a, *q = b;
    return (p->slice > q->slice) - (p->slice < q->slice);
}

/* One of the outcomes that are looked at, in order; NULL: of all. */
static const tn_strip_choice *choice_of(const tn_strip_choice *choice, const tn_strip_list *only)
{
    return only ? bsearch(choice, only->items, only->count, sizeof *choice, compare_choices) : choice;
}

/* seen: NULL where the ways are kept. */
static tn_status go(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, const tn_strip_list *only,
                    tn_strip_seen *seen, void *context, tn_error *error)
{
    tn_strip_list plane = {0};
    tn_stepping s = {
        .strip = strip, .trays = trays, .slice = slice, .state = words_of(strip, state), .keeping = seen == NULL};
    uint32_t between, read = s.state ? s.state[tn_strip_waiting_word(strip) - 1] : TN_STRIP_NONE;
    tn_status status = tn_strip_read_slice(strip, trays, read, slice, &between, error);
    if (status != TN_OK || between == TN_STRIP_NONE)
        return status;
    status = tn_strip_cross(strip, s.state, slice, &plane, &s.crossed, error);
    for (size_t i = 0; status == TN_OK && i < plane.count; i++, s.crossed += tn_strip_crossed_words(strip)) {
        const tn_strip_choice *choice = choice_of(&plane.items[i], only);
        s.state = words_of(strip, state);
        if (choice)
            status = try_outcome(&s, choice, between, seen, context, error);
    }
    return status;
}

/* ---- steps that are kept */

static tn_status keep(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, tn_error *error)
{
    tn_status status = go(strip, trays, state, slice, NULL, NULL, NULL, error);
    if (status == TN_OK)
        return tn_strip_ways_end(strip, trays, state, slice, error);
    tn_strip_ways_drop(strip);
    return status;
}

/* Shows the ways of a step over the outcomes that are looked at; both are by outcome. What sees them may keep other
 * steps. */
static tn_status show_kept(const tn_strip *strip, tn_strip_ways_of_step ways, const tn_strip_list *only,
                           tn_strip_seen *seen, void *context, tn_error *error)
{
    const tn_house_gain none = {{0}};
    tn_status status = TN_OK;
    for (size_t i = 0, at = 0; status == TN_OK && i < ways.count; i++) {
        const tn_strip_way way = strip->ways.items[ways.first + i];
        uint64_t choices = way.choices, times;
        while (only && at < only->count && only->items[at].slice < way.outcome)
            at++;
        if (only && (at == only->count || only->items[at].slice != way.outcome))
            continue;
        choices = only ? only->items[at].times : choices;
        if (__builtin_mul_overflow(choices, way.tiles, &times))
            return too_many_choices(strip, error);
        status = seen(context, way.after, times, choices, &none, error);
    }
    return status;
}

static tn_status step(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, const tn_strip_list *only,
                      tn_strip_seen *seen, void *context, tn_error *error)
{
    if (state == TN_STRIP_NONE && slice == TN_STRIP_NONE) /* a row without trays */
        return keeps_no_trays(strip) ? seen(context, 0, 1, 1, &(tn_house_gain){{0}}, error) : TN_OK;
    const tn_strip_ways_of_step *kept = tn_strip_ways_find(strip, trays, state, slice);
    tn_status status = TN_OK;
    if (!kept && tn_strip_ways_begin(strip)) {
        status = keep(strip, trays, state, slice, error);
        kept = tn_strip_ways_find(strip, trays, state, slice);
    }
    if (status != TN_OK)
        return status;
    return kept ? show_kept(strip, *kept, only, seen, context, error)
                : go(strip, trays, state, slice, only, seen, context, error);
}

tn_status tn_strip_step(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, tn_strip_seen *seen,
                        void *context, tn_error *error)
{
    return step(strip, trays, state, slice, NULL, seen, context, error);
}

tn_status tn_strip_step_by(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, const tn_strip_list *plane,
                           tn_strip_seen *seen, void *context, tn_error *error)
{
    return step(strip, trays, state, slice, plane, seen, context, error);
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

tn_status tn_strip_ends(tn_strip *strip, uint32_t trays, uint32_t state, bool *ends, tn_error *error)
{
    enum { UNKNOWN, NO, YES };
    size_t before = strip->end_room;
    *ends = false;
    if (!tn_array_reserve(&strip->ends, &strip->end_room, state, 1, sizeof *strip->ends))
        return tn_fail_memory(error);
    memset(strip->ends + before, UNKNOWN, strip->end_room - before);
    tn_status status = TN_OK;
    if (strip->ends[state] == UNKNOWN) {
        status = tn_strip_step(strip, trays, state, TN_STRIP_NONE, see_end, ends, error);
        strip->ends[state] = status != TN_OK ? UNKNOWN : *ends ? YES : NO;
    }
    *ends = strip->ends[state] == YES;
    return status;
}
