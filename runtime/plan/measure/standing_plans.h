/* The plans that a tray stands for, of a schema of a library: which measures and rules say of a plan what the tray is.
 *
 * The plans of a tray are numbered from 0 in the order of their ranks in the library. For each number of trays to come
 * the plans are counted by what their measures still come to, so that no plan is listed. A tn_standing_plans borrows
 * the library and the schema; it belongs to one thread. */
#ifndef TARTAN_PLAN_MEASURE_STANDING_PLANS_H
#define TARTAN_PLAN_MEASURE_STANDING_PLANS_H

#include "runtime/plan/library/library.h"

#define TN_STANDING_VALUES_MAX 4000000u /* triples of trays to come, a state and values */

typedef struct tn_standing_plans tn_standing_plans;

/* rows: the schema whose trays stand for plans of the library. TN_LIMIT: E0832 past the limit, E0841 past that on
 * memory; TN_INVALID (E0703): its module says another number of plans than there are, or not what its fields say. */
tn_status tn_standing_plans_new(const tn_library *library, const tn_schema *rows, tn_standing_plans **plans,
                                tn_error *error);
void tn_standing_plans_free(tn_standing_plans *plans);

/* The plan of a number, which is below how many the tray stands for: its trays (room for tn_library_max of the
 * library). */
tn_status tn_standing_plans_unrank(tn_standing_plans *plans, tn_tray tray, const mpz_t number, tn_tray *trays,
                                   uint32_t *length, tn_error *error);

/* The number of a plan among those that the tray stands for. *stands: is it one of these? */
tn_status tn_standing_plans_rank(tn_standing_plans *plans, tn_tray tray, const tn_tray *trays, uint32_t length,
                                 mpz_t number, bool *stands, tn_error *error);

#endif
