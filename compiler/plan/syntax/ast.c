/* Makes the syntax tree of .plan files. */
#include "compiler/plan/syntax/ast.h"

#include "compiler/common/limits.h"

tn_ast_list tn_ast_empty(void)
{
    return (tn_ast_list){0};
}

tn_ast_list tn_ast_append(tn_ast_list list, void *added)
{
    tn_ast_node *node = added;
    if (!node)
        return list;
    TN_CHAIN(&list, node);
    list.count++;
    return list;
}

tn_ast_list tn_ast_one(void *node)
{
    return tn_ast_append(tn_ast_empty(), node);
}

tn_ast_list tn_ast_join(tn_ast_list first, tn_ast_list second)
{
    if (!first.last)
        return second;
    if (!second.last)
        return first;
    first.last->next = second.first;
    return (tn_ast_list){first.first, second.last, first.count + second.count};
}

/* ---- words */

tn_ast_word *tn_ast_word_new(tn_parse *parse, tn_word_kind kind, tn_span span, const char *text, int64_t value)
{
    tn_ast_word *word = TN_NEW(parse->arena, tn_ast_word);
    if (word)
        *word = (tn_ast_word){.node.span = span, .kind = kind, .text = text, .value = value};
    return word;
}

tn_ast_word *tn_ast_not_word(tn_parse *parse, tn_span span)
{
    return tn_ast_word_new(parse, TN_WORD_NOT, span, "not", 0);
}

tn_ast_word *tn_ast_sign(tn_parse *parse, tn_span span)
{
    return tn_ast_word_new(parse, TN_WORD_SIGN, span, tn_arena_copy(parse->arena, parse->text + span.begin, 1), 0);
}

tn_ast_word *tn_ast_operator(tn_parse *parse, tn_span span, tn_operator op)
{
    tn_ast_word *word = tn_ast_word_new(parse, TN_WORD_OPERATOR, span, "", 0);
    if (word) {
        word->op = op;
        word->text = tn_arena_copy(parse->arena, parse->text + span.begin, span.end - span.begin);
    }
    return word;
}

tn_ast_word *tn_ast_negative(tn_parse *parse, tn_span span, const tn_ast_word *number)
{
    if (!number)
        return NULL;
    const char *text = tn_arena_copy(parse->arena, parse->text + span.begin, span.end - span.begin);
    tn_ast_word *word = tn_ast_word_new(parse, number->kind, span, text, -number->value);
    if (word)
        word->broken = number->broken;
    return word;
}

static tn_ast_word *word_of_two(tn_parse *parse, tn_word_kind kind, tn_span span, const tn_ast_word *low,
                                const tn_ast_word *high)
{
    if (!low || !high)
        return NULL;
    tn_ast_word *word = tn_ast_word_new(
        parse, kind, span, tn_arena_copy(parse->arena, parse->text + span.begin, span.end - span.begin), 0);
    if (word) {
        word->broken = low->broken || high->broken;
        word->low = low;
        word->high = high;
    }
    return word;
}

tn_ast_word *tn_ast_word_range(tn_parse *parse, tn_span span, const tn_ast_word *low, const tn_ast_word *high)
{
    return word_of_two(parse, TN_WORD_RANGE, span, low, high);
}

tn_ast_word *tn_ast_word_ratio(tn_parse *parse, tn_span span, const tn_ast_word *of, const tn_ast_word *to)
{
    return word_of_two(parse, TN_WORD_RATIO, span, of, to);
}

tn_ast_word *tn_ast_group(tn_parse *parse, tn_span span, tn_ast_list alternatives)
{
    if (++parse->groups > TN_NESTING_MAX) { /* in all: more than anybody writes, and recursion ends there */
        tn_ast_too_deep(parse, span);
        return NULL;
    }
    tn_ast_word *word = tn_ast_word_new(parse, TN_WORD_GROUP, span, "(", 0);
    if (word)
        word->group = tn_ast_item_new(parse, span, alternatives);
    return word && word->group ? word : NULL;
}

tn_ast_range tn_ast_range_new(tn_span span, const tn_ast_word *low, const tn_ast_word *high)
{
    return (tn_ast_range){low, high, span};
}

tn_ast_range tn_ast_range_dash(tn_parse *parse, tn_span span, const tn_ast_word *low, const tn_ast_word *high)
{
    if (low && high) {
        tn_diagnostic *d =
            tn_report(parse->diagnostics, E_RANGE_DASH, span, "a range is written with two dots, not with a dash");
        tn_advise(parse->diagnostics, d, "%s..%s", low->text, high->text);
    }
    return tn_ast_range_new(span, low, high);
}

