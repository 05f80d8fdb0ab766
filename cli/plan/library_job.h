/* What the commands that work on one library have in common: opening it as the options say. */
#ifndef TARTAN_CLI_PLAN_LIBRARY_JOB_H
#define TARTAN_CLI_PLAN_LIBRARY_JOB_H

#include "cli/common/job.h"
#include "driver/plan/library.h"

/* Opens the file and makes the chosen library ready; false where that failed (then end the job). */
bool tn_job_library(tn_job *job, const char *path, tn_ready_library *ready);

/* The same, but only the schema: for commands that match plans against the clauses. */
bool tn_job_library_schema(tn_job *job, const char *path, tn_ready_library *ready);

/* How many threads the options ask for; sets it for the library's own parallel loops too. */
int tn_job_threads(const tn_settings *settings);

/* The longest plan that the options accept. */
size_t tn_job_max_length(const tn_settings *settings);

/* A rank of the options ("" or NULL: `otherwise`). `number` is initialised. */
void tn_job_rank(const char *text, const mpz_t otherwise, mpz_t number);

/* Records that the library has no plan of that rank, and how many it has. */
void tn_job_no_rank(tn_job *job, const tn_library *library, const tn_library_record *record, const char *rank);

#endif
