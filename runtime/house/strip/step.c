/* Goes from a state to those after one more slice. */
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/strip/parts.h"

/* Words of a state: edge, what waits for its right side, rooms, then each walk, each clause's state, each clause's base
 * (0 where nothing of its letter is known at the right side only). */
enum { STATE_EDGE, STATE_WAITING, STATE_ROOMS, STATE_WALKS };

typedef struct tn_stepping {
    tn_strip *strip;
    const uint32_t *state, *slice; /* NULL: before the first, after the last */
    uint32_t trays, slice_number, outcome_number; /* trays: before the slice */
    tn_strip_crossing crossing;
    uint32_t rooms, walks[TN_STRIP_MEETINGS_MAX];
    uint32_t closed[TN_STRIP_QUESTIONS_MAX];
    bool apart[TN_STRIP_MEETINGS_MAX];
} tn_stepping;

static const uint32_t *bases_of(const tn_stepping *s)
{
    const uint32_t *steps = s->slice + SLICE_CELLS + (size_t)CELL_WORDS * s->crossing.right->count;
    return steps + 1 + (size_t)STEP_WORDS * *steps;
}

/* The tiles of the left slice: *tiles := the product over its cells; 0 where one has none. */
static tn_status count_tiles(const tn_stepping *s, uint64_t *tiles, tn_error *error)
{
    size_t size;
    tn_status status = TN_OK;
    *tiles = 1;
    if (!s->state || s->strip->scouting)
        return TN_OK;
    const tn_strip_edge *left = s->crossing.left;
    const uint32_t *sides = s->crossing.outcome + 3 + (size_t)STEP_WORDS * s->crossing.outcome[2];
    const uint32_t *waiting = tn_interned(&s->strip->waiting, s->state[STATE_WAITING], &size);
    for (uint32_t i = 0; status == TN_OK && *tiles > 0 && i < left->count; i++) {
        uint32_t fit = 0;
        if (!left->cells[i].tiled)
            continue;
        uint64_t pair = s->strip->merged.one[*waiting++];
        status = tn_strip_fit(s->strip, tn_high(pair), tn_low(pair), sides[SIDE_WORDS * i + SIDE_FIT], &fit, error);
        if (status == TN_OK && __builtin_mul_overflow(*tiles, (uint64_t)fit, tiles))
            status = tn_strip_limit(s->strip, NULL, "a tray has more than 2^64 arrangements of tiles", error);
    }
    return status;
}

/* The number of what is crossed: {before, left edge, outcome, slice}; *met: it was crossed before. */
static uint32_t number_crossing(const tn_stepping *s, tn_strip_crossings *known, uint32_t before, bool *met)
{
    const uint32_t parts[] = {s->state ? s->state[STATE_EDGE] : TN_STRIP_NONE, s->outcome_number, s->slice_number};
    uint32_t at = before, count = known->keys[2].count;
    for (size_t i = 0; i < sizeof parts / sizeof *parts && at != UINT32_MAX; i++)
        at = tn_number(&known->keys[i], (uint64_t)at << 32 | parts[i]);
    *met = at < count;
    return at;
}

static tn_status cross_rooms(tn_stepping *s, tn_error *error)
{
    tn_strip_crossings *known = &s->strip->crossed_rooms;
    uint32_t questions = s->strip->questions.room_count, before = s->state ? s->state[STATE_ROOMS] : 0;
    size_t words = 1 + (size_t)questions;
    bool met;
    if (questions == 0)
        return TN_OK;
    uint32_t at = number_crossing(s, known, before, &met);
    if (at == UINT32_MAX || !tn_array_reserve(&known->results, &known->room, at * words, words, sizeof *known->results))
        return tn_fail_memory(error);
    uint32_t *result = &known->results[at * words];
    tn_status status =
        met ? TN_OK : tn_strip_rooms_cross(s->strip, before, &s->crossing, &result[0], result + 1, error);
    s->rooms = result[0];
    memcpy(s->closed, result + 1, questions * sizeof *s->closed);
    return status;
}

