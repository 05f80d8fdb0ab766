/* Constructors of sums and comparisons, and of what is written shorter than it means: `implies`, `every`, quantifiers,
 * calls, open plans. */
#include "compiler/plan/syntax/ast.h"

static tn_ast_expr *two(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_expr *left, tn_ast_expr *right)
{
    if (!left || !right)
        return NULL;
    return tn_ast_of(parse, kind, span, tn_ast_append(tn_ast_one(left), right));
}

tn_operator tn_operator_turned(tn_operator op)
{
    static const tn_operator other[] = {[TN_LESS] = TN_GREATER,    [TN_AT_MOST] = TN_AT_LEAST, [TN_EQUAL] = TN_EQUAL,
                                        [TN_UNEQUAL] = TN_UNEQUAL, [TN_AT_LEAST] = TN_AT_MOST, [TN_GREATER] = TN_LESS};
    return other[op];
}

/* A sum of one field with a condition keeps the form that it had before there were others. */
tn_ast_expr *tn_ast_sum(tn_parse *parse, tn_span span, tn_ast_expr *figure, tn_ast_expr *part, tn_ast_region region,
                        tn_ast_cond *condition)
{
    tn_ast_expr *expr = tn_ast_of(parse, TN_EXPR_SUM, span, tn_ast_one(part));
    if (!expr || !figure)
        return NULL;
    expr->condition = condition;
    expr->region = region;
    if (figure->kind == TN_EXPR_FIGURE) {
        expr->name = figure->name;
        expr->detail = figure->detail;
    }
    expr->figure = figure;
    return expr;
}

tn_ast_expr *tn_ast_extreme(tn_parse *parse, tn_span span, tn_ast_extreme_kind extreme, tn_ast_expr *figure,
                            tn_ast_expr *part)
{
    tn_ast_expr *expr = figure ? tn_ast_of(parse, TN_EXPR_EXTREME, span, tn_ast_one(part)) : NULL;
    if (!expr)
        return NULL;
    expr->extreme = extreme;
    expr->figure = figure;
    return expr;
}

tn_ast_expr *tn_ast_extreme_gap(tn_parse *parse, tn_span span, tn_ast_extreme_kind extreme, tn_ast_expr *source,
                                tn_ast_expr *destination, const tn_ast_word *by)
{
    tn_ast_expr *expr = two(parse, TN_EXPR_GAP, span, source, destination);
    if (!expr)
        return NULL;
    expr->extreme = extreme;
    expr->name = by;
    return expr;
}

tn_ast_expr *tn_ast_constant(tn_parse *parse, const tn_ast_word *word)
{
    if (!word)
        return NULL;
    tn_ast_expr *expr = tn_ast_leaf(parse, TN_EXPR_NUMBER, word->node.span);
    if (expr)
        expr->name = word;
    return expr;
}

tn_ast_expr *tn_ast_figure(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *detail)
{
    tn_ast_expr *expr = tn_ast_leaf(parse, TN_EXPR_FIGURE, span);
    if (!expr || !name)
        return NULL;
    expr->name = name;
    expr->detail = detail;
    return expr;
}

tn_ast_expr *tn_ast_arithmetic(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_expr *left, tn_ast_expr *right)
{
    return two(parse, kind, span, left, right);
}

tn_ast_expr *tn_ast_sum_compared(tn_parse *parse, tn_span span, tn_ast_expr *left, tn_operator op, tn_ast_expr *right)
{
    tn_ast_expr *expr = two(parse, TN_EXPR_COMPARE, span, left, right);
    if (expr)
        expr->op = op;
    return expr;
}

tn_ast_expr *tn_ast_sum_within(tn_parse *parse, tn_span span, tn_ast_expr *sum, tn_ast_expr *low, tn_ast_expr *high)
{
    if (!sum || !low || !high)
        return NULL;
    return tn_ast_of(parse, TN_EXPR_WITHIN, span, tn_ast_append(tn_ast_append(tn_ast_one(sum), low), high));
}

tn_ast_expr *tn_ast_sum_remainder(tn_parse *parse, tn_span span, tn_ast_expr *sum, tn_ast_expr *modulus, tn_operator op,
                                  tn_ast_expr *rest)
{
    if (!sum || !modulus || !rest)
        return NULL;
    tn_ast_list parts = tn_ast_append(tn_ast_append(tn_ast_one(sum), modulus), rest);
    tn_ast_expr *expr = tn_ast_of(parse, TN_EXPR_REMAINDER, span, parts);
    if (expr)
        expr->op = op;
    return expr;
}

