#include "compiler/plan/edit/rule_tree.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* ---- kinds */

static const struct {
    const char *word;
    tn_binding binds, holds;
    tn_rule_part_form form;
} kinds[] = {
#define RULE_PART(ID, WORD, BINDS, HOLDS, FORM) {WORD, BINDS, HOLDS, TN_RULE_PART_##FORM},
#include "compiler/plan/edit/rule_parts.def"
};

const char *tn_rule_part_word(tn_rule_part_kind kind)
{
    return kinds[kind].word;
}

tn_rule_part_form tn_rule_part_form_of(tn_rule_part_kind kind)
{
    return kinds[kind].form;
}

tn_binding tn_rule_part_holds(tn_rule_part_kind kind)
{
    return kinds[kind].holds;
}

/* `...` is parsed as what it stands for. */
static bool is_gap(const tn_ast_expr *expr, const char *text)
{
    return expr->kind == TN_EXPR_OPTIONAL && text[expr->node.span.begin] == '.';
}

/* What is called with fields, not with parts. */
static bool of_fields(const char *name)
{
    return strcmp(name, "mirrored") == 0 || strcmp(name, "values") == 0;
}

tn_rule_part_kind tn_rule_part_kind_of(const tn_ast_expr *expr, const char *text)
{
    if (is_gap(expr, text))
        return TN_RULE_PART_GAP;
    bool counts = expr->condition != NULL;
    switch (expr->kind) {
#define SAME(ID)                                                                                                       \
    case TN_EXPR_##ID:                                                                                                 \
        return TN_RULE_PART_##ID;
        SAME(TRAY)
        SAME(ANY)
        SAME(NAME)
        SAME(AND)
        SAME(OR)
        SAME(NOT)
        SAME(IMPLIES)
        SAME(WHERE)
        SAME(NEIGHBOUR)
        SAME(SYMMETRIC)
        SAME(MANY)
        SAME(OPTIONAL)
        SAME(DISTANCE)
        SAME(BEGINNING)
        SAME(END)
        SAME(EVERY)
        SAME(NEAR)
        SAME(EVERY_NEAR)
        SAME(SOME)
        SAME(EACH)
#undef SAME
    case TN_EXPR_CALL:
        return of_fields(expr->name->text) ? TN_RULE_PART_TEXT : TN_RULE_PART_CALL;
    case TN_EXPR_SUM:
        return counts && expr->parts.count ? TN_RULE_PART_SUM : TN_RULE_PART_TEXT;
    case TN_EXPR_QUANTITY:
        return counts ? TN_RULE_PART_QUANTITY : TN_RULE_PART_TEXT;
    case TN_EXPR_OCCURRENCES:
        return counts ? TN_RULE_PART_OCCURRENCES : TN_RULE_PART_TEXT;
    default:
        return TN_RULE_PART_TEXT;
    }
}

tn_binding tn_expr_binds(const tn_ast_expr *expr)
{
    switch (expr->kind) {
    case TN_EXPR_IMPLIES:
    case TN_EXPR_WHERE:
        return TN_BINDS_NOTHING;
    case TN_EXPR_OR:
        return TN_BINDS_OR;
    case TN_EXPR_AND:
        return TN_BINDS_AND;
    case TN_EXPR_NOT:
    case TN_EXPR_NEAR:
    case TN_EXPR_EVERY_NEAR:
    case TN_EXPR_COMPARE:
    case TN_EXPR_WITHIN:
    case TN_EXPR_REMAINDER:
        return TN_BINDS_NOT;
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
    case TN_EXPR_NEGATIVE:
        return TN_BINDS_SUM;
    default:
        return TN_BINDS_PRIMARY;
    }
}

/* ---- places */

static bool is_sign(const tn_rule_text *text, size_t token, char sign)
{
    return token < text->token_count && text->tokens[token].kind == TN_TOKEN_SIGN &&
           text->text[text->tokens[token].span.begin] == sign;
}

/* With the parentheses that stand directly around it, none of which opens before `floor`: what opens there is its
 * parent's own. */
static tn_text_stretch with_parentheses(const tn_rule_text *text, tn_text_stretch own, uint32_t floor)
{
    size_t before = tn_rule_text_token(text, own.begin), after = tn_rule_text_token(text, own.end);
    tn_text_stretch outer = own;
    while (before > 0 && is_sign(text, before - 1, '(') && is_sign(text, after, ')') &&
           text->tokens[before - 1].span.begin >= floor) {
        outer = (tn_text_stretch){text->tokens[--before].span.begin, text->tokens[after++].span.end};
    }
    return outer;
}

/* Where the parts of an expression can begin: behind the parenthesis that belongs to its word, `many(`, or behind the
 * word. */
static uint32_t floor_of(const tn_rule_text *text, const tn_ast_expr *expr, tn_rule_part_kind kind)
{
    size_t token = tn_rule_text_token(text, expr->node.span.begin);
    bool called = tn_rule_part_holds(kind) == TN_BINDS_NOTHING;
    while (called && token + 1 < text->token_count && !is_sign(text, token, '('))
        token++;
    bool prefixed = called || kind == TN_RULE_PART_NOT || kind == TN_RULE_PART_SYMMETRIC;
    return prefixed && token < text->token_count ? text->tokens[token].span.end : expr->node.span.begin;
}

/* ---- the tree */

static tn_status add(tn_rule_tree *tree, const tn_ast_expr *expr, uint32_t parent, uint32_t floor, uint32_t *made,
                     tn_error *error);

