/* Moments: for each state how many plans lead there, and the sums of their values and of the squares of these. */
#include "runtime/plan/measure/moments.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/automata/numbering.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/distribution.h"

/* Of the values of the plans that lead to a state, or of all that end: how many there are, their sum, the sum of their
 * squares, the least and the most. */
typedef struct moments {
    uint32_t state;
    mpz_t count, sum, squares;
    int64_t least, most;
} moments;

typedef struct level {
    tn_numbering numbers; /* of states */
    moments *items;
    size_t room;
} level;

static void moments_init(moments *m, uint32_t state)
{
    *m = (moments){.state = state, .least = INT64_MAX, .most = INT64_MIN};
    mpz_inits(m->count, m->sum, m->squares, NULL);
}

static void moments_clear(moments *m)
{
    mpz_clears(m->count, m->sum, m->squares, NULL);
}

static void level_clear(level *l)
{
    for (uint32_t i = 0; i < l->numbers.count; i++)
        moments_clear(&l->items[i]);
    free(l->items);
    tn_numbering_clear(&l->numbers);
    *l = (level){0};
}

/* The state's moments; NULL: out of memory. */
static moments *moments_at(level *l, uint32_t state)
{
    uint32_t before = l->numbers.count;
    if (!tn_array_reserve(&l->items, &l->room, before, 1, sizeof *l->items))
        return NULL;
    uint32_t index = tn_number(&l->numbers, state);
    if (index == UINT32_MAX)
        return NULL;
    if (index == before)
        moments_init(&l->items[index], state);
    return &l->items[index];
}

/* Adds those of a state's plans, each `times` times, whose values are shifted by `gain`. */
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

/* Does a kept plan of the library's lengths follow, after n trays? */
static bool leads_on(const tn_weighed *w, uint32_t n, uint32_t state)
{
    const tn_library *library = tn_weighed_library(w);
    uint32_t low = n < library->min ? library->min - n : 0;
    for (uint32_t left = low; left <= library->max - n; left++)
        if (tn_weighed_alive(w, left, state))
            return true;
    return false;
}

static tn_status step(tn_weighed *w, const moments *from, uint32_t n, level *next, tn_error *error)
{
    const tn_weighed_edge *edges;
    size_t count;
    tn_status status = tn_weighed_edges(w, from->state, &edges, &count, error);
    for (size_t e = 0; status == TN_OK && e < count; e++) {
        if (!leads_on(w, n + 1, edges[e].target))
            continue;
        moments *to = moments_at(next, edges[e].target);
        if (!to)
            return tn_fail_memory(error);
        add_shifted(to, from, edges[e].trays, edges[e].gain[0]);
    }
    return status;
}

static tn_status walk(tn_weighed *w, moments *all, tn_error *error)
{
    const tn_library *library = tn_weighed_library(w);
    level here = {0};
    moments *start = moments_at(&here, 0);
    tn_status status = start ? TN_OK : tn_fail_memory(error);
    if (start) {
        int64_t first = tn_weighed_start(w, 0);
        mpz_set_ui(start->count, 1);
        mpz_set_si(start->sum, first);
        mpz_mul(start->squares, start->sum, start->sum);
        start->least = start->most = first;
    }
    for (uint32_t n = 0; status == TN_OK && n <= library->max; n++) {
        level next = {0};
        for (uint32_t i = 0; status == TN_OK && i < here.numbers.count; i++) {
            const moments *m = &here.items[i];
            if (n >= library->min && tn_weighed_alive(w, 0, m->state) && tn_weighed_valued(w, m->state))
                add_shifted(all, m, 1, tn_weighed_rest(w, m->state, 0));
            if (n < library->max)
                status = step(w, m, n, &next, error);
        }
        level_clear(&here);
        here = next;
    }
    level_clear(&here);
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
    const tn_library *library = tn_weighed_library(weighed);
    bool over;
    tn_weighed_sum(weighed, 0, &over);
    if (over)
        return find_of_quotient(m, weighed, error);
    moments all;
    moments_init(&all, 0);
    tn_status status = library->min <= library->max ? walk(weighed, &all, error) : TN_OK;
    if (status == TN_OK)
        conclude(m, &all, tn_weighed_unit(weighed, 0));
    moments_clear(&all);
    return status;
}

tn_status tn_weighed_plans(tn_weighed *weighed, mpz_t plans, tn_error *error)
{
    const tn_library *library = tn_weighed_library(weighed);
    moments all;
    moments_init(&all, 0);
    tn_status status = library->min <= library->max ? walk(weighed, &all, error) : TN_OK;
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
