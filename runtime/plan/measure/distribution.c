/* Distributions: level by level, for each state how many plans lead there with which value. */
#include "runtime/plan/measure/distribution.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/automata/count.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/pareto.h"

#define DENSE_MAX (INT64_C(1) << 22) /* values side by side: beyond, they are sorted */

/* The values with which plans reach a state, ascending, each with the number of those plans. */
typedef struct spread {
    uint32_t state;
    size_t count;
    int64_t *value;
    mp_limb_t *plans; /* [count][limbs] */
} spread;

typedef struct level {
    spread *items;
    size_t count, room;
} level;

/* So many trays from a state of one level to a state of the next. */
typedef struct arc {
    uint32_t target, source;
    uint64_t trays;
    int64_t gain;
} arc;

typedef struct pair {
    int64_t value;
    size_t index; /* of its number in `numbers` */
} pair;

typedef struct spreader {
    tn_weighed *weighed;
    const tn_library *library;
    size_t limbs; /* of a number of plans */
    arc *arcs;
    size_t arc_count, arc_capacity;
    mp_limb_t *dense; /* [DENSE_MAX][limbs], grows */
    size_t dense_room;
    pair *pairs;
    mp_limb_t *numbers;
    size_t pair_room;
    uint64_t words; /* of the level that is made */
    uint64_t ended; /* words of the plans that have ended */
} spreader;

static void level_clear(level *l)
{
    for (size_t i = 0; i < l->count; i++) {
        free(l->items[i].value);
        free(l->items[i].plans);
    }
    free(l->items);
    *l = (level){0};
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

/* ---- one level */

static bool add_arc(spreader *s, arc a)
{
    if (!tn_array_reserve_from(&s->arcs, &s->arc_capacity, 1024, s->arc_count, 1, sizeof *s->arcs))
        return false;
    s->arcs[s->arc_count++] = a;
    return true;
}

/* Orders arcs by target. Those of one target stay in the order in which they were found: by source, then by gain. */
static bool sort_arcs(spreader *s)
{
    uint32_t states = tn_weighed_states(s->weighed);
    size_t *place = calloc((size_t)states + 1, sizeof *place);
    arc *sorted = malloc((s->arc_count + 1) * sizeof *sorted);
    if (!place || !sorted) {
        free(place);
        free(sorted);
        return false;
    }
    for (size_t i = 0; i < s->arc_count; i++)
        place[s->arcs[i].target + 1]++;
    for (uint32_t state = 0; state < states; state++)
        place[state + 1] += place[state];
    for (size_t i = 0; i < s->arc_count; i++)
        sorted[place[s->arcs[i].target]++] = s->arcs[i];
    free(place);
    free(s->arcs);
    s->arcs = sorted;
    s->arc_capacity = s->arc_count + 1;
    return true;
}

/* Does a kept plan of the library's lengths follow, after n trays? */
static bool leads_on(const spreader *s, uint32_t n, uint32_t state)
{
    uint32_t low = n < s->library->min ? s->library->min - n : 0;
    for (uint32_t left = low; left <= s->library->max - n; left++)
        if (tn_weighed_alive(s->weighed, left, state))
            return true;
    return false;
}

static tn_status find_arcs(spreader *s, const level *from, uint32_t n, tn_error *error)
{
    s->arc_count = 0;
    for (size_t i = 0; i < from->count; i++) {
        const tn_weighed_edge *edges;
        size_t count;
        tn_status status = tn_weighed_edges(s->weighed, from->items[i].state, &edges, &count, error);
        if (status != TN_OK)
            return status;
        for (size_t e = 0; e < count; e++)
            if (leads_on(s, n + 1, edges[e].target) &&
                !add_arc(s, (arc){edges[e].target, (uint32_t)i, edges[e].trays, edges[e].gain[0]}))
                return tn_fail_memory(error);
    }
    return sort_arcs(s) ? TN_OK : tn_fail_memory(error);
}

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

static bool spread_new(spread *made, uint32_t state, size_t count, size_t limbs)
{
    *made = (spread){.state = state,
                     .value = malloc((count + 1) * sizeof *made->value),
                     .plans = malloc((count * limbs + 1) * sizeof *made->plans)};
    return made->value && made->plans;
}

static void spread_add(spread *made, int64_t value, const mp_limb_t *plans, size_t limbs)
{
    made->value[made->count] = value;
    memcpy(made->plans + made->count++ * limbs, plans, limbs * sizeof *plans);
}

static bool gather_dense(spreader *s, const level *from, size_t first, size_t last, int64_t low, size_t range,
                         spread *made)
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
    for (size_t a = first; a < last; a++) {
        const spread *source = &from->items[s->arcs[a].source];
        for (size_t i = 0; i < source->count; i++)
            add_plans(s->dense + (size_t)(source->value[i] + s->arcs[a].gain - low) * limbs, source->plans + i * limbs,
                      s->arcs[a].trays, limbs);
    }
    size_t count = 0;
    for (size_t v = 0; v < range; v++)
        count += !is_zero(s->dense + v * limbs, limbs);
    bool ok = spread_new(made, s->arcs[first].target, count, limbs);
    for (size_t v = 0; ok && v < range; v++)
        if (!is_zero(s->dense + v * limbs, limbs))
            spread_add(made, low + (int64_t)v, s->dense + v * limbs, limbs);
    memset(s->dense, 0, range * limbs * sizeof *s->dense);
    return ok;
}

