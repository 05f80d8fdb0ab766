/* Searches for the shortest word that some automata accept and others do not. */
#include "runtime/automata/search.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* How a tuple was first reached. */
typedef struct step {
    uint32_t from, letter, length;
} step;

/* A tuple is the number of letters read, counted up to `min`, and the state of each part. */
typedef struct explorer {
    const tn_search *search;
    tn_join join;
    uint32_t *lost; /* [count]: the state from which a part can never answer as wanted */
    uint32_t *next; /* [count + 1]: a tuple under construction */
    tn_interner tuples;
    step *steps; /* [tuples] */
    size_t room;
    tn_bounds bounds;
} explorer;

bool tn_dfa_accepts(const tn_dfa *dfa, const uint32_t *word, size_t length)
{
    uint32_t state = 0;
    for (size_t i = 0; i < length; i++)
        state = tn_dfa_read(dfa, state, word[i]);
    return dfa->accept[state];
}

static tn_status explorer_make(explorer *e, const tn_search *search, tn_error *error)
{
    *e = (explorer){.search = search, .bounds = tn_bounds_make(search->max_states)};
    e->bounds.max_work = search->max_work ? search->max_work : TN_SEARCH_WORK;
    e->bounds.watch = search->watch;
    tn_status status = tn_bounds_check(&e->bounds, search->what, 1, 1, 0, error);
    if (status != TN_OK)
        return status;
    const tn_dfa **parts = malloc(search->count * sizeof *parts);
    e->lost = malloc(search->count * sizeof *e->lost);
    e->next = calloc(search->count + 1, sizeof *e->next);
    if (!parts || !e->lost || !e->next) {
        free(parts);
        return tn_fail_memory(error);
    }
    for (size_t p = 0; p < search->count; p++) {
        parts[p] = search->parts[p].dfa;
        e->lost[p] = tn_dfa_sink(parts[p], !search->parts[p].accepts);
    }
    status = tn_join_make(&e->join, parts, (uint32_t)search->count, parts[0]->letters, NULL, false, error);
    free(parts);
    return status;
}

static void explorer_clear(explorer *e)
{
    tn_join_clear(&e->join);
    tn_interner_clear(&e->tuples);
    free(e->lost);
    free(e->next);
    free(e->steps);
}

/* Numbers the tuple in `next`; where it is new, notes how it was reached. */
static bool visit(explorer *e, step how, uint32_t *number)
{
    uint32_t before = e->tuples.count;
    *number = tn_intern(&e->tuples, e->next, e->search->count + 1);
    if (*number == UINT32_MAX)
        return false;
    if (e->tuples.count == before)
        return true;
    if (!tn_array_reserve_from(&e->steps, &e->room, 256, before, 1, sizeof *e->steps))
        return false;
    e->steps[before] = how;
    return true;
}

/* Fills `next` with what a column leads to; false where a part is lost there. */
static bool advance(explorer *e, const uint32_t *tuple, uint32_t column)
{
    const tn_search *search = e->search;
    const uint32_t *pick = e->join.pick + (size_t)column * e->join.parts;
    for (size_t p = 0; p < search->count; p++) {
        const tn_dfa *dfa = search->parts[p].dfa;
        uint32_t state = dfa->delta[(size_t)tuple[p + 1] * dfa->columns + pick[p]];
        if (state == e->lost[p])
            return false;
        e->next[p + 1] = state;
    }
    e->next[0] = tuple[0] < search->min ? tuple[0] + 1 : tuple[0];
    return true;
}

static bool is_goal(const explorer *e, uint32_t number)
{
    size_t size;
    const uint32_t *tuple = tn_interned(&e->tuples, number, &size);
    if (tuple[0] < e->search->min)
        return false;
    for (size_t p = 0; p < e->search->count; p++)
        if ((bool)e->search->parts[p].dfa->accept[tuple[p + 1]] != e->search->parts[p].accepts)
            return false;
    return true;
}

/* Follows a tuple's edges. *goal: the first new one that is a goal. */
static tn_status expand(explorer *e, uint32_t number, uint32_t *goal, tn_error *error)
{
    size_t size;
    for (uint32_t c = 0; c < e->join.columns && *goal == UINT32_MAX; c++) {
        const uint32_t *tuple = tn_interned(&e->tuples, number, &size); /* moves when tuples are added */
        uint32_t before = e->tuples.count, to;
        if (!advance(e, tuple, c))
            continue;
        if (!visit(e, (step){number, e->join.letter[c], e->steps[number].length + 1}, &to))
            return tn_fail_memory(error);
        if (e->tuples.count > before && is_goal(e, to))
            *goal = to;
    }
    uint64_t work = (uint64_t)e->join.columns * (e->search->count + 1);
    return tn_bounds_check(&e->bounds, e->search->what, e->tuples.count, 1, work, error);
}

static tn_status explore(explorer *e, uint32_t *goal, tn_error *error)
{
    for (size_t p = 0; p < e->search->count; p++)
        if (e->lost[p] == 0)
            return TN_OK;
    uint32_t start;
    if (!visit(e, (step){0}, &start))
        return tn_fail_memory(error);
    if (is_goal(e, start))
        *goal = start;
    for (uint32_t n = 0; n < e->tuples.count && *goal == UINT32_MAX; n++) {
        if (e->steps[n].length >= e->search->max)
            break; /* breadth first: nor has any later tuple room */
        tn_status status = expand(e, n, goal, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status read_back(const explorer *e, uint32_t goal, tn_key *word, tn_error *error)
{
    uint32_t length = e->steps[goal].length;
    word->data = malloc(((size_t)length + 1) * sizeof *word->data);
    if (!word->data)
        return tn_fail_memory(error);
    word->size = word->capacity = length;
    for (uint32_t at = goal, i = length; i-- > 0; at = e->steps[at].from)
        word->data[i] = e->steps[at].letter;
    return TN_OK;
}

tn_status tn_search_shortest(const tn_search *search, tn_key *word, bool *found, tn_error *error)
{
    explorer e;
    uint32_t goal = UINT32_MAX;
    *word = (tn_key){0};
    tn_status status = explorer_make(&e, search, error);
    if (status == TN_OK)
        status = explore(&e, &goal, error);
    *found = status == TN_OK && goal != UINT32_MAX;
    if (*found)
        status = read_back(&e, goal, word, error);
    explorer_clear(&e);
    return status;
}
