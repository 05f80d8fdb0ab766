/* Conditions on a number: the E of `quantity`, `sum` and `occurrences`. */
#ifndef TARTAN_PLAN_MATCH_CONDITION_H
#define TARTAN_PLAN_MATCH_CONDITION_H

#include "runtime/module/module.h"

#define TN_CONDITION_STEPS_MAX (UINT64_C(1) << 30)

/* E(n), n >= 0, for a verified condition function (index into FUNCTION records). */
bool tn_condition_holds(const tn_module *module, uint32_t function, int64_t n);

/* The least (threshold, period) such that E(n) = E(n + period) for every n >= threshold, counted in steps of
 * `unit` (E is asked at multiples of unit only; unit 1 for quantities). Finding them evaluates E at most `limit`
 * times (and at most TN_CONDITION_STEPS_MAX); TN_LIMIT (E0802) where that does not suffice. */
tn_status tn_condition_period(const tn_module *module, uint32_t function, int64_t unit, uint64_t limit,
                              uint64_t *threshold, uint64_t *period, tn_error *error);

#define TN_CONDITION_TEXT_MAX 160

/* Writes "n > 1 and not n mod 3 = 1" for a condition function of a verified module; "..." where that would be too long.
 */
void tn_condition_text(const tn_module *module, uint32_t function, char text[TN_CONDITION_TEXT_MAX]);

#endif
