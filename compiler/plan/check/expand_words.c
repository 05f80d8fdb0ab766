/* Bound words inside tray specifiers and conditions. */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/expand.h"

/* ---- does anything have to be written out? */

bool tn_words_bound(const tn_rule_expansion *expansion, const tn_ast_item *item)
{
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
        for (TN_EACH(const tn_ast_word, word, alternative->words))
            if ((word->kind == TN_WORD_NAME && tn_bound(expansion, word).value) ||
                (word->group && tn_words_bound(expansion, word->group)))
                return true;
    return false;
}

static bool operand_bound(const tn_rule_expansion *expansion, const tn_ast_word *word)
{
    return word && word->kind == TN_WORD_NAME && tn_bound(expansion, word).value;
}

bool tn_condition_bound(const tn_rule_expansion *expansion, const tn_ast_cond *cond)
{
    bool bound = operand_bound(expansion, cond->left) || operand_bound(expansion, cond->right) ||
                 operand_bound(expansion, cond->modulus) || operand_bound(expansion, cond->range.low) ||
                 operand_bound(expansion, cond->range.high);
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        bound = bound || tn_condition_bound(expansion, part);
    return bound;
}

/* ---- specifiers */

static void report_not_values(tn_rule_expansion *expansion, const tn_ast_expr *value, const tn_ast_word *use)
{
    if (value->kind == TN_EXPR_BROKEN) /* which was reported */
        return;
    tn_diagnostics *diagnostics = expansion->check->diagnostics;
    tn_diagnostic *d = tn_report(diagnostics, E_BAD_ARGUMENT, value->node.span, "values of a field are needed here");
    tn_note(diagnostics, d, &use->node.span, "`%s` is used in a specifier here", use->text);
    tn_help(diagnostics, d, "give a value of a field, several with `or` between, or `not` and a value");
}

static tn_ast_word *copy_word(tn_rule_expansion *expansion, const tn_ast_word *word)
{
    tn_ast_word *copy = TN_NEW(expansion->check->arena, tn_ast_word);
    if (!copy)
        return NULL;
    *copy = *word;
    copy->node.next = NULL;
    return copy;
}

/* The words of one alternative that an expression stands for: a value, or `not` a value. */
static bool words_of(tn_rule_expansion *expansion, const tn_ast_expr *value, tn_ast_list *words)
{
    tn_check *check = expansion->check;
    switch (value->kind) {
    case TN_EXPR_NUMBER:
        *words = tn_ast_append(*words, copy_word(expansion, value->name));
        return true;
    case TN_EXPR_NAME:
    case TN_EXPR_FIGURE:
        *words = tn_ast_append(*words, copy_word(expansion, value->name));
        if (value->detail)
            *words = tn_ast_append(*words, copy_word(expansion, value->detail));
        return true;
    case TN_EXPR_NOT: {
        tn_ast_word *word = TN_NEW(check->arena, tn_ast_word);
        if (!word)
            return false;
        *word = (tn_ast_word){.node.span = value->node.span, .kind = TN_WORD_NOT, .text = "not"};
        *words = tn_ast_append(*words, word);
        return words_of(expansion, (const tn_ast_expr *)value->parts.first, words);
    }
    default:
        return false;
    }
}

/* A word in parentheses: the alternatives that an `or` stands for. */
static tn_ast_word *group_of(tn_rule_expansion *expansion, const tn_ast_expr *value)
{
    tn_arena *arena = expansion->check->arena;
    tn_ast_word *word = TN_NEW(arena, tn_ast_word);
    tn_ast_item *item = TN_NEW(arena, tn_ast_item);
    if (!word || !item)
        return NULL;
    *item = (tn_ast_item){.node.span = value->node.span};
    for (TN_EACH(const tn_ast_expr, part, value->parts)) {
        tn_ast_alternative *alternative = TN_NEW(arena, tn_ast_alternative);
        if (!alternative)
            return NULL;
        *alternative = (tn_ast_alternative){.node.span = part->node.span};
        if (!words_of(expansion, part, &alternative->words))
            return NULL;
        item->alternatives = tn_ast_append(item->alternatives, alternative);
    }
    *word = (tn_ast_word){.node.span = value->node.span, .kind = TN_WORD_GROUP, .text = "(", .group = item};
    return word;
}

static void put_value(tn_rule_expansion *expansion, const tn_ast_word *use, tn_ast_expr *value, tn_ast_list *words)
{
    if (tn_is_arithmetic(value->kind)) {
        const tn_ast_word *word = tn_expand_constant(expansion, value, use->node.span);
        *words = tn_ast_append(*words, word ? copy_word(expansion, word) : NULL);
        return;
    }
    tn_ast_word *group = value->kind == TN_EXPR_OR ? group_of(expansion, value) : NULL;
    if (group)
        *words = tn_ast_append(*words, group);
    else if (value->kind == TN_EXPR_OR || !words_of(expansion, value, words))
        report_not_values(expansion, value, use);
}

static tn_ast_item *expand_item(tn_rule_expansion *expansion, const tn_ast_item *item);

