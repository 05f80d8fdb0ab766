/* How many plans each pruning clause prunes, and how many only it prunes. */
#include <stdlib.h>

#include "runtime/plan/library_data.h"

/* Plans of the library's lengths that `dfa` accepts and the clause matches. */
static tn_status count_with(const tn_library *library, const tn_dfa *dfa, const tn_dfa *clause, mpz_t count,
                            tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(library->max_states);
    tn_dfa *both = NULL;
    tn_status status = tn_dfa_product(dfa, clause, TN_DFA_AND, "library's count", &bounds, &both, error);
    if (status == TN_OK)
        status = tn_count_range(both, library->classes, library->min, library->max, count, error);
    tn_dfa_free(both);
    return status;
}

/* base less the prunes [first, end). */
static tn_status without(const tn_library *library, tn_dfa *base, size_t first, size_t end, tn_dfa **out,
                         tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(library->max_states);
    tn_dfa *rest = tn_dfa_share(base);
    for (size_t i = first; i < end; i++) {
        tn_dfa *next = NULL;
        const tn_dfa *clause = library->clauses[library->prunes[i]];
        tn_status status = tn_dfa_product(rest, clause, TN_DFA_MINUS, "library's count", &bounds, &next, error);
        tn_dfa_free(rest);
        if (status != TN_OK)
            return status;
        rest = next;
    }
    *out = rest;
    return TN_OK;
}

/* base: the generated plans that no prune outside [first, end) matches. Halving the range shares the work of leaving
 * all but one out: count * log(count) products instead of count * count. The depth is log2 of the number of clauses. */
static tn_status count_only(const tn_library *library, tn_dfa *base, size_t first, size_t end, mpz_t *only,
                            tn_error *error)
{
    if (end - first == 1)
        return count_with(library, base, library->clauses[library->prunes[first]], only[first], error);
    size_t middle = first + (end - first) / 2;
    tn_dfa *half = NULL;
    tn_status status = without(library, base, middle, end, &half, error);
    if (status != TN_OK)
        return status;
    status = count_only(library, half, first, middle, only, error);
    tn_dfa_free(half);
    if (status != TN_OK)
        return status;
    status = without(library, base, first, middle, &half, error);
    if (status != TN_OK)
        return status;
    status = count_only(library, half, middle, end, only, error);
    tn_dfa_free(half);
    return status;
}

static tn_status find_prunes(const tn_library *library, tn_error *error)
{
    size_t count = library->prune_count;
    mpz_t *prunes = tn_integers_new(count), *only = tn_integers_new(count);
    tn_status status = prunes && only ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = count_with(library, library->generator, library->clauses[library->prunes[i]], prunes[i], error);
    if (status == TN_OK && count > 0)
        status = count_only(library, library->generator, 0, count, only, error);
    if (status != TN_OK) {
        tn_integers_free(prunes, count);
        tn_integers_free(only, count);
        return status;
    }
    library->late->prunes = prunes;
    library->late->only = only;
    library->late->prunes_found = true;
    return TN_OK;
}

size_t tn_library_prune_count(const tn_library *library)
{
    return library->prune_count;
}

tn_status tn_library_prune(const tn_library *library, size_t i, uint32_t *clause, mpz_t prunes, mpz_t only,
                           uint32_t *states, tn_error *error)
{
    *clause = (uint32_t)(library->record->clause_first + library->prunes[i]);
    *states = library->clauses[library->prunes[i]]->states;
    pthread_mutex_lock(&library->late->lock);
    tn_status status = library->late->prunes_found ? TN_OK : find_prunes(library, error);
    pthread_mutex_unlock(&library->late->lock);
    if (status != TN_OK)
        return status;
    mpz_set(prunes, library->late->prunes[i]);
    mpz_set(only, library->late->only[i]);
    return TN_OK;
}