/* ---- depth */

static uint32_t deeper(uint32_t depth, uint32_t other)
{
    return depth > other ? depth : other;
}

void tn_ast_too_deep(tn_parse *parse, tn_span span)
{
    if (parse->too_deep)
        return;
    parse->too_deep = true;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_TOO_DEEP, span,
                                 "expressions are nested more than %u deep, which is the limit", TN_NESTING_MAX);
    tn_help(parse->diagnostics, d, "give the inner parts names, as rules of their own, and use the names");
}

static bool too_deep(tn_parse *parse, uint32_t depth, tn_span span)
{
    if (depth <= TN_NESTING_MAX)
        return false;
    tn_ast_too_deep(parse, span);
    return true;
}

/* ---- conditions */

static tn_ast_cond *cond_new(tn_parse *parse, tn_cond_kind kind, tn_span span)
{
    tn_ast_cond *cond = TN_NEW(parse->arena, tn_ast_cond);
    if (cond)
        *cond = (tn_ast_cond){.node.span = span, .kind = kind, .depth = 1};
    return cond;
}

tn_ast_cond *tn_ast_compare(tn_parse *parse, tn_span span, const tn_ast_word *left, tn_operator op,
                            const tn_ast_word *right)
{
    tn_ast_cond *cond = cond_new(parse, TN_COND_COMPARE, span);
    if (!cond || !left || !right)
        return NULL;
    cond->left = left;
    cond->op = op;
    cond->right = right;
    return cond;
}

static bool upward(tn_operator op)
{
    return op == TN_LESS || op == TN_AT_MOST;
}

tn_ast_cond *tn_ast_chained(tn_parse *parse, tn_span span, tn_ast_cond *first, tn_operator op, const tn_ast_word *right)
{
    if (!first || !right)
        return NULL;
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_CHAINED_COMPARISON, span, "a comparison has two sides, and this one has three");
    const tn_ast_word *low = first->left, *middle = first->right;
    bool range = middle->kind == TN_WORD_NAME && low->kind != TN_WORD_NAME && right->kind != TN_WORD_NAME;
    if (range && first->op == TN_AT_MOST && op == TN_AT_MOST)
        tn_advise(parse->diagnostics, d, "%s in %s..%s", middle->text, low->text, right->text);
    else if (range && first->op == TN_AT_LEAST && op == TN_AT_LEAST)
        tn_advise(parse->diagnostics, d, "%s in %s..%s", middle->text, right->text, low->text);
    else if (range && upward(first->op) && upward(op))
        tn_help(parse->diagnostics, d, "write `%s %s %s and %s %s %s`, or a range such as `%s in 2..4`", middle->text,
                first->op == TN_LESS ? ">" : ">=", low->text, middle->text, op == TN_LESS ? "<" : "<=", right->text,
                middle->text);
    else
        tn_help(parse->diagnostics, d, "write two comparisons joined by `and`, or a range such as `n in 2..4`");
    return first;
}

tn_ast_cond *tn_ast_within(tn_parse *parse, tn_span span, const tn_ast_word *variable, tn_ast_range range)
{
    tn_ast_cond *cond = cond_new(parse, TN_COND_WITHIN, span);
    if (!cond || !variable || !range.low || !range.high)
        return NULL;
    cond->left = variable;
    cond->range = range;
    return cond;
}

tn_ast_cond *tn_ast_remainder(tn_parse *parse, tn_span span, const tn_ast_word *variable, const tn_ast_word *modulus,
                              tn_operator op, const tn_ast_word *remainder)
{
    tn_ast_cond *cond = cond_new(parse, TN_COND_REMAINDER, span);
    if (!cond || !variable || !modulus || !remainder)
        return NULL;
    cond->left = variable;
    cond->modulus = modulus;
    cond->op = op;
    cond->right = remainder;
    return cond;
}

tn_ast_cond *tn_ast_cond_join(tn_parse *parse, tn_cond_kind kind, tn_ast_cond *first, tn_ast_cond *second)
{
    if (!first || !second)
        return NULL;
    tn_ast_cond *cond = cond_new(parse, kind, first->node.span);
    return tn_ast_cond_add(parse, tn_ast_cond_add(parse, cond, first), second);
}

