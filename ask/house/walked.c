/* Goes through the houses on one plan, and puts them in order by what each is worth. */
#include "ask/house/walked.h"

#include <inttypes.h>
#include <stdlib.h>

#include "driver/house/values.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/rule/stages.h"

bool tn_walked_asked(const tn_numbered *n, const tn_house_measures *measures)
{
    bool walks = tn_numbered_walks(n);
    for (uint32_t k = 0; k < measures->count; k++)
        walks = walks || tn_measure_walks(n->form.module, &measures->of[k]->of);
    return walks;
}

uint64_t tn_walked_most(const tn_numbered *n)
{
    return n->max_houses > 0 ? n->max_houses : TN_WALKED_HOUSES_DEFAULT;
}

/* ---- found */

static tn_status check_number(tn_numbered *n, const tn_plan *plan, tn_error *error)
{
    uint64_t most = tn_walked_most(n);
    mpz_t houses;
    mpz_init(houses);
    tn_status status = tn_numbered_houses_on(n, plan->trays, (uint32_t)plan->length, houses, error);
    if (status == TN_OK && mpz_cmp_ui(houses, most) > 0) {
        status = tn_fail(error, TN_LIMIT, E_VARIANTS,
                         "measures of walks are found house by house, and there are more than %" PRIu64 " on this plan",
                         most);
        tn_error_help(error, "allow more, with --max-houses N, ask for fewer of them, with --where, or look at some: "
                             "tartan sample FILE N --plan PLAN --columns -o NAME.csv");
    }
    mpz_clear(houses);
    return status;
}

typedef struct finding {
    tn_walked_houses *walked;
    tn_house_valuer *valuer;
    uint64_t number;
} finding;

static tn_status add_house(finding *f, const tn_house_value *values, size_t count, tn_error *error)
{
    tn_walked_houses *w = f->walked;
    if (!tn_array_reserve(&w->items, &w->room, w->count, 1, sizeof *w->items))
        return tn_fail_memory(error);
    tn_walked_house *to = &w->items[w->count];
    *to = (tn_walked_house){f->number, &w->measures, malloc((count + 1) * sizeof *to->values)};
    if (!to->values)
        return tn_fail_memory(error);
    w->count++;
    for (size_t k = 0; k < count; k++) {
        mpq_init(to->values[k]);
        mpq_set(to->values[k], values[k].value);
    }
    return TN_OK;
}

static tn_status value_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    finding *f = context;
    size_t count;
    bool has = true;
    (void)stop;
    tn_status status = tn_watch_check(house->form->module->watch, error);
    if (status == TN_OK)
        status = tn_house_values_find(f->valuer, house, NULL, error);
    const tn_house_value *values = tn_house_values(f->valuer, &count);
    for (size_t k = 0; k < count; k++)
        has = has && values[k].has;
    if (status == TN_OK && has)
        status = add_house(f, values, count, error);
    f->walked->without += !has;
    f->number++;
    return status;
}

/* ---- in order */

static int compare_values(const tn_walked_house *a, const tn_walked_house *b)
{
    for (uint32_t k = 0; k < a->measures->count; k++) {
        int order = mpq_cmp(a->values[k], b->values[k]);
        if (order != 0)
            return a->measures->most[k] ? -order : order;
    }
    return 0;
}

static int compare(const void *a, const void *b)
{
    const tn_walked_house *one = a, *other = b;
    int order = compare_values(one, other);
    return order != 0 ? order : one->number < other->number ? -1 : one->number > other->number;
}

/* In no measure is a worse. */
static bool covers(const tn_walked_house *a, const tn_walked_house *b)
{
    bool covers = true;
    for (uint32_t k = 0; k < a->measures->count; k++) {
        int order = mpq_cmp(a->values[k], b->values[k]);
        covers = covers && (a->measures->most[k] ? order >= 0 : order <= 0);
    }
    return covers;
}