/* Is the part of the expression one of the rule's parts? Of a relation, the distance is not. */
static bool is_part(tn_rule_part_kind kind, uint32_t index)
{
    return !((kind == TN_RULE_PART_NEAR || kind == TN_RULE_PART_EVERY_NEAR) && index == 2);
}

static void adopt(tn_rule_tree *tree, uint32_t parent, uint32_t child)
{
    tn_rule_part *of = &tree->parts[parent], *it = &tree->parts[child];
    it->index = of->count++;
    if (of->last == TN_NO_RULE_PART)
        of->first = child;
    else
        tree->parts[of->last].next = child;
    of->last = child;
}

static tn_status add_parts(tn_rule_tree *tree, const tn_ast_expr *expr, uint32_t part, uint32_t floor, tn_error *error)
{
    tn_rule_part_kind kind = tree->parts[part].kind;
    uint32_t index = 0, child;
    tn_status status = TN_OK;
    for (TN_EACH(const tn_ast_expr, inner, expr->parts)) {
        if (!is_part(kind, index++))
            continue;
        status = add(tree, inner, part, floor, &child, error);
        if (status != TN_OK)
            return status;
        adopt(tree, part, child);
    }
    return status;
}

/* Recursion is as deep as the parser lets expressions nest. */
static tn_status add(tn_rule_tree *tree, const tn_ast_expr *expr, uint32_t parent, uint32_t floor, uint32_t *made,
                     tn_error *error)
{
    const tn_rule_text *text = tree->text;
    tn_rule_part_kind kind = tn_rule_part_kind_of(expr, text->text);
    if (!tn_array_reserve_from(&tree->parts, &tree->capacity, 16, tree->count, 1, sizeof *tree->parts))
        return tn_fail_memory(error);
    uint32_t part = *made = tree->count++;
    tree->parts[part] = (tn_rule_part){.kind = kind,
                                       .expr = expr,
                                       .own = {expr->node.span.begin, expr->node.span.end},
                                       .binds = tn_expr_binds(expr),
                                       .parent = parent,
                                       .first = TN_NO_RULE_PART,
                                       .last = TN_NO_RULE_PART,
                                       .next = TN_NO_RULE_PART};
    bool parts = tn_rule_part_form_of(kind) != TN_RULE_PART_LEAF;
    bool infix = kind == TN_RULE_PART_AND || kind == TN_RULE_PART_OR;
    tn_status status = parts ? add_parts(tree, expr, part, infix ? floor : floor_of(text, expr, kind), error) : TN_OK;
    tn_rule_part *it = &tree->parts[part];
    if (status == TN_OK && infix) /* the syntax tree leaves out the parentheses of its first and last part */
        it->own = (tn_text_stretch){tree->parts[it->first].outer.begin, tree->parts[it->last].outer.end};
    it->outer = with_parentheses(text, it->own, floor);
    return status;
}

tn_status tn_rule_tree_make(const tn_rule_text *text, const tn_ast_rule *rule, tn_rule_tree *tree, tn_error *error)
{
    uint32_t root;
    *tree = (tn_rule_tree){.text = text, .rule = rule};
    return add(tree, rule->body, TN_NO_RULE_PART, rule->name->node.span.end, &root, error);
}

void tn_rule_tree_clear(tn_rule_tree *tree)
{
    free(tree->parts);
    *tree = (tn_rule_tree){0};
}

/* ---- looking around */

tn_binding tn_rule_part_needs(const tn_rule_tree *tree, uint32_t part)
{
    uint32_t parent = tree->parts[part].parent;
    return parent == TN_NO_RULE_PART ? TN_BINDS_NOTHING : tn_rule_part_holds(tree->parts[parent].kind);
}

uint32_t tn_rule_part_child(const tn_rule_tree *tree, uint32_t part, uint32_t index)
{
    uint32_t child = tree->parts[part].first;
    while (child != TN_NO_RULE_PART && index-- > 0)
        child = tree->parts[child].next;
    return child;
}

/* All between the comma before it and the parenthesis that ends the part. */
tn_text_stretch tn_rule_part_condition(const tn_rule_tree *tree, uint32_t part)
{
    const tn_rule_part *it = &tree->parts[part];
    const tn_rule_text *text = tree->text;
    if (!it->expr->condition || it->kind == TN_RULE_PART_TEXT)
        return (tn_text_stretch){0};
    size_t first = tn_rule_text_token(text, it->expr->condition->node.span.begin),
           end = tn_rule_text_token(text, it->own.end) - 1;
    while (is_sign(text, first - 1, '('))
        first--;
    return (tn_text_stretch){text->tokens[first].span.begin, text->tokens[end - 1].span.end};
}

bool tn_rule_part_within(const tn_rule_tree *tree, uint32_t part, uint32_t other)
{
    while (part != TN_NO_RULE_PART && part != other)
        part = tree->parts[part].parent;
    return part == other;
}

uint32_t tn_rule_part_placed(const tn_rule_tree *tree, tn_text_stretch own)
{
    for (uint32_t i = 0; i < tree->count; i++)
        if (tree->parts[i].own.begin == own.begin && tree->parts[i].own.end == own.end)
            return i;
    return TN_NO_RULE_PART;
}

uint32_t tn_rule_part_around(const tn_rule_tree *tree, tn_text_stretch place)
{
    for (uint32_t i = tree->count; i-- > 0;)
        if (tree->parts[i].outer.begin <= place.begin && place.end <= tree->parts[i].outer.end)
            return i;
    return TN_NO_RULE_PART;
}
