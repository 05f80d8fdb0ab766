/* count --by: how the plans of a library are spread over the values of a measure. */
#ifndef TARTAN_CLI_PLAN_COUNT_BY_H
#define TARTAN_CLI_PLAN_COUNT_BY_H

#include "cli/plan/library_job.h"

void tn_count_by(tn_job *job, const tn_ready_library *ready);

#endif
