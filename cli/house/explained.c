/* Says why a house is kept or dropped, clause by clause, or which rules match it. */
#include <stdlib.h>
#include <string.h>

#include "cli/house/explained_parts.h"
#include "cli/house/houses.h"
#include "runtime/base/utf8.h"

bool tn_is_house_line(const char *text)
{
    return strchr(text, ';') != NULL;
}

static bool choose(tn_house_explaining *e, const char *library, uint32_t *form)
{
    const tn_module *module = e->job->opened.module;
    tn_diagnostic *d;
    if (e->rules->count > 0) {
        uint32_t rule = tn_house_rule_find(module, e->rules->items[0]);
        *form = rule == TN_NO_RECORD ? 0 : module->HOUSE_RULE_records[rule].form;
        if (rule != TN_NO_RECORD)
            return true;
        d = tn_job_usage(e->job, "the file has no rule `%.80s` about houses", e->rules->items[0]);
        tn_help(tn_job_diagnostics(e->job), d, "name a rule that asks for cells, rooms or sections");
        return false;
    }
    uint32_t found = tn_house_library_find(module, library);
    if (found != TN_NO_RECORD) {
        e->library = &module->HOUSE_LIBRARY_records[found];
        *form = e->library->form;
        return true;
    }
    tn_job_answered(e->job, tn_say_no_houses(&(e->job)->session, library));
    return false;
}

/* ---- a library */

static const char *said(const tn_house_clause *clause)
{
    if (clause->trays)
        return clause->drops ? "no plan of its has so many trays" : "the number of trays is one of its";
    if (clause->kind == TN_CLAUSE_PRUNE)
        return clause->drops ? "matches, and is pruned" : "does not match";
    return clause->drops ? "does not hold, and is required" : "holds, as required";
}

static tn_status write_clause(tn_house_explaining *e, const tn_house_clause *clause, tn_error *error)
{
    tn_buffer_printf(&e->text, "%s %s: %s%s%s%s\n", clause->drops ? "-" : "+", clause->name, said(clause),
                     clause->of_plans ? ", by the plan alone" : "", *clause->doc ? "; " : "", clause->doc);
    return clause->function == TN_NO_RECORD ? TN_OK : tn_explain_why(e, clause->function, error);
}

static tn_status write_clause_json(tn_house_explaining *e, const tn_house_clause *clause, tn_error *error)
{
    static const char *const kinds[] = {"require", "total", "prune"};
    tn_json_object(e->json, NULL);
    tn_json_string(e->json, "name", clause->name);
    tn_json_string(e->json, "kind", clause->trays ? "trays" : kinds[clause->kind]);
    tn_json_string(e->json, "of", clause->of_plans ? "plan" : "house");
    tn_json_bool(e->json, "holds", clause->holds);
    tn_json_bool(e->json, "drops", clause->drops);
    tn_json_list(e->json, "why");
    tn_status status = clause->function == TN_NO_RECORD ? TN_OK : tn_explain_why(e, clause->function, error);
    tn_json_list_end(e->json);
    tn_json_object_end(e->json);
    return status;
}

static tn_status write_library(tn_house_explaining *e, const char *line, tn_error *error)
{
    tn_house_clause *clauses = NULL;
    size_t count = 0;
    bool dropped = false, of_plans = false;
    uint32_t bare = 0;
    const char *name = tn_text(e->judge.module, e->library->name);
    tn_status status = tn_house_judge_clauses(&e->judge, e->library, &e->house, &clauses, &count, error);
    for (size_t i = 0; i < count; i++)
        dropped |= clauses[i].drops;
    if (status == TN_OK)
        status = tn_explain_next_bare(e, &bare, error);
    dropped |= bare < e->house.cell_count;
    if (e->json) {
        tn_json_object(e->json, NULL);
        tn_json_string(e->json, "house", line);
        tn_json_string(e->json, "library", name);
        tn_json_bool(e->json, "kept", !dropped);
        tn_json_list(e->json, "clauses");
    } else {
        tn_buffer_printf(&e->text, "`%s` %s this house\n", name, dropped ? "drops" : "keeps");
    }
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        if (e->json)
            status = write_clause_json(e, &clauses[i], error);
        else if (e->full || clauses[i].drops)
            status = write_clause(e, &clauses[i], error);
        of_plans |= clauses[i].drops && clauses[i].of_plans;
    }
    if (e->json)
        tn_json_list_end(e->json);
    if (status == TN_OK)
        status = tn_explain_tiles(e, error);
    if (status == TN_OK && (e->full || e->json))
        tn_explain_behind_roofs(e);
    if (status == TN_OK && dropped && !of_plans)
        status = tn_explain_nearest(e, error);
    if (e->json) {
        tn_json_object_end(e->json);
        tn_json_end_line(e->json);
    }
    free(clauses);
    return status;
}

