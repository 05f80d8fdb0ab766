/* How many plans each pruning clause prunes, and how many only it prunes. */
#include <stdlib.h>

#include "runtime/plan/library_data.h"

/* Plans of the library's lengths that `base` accepts and the clause matches. Counting needs no minimal automaton. */
static tn_status count_with(const tn_library *library, const tn_sparse *base, const tn_dfa *clause, mpz_t count,
                            tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(library->max_joint);
    tn_sparse *both = NULL;
    tn_status status = tn_sparse_product(base, clause, TN_DFA_AND, "library", &bounds, &both, error);
    if (status == TN_OK)
        status = tn_count_range(both, library->classes, library->min, library->max, count, error);
    tn_sparse_free(both);
    return status;
}

/* The prune that is applied as number `i`: those that grow the automaton least come first here too. */
static const tn_dfa *ordered_clause(const tn_library *library, size_t i)
{
    return library->clauses[library->prunes[library->order[i]]];
}

/* base less the prunes applied as numbers [first, end). */
static tn_status without(const tn_library *library, const tn_sparse *base, size_t first, size_t end, tn_sparse **out,
                         tn_error *error)
{
    *out = NULL;
    tn_status status = tn_sparse_minimise(base, out, error); /* a copy */
    for (size_t i = first; status == TN_OK && i < end; i++)
        status = tn_library_apply(library, ordered_clause(library, i), TN_DFA_MINUS, out, error);
    if (status != TN_OK) {
        tn_sparse_free(*out);
        *out = NULL;
    }
    return status;
}

/* base: the generated plans that no prune but those applied as numbers [first, end) matches. Halving the range shares
 * the work of leaving all but one out: count * log(count) products instead of count * count. The depth is log2 of the
 * number of clauses. */
static tn_status count_only(const tn_library *library, const tn_sparse *base, size_t first, size_t end, mpz_t *only,
                            tn_error *error)
{
    if (end - first == 1)
        return count_with(library, base, ordered_clause(library, first), only[library->order[first]], error);
    size_t middle = first + (end - first) / 2;
    tn_sparse *half = NULL;
    tn_status status = without(library, base, middle, end, &half, error);
    if (status != TN_OK)
        return status;
    status = count_only(library, half, first, middle, only, error);
    tn_sparse_free(half);
    if (status != TN_OK)
        return status;
    status = without(library, base, first, middle, &half, error);
    if (status != TN_OK)
        return status;
    status = count_only(library, half, middle, end, only, error);
    tn_sparse_free(half);
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
