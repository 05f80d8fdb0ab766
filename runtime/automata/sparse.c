/* Keeps automata without their dead state, and combines them. */
#include "runtime/automata/sparse.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

tn_sparse *tn_sparse_new(uint32_t letters, uint32_t columns, uint32_t states, size_t edges)
{
    tn_sparse *sparse = calloc(1, sizeof *sparse);
    if (!sparse)
        return NULL;
    sparse->letters = letters;
    sparse->columns = columns;
    sparse->states = states;
    sparse->column = malloc(((size_t)letters + 1) * sizeof *sparse->column);
    sparse->first = calloc((size_t)states + 1, sizeof *sparse->first);
    sparse->label = malloc((edges + 1) * sizeof *sparse->label);
    sparse->target = malloc((edges + 1) * sizeof *sparse->target);
    sparse->accept = calloc((size_t)states + 1, 1);
    if (sparse->column && sparse->first && sparse->label && sparse->target && sparse->accept)
        return sparse;
    tn_sparse_free(sparse);
    return NULL;
}

void tn_sparse_free(tn_sparse *sparse)
{
    if (!sparse)
        return;
    free(sparse->column);
    free(sparse->first);
    free(sparse->label);
    free(sparse->target);
    free(sparse->accept);
    free(sparse);
}

/* ---- edges by target */

tn_status tn_inverse_make(const tn_sparse *sparse, tn_inverse *sources, tn_error *error)
{
    uint32_t n = sparse->states;
    size_t edges = sparse->first[n];
    *sources = (tn_inverse){0};
    sources->first = calloc((size_t)n + 2, sizeof *sources->first);
    sources->label = malloc((edges + 1) * sizeof *sources->label);
    sources->source = malloc((edges + 1) * sizeof *sources->source);
    if (!sources->first || !sources->label || !sources->source) {
        tn_inverse_clear(sources);
        return tn_fail_memory(error);
    }
    for (size_t e = 0; e < edges; e++)
        sources->first[sparse->target[e] + 2]++;
    for (uint32_t s = 0; s < n; s++)
        sources->first[s + 2] += sources->first[s + 1];
    for (uint32_t s = 0; s < n; s++) {
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++) {
            size_t at = sources->first[sparse->target[e] + 1]++;
            sources->label[at] = sparse->label[e];
            sources->source[at] = s;
        }
    }
    return TN_OK;
}

void tn_inverse_clear(tn_inverse *sources)
{
    free(sources->first);
    free(sources->label);
    free(sources->source);
    *sources = (tn_inverse){0};
}

/* ---- trimming */

/* Which states reach an accepting one: number of each among them, TN_NO_STATE for the others. */
static tn_status number_live(const tn_sparse *all, uint32_t *number, uint32_t *live, size_t *edges, tn_error *error)
{
    tn_inverse sources;
    tn_status status = tn_inverse_make(all, &sources, error);
    uint32_t *order = malloc(((size_t)all->states + 1) * sizeof *order), count = 0;
    if (status == TN_OK && !order)
        status = tn_fail_memory(error);
    memset(number, 0xff, all->states * sizeof *number);
    for (uint32_t s = 0; status == TN_OK && s < all->states; s++)
        if (all->accept[s]) {
            number[s] = 0;
            order[count++] = s;
        }
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        for (size_t e = sources.first[order[i]]; e < sources.first[order[i] + 1]; e++)
            if (number[sources.source[e]] == TN_NO_STATE) {
                number[sources.source[e]] = 0;
                order[count++] = sources.source[e];
            }
    *live = *edges = 0;
    for (uint32_t s = 0; status == TN_OK && s < all->states; s++)
        if (number[s] != TN_NO_STATE)
            number[s] = (*live)++;
    for (size_t e = 0; status == TN_OK && e < all->first[all->states]; e++)
        *edges += number[all->target[e]] != TN_NO_STATE;
    if (all->states > 0 && number[0] == TN_NO_STATE)
        *live = 0;
    free(order);
    tn_inverse_clear(&sources);
    return status;
}

