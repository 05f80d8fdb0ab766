/* How many plans each pruning clause prunes, and how many only it prunes.
 *
 * Only prune i, applied as number i, prunes what the generator less the first i prunes holds, prune i matches, and none
 * of the later ones does. So each count starts from an automaton that is needed anyway, and goes on with ever fewer
 * plans: an automaton of its own a clause, and of hundreds of clauses most run empty early. The last clause is met in a
 * product that is counted and never minimised. The clauses are independent of one another and go over the threads.
 */
#include <stdlib.h>

#include "runtime/plan/library_data.h"

#define SAVED_EDGES (UINT64_C(1) << 24) /* of the automata kept for starting from: 128 MB */

typedef struct tn_pruning {
    const tn_library *library;
    tn_bounds bounds;  /* of each automaton's making */
    size_t *order;     /* [prune_count] */
    size_t saved;      /* automata kept */
    tn_sparse **after; /* [saved + 1]: the generator less the first prunes */
    mpz_t *only;       /* [prune_count], by prune */
    tn_status *status; /* [prune_count], by number; what came of each */
    tn_error *errors;
} tn_pruning;

/* The prune that is applied as number i. */
static const tn_dfa *ordered_clause(const tn_pruning *pruning, size_t i)
{
    return pruning->library->clauses[pruning->library->prunes[pruning->order[i]]];
}

/* What `base` accepts and the clause matches (TN_DFA_AND) or does not (TN_DFA_MINUS). */
static tn_status combine(const tn_sparse *base, const tn_dfa *clause, tn_dfa_operation operation, tn_bounds *bounds,
                         tn_sparse **out, tn_error *error)
{
    return base->folded ? tn_sparse_fold(base, clause, operation, "library", bounds, out, error)
                        : tn_sparse_product(base, clause, operation, "library", bounds, out, error);
}

/* How many of its plans of the library's lengths. */
static tn_status count_with(const tn_library *library, const tn_sparse *base, const tn_dfa *clause,
                            tn_dfa_operation operation, mpz_t count, tn_error *error)
{
    tn_bounds bounds = tn_library_bounds(library);
    tn_sparse *both = NULL;
    tn_status status = combine(base, clause, operation, &bounds, &both, error);
    if (status == TN_OK)
        status = tn_count_range(both, library->classes, library->min, library->max, count, error);
    tn_sparse_free(both);
    return status;
}

/* The generator, or what it has within the library's lengths. */
static tn_status start(const tn_library *library, bool within, tn_bounds *bounds, tn_sparse **out, tn_error *error)
{
    if (!within || library->within)
        return tn_sparse_minimise(library->generator, out, error); /* a copy */
    tn_dfa *generator = NULL;
    tn_sparse *words = NULL;
    tn_status status = tn_sparse_fill(library->generator, &generator, error);
    if (status == TN_OK)
        status = tn_sparse_words(library->classes->count, library->min, library->max, &words, error);
    if (status == TN_OK)
        status = tn_sparse_fold(words, generator, TN_DFA_AND, "library", bounds, out, error);
    tn_sparse_free(words);
    tn_dfa_free(generator);
    return status;
}

/* Applies the prunes in order and keeps what the memory for that holds. */
static tn_status save_starts(tn_pruning *pruning, bool within, tn_error *error)
{
    const tn_library *library = pruning->library;
    tn_bounds bounds = pruning->bounds;
    pruning->after = calloc(library->prune_count + 1, sizeof *pruning->after);
    if (!pruning->after)
        return tn_fail_memory(error);
    tn_status status = start(library, within, &bounds, &pruning->after[0], error);
    if (status == TN_OK)
        status = tn_library_order(library, pruning->after[0], &pruning->order, error);
    uint64_t edges = 0;
    for (size_t i = 0; status == TN_OK && i + 1 < library->prune_count; i++) {
        tn_sparse *next = NULL;
        status = tn_sparse_minimise(pruning->after[i], &next, error); /* a copy */
        if (status == TN_OK)
            status = tn_library_apply(library, ordered_clause(pruning, i), TN_DFA_MINUS, &bounds, &next, error);
        pruning->after[i + 1] = next;
        pruning->saved = i + 1;
        if (status == TN_OK)
            edges += next->first[next->states];
        if (edges > SAVED_EDGES)
            break;
    }
    return status;
}

/* *base := *base without what the prunes of these numbers match. */
static tn_status apply_prunes(const tn_pruning *pruning, size_t from, size_t to, tn_bounds *bounds, tn_sparse **base,
                              tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = from; status == TN_OK && i < to && (*base)->states > 0; i++)
        status = tn_library_apply(pruning->library, ordered_clause(pruning, i), TN_DFA_MINUS, bounds, base, error);
    return status;
}

static tn_status count_only(const tn_pruning *pruning, size_t number, mpz_t only, tn_error *error)
{
    const tn_library *library = pruning->library;
    size_t last = library->prune_count - 1, from = number < pruning->saved ? number : pruning->saved;
    tn_bounds bounds = pruning->bounds;
    tn_sparse *base = NULL;
    tn_status status = tn_sparse_minimise(pruning->after[from], &base, error); /* a copy */
    if (status == TN_OK)
        status = apply_prunes(pruning, from, number, &bounds, &base, error);
    if (status == TN_OK && number < last)
        status = tn_library_apply(library, ordered_clause(pruning, number), TN_DFA_AND, &bounds, &base, error);
    if (status == TN_OK && number < last)
        status = apply_prunes(pruning, number + 1, last, &bounds, &base, error);
    if (status == TN_OK)
        status = count_with(library, base, ordered_clause(pruning, last), number < last ? TN_DFA_MINUS : TN_DFA_AND,
                            only, error);
    tn_sparse_free(base);
    if (status == TN_LIMIT)
        tn_library_blame(library, library->prunes[pruning->order[number]], error);
    return status;
}

/* All of them; the first failure, by number, whatever the threads do. */
static tn_status count_all(tn_pruning *pruning, tn_error *error)
{
    size_t count = pruning->library->prune_count;
    const size_t *order = pruning->order;
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

/* In at most `work` steps a clause. */
static tn_status try_only(const tn_library *library, bool within, uint64_t work, mpz_t *only, tn_error *error)
{
    tn_pruning pruning = {.library = library, .bounds = tn_library_bounds(library), .only = only};
    if (work < pruning.bounds.max_work)
        pruning.bounds.max_work = work;
    tn_status status = save_starts(&pruning, within, error);
    if (status == TN_OK)
        status = count_all(&pruning, error);
    for (size_t i = 0; pruning.after && i <= library->prune_count; i++)
        tn_sparse_free(pruning.after[i]);
    free(pruning.after);
    free(pruning.order);
    free(pruning.status);
    free(pruning.errors);
    return status;
}

static tn_status find_only(const tn_library *library, mpz_t *only, tn_error *error)
{
    tn_status status = TN_LIMIT;
    if (!library->within)
        status = try_only(library, false, library->max_eager, only, error);
    return status == TN_LIMIT ? try_only(library, true, UINT64_MAX, only, error) : status;
}

static tn_status find_prunes(const tn_library *library, tn_error *error)
{
    size_t count = library->prune_count;
    mpz_t *prunes = tn_integers_new(count), *only = tn_integers_new(count);
    tn_status status = prunes && only ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status =
            count_with(library, library->generator, library->clauses[library->prunes[i]], TN_DFA_AND, prunes[i], error);
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
