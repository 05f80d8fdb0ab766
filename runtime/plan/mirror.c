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
 *
 * Where every clause is its own mirror, so is the library: both = kept, and only the palindromes are left to count, for
 * which words of half the length suffice.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/explore.h"
#include "runtime/plan/library_data.h"
#include "runtime/plan/lower.h"

#define BOTH 1u       /* the word and its reverse are kept */
#define TURNS_HERE 2u /* the word followed by its reverse is kept */

typedef struct tn_mirror {
    const tn_sparse *live;
    const uint64_t *weights; /* [columns] */
    uint32_t *step;          /* [columns]: where p leads, of the key in hand */
    tn_inverse sources;
    tn_join join;   /* of the library's own columns, borrowed */
    size_t *bucket; /* [columns + 1]: R after each column is a run of `into` */
    tn_key into;
    tn_key middles; /* per state, in pairs of words (low, high): trays t so that word, t and reverse are kept */
    uint64_t effort;
    bool failed;
} tn_mirror;

/* A key is p, then R ascending; nothing where neither can come to anything. */
enum { PLACE, SET };

static int compare_states(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Finds what a key becomes by every column at once: edges into R, by column. */
static bool read_key(tn_mirror *mirror, const uint32_t *key, size_t size)
{
    const tn_inverse *sources = &mirror->sources;
    uint32_t columns = mirror->live->columns;
    memset(mirror->bucket, 0, ((size_t)columns + 2) * sizeof *mirror->bucket);
    memset(mirror->step, 0xff, columns * sizeof *mirror->step);
    for (size_t e = mirror->live->first[key[PLACE]]; e < mirror->live->first[key[PLACE] + 1]; e++)
        mirror->step[mirror->live->label[e]] = mirror->live->target[e];
    mirror->into.size = 0;
    for (size_t i = SET; i < size; i++)
        for (size_t e = sources->first[key[i]]; e < sources->first[key[i] + 1]; e++) {
            mirror->bucket[sources->label[e] + 2]++;
            if (!tn_key_push(&mirror->into, 0))
                return false;
        }
    mirror->effort += mirror->into.size;
    for (uint32_t c = 0; c < columns; c++)
        mirror->bucket[c + 2] += mirror->bucket[c + 1];
    for (size_t i = SET; i < size; i++)
        for (size_t e = sources->first[key[i]]; e < sources->first[key[i] + 1]; e++)
            mirror->into.data[mirror->bucket[sources->label[e] + 1]++] = sources->source[e];
    return true;
}

static bool mirror_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_mirror *mirror = context;
    if (size == 0)
        return true;
    if (column == 0 && !read_key(mirror, key, size)) /* columns come in order, key by key */
        return false;
    size_t first = mirror->bucket[column], end = mirror->bucket[column + 1];
    if (mirror->step[column] == TN_NO_STATE || first == end)
        return true;
    qsort(mirror->into.data + first, end - first, sizeof *mirror->into.data, compare_states);
    bool ok = tn_key_push(next, mirror->step[column]);
    for (size_t i = first; ok && i < end; i++)
        ok = tn_key_push(next, mirror->into.data[i]);
    return ok;
}

static bool in_set(const uint32_t *key, size_t size, uint32_t state)
{
    return bsearch(&state, key + SET, size - SET, sizeof *key, compare_states) != NULL;
}

static uint8_t mirror_flags(void *context, const uint32_t *key, size_t size)
{
    tn_mirror *mirror = context;
    const tn_sparse *live = mirror->live;
    uint64_t middles = 0;
    for (size_t e = size ? live->first[key[PLACE]] : 1; size > 0 && e < live->first[key[PLACE] + 1]; e++)
        if (in_set(key, size, live->target[e]))
            middles += mirror->weights[live->label[e]];
    if (!tn_key_push(&mirror->middles, (uint32_t)middles) || !tn_key_push(&mirror->middles, (uint32_t)(middles >> 32)))
        mirror->failed = true;
    if (size == 0)
        return 0;
    return (uint8_t)((live->accept[key[PLACE]] && in_set(key, size, 0) ? BOTH : 0) |
                     (in_set(key, size, key[PLACE]) ? TURNS_HERE : 0));
}

static uint64_t middles_of(const tn_mirror *mirror, uint32_t state)
{
    return mirror->middles.data[2 * (size_t)state] | (uint64_t)mirror->middles.data[2 * (size_t)state + 1] << 32;
}

/* The empty word: p is the start, R the accepting states. */
static bool start_key(const tn_sparse *live, tn_key *start)
{
    bool ok = live->states == 0 || tn_key_push(start, 0);
    for (uint32_t s = 0; ok && s < live->states; s++)
        if (live->accept[s])
            ok = tn_key_push(start, s);
    return ok;
}

static tn_status mirror_make(tn_mirror *mirror, const tn_library *library, tn_error *error)
{
    const tn_sparse *live = library->live;
    mirror->live = live;
    mirror->join = (tn_join){.letters = live->letters, .columns = live->columns, .column = live->column};
    mirror->step = malloc(((size_t)live->columns + 1) * sizeof *mirror->step);
    mirror->bucket = malloc(((size_t)live->columns + 2) * sizeof *mirror->bucket);
    if (!mirror->step || !mirror->bucket)
        return tn_fail_memory(error);
    return tn_inverse_make(live, &mirror->sources, error);
}