static void free_item(tn_walked_house *item)
{
    for (uint32_t k = 0; k < item->measures->count; k++)
        mpq_clear(item->values[k]);
    free(item->values);
}

/* What betters a house comes before it: those of equal values stay together. */
static void keep_front(tn_walked_houses *w)
{
    size_t kept = 0;
    for (size_t i = 0; i < w->count; i++) {
        bool worse = false;
        for (size_t k = kept; k-- > 0 && !worse;)
            worse = covers(&w->items[k], &w->items[i]) && compare_values(&w->items[k], &w->items[i]) != 0;
        if (worse)
            free_item(&w->items[i]);
        else
            w->items[kept++] = w->items[i];
    }
    w->count = kept;
}

static tn_status find_points(tn_walked_houses *w, tn_error *error)
{
    w->points = malloc((w->count + 1) * sizeof *w->points);
    if (!w->points)
        return tn_fail_memory(error);
    for (size_t i = 0; i < w->count; i++)
        if (i == 0 || compare_values(&w->items[i - 1], &w->items[i]) != 0)
            w->points[w->point_count++] = i;
    w->points[w->point_count] = w->count;
    return TN_OK;
}

/* ---- asked */

tn_status tn_walked_find(tn_numbered *n, const tn_plan *plan, const tn_house_measures *measures, bool front,
                         tn_walked_houses *walked, tn_error *error)
{
    tn_house_measured of[TN_WEIGHED_MAX];
    finding f = {.walked = walked};
    mpz_t first;
    *walked = (tn_walked_houses){.n = n, .plan = plan, .measures = *measures};
    for (uint32_t k = 0; k < measures->count; k++)
        of[k] = measures->of[k]->of;
    mpz_init(first);
    tn_status status = check_number(n, plan, error);
    if (status == TN_OK)
        status = tn_house_valuer_new(&n->form, plan->length, of, measures->count, &f.valuer, error);
    if (status == TN_OK)
        status = tn_numbered_each(n, plan->trays, (uint32_t)plan->length, first, value_house, &f, error);
    mpz_clear(first);
    tn_house_valuer_free(f.valuer);
    if (status != TN_OK)
        return status;
    if (walked->count > 0)
        qsort(walked->items, walked->count, sizeof *walked->items, compare);
    if (front)
        keep_front(walked);
    return find_points(walked, error);
}

void tn_walked_clear(tn_walked_houses *walked)
{
    for (size_t i = 0; i < walked->count; i++)
        free_item(&walked->items[i]);
    free(walked->items);
    free(walked->points);
    *walked = (tn_walked_houses){0};
}

tn_status tn_walked_each(const tn_walked_houses *w, size_t point, tn_house_each *each, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    bool stop = false;
    mpz_t number;
    mpz_init(number);
    for (size_t i = w->points[point]; status == TN_OK && !stop && i < w->points[point + 1]; i++) {
        tn_house house;
        mpz_set_ui(number, (unsigned long)w->items[i].number);
        status = tn_numbered_at(w->n, w->plan->trays, (uint32_t)w->plan->length, number, &house, error);
        if (status == TN_OK)
            status = each(context, &house, &stop, error);
        tn_house_clear(&house);
    }
    mpz_clear(number);
    return status;
}

tn_status tn_walked_spread(const tn_walked_houses *w, tn_distribution *d, tn_error *error)
{
    d->exact = malloc((w->point_count + 1) * sizeof *d->exact);
    d->plans = tn_integers_new(w->point_count);
    if (!d->exact || !d->plans)
        return tn_fail_memory(error);
    d->room = w->point_count;
    for (size_t i = 0; i < w->point_count; i++) {
        mpq_init(d->exact[i]);
        mpq_set(d->exact[i], w->items[w->points[i]].values[0]);
        mpz_set_ui(d->plans[i], (unsigned long)(w->points[i + 1] - w->points[i]));
        d->count++;
    }
    mpz_set_ui(d->all, (unsigned long)w->count);
    mpz_set_ui(d->without, (unsigned long)w->without);
    return TN_OK;
}