/* A copy without the states from which nothing is accepted. */
static tn_status trim(const tn_sparse *all, tn_sparse **out, tn_error *error)
{
    uint32_t *number = malloc(((size_t)all->states + 1) * sizeof *number), live = 0;
    size_t edges = 0, used = 0;
    tn_status status = number ? number_live(all, number, &live, &edges, error) : tn_fail_memory(error);
    tn_sparse *made = status == TN_OK ? tn_sparse_new(all->letters, all->columns, live, edges) : NULL;
    if (status == TN_OK && !made)
        status = tn_fail_memory(error);
    if (made)
        memcpy(made->column, all->column, all->letters * sizeof *all->column);
    for (uint32_t s = 0; made && live > 0 && s < all->states; s++) {
        if (number[s] == TN_NO_STATE)
            continue;
        made->accept[number[s]] = all->accept[s];
        for (size_t e = all->first[s]; e < all->first[s + 1]; e++) {
            if (number[all->target[e]] == TN_NO_STATE)
                continue;
            made->label[used] = all->label[e];
            made->target[used++] = number[all->target[e]];
        }
        made->first[number[s] + 1] = used;
    }
    free(number);
    *out = made;
    return status;
}

/* ---- from and to complete automata */

/* What tn_sparse_make finds out about its operand. */
typedef struct tn_reach {
    uint32_t *used;   /* columns that some letter has */
    uint32_t *number; /* [states]: breadth first from the start; TN_NO_STATE: not reached */
    uint32_t *order;  /* the states so numbered */
    uint32_t used_count, count;
    uint32_t *memory;
} tn_reach;

static bool reach_make(tn_reach *reach, const tn_dfa *dfa, uint32_t start)
{
    size_t n = dfa->states, k = dfa->columns;
    *reach = (tn_reach){.memory = tn_array_new(2 * (uint64_t)k + 2 * (uint64_t)n + 1, sizeof *reach->memory)};
    if (!reach->memory)
        return false;
    reach->used = reach->memory;
    uint32_t *seen = reach->used + k;
    reach->number = seen + k;
    reach->order = reach->number + n;
    memset(seen, 0, k * sizeof *seen);
    memset(reach->number, 0xff, n * sizeof *reach->number);
    for (uint32_t l = 0; l < dfa->letters; l++)
        if (!seen[dfa->column[l]]++)
            reach->used[reach->used_count++] = dfa->column[l];
    reach->number[start] = 0;
    reach->order[reach->count++] = start;
    for (uint32_t i = 0; i < reach->count; i++) {
        const uint32_t *row = dfa->delta + (size_t)reach->order[i] * dfa->columns;
        for (uint32_t c = 0; c < reach->used_count; c++) {
            uint32_t to = row[reach->used[c]];
            if (reach->number[to] != TN_NO_STATE)
                continue;
            reach->number[to] = reach->count;
            reach->order[reach->count++] = to;
        }
    }
    return true;
}

/* All that is reached, without the edges to the one dead state that `dfa` shows as such. */
static tn_sparse *make_reached(const tn_dfa *dfa, const tn_reach *reach)
{
    uint32_t dead = tn_dfa_sink(dfa, 0);
    size_t edges = 0;
    for (uint32_t i = 0; i < reach->count; i++)
        for (uint32_t c = 0; c < reach->used_count; c++)
            edges += dfa->delta[(size_t)reach->order[i] * dfa->columns + reach->used[c]] != dead;
    tn_sparse *sparse = tn_sparse_new(dfa->letters, dfa->columns, reach->count, edges);
    if (!sparse)
        return NULL;
    memcpy(sparse->column, dfa->column, dfa->letters * sizeof *dfa->column);
    edges = 0;
    for (uint32_t i = 0; i < reach->count; i++) {
        const uint32_t *row = dfa->delta + (size_t)reach->order[i] * dfa->columns;
        sparse->accept[i] = dfa->accept[reach->order[i]];
        for (uint32_t c = 0; c < reach->used_count; c++) {
            if (row[reach->used[c]] == dead)
                continue;
            sparse->label[edges] = reach->used[c];
            sparse->target[edges++] = reach->number[row[reach->used[c]]];
        }
        sparse->first[i + 1] = edges;
    }
    return sparse;
}

