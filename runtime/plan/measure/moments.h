/* The least, the most, the mean and the variance of a measure over a library: in one walk through its automaton,
 * without the distribution. */
#ifndef TARTAN_PLAN_MEASURE_MOMENTS_H
#define TARTAN_PLAN_MEASURE_MOMENTS_H

#include "runtime/plan/measure/weighed.h"

/* Values in nanometres to the measure's power. plans: those that have a value; where there are none all are 0. */
typedef struct tn_measure_moments {
    mpz_t plans;
    mpq_t least, most, mean, variance;
} tn_measure_moments;

/* How many plans have a value of each measure; `plans` is initialised. */
tn_status tn_weighed_plans(tn_weighed *weighed, mpz_t plans, tn_error *error);

void tn_measure_moments_init(tn_measure_moments *moments);
void tn_measure_moments_clear(tn_measure_moments *moments);

/* Of the first measure; `moments` is initialised. */
tn_status tn_measure_moments_find(tn_measure_moments *moments, tn_weighed *weighed, tn_error *error);

#endif
