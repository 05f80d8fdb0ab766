#include "runtime/plan/count.h"

#include <stdlib.h>
#include <string.h>

tn_status tn_column_weights(const tn_dfa *dfa, const tn_classes *classes, uint64_t **weights, tn_error *error)
{
    *weights = calloc((size_t)dfa->columns + 1, sizeof **weights);
    if (!*weights)
        return tn_fail_memory(error);
    for (uint32_t c = 0; c < classes->count; c++)
        (*weights)[dfa->column[c]] += classes->size[c];
    return TN_OK;
}

/* ---- edges */

/* Collects one state's edges; `sum` is zero for all states before and after. Returns how many there are. */
static uint32_t collect_edges(const tn_dfa *dfa, const uint64_t *weight, uint32_t state, uint32_t dead, uint64_t *sum,
                              uint32_t *target)
{
    uint32_t count = 0;
    const uint32_t *row = dfa->delta + (size_t)state * dfa->columns;
    for (uint32_t c = 0; c < dfa->columns; c++) {
        if (row[c] == dead || weight[c] == 0)
            continue;
        if (sum[row[c]] == 0)
            target[count++] = row[c];
        sum[row[c]] += weight[c];
    }
    return count;
}

tn_status tn_edges_make(tn_edges *edges, const tn_dfa *dfa, const uint64_t *weight, tn_error *error)
{
    uint32_t n = dfa->states, dead = tn_dfa_sink(dfa, 0);
    *edges = (tn_edges){.states = n, .accept = dfa->accept};
    uint64_t *sum = calloc((size_t)n + 1, sizeof *sum);
    uint32_t *target = malloc(((size_t)dfa->columns + 1) * sizeof *target);
    edges->first = malloc(((size_t)n + 1) * sizeof *edges->first);
    edges->target = malloc(((size_t)n * dfa->columns + 1) * sizeof *edges->target);
    edges->weight = malloc(((size_t)n * dfa->columns + 1) * sizeof *edges->weight);
    bool ok = sum && target && edges->first && edges->target && edges->weight;
    size_t count = 0;
    for (uint32_t s = 0; ok && s < n; s++) {
        edges->first[s] = count;
        uint32_t found = collect_edges(dfa, weight, s, dead, sum, target);
        for (uint32_t i = 0; i < found; i++) {
            edges->target[count] = target[i];
            edges->weight[count++] = sum[target[i]];
            sum[target[i]] = 0;
        }
    }
    if (ok)
        edges->first[n] = count;
    free(sum);
    free(target);
    if (ok)
        return TN_OK;
    tn_edges_clear(edges);
    return tn_fail_memory(error);
}

void tn_edges_clear(tn_edges *edges)
{
    free(edges->first);
    free(edges->target);
    free(edges->weight);
    *edges = (tn_edges){0};
}

/* ---- rows */

static tn_status row_allocate(const tn_edges *edges, size_t limbs, tn_row *row, tn_error *error)
{
    row->limbs = limbs;
    row->value = calloc((size_t)edges->states * limbs + 1, sizeof *row->value);
    return row->value ? TN_OK : tn_fail_memory(error);
}

void tn_row_clear(tn_row *row)
{
    free(row->value);
    *row = (tn_row){0};
}

/* Drops the last limb of every count where none needs it. */
static void row_shrink(const tn_edges *edges, tn_row *row)
{
    size_t limbs = row->limbs;
    if (limbs == 1)
        return;
    for (uint32_t s = 0; s < edges->states; s++)
        if (row->value[(size_t)s * limbs + limbs - 1] != 0)
            return;
    for (uint32_t s = 1; s < edges->states; s++)
        memmove(row->value + (size_t)s * (limbs - 1), row->value + (size_t)s * limbs, (limbs - 1) * sizeof *row->value);
    row->limbs = limbs - 1;
    mp_limb_t *less = realloc(row->value, ((size_t)edges->states * row->limbs + 1) * sizeof *less);
    if (less)
        row->value = less;
}

