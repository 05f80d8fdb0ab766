/* Comparisons of what a tray or sum comes to: `tray(beds >= 2)` and `sum(beds, n >= 12)`, as comparisons of sums. */
#include <string.h>

#include "compiler/plan/check/check.h"

tn_ast_expr *tn_expr_copy(tn_check *check, const tn_ast_expr *expr)
{
    tn_ast_expr *copy = TN_NEW(check->arena, tn_ast_expr);
    if (!copy)
        return NULL;
    *copy = *expr;
    copy->node.next = NULL;
    return copy;
}

static tn_ast_expr *make(tn_check *check, tn_expr_kind kind, tn_span span)
{
    tn_ast_expr *expr = TN_NEW(check->arena, tn_ast_expr);
    if (expr)
        *expr = (tn_ast_expr){.node.span = span, .kind = kind, .depth = 1, .from_sum = true};
    return expr;
}

static tn_ast_expr *constant(tn_check *check, const tn_ast_word *word)
{
    tn_ast_expr *expr = make(check, TN_EXPR_NUMBER, word->node.span);
    if (expr)
        expr->name = word;
    return expr;
}

static tn_ast_expr *compared(tn_check *check, tn_span span, const tn_ast_expr *sum, tn_operator op,
                             const tn_ast_word *word, bool turned)
{
    tn_ast_expr *expr = make(check, TN_EXPR_COMPARE, span), *left = tn_expr_copy(check, sum),
                *right = constant(check, word);
    if (!expr || !left || !right)
        return NULL;
    expr->op = op;
    expr->parts = turned ? tn_ast_append(tn_ast_one(right), left) : tn_ast_append(tn_ast_one(left), right);
    return expr;
}

static tn_ast_expr *within(tn_check *check, tn_span span, const tn_ast_expr *sum, const tn_ast_word *low,
                           const tn_ast_word *high)
{
    tn_ast_expr *expr = make(check, TN_EXPR_WITHIN, span), *value = tn_expr_copy(check, sum),
                *from = constant(check, low), *to = constant(check, high);
    if (!expr || !value || !from || !to)
        return NULL;
    expr->parts = tn_ast_append(tn_ast_append(tn_ast_one(value), from), to);
    return expr;
}

static tn_ast_expr *divided(tn_check *check, const tn_ast_cond *cond, const tn_ast_expr *sum)
{
    tn_ast_expr *expr = make(check, TN_EXPR_REMAINDER, cond->node.span), *value = tn_expr_copy(check, sum),
                *modulus = constant(check, cond->modulus), *rest = constant(check, cond->right);
    if (!expr || !value || !modulus || !rest)
        return NULL;
    expr->op = cond->op;
    expr->parts = tn_ast_append(tn_ast_append(tn_ast_one(value), modulus), rest);
    return expr;
}

static tn_ast_expr *broken(tn_check *check, tn_span span)
{
    return make(check, TN_EXPR_BROKEN, span);
}

/* ---- conditions of sums */

static tn_ast_expr *of_condition(tn_check *check, const tn_ast_cond *cond, const tn_ast_expr *sum,
                                 const tn_ast_word **variable);

static bool is_variable(tn_check *check, const tn_ast_word *word, const tn_ast_word **variable)
{
    if (!*variable)
        *variable = word;
    if (word->kind == TN_WORD_NAME && strcmp((*variable)->text, word->text) == 0)
        return true;
    if (word->broken)
        return false;
    tn_diagnostic *d;
    if (word->kind != TN_WORD_NAME) {
        d = tn_report(check->diagnostics, E_NO_VARIABLE, word->node.span, "a variable has to stand here, such as `n`");
        tn_help(check->diagnostics, d, "a condition says something about a number that you name: `n > 1`");
        return false;
    }
    d = tn_report(check->diagnostics, E_TWO_VARIABLES, word->node.span,
                  "a condition has one variable, and this one has `%s` and `%s`", (*variable)->text, word->text);
    tn_help(check->diagnostics, d, "use the same name for both, or join two rules by `and`");
    return false;
}

static tn_ast_expr *of_compare(tn_check *check, const tn_ast_cond *cond, const tn_ast_expr *sum,
                               const tn_ast_word **variable)
{
    bool turned = cond->left->kind != TN_WORD_NAME;
    const tn_ast_word *name = turned ? cond->right : cond->left, *number = turned ? cond->left : cond->right;
    if (!is_variable(check, name, variable))
        return broken(check, cond->node.span);
    if (number->kind != TN_WORD_NAME)
        return compared(check, cond->node.span, sum, cond->op, number, turned);
    tn_diagnostic *d = tn_report(check->diagnostics, E_TWO_VARIABLES, number->node.span,
                                 "a number must stand here, and `%s` is not one", number->text);
    tn_help(check->diagnostics, d, "a condition compares its one variable with numbers");
    return broken(check, cond->node.span);
}

static tn_ast_expr *of_parts(tn_check *check, tn_expr_kind kind, const tn_ast_cond *cond, const tn_ast_expr *sum,
                             const tn_ast_word **variable)
{
    tn_ast_expr *expr = make(check, kind, cond->node.span);
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        if (expr)
            expr->parts = tn_ast_append(expr->parts, of_condition(check, part, sum, variable));
    return expr;
}

