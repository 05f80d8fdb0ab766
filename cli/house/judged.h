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

/* Is the text a house line, and not a plan? */
bool tn_is_house_line(const char *text);

/* Says which clauses of the house library (NULL: the only one) keep the house out, or which of the rules match it. */
void tn_job_explain_house(tn_job *job, const char *library, const tn_option_list *rules, const char *line, bool full,
                          bool json, size_t max_length);

/* Says which cells keep all houses of a library off a plan (a line, or #P). */
void tn_job_explain_plan(tn_job *job, const tn_house_settings *settings, const char *text, bool json);

/* Appends the line of the house #P:V. False: reported. */
bool tn_job_house_line(tn_job *job, const tn_house_settings *settings, const char *number, tn_buffer *line);

#endif
