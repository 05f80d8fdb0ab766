/* Mirror pairs: a kept plan and its reverse, where that is kept too.
 *
 * Of the plans of one length, those whose reverse is kept too fall into pairs, but for the palindromes, which are their
 * own reverse. So one of each pair leaves kept - (both - palindromes) / 2, whether or not the library is its own
 * mirror.
 *
 * Both numbers come from one automaton that reads a word u from the left and keeps (p, R): p is where the kept
 * automaton is after u, R are the states from which it accepts u reversed. u and its reverse are both kept iff p
 * accepts and R has the start. A palindrome of even length is u and its reverse, kept iff p is in R; with a tray t in
 * between, iff the state after t from p is in R. Counting goes forwards, over how many words lead to each (p, R).
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/explore.h"
#include "runtime/plan/library_data.h"

#define BOTH 1u       /* the word and its reverse are kept */
#define TURNS_HERE 2u /* the word followed by its reverse is kept */

typedef struct tn_mirror {
    const tn_dfa *kept;
    const uint64_t *weights; /* [columns] */
    uint32_t dead;
    tn_join join;
    tn_key middles; /* per state, in pairs of words (low, high): trays t so that word, t and reverse are kept */
    uint64_t effort;
    bool failed;
} tn_mirror;

/* A key is p, then the bits of R; nothing where neither can come to anything. */
static bool in_set(const uint32_t *key, uint32_t state)
{
    return key[1 + state / 32] >> (state % 32) & 1;
}

static bool mirror_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_mirror *mirror = context;
    if (size == 0)
        return true;
    const tn_dfa *kept = mirror->kept;
    uint32_t p = kept->delta[(size_t)key[0] * kept->columns + column];
    if (p == mirror->dead)
        return true;
    if (!tn_key_push(next, p))
        return false;
    mirror->effort += kept->states;
    uint32_t any = 0;
    for (uint32_t word = 0; word + 1 < size; word++) {
        uint32_t bits = 0;
        for (uint32_t q = word * 32; q < kept->states && q < word * 32 + 32; q++)
            bits |= (uint32_t)in_set(key, kept->delta[(size_t)q * kept->columns + column]) << (q % 32);
        any |= bits;
        if (!tn_key_push(next, bits))
            return false;
    }
    if (!any)
        next->size = 0;
    return true;
}

static uint8_t mirror_flags(void *context, const uint32_t *key, size_t size)
{
    tn_mirror *mirror = context;
    const tn_dfa *kept = mirror->kept;
    uint64_t middles = 0;
    for (uint32_t c = 0; size > 0 && c < kept->columns; c++)
        if (in_set(key, kept->delta[(size_t)key[0] * kept->columns + c]))
            middles += mirror->weights[c];
    if (!tn_key_push(&mirror->middles, (uint32_t)middles) || !tn_key_push(&mirror->middles, (uint32_t)(middles >> 32)))
        mirror->failed = true;
    if (size == 0)
        return 0;
    return (uint8_t)((kept->accept[key[0]] && in_set(key, 0) ? BOTH : 0) | (in_set(key, key[0]) ? TURNS_HERE : 0));
}

static uint64_t middles_of(const tn_mirror *mirror, uint32_t state)
{
    return mirror->middles.data[2 * (size_t)state] | (uint64_t)mirror->middles.data[2 * (size_t)state + 1] << 32;
}

static tn_status explore_mirror(const tn_library *library, tn_mirror *mirror, tn_dfa **out, tn_error *error)
{
    const tn_dfa *kept = library->kept;
    tn_key start = {0};
    tn_status status = tn_join_make(&mirror->join, &kept, 1, kept->letters, NULL, false, error);
    bool ok = tn_key_push(&start, 0);
    for (uint32_t word = 0; ok && word <= kept->states / 32; word++) {
        uint32_t bits = 0;
        for (uint32_t q = word * 32; q < kept->states && q < word * 32 + 32; q++)
            bits |= (uint32_t)kept->accept[q] << (q % 32);
        ok = tn_key_push(&start, bits);
    }
    if (status == TN_OK && !ok)
        status = tn_fail_memory(error);
    if (mirror->dead == 0)
        start.size = 0;
    if (status == TN_OK) {
        tn_bounds bounds = tn_bounds_make(library->max_states);
        tn_construction construction = {"library and its mirror", &mirror->join, mirror, mirror_step, mirror_flags};
        status = tn_explore_raw(&construction, &start, &mirror->effort, &bounds, out, error);
    }
    free(start.data);
    if (status == TN_OK && mirror->failed) {
        tn_dfa_free(*out);
        *out = NULL;
        status = tn_fail_memory(error);
    }
    return status;
}

/* counts[n] := both - palindromes, for every length n. */
static tn_status count_pairs(const tn_library *library, const tn_mirror *mirror, const tn_edges *edges, mpz_t *counts,
                             tn_error *error)
{
    tn_row row = {0};
    mpz_t palindromes;
    mpz_init(palindromes);
    tn_status status = tn_row_start(edges, &row, error);
    for (uint32_t n = 0; status == TN_OK; n++) {
        for (uint32_t s = 0; s < edges->states; s++)
            if (edges->accept[s] & BOTH)
                tn_row_add(&row, s, 1, counts[n]);
        for (uint32_t odd = 0; odd < 2 && (uint64_t)2 * n + odd <= library->max; odd++) {
            mpz_set_ui(palindromes, 0);
            for (uint32_t s = 0; s < edges->states; s++)
                if (odd || edges->accept[s] & TURNS_HERE)
                    tn_row_add(&row, s, odd ? middles_of(mirror, s) : 1, palindromes);
            mpz_sub(counts[2 * n + odd], counts[2 * n + odd], palindromes);
        }
        if (n == library->max)
            break;
        tn_row next = {0};
        status = tn_row_forward(edges, &row, &next, error);
        tn_row_clear(&row);
        row = next;
    }
    mpz_clear(palindromes);
    tn_row_clear(&row);
    return status;
}

static tn_status find_mirror(const tn_library *library, tn_error *error)
{
    uint64_t *weights = NULL;
    tn_status status = tn_column_weights(library->kept, library->classes, &weights, error);
    tn_mirror mirror = {.kept = library->kept, .weights = weights, .dead = tn_dfa_sink(library->kept, 0)};
    tn_dfa *pairs = NULL;
    tn_edges edges = {0};
    mpz_t *counts = tn_integers_new((size_t)library->max + 1);
    if (status == TN_OK && !counts)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = explore_mirror(library, &mirror, &pairs, error);
    if (status == TN_OK)
        status = tn_edges_make(&edges, pairs, weights, error);
    if (status == TN_OK)
        status = count_pairs(library, &mirror, &edges, counts, error);
    for (uint32_t n = 0; status == TN_OK && n <= library->max; n++) {
        mpz_t kept;
        mpz_init(kept);
        tn_library_kept(library, n, kept);
        mpz_divexact_ui(counts[n], counts[n], 2);
        mpz_sub(counts[n], kept, counts[n]);
        if (n < library->min)
            mpz_set_ui(counts[n], 0);
        mpz_clear(kept);
    }
    tn_edges_clear(&edges);
    tn_dfa_free(pairs);
    tn_join_clear(&mirror.join);
    free(mirror.middles.data);
    free(weights);
    if (status != TN_OK) {
        tn_integers_free(counts, (size_t)library->max + 1);
        return status;
    }
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
