/* What comes of rooms and walks at a plane, and what the plane is to the clauses: each combination is worked out once.
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
    const uint32_t *behind; /* its words, where what comes of views is asked for (outlook.c), or NULL */
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
