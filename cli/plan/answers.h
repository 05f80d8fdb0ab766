/* What commands about plans print, for those that answer several questions at once. */
#ifndef TARTAN_CLI_PLAN_ANSWERS_H
#define TARTAN_CLI_PLAN_ANSWERS_H

#include "cli/plan/library_job.h"
#include "driver/plan/tests.h"

/* What `tartan count` prints of a library. */
void tn_job_count(tn_job *job, const tn_ready_library *ready);

/* What `tartan diff` prints of two; paths: their files. The job is the one that has the second open. */
void tn_job_compare(tn_job *job, const char *const paths[2], const tn_ready_library *before,
                    const tn_ready_library *after);

/* The last line of `tartan test`. */
void tn_test_counts_write(const tn_test_counts *counts, FILE *out);

#endif
