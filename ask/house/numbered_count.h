/* How many houses a library has, and how they are spread. */
#ifndef TARTAN_ASK_HOUSE_NUMBERED_COUNT_H
#define TARTAN_ASK_HOUSE_NUMBERED_COUNT_H

#include "ask/house/numbered.h"
#include "ask/session/requests.h"
#include "driver/measure/spread.h"

/* The houses of the library, or those on one plan (NULL: all plans); clauses: also what each clause keeps out. */
tn_status tn_numbered_count(tn_numbered *n, const tn_plan *plan, bool clauses, tn_counted_houses *counted,
                            tn_error *error);

/* The number of houses alone. */
tn_status tn_numbered_houses(tn_numbered *n, const tn_plan *plan, mpz_t houses, tn_error *error);

/* The same by the values of a measure, which tn_house_measure_choose numbers. Clear the spread in any case. */
tn_status tn_numbered_spread(tn_numbered *n, const tn_plan *plan, uint32_t measure, tn_spread *spread, tn_error *error);

#endif
