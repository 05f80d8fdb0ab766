/* What rules and libraries about houses say of them, for the commands that ask the same of plans. */
#ifndef TARTAN_CLI_HOUSE_JUDGED_H
#define TARTAN_CLI_HOUSE_JUDGED_H

#include "cli/house/houses.h"
#include "driver/house/judge.h"

typedef enum tn_house_answer { TN_HOUSE_NAMES, TN_HOUSE_JSON, TN_HOUSE_BITS, TN_HOUSE_ANY } tn_house_answer;

/* Do these rules (none: those of the file itself) ask for houses, so that houses are what is matched? */
bool tn_job_matches_houses(const tn_job *job, const tn_option_list *rules);

/* Writes for each house line of the file which of the rules match it, as `tartan match` does. */
void tn_job_match_houses(tn_job *job, const tn_option_list *rules, const char *path, tn_house_answer answer,
                         const char *output, size_t max_length);

#endif