static tn_ast_expr *of_condition(tn_check *check, const tn_ast_cond *cond, const tn_ast_expr *sum,
                                 const tn_ast_word **variable)
{
    switch (cond->kind) {
    case TN_COND_COMPARE:
        return of_compare(check, cond, sum, variable);
    case TN_COND_WITHIN:
        if (!is_variable(check, cond->left, variable))
            return broken(check, cond->node.span);
        return within(check, cond->node.span, sum, cond->range.low, cond->range.high);
    case TN_COND_AND:
        return of_parts(check, TN_EXPR_AND, cond, sum, variable);
    case TN_COND_OR:
        return of_parts(check, TN_EXPR_OR, cond, sum, variable);
    case TN_COND_NOT:
        return of_parts(check, TN_EXPR_NOT, cond, sum, variable);
    case TN_COND_REMAINDER:
        if (!is_variable(check, cond->left, variable))
            return broken(check, cond->node.span);
        return divided(check, cond, sum);
    }
    return NULL;
}

void tn_check_sum_condition(tn_check *check, tn_ast_expr *expr)
{
    tn_ast_expr *sum = tn_expr_copy(check, expr);
    if (!sum)
        return;
    sum->condition = NULL;
    tn_check_sum_expr(check, sum);
    const tn_ast_word *variable = NULL;
    tn_ast_expr *made = of_condition(check, expr->condition, sum, &variable);
    if (!made)
        return;
    tn_ast_node node = expr->node;
    *expr = *made;
    expr->node = node;
    expr->from_sum = true;
}

/* ---- numbers in specifiers */

static bool is_number(const tn_checked_schema *schema, const tn_ast_word *word)
{
    return word && word->kind == TN_WORD_NAME && tn_field_find(schema, word->text) == TN_NONE &&
           tn_schema_number(schema, word->text);
}

static const tn_ast_word *after_nots(const tn_ast_list *words, bool *negated)
{
    const tn_ast_word *word = (const tn_ast_word *)words->first;
    *negated = false;
    for (; word && word->kind == TN_WORD_NOT; word = (const tn_ast_word *)word->node.next)
        *negated = !*negated;
    return word;
}

static void report_test(tn_check *check, const tn_ast_word *name, tn_span span)
{
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_ITEM, span, "the number `%s` has to be compared", name->text);
    tn_help(check->diagnostics, d, "write `%s >= 2` or `%s in 2..4`", name->text, name->text);
}

/* [not] NUMBER op constant, or [not] NUMBER low..high */
static tn_ast_expr *test_of(tn_check *check, const tn_ast_alternative *alternative)
{
    bool negated = false;
    tn_span span = alternative->node.span;
    const tn_ast_word *name = after_nots(&alternative->words, &negated), *op = (const tn_ast_word *)name->node.next;
    const tn_ast_word *value = op && op->kind == TN_WORD_OPERATOR ? (const tn_ast_word *)op->node.next : op;
    tn_ast_expr *figure = make(check, TN_EXPR_FIGURE, name->node.span),
                *sum = make(check, TN_EXPR_SUM, name->node.span);
    if (!figure || !sum)
        return NULL;
    figure->name = name;
    sum->name = name;
    sum->figure = figure;
    tn_check_sum_expr(check, sum);
    if (!value || value->node.next || value->kind == TN_WORD_NAME || value->kind == TN_WORD_GROUP ||
        value->kind == TN_WORD_NOT || value->kind == TN_WORD_OPERATOR ||
        (value->kind == TN_WORD_RANGE && op != value)) {
        report_test(check, name, span);
        return broken(check, span);
    }
    tn_ast_expr *test = value->kind == TN_WORD_RANGE
                            ? within(check, span, sum, value->low, value->high)
                            : compared(check, span, sum, op == value ? TN_EQUAL : op->op, value, false);
    if (!negated || !test)
        return test;
    tn_ast_expr *opposite = make(check, TN_EXPR_NOT, span);
    if (opposite)
        opposite->parts = tn_ast_one(test);
    return opposite;
}

static bool about_number(const tn_checked_schema *schema, const tn_ast_alternative *alternative)
{
    bool negated = false;
    return is_number(schema, after_nots(&alternative->words, &negated));
}

void tn_check_tests_of_numbers(tn_check *check, tn_ast_expr *tray)
{
    tn_ast_list items = tn_ast_empty();
    bool any = false;
    for (TN_EACH(const tn_ast_item, item, tray->items))
        any = any || about_number(check->schema, (const tn_ast_alternative *)item->alternatives.first);
    if (!any)
        return;
    for (TN_EACH(const tn_ast_item, item, tray->items)) {
        tn_ast_item *copy = TN_NEW(check->arena, tn_ast_item);
        if (!copy)
            return;
        *copy = *item;
        copy->node.next = NULL;
        if (!about_number(check->schema, (const tn_ast_alternative *)item->alternatives.first)) {
            items = tn_ast_append(items, copy);
            continue;
        }
        tn_ast_expr *either = make(check, TN_EXPR_OR, item->node.span);
        for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
            if (about_number(check->schema, alternative)) {
                if (either)
                    either->parts = tn_ast_append(either->parts, test_of(check, alternative));
                continue;
            }
            tn_diagnostic *d = tn_report(check->diagnostics, E_OR_ACROSS_FIELDS, alternative->node.span,
                                         "`or` joins alternatives of one field or number");
            tn_help(check->diagnostics, d, "join two specifiers: `tray(...) or tray(...)`");
        }
        if (either)
            tray->tests = tn_ast_append(tray->tests, either->parts.count == 1 ? either->parts.first : &either->node);
    }
    tray->items = items;
}
