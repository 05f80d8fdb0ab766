/* What commands about plans print, for those that answer several questions at once. */
#ifndef TARTAN_CLI_PLAN_ANSWERS_H
#define TARTAN_CLI_PLAN_ANSWERS_H

#include "ask/session/requests.h"
#include "cli/plan/library_job.h"

/* Asks how many there are and writes the answer; path: NULL is standard output. */
void tn_job_count(tn_job *job, const tn_count_request *request, bool json, const char *path);

/* Asks what an edit does to a library. before: the session in which the file before it is open. Clear the answer in any
 * case, before that session forgets. */
bool tn_job_diff(tn_job *job, tn_session *before, const tn_diff_request *request, tn_reply *answer);

/* The same, and writes it as text. */
void tn_job_diff_text(tn_job *job, tn_session *before, const tn_diff_request *request);

#endif
