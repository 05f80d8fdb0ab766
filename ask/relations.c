/* relations: how rules of plans, and clauses about houses, relate. */
#include "ask/relations.h"

#include <stdlib.h>
#include <string.h>

#include "ask/questions.h"
#include "driver/plan/analysis.h"
#include "runtime/base/crew.h"
#include "runtime/plan/text/text.h"

const char *tn_relation_word(tn_rule_relation relation)
{
    static const char *const words[] = {
        [TN_RULES_UNKNOWN] = "unknown", [TN_RULES_EQUAL] = "equal",       [TN_RULES_APART] = "apart",
        [TN_RULES_INSIDE] = "inside",   [TN_RULES_CONTAINS] = "contains", [TN_RULES_OVERLAP] = "overlap",
    };
    return words[relation];
}

/* ---- rules */

typedef struct relating_rules {
    const tn_schema *schema;
    const tn_plan_analysis *analysis;
    bool examples;
} relating_rules;

static const char *rule_name(const relating_rules *r, size_t i)
{
    const tn_module *module = r->schema->module;
    return tn_text(module, module->RULE_records[tn_plan_analysis_rule(r->analysis, i)].name);
}

/* NULL if there is no such plan. */
static tn_status take_plan(const relating_rules *r, const tn_shown_plan *plan, char **to, tn_error *error)
{
    tn_buffer line = {0};
    if (!plan->shown)
        return TN_OK;
    bool written = tn_plan_write_line(r->schema, plan->trays, plan->length, &line) && tn_buffer_append(&line, "", 1);
    *to = line.data;
    return written ? TN_OK : tn_fail_memory(error);
}

static tn_status relate_pair(const relating_rules *r, size_t i, size_t j, tn_related_pair *pair, tn_error *error)
{
    tn_shown_plan plans[3];
    char **const to[3] = {&pair->both, &pair->only_a, &pair->only_b};
    pair->a = rule_name(r, i);
    pair->b = rule_name(r, j);
    pair->relation = tn_relation_word(tn_plan_analysis_relation(r->analysis, i, j));
    pair->has_both = pair->has_only_a = pair->has_only_b = r->examples;
    if (!r->examples)
        return TN_OK;
    tn_status status = tn_plan_analysis_examples(r->analysis, i, j, plans, error);
    for (int e = 0; e < 3; e++) {
        if (status == TN_OK)
            status = take_plan(r, &plans[e], to[e], error);
        tn_shown_plan_clear(&plans[e]);
    }
    return status;
}

static tn_status relate_rules(const relating_rules *r, tn_related *related, tn_error *error)
{
    size_t count = tn_plan_analysis_rule_count(r->analysis), pair = 0;
    related->has_schema = related->has_rules = true;
    related->schema = tn_text(r->schema->module, r->schema->record->name);
    related->rules.items = calloc(count + 1, sizeof *related->rules.items);
    if (!related->rules.items)
        return tn_fail_memory(error);
    related->rules.count = count;
    for (size_t i = 0; i < count; i++)
        related->rules.items[i] = rule_name(r, i);
    tn_status status = TN_NEW_LIST(related_pair, related->relations, count * (count - (count > 0)) / 2, error);
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; status == TN_OK && j < count; j++)
            status = relate_pair(r, i, j, &related->relations.items[pair++], error);
    return status;
}

/* ---- the whole */

static bool is_own(const tn_house_library_record *library)
{
    return !(library->flags & TN_IMPORTED);
}

static size_t own_house_libraries(const tn_module *module)
{
    size_t count = 0;
    for (size_t i = 0; i < module->HOUSE_LIBRARY_count; i++)
        count += is_own(&module->HOUSE_LIBRARY_records[i]);
    return count;
}

static tn_status relate_analysed(tn_session *session, const tn_relations_request *request,
                                 const tn_plan_analyses *analyses, tn_relations *relations)
{
    const tn_module *module = session->opened->module;
    size_t count = analyses->count, houses = own_house_libraries(module);
    tn_error error;
    tn_status status = TN_NEW_LIST(related, relations->items, count + houses, &error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const relating_rules r = {analyses->schemas[i], analyses->items[i], request->examples};
        status = relate_rules(&r, &relations->items.items[i], &error);
    }
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    for (size_t i = 0; status == TN_OK && i < module->HOUSE_LIBRARY_count; i++)
        if (is_own(&module->HOUSE_LIBRARY_records[i]))
            status =
                tn_relate_houses(session, request, &module->HOUSE_LIBRARY_records[i], &relations->items.items[count++]);
    return status;
}

tn_status tn_ask_relations(tn_session *session, const tn_relations_request *request, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    const tn_plan_analysis_options options = {
        .max_states = (uint32_t)request->max_states,
        .threads = request->has_threads ? (unsigned)request->threads : tn_crew_default(),
    };
    tn_plan_analyses analyses = {0};
    tn_error error;
    *answer = (tn_reply){0};
    if (module->RULE_count == 0 && own_house_libraries(module) == 0)
        return tn_session_refuse(session, NULL,
                                 "--relations is about rules of plans and libraries of houses, and %.200s has none",
                                 session->opened->path);
    tn_session_begins(session, "relating the rules");
    tn_status status = tn_plan_analyse(session->opened, &options, &analyses);
    if (status == TN_OK && tn_reply_new(&tn_message_relations, answer, &error) != TN_OK)
        status = tn_session_fail(session, &error);
    if (status == TN_OK)
        status = relate_analysed(session, request, &analyses, answer->value);
    tn_session_ends(session);
    tn_plan_analyses_free(&analyses);
    return status;
}
