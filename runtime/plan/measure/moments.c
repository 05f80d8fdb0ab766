/* Moments: for each state how many plans lead there, and the moments of their values and of the squares of these. */
#include "runtime/plan/measure/moments.h"

#include <stdlib.h>

#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/distribution.h"
#include "runtime/plan/measure/weighed_layers.h"

/* Of the values of the plans that lead to a state, or of all that end: how many there are, their sum, the sum of their
 * squares, the least and the most. */
typedef struct moments {
    mpz_t count, sum, squares;
    int64_t least, most;
} moments;

typedef struct adding {
    const tn_weighed *weighed;
    uint32_t min;
    moments *all;
} adding;

static void moments_init(const void *context, void *element)
{
    moments *m = element;
    (void)context;
    *m = (moments){.least = INT64_MAX, .most = INT64_MIN};
    mpz_inits(m->count, m->sum, m->squares, NULL);
}

static void moments_clear(void *element)
{
    moments *m = element;
    mpz_clears(m->count, m->sum, m->squares, NULL);
}

/* Adds the plans of `from`, each `times` times, with `gain` more. */
static void add_shifted(moments *to, const moments *from, uint64_t times, int64_t gain)
{
    mpz_t more, step;
    mpz_init(more);
    mpz_init_set_si(step, gain);
    mpz_addmul_ui(to->count, from->count, times);
    mpz_set(more, from->sum);
    mpz_addmul(more, from->count, step);
    mpz_addmul_ui(to->sum, more, times);
    mpz_add(more, more, from->sum); /* (v + g)^2 = v^2 + g (2 v + g) */
    mpz_mul(more, more, step);
    mpz_add(more, more, from->squares);
    mpz_addmul_ui(to->squares, more, times);
    to->least = from->least + gain < to->least ? from->least + gain : to->least;
    to->most = from->most + gain > to->most ? from->most + gain : to->most;
    mpz_clears(more, step, NULL);
}

/* The plan without trays, which has the start value. */
static tn_status begin(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const adding *s = context;
    moments *start = element;
    int64_t first = tn_weighed_start(s->weighed, 0);
    (void)layer, (void)state, (void)error;
    mpz_set_ui(start->count, 1);
    mpz_set_si(start->sum, first);
    mpz_mul(start->squares, start->sum, start->sum);
    start->least = start->most = first;
    return TN_OK;
}

static tn_status extend(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    const tn_weighed_edge *label = edge->label;
    (void)context, (void)error;
    add_shifted(sum, element, label->trays, label->gain[0]);
    return TN_OK;
}

/* The plans that end here. */
static tn_status end(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const adding *s = context;
    (void)error;
    if (layer >= s->min && tn_weighed_ends(s->weighed, state))
        add_shifted(s->all, element, 1, tn_weighed_rest(s->weighed, state, 0));
    return TN_OK;
}

TN_WALK_ALGEBRA(moments_algebra, moments_init, moments_clear, begin, extend, end);

/* Adds all plans to `all`. */
static tn_status add_plans(tn_weighed *w, moments *all, tn_error *error)
{
    const tn_library *library = tn_weighed_library(w);
    adding s = {w, library->min, all};
    tn_layers walk = {0};
    if (library->min > library->max)
        return TN_OK;
    tn_status status = tn_walk_begin(&walk, tn_weighed_last_layer(w), false, error);
    if (status == TN_OK)
        status = tn_walk_forward(&walk, &tn_weighed_after, w, &moments_algebra, &s, sizeof(moments), error);
    tn_walk_clear(&walk, &moments_algebra, NULL);
    return status;
}

/* mean := sum / count, variance := squares / count - mean^2, all in steps of the unit. */
static void conclude(tn_measure_moments *m, const moments *all, mpq_srcptr unit)
{
    mpq_t square;
    mpz_set(m->plans, all->count);
    if (mpz_sgn(all->count) == 0)
        return;
    mpq_init(square);
    mpq_set_si(m->least, all->least, 1);
    mpq_set_si(m->most, all->most, 1);
    mpq_set_num(m->mean, all->sum);
    mpq_set_den(m->mean, all->count);
    mpq_canonicalize(m->mean);
    mpq_set_num(m->variance, all->squares);
    mpq_set_den(m->variance, all->count);
    mpq_canonicalize(m->variance);
    mpq_mul(square, m->mean, m->mean);
    mpq_sub(m->variance, m->variance, square);
    mpq_mul(m->least, m->least, unit);
    mpq_mul(m->most, m->most, unit);
    mpq_mul(m->mean, m->mean, unit);
    mpq_mul(m->variance, m->variance, unit);
    mpq_mul(m->variance, m->variance, unit);
    mpq_clear(square);
}

/* Of a quotient: by its distribution. */
static tn_status find_of_quotient(tn_measure_moments *m, tn_weighed *weighed, tn_error *error)
{
    tn_distribution d;
    tn_distribution_init(&d);
    tn_status status = tn_distribution_make(&d, weighed, error);
    if (status == TN_OK && d.count > 0) {
        mpz_set(m->plans, d.all);
        tn_distribution_value(&d, 0, m->least);
        tn_distribution_value(&d, d.count - 1, m->most);
        tn_distribution_moments(&d, m->mean, m->variance);
    }
    tn_distribution_clear(&d);
    return status;
}

tn_status tn_measure_moments_find(tn_measure_moments *m, tn_weighed *weighed, tn_error *error)
{
    bool over;
    tn_weighed_sum(weighed, 0, &over);
    if (over)
        return find_of_quotient(m, weighed, error);
    moments all;
    moments_init(NULL, &all);
    tn_status status = add_plans(weighed, &all, error);
    if (status == TN_OK)
        conclude(m, &all, tn_weighed_unit(weighed, 0));
    moments_clear(&all);
    return status;
}

tn_status tn_weighed_plans(tn_weighed *weighed, mpz_t plans, tn_error *error)
{
    moments all;
    moments_init(NULL, &all);
    tn_status status = add_plans(weighed, &all, error);
    mpz_set(plans, all.count);
    moments_clear(&all);
    return status;
}

void tn_measure_moments_init(tn_measure_moments *m)
{
    mpz_init(m->plans);
    mpq_inits(m->least, m->most, m->mean, m->variance, NULL);
}

void tn_measure_moments_clear(tn_measure_moments *m)
{
    mpz_clear(m->plans);
    mpq_clears(m->least, m->most, m->mean, m->variance, NULL);
}
