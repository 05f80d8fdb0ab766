/* Explains a plan by the rules or the library of a file. */
#include "driver/plan/explain.h"

#include <stdlib.h>

#include "runtime/plan/schema/sum.h"

static tn_status explain_function(const tn_explained *explained, uint32_t function, size_t max_length, bool *holds,
                                  tn_explanation *why, tn_error *error)
{
    tn_status status =
        tn_explain(explained->schema, function, explained->trays, explained->length, max_length, why, error);
    *holds = status == TN_OK && why->nodes[0].matched;
    return status;
}

static tn_status explain_one(tn_explained *explained, tn_explained_rule *rule, uint32_t function, size_t max_length,
                             tn_error *error)
{
    return explain_function(explained, function, max_length, &rule->holds, &rule->why, error);
}

/* What a rule says of itself stands for a preference that says nothing. */
static tn_status explain_preference(tn_explained *explained, uint32_t i, size_t max_length, tn_error *error)
{
    const tn_module *module = explained->opened->module;
    const tn_library_record *library = explained->library;
    const tn_preference_record *preference = &module->PREFERENCE_records[library->preference_first + i];
    const tn_term_record *term = tn_preferred_term(module, library, i);
    tn_preference_reason *made = &explained->preferences[explained->preference_count++];
    *made = (tn_preference_reason){.name = tn_text(module, preference->name),
                                   .doc = tn_text(module, preference->doc),
                                   .worth = tn_text(module, term->factor)};
    return explain_function(explained, term->part, max_length, &made->met, &made->why, error);
}

void tn_explained_preferred(const tn_explained *explained, mpq_t met, mpq_t all)
{
    mpq_t worth;
    mpq_init(worth);
    mpq_set_ui(met, 0, 1);
    mpq_set_ui(all, 0, 1);
    for (size_t i = 0; i < explained->preference_count; i++) {
        mpq_set_str(worth, explained->preferences[i].worth, 10);
        mpq_add(all, all, worth);
        if (explained->preferences[i].met)
            mpq_add(met, met, worth);
    }
    mpq_clear(worth);
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
    if (status == TN_OK && made->drops && clause->kind == TN_CLAUSE_GENERATE)
        status = tn_generated_beginning_find(explained->schema, clause->holds, explained->library->trays_min,
                                             explained->library->trays_max, explained->trays, explained->length,
                                             &made->beginning, error);
    return status;
}

tn_status tn_explained_make(tn_explained *explained, const tn_opened *opened, const tn_schema *schema,
                            const tn_library_record *library, const uint32_t *rules, size_t rule_count,
                            const tn_tray *trays, size_t length, size_t max_length, tn_error *error)
{
    size_t count = library ? library->clause_count : rule_count;
    *explained =
        (tn_explained){.opened = opened, .schema = schema, .library = library, .trays = trays, .length = length};
    uint32_t preferences = library ? library->preference_count : 0;
    explained->rules = calloc(count + 1, sizeof *explained->rules);
    explained->preferences = calloc((size_t)preferences + 1, sizeof *explained->preferences);
    if (!explained->rules || !explained->preferences)
        return tn_fail_memory(error);
    explained->length_drops = library && (length < library->trays_min || length > library->trays_max);
    explained->kept = library && !explained->length_drops;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && library && i < count; i++)
        status = explain_clause(explained, i, max_length, error);
    for (uint32_t i = 0; status == TN_OK && i < preferences; i++)
        status = explain_preference(explained, i, max_length, error);
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
    for (size_t i = 0; i < explained->count; i++) {
        tn_explanation_clear(&explained->rules[i].why);
        tn_generated_beginning_clear(&explained->rules[i].beginning);
    }
    for (size_t i = 0; i < explained->preference_count; i++)
        tn_explanation_clear(&explained->preferences[i].why);
    free(explained->preferences);
    free(explained->rules);
    tn_near_clear(&explained->near);
    *explained = (tn_explained){0};
}
