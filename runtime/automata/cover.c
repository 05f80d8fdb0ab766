/* Merges states that short words do not tell apart.
 *
 * Two states, reached by words of l and m letters at least, are similar if what at most longest - max(l, m) letters
 * lead to from them is accepted alike. A state may be replaced by a similar one that fewer letters, or as many, lead
 * to: what a word of n letters leads to is then reached by n letters or fewer, and agrees about all that may come. For
 * each number of letters to come there are classes of states, as in Moore's way of minimising; so a state is replaced
 * by the first one of its class for as many letters as may come behind it. */
#include "runtime/automata/dfa.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

/* ---- how far states are away */

static uint32_t marker_column(const tn_bounds *bounds, const uint32_t *column, uint32_t letters)
{
    return letters > bounds->letters ? column[letters - 1] : TN_NO_STATE;
}

bool tn_depth_begin(tn_depth *depth, const tn_bounds *bounds, const uint32_t *column, uint32_t letters)
{
    *depth = (tn_depth){.longest = bounds->longest, .marker = marker_column(bounds, column, letters)};
    return depth->longest == 0 || tn_depth_add(depth, 0);
}

bool tn_depth_add(tn_depth *depth, uint32_t letters)
{
    if (!tn_array_reserve(&depth->letters, &depth->capacity, depth->count, 1, sizeof *depth->letters))
        return false;
    depth->letters[depth->count++] = letters;
    return true;
}

void tn_depth_clear(tn_depth *depth)
{
    free(depth->letters);
    *depth = (tn_depth){0};
}

/* ---- merging */

typedef struct tn_merging {
    const tn_dfa *dfa; /* minimal */
    tn_bounds *bounds;
    uint32_t longest, marker, dead;
    uint32_t *order;  /* [reached]: states by the letters that lead there */
    uint32_t *level;  /* [states]: these letters; TN_NO_STATE: no short word leads there */
    uint8_t *phase;   /* [states]: the markers that lead there */
    uint32_t *merged; /* [states]: the state to be taken for each */
    uint32_t reached;
    uint32_t *classes; /* [depths][states]: of states, by what they accept of so many letters; 0: nothing */
    uint32_t depths;   /* from the last one on, more letters tell no more apart */
    size_t capacity;   /* of classes, in depths */
    uint32_t *first;   /* [depths][states + 1]: the state to be taken for a class, or TN_NO_STATE */
} tn_merging;

static uint32_t step(const tn_merging *covering, uint32_t state, uint32_t column)
{
    return covering->dfa->delta[(size_t)state * covering->dfa->columns + column];
}

static void reach(tn_merging *covering, uint32_t from, uint32_t column)
{
    uint32_t to = step(covering, from, column);
    if (covering->level[to] != TN_NO_STATE)
        return;
    covering->level[to] = covering->level[from] + (column != covering->marker);
    covering->phase[to] = (uint8_t)(covering->phase[from] + (column == covering->marker));
    covering->order[covering->reached++] = to;
}

/* Orders states by the letters of the shortest words that lead there: of as many letters, those that a marker leads to
 * follow at once. */
static void find_levels(tn_merging *covering)
{
    memset(covering->level, 0xff, covering->dfa->states * sizeof *covering->level);
    covering->level[0] = 0;
    covering->order[covering->reached++] = 0;
    for (uint32_t begin = 0; begin < covering->reached;) {
        for (uint32_t i = begin; covering->marker != TN_NO_STATE && i < covering->reached; i++)
            reach(covering, covering->order[i], covering->marker);
        uint32_t end = covering->reached;
        for (uint32_t i = begin; i < end && covering->level[covering->order[i]] < covering->longest; i++)
            for (uint32_t c = 0; c < covering->dfa->columns; c++)
                reach(covering, covering->order[i], c);
        begin = end;
    }
}

/* The state's class for `depth` letters, which those for one letter less and of the states behind its marker are known
 * for. Class 0 is that of nothing. */
static bool find_class(tn_merging *covering, uint32_t depth, uint32_t state, tn_interner *interner, tn_key *key)
{
    uint32_t n = covering->dfa->states, *now = covering->classes + (size_t)depth * n;
    key->size = 0;
    bool ok = tn_key_push(key, covering->dfa->accept[state]), nothing = !covering->dfa->accept[state];
    for (uint32_t c = 0; ok && c < covering->dfa->columns; c++) {
        uint32_t to = step(covering, state, c), class = 0;
        if (c == covering->marker && to != covering->dead)
            class = now[to];
        else if (c != covering->marker && depth > 0)
            class = covering->classes[(size_t)(depth - 1) * n + to];
        nothing = nothing && class == 0;
        ok = tn_key_push(key, class);
    }
    if (!ok || nothing)
        return ok;
    uint32_t number = tn_intern(interner, key->data, key->size);
    now[state] = number + 1;
    return number != UINT32_MAX;
}

