/* How much each part of a rule matters: for how many plans a decision is another one when the part never matches.
 *
 * Counted on automata, exactly: what the part is in is lowered again with the part's instructions giving nothing, and
 * the plans of the difference are counted. Where that is about a library, all is counted within its lengths, from
 * automata that it keeps: what a clause alone keeps out, and the kept plans. A tn_coverage belongs to one thread and
 * borrows the schema or the library.
 */
#ifndef TARTAN_PLAN_ANALYSIS_COVERAGE_H
#define TARTAN_PLAN_ANALYSIS_COVERAGE_H

#include <gmp.h>

#include "runtime/plan/library/library.h"

typedef struct tn_coverage tn_coverage;

/* Of functions (HOLDS) by themselves, over the plans of min..max trays: of each plan some function says otherwise.
 * TN_LIMIT (E0802) where an automaton passes max_states (0: the default). */
tn_status tn_coverage_new(const tn_schema *schema, const uint32_t *functions, size_t count, uint32_t min, uint32_t max,
                          uint32_t max_states, tn_coverage **coverage, tn_error *error);

/* Of a library's clauses, over the plans that it generates: of each plan, whether it is kept. */
tn_status tn_coverage_of_library(const tn_library *library, tn_coverage **coverage, tn_error *error);
void tn_coverage_free(tn_coverage *coverage);

/* From now on, what the instructions at these code offsets make is empty (until the next call). */
tn_status tn_coverage_without(tn_coverage *coverage, const uint32_t *offsets, size_t count, tn_error *error);

/* How many plans are decided otherwise without the part. */
tn_status tn_coverage_flips(tn_coverage *coverage, mpz_t flips, tn_error *error);

/* Does function or clause i hold of a plan, with the part (as the rules are) or without? */
bool tn_coverage_holds(const tn_coverage *coverage, size_t i, bool without, const tn_tray *trays, size_t length);

#endif