tn_ast_expr *tn_ast_where(tn_parse *parse, tn_span span, tn_ast_expr *what, tn_ast_expr *where)
{
    return two(parse, TN_EXPR_WHERE, span, what, where);
}

tn_ast_expr *tn_ast_mixed(tn_parse *parse, tn_span span, tn_ast_expr *first)
{
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_IMPLIES_CHAINED, span, "it is not clear how far this `where` reaches");
    tn_help(parse->diagnostics, d, "use parentheses: `(a where b) implies c` or `a where (b implies c)`");
    return first;
}

tn_ast_expr *tn_ast_compared_chained(tn_parse *parse, tn_span span, tn_ast_expr *first)
{
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_CHAINED_COMPARISON, span, "a comparison has two sides, and this one has three");
    tn_help(parse->diagnostics, d, "write two comparisons joined by `and`, or a range such as `area in 90m2..120m2`");
    return first;
}

tn_ast_expr *tn_ast_implies(tn_parse *parse, tn_span span, tn_ast_expr *left, tn_ast_expr *right)
{
    return two(parse, TN_EXPR_IMPLIES, span, left, right);
}

tn_ast_expr *tn_ast_implies_chained(tn_parse *parse, tn_span span, tn_ast_expr *first)
{
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_IMPLIES_CHAINED, span, "it is not clear which `implies` comes first");
    tn_help(parse->diagnostics, d, "use parentheses: `(a implies b) implies c` or `a implies (b implies c)`");
    return first;
}

tn_ast_expr *tn_ast_every(tn_parse *parse, tn_span span, tn_ast_expr *which, tn_ast_expr *what)
{
    return two(parse, TN_EXPR_EVERY, span, which, what);
}

tn_ast_expr *tn_ast_near(tn_parse *parse, tn_span span, tn_nearness near, tn_ast_expr *source, tn_ast_expr *distance,
                         tn_ast_expr *destination)
{
    tn_ast_expr *expr = two(parse, TN_EXPR_NEAR, span, source, destination);
    if (!expr || (near != TN_NEAR_BESIDE && !distance))
        return NULL;
    expr->near = near;
    if (distance)
        expr->parts = tn_ast_append(expr->parts, distance);
    return expr;
}

tn_ast_expr *tn_ast_near_chained(tn_parse *parse, tn_span span, tn_ast_expr *first)
{
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_CHAINED_COMPARISON, span, "a relation has two sides, and this one has three");
    tn_help(parse->diagnostics, d,
            "write two relations joined by `and`: `a beside b and b beside c`; `neighbour(a, b, c)` is in this order");
    return first;
}

tn_ast_expr *tn_ast_every_near(tn_parse *parse, tn_span span, tn_ast_expr *near)
{
    (void)parse;
    if (!near)
        return NULL;
    near->kind = TN_EXPR_EVERY_NEAR;
    near->node.span = span;
    return near;
}

tn_ast_expr *tn_ast_quantifier(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list names,
                               const tn_ast_word *field, tn_ast_expr *part)
{
    if (!part || !field)
        return NULL;
    tn_ast_expr *expr = tn_ast_of(parse, kind, span, tn_ast_one(part));
    if (expr) {
        expr->names = names;
        expr->name = field;
    }
    return expr;
}

tn_ast_expr *tn_ast_call(tn_parse *parse, tn_span span, const tn_ast_word *name, tn_ast_list arguments)
{
    if (!name)
        return NULL;
    tn_ast_expr *expr = tn_ast_of(parse, TN_EXPR_CALL, span, arguments);
    if (expr)
        expr->name = name;
    return expr;
}

tn_ast_expr *tn_ast_range_of(tn_parse *parse, tn_span span, tn_ast_expr *low, tn_ast_expr *high)
{
    if (!low)
        return NULL;
    return high ? two(parse, TN_EXPR_RANGE, span, low, high) : tn_ast_of(parse, TN_EXPR_RANGE, span, tn_ast_one(low));
}

tn_ast_expr *tn_ast_open_tray(tn_parse *parse, tn_span span, tn_ast_list items)
{
    tn_ast_expr *tray = tn_ast_tray_new(parse, span, items);
    if (tray)
        tray->loose = true;
    return tray;
}

tn_ast_expr *tn_ast_gap(tn_parse *parse, tn_span span)
{
    tn_ast_expr *any = tn_ast_leaf(parse, TN_EXPR_ANY, span);
    tn_ast_expr *many = any ? tn_ast_of(parse, TN_EXPR_MANY, span, tn_ast_one(any)) : NULL;
    return many ? tn_ast_of(parse, TN_EXPR_OPTIONAL, span, tn_ast_one(many)) : NULL;
}
