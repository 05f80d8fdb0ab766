/* Distributions: for each state how many plans lead there with which value, as polynomials in the value. */
#include "runtime/plan/measure/distribution.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/count.h"
#include "runtime/base/array.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/pareto.h"
#include "runtime/plan/measure/weighed_layers.h"

#define DENSE_MAX (INT64_C(1) << 22) /* values side by side: beyond, they are sorted */

/* The values with which plans reach a state, ascending, each with the number of those plans. Before it is summed up: of
 * what it is the sum. */
typedef struct spread {
    size_t count;
    int64_t *value;
    mp_limb_t *plans;   /* [count][limbs] */
    struct part *parts; /* NULL once summed up */
    size_t part_count, part_room;
} spread;

/* Another spread, so many times, its values more by `gain`. */
typedef struct part {
    const spread *source;
    uint64_t times;
    int64_t gain;
} part;

typedef struct pair {
    int64_t value;
    size_t index; /* of its number in `numbers` */
} pair;

typedef struct spreader {
    const tn_weighed *weighed;
    const tn_library *library;
    size_t limbs;     /* of a number of plans */
    mp_limb_t *dense; /* [DENSE_MAX][limbs], grows */
    size_t dense_room;
    pair *pairs;
    mp_limb_t *numbers;
    size_t pair_room;
    uint32_t layer;
    uint64_t words; /* of the layer that is summed up */
    uint64_t ended_words;
    spread *ended; /* those of plans that end, one for each state and length */
    size_t ended_count, ended_room;
} spreader;

static void spread_clear(void *element)
{
    spread *s = element;
    free(s->value);
    free(s->plans);
    free(s->parts);
}

/* "in steps of 1 ft2" */
static tn_status too_many(const spreader *s, tn_error *error)
{
    tn_buffer step = {0};
    tn_amount_unit unit = tn_amount_unit_of(s->library->schema, tn_weighed_power(s->weighed, 0));
    bool ok = tn_amount_write(unit, tn_weighed_unit(s->weighed, 0), &step);
    tn_fail(error, TN_LIMIT, E_TOO_MANY_VALUES,
            "measure `%.60s` has too many different values: in steps of %.40s they take more than %llu MB",
            tn_weighed_name(s->weighed, 0), ok ? step.data : "?",
            (unsigned long long)(TN_DISTRIBUTION_WORDS * sizeof(uint64_t) / 1000000));
    tn_error_help(error, "measure in rounder numbers: prices in steps of 10 or 50, lengths in whole units; or give "
                         "fewer trays with --trays");
    free(step.data);
    return TN_LIMIT;
}

/* Words of so many pairs of state and value: more than there may be are too many in any case. */
static uint64_t words_of(const spreader *s, uint64_t pairs)
{
    return pairs > TN_DISTRIBUTION_WORDS ? pairs : pairs * (s->limbs + 1);
}

/* ---- sums */

static void add_plans(mp_limb_t *to, const mp_limb_t *plans, uint64_t times, size_t limbs)
{
    tn_limbs_add(to, plans, limbs, times); /* what a prefix leads to is at most the library: no carry is lost */
}

static bool is_zero(const mp_limb_t *plans, size_t limbs)
{
    mp_limb_t any = 0;
    for (size_t i = 0; i < limbs; i++)
        any |= plans[i];
    return any == 0;
}

static bool spread_new(spread *made, size_t count, size_t limbs)
{
    made->value = malloc((count + 1) * sizeof *made->value);
    made->plans = malloc((count * limbs + 1) * sizeof *made->plans);
    return made->value && made->plans;
}

static void spread_add(spread *made, int64_t value, const mp_limb_t *plans, size_t limbs)
{
    made->value[made->count] = value;
    memcpy(made->plans + made->count++ * limbs, plans, limbs * sizeof *plans);
}

static bool sum_dense(spreader *s, spread *sum, int64_t low, size_t range)
{
    size_t limbs = s->limbs;
    if (s->dense_room < range) {
        free(s->dense);
        s->dense_room = range * 2;
        s->dense = calloc(s->dense_room * limbs, sizeof *s->dense);
        if (!s->dense) {
            s->dense_room = 0;
            return false;
        }
    }
    for (size_t p = 0; p < sum->part_count; p++) {
        const part *of = &sum->parts[p];
        for (size_t i = 0; i < of->source->count; i++)
            add_plans(s->dense + (size_t)(of->source->value[i] + of->gain - low) * limbs, of->source->plans + i * limbs,
                      of->times, limbs);
    }
    size_t count = 0;
    for (size_t v = 0; v < range; v++)
        count += !is_zero(s->dense + v * limbs, limbs);
    bool ok = spread_new(sum, count, limbs);
    for (size_t v = 0; ok && v < range; v++)
        if (!is_zero(s->dense + v * limbs, limbs))
            spread_add(sum, low + (int64_t)v, s->dense + v * limbs, limbs);
    memset(s->dense, 0, range * limbs * sizeof *s->dense);
    return ok;
}

