/* count --by: how the plans of a library are spread over the values of a measure. */
#ifndef TARTAN_CLI_PLAN_COUNT_BY_H
#define TARTAN_CLI_PLAN_COUNT_BY_H

#include "cli/plan/library_job.h"
#include "driver/measure/spread.h"

/* How the distribution is shown: all zero lists its values, or few bins where they are many. */
typedef struct tn_count_by_options {
    bool json;
    const char *step; /* of bins, in the measure's unit */
    tn_option_number bins;
} tn_count_by_options;

/* Writes the distribution of the measure of that name; path: NULL is standard output. */
void tn_count_by(tn_job *job, const tn_ready_library *ready, const char *measure, const tn_count_by_options *options,
                 const char *path);

/* The same of a distribution that is made already. */
void tn_show_spread(tn_job *job, tn_spread *spread, const tn_count_by_options *options, const char *path);

#endif
