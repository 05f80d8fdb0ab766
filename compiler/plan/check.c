#include "compiler/plan/check.h"

static void check_rules(tn_check *check)
{
    tn_checked *result = check->result;
    for (size_t i = 0; i < result->rule_count; i++) {
        tn_checked_rule *rule = result->rules[i];
        check->unit = rule->unit;
        check->rule = rule;
        check->allow = rule->ast->allow;
        tn_check_allow(check, rule->ast->allow);
        rule->schema = tn_check_schema_for(check, rule->unit, rule->ast->using, rule->ast->name->node.span);
        check->schema = rule->schema;
        tn_check_expr(check, rule->ast->body);
    }
}

/* What needs callees to be checked before their callers. */
static void check_meanings(tn_check *check)
{
    tn_checked *result = check->result;
    for (size_t i = 0; i < result->rule_count; i++) {
        tn_checked_rule *rule = result->order[i];
        check->unit = rule->unit;
        check->rule = rule;
        check->schema = rule->schema;
        check->allow = rule->ast->allow;
        tn_ast_expr *body = rule->ast->body;
        rule->meaning = body->kind != TN_EXPR_NAME ? body : body->rule ? body->rule->meaning : NULL;
        rule->min_trays = tn_min_trays(body);
        tn_check_meaning(check, body);
        tn_check_warnings(check, body);
    }
}

tn_status tn_check_program(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports, tn_checked *result)
{
    tn_check check = {.arena = arena, .diagnostics = diagnostics, .imports = imports, .result = result};
    check.schemas.arena = check.names.arena = check.specs.arena = check.conditions.arena = arena;
    *result = (tn_checked){0};
    tn_check_collect(&check);
    if (tn_arena_failed(arena))
        return TN_MEMORY;
    for (size_t i = 0; i < result->schema_count && !tn_arena_failed(arena); i++)
        tn_check_schema(&check, result->schemas[i]);
    for (size_t i = 0; i < result->schema_count && !tn_arena_failed(arena); i++)
        tn_check_forbids(&check, result->schemas[i]);
    static void (*const steps[])(tn_check *) = {check_rules,        tn_check_order, check_meanings,
                                                tn_check_libraries, tn_check_forms, tn_check_tests, tn_check_allowances};
    for (size_t i = 0; i < sizeof steps / sizeof *steps && !tn_arena_failed(arena); i++)
        steps[i](&check);
    return tn_arena_failed(arena) ? TN_MEMORY : TN_OK;
}
