/* What the measures of a file are worth on single houses: those about houses of a form, and those about plans of its
 * schema that all plans have a value of.
 *
 * A tn_house_valuer borrows the form, belongs to one thread, and keeps its memory from house to house.
 */
#ifndef TARTAN_DRIVER_HOUSE_VALUES_H
#define TARTAN_DRIVER_HOUSE_VALUES_H

#include "runtime/house/rule/asked.h"
#include "runtime/house/schedule/describe.h"

typedef struct tn_house_valuer tn_house_valuer;

/* Of these measures; NULL: of all. max_length: of a plan, in trays. Free it in any case. */
tn_status tn_house_valuer_new(const tn_house_form *form, size_t max_length, const tn_house_measured *measures,
                              size_t count, tn_house_valuer **valuer, tn_error *error);
void tn_house_valuer_free(tn_house_valuer *valuer);

/* The measures with their units, and the values that they have on the house that was looked at last. Borrowed. */
const tn_house_value *tn_house_values(const tn_house_valuer *valuer, size_t *count);

/* Finds the values on a house. price: what it costs, unrounded; NULL: that is worked out if a measure asks
 * for it. */
tn_status tn_house_values_find(tn_house_valuer *valuer, const tn_house *house, mpq_srcptr price, tn_error *error);

#endif
