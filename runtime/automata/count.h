/* Counts the words that an automaton accepts, by length, without walking words: dynamic programming over states, exact.
 * A letter may stand for several symbols (a class of trays that no rule tells apart): a word then counts as often as
 * there are choices of its symbols.
 *
 * A row holds, for every state, how many words of one length are accepted from it, as GMP limbs side by side: all
 * states of a row have the same number of limbs, the fewest that hold its largest count.
 */
#ifndef TARTAN_AUTOMATA_COUNT_H
#define TARTAN_AUTOMATA_COUNT_H

#include <gmp.h>

#include "runtime/automata/sparse.h"
#include "runtime/automata/walk.h"

/* An automaton's transitions by symbols: for each state the states that follow it, each once, with the number of
 * symbols that lead there. Transitions to the state that accepts nothing are left out. Free with tn_edges_clear. */
typedef struct tn_edges {
    uint32_t states;
    const uint8_t *accept; /* the automaton's, borrowed */
    size_t *first;         /* [states + 1] */
    uint32_t *target;
    mp_limb_t *weight;
} tn_edges;

/* weight: symbols of each column (tn_column_weights). */
tn_status tn_edges_make(tn_edges *edges, const tn_sparse *sparse, const uint64_t *weight, tn_error *error);

/* The same of a complete automaton. */
tn_status tn_edges_of(tn_edges *edges, const tn_dfa *dfa, const uint64_t *weight, tn_error *error);
void tn_edges_clear(tn_edges *edges);

/* How many symbols each of so many columns has. sizes, column: the symbols and the column of each letter. The caller
 * frees *weights with free(). */
tn_status tn_column_weights(const uint32_t *sizes, uint32_t letters, const uint32_t *column, uint32_t columns,
                            uint64_t **weights, tn_error *error);

typedef struct tn_count_row {
    size_t limbs;     /* of a count, at least 1 */
    mp_limb_t *value; /* [states][limbs], owned */
} tn_count_row;

/* Bytes that a row takes. */
static inline uint64_t tn_count_row_bytes(const tn_edges *edges, const tn_count_row *row)
{
    return (uint64_t)edges->states * row->limbs * sizeof(mp_limb_t);
}

/* The row of length 0. */
tn_status tn_count_row_first(const tn_edges *edges, tn_count_row *row, tn_error *error);

/* The row of the next length: words of one symbol more, counted from the state before it. */
tn_status tn_count_row_next(const tn_edges *edges, const tn_count_row *row, tn_count_row *next, tn_error *error);

void tn_count_row_clear(tn_count_row *row);

/* Bytes of the counts of one state for the lengths behind `length` and up to `max`, as far as their limbs grow as they
 * did since half of that length, when there were `half`. Counts grow evenly in the long run: asked at powers of two
 * (tn_count_forecasts), which are long enough. */
uint64_t tn_count_to_come(size_t half, size_t limbs, uint32_t length, uint32_t max);

static inline bool tn_count_forecasts(uint32_t length)
{
    return length >= 512 && (length & (length - 1)) == 0;
}

static inline const mp_limb_t *tn_count_row_at(const tn_count_row *row, uint32_t state)
{
    return row->value + (size_t)state * row->limbs;
}

/* count += times * the row's count at a state. */
void tn_count_row_add(const tn_count_row *row, uint32_t state, uint64_t times, mpz_t count);

/* ---- counts of limbs, for the files that count */

__extension__ typedef unsigned __int128 tn_wide_limb; /* a product of limbs, which have 64 bits here */
_Static_assert(sizeof(mp_limb_t) == 8, "counts are kept in limbs of 64 bits");

/* Counts of more limbs than these are added up from the end of the words (tn_count_row), not from their beginning. */
#define TN_FORWARD_LIMBS_MAX 4

