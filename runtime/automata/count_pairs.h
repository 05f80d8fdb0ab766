/* What counting the words of two automata needs, for the files that do it (count_both.c, count_sweep.c). */
#ifndef TARTAN_AUTOMATA_COUNT_PAIRS_H
#define TARTAN_AUTOMATA_COUNT_PAIRS_H

#include "runtime/automata/count.h"

#define TN_BOTH_NEAR 4 /* steps or edges back that are looked at for one to the same place */

/* The two automata, and what their letters come to together. */
typedef struct tn_agreement {
    size_t limbs;
    const tn_sparse *a;
    const tn_dfa *b;
    bool agree; /* b must accept (otherwise: must not) */
    uint32_t max;
    tn_splits splits;
    uint64_t *weights; /* [splits.columns] */
} tn_agreement;

/* Fills in the splits, and the weights by the symbols of each letter. Clear it also after a failure. */
tn_status tn_agreement_make(tn_agreement *of, const uint32_t *sizes, tn_error *error);
void tn_agreement_clear(tn_agreement *of);

/* *away: for each state of b the symbols until it answers as wanted, at least, or UINT32_MAX. The caller frees it. */
tn_status tn_agreement_away(const tn_agreement *of, uint32_t **away, tn_error *error);

/* Symbols of the shortest and the longest word from each state of a folded automaton. */
void tn_sweep_measure(const tn_sparse *a, uint32_t *shortest, uint32_t *longest);

/* count += the words that both automata agree about, of any length; longest: as above; away: symbols from each state of
 * b to one where it answers as wanted. The bounds are of the steps. */
tn_status tn_sweep_count(const tn_agreement *of, const uint32_t *longest, const uint32_t *away, const char *what,
                         tn_bounds *bounds, mpz_t count, tn_error *error);

#endif
