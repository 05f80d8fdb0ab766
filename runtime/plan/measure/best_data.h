/* What finding the best plans by a quotient needs of finding them by sums. Internal to best.c and best_quotient.c. */
#ifndef TARTAN_PLAN_MEASURE_BEST_DATA_H
#define TARTAN_PLAN_MEASURE_BEST_DATA_H

#include "runtime/plan/measure/best.h"

/* By the first two sums as one, each so many times, as small as can be; then by the other sums. E0424 (TN_LIMIT) where
 * that passes 64 bits. most: of the sums behind them, from index 2 on. */
tn_status tn_best_of_mixture(tn_weighed *weighed, const int64_t *times, const bool *most, tn_best **best,
                             tn_error *error);

typedef struct tn_best_quotient tn_best_quotient;

tn_status tn_best_quotient_new(tn_weighed *weighed, const bool *most, tn_best_quotient **best, tn_error *error);
void tn_best_quotient_free(tn_best_quotient *best);
tn_status tn_best_quotient_next(tn_best_quotient *best, tn_tray *trays, uint32_t *length, int64_t *values, bool *found,
                                tn_error *error);

#endif