/* The classes for `depth` letters; *count: how many. */
static bool find_classes(tn_merging *covering, uint32_t depth, uint32_t *count)
{
    enum { PHASES = 3 };
    tn_interner interner = {0};
    tn_key key = {0};
    size_t row = covering->dfa->states * sizeof *covering->classes;
    bool ok = tn_array_reserve_from(&covering->classes, &covering->capacity, 4, depth, 1, row);
    if (ok)
        memset(covering->classes + (size_t)depth * covering->dfa->states, 0, row);
    for (unsigned phase = PHASES; ok && phase-- > 0;)
        for (uint32_t i = 0; ok && i < covering->reached; i++)
            if (covering->phase[covering->order[i]] == phase)
                ok = find_class(covering, depth, covering->order[i], &interner, &key);
    *count = interner.count;
    tn_interner_clear(&interner);
    free(key.data);
    return ok;
}

/* Goes on until more letters tell no more states apart, or no word has more; *fits: is there room for that? */
static tn_status classify(tn_merging *covering, bool *fits, tn_error *error)
{
    const tn_dfa *dfa = covering->dfa;
    uint32_t before = UINT32_MAX, count = 0;
    *fits = true;
    for (uint32_t depth = 0; *fits && count != before && depth <= covering->longest; depth++) {
        before = depth > 0 ? count : UINT32_MAX;
        if (!find_classes(covering, depth, &count))
            return tn_fail_memory(error);
        covering->depths = depth + 1;
        *fits = (uint64_t)covering->depths * dfa->states <= covering->bounds->max_words / 2;
        tn_status status =
            tn_bounds_check(covering->bounds, "rule", 1, 1, (uint64_t)dfa->states * (dfa->columns + 1), error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* The row of classes that tells apart what may come behind a state. */
static uint32_t depth_behind(const tn_merging *covering, uint32_t state)
{
    uint32_t left = covering->longest - covering->level[state];
    return left < covering->depths ? left : covering->depths - 1;
}

/* Takes for each state the first one of its class. */
static void merge(tn_merging *covering)
{
    size_t n = covering->dfa->states;
    uint32_t nowhere = covering->dead != TN_NO_STATE ? covering->dead : 0;
    memset(covering->first, 0xff, covering->depths * (n + 1) * sizeof *covering->first);
    for (uint32_t d = 0; d < covering->depths; d++)
        covering->first[d * (n + 1)] = covering->dead;
    for (uint32_t s = 0; s < n; s++)
        covering->merged[s] = nowhere;
    for (uint32_t i = 0; i < covering->reached; i++) {
        uint32_t s = covering->order[i], behind = depth_behind(covering, s);
        uint32_t *first = &covering->first[behind * (n + 1) + covering->classes[behind * n + s]];
        if (s == covering->dead || *first != TN_NO_STATE) {
            covering->merged[s] = s == covering->dead ? s : *first;
            continue;
        }
        covering->merged[s] = s;
        for (uint32_t d = 0; d <= behind; d++) {
            first = &covering->first[d * (n + 1) + covering->classes[d * n + s]];
            *first = *first == TN_NO_STATE ? s : *first;
        }
    }
}

static tn_status write_merged(const tn_merging *covering, tn_dfa **out, tn_error *error)
{
    const tn_dfa *dfa = covering->dfa;
    tn_dfa *made = tn_dfa_new(dfa->letters, dfa->columns, dfa->states);
    if (!made)
        return tn_fail_memory(error);
    memcpy(made->column, dfa->column, dfa->letters * sizeof *made->column);
    memcpy(made->accept, dfa->accept, dfa->states);
    for (size_t i = 0; i < (size_t)dfa->states * dfa->columns; i++)
        made->delta[i] = covering->merged[dfa->delta[i]];
    tn_status status = tn_dfa_minimise(made, covering->merged[0], out, error);
    tn_dfa_free(made);
    return status;
}

static tn_status merge_similar(tn_merging *covering, tn_dfa **out, tn_error *error)
{
    size_t n = covering->dfa->states;
    bool fits = false;
    uint32_t *room = malloc(3 * (n + 1) * sizeof *room);
    covering->order = room;
    covering->phase = calloc(n + 1, 1);
    if (!room || !covering->phase) {
        free(room);
        return tn_fail_memory(error);
    }
    covering->level = room + n;
    covering->merged = room + 2 * n;
    find_levels(covering);
    tn_status status = classify(covering, &fits, error);
    if (status == TN_OK && fits && !(covering->first = malloc(covering->depths * (n + 1) * sizeof *covering->first)))
        status = tn_fail_memory(error);
    if (status == TN_OK && fits) {
        merge(covering);
        status = write_merged(covering, out, error);
    }
    free(room);
    free(covering->phase);
    free(covering->classes);
    free(covering->first);
    return status;
}

tn_status tn_cover_minimise(const tn_dfa *dfa, tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    tn_dfa *minimal = NULL, *merged = NULL;
    tn_status status = tn_dfa_minimise(dfa, 0, &minimal, error);
    if (status == TN_OK && bounds->longest > 0) {
        tn_merging covering = {.dfa = minimal, .bounds = bounds, .longest = bounds->longest};
        covering.marker = marker_column(bounds, minimal->column, minimal->letters);
        covering.dead = tn_dfa_sink(minimal, 0);
        status = merge_similar(&covering, &merged, error);
    }
    if (status == TN_OK)
        *out = merged ? merged : tn_dfa_share(minimal);
    tn_dfa_free(minimal);
    return status;
}
