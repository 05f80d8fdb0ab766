/* How much each part of a rule matters: for how many plans a decision is another one when the part never matches.
 *
 * Counted on automata, exactly: the clauses are lowered again with the part's instructions giving nothing, and the
 * plans of the difference are counted. A tn_coverage belongs to one thread and borrows the schema.
 */
#ifndef TARTAN_PLAN_ANALYSIS_COVERAGE_H
#define TARTAN_PLAN_ANALYSIS_COVERAGE_H

#include <gmp.h>

#include "runtime/plan/schema/schema.h"

typedef struct tn_coverage tn_coverage;

typedef struct tn_coverage_clause {
    uint32_t function; /* HOLDS */
    bool requires; /* plans that it does not hold of are not generated; otherwise those that it holds of are pruned */
} tn_coverage_clause;

/* The plans of min..max trays that meet what is required; each is kept or pruned by the clauses. TN_LIMIT (E0802) where
 * an automaton passes max_states (0: the default). */
tn_status tn_coverage_new(const tn_schema *schema, const tn_coverage_clause *clauses, size_t count, uint32_t min,
                          uint32_t max, uint32_t max_states, tn_coverage **coverage, tn_error *error);
void tn_coverage_free(tn_coverage *coverage);

/* From now on, what the instructions at these code offsets make is empty (until the next call). */
tn_status tn_coverage_without(tn_coverage *coverage, const uint32_t *offsets, size_t count, tn_error *error);

/* How many generated plans are kept with the part and not without it, or the other way round. */
tn_status tn_coverage_flips(tn_coverage *coverage, mpz_t flips, tn_error *error);

/* Does clause i hold of a plan, with the part (as the rules are) or without? */
bool tn_coverage_holds(const tn_coverage *coverage, size_t i, bool without, const tn_tray *trays, size_t length);

#endif