/* ---- rules */

static tn_status write_rule(tn_house_explaining *e, const char *name, tn_error *error)
{
    const tn_module *module = e->judge.module;
    uint32_t rule = tn_house_rule_find(module, name);
    bool holds = false;
    if (rule == TN_NO_RECORD || &module->FORM_records[module->HOUSE_RULE_records[rule].form] != e->judge.form.record)
        return tn_fail(error, TN_INVALID, E_NOT_IN_FILE, "there is no rule `%.80s` about houses of that form", name);
    tn_status status = tn_house_rules_hold(e->judge.rules, module->HOUSE_RULE_records[rule].holds, &holds, error);
    if (e->json) {
        tn_json_object(e->json, NULL);
        tn_json_string(e->json, "name", name);
        tn_json_bool(e->json, "matches", holds);
        tn_json_list(e->json, "why");
    } else {
        tn_buffer_printf(&e->text, "%s `%s` %s this house\n", holds ? "+" : "-", name,
                         holds ? "matches" : "does not match");
    }
    if (status == TN_OK)
        status = tn_explain_why(e, module->HOUSE_RULE_records[rule].holds, error);
    if (e->json) {
        tn_json_list_end(e->json);
        tn_json_object_end(e->json);
    }
    return status;
}

static tn_status write_rules(tn_house_explaining *e, const char *line, tn_error *error)
{
    tn_status status = tn_house_rules_start(e->judge.rules, &e->house, error);
    if (e->json) {
        tn_json_object(e->json, NULL);
        tn_json_string(e->json, "house", line);
        tn_json_list(e->json, "rules");
    }
    for (size_t i = 0; status == TN_OK && i < e->rules->count; i++)
        status = write_rule(e, e->rules->items[i], error);
    if (e->json) {
        tn_json_list_end(e->json);
        tn_json_object_end(e->json);
        tn_json_end_line(e->json);
    }
    return status;
}

/* ---- the whole */

static void explain(tn_house_explaining *e, const char *line, size_t max_length)
{
    tn_error error = {0};
    tn_status status = tn_house_read_open(&e->judge.form, line, strlen(line), max_length, &e->house, &error);
    if (status == TN_INVALID) {
        tn_error_place(&error, error.column ? 1 : 0, error.column, error.column_end);
        tn_report_error(tn_job_diagnostics(e->job), &error, "HOUSE", line, strlen(line));
        tn_job_status(e->job, status);
        return;
    }
    if (status == TN_OK)
        status = e->library ? write_library(e, line, &error) : write_rules(e, line, &error);
    if (status == TN_OK && e->text.failed)
        status = tn_fail_memory(&error);
    tn_output out;
    if (status != TN_OK) {
        tn_job_fail(e->job, &error);
    } else if (tn_job_output(e->job, NULL, &out)) {
        if (e->json)
            fwrite(e->text.data, 1, e->text.size, out.stream);
        else
            tn_write_shown(out.stream, e->text.data, e->text.size);
        tn_job_commit(e->job, &out);
    }
}

void tn_job_explain_house(tn_job *job, const char *library, const tn_option_list *rules, const char *line, bool full,
                          bool json, size_t max_length)
{
    tn_house_explaining e = {.job = job, .rules = rules, .full = full};
    tn_json writer = tn_json_text(&e.text, TN_JSON_TIGHT);
    e.json = json ? &writer : NULL;
    uint32_t form;
    tn_error error;
    if (choose(&e, library, &form)) {
        if (tn_house_judge_open(job->opened.module, form, max_length, &e.judge, &error) == TN_OK)
            explain(&e, line, max_length);
        else
            tn_job_fail(job, &error);
    }
    tn_house_clear(&e.house);
    tn_house_judge_close(&e.judge);
    free(e.text.data);
}
