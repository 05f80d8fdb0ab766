/* Makes the syntax tree of .kit files: what the parser calls. */
#include "compiler/kit/ast.h"

tn_kit_node *tn_kit_node_new(tn_growth_parse *parse, tn_kit_kind kind, tn_span span, tn_kit_text name)
{
    tn_kit_node *node = TN_NEW(parse->arena, tn_kit_node);
    if (node) {
        node->kind = kind;
        node->span = span;
        node->name = name;
        node->depth = 1;
    }
    return node;
}

tn_kit_nodes tn_kit_nodes_add(tn_kit_nodes list, tn_kit_node *node)
{
    TN_CHAIN(&list, node);
    return list;
}

tn_kit_node *tn_kit_space_of(tn_growth_parse *parse, tn_kit_kind kind, tn_span span, tn_kit_node *a, tn_kit_node *b)
{
    tn_kit_node *node = tn_kit_node_new(parse, kind, span, (tn_kit_text){0});
    if (!node || !a)
        return NULL;
    node->inner = tn_kit_nodes_add(tn_kit_nodes_add((tn_kit_nodes){0}, a), b);
    node->depth = 1 + (b && b->depth > a->depth ? b->depth : a->depth);
    return node;
}

void tn_kit_add(tn_growth_parse *parse, tn_kit_node *node)
{
    tn_kit_file *file = parse->result;
    TN_CHAIN(file, node);
}

void tn_kit_add_use(tn_growth_parse *parse, tn_kit_text path)
{
    tn_kit_file *file = parse->result;
    tn_kit_use *use = TN_NEW(parse->arena, tn_kit_use);
    if (use)
        use->path = path;
    TN_CHAIN(&file->uses, use);
}

void tn_kit_lost(tn_growth_parse *parse)
{
    tn_kit_file *file = parse->result;
    file->damaged = true;
}