static tn_status cross_walk(tn_stepping *s, uint32_t walk, tn_error *error)
{
    tn_strip_crossings *known = &s->strip->crossed_walks[walk];
    uint32_t before = s->state ? s->state[STATE_WALKS + walk] : 0;
    bool met;
    uint32_t at = number_crossing(s, known, before, &met);
    if (at == UINT32_MAX || !tn_array_reserve(&known->results, &known->room, 2 * (size_t)at, 2, sizeof *known->results))
        return tn_fail_memory(error);
    uint32_t *result = &known->results[2 * (size_t)at];
    tn_status status = TN_OK;
    if (!met) {
        bool apart = false;
        status = tn_strip_walk_cross(s->strip, walk, before, &s->crossing, &result[0], &apart, error);
        result[1] = apart;
    }
    s->walks[walk] = result[0];
    s->apart[walk] = result[1];
    return status;
}

static tn_status cross(tn_stepping *s, tn_error *error)
{
    tn_status status = cross_rooms(s, error);
    for (uint32_t w = 0; status == TN_OK && w < s->strip->questions.walk_count; w++)
        status = cross_walk(s, w, error);
    return status;
}

/* What the plane says of the atoms of a clause. */
static uint32_t value_of(const tn_stepping *s, const tn_strip_clause *clause)
{
    uint32_t value = 0;
    for (size_t i = clause->atom_count; i-- > 0;) {
        const tn_strip_atom *atom = &clause->atoms[i];
        uint32_t of = atom->of, one = 0;
        if (atom->op.opcode == TN_OP_MEETS)
            one = tn_both(s->crossing.outcome) >> of & 1;
        else if (atom->op.opcode == TN_OP_APART)
            one = s->apart[of];
        else if (atom->op.opcode == TN_OP_SOME_ROOM)
            one = s->closed[of] > 0;
        else if (atom->op.opcode == TN_OP_ROOMS)
            one = s->closed[of];
        value = value * atom->radix + one;
    }
    return value;
}

/* A letter of a clause, after which it has read so many. Does the clause keep something then? */
static bool read_letter(const tn_stepping *s, const tn_strip_clause *clause, uint32_t letter, uint32_t letters,
                        uint32_t *state)
{
    *state = tn_dfa_read(clause->dfa, *state, letter);
    if (!s->slice)
        return clause->dfa->accept[*state];
    *state = clause->horizons[letters].alike[*state];
    return *state != TN_NO_STATE;
}

/* Reads the letters of the right slice, for the clauses that do not wait for its right side. Do all keep something? */
static bool read_right(const tn_stepping *s, uint32_t *states)
{
    const tn_strip *strip = s->strip;
    const uint32_t *before = s->state ? s->state + STATE_WALKS + strip->questions.walk_count : NULL;
    const uint32_t *bases = s->slice ? bases_of(s) : NULL;
    for (uint32_t i = 0; i < strip->clause_count; i++) {
        const tn_strip_clause *clause = &strip->clauses[i];
        states[i] = before ? before[i] : 0;
        if (clause->radix > 1)
            continue;
        if (bases ? !read_letter(s, clause, bases[i], s->trays + 1, &states[i]) : !clause->dfa->accept[states[i]])
            return false;
    }
    return true;
}

/* Reads the letters of the left slice, for the clauses that waited for the plane. */
static bool read_left(const tn_stepping *s, uint32_t *states)
{
    const tn_strip *strip = s->strip;
    const uint32_t *before = s->state ? s->state + STATE_WALKS + strip->questions.walk_count : NULL;
    for (uint32_t i = 0; before && i < strip->clause_count; i++) {
        const tn_strip_clause *clause = &strip->clauses[i];
        if (clause->radix == 1)
            continue;
        uint32_t letter = before[strip->clause_count + i] * clause->radix + value_of(s, clause);
        states[i] = before[i];
        if (!read_letter(s, clause, letter, s->trays, &states[i]))
            return false;
    }
    return true;
}

