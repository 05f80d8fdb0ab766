/* The best houses of a library by measures: the values that were aimed at, and the houses that have them, in the order
 * of their ranks. They are found choice by choice: plan, section and functions follow the states that lead to such a
 * value; no other house is looked at but those that differ from one in what is in their faces.
 */
#ifndef TARTAN_HOUSE_COUNT_BEST_H
#define TARTAN_HOUSE_COUNT_BEST_H

#include "runtime/house/count/houses.h"
#include "runtime/house/variant/variant.h"

/* How many values there are: of houses by measures, made with an aim of TN_HOUSES_LEAST or TN_HOUSES_FRONT. */
size_t tn_houses_points(const tn_houses *houses);

/* Value `point`, in steps of each measure, and how many houses have it. The values are in order, the best first; by
 * TN_HOUSES_LEAST so many that the wanted number of houses has one of them, if there are so many houses. */
void tn_houses_point(const tn_houses *houses, size_t point, int64_t *values, mpz_t count);

/* Calls `each` with the houses that have value `point`, in the order of their ranks, until there are no more or *stop.
 * The house is borrowed for the call. variants: of the same library. TN_LIMIT (E1617) as for variants. */
tn_status tn_houses_point_each(tn_houses *houses, size_t point, tn_house_variants *variants, tn_house_each *each,
                               void *context, tn_error *error);

#endif
