/* match, prune: which rules match plans and houses that are given, and which plans a library keeps. */
#include "ask/plan/match.h"

#include <stdlib.h>
#include <string.h>

#include "ask/house/typed.h"
#include "ask/plan/found.h"
#include "ask/session/questions.h"
#include "driver/plan/library.h"
#include "runtime/house/house.h"
#include "runtime/plan/match/vm.h"

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

/* ---- rules about houses */

bool tn_session_matches_houses(const tn_session *session, const tn_texts *rules)
{
    const tn_module *module = session->opened->module;
    for (size_t i = 0; i < rules->count; i++)
        if (tn_house_rule_find(module, rules->items[i]) != TN_NO_RECORD)
            return true;
    for (uint32_t i = 0; rules->count == 0 && i < module->HOUSE_RULE_count; i++)
        if (!(module->HOUSE_RULE_records[i].flags & TN_IMPORTED))
            return true;
    return false;
}

static tn_status add_rule(tn_house_matching *m, const char *name, uint32_t holds, uint32_t form)
{
    if (m->form != TN_NO_RECORD && form != TN_NO_RECORD && form != m->form)
        return tn_session_refuse(m->session, "choose rules about one form with --rule",
                                 "`%.80s` is about houses of another form than the rules before", name);
    m->form = form == TN_NO_RECORD ? m->form : form;
    m->rules[m->count++] = (tn_house_matching_rule){name, holds};
    return TN_OK;
}

static tn_status add_named(tn_house_matching *m, const char *name)
{
    const tn_module *module = m->session->opened->module;
    uint32_t found = tn_house_rule_find(module, name);
    if (found != TN_NO_RECORD)
        return add_rule(m, name, module->HOUSE_RULE_records[found].holds, module->HOUSE_RULE_records[found].form);
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (strcmp(tn_text(module, module->RULE_records[i].name), name) == 0)
            return add_rule(m, name, module->RULE_records[i].holds, TN_NO_RECORD);
    return tn_session_refuse(m->session, "name a rule of the file, or of one that it uses",
                             "the file has no rule `%.80s`", name);
}

static tn_status add_own(tn_house_matching *m)
{
    const tn_module *module = m->session->opened->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *rule = &module->HOUSE_RULE_records[i];
        if (!(rule->flags & TN_IMPORTED))
            status = add_rule(m, tn_text(module, rule->name), rule->holds, rule->form);
    }
    return status;
}

tn_status tn_house_matching_open(tn_session *session, const tn_texts *rules, size_t max_length, tn_house_matching *m)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    *m = (tn_house_matching){.session = session, .form = TN_NO_RECORD, .max_length = max_length};
    m->rules = malloc((rules->count + module->HOUSE_RULE_count + 1) * sizeof *m->rules);
    if (!m->rules) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = rules->count > 0 ? TN_OK : add_own(m);
    for (size_t i = 0; status == TN_OK && i < rules->count; i++)
        status = add_named(m, rules->items[i]);
    if (status != TN_OK)
        return status;
    status = tn_house_judge_open(module, m->form, max_length, &m->judge, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

void tn_house_matching_close(tn_house_matching *m)
{
    tn_house_judge_close(&m->judge);
    free(m->rules);
}

tn_status tn_house_match(tn_house_matching *m, const char *line, bool *holds, tn_error *error)
{
    const tn_typed_among among = {
        .form = &m->judge.form, .form_number = m->form, .max_length = m->max_length, .tiles_free = true};
    tn_first_mistake first = {0};
    tn_typed_told told;
    tn_house house = {0};
    tn_status status = tn_typed_find(&among, line, strlen(line), tn_keep_first_mistake, &first, &house, &told, error);
    tn_typed_told_clear(&told);
    if (first.any)
        *error = first.error;
    if (status == TN_OK)
        status = tn_house_rules_start(m->judge.rules, &house, error);
    for (size_t i = 0; status == TN_OK && i < m->count; i++)
        status = tn_house_rules_hold(m->judge.rules, m->rules[i].holds, &holds[i], error);
    tn_house_clear(&house);
    return status;
}

/* ---- match */

/* Room for `count` texts in an empty list, of which there are none yet. */
static tn_status texts_room(tn_texts *texts, size_t count, tn_error *error)
{
    texts->items = calloc(count + 1, sizeof *texts->items);
    return texts->items ? TN_OK : tn_fail_memory(error);
}

/* The names of those that hold. */
static tn_status name_holding(const tn_texts *all, const bool *holds, tn_texts *to, tn_error *error)
{
    tn_status status = texts_room(to, all->count, error);
    for (size_t i = 0; status == TN_OK && i < all->count; i++)
        if (holds[i])
            to->items[to->count++] = all->items[i];
    return status;
}

/* An answer with room for so many rules and plans, and `holds` for the rules. */
static tn_status begin(size_t rules, size_t plans, tn_reply *answer, bool **holds, tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_matched_plans, answer, error);
    tn_matched_plans *to = answer->value;
    *holds = malloc(rules + 1);
    if (status == TN_OK && !*holds)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = texts_room(&to->rules, rules, error);
    return status == TN_OK ? TN_NEW_LIST(matched_plan, to->plans, plans, error) : status;
}