/* The cells of the right slice that have tiles, by which of them fit; TN_STRIP_NONE: a cell has none, whatever stands
 * at its right. */
static tn_status find_waiting(const tn_stepping *s, uint32_t *waiting, tn_error *error)
{
    tn_strip *strip = s->strip;
    tn_key *key = &strip->joined;
    const tn_strip_edge *right = s->crossing.right;
    const uint32_t *sides = s->crossing.outcome + 3 + (size_t)STEP_WORDS * s->crossing.outcome[2] +
                            (size_t)SIDE_WORDS * (s->crossing.left ? s->crossing.left->count : 0);
    tn_status status = TN_OK;
    key->size = 0;
    *waiting = 0;
    for (uint32_t i = 0; status == TN_OK && !strip->scouting && *waiting == 0 && i < right->count; i++) {
        uint32_t class;
        if (!right->cells[i].tiled)
            continue;
        status = tn_strip_waits(strip, s->slice[SLICE_CELLS + CELL_WORDS * i + CELL_TILE],
                                sides[SIDE_WORDS * i + SIDE_FIT], &class, error);
        if (status == TN_OK && class == TN_STRIP_NONE)
            *waiting = TN_STRIP_NONE;
        else if (status == TN_OK && !tn_key_push(key, class))
            status = tn_fail_memory(error);
    }
    if (status != TN_OK || *waiting == TN_STRIP_NONE)
        return status;
    *waiting = tn_intern(&strip->waiting, key->data, key->size);
    return *waiting != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* Merges what the clauses that wait for the right side of the slice cannot tell apart: states and bases are replaced.
 * *keeps: does each keep something? */
static tn_status merge_pairs(const tn_stepping *s, uint32_t *states, uint32_t *bases, bool *keeps, tn_error *error)
{
    tn_strip *strip = s->strip;
    tn_status status = TN_OK;
    *keeps = true;
    for (uint32_t i = 0; status == TN_OK && *keeps && i < strip->clause_count; i++) {
        uint64_t pair;
        bases[i] = 0;
        if (strip->clauses[i].radix == 1)
            continue;
        status = tn_strip_pair(strip, &strip->clauses[i], s->trays + 1, states[i], bases_of(s)[i], &pair, error);
        *keeps = pair != TN_STRIP_NO_PAIR;
        states[i] = tn_high(pair);
        bases[i] = tn_low(pair);
    }
    return status;
}

/* states: of the clauses, then room for their bases. *after: TN_STRIP_NONE where no house goes on from there. */
static tn_status make_state(const tn_stepping *s, uint32_t *states, uint32_t *after, tn_error *error)
{
    tn_strip *strip = s->strip;
    tn_key *key = &strip->joined;
    uint32_t waiting = 0, edge = s->slice[SLICE_EDGE], *bases = states + strip->clause_count;
    bool keeps;
    *after = TN_STRIP_NONE;
    tn_status status = merge_pairs(s, states, bases, &keeps, error);
    if (status != TN_OK || !keeps)
        return status;
    status = find_waiting(s, &waiting, error);
    if (status != TN_OK || waiting == TN_STRIP_NONE)
        return status;
    key->size = 0;
    bool ok = tn_key_push(key, strip->merged.edges ? strip->merged.edges[edge] : edge) && tn_key_push(key, waiting) &&
              tn_key_push(key, s->rooms);
    for (uint32_t w = 0; ok && w < strip->questions.walk_count; w++)
        ok = tn_key_push(key, s->walks[w]);
    for (uint32_t i = 0; ok && i < 2 * strip->clause_count; i++)
        ok = tn_key_push(key, states[i]);
    *after = ok ? tn_intern(&strip->states, key->data, key->size) : UINT32_MAX;
    return *after != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* What the step adds to a measure: the right slice's cells, and the rooms that end at the plane. */
static int64_t gain_by(const tn_stepping *s, uint32_t measure)
{
    const tn_house_weights *w = s->strip->measures->of[measure];
    int64_t gain = s->slice ? (int64_t)tn_both(bases_of(s) + s->strip->clause_count + 2 * (size_t)measure) : 0;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->terms[i].kind == TN_HOUSE_ROOMS)
            gain += (int64_t)s->closed[s->strip->weighed_rooms[measure][i]] * w->terms[i].each;
    return s->strip->measures->most[measure] ? -gain : gain;
}

static tn_house_gain gain_of(const tn_stepping *s)
{
    tn_house_gain gain = {{0}};
    for (uint32_t k = 0; s->strip->measures && k < s->strip->measures->count; k++)
        gain.by[k] = gain_by(s, k);
    return gain;
}

/* One outcome of the plane. */
static tn_status try_outcome(tn_stepping *s, const tn_strip_choice *choice, tn_strip_seen *seen, void *context,
                             tn_error *error)
{
    tn_strip *strip = s->strip;
    size_t size;
    uint64_t times, faced = choice->times;
    uint32_t after = 0;
    s->outcome_number = choice->slice;
    s->crossing.outcome = tn_interned(&strip->outcome_keys, choice->slice, &size);
    tn_status status = count_tiles(s, &times, error);
    if (status != TN_OK || times == 0)
        return status;
    if (__builtin_mul_overflow(times, choice->times, &times))
        return tn_strip_limit(strip, NULL, "a tray has more than 2^64 choices", error);
    status = cross(s, error);
    if (status != TN_OK)
        return status;
    if (!read_left(s, strip->scratch))
        return TN_OK;
    tn_house_gain gain = gain_of(s);
    if (s->slice)
        status = make_state(s, strip->scratch, &after, error);
    return status == TN_OK && after != TN_STRIP_NONE ? seen(context, after, times, faced, &gain, error) : status;
}

static bool keeps_no_trays(const tn_strip *strip)
{
    for (uint32_t i = 0; i < strip->clause_count; i++)
        if (!strip->clauses[i].dfa->accept[0])
            return false;
    return true;
}

static void look(tn_stepping *s, uint32_t state, uint32_t slice)
{
    tn_strip *strip = s->strip;
    size_t size;
    s->state = state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, state, &size);
    s->slice = slice == TN_STRIP_NONE ? NULL : tn_interned(&strip->slice_keys, slice, &size);
    s->slice_number = slice;
    s->crossing = (tn_strip_crossing){.left = s->state ? &strip->edges[s->state[STATE_EDGE]] : NULL,
                                      .right = s->slice ? &strip->edges[s->slice[SLICE_EDGE]] : NULL,
                                      .slice = s->slice};
}

tn_status tn_strip_step(tn_strip *strip, uint32_t trays, uint32_t state, uint32_t slice, tn_strip_seen *seen,
                        void *context, tn_error *error)
{
    const tn_strip_list *plane;
    tn_stepping s = {.strip = strip, .trays = trays};
    if (state == TN_STRIP_NONE && slice == TN_STRIP_NONE) /* a row without trays */
        return keeps_no_trays(strip) ? seen(context, 0, 1, 1, &(tn_house_gain){{0}}, error) : TN_OK;
    look(&s, state, slice);
    if (!read_right(&s, strip->scratch))
        return TN_OK;
    tn_status status = tn_strip_plane(strip, s.state ? s.state[STATE_EDGE] : TN_STRIP_NONE,
                                      s.slice ? s.slice[SLICE_EDGE] : TN_STRIP_NONE, &plane, error);
    tn_strip_list outcomes = status == TN_OK ? *plane : (tn_strip_list){0};
    for (size_t i = 0; status == TN_OK && i < outcomes.count; i++) {
        look(&s, state, slice); /* states are made while others are read: the words may move */
        status = try_outcome(&s, &outcomes.items[i], seen, context, error);
    }
    return status;
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
