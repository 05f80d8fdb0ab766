/* Numbers that stand only in some places: what speaks of the whole plan (comparisons with `matches`, or of numbers of
 * houses) where the plan is meant, and what lies before or behind a stretch where a `where` says of which. */
#include "compiler/plan/check/check.h"

/* ---- the whole plan */

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

static void report_whole(tn_check *check, const tn_ast_expr *expr)
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
static bool walk_whole(tn_check *check, const tn_ast_expr *expr, bool level)
{
    bool whole =
        expr->whole || (expr->kind == TN_EXPR_NAME && expr->rule && !expr->rule->is_measure && expr->rule->about_plan);
    if (whole && !level)
        report_whole(check, expr);
    bool plan = expr->kind == TN_EXPR_MATCHES;
    bool through = level && (expr->kind == TN_EXPR_AND || expr->kind == TN_EXPR_OR || expr->kind == TN_EXPR_NOT ||
                             expr->kind == TN_EXPR_IMPLIES);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        bool inside = walk_whole(check, part, plan || through);
        whole = whole || (inside && !plan);
    }
    return whole;
}

bool tn_check_whole(tn_check *check, const tn_ast_expr *expr)
{
    return walk_whole(check, expr, true);
}

/* ---- before and behind a stretch */

static void report_around(tn_check *check, const tn_ast_expr *expr)
{
    const char *word = expr->region == TN_AST_BEFORE ? "before" : "after";
    tn_diagnostic *d = tn_report(check->diagnostics, E_AROUND_WHAT, expr->node.span,
                                 "this counts what lies %s a stretch, and it is not said which", word);
    tn_help(check->diagnostics, d,
            "say it behind `where`, joined by `and`, `or`, `not` and `implies` only: `tray(...) where quantity(any %s) "
            "= 2`",
            word);
}

/* Is the expression, if a `where` reaches it, still about the same stretch with all that is in it? */
static bool goes_through(tn_expr_kind kind)
{
    bool joined = kind == TN_EXPR_AND || kind == TN_EXPR_OR || kind == TN_EXPR_NOT || kind == TN_EXPR_IMPLIES;
    return joined || tn_compares_numbers(kind) || tn_is_arithmetic(kind);
}

static void walk_around(tn_check *check, const tn_ast_expr *expr, bool reached)
{
    if (expr->region != TN_AST_STRETCH && !reached)
        report_around(check, expr);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        bool second = expr->kind == TN_EXPR_WHERE && (const tn_ast_node *)part != expr->parts.first;
        walk_around(check, part, second || (reached && goes_through(expr->kind)));
    }
}

void tn_check_around(tn_check *check, const tn_ast_expr *expr)
{
    walk_around(check, expr, false);
}
