/* Counts the houses of a library by the values of a measure: for each node, how many choices lead there with each
 * value.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"

/* ---- layers */

typedef struct tn_spreading {
    const tn_houses *houses;
    tn_houses_kind *kind;
    uint32_t layer;
    tn_value_counts *here, *next; /* [nodes] */
    size_t here_count, next_count, next_room;
    uint64_t pairs; /* of nodes and values, of the next layer */
    mpz_t times, one;
} tn_spreading;

static tn_status add_shifted(tn_spreading *s, tn_value_counts *to, const tn_houses_edge *edge, tn_error *error)
{
    const tn_value_counts *from = &s->here[edge->from];
    size_t before = to->count;
    mpz_set_ui(s->times, edge->ways);
    mpz_mul_ui(s->times, s->times, edge->times);
    if (!tn_value_counts_add_shifted(to, from, &edge->gain, s->times))
        return tn_fail_memory(error);
    s->pairs += to->count - before;
    return s->pairs > s->houses->max_states ? tn_houses_too_many_values(s->houses, error) : TN_OK;
}

static tn_status lead_on(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_spreading *s = context;
    uint32_t to = tn_number(&s->kind->layers[s->layer + 1].nodes, (uint64_t)edge->plan << 32 | edge->state);
    if (to == UINT32_MAX || !tn_array_reserve(&s->next, &s->next_room, to, 1, sizeof *s->next))
        return tn_fail_memory(error);
    for (; s->next_count <= to; s->next_count++)
        s->next[s->next_count] = (tn_value_counts){0};
    if (s->kind->frontier->states.count > s->houses->max_states)
        return tn_houses_too_many_values(s->houses, error);
    return add_shifted(s, &s->next[to], edge, error);
}

static tn_status come_to_end(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_spreading *s = context;
    return add_shifted(s, &s->kind->spread, edge, error);
}

static void clear_layer(tn_value_counts *counts, size_t count)
{
    for (size_t i = 0; i < count; i++)
        tn_value_counts_clear(&counts[i]);
    free(counts);
}

static tn_status spread_layer(tn_spreading *s, tn_error *error)
{
    const tn_houses *h = s->houses;
    tn_status status = TN_OK;
    s->pairs = 0;
    if (s->layer >= h->low)
        status = tn_houses_expand(h, s->kind, s->layer, true, come_to_end, s, error);
    s->pairs = 0;
    if (status == TN_OK && s->layer < h->high)
        status = tn_houses_expand(h, s->kind, s->layer, false, lead_on, s, error);
    clear_layer(s->here, s->here_count);
    s->here = s->next;
    s->here_count = s->next_count;
    s->next = NULL;
    s->next_count = s->next_room = 0;
    return status;
}

tn_status tn_houses_spread_kind(const tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    tn_spreading s = {.houses = h, .kind = kind, .here_count = 1};
    tn_status status = TN_OK;
    mpz_inits(s.times, s.one, NULL);
    mpz_set_ui(s.one, 1);
    kind->layers = calloc((size_t)h->high + 1, sizeof *kind->layers);
    s.here = calloc(1, sizeof *s.here);
    tn_house_gain start = tn_houses_plan_start(h);
    if (!kind->layers || !s.here || tn_number(&kind->layers[0].nodes, TN_FRONTIER_NONE) == UINT32_MAX ||
        !tn_value_counts_add(s.here, &start, s.one))
        status = tn_fail_memory(error);
    for (; status == TN_OK && s.layer <= h->high; s.layer++)
        status = spread_layer(&s, error);
    clear_layer(s.here, s.here ? s.here_count : 0);
    mpz_clears(s.times, s.one, NULL);
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