static int compare_pairs(const void *left, const void *right)
{
    const pair *a = left, *b = right;
    return (a->value > b->value) - (a->value < b->value);
}

static bool sum_sorted(spreader *s, spread *sum, size_t cells)
{
    size_t limbs = s->limbs, count = 0;
    if (s->pair_room < cells) {
        free(s->pairs);
        free(s->numbers);
        s->pair_room = cells;
        s->pairs = malloc(cells * sizeof *s->pairs);
        s->numbers = malloc(cells * limbs * sizeof *s->numbers);
        if (!s->pairs || !s->numbers) {
            s->pair_room = 0;
            return false;
        }
    }
    for (size_t p = 0; p < sum->part_count; p++) {
        const part *of = &sum->parts[p];
        for (size_t i = 0; i < of->source->count; i++) {
            mpn_mul_1(s->numbers + count * limbs, of->source->plans + i * limbs, (mp_size_t)limbs, of->times);
            s->pairs[count] = (pair){of->source->value[i] + of->gain, count};
            count++;
        }
    }
    qsort(s->pairs, count, sizeof *s->pairs, compare_pairs);
    bool ok = spread_new(sum, count, limbs);
    for (size_t i = 0; ok && i < count; i++) {
        const mp_limb_t *plans = s->numbers + s->pairs[i].index * limbs;
        if (sum->count > 0 && sum->value[sum->count - 1] == s->pairs[i].value)
            mpn_add_n(sum->plans + (sum->count - 1) * limbs, sum->plans + (sum->count - 1) * limbs, plans,
                      (mp_size_t)limbs);
        else
            spread_add(sum, s->pairs[i].value, plans, limbs);
    }
    return ok;
}

/* Sums up the parts of a spread, of which there are some. */
static tn_status sum_up(spreader *s, spread *sum, tn_error *error)
{
    int64_t low = INT64_MAX, high = INT64_MIN;
    uint64_t cells = 0;
    for (size_t p = 0; p < sum->part_count; p++) {
        const spread *source = sum->parts[p].source;
        int64_t a = source->value[0] + sum->parts[p].gain, b = source->value[source->count - 1] + sum->parts[p].gain;
        low = a < low ? a : low;
        high = b > high ? b : high;
        cells += source->count;
    }
    bool dense = high - low < DENSE_MAX && (uint64_t)(high - low) / 64 <= cells;
    if (words_of(s, dense ? (uint64_t)(high - low) : cells) > TN_DISTRIBUTION_WORDS)
        return too_many(s, error);
    bool ok = dense ? sum_dense(s, sum, low, (size_t)(high - low) + 1) : sum_sorted(s, sum, (size_t)cells);
    s->words += words_of(s, sum->count);
    free(sum->parts);
    sum->parts = NULL;
    if (!ok)
        return tn_fail_memory(error);
    return s->words <= TN_DISTRIBUTION_WORDS ? TN_OK : too_many(s, error);
}

static bool add_part(spread *sum, part more)
{
    if (!tn_array_reserve_from(&sum->parts, &sum->part_room, 16, sum->part_count, 1, sizeof *sum->parts))
        return false;
    sum->parts[sum->part_count++] = more;
    return true;
}

/* ---- the algebra */

static void spread_init(const void *context, void *element)
{
    (void)context;
    *(spread *)element = (spread){0};
}

/* The plan without trays, which has the start value. */
static tn_status begin(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const spreader *s = context;
    spread *start = element;
    (void)layer, (void)state;
    if (!spread_new(start, 1, s->limbs))
        return tn_fail_memory(error);
    memset(start->plans, 0, s->limbs * sizeof *start->plans);
    start->plans[0] = 1;
    start->value[0] = tn_weighed_start(s->weighed, 0);
    start->count = 1;
    return TN_OK;
}

static tn_status extend(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    const tn_weighed_edge *label = edge->label;
    (void)context;
    return add_part(sum, (part){element, label->trays, label->gain[0]}) ? TN_OK : tn_fail_memory(error);
}

