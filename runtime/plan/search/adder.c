/* Adds up numbers over gates. */
#include "runtime/plan/search/adder.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define SUMS_MAX (1u << 20) /* that are different after one step */

void tn_adder_clear(tn_adder *adder)
{
    free(adder->choices);
    free(adder->steps);
    free(adder->rest);
    free(adder->sums);
    free(adder->next);
    free(adder->gates);
    *adder = (tn_adder){.circuit = adder->circuit};
}

void tn_adder_begin(tn_adder *adder)
{
    adder->choice_count = adder->step_count = adder->sum_count = 0;
}

/* ---- steps */

static bool begin_step(tn_adder *adder, size_t choices)
{
    if (!tn_array_reserve(&adder->steps, &adder->step_capacity, adder->step_count, 1, sizeof *adder->steps) ||
        !tn_array_reserve(&adder->choices, &adder->choice_capacity, adder->choice_count, choices,
                          sizeof *adder->choices))
        return false;
    adder->steps[adder->step_count++] = adder->choice_count;
    return true;
}

static void push_choice(tn_adder *adder, tn_signal gate, int64_t adds)
{
    if (gate != TN_SIGNAL_FALSE)
        adder->choices[adder->choice_count++] = (tn_adder_choice){.adds = adds, .gate = gate};
}

tn_status tn_adder_add(tn_adder *adder, tn_signal gate, int64_t adds, tn_error *error)
{
    if (gate == TN_SIGNAL_FALSE || adds == 0)
        return TN_OK;
    if (!begin_step(adder, 2))
        return tn_fail_memory(error);
    push_choice(adder, gate, adds);
    push_choice(adder, tn_signal_not(gate), 0);
    return TN_OK;
}

tn_status tn_adder_add_one_of(tn_adder *adder, tn_signal gate, const tn_adder_choice *choices, size_t count,
                              tn_error *error)
{
    tn_signal nothing = tn_signal_not(gate);
    if (gate == TN_SIGNAL_FALSE)
        return TN_OK;
    if (!begin_step(adder, count + 1))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        if (choices[i].adds == 0)
            nothing = tn_circuit_or(adder->circuit, nothing, choices[i].gate);
        else
            push_choice(adder, tn_circuit_and(adder->circuit, gate, choices[i].gate), choices[i].adds);
    }
    push_choice(adder, nothing, 0);
    return TN_OK;
}

static size_t step_end(const tn_adder *adder, size_t step)
{
    return step + 1 < adder->step_count ? adder->steps[step + 1] : adder->choice_count;
}

static bool find_rest(tn_adder *adder)
{
    if (!tn_array_reserve(&adder->rest, &adder->rest_capacity, 0, adder->step_count + 1, sizeof *adder->rest))
        return false;
    struct tn_adder_rest rest = adder->rest[adder->step_count] = (struct tn_adder_rest){0};
    for (size_t step = adder->step_count; step-- > 0; adder->rest[step] = rest) {
        int64_t least = INT64_MAX, most = INT64_MIN;
        for (size_t i = adder->steps[step]; i < step_end(adder, step); i++) {
            int64_t adds = adder->choices[i].adds;
            least = adds < least ? adds : least;
            most = adds > most ? adds : most;
        }
        rest.low += least;
        rest.high += most;
    }
    return true;
}

/* ---- sums */

static int compare_sums(const void *left, const void *right)
{
    const tn_adder_choice *a = left, *b = right;
    if (a->adds != b->adds)
        return a->adds < b->adds ? -1 : 1;
    return (a->gate > b->gate) - (a->gate < b->gate);
}

static bool gate_room(tn_adder *adder, size_t count)
{
    return tn_array_reserve(&adder->gates, &adder->gate_capacity, 0, count, sizeof *adder->gates);
}

