/* Selects parents. */
#include "runtime/genome/breeding/select.h"

#include <math.h>
#include <stdlib.h>

static int compare_merits(const void *left, const void *right)
{
    const tn_merit *a = left, *b = right;
    if (a->front != b->front)
        return a->front < b->front ? -1 : 1;
    if (a->room != b->room)
        return a->room > b->room ? -1 : 1;
    if (a->objectives[0] != b->objectives[0])
        return a->objectives[0] < b->objectives[0] ? -1 : 1;
    return a->index < b->index ? -1 : a->index > b->index;
}

void tn_merit_sort(tn_merit *merits, size_t count)
{
    qsort(merits, count, sizeof *merits, compare_merits);
}

/* Is a nearer to what is required than b; or as near, nowhere worse, and somewhere better? */
static bool dominates(const tn_merit *a, const tn_merit *b, size_t objectives)
{
    bool better = false;
    if (a->violation != b->violation)
        return a->violation < b->violation;
    for (size_t i = 0; i < objectives; i++) {
        if (a->objectives[i] > b->objectives[i])
            return false;
        better |= a->objectives[i] < b->objectives[i];
    }
    return better;
}

/* Fronts one after another: those that nothing left dominates. `above` counts by how many each is dominated. */
static void find_fronts(tn_merit *merits, size_t count, size_t objectives, uint32_t *above, uint32_t *front,
                        uint32_t *next)
{
    size_t size = 0;
    for (size_t i = 0; i < count; i++) {
        above[i] = 0;
        for (size_t k = 0; k < count; k++)
            above[i] += dominates(&merits[k], &merits[i], objectives);
        if (above[i] == 0)
            front[size++] = (uint32_t)i;
    }
    for (uint32_t number = 0; size; number++) {
        size_t following = 0;
        for (size_t i = 0; i < size; i++)
            merits[front[i]].front = number;
        for (size_t i = 0; i < size; i++)
            for (size_t k = 0; k < count; k++)
                if (dominates(&merits[front[i]], &merits[k], objectives) && --above[k] == 0)
                    next[following++] = (uint32_t)k;
        uint32_t *swap = front;
        front = next;
        next = swap;
        size = following;
    }
}

/* Orders positions by one objective, ties by index, so that the result is the same everywhere. */
static void sort_by(const tn_merit *merits, uint32_t *places, size_t count, size_t objective)
{
    for (size_t gap = count / 2; gap; gap /= 2) /* shell sort: fronts are small, and it needs no context */
        for (size_t i = gap; i < count; i++) {
            uint32_t moving = places[i];
            double value = merits[moving].objectives[objective];
            size_t at = i;
            for (; at >= gap; at -= gap) {
                double before = merits[places[at - gap]].objectives[objective];
                if (before < value || (before == value && places[at - gap] < moving))
                    break;
                places[at] = places[at - gap];
            }
            places[at] = moving;
        }
}

static void find_rooms(tn_merit *merits, uint32_t *places, size_t count, size_t objectives)
{
    for (size_t o = 0; o < objectives; o++) {
        sort_by(merits, places, count, o);
        double low = merits[places[0]].objectives[o], high = merits[places[count - 1]].objectives[o],
               range = high - low;
        merits[places[0]].room = merits[places[count - 1]].room = HUGE_VAL;
        for (size_t i = 1; i + 1 < count && range > 0 && isfinite(range); i++)
            merits[places[i]].room +=
                (merits[places[i + 1]].objectives[o] - merits[places[i - 1]].objectives[o]) / range;
    }
}

void tn_nsga2(tn_merit *merits, size_t count, size_t objectives, uint32_t *scratch)
{
    find_fronts(merits, count, objectives, scratch, scratch + count, scratch + 2 * count);
    for (size_t i = 0; i < count; i++)
        merits[i].room = 0;
    for (uint32_t front = 0;; front++) {
        size_t size = 0;
        for (size_t i = 0; i < count; i++)
            if (merits[i].front == front)
                scratch[size++] = (uint32_t)i;
        if (!size)
            return;
        find_rooms(merits, scratch, size, objectives);
    }
}

static size_t roulette(tn_chance *chance, const tn_merit *sorted, size_t count)
{
    double worst = 0, sum = 0;
    bool any = false;
    for (size_t i = 0; i < count; i++)
        if (isfinite(sorted[i].objectives[0]) && (!any || sorted[i].objectives[0] > worst)) {
            worst = sorted[i].objectives[0];
            any = true;
        }
    /* the worst finite one keeps a share: a hundredth of the best one's */
    double least = any ? (worst - sorted[0].objectives[0]) / 100 : 0;
    least = least > 0 ? least : 1;
    for (size_t i = 0; i < count; i++)
        sum += isfinite(sorted[i].objectives[0]) ? worst - sorted[i].objectives[0] + least : 0;
    double at = tn_chance_unit(chance) * sum;
    if (!any)
        return (size_t)tn_chance_below(chance, count);
    for (size_t i = 0; i < count; i++) {
        at -= isfinite(sorted[i].objectives[0]) ? worst - sorted[i].objectives[0] + least : 0;
        if (at < 0)
            return i;
    }
    return 0;
}

size_t tn_select(const tn_select_options *options, tn_chance *chance, const tn_merit *sorted, size_t count)
{
    size_t best = count, share;
    switch (options->selection) {
    case TN_SELECT_TRUNCATION:
        share = (size_t)((double)count * options->truncation + 0.5);
        return (size_t)tn_chance_below(chance, share ? share : 1);
    case TN_SELECT_ROULETTE:
        return roulette(chance, sorted, count);
    default:
        for (uint32_t i = 0; i < options->tournament || i == 0; i++) {
            size_t drawn = (size_t)tn_chance_below(chance, count);
            best = drawn < best ? drawn : best;
        }
        return best;
    }
}

/* ---- selects by the errors in single cases, in random order */

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
