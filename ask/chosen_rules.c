/* Finds the rules that a command line names. */
#include "cli/plan/chosen_rules.h"

#include <stdlib.h>

#include "driver/plan/library.h"

static bool choose_asked(tn_job *job, const tn_option_list *asked, tn_chosen_rules *chosen)
{
    for (size_t i = 0; i < asked->count; i++) {
        tn_status status = tn_rule_choose(&job->opened, asked->items[i], &chosen->indices[chosen->count]);
        tn_job_status(job, status);
        chosen->count += status == TN_OK;
    }
    return chosen->count == asked->count;
}

static bool choose_own(tn_job *job, const char *otherwise, tn_chosen_rules *chosen)
{
    const tn_module *module = job->opened.module;
    tn_error error;
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED))
            chosen->indices[chosen->count++] = i;
    if (chosen->count > 0)
        return true;
    tn_fail(&error, TN_INVALID, E_NOT_IN_FILE, "%.200s has no rules of its own", job->opened.path);
    tn_error_help(&error, "%s", tn_opened_help(&job->opened, otherwise).text);
    tn_job_fail(job, &error);
    return false;
}

/* All rules have to be about the same trays, or the plans could not be read. */
static bool choose_schema(tn_job *job, tn_chosen_rules *chosen)
{
    const tn_module *module = job->opened.module;
    const tn_rule_record *first = &module->RULE_records[chosen->indices[0]];
    tn_error error;
    chosen->schema = first->schema;
    for (size_t i = 1; i < chosen->count; i++) {
        const tn_rule_record *rule = &module->RULE_records[chosen->indices[i]];
        if (rule->schema == first->schema)
            continue;
        tn_fail(&error, TN_INVALID, E_NOT_IN_FILE,
                "`%.80s` is about the trays of `%.80s`, `%.80s` about those of `%.80s`", tn_text(module, first->name),
                tn_text(module, module->SCHEMA_records[first->schema].name), tn_text(module, rule->name),
                tn_text(module, module->SCHEMA_records[rule->schema].name));
        tn_error_help(&error, "choose rules about the same trays with --rule");
        tn_job_fail(job, &error);
        return false;
    }
    return true;
}

bool tn_job_choose_rules(tn_job *job, const tn_option_list *asked, const char *otherwise, tn_chosen_rules *chosen)
{
    *chosen = (tn_chosen_rules){
        .indices = malloc(sizeof *chosen->indices * (asked->count + job->opened.module->RULE_count + 1))};
    if (!chosen->indices) {
        tn_error error;
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return false;
    }
    return (asked->count ? choose_asked(job, asked, chosen) : choose_own(job, otherwise, chosen)) &&
           choose_schema(job, chosen);
}

void tn_chosen_rules_clear(tn_chosen_rules *chosen)
{
    free(chosen->indices);
    *chosen = (tn_chosen_rules){0};
}
