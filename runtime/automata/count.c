/* Counts words forward from the start, or backward from the end in rows. */
#include "runtime/automata/count.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

tn_status tn_column_weights(const uint32_t *sizes, uint32_t letters, const uint32_t *column, uint32_t columns,
                            uint64_t **weights, tn_error *error)
{
    *weights = calloc((size_t)columns + 1, sizeof **weights);
    if (!*weights)
        return tn_fail_memory(error);
    for (uint32_t l = 0; l < letters; l++)
        (*weights)[column[l]] += sizes[l];
    return TN_OK;
}

/* ---- edges */

/* Room while edges are collected. */
typedef struct tn_collecting {
    uint64_t *sum;  /* [states]: symbols that lead there from the state in hand; zero between states */
    uint32_t *into; /* [columns]: states with a sum */
    uint32_t count;
} tn_collecting;

static tn_status edges_begin(tn_edges *edges, uint32_t states, uint32_t columns, size_t most, const uint8_t *accept,
                             tn_collecting *collecting, tn_error *error)
{
    *edges = (tn_edges){.states = states, .accept = accept};
    *collecting = (tn_collecting){0};
    collecting->sum = calloc((size_t)states + 1, sizeof *collecting->sum);
    collecting->into = malloc(((size_t)columns + 1) * sizeof *collecting->into);
    edges->first = calloc((size_t)states + 1, sizeof *edges->first);
    edges->target = malloc((most + 1) * sizeof *edges->target);
    edges->weight = malloc((most + 1) * sizeof *edges->weight);
    bool ok = collecting->sum && collecting->into && edges->first && edges->target && edges->weight;
    return ok ? TN_OK : tn_fail_memory(error);
}

static void edges_add(tn_collecting *collecting, uint32_t target, uint64_t weight)
{
    if (weight == 0)
        return;
    if (collecting->sum[target] == 0)
        collecting->into[collecting->count++] = target;
    collecting->sum[target] += weight;
}

/* Ends the edges of a state; states come in order. */
static void edges_next(tn_edges *edges, uint32_t state, tn_collecting *collecting)
{
    size_t at = edges->first[state];
    for (uint32_t i = 0; i < collecting->count; i++) {
        edges->target[at] = collecting->into[i];
        edges->weight[at++] = collecting->sum[collecting->into[i]];
        collecting->sum[collecting->into[i]] = 0;
    }
    collecting->count = 0;
    edges->first[state + 1] = at;
}

static tn_status edges_end(tn_edges *edges, tn_collecting *collecting, tn_status status)
{
    free(collecting->sum);
    free(collecting->into);
    if (status != TN_OK)
        tn_edges_clear(edges);
    return status;
}

tn_status tn_edges_make(tn_edges *edges, const tn_sparse *sparse, const uint64_t *weight, tn_error *error)
{
    tn_collecting collecting;
    tn_status status = edges_begin(edges, sparse->states, sparse->columns, sparse->first[sparse->states],
                                   sparse->accept, &collecting, error);
    for (uint32_t s = 0; status == TN_OK && s < sparse->states; s++) {
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++)
            edges_add(&collecting, sparse->target[e], weight[sparse->label[e]]);
        edges_next(edges, s, &collecting);
    }
    return edges_end(edges, &collecting, status);
}

tn_status tn_edges_of(tn_edges *edges, const tn_dfa *dfa, const uint64_t *weight, tn_error *error)
{
    tn_collecting collecting;
    tn_status status = edges_begin(edges, dfa->states, dfa->columns, (size_t)dfa->states * dfa->columns, dfa->accept,
                                   &collecting, error);
    uint32_t dead = tn_dfa_sink(dfa, 0);
    for (uint32_t s = 0; status == TN_OK && s < dfa->states; s++) {
        for (uint32_t c = 0; c < dfa->columns; c++) {
            uint32_t to = dfa->delta[(size_t)s * dfa->columns + c];
            if (to != dead)
                edges_add(&collecting, to, weight[c]);
        }
        edges_next(edges, s, &collecting);
    }
    return edges_end(edges, &collecting, status);
}

void tn_edges_clear(tn_edges *edges)
{
    free(edges->first);
    free(edges->target);
    free(edges->weight);
    *edges = (tn_edges){0};
}

