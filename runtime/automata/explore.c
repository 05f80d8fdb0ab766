/* Makes an automaton by exploring a construction's states from the start. */
#include "runtime/automata/explore.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

typedef struct tn_explorer {
    const tn_construction *construction;
    tn_interner keys;
    tn_key current, next;
    uint32_t *delta; /* [states][columns], grows */
    size_t capacity; /* rows */
} tn_explorer;

/* over: no longer word matters. */
static bool explorer_row(tn_explorer *explorer, uint32_t state, bool over)
{
    const tn_construction *construction = explorer->construction;
    uint32_t columns = construction->join->columns;
    if (!tn_array_reserve_from(&explorer->delta, &explorer->capacity, 32, state, 1, columns * sizeof *explorer->delta))
        return false;
    for (uint32_t c = 0; over && c < columns; c++)
        explorer->delta[(size_t)state * columns + c] = state;
    if (over)
        return true;
    size_t size;
    const uint32_t *key = tn_interned(&explorer->keys, state, &size);
    if (!tn_key_copy(&explorer->current, key, size))
        return false;
    for (uint32_t c = 0; c < columns; c++) {
        explorer->next.size = 0;
        if (!construction->step(construction->context, explorer->current.data, size, c, &explorer->next))
            return false;
        uint32_t to = tn_intern(&explorer->keys, explorer->next.data, explorer->next.size);
        if (to == UINT32_MAX)
            return false;
        explorer->delta[(size_t)state * columns + c] = to;
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
    uint32_t columns = construction->join->columns;
    tn_status status = tn_bounds_check(bounds, construction->what, 1, columns, construction->join->letters, error);
    if (status == TN_OK && tn_intern(&explorer->keys, start->data, start->size) == UINT32_MAX)
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    tn_depth depth = tn_depth_begin(bounds);
    for (uint32_t s = 0; s < explorer->keys.count; s++) {
        uint64_t before = effort ? *effort : 0;
        if (!explorer_row(explorer, s, tn_depth_over(&depth, s, explorer->keys.count)))
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

static tn_status explorer_finish(const tn_explorer *explorer, tn_dfa **out, tn_error *error)
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
    tn_status status = tn_dfa_minimise(dfa, 0, out, error);
    tn_dfa_free(dfa);
    return status;
}

tn_status tn_explore(const tn_construction *construction, const tn_key *start, const uint64_t *effort,
                     tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    tn_explorer explorer = {.construction = construction};
    tn_status status = explorer_run(&explorer, start, effort, bounds, error);
    if (status == TN_OK)
        status = explorer_finish(&explorer, out, error);
    tn_interner_clear(&explorer.keys);
    free(explorer.current.data);
    free(explorer.next.data);
    free(explorer.delta);
    return status;
}
