/* The rules that a command works on: those of --rule, or those that the file itself holds. */
#ifndef TARTAN_CLI_PLAN_CHOSEN_RULES_H
#define TARTAN_CLI_PLAN_CHOSEN_RULES_H

#include "cli/common/job.h"

typedef struct tn_chosen_rules {
    uint32_t *indices; /* RULE records, in file order or as asked for */
    size_t count;      /* at least one */
    uint32_t schema;   /* which all of them are about */
} tn_chosen_rules;

/* asked: the words of --rule. False where there are none, or where they are about different trays (then end the job).
 * `otherwise` says what to do where the file has no rules of its own. Clear them in any case. */
bool tn_job_choose_rules(tn_job *job, const tn_option_list *asked, const char *otherwise, tn_chosen_rules *chosen);
void tn_chosen_rules_clear(tn_chosen_rules *chosen);

#endif