/* ---- rows */

static tn_status row_allocate(const tn_edges *edges, size_t limbs, tn_count_row *row, tn_error *error)
{
    row->limbs = limbs;
    row->value = calloc(tn_size_of(edges->states, limbs) + 1, sizeof *row->value);
    return row->value ? TN_OK : tn_fail_memory(error);
}

void tn_count_row_clear(tn_count_row *row)
{
    free(row->value);
    *row = (tn_count_row){0};
}

/* Drops the last limb of every count where none needs it. */
static void row_shrink(const tn_edges *edges, tn_count_row *row)
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
    (void)tn_array_resize(&row->value, (size_t)edges->states * row->limbs, sizeof *row->value); /* or it stays large */
}

tn_status tn_count_row_first(const tn_edges *edges, tn_count_row *row, tn_error *error)
{
    tn_status status = row_allocate(edges, 1, row, error);
    for (uint32_t s = 0; status == TN_OK && s < edges->states; s++)
        row->value[s] = edges->accept[s];
    return status;
}

/* A sum of counts of one row, each times a number of symbols that add up to less than 2^32, needs one limb more at
 * most.
 */
tn_status tn_count_row_next(const tn_edges *edges, const tn_count_row *row, tn_count_row *next, tn_error *error)
{
    size_t limbs = row->limbs;
    tn_status status = row_allocate(edges, limbs + 1, next, error);
    if (status != TN_OK)
        return status;
    for (uint32_t s = 0; s < edges->states; s++) {
        mp_limb_t *sum = next->value + (size_t)s * next->limbs;
        for (size_t e = edges->first[s]; e < edges->first[s + 1]; e++)
            sum[limbs] += tn_limbs_add(sum, tn_count_row_at(row, edges->target[e]), limbs, edges->weight[e]);
    }
    row_shrink(edges, next);
    return TN_OK;
}

void tn_count_row_add(const tn_count_row *row, uint32_t state, uint64_t times, mpz_t count)
{
    mpz_t value;
    mpz_roinit_n(value, tn_count_row_at(row, state), (mp_size_t)row->limbs);
    mpz_addmul_ui(count, value, times);
}

uint64_t tn_count_to_come(size_t half, size_t limbs, uint32_t length, uint32_t max)
{
    double left = max > length ? max - length : 0, slope = 2 * (double)(limbs > half ? limbs - half : 0) / length;
    double bytes = sizeof(mp_limb_t) * left * ((double)limbs + slope * left / 2);
    return bytes < 0x1p63 ? (uint64_t)bytes : UINT64_MAX / 2;
}

/* ---- counts */

/* Counting forwards, in counts of so many limbs that no word is lost. */
typedef struct forward_count {
    size_t limbs;
    const tn_sparse *sparse;
    const uint64_t *weights; /* symbols of each column */
    mpz_t *counts;           /* by length */
} forward_count;

static tn_status edges_of(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                          tn_error *error)
{
    const forward_count *f = context;
    tn_status status = TN_OK;
    (void)layer;
    for (size_t e = f->sparse->first[state]; status == TN_OK && e < f->sparse->first[state + 1]; e++) {
        const uint64_t *weight = &f->weights[f->sparse->label[e]];
        if (*weight > 0)
            status = seen(walk, f->sparse->target[e], weight, error);
    }
    return status;
}

static tn_status end_words(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const forward_count *f = context;
    mpz_t value;
    (void)error;
    mpz_roinit_n(value, element, (mp_size_t)f->limbs);
    if (f->sparse->accept[state])
        mpz_add(f->counts[layer], f->counts[layer], value);
    return TN_OK;
}

static const tn_walk_graph graph = {tn_walk_starts_first, edges_of};
TN_WALK_ALGEBRA(algebra, tn_limbs_begin, NULL, tn_limbs_one, tn_limbs_extend, end_words);

/* Of an automaton without cycles, from its start: each step only meets the states that words of that length reach.
 * limbs: hold the number of all words of `max` symbols. */