tn_status tn_row_first(const tn_edges *edges, tn_row *row, tn_error *error)
{
    tn_status status = row_allocate(edges, 1, row, error);
    for (uint32_t s = 0; status == TN_OK && s < edges->states; s++)
        row->value[s] = edges->accept[s];
    return status;
}

/* A sum of counts of one row, each times a number of trays that add up to less than 2^32, needs one limb more at most.
 */
tn_status tn_row_next(const tn_edges *edges, const tn_row *row, tn_row *next, tn_error *error)
{
    size_t limbs = row->limbs;
    tn_status status = row_allocate(edges, limbs + 1, next, error);
    if (status != TN_OK)
        return status;
    for (uint32_t s = 0; s < edges->states; s++) {
        mp_limb_t *sum = next->value + (size_t)s * next->limbs;
        for (size_t e = edges->first[s]; e < edges->first[s + 1]; e++)
            sum[limbs] += mpn_addmul_1(sum, tn_row_at(row, edges->target[e]), (mp_size_t)limbs, edges->weight[e]);
    }
    row_shrink(edges, next);
    return TN_OK;
}

tn_status tn_row_start(const tn_edges *edges, tn_row *row, tn_error *error)
{
    tn_status status = row_allocate(edges, 1, row, error);
    if (status == TN_OK)
        row->value[0] = 1;
    return status;
}

/* All counts of a vector together are at most (number of trays) ^ length, so one limb more suffices here too. */
tn_status tn_row_forward(const tn_edges *edges, const tn_row *row, tn_row *next, tn_error *error)
{
    size_t limbs = row->limbs;
    tn_status status = row_allocate(edges, limbs + 1, next, error);
    if (status != TN_OK)
        return status;
    for (uint32_t s = 0; s < edges->states; s++) {
        const mp_limb_t *from = tn_row_at(row, s);
        for (size_t e = edges->first[s]; e < edges->first[s + 1]; e++) {
            mp_limb_t *sum = next->value + (size_t)edges->target[e] * next->limbs;
            sum[limbs] += mpn_addmul_1(sum, from, (mp_size_t)limbs, edges->weight[e]);
        }
    }
    row_shrink(edges, next);
    return TN_OK;
}

void tn_row_add(const tn_row *row, uint32_t state, uint64_t times, mpz_t count)
{
    mpz_t value;
    mpz_roinit_n(value, tn_row_at(row, state), (mp_size_t)row->limbs);
    mpz_addmul_ui(count, value, times);
}

/* ---- counts */

tn_status tn_count_lengths(const tn_dfa *dfa, const tn_classes *classes, uint32_t max, mpz_t *counts, tn_error *error)
{
    uint64_t *weights = NULL;
    tn_edges edges = {0};
    tn_row row = {0};
    tn_status status = tn_column_weights(dfa, classes, &weights, error);
    if (status == TN_OK)
        status = tn_edges_make(&edges, dfa, weights, error);
    if (status == TN_OK)
        status = tn_row_first(&edges, &row, error);
    for (uint32_t length = 0; status == TN_OK; length++) {
        mpz_set_ui(counts[length], 0);
        tn_row_add(&row, 0, 1, counts[length]);
        if (length == max)
            break;
        tn_row next = {0};
        status = tn_row_next(&edges, &row, &next, error);
        tn_row_clear(&row);
        row = next;
    }
    tn_row_clear(&row);
    tn_edges_clear(&edges);
    free(weights);
    return status;
}

tn_status tn_count_range(const tn_dfa *dfa, const tn_classes *classes, uint32_t min, uint32_t max, mpz_t count,
                         tn_error *error)
{
    mpz_set_ui(count, 0);
    if (min > max)
        return TN_OK;
    mpz_t *counts = calloc((size_t)max + 1, sizeof *counts);
    if (!counts)
        return tn_fail_memory(error);
    for (uint32_t length = 0; length <= max; length++)
        mpz_init(counts[length]);
    tn_status status = tn_count_lengths(dfa, classes, max, counts, error);
    for (uint32_t length = min; status == TN_OK && length <= max; length++)
        mpz_add(count, count, counts[length]);
    for (uint32_t length = 0; length <= max; length++)
        mpz_clear(counts[length]);
    free(counts);
    return status;
}
