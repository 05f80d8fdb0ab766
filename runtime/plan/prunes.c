/* How many plans each pruning clause prunes, and how many only it prunes.
 *
 * The second needs, for each clause, the plans that none of the others prunes: as many automata as large as the
 * library's own. They share what they can. Prunes are applied in the library's order, those that multiply states last;
 * those up to where the automaton is still small are `early`. The automata of the generator less the first i early
 * prunes are kept, so that leaving prune i out only takes applying the early ones after it. The late ones are joined
 * with the clause in question into one small automaton, which meets the large one once, in a product that is counted
 * and never minimised. The clauses are independent of one another and go over the threads.
 */
#include <stdlib.h>

#include "runtime/plan/library_data.h"

#define EARLY_STATES 10000u

typedef struct tn_pruning {
    const tn_library *library;
    size_t early;      /* prunes applied as numbers below this are early */
    tn_sparse **after; /* [early + 1]: the generator less the first prunes */
    mpz_t *only;       /* [prune_count], by prune */
    tn_status *status; /* [prune_count], by number; what came of each */
    tn_error *errors;
} tn_pruning;

/* The prune that is applied as number i. */
static const tn_dfa *ordered_clause(const tn_library *library, size_t i)
{
    return library->clauses[library->prunes[library->order[i]]];
}

/* Plans of the library's lengths that `base` accepts and the clause matches. */
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

/* Applies prunes while the automaton stays small. */
static tn_status apply_early(tn_pruning *pruning, tn_error *error)
{
    const tn_library *library = pruning->library;
    pruning->after = calloc(library->prune_count + 1, sizeof *pruning->after);
    if (!pruning->after)
        return tn_fail_memory(error);
    tn_status status = tn_sparse_minimise(library->generator, &pruning->after[0], error); /* a copy */
    for (size_t i = 0; status == TN_OK && i < library->prune_count; i++) {
        if (pruning->after[i]->states > EARLY_STATES)
            break;
        status = tn_sparse_minimise(pruning->after[i], &pruning->after[i + 1], error); /* a copy */
        if (status == TN_OK)
            status = tn_library_apply(library, ordered_clause(library, i), TN_DFA_MINUS, &pruning->after[i + 1], error);
        pruning->early = i + 1;
    }
    return status;
}

/* What prune `number` matches and no other late prune does. */
static tn_status join_late(const tn_pruning *pruning, size_t number, tn_dfa **out, tn_error *error)
{
    const tn_library *library = pruning->library;
    tn_bounds bounds = tn_bounds_make(library->max_joint);
    tn_dfa *joined = NULL;
    tn_status status = tn_dfa_minimise(ordered_clause(library, number), 0, &joined, error); /* a copy */
    for (size_t i = pruning->early; status == TN_OK && i < library->prune_count; i++) {
        if (i == number)
            continue;
        tn_dfa *rest = NULL;
        status = tn_dfa_product(joined, ordered_clause(library, i), TN_DFA_MINUS, "library", &bounds, &rest, error);
        tn_dfa_free(joined);
        joined = rest;
    }
    *out = joined;
    return status;
}

static tn_status count_only(const tn_pruning *pruning, size_t number, mpz_t only, tn_error *error)
{
    const tn_library *library = pruning->library;
    size_t from = number < pruning->early ? number : pruning->early;
    tn_sparse *base = NULL;
    tn_dfa *joined = NULL;
    tn_status status = tn_sparse_minimise(pruning->after[from], &base, error); /* a copy */
    for (size_t i = from + 1; status == TN_OK && i < pruning->early; i++)
        status = tn_library_apply(library, ordered_clause(library, i), TN_DFA_MINUS, &base, error);
    if (status == TN_OK)
        status = join_late(pruning, number, &joined, error);
    if (status == TN_OK)
        status = count_with(library, base, joined, only, error);
    tn_sparse_free(base);
    tn_dfa_free(joined);
    return status;
}

/* All of them; the first failure, by number, whatever the threads do. */
static tn_status count_all(tn_pruning *pruning, tn_error *error)
{
    size_t count = pruning->library->prune_count;
    const size_t *order = pruning->library->order;
    pruning->status = calloc(count + 1, sizeof *pruning->status);
    pruning->errors = calloc(count + 1, sizeof *pruning->errors);
    if (!pruning->status || !pruning->errors)
        return tn_fail_memory(error);
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t i = 0; i < count; i++)
        pruning->status[i] = count_only(pruning, i, pruning->only[order[i]], &pruning->errors[i]);
    for (size_t i = 0; i < count; i++) {
        if (pruning->status[i] == TN_OK)
            continue;
        if (error)
            *error = pruning->errors[i];
        return pruning->status[i];
    }
    return TN_OK;
}

static tn_status find_only(const tn_library *library, mpz_t *only, tn_error *error)
{
    tn_pruning pruning = {.library = library, .only = only};
    tn_status status = apply_early(&pruning, error);
    if (status == TN_OK)
        status = count_all(&pruning, error);
    for (size_t i = 0; pruning.after && i <= library->prune_count; i++)
        tn_sparse_free(pruning.after[i]);
    free(pruning.after);
    free(pruning.status);
    free(pruning.errors);
    return status;
}

static tn_status find_prunes(const tn_library *library, tn_error *error)
{
    size_t count = library->prune_count;
    mpz_t *prunes = tn_integers_new(count), *only = tn_integers_new(count);
    tn_status status = prunes && only ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = count_with(library, library->generator, library->clauses[library->prunes[i]], prunes[i], error);
    if (status == TN_OK)
        status = find_only(library, only, error);
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
