/* The best trade-offs of some measures: from a plan, to plans that are better in one measure and in none worse, until
 * there is none; then to plans that are better than each of those found in some measure (guided improvement: Rayside,
 * Estler, Jackson: The guided improvement algorithm for exact, general-purpose, many-objective combinatorial
 * optimization, 2009). */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/search/search_data.h"

typedef struct trading {
    tn_plan_search *search;
    tn_search_values values[TN_WEIGHED_MAX];
    uint32_t count;
    size_t at[TN_WEIGHED_MAX]; /* which values the search's plan has */
    tn_tray *plan;             /* [trays_max + 1]: room */
    tn_searched_front *front;
} trading;

void tn_searched_front_clear(tn_searched_front *front)
{
    for (size_t i = 0; i < front->count; i++) {
        free(front->points[i].trays);
        for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
            mpq_clear(front->points[i].values[k]);
    }
    free(front->points);
    *front = (tn_searched_front){0};
}

/* Better in some measure than the values from[] less one. */
static tn_signal better_in_some(trading *t, const size_t *from)
{
    tn_signal gates[TN_WEIGHED_MAX];
    for (uint32_t k = 0; k < t->count; k++)
        gates[k] = tn_search_values_from(&t->values[k], from[k]);
    return tn_circuit_any(t->search->at.circuit, gates, t->count);
}

/* The same than the search's plan. */
static tn_signal better_than_this(trading *t)
{
    size_t from[TN_WEIGHED_MAX] = {0};
    for (uint32_t k = 0; k < t->count; k++)
        from[k] = t->at[k] + 1;
    return better_in_some(t, from);
}

/* What the plans of lengths before are no better than. */
static void assert_points(trading *t)
{
    for (size_t i = 0; i < t->front->count; i++) {
        size_t from[TN_WEIGHED_MAX] = {0};
        for (uint32_t k = 0; k < t->count; k++)
            from[k] = tn_search_better_than(&t->values[k], t->front->points[i].values[k]);
        tn_circuit_assert(t->search->at.circuit, better_in_some(t, from));
    }
}

static tn_status open_length(trading *t, uint32_t length, tn_error *error)
{
    tn_status status = tn_search_open(t->search, length, true, error);
    for (uint32_t k = 0; status == TN_OK && k < t->count; k++)
        status = tn_search_values_open(&t->values[k], error);
    if (status == TN_OK)
        assert_points(t);
    return status;
}

/* As tn_search_find: what is not found out may be missing. */
static tn_status find(trading *t, size_t count, bool *found, tn_error *error)
{
    tn_error limit;
    bool undecided;
    tn_status status = tn_search_find(t->search, count, found, &limit);
    status = tn_search_unless_undecided(status, &limit, &undecided, error);
    t->front->proven = t->front->proven && !undecided;
    return status;
}

/* The values of the search's plan. */
static tn_status find_values(trading *t, tn_error *error)
{
    tn_plan_search *search = t->search;
    tn_status status = tn_plan_vm_plan(search->vm, search->plan, search->at.trays, error);
    for (uint32_t k = 0; status == TN_OK && k < t->count; k++)
        status = tn_search_values_find(&t->values[k], 0, &t->at[k], error);
    return status;
}

/* Assumes values no worse than those of the search's plan. */
static void assume_values(trading *t)
{
    for (uint32_t k = 0; k < t->count; k++)
        t->search->at.assumed[k] = tn_search_values_from(&t->values[k], t->at[k]);
}

/* From the search's plan to one that none betters, as far as that is found out. */
static tn_status improve(trading *t, tn_error *error)
{
    bool found = true;
    tn_status status = find_values(t, error);
    while (status == TN_OK && found) {
        assume_values(t);
        t->search->at.assumed[t->count] = better_than_this(t);
        status = find(t, t->count + 1, &found, error);
        if (status == TN_OK && found)
            status = find_values(t, error);
    }
    return status;
}

static tn_status add_point(trading *t, tn_error *error)
{
    tn_searched_front *front = t->front;
    uint32_t length = t->search->at.trays;
    tn_tray *copy = tn_array_new((uint64_t)length + 1, sizeof *copy);
    if (!copy || !tn_array_reserve(&front->points, &front->capacity, front->count, 1, sizeof *front->points)) {
        free(copy);
        return tn_fail_memory(error);
    }
    if (length > 0)
        memcpy(copy, t->search->plan, length * sizeof *copy);
    tn_searched_point *point = &front->points[front->count++];
    *point = (tn_searched_point){.trays = copy, .length = length};
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++) {
        mpq_init(point->values[k]);
        if (k < t->count)
            tn_search_value(&t->values[k], t->at[k], point->values[k]);
    }
    return TN_OK;
}

