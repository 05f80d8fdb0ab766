/* The best houses of a library by measures: the values that were aimed at. The houses that have them: rank/rank.h. */
#ifndef TARTAN_HOUSE_COUNT_BEST_H
#define TARTAN_HOUSE_COUNT_BEST_H

#include "runtime/house/count/houses.h"

/* How many values there are: of houses by measures, made with an aim of TN_HOUSES_LEAST or TN_HOUSES_FRONT. */
size_t tn_houses_points(const tn_houses *houses);

/* Value `point`, in steps of each measure, and how many houses have it. The values are in order, the best first; by
 * TN_HOUSES_LEAST so many that the wanted number of houses has one of them, if there are so many houses. */
void tn_houses_point(const tn_houses *houses, size_t point, int64_t *values, mpz_t count);

#endif
