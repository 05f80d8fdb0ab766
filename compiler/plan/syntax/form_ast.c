/* Makes the nodes of a form's syntax tree. */
#include "compiler/plan/syntax/form_ast.h"

/* Declares `node`, a new TYPE; its constructor returns NULL where there is no memory. */
#define MAKE(TYPE)                                                                                                     \
    TYPE *node = TN_NEW(parse->arena, TYPE);                                                                           \
    if (!node)                                                                                                         \
    return NULL

void *tn_ast_form_new(tn_parse *parse, tn_span span, tn_ast_form head, tn_ast_list clauses)
{
    MAKE(tn_ast_form);
    *node = head;
    node->top = (tn_ast_top){.node.span = span, .kind = TN_ITEM_FORM};
    node->clauses = clauses;
    return head.name && head.schema ? node : NULL;
}

void *tn_ast_form_clause_new(tn_parse *parse, tn_span span, tn_ast_form_clause clause)
{
    MAKE(tn_ast_form_clause);
    *node = clause;
    node->node = (tn_ast_node){.span = span};
    return node;
}

void *tn_ast_shape_new(tn_parse *parse, tn_span span, const tn_ast_word *word, tn_ast_list arguments)
{
    MAKE(tn_ast_shape);
    *node = (tn_ast_shape){.node.span = span, .word = word, .arguments = arguments};
    return word ? node : NULL;
}

void *tn_ast_argument_new(tn_parse *parse, tn_span span, const tn_ast_word *word, const tn_ast_word *run)
{
    MAKE(tn_ast_argument);
    *node = (tn_ast_argument){.node.span = span, .word = word, .run = run};
    return word ? node : NULL;
}

void *tn_ast_opening_part_new(tn_parse *parse, tn_span span, tn_ast_opening_part part)
{
    MAKE(tn_ast_opening_part);
    *node = part;
    node->node = (tn_ast_node){.span = span};
    return (part.length || part.part >= TN_OPENING_PASSAGE) && (part.side || part.part != TN_OPENING_NEAR) ? node
                                                                                                           : NULL;
}

void *tn_ast_layer_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *length)
{
    MAKE(tn_ast_layer);
    *node = (tn_ast_layer){.node.span = span, .name = name, .length = length};
    return name && length ? node : NULL;
}

void *tn_ast_class_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *code,
                       const tn_ast_word *title)
{
    MAKE(tn_ast_class);
    *node = (tn_ast_class){.node.span = span, .name = name, .code = code, .title = title};
    return name && code ? node : NULL;
}

void *tn_ast_reach_new(tn_parse *parse, tn_span span, tn_ast_reach reach)
{
    MAKE(tn_ast_reach);
    *node = reach;
    node->node = (tn_ast_node){.span = span};
    return reach.low && reach.high ? node : NULL;
}

void *tn_ast_symbol_line_new(tn_parse *parse, tn_span span, tn_ast_symbol_line from, tn_ast_symbol_line to)
{
    MAKE(tn_ast_symbol_line);
    *node = from;
    for (int k = 0; k < 2; k++) {
        node->sides[1][k] = to.sides[0][k];
        node->lengths[1][k] = to.lengths[0][k];
    }
    node->node = (tn_ast_node){.span = span};
    return node;
}

void *tn_ast_tile_part_new(tn_parse *parse, tn_span span, tn_ast_tile_part part)
{
    MAKE(tn_ast_tile_part);
    *node = part;
    node->node = (tn_ast_node){.span = span};
    return node;
}

void *tn_ast_alternative_word(tn_parse *parse, tn_span span, tn_ast_word *word, void *alternative)
{
    const tn_ast_alternative *rest = alternative;
    if (!word || !rest)
        return NULL;
    return tn_ast_alternative_new(parse, span, tn_ast_join(tn_ast_one(word), rest->words));
}

tn_ast_expr *tn_ast_house_leaf(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list items)
{
    tn_ast_expr *expr = tn_ast_leaf(parse, kind, span);
    if (expr)
        expr->items = items;
    return expr;
}

tn_ast_expr *tn_ast_meeting(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list parts, tn_ast_list kinds)
{
    tn_ast_expr *expr = parts.count > 1 ? tn_ast_of(parse, kind, span, parts) : NULL;
    if (expr)
        expr->kinds = kinds;
    return expr;
}

tn_ast_expr *tn_ast_walk(tn_parse *parse, tn_span span, tn_ast_extreme_kind extreme, tn_ast_expr *from,
                         tn_ast_expr *to, tn_ast_expr *through, tn_ast_list kinds)
{
    if (!from || !to)
        return NULL;
    bool word = to->kind == TN_EXPR_FIGURE;
    tn_ast_list parts = word ? tn_ast_one(from) : tn_ast_append(tn_ast_one(from), to);
    tn_ast_expr *expr = tn_ast_of(parse, TN_EXPR_WALK, span, through ? tn_ast_append(parts, through) : parts);
    if (!expr)
        return NULL;
    expr->extreme = extreme;
    expr->name = word ? to->name : NULL;
    expr->kinds = kinds;
    return expr;
}
