/* Writing ranked plans as the options say. */
#ifndef TARTAN_CLI_PLAN_PLAN_OUTPUT_H
#define TARTAN_CLI_PLAN_PLAN_OUTPUT_H

#include "cli/common/row_output.h"
#include "cli/plan/library_job.h"

/* Opens the output that --output and --format ask for. `made` says what was asked for, in words of the command line
 * that decide the result. False where that failed. */
bool tn_job_plan_writer(tn_job *job, const tn_ready_library *ready, const tn_written_settings *settings,
                        const char *made, tn_plan_writer **writer);

#endif
