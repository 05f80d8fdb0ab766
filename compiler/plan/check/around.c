/* Counts and sums of what lies before or behind a stretch: they stand where a `where` says of which stretch. */
#include "compiler/plan/check/check.h"

static void report(tn_check *check, const tn_ast_expr *expr)
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

static void walk(tn_check *check, const tn_ast_expr *expr, bool reached)
{
    if (expr->region != TN_AST_STRETCH && !reached)
        report(check, expr);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        bool second = expr->kind == TN_EXPR_WHERE && (const tn_ast_node *)part != expr->parts.first;
        walk(check, part, second || (reached && goes_through(expr->kind)));
    }
}

void tn_check_around(tn_check *check, const tn_ast_expr *expr)
{
    walk(check, expr, false);
}
