/* Explains a house by the clauses of a library of houses and of its plans, or by rules. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/explain/explain.h"

/* The library that is named, or the first of the rules, says of which form the house is. */
static tn_status choose(tn_house_explaining *e, const tn_explain_request *request, uint32_t *form)
{
    const tn_module *module = e->session->opened->module;
    const char *library = request->subject.library;
    if (request->rules.count > 0) {
        uint32_t rule = tn_house_rule_find(module, request->rules.items[0]);
        *form = rule == TN_NO_RECORD ? 0 : module->HOUSE_RULE_records[rule].form;
        return rule != TN_NO_RECORD
                   ? TN_OK
                   : tn_session_refuse(e->session, "name a rule that asks for cells, rooms or sections",
                                       "the file has no rule `%.80s` about houses", request->rules.items[0]);
    }
    uint32_t found = tn_house_library_find(module, library);
    if (found == TN_NO_RECORD)
        return tn_say_no_houses(e->session, library);
    e->library = &module->HOUSE_LIBRARY_records[found];
    *form = e->library->form;
    return TN_OK;
}

/* ---- a library */

static tn_status set_clause(tn_house_explaining *e, const tn_house_clause *clause, tn_explained_house_clause *to,
                            tn_error *error)
{
    to->name = clause->name;
    to->doc = clause->doc;
    to->kind = clause->trays ? "trays" : tn_names_CLAUSE_KIND[clause->kind];
    to->of = clause->of_plans ? "plan" : "house";
    to->holds = clause->holds;
    to->drops = clause->drops;
    return clause->function == TN_NO_RECORD ? TN_OK : tn_explain_found(e, clause->function, TN_WHY(to->why), error);
}

/* drops: a clause does. by_plan: one about plans does. */
static tn_status set_clauses(tn_house_explaining *e, tn_explained_house *to, bool *drops, bool *by_plan,
                             tn_error *error)
{
    tn_house_clause *clauses = NULL;
    size_t count = 0;
    tn_status status = tn_house_judge_clauses(&e->judge, e->library, &e->house, &clauses, &count, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(explained_house_clause, to->clauses, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        *drops |= clauses[i].drops;
        *by_plan |= clauses[i].drops && clauses[i].of_plans;
        status = set_clause(e, &clauses[i], &to->clauses.items[i], error);
    }
    free(clauses);
    return status;
}

static tn_status explain_library(tn_house_explaining *e, tn_explained_house *to, tn_error *error)
{
    bool drops = false, by_plan = false;
    to->library = tn_text(e->judge.module, e->library->name);
    tn_status status = set_clauses(e, to, &drops, &by_plan, error);
    if (status == TN_OK)
        status = tn_explain_bare(e, (tn_list *)&to->bare, error);
    if (status == TN_OK)
        status = tn_explain_covered(e, (tn_list *)&to->behind_roofs, error);
    to->kept = !drops && to->bare.count == 0;
    to->has_nearest = !to->kept && !by_plan;
    return status == TN_OK && to->has_nearest ? tn_explain_nearest(e, to, error) : status;
}

/* ---- rules */

static tn_status explain_rule(tn_house_explaining *e, const char *name, tn_explained_house_rule *to, tn_error *error)
{
    const tn_module *module = e->judge.module;
    uint32_t rule = tn_house_rule_find(module, name);
    if (rule == TN_NO_RECORD || &module->FORM_records[module->HOUSE_RULE_records[rule].form] != e->judge.form.record)
        return tn_fail(error, TN_INVALID, E_NOT_IN_FILE, "there is no rule `%.80s` about houses of that form", name);
    uint32_t holds = module->HOUSE_RULE_records[rule].holds;
    to->name = name;
    tn_status status = tn_house_rules_hold(e->judge.rules, holds, &to->matches, error);
    return status == TN_OK ? tn_explain_found(e, holds, TN_WHY(to->why), error) : status;
}

static tn_status explain_rules(tn_house_explaining *e, const tn_texts *rules, tn_explained_house_by_rules *to,
                               tn_error *error)
{
    tn_status status = tn_house_rules_start(e->judge.rules, &e->house, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(explained_house_rule, to->rules, rules->count, error);
    for (size_t i = 0; status == TN_OK && i < rules->count; i++)
        status = explain_rule(e, rules->items[i], &to->rules.items[i], error);
    return status;
}

/* ---- the whole */

static tn_status explain(tn_house_explaining *e, const tn_explain_request *request, const char *line, tn_reply *answer)
{
    tn_error error = {0};
    bool library = e->library != NULL;
    tn_status status =
        tn_house_read_open(&e->judge.form, line, strlen(line), tn_asked_length(&request->subject), &e->house, &error);
    if (status != TN_OK)
        return tn_session_bad_text(e->session, &error, "HOUSE", line);
    status = tn_reply_new(library ? &tn_message_explained_house : &tn_message_explained_house_by_rules, answer, &error);
    tn_explained_house *of_library = status == TN_OK ? TN_REPLY(explained_house, answer) : NULL;
    tn_explained_house_by_rules *of_rules = status == TN_OK ? TN_REPLY(explained_house_by_rules, answer) : NULL;
    if (status == TN_OK) {
        char *copy = strdup(line);
        *(library ? &of_library->house : &of_rules->house) = copy;
        status = copy ? TN_OK : tn_fail_memory(&error);
    }
    if (status == TN_OK)
        status = library ? explain_library(e, of_library, &error) : explain_rules(e, &request->rules, of_rules, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(e->session, &error);
}

static tn_status explain_line(tn_session *session, const tn_explain_request *request, const char *line,
                              tn_reply *answer)
{
    tn_house_explaining e = {.session = session};
    uint32_t form;
    tn_error error;
    tn_status status = choose(&e, request, &form);
    if (status == TN_OK) {
        status =
            tn_house_judge_open(session->opened->module, form, tn_asked_length(&request->subject), &e.judge, &error);
        status = status == TN_OK ? explain(&e, request, line, answer) : tn_session_fail(session, &error);
    }
    tn_house_clear(&e.house);
    tn_house_judge_close(&e.judge);
    return status;
}

static tn_status write_line(void *line, const tn_house *house, tn_error *error)
{
    return tn_house_write(house, line, error);
}

tn_status tn_explain_house(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    tn_buffer line = {0};
    if (!tn_is_house_number(request->house))
        return explain_line(session, request, request->house, answer);
    tn_status status = tn_session_house(session, &settings, request->house, write_line, &line);
    if (status == TN_OK)
        status = explain_line(session, request, line.data, answer);
    free(line.data);
    return status;
}
