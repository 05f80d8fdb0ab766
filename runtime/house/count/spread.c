/* Counts the houses of a library by the values of a measure: for each node, how many choices lead there with each
 * value.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"

/* ---- layers */

typedef struct tn_spreading {
    const tn_houses *houses;
    tn_houses_kind *kind;
    uint64_t turn;  /* 1 and the layer whose ends, or edges, are gone: with ends, 2 for each layer */
    uint64_t pairs; /* of nodes and values, that these have made */
    mpz_t times;
} tn_spreading;

static void zero_values(const void *context, void *element)
{
    (void)context;
    *(tn_value_counts *)element = (tn_value_counts){0};
}

static void clear_values(void *element)
{
    tn_value_counts_clear(element);
}

static tn_status start_values(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    tn_spreading *s = context;
    tn_house_gain start = tn_houses_plan_start(s->houses);
    (void)layer;
    (void)state;
    mpz_set_ui(s->times, 1);
    return tn_value_counts_add(element, &start, s->times) ? TN_OK : tn_fail_memory(error);
}

static tn_status add_shifted(tn_spreading *s, uint64_t turn, tn_value_counts *to, const tn_value_counts *from,
                             const tn_houses_edge *edge, tn_error *error)
{
    size_t before = to->count;
    s->pairs = s->turn == turn ? s->pairs : 0;
    s->turn = turn;
    mpz_set_ui(s->times, edge->ways);
    mpz_mul_ui(s->times, s->times, edge->times);
    if (!tn_value_counts_add_shifted(to, from, &edge->gain, s->times))
        return tn_fail_memory(error);
    s->pairs += to->count - before;
    return s->pairs > s->houses->max_states ? tn_houses_too_many_values(s->houses, error) : TN_OK;
}

static tn_status add_values(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_spreading *s = context;
    if (s->kind->frontier->states.count > s->houses->max_states)
        return tn_houses_too_many_values(s->houses, error);
    return add_shifted(s, 2 * (uint64_t)at->layer + 2, sum, element, at->label, error);
}

static tn_status end_values(void *context, void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_spreading *s = context;
    return add_shifted(s, 2 * (uint64_t)at->layer + 1, &s->kind->spread, element, at->label, error);
}

tn_status tn_houses_spread_kind(const tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    static const tn_walk_algebra values = {
        .zero = zero_values, .clear = clear_values, .one = start_values, .add = add_values};
    tn_spreading s = {.houses = h, .kind = kind};
    mpz_init(s.times);
    const tn_key_question spread = {&values, end_values, &s, sizeof(tn_value_counts)};
    tn_status status = tn_houses_go_forward(h, kind, &spread, error);
    mpz_clear(s.times);
    return status;
}

/* ---- all sections */

/* The values of all sections, as they are given out. */
static bool join_kinds(const tn_houses *h, tn_value_counts *all)
{
    bool ok = true;
    mpz_t times;
    mpz_init(times);
    for (size_t k = 0; ok && k < h->kind_count; k++)
        for (size_t i = 0; ok && i < h->kinds[k].spread.count; i++) {
            const tn_value_count *item = &h->kinds[k].spread.items[i];
            const tn_house_gain shown = {{tn_houses_shown(h, 0, item->value.by[0])}};
            mpz_mul_ui(times, item->count, h->kinds[k].sections);
            ok = tn_value_counts_add(all, &shown, times);
        }
    mpz_clear(times);
    return ok;
}

tn_status tn_houses_spread(const tn_houses *h, tn_distribution *d, tn_error *error)
{
    tn_value_counts all = {0};
    bool ok = join_kinds(h, &all);
    mpq_set(d->unit, h->measures->of[0]->shown);
    d->value = ok ? malloc((all.count + 1) * sizeof *d->value) : NULL;
    d->plans = d->value ? tn_integers_new(all.count) : NULL;
    d->count = d->room = d->plans ? all.count : 0;
    for (size_t i = 0; i < d->count; i++) {
        d->value[i] = (int64_t)all.items[i].value.by[0];
        mpz_set(d->plans[i], all.items[i].count);
        mpz_add(d->all, d->all, d->plans[i]);
    }
    tn_value_counts_clear(&all);
    return d->plans ? TN_OK : tn_fail_memory(error);
}
