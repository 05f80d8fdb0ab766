/* Checks .plan files: schemas, rules, libraries and tests, in the order of their uses. */
#include "compiler/plan/check/check.h"

static void find_schemas(tn_check *check)
{
    tn_checked *result = check->result;
    for (size_t i = 0; i < result->rule_count; i++)
        tn_check_find_schema(check, result->rules[i]);
    for (size_t i = 0; i < check->template_count; i++) {
        tn_check_find_schema(check, check->templates[i]);
        tn_check_parameters(check, check->templates[i]);
    }
}

/* What is wrong inside a call is said once, with the call. */
static void note_call(tn_check *check, tn_checked_rule *rule, size_t errors)
{
    tn_diagnostics *diagnostics = check->diagnostics;
    if (!rule->call || diagnostics->error_count == errors || diagnostics->count == 0)
        return;
    tn_span place = rule->call->node.span;
    tn_note(diagnostics, &diagnostics->items[diagnostics->count - 1], &place, "%s",
            rule->of->is_template ? "it is called here"
            : rule->listed        ? "trays of this schema have it too"
                                  : "it is used here");
    rule->of->failed = true;
}

/* Is it a rule of an older schema, written out for a newer one? Then it was warned about where it is. */
static bool is_taken_over(const tn_checked_rule *rule)
{
    return rule->hidden && !rule->of->is_template;
}

static void check_rule(tn_check *check, tn_checked_rule *rule)
{
    check->unit = rule->unit;
    check->rule = rule;
    check->allow = rule->ast->allow;
    check->schema = rule->schema;
    check->quiet = is_taken_over(rule);
    if (rule->hidden && rule->of->failed) {
        rule->ast->body->kind = TN_EXPR_BROKEN;
        return;
    }
    size_t errors = check->diagnostics->error_count;
    if (!rule->hidden) {
        tn_check_allow(check, rule->ast->allow);
        check->met_param = false;
        tn_expand(check, &rule->ast->body);
        rule->settable = check->met_param;
    }
    check->settable = rule->settable;
    if (tn_arena_failed(check->arena))
        return;
    if (rule->is_measure)
        tn_check_sum_expr(check, rule->ast->body);
    else
        tn_check_expr(check, rule->ast->body);
    note_call(check, rule, errors);
    rule->failed |= check->diagnostics->error_count > errors;
}

/* ---- checking */

/* What needs callees to be checked before their callers. */
static void check_meaning(tn_check *check, tn_checked_rule *rule)
{
    check->unit = rule->unit;
    check->rule = rule;
    check->schema = rule->schema;
    check->allow = rule->ast->allow;
    check->quiet = is_taken_over(rule);
    tn_ast_expr *body = rule->ast->body;
    size_t errors = check->diagnostics->error_count;
    for (size_t i = 0; i < rule->use_count; i++)
        rule->settable |= rule->uses[i]->settable;
    check->settable = rule->settable;
    rule->meaning = body->kind != TN_EXPR_NAME ? body : body->rule ? body->rule->meaning : NULL;
    rule->min_trays = tn_min_trays(body);
    tn_check_meaning(check, body);
    if (rule->is_measure)
        tn_check_plan_measure(check, rule);
    tn_check_around(check, body);
    rule->about_plan = tn_check_whole(check, body) && !rule->is_measure;
    tn_check_warnings(check, body);
    note_call(check, rule, errors);
}

/* A constant, arithmetic of constants, values joined by `or` or after `not`. Names are looked up where it is used. */
static bool is_let_value(const tn_ast_expr *value)
{
    switch (value->kind) {
    case TN_EXPR_NUMBER:
    case TN_EXPR_NAME:
    case TN_EXPR_BROKEN:
        return true;
    case TN_EXPR_OR:
    case TN_EXPR_NOT:
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
    case TN_EXPR_NEGATIVE:
        for (TN_EACH(const tn_ast_expr, part, value->parts))
            if (!is_let_value(part))
                return false;
        return true;
    default:
        return false;
    }
}

void tn_check_let(tn_check *check, const tn_ast_expr *value)
{
    if (is_let_value(value))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_ARGUMENT, value->node.span,
                                 "`let` names a constant or values of a field, and this is neither");
    tn_help(check->diagnostics, d,
            "write `let wide = 4.8m` or `let wet = bath or kitchen`; a rule is named by `rule NAME = ...`");
}

/* Says which use themselves, whether or not anything uses them; and what params are. */
static void check_lets(tn_check *check)
{
    for (size_t u = 0; check->has_lets && u < check->imports->count; u++) {
        const tn_ast_file *file = check->imports->units[u]->tree;
        for (TN_EACH(tn_ast_top, item, file->items)) {
            bool let = item->kind == TN_ITEM_LET || item->kind == TN_ITEM_PARAM;
            const tn_checked_name *name =
                let ? tn_names_get(&check->names, ((const tn_ast_rule *)item)->name->text) : NULL;
            if (!name || !name->rule || &name->rule->ast->top != item)
                continue;
            tn_let_value(check, name->rule);
            if (name->rule->param)
                tn_check_param(check, name->rule);
        }
    }
}

void tn_check_settle(tn_check *check)
{
    tn_checked *result = check->result;
    size_t ordered = result->ordered;
    bool quiet = check->quiet, settable = check->settable;
    for (; result->rule_count > result->settled && !tn_arena_failed(check->arena); result->settled++)
        check_rule(check, result->rules[result->settled]);
    tn_check_order(check);
    for (size_t i = ordered; i < result->ordered; i++) {
        if (result->order[i]->circle == result->order[i])
            tn_check_circle(result->order + i);
        check_meaning(check, result->order[i]);
    }
    check->quiet = quiet;
    check->settable = settable;
}

tn_status tn_check_program(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports,
                           const tn_asked_for *asked, tn_checked *result)
{
    tn_check check = {.arena = arena, .diagnostics = diagnostics, .imports = imports, .asked = asked, .result = result};
    check.schemas.arena = check.names.arena = check.specs.arena = check.conditions.arena = check.calls.arena = arena;
    *result = (tn_checked){0};
    tn_check_collect(&check);
    if (tn_arena_failed(arena))
        return TN_MEMORY;
    check.in_schema = true;
    for (size_t i = 0; i < result->schema_count && !tn_arena_failed(arena); i++)
        tn_check_schema(&check, result->schemas[i]);
    static void (*const of_schemas[])(tn_check *, tn_checked_schema *) = {tn_check_numbers, tn_check_forbids,
                                                                          tn_check_covered};
    for (size_t k = 0; k < sizeof of_schemas / sizeof *of_schemas; k++)
        for (size_t i = 0; i < result->schema_count && !tn_arena_failed(arena); i++)
            of_schemas[k](&check, result->schemas[i]);
    check.in_schema = false;
    static void (*const steps[])(tn_check *) = {
        tn_check_settings,       check_lets,         tn_check_forms,      find_schemas,      tn_check_older_measures,
        tn_check_settle,         tn_check_libraries, tn_check_rows,       tn_check_asked,    tn_check_unused,
        tn_check_number_records, tn_check_tests,     tn_check_allowances, tn_check_settable, tn_check_list_params};
    for (size_t i = 0; i < sizeof steps / sizeof *steps && !tn_arena_failed(arena); i++)
        steps[i](&check);
    for (size_t i = 0; i < result->schema_count; i++) {
        tn_choices_free(result->schemas[i]->choices);
        result->schemas[i]->choices = NULL;
    }
    return tn_arena_failed(arena) || check.out_of_memory ? TN_MEMORY : TN_OK;
}
