/* The best plans by a measure: as sums are maximised with a solver, by asking for more than the best so far, and, where
 * that is not decided within the limit, by asking for half of what there may still be. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/search/search_data.h"

typedef struct bettering {
    tn_plan_search *search;
    tn_search_values values;
    size_t wanted;
    tn_searched_plans *plans; /* the best first */
    tn_search_proof *proof;
    bool stuck; /* the limit was passed in this length */
} bettering;

/* Is there a plan whose value is one of those from `from` on? *undecided: that passes the limit. */
static tn_status find_better(bettering *b, size_t from, bool *found, bool *undecided, tn_error *error)
{
    b->search->at.assumed[0] = tn_search_values_from(&b->values, from);
    tn_error limit;
    tn_status status = tn_search_solve(b->search, 1, found, &limit);
    return tn_search_unless_undecided(status, &limit, undecided, error);
}

/* Takes the plan that the solver has found, of a value from `from` on: *value is which. */
static tn_status take_plan(bettering *b, size_t from, size_t *value, tn_error *error)
{
    tn_plan_search *search = b->search;
    tn_letters_read(&search->at.letters, search->plan);
    tn_status status = tn_plan_vm_plan(search->vm, search->plan, search->at.trays, error);
    return status == TN_OK ? tn_search_values_find(&b->values, from, value, error) : status;
}

/* Better than the worst plan that is kept, if there are enough? Else any. */
static size_t first_wanted(const bettering *b)
{
    return b->plans->count < b->wanted ? 0
                                       : tn_search_better_than(&b->values, b->plans->items[b->plans->count - 1].value);
}

/* Puts the search's plan in its place, and drops the last if there are too many. */
static tn_status keep_plan(bettering *b, size_t value, tn_error *error)
{
    tn_searched_plans *plans = b->plans;
    tn_status status = tn_searched_add(plans, b->search->plan, b->search->at.trays, error);
    if (status != TN_OK)
        return status;
    tn_searched_plan added = plans->items[plans->count - 1];
    tn_search_value(&b->values, value, added.value);
    size_t at = plans->count - 1;
    for (; at > 0 && tn_search_is_better(&b->values, added.value, plans->items[at - 1].value); at--)
        plans->items[at] = plans->items[at - 1];
    plans->items[at] = added;
    if (plans->count <= b->wanted)
        return TN_OK;
    tn_searched_plan *last = &plans->items[--plans->count];
    free(last->trays);
    mpq_clear(last->value);
    return TN_OK;
}

/* It is not known that there is no plan of this value. */
static void widen_bound(bettering *b, size_t value)
{
    mpq_t bound;
    mpq_init(bound);
    tn_search_value(&b->values, value, bound);
    if (b->proof->proven || tn_search_is_better(&b->values, bound, b->proof->bound))
        mpq_set(b->proof->bound, bound);
    b->proof->proven = false;
    mpq_clear(bound);
}

/* Between a value that a plan has (or one below all that are wanted) and the best that there may be: asks for the
 * better half of what lies between, as long as that is decided. */
static tn_status halve(bettering *b, size_t low, bool *better, size_t *value, tn_error *error)
{
    size_t high = b->values.values.sum_count;
    bool found, undecided = false;
    tn_status status = TN_OK;
    while (status == TN_OK && !undecided && low < high) {
        size_t middle = low + (high - low) / 2;
        status = find_better(b, middle, &found, &undecided, error);
        if (status != TN_OK || undecided)
            break;
        if (!found) {
            high = middle;
            continue;
        }
        status = take_plan(b, middle, value, error);
        low = *value + 1;
        *better = true;
    }
    if (status == TN_OK && low < high)
        widen_bound(b, high - 1);
    return status;
}

/* The best plan of the length that is open which is not excluded, and is wanted; *found: there is one, of this value.
 */
static tn_status find_best(bettering *b, bool *found, size_t *value, tn_error *error)
{
    size_t from = first_wanted(b);
    bool better = true;
    b->stuck = false;
    tn_status status = TN_OK;
    for (*found = false; status == TN_OK && better && !b->stuck && from < b->values.values.sum_count;) {
        status = find_better(b, from, &better, &b->stuck, error);
        if (status != TN_OK || !better)
            continue;
        status = take_plan(b, from, value, error);
        from = *value + 1;
        *found = true;
    }
    return status == TN_OK && b->stuck ? halve(b, from, found, value, error) : status;
}

static tn_status search_length(bettering *b, uint32_t length, tn_error *error)
{
    bool found = true;
    size_t value = 0;
    tn_status status = tn_search_open(b->search, length, true, error);
    if (status == TN_OK)
        status = tn_search_values_open(&b->values, error);
    for (b->stuck = false; status == TN_OK && found && !b->stuck;) {
        bool kept = false;
        status = find_best(b, &found, &value, error);
        if (status != TN_OK || !found)
            break;
        status = tn_search_judge(b->search, b->search->plan, &kept, error);
        if (status == TN_OK && kept)
            status = keep_plan(b, value, error);
        if (status == TN_OK)
            tn_search_exclude(b->search, b->search->plan);
    }
    return status;
}

tn_status tn_plan_search_best(tn_plan_search *search, uint32_t sum, bool most, size_t count, tn_searched_plans *plans,
                              tn_search_proof *proof, tn_error *error)
{
    const tn_search_options *o = &search->options;
    bettering b = {.search = search, .wanted = count, .plans = plans, .proof = proof};
    proof->proven = true;
    tn_status status = tn_search_values_new(&b.values, search, sum, most, error);
    for (uint32_t l = o->trays_min; status == TN_OK && count > 0 && l <= o->trays_max; l++)
        status = search_length(&b, l, error);
    if (status == TN_OK && plans->count == 0 && !proof->proven)
        status = tn_search_undecided(search, error);
    tn_search_close(search);
    tn_search_values_clear(&b.values);
    return status;
}
