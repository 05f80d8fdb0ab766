/* Open plans: how many plans of a library complete a pattern, and which values its written trays then have.
 *
 * A pattern is a row of trays, each a rule function that looks at that tray alone, and gaps of any number of trays.
 * Where a plan fits in several ways the leftmost counts: the first written tray as early as can be, then the second,
 * and so on.
 */
#ifndef TARTAN_PLAN_MEASURE_COMPLETE_H
#define TARTAN_PLAN_MEASURE_COMPLETE_H

#include "runtime/plan/measure/weighed.h"

#define TN_PATTERN_MAX 60u /* written trays */

#define TN_NO_BEST INT64_MIN /* no plan with the choice has a value */

typedef struct tn_completions {
    mpz_t plans;
    uint32_t trays;  /* written ones */
    uint32_t values; /* of the schema, over all fields */
    mpz_t *counts;   /* [trays][values]: completions that have the value there */
    int64_t *best;   /* [trays][values]: the best that the measure still can be with it, in steps, where there are such
                        completions; NULL where no measure was asked for */
    tn_tray *first;  /* a plan that completes it, [first_length]; NULL if there is none, or it was not asked for */
    uint32_t first_length;
} tn_completions;

/* A place of an open plan by its trays instead of by a rule. */
typedef struct tn_open_tray {
    const bool *fits; /* [trays of the schema]; NULL: every tray */
    bool gap;
} tn_open_tray;

typedef struct tn_open_plan {
    const uint32_t *functions; /* of M, or TN_NO_RECORD for a gap; NULL: `trays` says it */
    const tn_open_tray *trays;
    size_t count;
    tn_weighed *weighed; /* by its first measure, of the same library, choices are weighed; or NULL */
    bool most;           /* more of it is better, else less */
    bool first;          /* find a plan that completes it, too */
} tn_open_plan;

/* Clear in any case. */
tn_status tn_complete(tn_completions *completions, const tn_library *library, const tn_open_plan *open,
                      tn_error *error);
void tn_completions_clear(tn_completions *completions);

#endif
