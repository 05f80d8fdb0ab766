/* Makes a form ready for judging houses, and asks each clause of a library about one. */
#include "driver/house/judge.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/house/house.h"

tn_status tn_house_judge_open(const tn_module *module, uint32_t form, size_t max_length, tn_house_judge *judge,
                              tn_error *error)
{
    *judge = (tn_house_judge){.module = module};
    tn_status status = tn_form_schema(module, form, &judge->schema, error);
    if (status != TN_OK)
        return status;
    tn_form_ready(module, form, judge->schema, &judge->form);
    return tn_house_rules_new(&judge->form, max_length, &judge->rules, error);
}

void tn_house_judge_close(tn_house_judge *judge)
{
    tn_house_rules_free(judge->rules);
    tn_schema_free(judge->schema);
    *judge = (tn_house_judge){0};
}

/* ---- clauses */

static tn_house_clause trays_clause(const tn_library_record *plans, size_t length)
{
    bool drops = length < plans->trays_min || length > plans->trays_max;
    return (tn_house_clause){.name = "trays",
                             .doc = "",
                             .kind = TN_CLAUSE_REQUIRE,
                             .of_plans = true,
                             .trays = true,
                             .function = TN_NO_RECORD,
                             .holds = !drops,
                             .drops = drops,
                             .file = plans->file,
                             .begin = plans->begin,
                             .end = plans->end};
}

static tn_status ask(tn_house_judge *judge, uint32_t function, tn_house_clause *clause, tn_error *error)
{
    tn_status status = tn_house_rules_hold(judge->rules, function, &clause->holds, error);
    clause->drops = clause->holds == (clause->kind == TN_CLAUSE_PRUNE);
    return status;
}

static tn_status ask_plans(tn_house_judge *judge, const tn_library_record *plans, tn_house_clause *clauses,
                           size_t *count, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < plans->clause_count; i++) {
        const tn_clause_record *record = &judge->module->CLAUSE_records[plans->clause_first + i];
        tn_house_clause *clause = &clauses[(*count)++];
        *clause = (tn_house_clause){.name = tn_text(judge->module, record->name),
                                    .doc = tn_text(judge->module, record->doc),
                                    .kind = record->kind,
                                    .of_plans = true,
                                    .function = TN_NO_RECORD,
                                    .file = record->file,
                                    .begin = record->begin,
                                    .end = record->end};
        status = ask(judge, record->holds, clause, error);
    }
    return status;
}

static tn_status ask_houses(tn_house_judge *judge, const tn_house_library_record *library, tn_house_clause *clauses,
                            size_t *count, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++) {
        const tn_house_clause_record *record = &judge->module->HOUSE_CLAUSE_records[library->clause_first + i];
        tn_house_clause *clause = &clauses[(*count)++];
        *clause = (tn_house_clause){.name = tn_text(judge->module, record->name),
                                    .doc = tn_text(judge->module, record->doc),
                                    .kind = record->kind,
                                    .function = record->holds,
                                    .file = record->file,
                                    .begin = record->begin,
                                    .end = record->end};
        status = ask(judge, record->holds, clause, error);
    }
    return status;
}

tn_status tn_house_judge_clauses(tn_house_judge *judge, const tn_house_library_record *library, const tn_house *house,
                                 tn_house_clause **clauses, size_t *count, tn_error *error)
{
    const tn_library_record *plans = &judge->module->LIBRARY_records[library->plans];
    *count = 0;
    *clauses = calloc((size_t)plans->clause_count + library->clause_count + 1, sizeof **clauses);
    if (!*clauses)
        return tn_fail_memory(error);
    tn_status status = tn_house_rules_start(judge->rules, house, error);
    (*clauses)[(*count)++] = trays_clause(plans, house->length);
    if (status == TN_OK)
        status = ask_plans(judge, plans, *clauses, count, error);
    return status == TN_OK ? ask_houses(judge, library, *clauses, count, error) : status;
}

/* ---- names */

uint32_t tn_house_library_find(const tn_module *module, const char *name)
{
    uint32_t own = TN_NO_RECORD, any = TN_NO_RECORD;
    size_t owns = 0;
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count; i++) {
        const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[i];
        if (name && strcmp(tn_text(module, library->name), name) == 0)
            return i;
        any = i;
        own = library->flags & TN_IMPORTED ? own : i;
        owns += !(library->flags & TN_IMPORTED);
    }
    if (name)
        return TN_NO_RECORD;
    return owns == 1 ? own : owns == 0 && module->HOUSE_LIBRARY_count == 1 ? any : TN_NO_RECORD;
}

uint32_t tn_house_rule_find(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->HOUSE_RULE_count; i++)
        if (strcmp(tn_text(module, module->HOUSE_RULE_records[i].name), name) == 0)
            return i;
    return TN_NO_RECORD;
}