tn_ast_cond *tn_ast_cond_add(tn_parse *parse, tn_ast_cond *joined, tn_ast_cond *part)
{
    if (!joined || !part || too_deep(parse, part->depth + 1, part->node.span))
        return joined;
    joined->parts = tn_ast_append(joined->parts, part);
    joined->depth = deeper(joined->depth, part->depth + 1);
    joined->node.span = tn_span_join(joined->node.span, part->node.span);
    return joined;
}

tn_ast_cond *tn_ast_cond_not(tn_parse *parse, tn_span span, tn_ast_cond *part)
{
    if (!part || too_deep(parse, part->depth + 1, span))
        return part;
    tn_ast_cond *cond = cond_new(parse, TN_COND_NOT, span);
    if (!cond)
        return NULL;
    cond->parts = tn_ast_one(part);
    cond->depth = part->depth + 1;
    return cond;
}

/* ---- tray specifiers */

tn_ast_alternative *tn_ast_alternative_new(tn_parse *parse, tn_span span, tn_ast_list words)
{
    tn_ast_alternative *alternative = TN_NEW(parse->arena, tn_ast_alternative);
    if (alternative)
        *alternative = (tn_ast_alternative){.node.span = span, .words = words};
    return alternative;
}

tn_ast_item *tn_ast_item_new(tn_parse *parse, tn_span span, tn_ast_list alternatives)
{
    tn_ast_item *item = TN_NEW(parse->arena, tn_ast_item);
    if (item)
        *item = (tn_ast_item){.node.span = span, .alternatives = alternatives};
    return item;
}

/* ---- rule expressions */

tn_ast_expr *tn_ast_leaf(tn_parse *parse, tn_expr_kind kind, tn_span span)
{
    tn_ast_expr *expr = TN_NEW(parse->arena, tn_ast_expr);
    if (expr)
        *expr = (tn_ast_expr){.node.span = span, .kind = kind, .depth = 1};
    return expr;
}

tn_ast_expr *tn_ast_tray_new(tn_parse *parse, tn_span span, tn_ast_list items)
{
    tn_ast_expr *expr = tn_ast_leaf(parse, TN_EXPR_TRAY, span);
    if (expr)
        expr->items = items;
    return expr;
}

tn_ast_expr *tn_ast_name(tn_parse *parse, const tn_ast_word *name)
{
    if (!name)
        return NULL;
    tn_ast_expr *expr = tn_ast_leaf(parse, TN_EXPR_NAME, name->node.span);
    if (expr)
        expr->name = name;
    return expr;
}

tn_ast_expr *tn_ast_expr_add(tn_parse *parse, tn_ast_expr *joined, tn_ast_expr *part)
{
    if (!joined || !part)
        return joined;
    if (too_deep(parse, part->depth + 1, part->node.span)) {
        joined->kind = TN_EXPR_BROKEN;
        return joined;
    }
    joined->parts = tn_ast_append(joined->parts, part);
    joined->depth = deeper(joined->depth, part->depth + 1);
    joined->node.span = tn_span_join(joined->node.span, part->node.span);
    return joined;
}

tn_ast_expr *tn_ast_expr_join(tn_parse *parse, tn_expr_kind kind, tn_ast_expr *first, tn_ast_expr *second)
{
    if (!first || !second)
        return NULL;
    tn_ast_expr *expr = tn_ast_leaf(parse, kind, first->node.span);
    return tn_ast_expr_add(parse, tn_ast_expr_add(parse, expr, first), second);
}

tn_ast_expr *tn_ast_of(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list parts)
{
    tn_ast_expr *expr = tn_ast_leaf(parse, kind, span);
    if (!expr)
        return NULL;
    for (TN_EACH(const tn_ast_expr, part, parts))
        expr->depth = deeper(expr->depth, part->depth + 1);
    expr->parts = parts;
    if (too_deep(parse, expr->depth, span))
        return tn_ast_leaf(parse, TN_EXPR_BROKEN, span);
    return expr;
}

tn_ast_expr *tn_ast_counted(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_expr *part, tn_ast_region region,
                            tn_ast_cond *condition)
{
    if (!part)
        return NULL;
    tn_ast_expr *expr = tn_ast_of(parse, kind, span, tn_ast_one(part));
    if (expr) {
        expr->condition = condition;
        expr->region = region;
    }
    return expr;
}

tn_ast_expr *tn_ast_distance(tn_parse *parse, tn_span span, tn_ast_expr *from, tn_ast_expr *to, tn_ast_expr *by)
{
    if (!from || !to || !by)
        return NULL;
    return tn_ast_of(parse, TN_EXPR_DISTANCE, span, tn_ast_append(tn_ast_append(tn_ast_one(from), to), by));
}
