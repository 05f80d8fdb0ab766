/* The best plans by a quotient of two sums A / B, B above 0.
 *
 * A plan's quotient is at least r if A - r B is at least 0 (Dinkelbach: On nonlinear fractional programming, 1967). So
 * the k best by A - r B, for an r that k plans reach, all reach it; the worst quotient among them is the next r. It
 * rises until nothing changes: then it is the k-th best. Those that are better are among the k, and those that are as
 * good come in the order of the further measures and of ranks.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/int128.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/best_data.h"

typedef struct found_plan {
    tn_tray *trays;
    uint32_t length;
    int64_t values[TN_WEIGHED_MAX];
} found_plan;

struct tn_best_quotient {
    tn_weighed *weighed;
    bool most;
    bool most_of_sum[TN_WEIGHED_MAX];
    found_plan *found; /* [wanted], in order */
    size_t count, wanted, given;
    bool all; /* there are no more */
};

enum { FIRST = 16 };

static void clear_found(tn_best_quotient *best)
{
    for (size_t i = 0; i < best->count; i++)
        free(best->found[i].trays);
    free(best->found);
    best->found = NULL;
    best->count = 0;
}

void tn_best_quotient_free(tn_best_quotient *best)
{
    if (!best)
        return;
    clear_found(best);
    free(best);
}

/* The order of two quotients, as steps of the one sum by steps of the other: the better first. */
static int compare_quotients(const tn_best_quotient *best, const int64_t *a, const int64_t *b)
{
    tn_int128 left = (tn_int128)a[0] * b[1], right = (tn_int128)b[0] * a[1];
    int order = (left > right) - (left < right);
    return best->most ? -order : order;
}

/* The plans that are best by so many times the one sum and so many times the other: as many as are wanted. */
static tn_status find(tn_best_quotient *best, const int64_t *times, size_t wanted, tn_error *error)
{
    tn_best *mixture = NULL;
    uint32_t longest = tn_library_max(tn_weighed_library(best->weighed));
    clear_found(best);
    best->found = calloc(wanted + 1, sizeof *best->found);
    tn_status status = best->found ? tn_best_of_mixture(best->weighed, times, best->most_of_sum, &mixture, error)
                                   : tn_fail_memory(error);
    for (bool more = true; status == TN_OK && more && best->count < wanted;) {
        found_plan *plan = &best->found[best->count];
        plan->trays = malloc(((size_t)longest + 1) * sizeof *plan->trays);
        if (!plan->trays) {
            status = tn_fail_memory(error);
            break;
        }
        status = tn_best_next(mixture, plan->trays, &plan->length, plan->values, &more, error);
        if (status == TN_OK && more)
            best->count++;
        else
            free(plan->trays);
    }
    tn_best_free(mixture);
    return status;
}

static int64_t divisor(int64_t a, int64_t b)
{
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return llabs(a);
}

/* How many times each sum counts so that 0 is what the quotient of these values has. */
static void find_times(const tn_best_quotient *best, const int64_t *values, int64_t *times)
{
    int64_t common = divisor(values[0], values[1]), sign = best->most ? -1 : 1;
    times[0] = sign * (values[1] / common);
    times[1] = -sign * (values[0] / common);
}

/* By value, further values, length and trays: the order of ranks. */
static int compare_plans(const tn_best_quotient *best, const found_plan *a, const found_plan *b)
{
    int order = compare_quotients(best, a->values, b->values);
    for (uint32_t k = 2; order == 0 && k < tn_weighed_count(best->weighed); k++) {
        order = (a->values[k] > b->values[k]) - (a->values[k] < b->values[k]);
        order = best->most_of_sum[k] ? -order : order;
    }
    if (order == 0)
        order = (a->length > b->length) - (a->length < b->length);
    for (uint32_t i = 0; order == 0 && i < a->length; i++)
        order = (a->trays[i] > b->trays[i]) - (a->trays[i] < b->trays[i]);
    return order;
}

/* Stable and simple: all but those that are better than the last are in order already. */
static void sort(tn_best_quotient *best)
{
    for (size_t i = 1; i < best->count; i++) {
        found_plan plan = best->found[i];
        size_t at = i;
        for (; at > 0 && compare_plans(best, &plan, &best->found[at - 1]) < 0; at--)
            best->found[at] = best->found[at - 1];
        best->found[at] = plan;
    }
}

static size_t worst(const tn_best_quotient *best)
{
    size_t found = 0;
    for (size_t i = 1; i < best->count; i++)
        if (compare_quotients(best, best->found[i].values, best->found[found].values) > 0)
            found = i;
    return found;
}

/* The best, as many as are wanted. */
static tn_status refill(tn_best_quotient *best, size_t wanted, tn_error *error)
{
    int64_t reached[TN_WEIGHED_MAX], times[2] = {best->most ? -1 : 1, 0};
    for (bool first = true;; first = false) {
        tn_status status = find(best, times, wanted, error);
        if (status != TN_OK)
            return status;
        best->all = best->count < wanted;
        if (best->all)
            break;
        const int64_t *now = best->found[worst(best)].values;
        if (!first && compare_quotients(best, now, reached) == 0)
            break;
        memcpy(reached, now, sizeof reached);
        find_times(best, reached, times);
    }
    sort(best);
    best->wanted = wanted;
    return TN_OK;
}

/* No plan divides by less than 0. */
static tn_status check_divisor(tn_best_quotient *best, tn_error *error)
{
    const int64_t times[2] = {0, 1};
    tn_status status = find(best, times, 1, error);
    if (status != TN_OK || best->count == 0 || best->found[0].values[1] > 0)
        return status;
    tn_fail(error, TN_INVALID, E_QUOTIENT, "measure `%.60s` divides by a number that is below 0 for some plans",
            tn_weighed_name(best->weighed, 0));
    tn_error_help(error, "the best are found by quotients of what is above 0: `--where` can leave the other plans out");
    return TN_INVALID;
}

tn_status tn_best_quotient_new(tn_weighed *weighed, const bool *most, tn_best_quotient **out, tn_error *error)
{
    tn_best_quotient *best = calloc(1, sizeof *best);
    if (!best)
        return tn_fail_memory(error);
    best->weighed = weighed;
    best->most = most[0];
    for (uint32_t k = 1; k < tn_weighed_measures(weighed); k++)
        best->most_of_sum[k + 1] = most[k];
    tn_status status = check_divisor(best, error);
    if (status == TN_OK)
        *out = best;
    else
        tn_best_quotient_free(best);
    return status;
}

tn_status tn_best_quotient_next(tn_best_quotient *best, tn_tray *trays, uint32_t *length, int64_t *values, bool *found,
                                tn_error *error)
{
    if (best->given == best->wanted && !best->all) {
        tn_status status = refill(best, best->wanted ? 2 * best->wanted : FIRST, error);
        if (status != TN_OK)
            return status;
    }
    *found = best->given < best->count;
    if (!*found)
        return TN_OK;
    const found_plan *plan = &best->found[best->given++];
    memcpy(trays, plan->trays, plan->length * sizeof *trays);
    memcpy(values, plan->values, sizeof plan->values);
    *length = plan->length;
    return TN_OK;
}
