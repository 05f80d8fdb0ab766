/* Fronts: for each state the completions that no other completion betters, from the end of the plan backwards. */
#include "runtime/plan/measure/pareto.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/weighed_layers.h"

/* A completion of a state that no other betters: the first tray, and which of the child's points it goes on with. */
typedef struct point {
    int64_t value[TN_WEIGHED_MAX]; /* with the sign that makes less better */
    mpz_t plans;
    tn_tray tray;
    uint32_t child, child_point; /* child: its place in the next layer */
} point;

typedef struct front {
    point *points;
    size_t count, room;
} front;

typedef struct fronts {
    tn_weighed *weighed;
    const tn_library *library;
    int64_t sign[TN_WEIGHED_MAX];
    bool exact[TN_WEIGHED_MAX]; /* sums of which none is better: both of a quotient */
    bool any_exact, all_exact;
    size_t most;    /* points of a state */
    tn_layers walk; /* by trays to come; a node's element is its front */
} fronts;

static void front_init(const void *context, void *element)
{
    (void)context;
    *(front *)element = (front){0};
}

static void front_clear(void *element)
{
    front *f = element;
    for (size_t i = 0; i < f->count; i++)
        mpz_clear(f->points[i].plans);
    free(f->points);
}

static bool add_point(front *f, const int64_t *value, const mpz_t plans, uint64_t times, tn_tray tray, uint32_t child,
                      uint32_t child_point)
{
    if (!tn_array_reserve_from(&f->points, &f->room, 16, f->count, 1, sizeof *f->points))
        return false;
    point *p = &f->points[f->count++];
    *p = (point){.tray = tray, .child = child, .child_point = child_point};
    memcpy(p->value, value, sizeof p->value);
    mpz_init(p->plans);
    mpz_mul_ui(p->plans, plans, times);
    return true;
}

static int compare_points(const void *left, const void *right)
{
    const point *a = left, *b = right;
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        if (a->value[k] != b->value[k])
            return a->value[k] < b->value[k] ? -1 : 1;
    return (a->tray > b->tray) - (a->tray < b->tray);
}

static bool covers(const fronts *all, const point *a, const point *b)
{
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        if (a->value[k] > b->value[k] || (all->exact[k] && a->value[k] != b->value[k]))
            return false;
    return true;
}

static bool same_values(const point *a, const point *b)
{
    return memcmp(a->value, b->value, sizeof a->value) == 0;
}

/* Sorts, joins equal values (the first keeps its place: the lowest tray) and drops what another point betters. Whoever
 * betters a point comes before it; by two measures that is the last point kept. */
static void reduce(const fronts *all, front *f)
{
    size_t kept = 0;
    bool last = tn_weighed_count(all->weighed) <= 2 && !all->any_exact;
    if (f->count > 1)
        qsort(f->points, f->count, sizeof *f->points, compare_points);
    for (size_t i = 0; i < f->count; i++) {
        point *p = &f->points[i];
        bool equal = kept > 0 && same_values(&f->points[kept - 1], p), worse = false;
        if (equal)
            mpz_add(f->points[kept - 1].plans, f->points[kept - 1].plans, p->plans);
        size_t from = all->all_exact ? kept : last && kept > 0 ? kept - 1 : 0;
        for (size_t j = from; j < kept && !equal && !worse; j++)
            worse = covers(all, &f->points[j], p);
        if (equal || worse) {
            mpz_clear(p->plans);
            continue;
        }
        if (kept < i) {
            f->points[kept] = *p;
        }
        kept++;
    }
    f->count = kept;
}

static tn_status too_many(const fronts *all, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_VALUES, "%s in a state: more than %zu",
            all->all_exact ? "the sums have too many different values" : "the front has too many points", all->most);
    tn_error_help(error, "measure in rounder numbers: prices in steps of 10 or 50, lengths in whole units");
    return TN_LIMIT;
}

/* ---- the algebra */

