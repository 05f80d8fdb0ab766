/* What the houses of a library that asks for walks, or is asked for them, have in the trays of an open plan: those on
 * each plan that completes it are gone through (walked.h). Other houses are counted together (count/houses.h). */
#ifndef TARTAN_ASK_HOUSE_COMPLETED_H
#define TARTAN_ASK_HOUSE_COMPLETED_H

#include "ask/house/walked.h"
#include "runtime/plan/measure/complete.h"

/* As tn_houses_complete; measures: none, or one, whose best values are in steps of `step`, which is initialised.
 * TN_LIMIT (E1617) if more than TN_HOUSE_PLANS_FEW plans complete it, or too many houses are on them. Clear `found`
 * with tn_completions_clear in any case. */
tn_status tn_completed_walked(tn_numbered *n, const tn_house_measures *measures, const tn_open_plan *open,
                              tn_completions *found, mpq_t step, tn_error *error);

#endif
