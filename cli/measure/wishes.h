/* What `best` and `pareto` are told to make small or great: measures in their order. */
#ifndef TARTAN_CLI_MEASURE_WISHES_H
#define TARTAN_CLI_MEASURE_WISHES_H

#include "ask/plan/best.h"
#include "cli/plan/library_job.h"

/* Room for the measures of --least, --most and so on. */
typedef struct tn_wished {
    tn_wish items[TN_WEIGHED_MAX];
    size_t count;
} tn_wished;

/* Reads the options, which have added to `list`; `least` of them are needed. False if one is wrong: then reported. */
bool tn_job_wishes(tn_job *job, const tn_option_list *list, uint32_t least, tn_wished *wished);

#endif
