/* Counts the plans that an automaton accepts, by length, without walking plans: dynamic programming over states, exact.
 *
 * A row holds, for every state, how many plans of one length are accepted from it, as GMP limbs side by side: all
 * states of a row have the same number of limbs, the fewest that hold its largest count.
 */
#ifndef TARTAN_PLAN_LIBRARY_COUNT_H
#define TARTAN_PLAN_LIBRARY_COUNT_H

#include <gmp.h>

#include "runtime/plan/automata/sparse.h"
#include "runtime/plan/schema/classes.h"

/* An automaton's transitions by trays: for each state the states that follow it, each once, with the number of trays
 * that lead there. Transitions to the state that accepts nothing are left out. Free with tn_edges_clear. */
typedef struct tn_edges {
    uint32_t states;
    const uint8_t *accept; /* the automaton's, borrowed */
    size_t *first;         /* [states + 1] */
    uint32_t *target;
    mp_limb_t *weight;
} tn_edges;

/* weight: trays for each column (tn_column_weights). */
tn_status tn_edges_make(tn_edges *edges, const tn_sparse *sparse, const uint64_t *weight, tn_error *error);

/* The same of a complete automaton. */
tn_status tn_edges_of(tn_edges *edges, const tn_dfa *dfa, const uint64_t *weight, tn_error *error);
void tn_edges_clear(tn_edges *edges);

/* How many trays each of so many columns has; column: of each class. The caller frees *weights with free(). */
tn_status tn_column_weights(const tn_classes *classes, const uint32_t *column, uint32_t columns, uint64_t **weights,
                            tn_error *error);

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

/* The row of the next length: plans of one tray more, counted from the state before that tray. */
tn_status tn_count_row_next(const tn_edges *edges, const tn_count_row *row, tn_count_row *next, tn_error *error);

void tn_count_row_clear(tn_count_row *row);

static inline const mp_limb_t *tn_count_row_at(const tn_count_row *row, uint32_t state)
{
    return row->value + (size_t)state * row->limbs;
}

/* count += times * the row's count at a state. */
void tn_count_row_add(const tn_count_row *row, uint32_t state, uint64_t times, mpz_t count);

/* How many plans of each of the lengths 0..max the automaton accepts: counts is an initialised array of max + 1. */
tn_status tn_count_lengths(const tn_sparse *sparse, const tn_classes *classes, uint32_t max, mpz_t *counts,
                           tn_error *error);

/* How many plans of the lengths min..max. */
tn_status tn_count_range(const tn_sparse *sparse, const tn_classes *classes, uint32_t min, uint32_t max, mpz_t count,
                         tn_error *error);

#endif
