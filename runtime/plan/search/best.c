/* The best plans by a measure: as sums are maximised with a solver, by asking for more than the best so far, and, where
 * that is not decided within the limit, by asking for half of what there may still be. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/search/search_data.h"

typedef struct bettering {
    tn_plan_search *search;
    uint32_t index; /* of the SUM record */
    tn_sum *sum;
    bool most;
    size_t wanted;
    tn_searched_plans *plans; /* the best first */
    tn_search_proof *proof;
    tn_adder values;  /* of the length that is open: all that there may be, the worst first */
    tn_signal *gates; /* room */
    tn_signal has;
    bool stuck; /* the limit was passed in this length */
} bettering;

static void value_of(const bettering *b, int64_t steps, mpq_t value)
{
    mpz_set_si(mpq_numref(value), steps);
    mpz_set_ui(mpq_denref(value), 1);
    mpq_mul(value, value, b->sum->unit);
}

static bool is_better(const bettering *b, const mpq_t one, const mpq_t other)
{
    int order = mpq_cmp(one, other);
    return b->most ? order > 0 : order < 0;
}

/* Makes the values of the plans of a length; without gates for those that its plans cannot have. */
static tn_status open_length(bettering *b, uint32_t length, tn_error *error)
{
    tn_status status = tn_search_open(b->search, length, true, error);
    if (status != TN_OK)
        return status;
    tn_adder_clear(&b->values);
    b->values.circuit = b->search->at.circuit;
    status = tn_unrolled_value(b->search->at.unrolled, b->sum, &b->values, &b->has, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0, j = b->values.sum_count; !b->most && i + 1 < j--; i++) {
        tn_adder_choice other = b->values.sums[i];
        b->values.sums[i] = b->values.sums[j];
        b->values.sums[j] = other;
    }
    tn_circuit_assert(b->search->at.circuit, b->has);
    free(b->gates);
    b->gates = malloc((b->values.sum_count + 1) * sizeof *b->gates);
    return b->gates ? TN_OK : tn_fail_memory(error);
}

/* Is there a plan whose value is one of those from `from` on? *undecided: that passes the limit. */
static tn_status find_better(bettering *b, size_t from, bool *found, bool *undecided, tn_error *error)
{
    size_t count = 0;
    *found = *undecided = false;
    for (size_t i = from; i < b->values.sum_count; i++)
        b->gates[count++] = b->values.sums[i].gate;
    b->search->at.assumed[0] = tn_circuit_any(b->search->at.circuit, b->gates, count);
    tn_error limit;
    tn_status status = tn_search_solve(b->search, 1, found, &limit);
    *undecided = status == TN_LIMIT && limit.code == E_SEARCH_UNDECIDED;
    if (status != TN_OK && !*undecided && error)
        *error = limit;
    return *undecided ? TN_OK : status;
}

/* Takes the plan that the solver has found, of a value from `from` on: *value is which, as the interpreter says. */
static tn_status take_plan(bettering *b, size_t from, size_t *value, tn_error *error)
{
    tn_plan_search *search = b->search;
    bool has = false;
    mpq_t found, other;
    mpq_inits(found, other, NULL);
    tn_letters_read(&search->at.letters, search->plan);
    tn_status status = tn_plan_vm_plan(search->vm, search->plan, search->at.trays, error);
    if (status == TN_OK)
        status = tn_plan_vm_value(search->vm, b->index, found, &has, error);
    for (*value = from; status == TN_OK && has && *value < b->values.sum_count; ++*value) {
        value_of(b, b->values.sums[*value].adds, other);
        if (mpq_equal(found, other))
            break;
    }
    if (status == TN_OK && (!has || *value == b->values.sum_count))
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan was found that has not the value that is asked for");
    mpq_clears(found, other, NULL);
    return status;
}

/* Better than the worst plan that is kept, if there are enough? Else any. */
static size_t first_wanted(const bettering *b)
{
    size_t i = 0;
    mpq_t value;
    if (b->plans->count < b->wanted)
        return 0;
    mpq_init(value);
    for (; i < b->values.sum_count; i++) {
        value_of(b, b->values.sums[i].adds, value);
        if (is_better(b, value, b->plans->items[b->plans->count - 1].value))
            break;
    }
    mpq_clear(value);
    return i;
}

/* Puts the search's plan in its place, and drops the last if there are too many. */
static tn_status keep_plan(bettering *b, size_t value, tn_error *error)
{
    tn_searched_plans *plans = b->plans;
    tn_status status = tn_searched_add(plans, b->search->plan, b->search->at.trays, error);
    if (status != TN_OK)
        return status;
    tn_searched_plan added = plans->items[plans->count - 1];
    value_of(b, b->values.sums[value].adds, added.value);
    size_t at = plans->count - 1;
    for (; at > 0 && is_better(b, added.value, plans->items[at - 1].value); at--)
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
    value_of(b, b->values.sums[value].adds, bound);
    if (b->proof->proven || is_better(b, bound, b->proof->bound))
        mpq_set(b->proof->bound, bound);
    b->proof->proven = false;
    mpq_clear(bound);
}

/* Between a value that a plan has (or one below all that are wanted) and the best that there may be: asks for the
 * better half of what lies between, as long as that is decided. */
static tn_status halve(bettering *b, size_t low, bool *better, size_t *value, tn_error *error)
{
    size_t high = b->values.sum_count;
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
    for (*found = false; status == TN_OK && better && !b->stuck && from < b->values.sum_count;) {
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
    tn_status status = open_length(b, length, error);
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
    bettering b = {.search = search, .index = sum, .most = most, .wanted = count, .plans = plans, .proof = proof};
    proof->proven = true;
    tn_status status = tn_sum_new(search->schema, sum, &b.sum, error);
    for (uint32_t l = o->trays_min; status == TN_OK && count > 0 && l <= o->trays_max; l++)
        status = search_length(&b, l, error);
    if (status == TN_OK && plans->count == 0 && !proof->proven)
        status = tn_search_undecided(search, error);
    tn_search_close(search);
    tn_adder_clear(&b.values);
    tn_sum_free(b.sum);
    free(b.gates);
    return status;
}
