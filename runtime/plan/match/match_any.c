/* Matches whether any of some rules matches. */
#include "runtime/plan/match/match_any.h"

#include <stdlib.h>
#include <string.h>

#define TABLE_BYTES_MAX (1u << 20) /* half of a second-level cache */

#define FEW 2 /* lanes that are cheaper to finish one by one than to walk again all together */

/* *all: the union of the automata, or NULL where it passes the limit. */
static tn_status unite(tn_dfa *const *dfas, size_t count, tn_dfa **all, tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(TN_ANY_STATES_MAX);
    *all = NULL;
    for (size_t i = 0; i < count; i++) {
        tn_dfa *joined = NULL;
        tn_status status = TN_OK;
        if (*all)
            status = tn_dfa_product(*all, dfas[i], TN_DFA_OR, "the union of the rules", &bounds, &joined, error);
        else
            joined = tn_dfa_share(dfas[i]);
        tn_dfa_free(*all);
        *all = joined;
        if (status != TN_OK)
            return status == TN_LIMIT ? TN_OK : status;
    }
    return TN_OK;
}

static tn_status fill(tn_any *any, const tn_row_map *map, const tn_dfa *dfa, tn_error *error)
{
    while (UINT32_C(1) << any->shift < dfa->states)
        any->shift++;
    size_t entries = ((size_t)map->rows + 1) << any->shift;
    if (entries * sizeof *any->table > TABLE_BYTES_MAX)
        return TN_OK;
    any->table = calloc(entries, sizeof *any->table);
    any->accept = malloc(dfa->states);
    if (!any->table || !any->accept)
        return tn_fail_memory(error);
    uint32_t sink = tn_dfa_sink(dfa, 1);
    any->sink = sink == TN_NO_STATE ? UINT16_MAX : (uint16_t)sink;
    memcpy(any->accept, dfa->accept, dfa->states);
    for (uint32_t s = 0; s < dfa->states; s++) {
        for (uint32_t row = 0; row < map->rows; row++)
            any->table[((size_t)row << any->shift) + s] = (uint16_t)tn_dfa_read(dfa, s, map->letter[row]);
        any->table[((size_t)map->rows << any->shift) + s] = (uint16_t)s;
    }
    return TN_OK;
}

tn_status tn_any_make(tn_any *any, const tn_row_map *map, tn_dfa *const *dfas, size_t count, tn_error *error)
{
    *any = (tn_any){0};
    tn_dfa *all;
    tn_status status = unite(dfas, count, &all, error);
    if (status == TN_OK && all)
        status = fill(any, map, all, error);
    tn_dfa_free(all);
    return status;
}

void tn_any_clear(tn_any *any)
{
    free(any->table);
    free(any->accept);
    *any = (tn_any){0};
}

#define STEP(k) state##k = table[((size_t)rows##k[i] << shift) + state##k];
#define FINISH(k) matches[k] = any->accept[state##k];
#define UNDECIDED(k) | (state##k ^ sink)
#define LIST_STATE(k) state##k,

/* Walks on with the lanes that a glance has not decided, one after another; false where they are many. */
static bool finish_few(const tn_any *any, const size_t states[TN_LANES], const tn_plan_array *plans, size_t first,
                       uint8_t *matches)
{
    size_t undecided = 0;
    for (size_t k = 0; k < TN_LANES; k++)
        undecided += states[k] != any->sink;
    if (undecided > FEW)
        return false;
    for (size_t k = 0; k < TN_LANES; k++) {
        size_t state = states[k], begin = first + k ? plans->ends[first + k - 1] : plans->begin;
        for (size_t i = begin + TN_ANY_STEPS; i < plans->ends[first + k] && state != any->sink; i++)
            state = any->table[((size_t)plans->trays[i] << any->shift) + state];
        matches[k] = any->accept[state];
    }
    return true;
}

bool tn_any_glance(const tn_any *any, const tn_plan_array *plans, size_t first, uint8_t *matches)
{
    const uint16_t *table = any->table;
    const size_t *ends = plans->ends + first;
    size_t sink = any->sink, begin = first ? ends[-1] : plans->begin;
    unsigned shift = any->shift;
    bool is_short = false;
#define START(k)                                                                                                       \
    size_t state##k = 0;                                                                                               \
    const tn_tray *rows##k = plans->trays + ((k) ? ends[(k)-1] : begin);                                               \
    is_short |= ends[k] - ((k) ? ends[(k)-1] : begin) < TN_ANY_STEPS;
    TN_EACH_LANE(START)
#undef START
    if (is_short)
        return false;
    for (size_t i = 0; i < TN_ANY_STEPS; i++) {
        TN_EACH_LANE(STEP)
    }
    memset(matches, 1, TN_LANES);
    return !(0 TN_EACH_LANE(UNDECIDED)) || finish_few(any, (size_t[]){TN_EACH_LANE(LIST_STATE)}, plans, first, matches);
}

void tn_any_walk(const tn_any *any, const tn_lanes *lanes, uint8_t matches[TN_LANES])
{
    const uint16_t *table = any->table;
    size_t stride = lanes->stride, longest = lanes->longest, sink = any->sink;
    unsigned shift = any->shift;
#define START(k)                                                                                                       \
    size_t state##k = 0;                                                                                               \
    const uint32_t *rows##k = lanes->rows + (k)*stride;
    if (lanes->alone) {
        START(0)
        for (size_t i = 0; i < longest && state0 != sink; i++)
            STEP(0)
        FINISH(0)
        return;
    }
    TN_EACH_LANE(START)
#undef START
    for (size_t i = 0; i < longest;) {
        size_t stop = longest - i < TN_ANY_STEPS ? longest : i + TN_ANY_STEPS;
        for (; i < stop; i++) {
            TN_EACH_LANE(STEP)
        }
        if (!(0 TN_EACH_LANE(UNDECIDED)))
            break;
    }
    TN_EACH_LANE(FINISH)
}
#undef STEP
#undef FINISH
#undef UNDECIDED
#undef LIST_STATE
