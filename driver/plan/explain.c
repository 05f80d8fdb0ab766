/* Explains a plan by the rules or the library of a file. */
#include "driver/plan/explain.h"

#include <stdlib.h>

static tn_status explain_one(tn_explained *explained, tn_explained_rule *rule, uint32_t function, size_t max_length,
                             tn_error *error)
{
    tn_status status =
        tn_explain(explained->schema, function, explained->trays, explained->length, max_length, &rule->why, error);
    rule->holds = status == TN_OK && rule->why.nodes[0].matched;
    return status;
}

static tn_status explain_clause(tn_explained *explained, uint32_t i, size_t max_length, tn_error *error)
{
    const tn_module *module = explained->opened->module;
    const tn_clause_record *clause = &module->CLAUSE_records[explained->library->clause_first + i];
    uint32_t rule = tn_function_rule(module, clause->holds);
    tn_explained_rule *made = &explained->rules[explained->count++];
    const char *doc = tn_text(module, clause->doc);
    if (!*doc && rule != UINT32_MAX)
        doc = tn_text(module, module->RULE_records[rule].doc);
    *made = (tn_explained_rule){.name = tn_text(module, clause->name), .doc = doc, .clause = clause};
    tn_status status = explain_one(explained, made, clause->holds, max_length, error);
    made->drops = status == TN_OK && made->holds == (clause->kind == TN_CLAUSE_PRUNE);
    explained->kept = explained->kept && !made->drops;
    return status;
}

tn_status tn_explained_make(tn_explained *explained, const tn_opened *opened, const tn_schema *schema,
                            const tn_library_record *library, const uint32_t *rules, size_t rule_count,
                            const tn_tray *trays, size_t length, size_t max_length, tn_error *error)
{
    size_t count = library ? library->clause_count : rule_count;
    *explained =
        (tn_explained){.opened = opened, .schema = schema, .library = library, .trays = trays, .length = length};
    explained->rules = calloc(count + 1, sizeof *explained->rules);
    if (!explained->rules)
        return tn_fail_memory(error);
    explained->length_drops = library && (length < library->trays_min || length > library->trays_max);
    explained->kept = library && !explained->length_drops;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && library && i < count; i++)
        status = explain_clause(explained, i, max_length, error);
    for (size_t i = 0; status == TN_OK && !library && i < count; i++) {
        const tn_rule_record *record = &opened->module->RULE_records[rules[i]];
        tn_explained_rule *made = &explained->rules[explained->count++];
        *made = (tn_explained_rule){.name = tn_text(opened->module, record->name),
                                    .doc = tn_text(opened->module, record->doc)};
        status = explain_one(explained, made, record->holds, max_length, error);
    }
    return status;
}

tn_status tn_explained_near(tn_explained *explained, tn_near_finder *finder, size_t most, tn_error *error)
{
    if (explained->kept)
        return TN_OK;
    tn_near_clear(&explained->near);
    tn_status status = tn_near_find(finder, explained->trays, explained->length, most, &explained->near, error);
    explained->near_known = status == TN_OK;
    return status;
}

void tn_explained_clear(tn_explained *explained)
{
    for (size_t i = 0; i < explained->count; i++)
        tn_explanation_clear(&explained->rules[i].why);
    free(explained->rules);
    tn_near_clear(&explained->near);
    *explained = (tn_explained){0};
}
