/* Mirror pairs: a kept plan and its reverse, where that is kept too.
 *
 * Of the plans of one length, those whose reverse is kept too fall into pairs, but for the palindromes, which are their
 * own reverse. So one of each pair leaves kept - (both - palindromes) / 2, whether or not the library is its own
 * mirror.
 *
 * Both numbers are found clause by clause, since clauses have small automata and the library may not: `both` are the
 * kept plans that also meet the clauses lowered on the reversed plan (only those that are not their own mirrors change
 * anything), and the palindromes are counted by their halves (half.h), which each clause lets pass or not.
 */
#include <stdlib.h>

#include "runtime/automata/half.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/match/lower.h"

/* *both := *both of which the reverse meets a clause too. */
static tn_status apply_turned(const tn_library *library, tn_lowering *lowering, size_t clause, tn_bounds *bounds,
                              tn_sparse **both, tn_error *error)
{
    tn_dfa *turned = NULL;
    tn_status status = tn_lower_reversed(lowering, tn_library_clause(library, clause)->holds, &turned, error);
    if (status == TN_OK && !tn_dfa_equal(turned, library->clauses[clause]))
        status = tn_library_apply(library, turned, tn_library_keeping(library, clause), bounds, both, error);
    tn_dfa_free(turned);
    return status;
}

/* counts[n] += kept plans of n trays of which the reverse is kept too. */
static tn_status count_both(const tn_library *library, mpz_t *counts, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_sparse *both = NULL;
    tn_bounds bounds = tn_library_bounds(library);
    tn_status status = tn_lowering_new(library->classes, library->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, library->max);
    if (status == TN_OK)
        status = tn_sparse_copy(library->live, &both, error);
    for (size_t i = 0; status == TN_OK && i < library->record->clause_count; i++)
        status = apply_turned(library, lowering, i, &bounds, &both, error);
    if (status == TN_OK)
        status =
            tn_count_lengths(both, library->classes->size, library->max, counts, library->schema->module->watch, error);
    tn_sparse_free(both);
    tn_lowering_free(lowering);
    return status;
}

/* The halves, of at most `length` trays, of the palindromes that all clauses let pass. */
static tn_status make_halves(const tn_library *library, bool odd, uint32_t length, tn_sparse **halves, tn_error *error)
{
    tn_bounds joint = tn_library_bounds(library);
    tn_status status = tn_sparse_words(library->classes->count, 0, length, halves, error);
    for (size_t i = 0; status == TN_OK && i < library->record->clause_count; i++) {
        tn_bounds bounds = tn_bounds_make(library->max_states);
        tn_dfa *half = NULL;
        status = tn_half(library->clauses[i], odd, &bounds, &half, error);
        if (status == TN_OK)
            status = tn_library_apply(library, half, tn_library_keeping(library, i), &joint, halves, error);
        tn_dfa_free(half);
    }
    return status;
}

/* counts[n] -= kept palindromes of n trays, for even n or (odd) odd n. */
static tn_status take_palindromes(const tn_library *library, bool odd, mpz_t *counts, tn_error *error)
{
    if (odd && library->max == 0)
        return TN_OK;
    uint32_t longest = odd ? (library->max + 1) / 2 : library->max / 2;
    tn_sparse *halves = NULL;
    mpz_t *words = tn_integers_new((size_t)longest + 1);
    tn_status status = words ? make_halves(library, odd, longest, &halves, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status =
            tn_count_lengths(halves, library->classes->size, longest, words, library->schema->module->watch, error);
    for (uint32_t n = odd; status == TN_OK && n <= longest; n++)
        mpz_sub(counts[2 * n - odd], counts[2 * n - odd], words[n]);
    tn_sparse_free(halves);
    tn_integers_free(words, (size_t)longest + 1);
    return status;
}

/* counts[n] := kept plans of n trays less half of counts[n], that is without the second ones of pairs. */
static void finish_counts(const tn_library *library, mpz_t *counts)
{
    mpz_t kept;
    mpz_init(kept);
    for (uint32_t n = library->min; n <= library->max; n++) {
        tn_library_kept(library, n, kept);
        mpz_divexact_ui(counts[n], counts[n], 2);
        mpz_sub(counts[n], kept, counts[n]);
    }
    mpz_clear(kept);
}

static tn_status find_mirror(const tn_library *library, tn_error *error)
{
    mpz_t *counts = tn_integers_new((size_t)library->max + 1);
    tn_status status = counts ? count_both(library, counts, error) : tn_fail_memory(error);
    for (int odd = 0; status == TN_OK && odd < 2; odd++)
        status = take_palindromes(library, odd, counts, error);
    if (status != TN_OK) {
        tn_integers_free(counts, (size_t)library->max + 1);
        return status;
    }
    finish_counts(library, counts);
    library->late->mirror = counts;
    library->late->mirror_found = true;
    return TN_OK;
}

tn_status tn_library_kept_mirror(const tn_library *library, uint32_t length, mpz_t count, tn_error *error)
{
    pthread_mutex_lock(&library->late->lock);
    tn_status status = library->late->mirror_found ? TN_OK : find_mirror(library, error);
    pthread_mutex_unlock(&library->late->lock);
    if (status != TN_OK)
        return status;
    mpz_set_ui(count, 0);
    for (uint32_t n = library->min; n <= library->max; n++)
        if (length == TN_ALL_LENGTHS || length == n)
            mpz_add(count, count, library->late->mirror[n]);
    return TN_OK;
}

bool tn_library_mirror_first(const tn_library *library, const tn_tray *trays, uint32_t length)
{
    uint32_t state = 0;
    for (uint32_t i = length; i-- > 0;)
        state = tn_library_step(library, state, trays[i]);
    if (!library->kept->accept[state])
        return true;
    for (uint32_t i = 0; i < length / 2; i++)
        if (trays[i] != trays[length - 1 - i])
            return trays[i] < trays[length - 1 - i];
    return true;
}
