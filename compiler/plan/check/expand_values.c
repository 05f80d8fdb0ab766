/* The values that quantifiers go through: as expressions, and compared with one another or with words of their field.
 */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/expand.h"
#include "runtime/base/nearest.h"

/* A flag that is not there is written `not FLAG`. */
static tn_ast_expr *absent(tn_rule_expansion *expansion, tn_ast_expr *expr, const tn_checked_field *field)
{
    tn_ast_expr *flag = TN_NEW(expansion->check->arena, tn_ast_expr);
    tn_ast_word *word = TN_NEW(expansion->check->arena, tn_ast_word);
    if (!flag || !word)
        return NULL;
    *word = *expr->name;
    word->text = field->name;
    *flag = *expr;
    flag->name = word;
    expr->kind = TN_EXPR_NOT;
    expr->parts = tn_ast_one(flag);
    return expr;
}

tn_ast_expr *tn_value_expression(tn_rule_expansion *expansion, const tn_ast_expr *quantifier,
                                 const tn_checked_field *field, uint32_t v)
{
    tn_arena *arena = expansion->check->arena;
    const tn_checked_value *value = &field->values[v];
    tn_ast_expr *expr = TN_NEW(arena, tn_ast_expr);
    tn_ast_word *word = TN_NEW(arena, tn_ast_word), *depth = TN_NEW(arena, tn_ast_word);
    if (!expr || !word || !depth)
        return NULL;
    bool length = field->kind == TN_FIELD_LENGTH;
    *word = (tn_ast_word){.node.span = quantifier->name->node.span,
                          .kind = length ? TN_WORD_LENGTH : TN_WORD_NAME,
                          .text = value->name,
                          .value = value->length};
    *depth = (tn_ast_word){
        .node.span = word->node.span, .kind = TN_WORD_LENGTH, .text = value->measure, .value = value->length};
    *expr = (tn_ast_expr){
        .node.span = word->node.span, .kind = length ? TN_EXPR_NUMBER : TN_EXPR_FIGURE, .depth = 1, .name = word};
    if (field->kind == TN_FIELD_ZONE && value->has_depth)
        expr->detail = depth;
    return field->kind == TN_FIELD_FLAG && v == 0 ? absent(expansion, expr, field) : expr;
}

/* The quantifier's value that a side stands for; field NULL where it is another thing. */
static tn_bound_name value_of(const tn_rule_expansion *expansion, const tn_ast_node *side)
{
    const tn_ast_expr *expr = (const tn_ast_expr *)side;
    tn_bound_name bound = expr->kind == TN_EXPR_NAME ? tn_bound(expansion, expr->name) : (tn_bound_name){0};
    return bound.field ? bound : (tn_bound_name){0};
}

static bool is_value(const tn_checked_field *field, const char *word)
{
    for (uint32_t v = 0; v < field->value_count; v++)
        if (strcmp(field->values[v].name, word) == 0)
            return true;
    return false;
}

/* A word beside a value of a field that is no length: has to be a value of that field. */
static bool check_word(tn_rule_expansion *expansion, const tn_checked_field *field, const tn_ast_word *word)
{
    if (is_value(field, word->text))
        return true;
    tn_check *check = expansion->check;
    const char **names = TN_NEW_ARRAY(check->arena, const char *, field->value_count);
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_WORD, word->node.span,
                                 "`%s` is not a value of field `%s`", word->text, field->name);
    for (uint32_t v = 0; names && v < field->value_count; v++)
        names[v] = field->values[v].name;
    const char *near = names ? tn_nearest(word->text, names, field->value_count) : NULL;
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "compare with a value of the field, such as `%s`", field->values[0].name);
    return false;
}

/* A fill without its depth is any depth of it. */
static bool same_value(const tn_ast_expr *left, const tn_ast_expr *right)
{
    if (left->kind == TN_EXPR_NUMBER && right->kind == TN_EXPR_NUMBER)
        return left->name->value == right->name->value;
    bool same = strcmp(left->name->text, right->name->text) == 0;
    return same && (!left->detail || !right->detail || left->detail->value == right->detail->value);
}

tn_expr_kind tn_decided(tn_operator op, int64_t order)
{
    bool truths[] = {[TN_LESS] = order<0, [TN_AT_MOST] = order <= 0, [TN_EQUAL] = order == 0, [TN_UNEQUAL] = order != 0,
                                       [TN_AT_LEAST] = order >= 0, [TN_GREATER] = order> 0};
    return truths[op] ? TN_EXPR_TRUE : TN_EXPR_FALSE;
}

/* Of a value of a field whose values have an order. */
static uint32_t place_of(const tn_checked_field *field, const tn_ast_expr *value)
{
    uint32_t v = 0;
    while (v + 1 < field->value_count && strcmp(field->values[v].name, value->name->text) != 0)
        v++;
    return v;
}

tn_ast_expr *tn_place_expression(tn_rule_expansion *expansion, const tn_checked_field *field, const tn_ast_expr *value)
{
    tn_ast_expr *number = TN_NEW(expansion->check->arena, tn_ast_expr);
    tn_ast_word *word = TN_NEW(expansion->check->arena, tn_ast_word);
    const char *exact = field->values[place_of(field, value)].number;
    if (!number || !word)
        return NULL;
    *word = (tn_ast_word){.node.span = value->node.span,
                          .kind = TN_WORD_NUMBER,
                          .value = strtoll(exact, NULL, 10),
                          .text = exact,
                          .exact = exact,
                          .power = field->power};
    *number = (tn_ast_expr){.node.span = value->node.span, .kind = TN_EXPR_NUMBER, .depth = 1, .name = word};
    return number;
}

bool tn_decide_values(tn_rule_expansion *expansion, const tn_ast_expr *comparison, tn_expr_kind *decided)
{
    tn_bound_name bound[2] = {value_of(expansion, comparison->parts.first),
                              value_of(expansion, comparison->parts.last)};
    const tn_ast_expr *sides[2] = {(const tn_ast_expr *)comparison->parts.first,
                                   (const tn_ast_expr *)comparison->parts.last};
    const tn_checked_field *field = bound[0].field ? bound[0].field : bound[1].field;
    if (!field)
        return false;
    *decided = TN_EXPR_BROKEN;
    for (int k = 0; k < 2; k++) {
        if (bound[k].field) {
            sides[k] = bound[k].value;
            continue;
        }
        bool word = sides[k]->kind == TN_EXPR_NAME && !tn_bound(expansion, sides[k]->name).value;
        if (!word || field->kind == TN_FIELD_LENGTH)
            return false;
        if (!check_word(expansion, field, sides[k]->name))
            return true;
    }
    bool lengths = sides[0]->kind == TN_EXPR_NUMBER && sides[1]->kind == TN_EXPR_NUMBER;
    if (!lengths && field->ordered) {
        *decided = tn_decided(comparison->op, (int64_t)place_of(field, sides[0]) - place_of(field, sides[1]));
        return true;
    }
    if (!lengths && comparison->op != TN_EQUAL && comparison->op != TN_UNEQUAL) {
        tn_check *check = expansion->check;
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_ARGUMENT, comparison->node.span,
                                     "these values cannot be compared by size");
        tn_help(check->diagnostics, d, "lengths are compared by order; names and zones by `=` and `!=`");
        return true;
    }
    bool same = same_value(sides[0], sides[1]), less = lengths && sides[0]->name->value < sides[1]->name->value;
    *decided = tn_decided(comparison->op, same ? 0 : less ? -1 : 1);
    return true;
}