/* The plan that ends in the state, if it is one. */
static tn_status end(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const fronts *all = context;
    int64_t value[TN_WEIGHED_MAX] = {0};
    if (layer < all->library->max || !tn_weighed_ends(all->weighed, state))
        return TN_OK;
    for (uint32_t k = 0; k < tn_weighed_count(all->weighed); k++)
        value[k] = all->sign[k] * tn_weighed_rest(all->weighed, state, k);
    mpz_t one;
    mpz_init_set_ui(one, 1);
    bool ok = add_point(element, value, one, 1, 0, 0, 0);
    mpz_clear(one);
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status extend(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    const fronts *all = context;
    const front *from = element;
    const tn_weighed_edge *label = edge->label;
    front *made = sum;
    for (size_t i = 0; i < from->count; i++) {
        const point *p = &from->points[i];
        int64_t value[TN_WEIGHED_MAX];
        for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
            value[k] = p->value[k] + all->sign[k] * label->gain[k];
        if (!add_point(made, value, p->plans, label->trays, label->first, edge->to, (uint32_t)i))
            return tn_fail_memory(error);
    }
    tn_status status = tn_weighed_check(all->weighed, error);
    if (status == TN_OK && made->count > 4 * all->most)
        reduce(all, made);
    return status == TN_OK && made->count > 4 * all->most ? too_many(all, error) : status;
}

static tn_status settle(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const fronts *all = context;
    front *made = element;
    (void)layer, (void)state;
    reduce(all, made);
    return made->count > all->most ? too_many(all, error) : TN_OK;
}

TN_WALK_ALGEBRA(front_algebra, front_init, front_clear, end, extend, settle);

/* ---- the library's front */

static tn_status fill_point(fronts *all, const point *p, uint32_t length, tn_pareto_point *out, tn_error *error)
{
    out->length = length;
    out->trays = malloc(((size_t)length + 1) * sizeof *out->trays);
    if (!out->trays)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < tn_weighed_count(all->weighed); k++)
        out->values[k] = all->sign[k] * p->value[k] + tn_weighed_start(all->weighed, k);
    mpz_set(out->plans, p->plans);
    const tn_layers *walk = &all->walk;
    uint32_t layer = walk->last - length;
    const point *at = p;
    for (uint32_t i = 0; i < length; i++) {
        const front *f = tn_walk_backward_of(walk, layer + i, at->child);
        at = &f->points[at->child_point];
        out->trays[i] = at->tray;
    }
    return TN_OK;
}

/* The fronts of all lengths as one: here a point's tray is its length. */
static tn_status join_lengths(fronts *all, front *whole, tn_error *error)
{
    const tn_library *library = all->library;
    tn_status status = TN_OK;
    for (uint32_t n = library->min; status == TN_OK && n <= library->max; n++) {
        uint32_t layer = library->max - n, start = tn_walk_at(&all->walk, layer)->start;
        if (start == TN_NO_STATE)
            continue;
        const front *f = tn_walk_backward_of(&all->walk, layer, start);
        for (size_t i = 0; status == TN_OK && i < f->count; i++) {
            const point *p = &f->points[i];
            if (!add_point(whole, p->value, p->plans, 1, n, start, (uint32_t)i))
                status = tn_fail_memory(error);
        }
    }
    reduce(all, whole);
    return status;
}

/* The front of each state with so many trays to come. */
static tn_status find_fronts(fronts *all, tn_error *error)
{
    tn_weighed *w = all->weighed;
    if (all->library->min > all->library->max)
        return TN_OK;
    tn_status status = tn_walk_begin(&all->walk, tn_weighed_last_layer(w), true, error);
    if (status == TN_OK)
        status = tn_walk_forward(&all->walk, &tn_weighed_to_come, w, NULL, NULL, 0, error);
    if (status == TN_OK)
        status = tn_walk_backward(&all->walk, &tn_weighed_to_come, w, &front_algebra, all, sizeof(front), error);
    return status;
}

/* The points of all sums that are not bettered, each with a plan. */
static tn_status make_points(tn_pareto_front *out, fronts *all, tn_error *error)
{
    front whole = {0};
    tn_status status = find_fronts(all, error);
    if (status == TN_OK)
        status = join_lengths(all, &whole, error);
    if (status == TN_OK && !(out->points = calloc(whole.count + 1, sizeof *out->points)))
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < whole.count; i++) {
        mpz_init(out->points[out->count].plans);
        status = fill_point(all, &whole.points[i], whole.points[i].tray, &out->points[out->count], error);
        out->count++;
    }
    front_clear(&whole);
    tn_walk_clear(&all->walk, NULL, &front_algebra);
    return status;
}

/* ---- quotients: what is not bettered by their values */

/* A point with the values of its measures, with the sign that makes less better. */
typedef struct measured {
    tn_pareto_point point;
    mpq_t value[TN_WEIGHED_MAX];
    uint32_t measures;
} measured;