static tn_status count_forward(const tn_sparse *sparse, const uint64_t *weights, size_t limbs, uint32_t max,
                               mpz_t *counts, tn_error *error)
{
    forward_count f = {limbs, sparse, weights, counts};
    tn_layers walk = {0};
    for (uint32_t length = 0; length <= max; length++)
        mpz_set_ui(counts[length], 0);
    if (sparse->states == 0)
        return TN_OK;
    tn_status status = tn_walk_begin(&walk, max, false, error);
    if (status == TN_OK)
        status = tn_walk_forward(&walk, &graph, &f, &algebra, &f, limbs * sizeof(mp_limb_t), error);
    tn_walk_clear(&walk, &algebra, NULL);
    return status;
}

uint64_t tn_count_limbs(const uint64_t *weights, uint32_t columns, uint32_t max)
{
    uint64_t symbols = 0, bits = 1;
    for (uint32_t c = 0; c < columns; c++)
        symbols += weights[c];
    while (symbols >> bits)
        bits++;
    return bits * max / 64 + 1;
}

/* GMP, which the counts are for, ends the program where it gets no memory. */
static tn_status check_counts(tn_watch *watch, size_t half, size_t limbs, uint32_t length, uint32_t max,
                              tn_error *error)
{
    char what[64];
    snprintf(what, sizeof what, "counting the plans of up to %u trays", max);
    tn_status status = tn_watch_room(watch, tn_count_to_come(half, limbs, length, max), what, error);
    if (status == TN_LIMIT)
        tn_error_help(error, "give fewer trays with --trays, or raise the limit with --memory-limit");
    return status;
}

static tn_status count_backward(const tn_sparse *sparse, const uint64_t *weights, uint32_t max, mpz_t *counts,
                                tn_watch *watch, tn_error *error)
{
    tn_edges edges = {0};
    tn_count_row row = {0};
    size_t half = 1;
    tn_status status = tn_edges_make(&edges, sparse, weights, error);
    if (status == TN_OK)
        status = tn_count_row_first(&edges, &row, error);
    for (uint32_t length = 0; status == TN_OK; length++) {
        mpz_set_ui(counts[length], 0);
        if (sparse->states > 0)
            tn_count_row_add(&row, 0, 1, counts[length]);
        if (length == max)
            break;
        status = tn_watch_check(watch, error);
        if (status == TN_OK && tn_count_forecasts(length))
            status = check_counts(watch, half, row.limbs, length, max, error);
        if (status != TN_OK)
            break;
        if (tn_count_forecasts(2 * length))
            half = row.limbs;
        tn_count_row next = {0};
        status = tn_count_row_next(&edges, &row, &next, error);
        tn_count_row_clear(&row);
        row = next;
    }
    tn_count_row_clear(&row);
    tn_edges_clear(&edges);
    return status;
}

tn_status tn_count_lengths(const tn_sparse *sparse, const uint32_t *sizes, uint32_t max, mpz_t *counts, tn_watch *watch,
                           tn_error *error)
{
    uint64_t *weights = NULL;
    tn_status status = tn_column_weights(sizes, sparse->letters, sparse->column, sparse->columns, &weights, error);
    uint64_t limbs = status == TN_OK ? tn_count_limbs(weights, sparse->columns, max) : 0;
    if (status == TN_OK && sparse->folded && limbs <= TN_FORWARD_LIMBS_MAX)
        status = count_forward(sparse, weights, (size_t)limbs, max, counts, error);
    else if (status == TN_OK)
        status = count_backward(sparse, weights, max, counts, watch, error);
    free(weights);
    return status;
}

tn_status tn_count_range(const tn_sparse *sparse, const uint32_t *sizes, uint32_t min, uint32_t max, mpz_t count,
                         tn_watch *watch, tn_error *error)
{
    mpz_set_ui(count, 0);
    if (min > max)
        return TN_OK;
    mpz_t *counts = calloc((size_t)max + 1, sizeof *counts);
    if (!counts)
        return tn_fail_memory(error);
    for (uint32_t length = 0; length <= max; length++)
        mpz_init(counts[length]);
    tn_status status = tn_count_lengths(sparse, sizes, max, counts, watch, error);
    for (uint32_t length = min; status == TN_OK && length <= max; length++)
        mpz_add(count, count, counts[length]);
    for (uint32_t length = 0; length <= max; length++)
        mpz_clear(counts[length]);
    free(counts);
    return status;
}
