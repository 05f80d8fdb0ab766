/* Measures that no plan has a value of. */
#ifndef TARTAN_PLAN_MEASURE_NEVER_H
#define TARTAN_PLAN_MEASURE_NEVER_H

#include "runtime/plan/schema/schema.h"

/* Is there no plan at all, of any length, that has a value of the MEASURE record? False, too, if that passes a limit
 * or memory runs out. */
bool tn_measure_never(const tn_schema *schema, uint32_t measure);

#endif
