/* A sample of a library's plans as points: the values that each of its measures has. */
#ifndef TARTAN_PLAN_MEASURE_CLOUD_H
#define TARTAN_PLAN_MEASURE_CLOUD_H

#include "runtime/plan/measure/weighed.h"

typedef struct tn_cloud {
    int64_t (*values)[TN_WEIGHED_MAX]; /* steps of the sums, as in pareto.h */
    size_t count;
} tn_cloud;

/* `count` different plans, each as likely as each, or all where there are fewer; those without a value are left out.
 * Clear in any case. */
tn_status tn_cloud_make(tn_cloud *cloud, tn_weighed *weighed, uint64_t seed, size_t count, tn_error *error);
void tn_cloud_clear(tn_cloud *cloud);

/* The values of the sums of one plan of the library, in steps; *valued: it has a value of each measure. */
tn_status tn_weighed_plan(tn_weighed *weighed, const tn_tray *trays, size_t length, int64_t *values, bool *valued,
                          tn_error *error);

#endif