static int compare_pairs(const void *left, const void *right)
{
    const pair *a = left, *b = right;
    return (a->value > b->value) - (a->value < b->value);
}

static bool gather_sorted(spreader *s, const level *from, size_t first, size_t last, size_t cells, spread *made)
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
    for (size_t a = first; a < last; a++) {
        const spread *source = &from->items[s->arcs[a].source];
        for (size_t i = 0; i < source->count; i++) {
            mpn_mul_1(s->numbers + count * limbs, source->plans + i * limbs, (mp_size_t)limbs, s->arcs[a].trays);
            s->pairs[count] = (pair){source->value[i] + s->arcs[a].gain, count};
            count++;
        }
    }
    qsort(s->pairs, count, sizeof *s->pairs, compare_pairs);
    bool ok = spread_new(made, s->arcs[first].target, count, limbs);
    for (size_t i = 0; ok && i < count; i++) {
        const mp_limb_t *plans = s->numbers + s->pairs[i].index * limbs;
        if (made->count > 0 && made->value[made->count - 1] == s->pairs[i].value)
            mpn_add_n(made->plans + (made->count - 1) * limbs, made->plans + (made->count - 1) * limbs, plans,
                      (mp_size_t)limbs);
        else
            spread_add(made, s->pairs[i].value, plans, limbs);
    }
    return ok;
}

/* The state that the arcs from `first` on lead to: its spread; *next: the arc after them. */
static tn_status gather(spreader *s, const level *from, size_t first, size_t *next, spread *made, tn_error *error)
{
    int64_t low = INT64_MAX, high = INT64_MIN;
    uint64_t cells = 0;
    size_t last = first;
    for (; last < s->arc_count && s->arcs[last].target == s->arcs[first].target; last++) {
        const spread *source = &from->items[s->arcs[last].source];
        int64_t a = source->value[0] + s->arcs[last].gain, b = source->value[source->count - 1] + s->arcs[last].gain;
        low = a < low ? a : low;
        high = b > high ? b : high;
        cells += source->count;
    }
    *next = last;
    bool dense = high - low < DENSE_MAX && (uint64_t)(high - low) / 64 <= cells;
    if (words_of(s, dense ? (uint64_t)(high - low) : cells) > TN_DISTRIBUTION_WORDS)
        return too_many(s, error);
    bool ok = dense ? gather_dense(s, from, first, last, low, (size_t)(high - low) + 1, made)
                    : gather_sorted(s, from, first, last, (size_t)cells, made);
    s->words += words_of(s, made->count);
    if (!ok)
        return tn_fail_memory(error);
    return s->words <= TN_DISTRIBUTION_WORDS ? TN_OK : too_many(s, error);
}