static tn_ast_list expand_words(tn_rule_expansion *expansion, tn_ast_list words)
{
    tn_ast_list made = tn_ast_empty();
    for (TN_EACH(const tn_ast_word, word, words)) {
        tn_bound_name bound = word->kind == TN_WORD_NAME ? tn_bound(expansion, word) : (tn_bound_name){0};
        if (bound.value) {
            put_value(expansion, word, bound.value, &made);
            continue;
        }
        tn_ast_word *copy = copy_word(expansion, word);
        if (copy && copy->group)
            copy->group = expand_item(expansion, copy->group);
        made = tn_ast_append(made, copy);
    }
    return made;
}

static tn_ast_item *expand_item(tn_rule_expansion *expansion, const tn_ast_item *item)
{
    tn_ast_item *copy = TN_NEW(expansion->check->arena, tn_ast_item);
    if (!copy)
        return NULL;
    *copy = (tn_ast_item){.node.span = item->node.span};
    bool met = expansion->check->met_param;
    expansion->check->met_param = false;
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
        tn_ast_alternative *other = TN_NEW(expansion->check->arena, tn_ast_alternative);
        if (!other)
            return copy;
        *other = (tn_ast_alternative){.node.span = alternative->node.span,
                                      .words = expand_words(expansion, alternative->words)};
        if (other->words.first) /* where nothing is left, that was reported */
            copy->alternatives = tn_ast_append(copy->alternatives, other);
    }
    copy->made = expansion->bindings || expansion->check->met_param;
    expansion->check->met_param |= met;
    return copy;
}

tn_ast_list tn_expand_items(tn_rule_expansion *expansion, tn_ast_list items)
{
    tn_ast_list made = tn_ast_empty();
    for (TN_EACH(const tn_ast_item, item, items)) {
        tn_ast_item *copy = expand_item(expansion, item);
        if (copy && copy->alternatives.first)
            made = tn_ast_append(made, copy);
    }
    return made;
}

/* ---- conditions */

/* The first part of a sum, or the sum, that is no number and was not reported as broken; NULL: all are. */
static const tn_ast_expr *find_no_number(const tn_ast_expr *value)
{
    bool number = value->kind == TN_EXPR_NUMBER || value->kind == TN_EXPR_BROKEN;
    if (!tn_is_arithmetic(value->kind))
        return number ? NULL : value;
    for (TN_EACH(const tn_ast_expr, part, value->parts)) {
        const tn_ast_expr *found = find_no_number(part);
        if (found)
            return found;
    }
    return NULL;
}

const tn_ast_word *tn_expand_constant(tn_rule_expansion *expansion, tn_ast_expr *value, tn_span place)
{
    tn_check *check = expansion->check;
    if (value->kind == TN_EXPR_NUMBER)
        return value->name;
    tn_sum_amount amount = {0};
    tn_ast_word *word = TN_NEW(check->arena, tn_ast_word);
    if (!word)
        return NULL;
    const tn_ast_expr *wrong = find_no_number(value);
    bool good = !wrong && tn_is_arithmetic(value->kind) && tn_check_figure(check, NULL, value, &amount);
    bool whole = good && amount.value && !strchr(amount.value, '/') && strlen(amount.value) < 18 &&
                 (amount.power == 0 || amount.power == 1);
    if (wrong) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_ARGUMENT, wrong->node.span, "a number is needed here");
        tn_note(check->diagnostics, d, &place, "it is used here");
        tn_help(check->diagnostics, d, "give a number such as `2`, or a length such as `12'` or `3.6m`");
    }
    if (!good)
        return NULL;
    *word = (tn_ast_word){.node.span = value->node.span,
                          .kind = !whole         ? TN_WORD_DECIMAL
                                  : amount.power ? TN_WORD_LENGTH
                                                 : TN_WORD_NUMBER,
                          .exact = amount.value,
                          .power = amount.power};
    word->value = whole ? strtoll(amount.value, NULL, 10) : 0;
    const char *text = check->diagnostics->sources->files[value->node.span.file].text;
    word->text =
        tn_arena_copy(check->arena, text + value->node.span.begin, value->node.span.end - value->node.span.begin);
    return word;
}

static const tn_ast_word *expand_operand(tn_rule_expansion *expansion, const tn_ast_word *word)
{
    if (!word || word->kind != TN_WORD_NAME)
        return word;
    tn_bound_name bound = tn_bound(expansion, word);
    if (!bound.value)
        return word;
    bool words = tn_refuse_words(expansion, bound, word->node.span);
    const tn_ast_word *constant = words ? NULL : tn_expand_constant(expansion, bound.value, word->node.span);
    if (constant)
        return constant;
    tn_ast_word *broken = copy_word(expansion, word);
    if (broken) {
        broken->kind = TN_WORD_NUMBER;
        broken->broken = true;
    }
    return broken;
}

tn_ast_cond *tn_expand_condition(tn_rule_expansion *expansion, const tn_ast_cond *cond)
{
    tn_ast_cond *copy = TN_NEW(expansion->check->arena, tn_ast_cond);
    if (!copy)
        return NULL;
    *copy = *cond;
    copy->node.next = NULL;
    copy->left = expand_operand(expansion, cond->left);
    copy->right = expand_operand(expansion, cond->right);
    copy->modulus = expand_operand(expansion, cond->modulus);
    bool one = cond->range.low == cond->range.high;
    copy->range.low = expand_operand(expansion, cond->range.low);
    copy->range.high = one ? copy->range.low : expand_operand(expansion, cond->range.high);
    copy->parts = tn_ast_empty();
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        copy->parts = tn_ast_append(copy->parts, tn_expand_condition(expansion, part));
    return copy;
}
