/* The front of a library by two or three measures: values that no plan betters in one without losing in another. */
#ifndef TARTAN_PLAN_MEASURE_PARETO_H
#define TARTAN_PLAN_MEASURE_PARETO_H

#include "runtime/plan/measure/weighed.h"

#define TN_FRONT_MAX 10000u  /* points of one state */
#define TN_JOINT_MAX 200000u /* the same, of a joint distribution */

typedef struct tn_pareto_point {
    int64_t values[TN_WEIGHED_MAX]; /* steps of the sums */
    mpz_t plans;                    /* how many plans lie there */
    tn_tray *trays;                 /* the first of them by rank */
    uint32_t length;
} tn_pareto_point;

typedef struct tn_pareto_front {
    tn_pareto_point *points; /* best first by the measures in their order */
    size_t count;
} tn_pareto_front;

/* most[k] as in best.h. E0832 past TN_FRONT_MAX. Plans without a value are left out. Clear in any case. */
tn_status tn_pareto_make(tn_pareto_front *front, tn_weighed *weighed, const bool *most, tn_error *error);

/* All values of the sums that plans have, ascending: their joint distribution. E0832 past TN_JOINT_MAX. */
tn_status tn_pareto_all(tn_pareto_front *all, tn_weighed *weighed, tn_error *error);
void tn_pareto_clear(tn_pareto_front *front);

#endif