/* sum += count * weight + carry, of one limb; returns the limb carried out. */
static inline mp_limb_t tn_limb_add(mp_limb_t *sum, mp_limb_t count, mp_limb_t weight, mp_limb_t carry)
{
    tn_wide_limb all = (tn_wide_limb)count * weight + *sum + carry;
    *sum = (mp_limb_t)all;
    return (mp_limb_t)(all >> 64);
}

/* sum += count * weight; returns the limb carried out. GMP's own is faster from a few limbs on; most libraries have
 * fewer. */
static inline mp_limb_t tn_limbs_add(mp_limb_t *sum, const mp_limb_t *count, size_t limbs, mp_limb_t weight)
{
    if (limbs > 3)
        return mpn_addmul_1(sum, count, (mp_size_t)limbs, weight);
    mp_limb_t carry = tn_limb_add(sum, count[0], weight, 0);
    if (limbs > 1)
        carry = tn_limb_add(sum + 1, count[1], weight, carry);
    if (limbs > 2)
        carry = tn_limb_add(sum + 2, count[2], weight, carry);
    return carry;
}

/* The algebra of counts of limbs, for layered walks whose context begins with the number of limbs. The label of an edge
 * is its number of symbols. */
static inline void tn_limbs_begin(const void *context, void *count)
{
    mp_limb_t *limb = count;
    for (size_t i = 0; i < *(const size_t *)context; i++)
        limb[i] = 0;
}

static inline tn_status tn_limbs_one(void *context, uint32_t layer, uint32_t state, void *count, tn_error *error)
{
    (void)context, (void)layer, (void)state, (void)error;
    *(mp_limb_t *)count = 1;
    return TN_OK;
}

static inline tn_status tn_limbs_extend(void *context, void *sum, const void *count, const tn_walk_edge *edge,
                                        tn_error *error)
{
    (void)error;
    tn_limbs_add(sum, count, *(const size_t *)context, *(const uint64_t *)edge->label);
    return TN_OK;
}

/* Limbs that hold the number of all words of `max` symbols; weights: symbols of each column. */
uint64_t tn_count_limbs(const uint64_t *weights, uint32_t columns, uint32_t max);

/* ---- counts of words; sizes: the symbols of each letter */

/* How many words of each of the lengths 0..max the automaton accepts: counts is an initialised array of max + 1. The
 * watch, or NULL, can end it, and limits what the counts take (TN_LIMIT). */
tn_status tn_count_lengths(const tn_sparse *sparse, const uint32_t *sizes, uint32_t max, mpz_t *counts, tn_watch *watch,
                           tn_error *error);

/* How many words of the lengths min..max. */
tn_status tn_count_range(const tn_sparse *sparse, const uint32_t *sizes, uint32_t min, uint32_t max, mpz_t count,
                         tn_watch *watch, tn_error *error);

/* How many words of the lengths min..max `a` accepts and b accepts too (TN_DFA_AND) or does not (TN_DFA_MINUS): without
 * making their product (count_both.c). The bounds are of the pairs of states met; `what` names the product. */
tn_status tn_count_both(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                        uint32_t min, uint32_t max, const char *what, tn_bounds *bounds, mpz_t count, tn_error *error);

/* The same for each of the lengths 0..max, with a row of counts for each state of `a` that words lead to, one for each
 * state of b (count_sweep.c): counts is an initialised array of max + 1. The bounds are of the steps. */
tn_status tn_count_both_lengths(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                                uint32_t max, const char *what, tn_bounds *bounds, mpz_t *counts, tn_error *error);

/* A word of symbols, and the symbols that come before those. */
typedef struct tn_count_word {
    uint32_t length;
    const uint32_t *letters; /* [length]: that its symbols are of */
    /* += how many symbols of each letter come before that of the word in a place. */
    void (*lower)(void *context, uint32_t place, uint64_t *symbols);
    void *context;
} tn_count_word;

/* As tn_count_both_lengths, of the words that are as long as a word and come before it, symbol by symbol. */
tn_status tn_count_both_before(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                               const tn_count_word *word, const char *what, tn_bounds *bounds, mpz_t count,
                               tn_error *error);

#endif