static tn_status next_level(spreader *s, const level *from, uint32_t n, level *to, tn_error *error)
{
    *to = (level){0};
    tn_status status = find_arcs(s, from, n, error);
    size_t targets = 0;
    for (size_t a = 0; a < s->arc_count; a++)
        targets += a == 0 || s->arcs[a].target != s->arcs[a - 1].target;
    if (status == TN_OK && !(to->items = calloc(targets + 1, sizeof *to->items)))
        status = tn_fail_memory(error);
    s->words = 0;
    for (size_t a = 0; status == TN_OK && a < s->arc_count;) {
        status = gather(s, from, a, &a, &to->items[to->count], error);
        to->count++;
        if (status == TN_OK)
            status = tn_weighed_check(s->weighed, error);
    }
    return status;
}

/* ---- all of them */

/* The plans that end at a level: spreads of an imagined last state. */
static tn_status add_ended(spreader *s, const level *l, uint32_t n, level *ended, tn_error *error)
{
    if (n < s->library->min)
        return TN_OK;
    for (size_t i = 0; i < l->count; i++) {
        const spread *from = &l->items[i];
        if (!tn_weighed_alive(s->weighed, 0, from->state) || !tn_weighed_valued(s->weighed, from->state))
            continue;
        s->ended += words_of(s, from->count);
        if (s->ended > TN_DISTRIBUTION_WORDS)
            return too_many(s, error);
        if (!tn_array_reserve(&ended->items, &ended->room, ended->count, 1, sizeof *ended->items))
            return tn_fail_memory(error);
        spread *made = &ended->items[ended->count++];
        if (!spread_new(made, 0, from->count, s->limbs))
            return tn_fail_memory(error);
        int64_t rest = tn_weighed_rest(s->weighed, from->state, 0);
        for (size_t v = 0; v < from->count; v++)
            spread_add(made, from->value[v] + rest, from->plans + v * s->limbs, s->limbs);
    }
    return TN_OK;
}

static tn_status finish(spreader *s, const level *ended, tn_distribution *d, tn_error *error)
{
    s->arc_count = 0;
    for (size_t i = 0; i < ended->count; i++)
        if (!add_arc(s, (arc){0, (uint32_t)i, 1, 0}))
            return tn_fail_memory(error);
    if (ended->count == 0)
        return TN_OK;
    spread all = {0};
    size_t next;
    tn_status status = gather(s, ended, 0, &next, &all, error);
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
    free(all.value);
    free(all.plans);
    return status;
}

static tn_status walk(spreader *s, level *ended, tn_error *error)
{
    level here = {.items = calloc(1, sizeof *here.items), .count = 1};
    mp_limb_t *one = calloc(s->limbs + 1, sizeof *one);
    tn_status status = here.items && one && spread_new(here.items, 0, 1, s->limbs) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        one[0] = 1;
        spread_add(here.items, tn_weighed_start(s->weighed, 0), one, s->limbs);
    } else {
        here.count = here.items ? 1 : 0; /* half of it may be there */
    }
    for (uint32_t n = 0; status == TN_OK && n <= s->library->max; n++) {
        status = add_ended(s, &here, n, ended, error);
        level there = {0};
        if (status == TN_OK && n < s->library->max)
            status = next_level(s, &here, n, &there, error);
        level_clear(&here);
        here = there;
    }
    level_clear(&here);
    free(one);
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
    const tn_library *library = tn_weighed_library(weighed);
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    spreader s = {.weighed = weighed, .library = library, .limbs = mpz_size(kept) ? mpz_size(kept) : 1};
    level ended = {0};
    bool over;
    tn_weighed_sum(weighed, 0, &over);
    tn_status status = mpz_sgn(kept) == 0 ? TN_OK : over ? make_quotient(d, weighed, error) : walk(&s, &ended, error);
    if (status == TN_OK && !over)
        status = finish(&s, &ended, d, error);
    mpz_sub(d->without, kept, d->all);
    level_clear(&ended);
    mpz_clear(kept);
    free(s.arcs);
    free(s.dense);
    free(s.pairs);
    free(s.numbers);
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
