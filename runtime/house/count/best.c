/* Finds the best values of a library's houses: for each node, the values that what follows can add. */

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"
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
    if (h->aim == TN_HOUSES_FRONT)
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

typedef struct tn_aiming {
    const tn_houses *houses;
    tn_houses_kind *kind;
    uint32_t layer;
    uint64_t pairs; /* of nodes and values, of all layers */
    mpz_t times;
} tn_aiming;

static tn_value_counts *values_at(const tn_aiming *a, uint32_t layer, uint32_t node, uint32_t length)
{
    return &a->kind->layers[layer].best[(size_t)node * tn_houses_lengths(a->houses) + length];
}

static tn_status add_end(void *context, const tn_houses_edge *edge, tn_error *error)
{
    const tn_aiming *a = context;
    tn_value_counts *to = values_at(a, a->layer, edge->from, a->layer - a->houses->low);
    mpz_t times;
    mpz_init_set_ui(times, edge->times);
    bool ok = tn_value_counts_add(to, &edge->gain, times);
    mpz_clear(times);
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status add_ahead(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_aiming *a = context;
    uint32_t to = tn_number_find(&a->kind->layers[a->layer + 1].nodes, (uint64_t)edge->plan << 32 | edge->state);
    tn_status status = TN_OK;
    mpz_set_ui(a->times, edge->ways);
    mpz_mul_ui(a->times, a->times, edge->times);
    for (uint32_t i = 0; status == TN_OK && i < tn_houses_lengths(a->houses); i++)
        status = add_values(a->houses, values_at(a, a->layer, edge->from, i), values_at(a, a->layer + 1, to, i),
                            &edge->gain, a->times, error);
    return status;
}

static tn_status finish_layer(tn_aiming *a, tn_error *error)
{
    const tn_houses *h = a->houses;
    const tn_houses_layer *layer = &a->kind->layers[a->layer];
    size_t lists = (size_t)layer->nodes.count * tn_houses_lengths(h);
    for (size_t i = 0; i < lists; i++) {
        keep_best(h, &layer->best[i]);
        a->pairs += layer->best[i].count;
        if (h->aim == TN_HOUSES_FRONT && layer->best[i].count > TN_FRONT_MAX)
            return too_long_a_front(error);
    }
    return a->pairs > h->max_states ? tn_houses_too_many_values(h, error) : TN_OK;
}

tn_status tn_houses_aim_kind(const tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    tn_aiming a = {.houses = h, .kind = kind};
    tn_status status = TN_OK;
    mpz_init(a.times);
    for (a.layer = h->high + 1; status == TN_OK && a.layer-- > 0;) {
        tn_houses_layer *layer = &kind->layers[a.layer];
        layer->best = calloc(tn_size_of(layer->nodes.count, tn_houses_lengths(h)) + 1, sizeof *layer->best);
        status = layer->best ? TN_OK : tn_fail_memory(error);
        if (status == TN_OK && a.layer >= h->low)
            status = tn_houses_expand(h, kind, a.layer, true, add_end, &a, error);
        if (status == TN_OK && a.layer < h->high)
            status = tn_houses_expand(h, kind, a.layer, false, add_ahead, &a, error);
        if (status == TN_OK)
            status = finish_layer(&a, error);
    }
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