tn_status tn_sparse_make(const tn_dfa *dfa, uint32_t start, tn_sparse **out, tn_error *error)
{
    tn_reach reach;
    tn_sparse *reached = reach_make(&reach, dfa, start) ? make_reached(dfa, &reach) : NULL;
    tn_status status = reached ? trim(reached, out, error) : tn_fail_memory(error);
    free(reach.memory);
    tn_sparse_free(reached);
    return status;
}

tn_status tn_sparse_fill(const tn_sparse *sparse, tn_dfa **out, tn_error *error)
{
    uint32_t dead = sparse->states;
    tn_dfa *dfa = tn_dfa_new(sparse->letters, sparse->columns, sparse->states + 1);
    if (!dfa)
        return tn_fail_memory(error);
    memcpy(dfa->column, sparse->column, dfa->letters * sizeof *dfa->column);
    memcpy(dfa->accept, sparse->accept, sparse->states);
    for (size_t i = 0; i < (size_t)dfa->states * dfa->columns; i++)
        dfa->delta[i] = dead;
    for (uint32_t s = 0; s < sparse->states; s++)
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++)
            dfa->delta[(size_t)s * dfa->columns + sparse->label[e]] = sparse->target[e];
    *out = dfa;
    return TN_OK;
}

tn_status tn_sparse_complete(const tn_sparse *sparse, tn_dfa **out, tn_error *error)
{
    tn_dfa *dfa = NULL;
    tn_status status = tn_sparse_fill(sparse, &dfa, error);
    if (status == TN_OK)
        status = tn_dfa_tidy(dfa, 0, out, error);
    tn_dfa_free(dfa);
    return status;
}

/* ---- products */

#define TABLE_ENTRIES_MAX (UINT64_C(1) << 23) /* 32 MB, of which only the pages used take memory */

typedef struct tn_sparse_work {
    const tn_sparse *a;
    const tn_dfa *b;
    tn_dfa_operation operation;
    uint32_t settled; /* the state of b with which nothing is accepted any more */
    tn_splits splits;
    tn_numbering pairs;
    uint32_t *table; /* [states of a][states of b]: number + 1; NULL where that is too much: then `pairs` hashes */
    size_t *first;
    uint32_t *label, *target;
    size_t states_capacity, edges, edges_capacity;
} tn_sparse_work;

bool tn_splits_make(tn_splits *splits, const tn_sparse *a, const tn_dfa *b)
{
    tn_numbering pairs = {0};
    *splits = (tn_splits){.column = malloc(((size_t)a->letters + 1) * sizeof *splits->column)};
    bool ok = splits->column != NULL;
    for (uint32_t l = 0; ok && l < a->letters; l++) {
        splits->column[l] = tn_number(&pairs, (uint64_t)a->column[l] << 32 | b->column[l]);
        ok = splits->column[l] != UINT32_MAX;
    }
    splits->columns = pairs.count;
    splits->first = calloc((size_t)a->columns + 2, sizeof *splits->first);
    splits->splits = malloc(((size_t)pairs.count + 1) * sizeof *splits->splits);
    ok = ok && splits->first && splits->splits;
    for (uint32_t i = 0; ok && i < pairs.count; i++)
        splits->first[(pairs.keys[i] >> 32) + 2]++;
    for (uint32_t c = 0; ok && c < a->columns; c++)
        splits->first[c + 2] += splits->first[c + 1];
    for (uint32_t i = 0; ok && i < pairs.count; i++)
        splits->splits[splits->first[(pairs.keys[i] >> 32) + 1]++] = (tn_split){i, (uint32_t)pairs.keys[i]};
    tn_numbering_clear(&pairs);
    return ok;
}

void tn_splits_clear(tn_splits *splits)
{
    free(splits->column);
    free(splits->first);
    free(splits->splits);
    *splits = (tn_splits){0};
}

static bool work_reserve(tn_sparse_work *work, uint32_t state, size_t more)
{
    size_t label_capacity = work->edges_capacity;
    return tn_array_reserve(&work->first, &work->states_capacity, state, 2, sizeof *work->first) &&
           tn_array_reserve_from(&work->label, &label_capacity, 256, work->edges, more, sizeof *work->label) &&
           tn_array_reserve_from(&work->target, &work->edges_capacity, 256, work->edges, more, sizeof *work->target);
}

