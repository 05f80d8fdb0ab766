/* The best plans of a library by one to three measures, in order: value by value, then by rank. None is listed that was
 * not asked for: the k best completions of each state are found when they are needed (Jimenez and Marzal: Computing the
 * K shortest paths, 1999). */
#ifndef TARTAN_PLAN_MEASURE_BEST_H
#define TARTAN_PLAN_MEASURE_BEST_H

#include "runtime/plan/measure/weighed.h"

typedef struct tn_best tn_best;

/* most[k]: is measure k to be as great as can be, instead of as small? A quotient can only be the first of them, and
 * what it is divided by must not be below 0 for any plan (E0429). Borrows the weighed library. */
tn_status tn_best_new(tn_weighed *weighed, const bool *most, tn_best **best, tn_error *error);
void tn_best_free(tn_best *best);

/* The next best plan: fills trays (room for the library's longest), its length, and the values of the sums in steps.
 * *found false at the end. Plans without a value are left out. */
tn_status tn_best_next(tn_best *best, tn_tray *trays, uint32_t *length, int64_t *values, bool *found, tn_error *error);

#endif
