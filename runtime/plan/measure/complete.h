/* How many plans of a library complete an open plan, and which values its written trays then have. */
#ifndef TARTAN_PLAN_MEASURE_COMPLETE_H
#define TARTAN_PLAN_MEASURE_COMPLETE_H

#include "runtime/plan/measure/open_plan.h"

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

/* Clear in any case. */
tn_status tn_complete(tn_completions *completions, const tn_library *library, const tn_open_plan *open,
                      tn_error *error);
void tn_completions_clear(tn_completions *completions);

#endif
