/* Selects by the errors in single cases, in random order. */
#include "runtime/genome/breeding/lexicase.h"

#include <math.h>
#include <stdlib.h>

void tn_lexicase_clear(tn_lexicase *l)
{
    free(l->errors);
    free(l->epsilons);
    free(l->scratch);
    *l = (tn_lexicase){0};
}

tn_status tn_lexicase_new(size_t members, size_t cases, unsigned threads, tn_lexicase *l, tn_error *error)
{
    *l = (tn_lexicase){.members = members, .cases = cases, .threads = threads};
    if (cases > TN_LEXICASE_ERRORS_MAX / members) {
        tn_fail(error, TN_LIMIT, E_POPULATION,
                "lexicase selection keeps %zu errors for each of %zu members, more than %zu together, the limit", cases,
                members, TN_LEXICASE_ERRORS_MAX);
        tn_error_help(error, "make the population smaller, fit fewer lines of data, or select by tournament");
        return TN_LIMIT;
    }
    l->errors = malloc(members * cases * sizeof *l->errors);
    l->epsilons = calloc(cases, sizeof *l->epsilons);
    l->scratch = malloc(threads * (members + cases) * sizeof *l->scratch);
    return l->errors && l->epsilons && l->scratch ? TN_OK : tn_fail_memory(error);
}

void tn_lexicase_put(tn_lexicase *l, size_t member, const double *errors)
{
    for (size_t i = 0; i < l->cases; i++)
        l->errors[i * l->members + member] = errors[i];
}

static int compare_numbers(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

/* The median of the finite numbers; they are sorted. */
static double median(double *numbers, size_t count)
{
    qsort(numbers, count, sizeof *numbers, compare_numbers);
    while (count && !isfinite(numbers[count - 1]))
        count--;
    return count == 0 ? 0 : count % 2 ? numbers[count / 2] : numbers[count / 2 - 1] / 2 + numbers[count / 2] / 2;
}

tn_status tn_lexicase_find_epsilons(tn_lexicase *l, tn_error *error)
{
    double *distances = malloc(l->members * sizeof *distances);
    if (!distances)
        return tn_fail_memory(error);
    for (size_t i = 0; i < l->cases; i++) {
        const double *errors = l->errors + i * l->members;
        for (size_t m = 0; m < l->members; m++)
            distances[m] = errors[m];
        double middle = median(distances, l->members);
        for (size_t m = 0; m < l->members; m++)
            distances[m] = fabs(errors[m] - middle);
        l->epsilons[i] = median(distances, l->members);
    }
    free(distances);
    return TN_OK;
}

/* Keeps those of the members left that are good enough in the case; returns how many. */
static size_t filter(const tn_lexicase *l, size_t number, uint32_t *left, size_t count)
{
    const double *errors = l->errors + number * l->members;
    double best = HUGE_VAL;
    for (size_t i = 0; i < count; i++)
        best = errors[left[i]] < best ? errors[left[i]] : best;
    double most = best + l->epsilons[number];
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (errors[left[i]] <= most)
            left[kept++] = left[i];
    return kept;
}

size_t tn_lexicase_select(const tn_lexicase *l, unsigned thread, tn_chance *chance)
{
    uint32_t *left = l->scratch + (size_t)thread * (l->members + l->cases), *order = left + l->members;
    size_t count = l->members;
    for (size_t i = 0; i < l->members; i++)
        left[i] = (uint32_t)i;
    for (size_t i = 0; i < l->cases; i++)
        order[i] = (uint32_t)i;
    for (size_t i = 0; i < l->cases && count > 1; i++) {
        size_t drawn = i + (size_t)tn_chance_below(chance, l->cases - i);
        uint32_t number = order[drawn];
        order[drawn] = order[i];
        count = filter(l, number, left, count);
    }
    return left[count > 1 ? tn_chance_below(chance, count) : 0];
}
