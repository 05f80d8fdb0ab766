/* Draws plans by search. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/plan/search/search_data.h"

/* ---- plans that were found */

void tn_searched_plans_clear(tn_searched_plans *plans)
{
    for (size_t i = 0; i < plans->count; i++) {
        free(plans->items[i].trays);
        mpq_clear(plans->items[i].value);
    }
    free(plans->items);
    *plans = (tn_searched_plans){0};
}

tn_status tn_searched_add(tn_searched_plans *plans, const tn_tray *trays, uint32_t length, tn_error *error)
{
    tn_tray *copy = tn_array_new((uint64_t)length + 1, sizeof *copy);
    if (!copy || !tn_array_reserve(&plans->items, &plans->capacity, plans->count, 1, sizeof *plans->items)) {
        free(copy);
        return tn_fail_memory(error);
    }
    if (length > 0)
        memcpy(copy, trays, length * sizeof *copy);
    tn_searched_plan *plan = &plans->items[plans->count++];
    *plan = (tn_searched_plan){.trays = copy, .length = length};
    mpq_init(plan->value);
    return TN_OK;
}

/* The order of ranks. */
static int compare_plans(const void *left, const void *right)
{
    const tn_searched_plan *a = left, *b = right;
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    for (uint32_t i = 0; i < a->length; i++)
        if (a->trays[i] != b->trays[i])
            return a->trays[i] < b->trays[i] ? -1 : 1;
    return 0;
}

/* ---- drawing */

/* Of each field of each tray, a value is guessed first. */
static void prefer_values(tn_plan_search *search, uint64_t seed, uint64_t number)
{
    const tn_schema *schema = search->schema;
    uint64_t index = 0;
    for (uint32_t k = 0; k < search->at.trays; k++)
        for (uint32_t f = 0; f < schema->field_count; f++) {
            uint32_t count = schema->value_start[f + 1] - schema->value_start[f];
            uint32_t value = (uint32_t)(tn_random64(seed, number, index++) % count);
            for (uint32_t v = 0; v + 1 < count; v++) {
                tn_signal up_to = tn_letters_up_to(&search->at.letters, k, f, v);
                tn_circuit_prefer(search->at.circuit, v >= value ? up_to : tn_signal_not(up_to));
            }
        }
}

typedef struct drawing {
    tn_plan_search *search;
    tn_searched_plans *plans;
    size_t first, wanted; /* of the plans: where those that are drawn begin, and how many there are to be in the end */
    uint64_t seed;
} drawing;

/* One more plan of the length that is open; *found: there was one. */
static tn_status draw_one(drawing *d, bool *found, tn_error *error)
{
    tn_plan_search *search = d->search;
    prefer_values(search, d->seed, d->plans->count);
    tn_status status = tn_search_find(search, 0, found, error);
    if (status != TN_OK || !*found)
        return status;
    tn_search_exclude(search, search->plan);
    return tn_searched_add(d->plans, search->plan, search->at.trays, error);
}

/* Up to `share` more plans of a length; *found: how many. */
static tn_status draw_length(drawing *d, uint32_t length, size_t share, size_t *found, tn_error *error)
{
    bool more = true;
    tn_status status = tn_search_open(d->search, length, true, error);
    for (size_t i = d->first; status == TN_OK && i < d->plans->count; i++)
        if (d->plans->items[i].length == length)
            tn_search_exclude(d->search, d->plans->items[i].trays);
    for (*found = 0; status == TN_OK && more && *found < share;) {
        status = draw_one(d, &more, error);
        *found += status == TN_OK && more;
    }
    return status;
}

/* Goes through the lengths that may have more plans, each of which gives as many, until there are enough. */
static tn_status draw_lengths(drawing *d, uint32_t min, uint32_t max, bool *ended, tn_error *error)
{
    uint32_t left = max - min + 1;
    tn_status status = TN_OK;
    for (bool first = true; status == TN_OK && left > 0 && d->plans->count < d->wanted; first = false) {
        uint32_t to_come = left;
        for (uint32_t i = 0; status == TN_OK && i <= max - min && d->plans->count < d->wanted; i++) {
            if (!first && ended[i])
                continue;
            size_t share = (d->wanted - d->plans->count + to_come - 1) / to_come, found = 0;
            status = draw_length(d, min + i, share, &found, error);
            ended[i] = found < share;
            left -= ended[i];
            to_come -= to_come > 1;
        }
    }
    return status;
}

tn_status tn_plan_search_sample(tn_plan_search *search, uint64_t seed, uint32_t min, uint32_t max, size_t count,
                                tn_searched_plans *plans, tn_error *error)
{
    const tn_search_options *o = &search->options;
    drawing d = {search, plans, plans->count, plans->count + count, seed};
    min = min < o->trays_min ? o->trays_min : min;
    max = max > o->trays_max ? o->trays_max : max;
    if (min > max)
        return TN_OK;
    bool *ended = calloc((size_t)(max - min) + 1, sizeof *ended);
    tn_status status = ended ? draw_lengths(&d, min, max, ended, error) : tn_fail_memory(error);
    if (plans->count > d.first)
        qsort(plans->items + d.first, plans->count - d.first, sizeof *plans->items, compare_plans);
    tn_search_close(search);
    free(ended);
    return status;
}
