/* Makes an automaton by exploring a construction's states from the start. */
#include "runtime/automata/explore.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

typedef struct tn_explorer {
    const tn_construction *construction;
    tn_interner keys;
    tn_key current, next;
    tn_depth depth;
    uint32_t *delta; /* [states][columns], grows */
    size_t capacity; /* rows */
} tn_explorer;

/* The state that a column leads to; UINT32_MAX: out of memory. */
static uint32_t explorer_step(tn_explorer *explorer, uint32_t state, uint32_t column)
{
    const tn_construction *construction = explorer->construction;
    const tn_key *current = &explorer->current;
    explorer->next.size = 0;
    if (tn_depth_over(&explorer->depth, state, column))
        return state;
    if (!construction->step(construction->context, current->data, current->size, column, &explorer->next))
        return UINT32_MAX;
    uint32_t to = tn_intern(&explorer->keys, explorer->next.data, explorer->next.size);
    return to != UINT32_MAX && tn_depth_found(&explorer->depth, state, column, to) ? to : UINT32_MAX;
}

static bool explorer_row(tn_explorer *explorer, uint32_t state)
{
    uint32_t columns = explorer->construction->join->columns;
    size_t size;
    const uint32_t *key = tn_interned(&explorer->keys, state, &size);
    if (!tn_array_reserve_from(&explorer->delta, &explorer->capacity, 32, state, 1,
                               columns * sizeof *explorer->delta) ||
        !tn_key_copy(&explorer->current, key, size))
        return false;
    uint32_t *row = explorer->delta + (size_t)state * columns;
    for (uint32_t c = 0; c < columns; c++) {
        row[c] = explorer_step(explorer, state, c);
        if (row[c] == UINT32_MAX)
            return false;
    }
    return true;
}

static tn_status check_words(const tn_explorer *explorer, const tn_bounds *bounds, tn_error *error)
{
    if (explorer->keys.words_used <= bounds->max_words)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
            "the automaton of this %s takes more than %llu MB to build; it had %u states by then",
            explorer->construction->what, (unsigned long long)(bounds->max_words * sizeof(uint32_t) >> 20),
            explorer->keys.count);
    tn_error_help(error, "split the rule into smaller ones");
    return TN_LIMIT;
}

static tn_status explorer_run(tn_explorer *explorer, const tn_key *start, const uint64_t *effort, tn_bounds *bounds,
                              tn_error *error)
{
    const tn_construction *construction = explorer->construction;
    const tn_join *join = construction->join;
    uint32_t columns = join->columns;
    tn_status status = tn_bounds_check(bounds, construction->what, 1, columns, join->letters, error);
    if (status == TN_OK && (tn_intern(&explorer->keys, start->data, start->size) == UINT32_MAX ||
                            !tn_depth_begin(&explorer->depth, bounds, join->column, join->letters)))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    for (uint32_t s = 0; s < explorer->keys.count; s++) {
        uint64_t before = effort ? *effort : 0;
        if (!explorer_row(explorer, s))
            return tn_fail_memory(error);
        uint64_t work = (uint64_t)(explorer->current.size + 1) * columns + (effort ? *effort - before : 0);
        status = tn_bounds_check(bounds, construction->what, explorer->keys.count, columns, work, error);
        if (status == TN_OK)
            status = check_words(explorer, bounds, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status explorer_finish(const tn_explorer *explorer, tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    const tn_construction *construction = explorer->construction;
    const tn_join *join = construction->join;
    tn_dfa *dfa = tn_dfa_new(join->letters, join->columns, explorer->keys.count);
    if (!dfa)
        return tn_fail_memory(error);
    memcpy(dfa->column, join->column, dfa->letters * sizeof *dfa->column);
    memcpy(dfa->delta, explorer->delta, (size_t)dfa->states * dfa->columns * sizeof *dfa->delta);
    for (uint32_t s = 0; s < dfa->states; s++) {
        size_t size;
        const uint32_t *key = tn_interned(&explorer->keys, s, &size);
        dfa->accept[s] = construction->accepts(construction->context, key, size);
    }
    tn_status status = tn_cover_minimise(dfa, bounds, out, error);
    tn_dfa_free(dfa);
    return status;
}

tn_status tn_explore(const tn_construction *construction, const tn_key *start, const uint64_t *effort,
                     tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    tn_explorer explorer = {.construction = construction};
    tn_status status = explorer_run(&explorer, start, effort, bounds, error);
    if (status == TN_OK)
        status = explorer_finish(&explorer, bounds, out, error);
    tn_interner_clear(&explorer.keys);
    tn_depth_clear(&explorer.depth);
    free(explorer.current.data);
    free(explorer.next.data);
    free(explorer.delta);
    return status;
}
