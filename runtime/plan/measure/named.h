/* The measures of a library: the MEASURE records of its schema, and `preference`, what the library's preferences add up
 * to. A measure is the index of its record, or TN_PREFERENCE. */
#ifndef TARTAN_PLAN_MEASURE_NAMED_H
#define TARTAN_PLAN_MEASURE_NAMED_H

#include "runtime/plan/schema/schema.h"

#define TN_PREFERENCE (UINT32_MAX - 1)

const char *tn_named_measure(const tn_module *module, uint32_t measure);     /* its name */
const char *tn_named_measure_doc(const tn_module *module, uint32_t measure); /* what its author says of it, or "" */

/* Its SUM record. */
uint32_t tn_named_measure_sum(const tn_module *module, const tn_library_record *library, uint32_t measure);

/* The SUM record that it is divided by; TN_NO_RECORD: it is no quotient. */
uint32_t tn_named_measure_over(const tn_module *module, uint32_t measure);

/* To which power of a length it is: below 0 of a number by a length. */
int tn_named_measure_power(const tn_module *module, uint32_t measure);

/* May a plan have no value of it: a quotient by 0, the greatest number of nothing? */
bool tn_named_measure_partial(const tn_module *module, uint32_t measure);

/* The measure of that name; TN_NO_RECORD: the library has none. */
uint32_t tn_named_measure_find(const tn_module *module, const tn_library_record *library, const char *name);

/* Goes from one to the next, from TN_NO_RECORD to the first; false: there are no more. */
bool tn_named_measure_next(const tn_module *module, const tn_library_record *library, uint32_t *measure);

#endif