static int compare_ranks(const tn_pareto_point *a, const tn_pareto_point *b)
{
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    for (uint32_t i = 0; i < a->length; i++)
        if (a->trays[i] != b->trays[i])
            return a->trays[i] < b->trays[i] ? -1 : 1;
    return 0;
}

static int compare_measured(const void *left, const void *right)
{
    const measured *a = left, *b = right;
    for (uint32_t k = 0; k < a->measures; k++) {
        int order = mpq_cmp(a->value[k], b->value[k]);
        if (order != 0)
            return order;
    }
    return compare_ranks(&a->point, &b->point);
}

static bool betters(const measured *a, const measured *b)
{
    for (uint32_t k = 0; k < a->measures; k++)
        if (mpq_cmp(a->value[k], b->value[k]) > 0)
            return false;
    return true;
}

static bool same_measures(const measured *a, const measured *b)
{
    for (uint32_t k = 0; k < a->measures; k++)
        if (!mpq_equal(a->value[k], b->value[k]))
            return false;
    return true;
}

static void point_clear(tn_pareto_point *p)
{
    mpz_clear(p->plans);
    free(p->trays);
}

/* Those of the points that no other betters, in order; points of the same values are one. */
static void keep_best(tn_pareto_front *out, measured *points)
{
    size_t kept = 0, count = out->count;
    if (count > 1)
        qsort(points, count, sizeof *points, compare_measured);
    for (size_t i = 0; i < count; i++) {
        bool equal = kept > 0 && same_measures(&points[kept - 1], &points[i]), worse = false;
        for (size_t j = 0; j < kept && !equal && !worse; j++)
            worse = betters(&points[j], &points[i]);
        if (equal)
            mpz_add(points[kept - 1].point.plans, points[kept - 1].point.plans, points[i].point.plans);
        if (equal || worse) {
            point_clear(&points[i].point);
            continue;
        }
        measured keep = points[kept];
        points[kept++] = points[i];
        points[i] = keep; /* its numbers are cleared with the others */
    }
    out->count = kept;
    for (size_t i = 0; i < kept; i++)
        out->points[i] = points[i].point;
}

static tn_status go_by_quotients(tn_pareto_front *out, const tn_weighed *weighed, const bool *most, tn_error *error)
{
    uint32_t measures = tn_weighed_measures(weighed);
    size_t count = out->count;
    measured *points = calloc(count + 1, sizeof *points);
    if (!points)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        points[i].point = out->points[i];
        points[i].measures = measures;
        for (uint32_t k = 0; k < measures; k++) {
            mpq_init(points[i].value[k]);
            tn_weighed_value(weighed, k, out->points[i].values, points[i].value[k]);
            if (most[k])
                mpq_neg(points[i].value[k], points[i].value[k]);
        }
    }
    keep_best(out, points);
    for (size_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < measures; k++)
            mpq_clear(points[i].value[k]);
    free(points);
    return TN_OK;
}

tn_status tn_pareto_make(tn_pareto_front *out, tn_weighed *weighed, const bool *most, tn_error *error)
{
    fronts all = {.weighed = weighed, .library = tn_weighed_library(weighed), .most = TN_FRONT_MAX};
    *out = (tn_pareto_front){0};
    for (uint32_t k = 0; k < tn_weighed_measures(weighed); k++) {
        bool over;
        uint32_t sum = tn_weighed_sum(weighed, k, &over);
        all.sign[sum] = most[k] ? -1 : 1;
        if (over)
            all.sign[sum + 1] = 1;
        all.exact[sum] |= over;
        if (over)
            all.exact[sum + 1] = true;
        all.any_exact |= over;
    }
    tn_status status = make_points(out, &all, error);
    return status == TN_OK && all.any_exact ? go_by_quotients(out, weighed, most, error) : status;
}

tn_status tn_pareto_all(tn_pareto_front *out, tn_weighed *weighed, tn_error *error)
{
    fronts all = {.weighed = weighed,
                  .library = tn_weighed_library(weighed),
                  .most = TN_JOINT_MAX,
                  .any_exact = true,
                  .all_exact = true};
    *out = (tn_pareto_front){0};
    for (uint32_t k = 0; k < tn_weighed_count(weighed); k++) {
        all.sign[k] = 1;
        all.exact[k] = true;
    }
    return make_points(out, &all, error);
}

void tn_pareto_clear(tn_pareto_front *f)
{
    for (size_t i = 0; i < f->count; i++)
        point_clear(&f->points[i]);
    free(f->points);
    *f = (tn_pareto_front){0};
}