static uint32_t work_number(tn_sparse_work *work, uint32_t p, uint32_t q)
{
    uint64_t pair = (uint64_t)p << 32 | q;
    if (!work->table)
        return tn_number(&work->pairs, pair);
    uint32_t *slot = &work->table[(size_t)p * work->b->states + q];
    if (*slot == 0)
        *slot = tn_number_new(&work->pairs, pair) + 1; /* 0 again where out of memory */
    return *slot - 1;
}

static bool work_row(tn_sparse_work *work, uint32_t state)
{
    uint32_t p = (uint32_t)(work->pairs.keys[state] >> 32), q = (uint32_t)work->pairs.keys[state];
    const tn_sparse *a = work->a;
    const uint32_t *row = work->b->delta + (size_t)q * work->b->columns;
    if (!work_reserve(work, state, work->splits.columns))
        return false;
    work->first[state] = work->edges;
    for (size_t e = a->first[p]; e < a->first[p + 1]; e++) {
        for (size_t i = work->splits.first[a->label[e]]; i < work->splits.first[a->label[e] + 1]; i++) {
            uint32_t to = row[work->splits.splits[i].other];
            if (to == work->settled)
                continue;
            uint32_t number = work_number(work, a->target[e], to);
            if (number == UINT32_MAX)
                return false;
            work->label[work->edges] = work->splits.splits[i].label;
            work->target[work->edges++] = number;
        }
    }
    work->first[state + 1] = work->edges;
    return true;
}

static tn_status work_run(tn_sparse_work *work, const char *what, tn_bounds *bounds, tn_error *error)
{
    if (work->a->states == 0 || work->settled == 0)
        return work_reserve(work, 0, 0) ? (work->first[0] = 0, TN_OK) : tn_fail_memory(error);
    uint64_t all = (uint64_t)work->a->states * work->b->states;
    if (all <= TABLE_ENTRIES_MAX)
        work->table = calloc((size_t)all, sizeof *work->table);
    if (work_number(work, 0, 0) == UINT32_MAX)
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < work->pairs.count; s++) {
        size_t before = work->edges;
        if (!work_row(work, s))
            return tn_fail_memory(error);
        uint64_t spent = work->edges - before + 1;
        tn_status status = tn_bounds_check(bounds, what, work->pairs.count, 1, spent, error);
        if (status == TN_OK && work->edges > bounds->max_transitions)
            status = tn_bounds_check(bounds, what, work->pairs.count, UINT32_MAX, 0, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static bool pair_accepts(const tn_sparse_work *work, uint64_t pair)
{
    bool b = work->b->accept[(uint32_t)pair];
    return work->a->accept[pair >> 32] && (work->operation == TN_DFA_AND ? b : !b);
}

static tn_status work_finish(tn_sparse_work *work, tn_sparse **out, tn_error *error)
{
    uint8_t *accept = malloc((size_t)work->pairs.count + 1);
    if (!accept)
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < work->pairs.count; s++)
        accept[s] = pair_accepts(work, work->pairs.keys[s]);
    tn_sparse all = {.letters = work->a->letters,
                     .columns = work->splits.columns,
                     .states = work->pairs.count,
                     .column = work->splits.column,
                     .first = work->first,
                     .label = work->label,
                     .target = work->target,
                     .accept = accept};
    tn_status status = trim(&all, out, error);
    free(accept);
    return status;
}

tn_status tn_sparse_product(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                            tn_bounds *bounds, tn_sparse **out, tn_error *error)
{
    tn_sparse_work work = {.a = a, .b = b, .operation = operation};
    work.settled = tn_dfa_sink(b, operation != TN_DFA_AND);
    tn_status status = tn_bounds_check(bounds, what, 1, 1, a->letters, error);
    if (status == TN_OK && !tn_splits_make(&work.splits, a, b))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = work_run(&work, what, bounds, error);
    if (status == TN_OK)
        status = work_finish(&work, out, error);
    tn_numbering_clear(&work.pairs);
    free(work.table);
    tn_splits_clear(&work.splits);
    free(work.first);
    free(work.label);
    free(work.target);
    return status;
}
