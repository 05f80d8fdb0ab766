/* What rules about houses say of them, for the command that asks the same of plans. */
#ifndef TARTAN_CLI_HOUSE_JUDGED_H
#define TARTAN_CLI_HOUSE_JUDGED_H

#include "ask/plan/match.h"
#include "cli/common/job.h"

typedef enum tn_house_answer { TN_HOUSE_NAMES, TN_HOUSE_JSON, TN_HOUSE_BITS, TN_HOUSE_ANY } tn_house_answer;

/* Writes for each house line of the file which of the rules match it, as `tartan match` does. */
void tn_job_match_houses(tn_job *job, const tn_texts *rules, const char *path, tn_house_answer answer,
                         const char *output, size_t max_length);

#endif
