/* Finds the rules that a question names. */
#include "ask/chosen_rules.h"

#include <stdlib.h>

#include "driver/plan/library.h"

/* All that are wrong are said. */
static tn_status choose_asked(tn_session *session, const tn_texts *asked, tn_chosen_rules *chosen)
{
    tn_status gravest = TN_OK;
    for (size_t i = 0; i < asked->count; i++) {
        tn_status status = tn_rule_choose(session->opened, asked->items[i], &chosen->indices[chosen->count]);
        chosen->count += status == TN_OK;
        gravest = status == TN_OK ? gravest : status;
    }
    return gravest;
}

static tn_status choose_own(tn_session *session, const char *otherwise, tn_chosen_rules *chosen)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED))
            chosen->indices[chosen->count++] = i;
    if (chosen->count > 0)
        return TN_OK;
    tn_fail(&error, TN_INVALID, E_NOT_IN_FILE, "%.200s has no rules of its own", session->opened->path);
    tn_error_help(&error, "%s", tn_opened_help(session->opened, otherwise).text);
    return tn_session_fail(session, &error);
}

/* All rules have to be about the same trays, or the plans could not be read. */
static tn_status choose_schema(tn_session *session, tn_chosen_rules *chosen)
{
    const tn_module *module = session->opened->module;
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
        return tn_session_fail(session, &error);
    }
    return TN_OK;
}

tn_status tn_session_rules(tn_session *session, const tn_texts *asked, const char *otherwise, tn_chosen_rules *chosen)
{
    size_t most = asked->count + session->opened->module->RULE_count + 1;
    *chosen = (tn_chosen_rules){.indices = malloc(sizeof *chosen->indices * most)};
    if (!chosen->indices) {
        tn_error error;
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = asked->count ? choose_asked(session, asked, chosen) : choose_own(session, otherwise, chosen);
    return status == TN_OK ? choose_schema(session, chosen) : status;
}

void tn_chosen_rules_clear(tn_chosen_rules *chosen)
{
    free(chosen->indices);
    *chosen = (tn_chosen_rules){0};
}