/* The first plan with the values of the search's plan, than which none is better; the plan itself if that is not found
 * out. */
static tn_status find_first(trading *t, tn_error *error)
{
    tn_plan_search *search = t->search;
    size_t size = search->at.trays * sizeof *t->plan;
    bool found = false, undecided;
    tn_error limit;
    assume_values(t);
    search->at.fixed = t->count;
    search->has_plan = false;
    memcpy(t->plan, search->plan, size);
    tn_status status = tn_search_next_of_length(search, &found, &limit);
    status = tn_search_unless_undecided(status, &limit, &undecided, error);
    search->at.fixed = 0;
    search->has_plan = false;
    if (undecided) {
        memcpy(search->plan, t->plan, size);
        t->front->proven = false;
    } else if (status == TN_OK && !found) {
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan that was found is not found again");
    }
    return status;
}

static tn_status take_point(trading *t, tn_error *error)
{
    tn_signal better = better_than_this(t);
    tn_status status = find_first(t, error);
    if (status == TN_OK)
        status = add_point(t, error);
    tn_circuit_assert(t->search->at.circuit, better);
    return status;
}

static tn_status search_length(trading *t, uint32_t length, tn_error *error)
{
    bool found = true;
    tn_status status = open_length(t, length, error);
    while (status == TN_OK && found) {
        status = find(t, 0, &found, error);
        if (status == TN_OK && found)
            status = improve(t, error);
        if (status == TN_OK && found)
            status = take_point(t, error);
    }
    return status;
}

/* ---- all lengths */

/* Is one no worse than the other in any measure? */
static bool covers(const trading *t, const tn_searched_point *one, const tn_searched_point *other)
{
    for (uint32_t k = 0; k < t->count; k++)
        if (tn_search_is_better(&t->values[k], other->values[k], one->values[k]))
            return false;
    return true;
}

/* Is there another at least as good? No two have the same values. */
static bool is_covered(const trading *t, size_t i)
{
    const tn_searched_point *points = t->front->points;
    for (size_t j = 0; j < t->front->count; j++)
        if (j != i && covers(t, &points[j], &points[i]))
            return true;
    return false;
}

static bool comes_before(const trading *t, const tn_searched_point *one, const tn_searched_point *other)
{
    for (uint32_t k = 0; k < t->count; k++)
        if (!mpq_equal(one->values[k], other->values[k]))
            return tn_search_is_better(&t->values[k], one->values[k], other->values[k]);
    return false;
}

/* In its place among those before it. */
static void insert_point(const trading *t, tn_searched_front *sorted, tn_searched_point point)
{
    size_t at = sorted->count++;
    for (; at > 0 && comes_before(t, &point, &sorted->points[at - 1]); at--)
        sorted->points[at] = sorted->points[at - 1];
    sorted->points[at] = point;
}

/* Sorts the points; those that others are no worse than come to an end. */
static tn_status sort_points(trading *t, tn_error *error)
{
    tn_searched_front kept = {.proven = t->front->proven}, others = {0};
    size_t count = t->front->count;
    if (!tn_array_reserve(&kept.points, &kept.capacity, 0, count + 1, sizeof *kept.points) ||
        !tn_array_reserve(&others.points, &others.capacity, 0, count + 1, sizeof *others.points)) {
        free(kept.points);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < count; i++)
        insert_point(t, is_covered(t, i) ? &others : &kept, t->front->points[i]);
    free(t->front->points);
    tn_searched_front_clear(&others);
    *t->front = kept;
    return TN_OK;
}

tn_status tn_plan_search_front(tn_plan_search *search, const uint32_t *sums, const bool *most, uint32_t count,
                               tn_searched_front *front, tn_error *error)
{
    const tn_search_options *o = &search->options;
    trading t = {.search = search, .count = count, .front = front};
    front->proven = true;
    t.plan = tn_array_new((uint64_t)o->trays_max + 1, sizeof *t.plan);
    tn_status status = t.plan ? TN_OK : tn_fail_memory(error);
    for (uint32_t k = 0; status == TN_OK && k < count; k++)
        status = tn_search_values_new(&t.values[k], search, sums[k], most[k], error);
    for (uint32_t l = o->trays_min; status == TN_OK && l <= o->trays_max; l++)
        status = search_length(&t, l, error);
    if (status == TN_OK)
        status = sort_points(&t, error);
    if (status == TN_OK && front->count == 0 && !front->proven)
        status = tn_search_undecided(search, error);
    tn_search_close(search);
    for (uint32_t k = 0; k < count; k++)
        tn_search_values_clear(&t.values[k]);
    free(t.plan);
    return status;
}