/* Adds the plans that end here to those of all lengths. */
static tn_status add_ended(spreader *s, uint32_t state, const spread *from, tn_error *error)
{
    s->ended_words += words_of(s, from->count);
    if (s->ended_words > TN_DISTRIBUTION_WORDS)
        return too_many(s, error);
    if (!tn_array_reserve(&s->ended, &s->ended_room, s->ended_count, 1, sizeof *s->ended))
        return tn_fail_memory(error);
    spread *made = &s->ended[s->ended_count++];
    *made = (spread){0};
    if (!spread_new(made, from->count, s->limbs))
        return tn_fail_memory(error);
    int64_t rest = tn_weighed_rest(s->weighed, state, 0);
    for (size_t v = 0; v < from->count; v++)
        spread_add(made, from->value[v] + rest, from->plans + v * s->limbs, s->limbs);
    return TN_OK;
}

static tn_status settle(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    spreader *s = context;
    spread *sum = element;
    tn_status status = TN_OK;
    if (layer != s->layer)
        s->words = 0;
    s->layer = layer;
    if (sum->part_count > 0)
        status = sum_up(s, sum, error);
    if (status == TN_OK)
        status = tn_weighed_check(s->weighed, error);
    if (status == TN_OK && layer >= s->library->min && tn_weighed_ends(s->weighed, state))
        status = add_ended(s, state, sum, error);
    return status;
}

TN_WALK_ALGEBRA(spread_algebra, spread_init, spread_clear, begin, extend, settle);

/* ---- all of them */

/* Fills the distribution from the plans that ended. */
static tn_status finish(spreader *s, tn_distribution *d, tn_error *error)
{
    spread all = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < s->ended_count; i++)
        status = add_part(&all, (part){&s->ended[i], 1, 0}) ? TN_OK : tn_fail_memory(error);
    if (s->layer < s->library->max)
        s->words = 0;
    if (status == TN_OK && s->ended_count > 0)
        status = sum_up(s, &all, error);
    if (status == TN_OK) {
        d->value = all.value;
        all.value = NULL;
        d->plans = tn_integers_new(all.count);
        d->count = d->room = d->plans ? all.count : 0;
        status = d->plans ? TN_OK : tn_fail_memory(error);
    }
    for (size_t i = 0; i < d->count; i++) {
        mpz_import(d->plans[i], s->limbs, -1, sizeof(mp_limb_t), 0, 0, all.plans + i * s->limbs);
        mpz_add(d->all, d->all, d->plans[i]);
    }
    spread_clear(&all);
    return status;
}

static tn_status make_sum(tn_distribution *d, tn_weighed *weighed, size_t limbs, tn_error *error)
{
    spreader s = {.weighed = weighed, .library = tn_weighed_library(weighed), .limbs = limbs};
    tn_layers walk = {0};
    tn_status status = tn_walk_begin(&walk, tn_weighed_last_layer(weighed), false, error);
    if (status == TN_OK)
        status = tn_walk_forward(&walk, &tn_weighed_after, weighed, &spread_algebra, &s, sizeof(spread), error);
    tn_walk_clear(&walk, &spread_algebra, NULL);
    if (status == TN_OK)
        status = finish(&s, d, error);
    for (size_t i = 0; i < s.ended_count; i++)
        spread_clear(&s.ended[i]);
    free(s.ended);
    free(s.dense);
    free(s.pairs);
    free(s.numbers);
    return status;
}

void tn_distribution_init(tn_distribution *d)
{
    *d = (tn_distribution){0};
    mpz_inits(d->all, d->without, NULL);
    mpq_init(d->unit);
}

/* ---- quotients */

typedef struct share {
    mpq_t value;
    size_t point;
} share;

static int compare_shares(const void *left, const void *right)
{
    const share *a = left, *b = right;
    return mpq_cmp(a->value, b->value);
}

/* Fills the distribution from the values that both sums have together. */
static tn_status divide(tn_distribution *d, const tn_weighed *weighed, const tn_pareto_front *joint, tn_error *error)
{
    share *shares = calloc(joint->count + 1, sizeof *shares);
    d->plans = tn_integers_new(joint->count);
    d->room = d->plans ? joint->count : 0;
    d->exact = malloc((joint->count + 1) * sizeof *d->exact);
    if (!shares || !d->plans || !d->exact) {
        free(shares);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < joint->count; i++) {
        mpq_init(shares[i].value);
        shares[i].point = i;
        tn_weighed_value(weighed, 0, joint->points[i].values, shares[i].value);
    }
    qsort(shares, joint->count, sizeof *shares, compare_shares);
    for (size_t i = 0; i < joint->count; i++) {
        if (d->count == 0 || !mpq_equal(d->exact[d->count - 1], shares[i].value)) {
            mpq_init(d->exact[d->count]);
            mpq_set(d->exact[d->count++], shares[i].value);
        }
        mpz_add(d->plans[d->count - 1], d->plans[d->count - 1], joint->points[shares[i].point].plans);
        mpz_add(d->all, d->all, joint->points[shares[i].point].plans);
        mpq_clear(shares[i].value);
    }
    free(shares);
    return TN_OK;
}

