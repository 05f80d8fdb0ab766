/* What speaks of the whole plan (comparisons with `matches`, or of numbers of houses) stands only where the plan is
 * meant. */
#include "compiler/plan/check/check.h"

static const tn_ast_expr *comparison_in(const tn_ast_expr *expr)
{
    if (expr->whole)
        return expr;
    if (expr->kind == TN_EXPR_NAME)
        return expr->rule && expr->rule->about_plan && expr->rule->ast->body != expr
                   ? comparison_in(expr->rule->ast->body)
                   : NULL;
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        const tn_ast_expr *found = comparison_in(part);
        if (found)
            return found;
    }
    return NULL;
}

static void report(tn_check *check, const tn_ast_expr *expr)
{
    const tn_ast_expr *comparison = comparison_in(expr);
    bool houses =
        comparison && comparison->sum && (comparison->sum->houses || (comparison->high && comparison->high->houses));
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_WHOLE_PLAN, expr->node.span,
                  "this is about the whole %s, and stands where a part of it is meant", houses ? "house" : "plan");
    if (comparison && comparison != expr)
        tn_note(check->diagnostics, d, &comparison->node.span, "because of this comparison, which %s",
                houses ? "adds up over the house" : "has `matches` in it");
    if (houses)
        tn_help(check->diagnostics, d,
                "about a part of it write a condition, such as `quantity(cell(...), n > 1)`; or join this to other "
                "rules by `and`, `or`, `not` and `implies` only");
    else
        tn_help(check->diagnostics, d, "join it to other rules by `and`, `or`, `not` and `implies` only");
}

/* level: is the plan as a whole meant? */
static bool walk(tn_check *check, const tn_ast_expr *expr, bool level)
{
    bool whole =
        expr->whole || (expr->kind == TN_EXPR_NAME && expr->rule && !expr->rule->is_measure && expr->rule->about_plan);
    if (whole && !level)
        report(check, expr);
    bool plan = expr->kind == TN_EXPR_MATCHES;
    bool through = level && (expr->kind == TN_EXPR_AND || expr->kind == TN_EXPR_OR || expr->kind == TN_EXPR_NOT ||
                             expr->kind == TN_EXPR_IMPLIES);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        bool inside = walk(check, part, plan || through);
        whole = whole || (inside && !plan);
    }
    return whole;
}

bool tn_check_whole(tn_check *check, const tn_ast_expr *expr)
{
    return walk(check, expr, true);
}