static void mirror_clear(tn_mirror *mirror)
{
    tn_inverse_clear(&mirror->sources);
    free(mirror->step);
    free(mirror->bucket);
    free(mirror->into.data);
    free(mirror->middles.data);
}

/* Words of at most `depth` trays. */
static tn_status explore_mirror(const tn_library *library, tn_mirror *mirror, uint32_t depth, tn_dfa **out,
                                tn_error *error)
{
    tn_key start = {0};
    tn_status status = start_key(library->live, &start) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        tn_bounds bounds = tn_bounds_make(library->max_joint);
        tn_construction construction = {.what = "library and its mirror",
                                        .join = &mirror->join,
                                        .max_depth = depth ? depth : 1,
                                        .context = mirror,
                                        .step = mirror_step,
                                        .accepts = mirror_flags};
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

/* Adds both, and takes off palindromes, found after words of n trays. */
static void count_row(const tn_library *library, const tn_mirror *mirror, const tn_edges *edges, const tn_row *row,
                      uint32_t n, bool symmetric, mpz_t *counts)
{
    mpz_t sum;
    mpz_init(sum);
    for (uint32_t s = 0; !symmetric && s < edges->states; s++)
        if (edges->accept[s] & BOTH)
            tn_row_add(row, s, 1, counts[n]);
    for (uint32_t odd = 0; odd < 2 && (uint64_t)2 * n + odd <= library->max; odd++) {
        mpz_set_ui(sum, 0);
        for (uint32_t s = 0; s < edges->states; s++)
            if (odd || edges->accept[s] & TURNS_HERE)
                tn_row_add(row, s, odd ? middles_of(mirror, s) : 1, sum);
        mpz_sub(counts[2 * n + odd], counts[2 * n + odd], sum);
    }
    mpz_clear(sum);
}

/* counts[n] := both - palindromes, for every length n. */
static tn_status count_pairs(const tn_library *library, const tn_mirror *mirror, const tn_edges *edges, uint32_t depth,
                             bool symmetric, mpz_t *counts, tn_error *error)
{
    tn_row row = {0};
    tn_status status = tn_row_start(edges, &row, error);
    for (uint32_t n = 0; symmetric && n <= library->max; n++)
        tn_library_kept(library, n, counts[n]);
    for (uint32_t n = 0; status == TN_OK; n++) {
        count_row(library, mirror, edges, &row, n, symmetric, counts);
        if (n == depth)
            break;
        tn_row next = {0};
        status = tn_row_forward(edges, &row, &next, error);
        tn_row_clear(&row);
        row = next;
    }
    tn_row_clear(&row);
    return status;
}

/* Is every clause its own mirror? Not knowing (a mirrored clause passes a limit) counts as no. */
static tn_status is_symmetric(const tn_library *library, bool *symmetric, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_status status = tn_lowering_new(library->classes, library->max_states, &lowering, error);
    *symmetric = true;
    for (size_t i = 0; status == TN_OK && *symmetric && i < library->record->clause_count; i++) {
        const tn_clause_record *clause = &library->schema->module->CLAUSE_records[library->record->clause_first + i];
        tn_dfa *turned = NULL;
        status = tn_lower_reversed(lowering, clause->holds, &turned, error);
        *symmetric = status == TN_OK && tn_dfa_equal(turned, library->clauses[i]);
        tn_dfa_free(turned);
    }
    tn_lowering_free(lowering);
    return status == TN_LIMIT ? TN_OK : status;
}

/* counts[n] := plans of length n less the second ones of pairs, from both - palindromes. */
static void finish_counts(const tn_library *library, mpz_t *counts)
{
    mpz_t kept;
    mpz_init(kept);
    for (uint32_t n = 0; n <= library->max; n++) {
        tn_library_kept(library, n, kept);
        mpz_divexact_ui(counts[n], counts[n], 2);
        mpz_sub(counts[n], kept, counts[n]);
    }
    mpz_clear(kept);
}

static tn_status find_mirror(const tn_library *library, tn_error *error)
{
    uint64_t *weights = NULL;
    bool symmetric = false;
    tn_mirror mirror = {0};
    tn_dfa *pairs = NULL;
    tn_edges edges = {0};
    mpz_t *counts = tn_integers_new((size_t)library->max + 1);
    tn_status status = counts ? is_symmetric(library, &symmetric, error) : tn_fail_memory(error);
    uint32_t depth = symmetric ? library->max / 2 : library->max;
    if (status == TN_OK)
        status = tn_column_weights(library->classes, library->live->column, library->live->columns, &weights, error);
    mirror.weights = weights;
    if (status == TN_OK)
        status = mirror_make(&mirror, library, error);
    if (status == TN_OK)
        status = explore_mirror(library, &mirror, depth, &pairs, error);
    if (status == TN_OK)
        status = tn_edges_of(&edges, pairs, weights, error);
    if (status == TN_OK)
        status = count_pairs(library, &mirror, &edges, depth, symmetric, counts, error);
    if (status == TN_OK) {
        finish_counts(library, counts);
        library->late->mirror = counts;
        library->late->mirror_found = true;
    } else {
        tn_integers_free(counts, (size_t)library->max + 1);
    }
    tn_edges_clear(&edges);
    tn_dfa_free(pairs);
    mirror_clear(&mirror);
    free(weights);
    return status;
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