/* Joins the `count` sums of adder->next that are equal. */
static tn_status join_sums(tn_adder *adder, size_t count, tn_error *error)
{
    if (count > 1)
        qsort(adder->next, count, sizeof *adder->next, compare_sums);
    if (!gate_room(adder, count) ||
        !tn_array_reserve(&adder->sums, &adder->sum_capacity, 0, count, sizeof *adder->sums))
        return tn_fail_memory(error);
    adder->sum_count = 0;
    for (size_t i = 0, end; i < count; i = end) {
        size_t gates = 0;
        for (end = i; end < count && adder->next[end].adds == adder->next[i].adds; end++)
            adder->gates[gates++] = adder->next[end].gate;
        tn_signal any = tn_circuit_any(adder->circuit, adder->gates, gates);
        adder->sums[adder->sum_count++] = (tn_adder_choice){adder->next[i].adds, any};
    }
    if (adder->sum_count <= SUMS_MAX)
        return tn_circuit_status(adder->circuit, error);
    tn_fail(error, TN_LIMIT, E_SEARCH_TOO_LARGE, "a sum that is searched has more than %u values", SUMS_MAX);
    tn_error_help(error, "give fewer trays with --trays");
    return TN_LIMIT;
}

/* The sums after a step; *count of them in adder->next, some of them equal. */
static tn_status take_step(tn_adder *adder, size_t step, size_t *count, tn_error *error)
{
    size_t begin = adder->steps[step], end = step_end(adder, step);
    if (!tn_array_reserve(&adder->next, &adder->next_capacity, 0, tn_size_of(adder->sum_count, end - begin),
                          sizeof *adder->next))
        return tn_fail_memory(error);
    *count = 0;
    for (size_t s = 0; s < adder->sum_count; s++)
        for (size_t i = begin; i < end; i++) {
            tn_signal gate = tn_circuit_and(adder->circuit, adder->sums[s].gate, adder->choices[i].gate);
            int64_t sum = adder->sums[s].adds + adder->choices[i].adds;
            if (gate != TN_SIGNAL_FALSE)
                adder->next[(*count)++] = (tn_adder_choice){sum, gate};
        }
    return tn_circuit_status(adder->circuit, error);
}

typedef struct adder_test {
    tn_adder_judge *judge;
    const void *context;
    int64_t modulus;
    tn_signal met; /* by sums that are not followed any more */
} adder_test;

/* Of `count` sums after so many steps, those whose outcome is not certain are kept. */
static tn_status keep_open(tn_adder *adder, size_t step, adder_test *test, size_t *count, tn_error *error)
{
    const int64_t low = adder->rest[step].low, high = adder->rest[step].high;
    size_t kept = 0, met = 0;
    if (!gate_room(adder, *count + 1))
        return tn_fail_memory(error);
    for (size_t i = 0; i < *count; i++) {
        tn_adder_choice sum = adder->next[i];
        if (test->modulus > 0)
            sum.adds = ((sum.adds % test->modulus) + test->modulus) % test->modulus;
        tn_adder_outcome outcome = test->judge(test->context, sum.adds + low, sum.adds + high);
        if (outcome == TN_ADDER_SOME)
            adder->next[kept++] = sum;
        else if (outcome == TN_ADDER_YES)
            adder->gates[met++] = sum.gate;
    }
    *count = kept;
    adder->gates[met++] = test->met;
    test->met = tn_circuit_any(adder->circuit, adder->gates, met);
    return TN_OK;
}

static tn_status begin_sums(tn_adder *adder, int64_t from, tn_error *error)
{
    if (!find_rest(adder) || !tn_array_reserve(&adder->next, &adder->next_capacity, 0, 1, sizeof *adder->next))
        return tn_fail_memory(error);
    adder->next[0] = (tn_adder_choice){from, TN_SIGNAL_TRUE};
    return TN_OK;
}

static tn_status add_up(tn_adder *adder, int64_t from, adder_test *test, tn_error *error)
{
    size_t count = 1;
    tn_status status = begin_sums(adder, from, error);
    for (size_t step = 0; status == TN_OK && step <= adder->step_count; step++) {
        if (test)
            status = keep_open(adder, step, test, &count, error);
        if (status == TN_OK)
            status = join_sums(adder, count, error);
        if (status == TN_OK && step < adder->step_count)
            status = take_step(adder, step, &count, error);
    }
    return status;
}

tn_status tn_adder_test(tn_adder *adder, int64_t from, int64_t modulus, tn_adder_judge *judge, const void *context,
                        tn_signal *gate, tn_error *error)
{
    adder_test test = {.judge = judge, .context = context, .modulus = modulus, .met = TN_SIGNAL_FALSE};
    tn_status status = add_up(adder, from, &test, error);
    *gate = test.met;
    return status;
}

tn_status tn_adder_sums(tn_adder *adder, int64_t from, tn_error *error)
{
    return add_up(adder, from, NULL, error);
}
