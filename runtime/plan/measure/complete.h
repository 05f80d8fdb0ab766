/* Open plans: how many plans of a library complete a pattern, and which values its written trays then have.
 *
 * A pattern is a row of trays, each a rule function that looks at that tray alone, and gaps of any number of trays.
 * Where a plan fits in several ways the leftmost counts: the first written tray as early as can be, then the second,
 * and so on.
 */
#ifndef TARTAN_PLAN_MEASURE_COMPLETE_H
#define TARTAN_PLAN_MEASURE_COMPLETE_H

#include "runtime/plan/library/library.h"

#define TN_PATTERN_MAX 60u /* written trays */

typedef struct tn_completions {
    mpz_t plans;
    uint32_t trays;  /* written ones */
    uint32_t values; /* of the schema, over all fields */
    mpz_t *counts;   /* [trays][values]: completions that have the value there */
} tn_completions;

/* functions: of M, or TN_NO_RECORD for a gap. Clear in any case. */
tn_status tn_complete(tn_completions *completions, const tn_library *library, const uint32_t *functions, size_t count,
                      tn_error *error);
void tn_completions_clear(tn_completions *completions);

#endif