static tn_status match_house(tn_house_matching *m, const char *line, bool *holds, const tn_texts *rules,
                             tn_matched_plan *to)
{
    tn_error error = {0};
    to->has_house = true;
    to->house = line;
    if (tn_house_match(m, line, holds, &error) != TN_OK)
        return tn_session_bad_text(m->session, &error, "PLANS", line);
    tn_status status = name_holding(rules, holds, &to->rules, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(m->session, &error);
}

static tn_status match_all_houses(tn_house_matching *m, const tn_match_request *request, tn_reply *answer)
{
    tn_error error;
    bool *holds;
    tn_status status = begin(m->count, request->plans.count, answer, &holds, &error);
    tn_matched_plans *to = answer->value;
    if (status != TN_OK)
        tn_session_fail(m->session, &error);
    for (size_t i = 0; status == TN_OK && i < m->count; i++)
        to->rules.items[to->rules.count++] = m->rules[i].name;
    for (size_t i = 0; status == TN_OK && i < request->plans.count; i++)
        status = match_house(m, request->plans.items[i], holds, &to->rules, &to->plans.items[i]);
    free(holds);
    return status;
}

static tn_status match_houses(tn_session *session, const tn_match_request *request, size_t longest, tn_reply *answer)
{
    tn_house_matching m;
    tn_status status = tn_house_matching_open(session, &request->rules, longest, &m);
    if (status == TN_OK)
        status = match_all_houses(&m, request, answer);
    tn_house_matching_close(&m);
    return status;
}

/* Plans and the rules that they are matched by, ready. */
typedef struct plan_matching {
    tn_session *session;
    const tn_schema *schema;
    tn_rules *rules;
    tn_matcher *matcher;
    size_t count, longest;
    uint64_t *bits;
    bool *holds;
} plan_matching;

/* holds[rule] of the plan of a text, whose trays the caller frees. */
static tn_status match_text(plan_matching *m, const char *text, tn_plan *plan)
{
    tn_error error;
    tn_status status = tn_session_plan_line(m->session, m->schema, text, m->longest, plan);
    if (status != TN_OK)
        return status;
    if (tn_match(m->matcher, plan->trays, plan->length, m->bits, &error) != TN_OK)
        return tn_session_fail(m->session, &error);
    for (size_t i = 0; i < m->count; i++)
        m->holds[i] = m->bits[i / 64] >> (i % 64) & 1;
    return TN_OK;
}

static tn_status match_plan(plan_matching *m, size_t number, const char *text, const tn_texts *rules,
                            tn_matched_plan *to)
{
    tn_error error;
    tn_plan plan = {0};
    tn_status status = match_text(m, text, &plan);
    to->has_line = to->has_plan = true;
    to->line = number + 1;
    if (status == TN_OK &&
        (tn_found_plan_texts(m->schema, plan.trays, (uint32_t)plan.length, &to->plan, NULL, &error) != TN_OK ||
         name_holding(rules, m->holds, &to->rules, &error) != TN_OK))
        status = tn_session_fail(m->session, &error);
    free(plan.trays);
    return status;
}

static tn_status match_all_plans(plan_matching *m, const tn_chosen_rules *chosen, const tn_match_request *request,
                                 tn_reply *answer)
{
    const tn_module *module = m->session->opened->module;
    tn_error error;
    tn_status status = begin(m->count, request->plans.count, answer, &m->holds, &error);
    tn_matched_plans *to = answer->value;
    m->bits = calloc(m->count / 64 + 1, sizeof *m->bits);
    if (status == TN_OK && !m->bits)
        status = tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_matcher_new(m->rules, &m->matcher, &error);
    if (status != TN_OK)
        return tn_session_fail(m->session, &error);
    for (size_t i = 0; i < m->count; i++)
        to->rules.items[to->rules.count++] = tn_text(module, module->RULE_records[chosen->indices[i]].name);
    for (size_t i = 0; status == TN_OK && i < request->plans.count; i++)
        status = match_plan(m, i, request->plans.items[i], &to->rules, &to->plans.items[i]);
    return status;
}

static void clear(plan_matching *m)
{
    tn_matcher_free(m->matcher);
    tn_rules_free(m->rules);
    free(m->bits);
    free(m->holds);
}

static tn_status compile(plan_matching *m, const tn_chosen_rules *chosen, const tn_rules_options *options,
                         tn_error *error)
{
    const tn_module *module = m->session->opened->module;
    uint32_t *functions = malloc((chosen->count + 1) * sizeof *functions);
    if (!functions)
        return tn_fail_memory(error);
    for (size_t i = 0; i < chosen->count; i++)
        functions[i] = module->RULE_records[chosen->indices[i]].holds;
    tn_status status = tn_rules_new(m->schema, functions, chosen->count, options, &m->rules, error);
    free(functions);
    return status;
}

static tn_status match_plans(tn_session *session, const tn_match_request *request, size_t longest, tn_reply *answer)
{
    static const char otherwise[] = "name one of those it uses with --rule, or filter with `tartan prune`";
    const tn_rules_options options = {.max_states = (uint32_t)request->max_states, .max_length = longest};
    plan_matching m = {.session = session, .longest = longest};
    tn_chosen_rules chosen = {0};
    tn_schema *schema = NULL;
    tn_error error;
    tn_status status = tn_session_rules(session, &request->rules, otherwise, &chosen);
    if (status == TN_OK) {
        status = tn_schema_new(session->opened->module, chosen.schema, 0, &schema, &error);
        m.schema = schema;
        m.count = chosen.count;
        if (status == TN_OK)
            status = compile(&m, &chosen, &options, &error);
        status = status == TN_OK ? match_all_plans(&m, &chosen, request, answer) : tn_session_fail(session, &error);
    }
    clear(&m);
    tn_schema_free(schema);
    tn_chosen_rules_clear(&chosen);
    return status;
}

tn_status tn_ask_match(tn_session *session, const tn_match_request *request, tn_reply *answer)
{
    size_t longest = request->has_max_length ? (size_t)request->max_length : TN_VM_LENGTH_DEFAULT;
    *answer = (tn_reply){0};
    bool houses = tn_session_matches_houses(session, &request->rules);
    return (houses ? match_houses : match_plans)(session, request, longest, answer);
}

/* ---- prune */

/* Sets what drops the plan, if anything does. */
static tn_status judge(const plan_matching *m, const tn_ready_library *ready, const tn_library_asked *asked,
                       const tn_plan *plan, tn_pruned_plan *to, tn_error *error)
{
    const tn_module *module = m->session->opened->module;
    uint64_t least = asked->has_trays ? asked->trays.from : ready->record->trays_min,
             most = asked->has_trays ? asked->trays.to : ready->record->trays_max;
    tn_status status = texts_room(&to->dropped_by, m->count + 1, error);
    if (status == TN_OK && (plan->length < least || plan->length > most))
        to->dropped_by.items[to->dropped_by.count++] = "trays";
    for (size_t i = 0; status == TN_OK && i < m->count; i++)
        if (tn_clause_drops(module, ready->record, i, m->bits))
            to->dropped_by.items[to->dropped_by.count++] =
                tn_text(module, module->CLAUSE_records[ready->record->clause_first + i].name);
    to->has_dropped_by = to->dropped_by.count > 0;
    return status == TN_OK
               ? tn_found_plan_texts(m->schema, plan->trays, (uint32_t)plan->length, NULL, &to->members, error)
               : status;
}

static tn_status prune_plan(plan_matching *m, const tn_ready_library *ready, const tn_library_asked *asked,
                            const char *text, tn_pruned_plan *to)
{
    tn_error error;
    tn_plan plan = {0};
    tn_status status = match_text(m, text, &plan);
    if (status == TN_OK && judge(m, ready, asked, &plan, to, &error) != TN_OK)
        status = tn_session_fail(m->session, &error);
    free(plan.trays);
    return status;
}

static tn_status make_ready(plan_matching *m, const tn_ready_library *ready, const tn_prune_request *request,
                            tn_reply *answer, tn_error *error)
{
    const tn_rules_options options = {.max_states = (uint32_t)request->subject.max_states, .max_length = m->longest};
    tn_status status = tn_clause_rules_new(m->schema, ready->record, &options, &m->rules, error);
    if (status == TN_OK)
        status = tn_matcher_new(m->rules, &m->matcher, error);
    m->bits = calloc(m->count / 64 + 1, sizeof *m->bits);
    m->holds = calloc(m->count + 1, sizeof *m->holds);
    if (status == TN_OK && !(m->bits && m->holds))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_reply_new(&tn_message_pruned_plans, answer, error);
    if (status != TN_OK)
        return status;
    tn_pruned_plans *to = answer->value;
    to->library = tn_text(m->session->opened->module, ready->record->name);
    return TN_NEW_LIST(pruned_plan, to->plans, request->plans.count, error);
}

tn_status tn_ask_prune(tn_session *session, const tn_prune_request *request, tn_reply *answer)
{
    tn_ready_library ready = {0};
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_library_ready(session->opened, request->subject.library, NULL, &ready);
    if (status != TN_OK)
        return status;
    plan_matching m = {.session = session,
                       .schema = ready.schema,
                       .count = ready.record->clause_count,
                       .longest = tn_asked_length(&request->subject)};
    status = make_ready(&m, &ready, request, answer, &error);
    if (status != TN_OK)
        tn_session_fail(session, &error);
    tn_pruned_plans *to = answer->value;
    for (size_t i = 0; status == TN_OK && i < request->plans.count; i++)
        status = prune_plan(&m, &ready, &request->subject, request->plans.items[i], &to->plans.items[i]);
    clear(&m);
    tn_library_close(&ready);
    return status;
}
