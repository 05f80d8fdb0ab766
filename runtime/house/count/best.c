/* Finds the best values of a library's houses: for each node, the values that what follows can add. */

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"
#include "runtime/plan/measure/pareto.h"

tn_status tn_houses_too_many_values(const tn_houses *h, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_FRONTIER, "counting houses by `%.60s` takes more than %u states",
            tn_text(h->form->module, h->measures->of[0]->of.name), h->max_states);
    tn_error_help(error, "ask about one plan (--plan), use rounder numbers, or allow more (--max-states N)");
    return TN_LIMIT;
}

static tn_status too_long_a_front(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_VALUES, "the front has more than %u points in a state", TN_FRONT_MAX);
    tn_error_help(error, "measure in rounder numbers: prices in steps of 10 or 50, lengths in whole units");
    return TN_LIMIT;
}

/* Drops what is not aimed at. */
static void keep_best(const tn_houses *h, tn_value_counts *counts)
{
    if (h->front)
        tn_value_counts_keep_front(counts);
    else
        tn_value_counts_keep_least(counts, h->wanted);
}

/* to += the values of from, each more by `gain` and so many times. Now and then what is not aimed at is dropped. */
static tn_status add_values(const tn_houses *h, tn_value_counts *to, const tn_value_counts *from,
                            const tn_house_gain *gain, const mpz_t times, tn_error *error)
{
    size_t most = 2 * from->count + to->count + 64;
    bool ok = tn_value_counts_add_shifted(to, from, gain, times);
    if (ok && to->count + from->count > most)
        keep_best(h, to);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* ---- a section, from the end of the row backwards */

/* The element of a node is values [lengths]. */
typedef struct tn_aiming {
    const tn_houses *houses;
    uint64_t pairs; /* of nodes and values, of all layers */
    mpz_t times;
} tn_aiming;

static void zero_values(const void *context, void *element)
{
    const tn_aiming *a = context;
    memset(element, 0, tn_houses_lengths(a->houses) * sizeof(tn_value_counts));
}

static tn_status add_end(void *context, void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_aiming *a = context;
    const tn_houses_edge *edge = at->label;
    mpz_set_ui(a->times, edge->times);
    return tn_value_counts_add((tn_value_counts *)element + (at->layer - a->houses->low), &edge->gain, a->times)
               ? TN_OK
               : tn_fail_memory(error);
}

static tn_status add_ahead(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_aiming *a = context;
    tn_value_counts *to = sum;
    const tn_value_counts *from = element;
    const tn_houses_edge *edge = at->label;
    tn_status status = TN_OK;
    mpz_set_ui(a->times, edge->ways);
    mpz_mul_ui(a->times, a->times, edge->times);
    for (uint32_t i = 0; status == TN_OK && i < tn_houses_lengths(a->houses); i++)
        status = add_values(a->houses, &to[i], &from[i], &edge->gain, a->times, error);
    return status;
}

static tn_status keep_aimed(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    tn_aiming *a = context;
    const tn_houses *h = a->houses;
    tn_value_counts *values = element;
    (void)layer;
    (void)state;
    for (uint32_t i = 0; i < tn_houses_lengths(h); i++) {
        keep_best(h, &values[i]);
        a->pairs += values[i].count;
        if (h->front && values[i].count > TN_FRONT_MAX)
            return too_long_a_front(error);
    }
    return a->pairs > h->max_states ? tn_houses_too_many_values(h, error) : TN_OK;
}

tn_status tn_houses_aim_kind(const tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    static const tn_walk_algebra values = {.zero = zero_values, .add = add_ahead, .settle = keep_aimed};
    tn_aiming a = {.houses = h};
    tn_houses_layers l;
    mpz_init(a.times);
    const tn_key_question aim = {&values, add_end, &a, tn_houses_lengths(h) * sizeof(tn_value_counts)};
    tn_status status = tn_houses_layers_begin(&l, h, kind, error);
    if (status == TN_OK)
        status = tn_key_walk_backward(&l.walk, &aim, error);
    for (uint32_t k = 0; l.walk.backward && k <= l.walk.last; k++) {
        kind->layers[k].best = (tn_value_counts *)(void *)l.walk.backward[k];
        l.walk.backward[k] = NULL;
    }
    tn_key_walk_clear(&l.walk, NULL, NULL);
    mpz_clear(a.times);
    return status;
}

/* ---- all of them */

tn_status tn_houses_aim_all(tn_houses *h, tn_error *error)
{
    tn_house_gain start = tn_houses_plan_start(h);
    tn_status status = TN_OK;
    mpz_t sections;
    mpz_init(sections);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        mpz_set_ui(sections, h->kinds[i].sections);
        for (uint32_t k = 0; status == TN_OK && k < tn_houses_lengths(h); k++)
            status = add_values(h, &h->best, &h->kinds[i].layers[0].best[k], &start, sections, error);
    }
    mpz_clear(sections);
    keep_best(h, &h->best);
    return status;
}

size_t tn_houses_points(const tn_houses *h)
{
    return h->best.count;
}

void tn_houses_point(const tn_houses *h, size_t point, int64_t *values, mpz_t count)
{
    for (uint32_t k = 0; k < h->measures->count; k++)
        values[k] = tn_houses_shown(h, k, h->best.items[point].value.by[k] * (h->measures->most[k] ? -1 : 1));
    mpz_set(count, h->best.items[point].count);
}
