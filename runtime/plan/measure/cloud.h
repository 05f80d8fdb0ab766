/* A sample of a library's plans as points: the values that each of its measures has. */
#ifndef TARTAN_PLAN_MEASURE_CLOUD_H
#define TARTAN_PLAN_MEASURE_CLOUD_H

#include "runtime/plan/measure/weighed.h"

typedef struct tn_cloud {
    int64_t (*values)[TN_WEIGHED_MAX]; /* steps of the measures, as in pareto.h */
    size_t count;
} tn_cloud;

/* `count` different plans, each as likely as each, or all where there are fewer. Clear in any case. */
tn_status tn_cloud_make(tn_cloud *cloud, tn_weighed *weighed, uint64_t seed, size_t count, tn_error *error);
void tn_cloud_clear(tn_cloud *cloud);

/* The values of one plan of the library, in steps. */
tn_status tn_weighed_plan(tn_weighed *weighed, const tn_tray *trays, size_t length, int64_t *values, tn_error *error);

#endif