static tn_status make_quotient(tn_distribution *d, tn_weighed *weighed, tn_error *error)
{
    tn_pareto_front joint;
    tn_status status = tn_pareto_all(&joint, weighed, error);
    if (status == TN_OK)
        status = divide(d, weighed, &joint, error);
    tn_pareto_clear(&joint);
    return status;
}

tn_status tn_distribution_make(tn_distribution *d, tn_weighed *weighed, tn_error *error)
{
    mpq_set(d->unit, tn_weighed_unit(weighed, 0));
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(tn_weighed_library(weighed), TN_ALL_LENGTHS, kept);
    bool over;
    tn_weighed_sum(weighed, 0, &over);
    tn_status status = TN_OK;
    if (mpz_sgn(kept) > 0)
        status = over ? make_quotient(d, weighed, error) : make_sum(d, weighed, mpz_size(kept), error);
    mpz_sub(d->without, kept, d->all);
    mpz_clear(kept);
    return status;
}

void tn_distribution_clear(tn_distribution *d)
{
    for (size_t i = 0; d->exact && i < d->count; i++)
        mpq_clear(d->exact[i]);
    free(d->exact);
    tn_integers_free(d->plans, d->room);
    free(d->value);
    mpz_clears(d->all, d->without, NULL);
    mpq_clear(d->unit);
    *d = (tn_distribution){0};
}

void tn_distribution_value(const tn_distribution *d, size_t i, mpq_t value)
{
    if (d->exact) {
        mpq_set(value, d->exact[i]);
        return;
    }
    mpz_set_si(mpq_numref(value), d->value[i]);
    mpz_set_ui(mpq_denref(value), 1);
    mpq_mul(value, value, d->unit);
}

/* The same, number by number. */
static void moments_of_exact(const tn_distribution *d, mpq_t mean, mpq_t variance)
{
    mpq_t term, times;
    mpq_inits(term, times, NULL);
    mpq_set_ui(mean, 0, 1);
    mpq_set_ui(variance, 0, 1);
    for (size_t i = 0; i < d->count; i++) {
        mpq_set_z(times, d->plans[i]);
        mpq_mul(term, times, d->exact[i]);
        mpq_add(mean, mean, term);
        mpq_mul(term, term, d->exact[i]);
        mpq_add(variance, variance, term);
    }
    mpq_set_z(times, d->all);
    mpq_div(mean, mean, times);
    mpq_div(variance, variance, times);
    mpq_mul(term, mean, mean);
    mpq_sub(variance, variance, term);
    mpq_clears(term, times, NULL);
}

void tn_distribution_moments(const tn_distribution *d, mpq_t mean, mpq_t variance)
{
    if (d->exact) {
        moments_of_exact(d, mean, variance);
        return;
    }
    mpz_t first, second, term;
    mpz_inits(first, second, term, NULL);
    for (size_t i = 0; i < d->count; i++) {
        mpz_mul_si(term, d->plans[i], d->value[i]);
        mpz_add(first, first, term);
        mpz_mul_si(term, term, d->value[i]);
        mpz_add(second, second, term);
    }
    mpq_set_num(mean, first);
    mpq_set_den(mean, d->all);
    mpq_canonicalize(mean);
    mpq_set_num(variance, second);
    mpq_set_den(variance, d->all);
    mpq_canonicalize(variance);
    mpq_t square;
    mpq_init(square);
    mpq_mul(square, mean, mean);
    mpq_sub(variance, variance, square);
    mpq_mul(mean, mean, d->unit);
    mpq_mul(variance, variance, d->unit);
    mpq_mul(variance, variance, d->unit);
    mpq_clear(square);
    mpz_clears(first, second, term, NULL);
}

size_t tn_distribution_quartile(const tn_distribution *d, unsigned quarter)
{
    mpz_t below, wanted;
    mpz_inits(below, wanted, NULL);
    mpz_mul_ui(wanted, d->all, quarter);
    size_t i = 0;
    for (; i < d->count; i++) {
        mpz_addmul_ui(below, d->plans[i], 4);
        if (mpz_cmp(below, wanted) >= 0)
            break;
    }
    mpz_clears(below, wanted, NULL);
    return i;
}
