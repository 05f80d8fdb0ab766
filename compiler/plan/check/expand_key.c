/* A text of an expression that is the same for equal ones, so that equal calls are written out once. */
#include <string.h>

#include "compiler/plan/check/expand.h"

typedef struct text {
    tn_arena *arena;
    char *data;
    size_t size, room;
} text;

static void put(text *t, const char *words)
{
    size_t more = strlen(words);
    if (t->size + more + 2 > t->room) {
        size_t room = 2 * (t->size + more) + 64;
        char *data = tn_arena_alloc(t->arena, room);
        if (!data)
            return;
        if (t->size)
            memcpy(data, t->data, t->size);
        t->data = data;
        t->room = room;
    }
    memcpy(t->data + t->size, words, more + 1);
    t->size += more;
}

static void put_number(text *t, long long number)
{
    char digits[32];
    snprintf(digits, sizeof digits, " %lld", number);
    put(t, digits);
}

static void put_item(text *t, const tn_ast_item *item);

static void put_word(text *t, const tn_ast_word *word)
{
    if (!word)
        return;
    put_number(t, word->kind);
    put(t, word->text);
    put_number(t, word->kind == TN_WORD_OPERATOR ? (long long)word->op : word->value);
    if (word->group)
        put_item(t, word->group);
    put_word(t, word->low);
    put_word(t, word->high);
}

static void put_item(text *t, const tn_ast_item *item)
{
    put(t, "[");
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
        put(t, "|");
        for (TN_EACH(const tn_ast_word, word, alternative->words))
            put_word(t, word);
    }
    put(t, "]");
}

static void put_condition(text *t, const tn_ast_cond *cond)
{
    put_number(t, cond->kind);
    put_number(t, cond->op);
    put_word(t, cond->left);
    put_word(t, cond->right);
    put_word(t, cond->modulus);
    put_word(t, cond->range.low);
    put_word(t, cond->range.high);
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        put_condition(t, part);
    put(t, ";");
}

static void put_expression(text *t, const tn_ast_expr *expr)
{
    put(t, "(");
    put_number(t, expr->kind);
    put_number(t, expr->op);
    put_number(t, expr->near);
    put_number(t, expr->region);
    put_number(t, expr->least);
    put_number(t, expr->most);
    put_number(t, expr->rule && expr->rule->hidden ? (long long)expr->rule->serial : -1);
    put_number(t, (long long)expr->unit);
    put_number(t, expr->older ? (long long)expr->older->index : -1);
    put_word(t, expr->name);
    put_word(t, expr->detail);
    for (TN_EACH(const tn_ast_item, item, tn_ast_tray_items(expr)))
        put_item(t, item);
    if (expr->kind == TN_EXPR_SECTION) { /* the same where it is the same text */
        put_number(t, expr->node.span.file);
        put_number(t, expr->node.span.begin);
    }
    for (TN_EACH(const tn_ast_word, kind, expr->kinds))
        put_word(t, kind);
    if (expr->kind == TN_EXPR_MIRRORED || expr->kind == TN_EXPR_VALUES)
        for (TN_EACH(const tn_ast_word, field, expr->names))
            put_word(t, field);
    if (expr->figure)
        put_expression(t, expr->figure);
    if (expr->condition)
        put_condition(t, expr->condition);
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        put_expression(t, part);
    put(t, ")");
}

const char *tn_expression_key(tn_check *check, const tn_checked_schema *schema, const char *name, tn_ast_list parts)
{
    text t = {.arena = check->arena};
    put_number(&t, schema ? (long long)schema->index : -1);
    put(&t, name);
    for (TN_EACH(const tn_ast_expr, part, parts))
        put_expression(&t, part);
    return t.data;
}
