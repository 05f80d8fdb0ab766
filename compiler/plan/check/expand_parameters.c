/* What a rule's parameters are (expressions, values of a field, numbers), told by their uses. */
#include <string.h>

#include "compiler/plan/check/expand.h"

typedef enum use_kind { USE_NONE, USE_EXPRESSION, USE_VALUES, USE_NUMBER } use_kind;

typedef struct parameter {
    const tn_ast_word *word;
    use_kind kind;
    tn_span first;
    bool said;
} parameter;

typedef struct parameters {
    tn_check *check;
    parameter items[TN_PARAMETERS_MAX];
    size_t count;
} parameters;

static const char *const kind_names[] = {
    [USE_EXPRESSION] = "an expression", [USE_VALUES] = "values of a field", [USE_NUMBER] = "a number"};

static void use(parameters *p, const tn_ast_word *word, use_kind kind)
{
    for (size_t i = 0; word && word->kind == TN_WORD_NAME && i < p->count; i++) {
        parameter *item = &p->items[i];
        if (strcmp(item->word->text, word->text) != 0)
            continue;
        if (item->kind == USE_NONE) {
            item->kind = kind;
            item->first = word->node.span;
        } else if (item->kind != kind && !item->said) {
            item->said = true;
            tn_diagnostics *diagnostics = p->check->diagnostics;
            tn_diagnostic *d =
                tn_report(diagnostics, E_PARAMETER_KINDS, word->node.span, "`%s` is %s here, and %s before", word->text,
                          kind_names[kind], kind_names[item->kind]);
            tn_note(diagnostics, d, &item->first, "it is %s here", kind_names[item->kind]);
            tn_help(diagnostics, d, "use two parameters: one for each");
        }
    }
}

/* It is used, as what another place says: by a rule that is called, or as a field. */
static void use_somehow(parameters *p, const tn_ast_word *word)
{
    for (size_t i = 0; i < p->count; i++)
        if (strcmp(p->items[i].word->text, word->text) == 0 && p->items[i].kind == USE_NONE)
            p->items[i].said = true;
}

static void use_items(parameters *p, const tn_ast_item *item)
{
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
        for (TN_EACH(const tn_ast_word, word, alternative->words)) {
            use(p, word, USE_VALUES);
            if (word->group)
                use_items(p, word->group);
        }
}

static void use_condition(parameters *p, const tn_ast_cond *cond)
{
    use(p, cond->left, USE_NUMBER);
    use(p, cond->right, USE_NUMBER);
    use(p, cond->modulus, USE_NUMBER);
    use(p, cond->range.low, USE_NUMBER);
    if (cond->range.high != cond->range.low)
        use(p, cond->range.high, USE_NUMBER);
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        use_condition(p, part);
}

/* number: does the expression stand where a number does? */
static void use_expression(parameters *p, const tn_ast_expr *expr, bool number)
{
    bool sum = expr->kind == TN_EXPR_COMPARE || expr->kind == TN_EXPR_WITHIN || expr->kind == TN_EXPR_PLUS ||
               expr->kind == TN_EXPR_MINUS || expr->kind == TN_EXPR_TIMES || expr->kind == TN_EXPR_OVER ||
               expr->kind == TN_EXPR_REMAINDER || expr->kind == TN_EXPR_NEGATIVE || expr->kind == TN_EXPR_LEAST ||
               expr->kind == TN_EXPR_MOST || expr->kind == TN_EXPR_RANGE;
    if (expr->kind == TN_EXPR_NAME)
        use(p, expr->name, number ? USE_NUMBER : USE_EXPRESSION);
    if (expr->kind == TN_EXPR_FIGURE)
        use_somehow(p, expr->name); /* as a number, or as a field */
    if (expr->kind == TN_EXPR_SOME || expr->kind == TN_EXPR_EACH)
        use_somehow(p, expr->name);
    for (TN_EACH(const tn_ast_item, item, tn_ast_tray_items(expr)))
        use_items(p, item);
    if (expr->condition)
        use_condition(p, expr->condition);
    if (expr->figure)
        use_expression(p, expr->figure, true);
    size_t at = 0;
    for (const tn_ast_expr *part = (const tn_ast_expr *)expr->parts.first; part;
         part = (const tn_ast_expr *)part->node.next, at++) {
        if (expr->kind == TN_EXPR_CALL && part->kind == TN_EXPR_NAME) {
            use_somehow(p, part->name); /* what it is there, the rule that is called says */
            continue;
        }
        bool distance = (expr->kind == TN_EXPR_NEAR || expr->kind == TN_EXPR_EVERY_NEAR) && at == 2;
        use_expression(p, part, sum || distance);
    }
}

void tn_check_parameters(tn_check *check, const tn_checked_rule *rule)
{
    parameters p = {.check = check};
    tn_check_allow(check, rule->ast->allow);
    check->allow = rule->ast->allow;
    for (TN_EACH(const tn_ast_word, word, rule->ast->params)) {
        bool bound = false;
        for (size_t i = 0; i < p.count; i++)
            bound |= strcmp(p.items[i].word->text, word->text) == 0;
        tn_check_new_word(check, rule->schema, word, bound);
        if (tn_check_room(check, p.count, TN_PARAMETERS_MAX, "parameter", word->node.span,
                          "give the rule fewer parameters"))
            p.items[p.count++] = (parameter){.word = word};
    }
    use_expression(&p, rule->written, false);
    for (size_t i = 0; i < p.count; i++) {
        if (p.items[i].kind != USE_NONE || p.items[i].said || !tn_check_wanted(check, W_UNUSED_PARAMETER))
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, W_UNUSED_PARAMETER, p.items[i].word->node.span,
                                     "the parameter `%s` is not used", p.items[i].word->text);
        tn_help(check->diagnostics, d, "leave it out, also in calls");
    }
}
