/* Walks a tree until a node is taken. */
#include "runtime/genome/tree/pick.h"

#define WALKS_MAX 1000 /* then a node is drawn by roulette */

typedef struct picking {
    const tn_gene_tree *tree;
    double maxprob;
    tn_gene_class wanted;
    tn_chance *chance;
} picking;

static bool is_wanted(const picking *p, uint32_t node)
{
    tn_gene_class class_ = tn_gene_symbols[p->tree->nodes[node].symbol].class_;
    return class_ != TN_CLASS_COMMA && (p->wanted == TN_PICK_ANY || p->wanted == class_);
}

static bool may_be(const picking *p, uint32_t node)
{
    return is_wanted(p, node) && (node > 0 || p->tree->count == 1);
}

/* The root is at depth 0, and so never. */
static bool takes(const picking *p, uint32_t node)
{
    double depth = p->tree->nodes[node].depth;
    return is_wanted(p, node) && tn_chance_is(p->chance, depth / p->tree->height * p->maxprob);
}

/* The stack holds no more than a node a level, and one more. */
static uint32_t walk(const picking *p, bool fair)
{
    const tn_gene_node *nodes = p->tree->nodes;
    uint32_t stack[TN_GENE_HEIGHT_MAX + 2], count = 1;
    stack[0] = 0;
    while (count) {
        uint32_t node = stack[--count], first = node + 1;
        if (takes(p, node))
            return node;
        uint32_t operands = tn_gene_symbols[nodes[node].symbol].operands;
        if (operands == 0)
            continue;
        uint32_t second = operands == 2 ? first + nodes[first].size : first;
        bool turned = operands == 2 && fair && !tn_chance_is(p->chance, 0.5);
        if (operands == 2)
            stack[count++] = turned ? first : second;
        stack[count++] = turned ? second : first;
    }
    return TN_PICK_NONE;
}

static uint32_t walk_levels(const picking *p)
{
    for (uint32_t depth = 0; depth <= p->tree->height; depth++)
        for (uint32_t node = 0; node < p->tree->count; node++)
            if (p->tree->nodes[node].depth == depth && takes(p, node))
                return node;
    return TN_PICK_NONE;
}

/* In proportion to the depth; where all are at depth 0, the root. */
static uint32_t draw(const picking *p)
{
    uint64_t total = 0;
    for (uint32_t node = 0; node < p->tree->count; node++)
        total += may_be(p, node) ? p->tree->nodes[node].depth : 0;
    uint64_t at = tn_chance_below(p->chance, total);
    for (uint32_t node = 0; node < p->tree->count; node++) {
        uint64_t share = may_be(p, node) ? p->tree->nodes[node].depth : 0;
        if (at < share)
            return node;
        at -= share;
    }
    return TN_PICK_NONE;
}

static bool has_any(const picking *p)
{
    for (uint32_t node = 0; node < p->tree->count; node++)
        if (may_be(p, node))
            return true;
    return false;
}

uint32_t tn_pick_node(const tn_gene_tree *tree, tn_pick_order order, double maxprob, tn_gene_class wanted,
                      tn_chance *chance)
{
    picking p = {tree, maxprob, wanted, chance};
    if (!has_any(&p))
        return TN_PICK_NONE;
    if (tree->count == 1)
        return 0;
    for (int i = 0; i < WALKS_MAX && order != TN_PICK_ROULETTE && tree->height <= TN_GENE_HEIGHT_MAX; i++) {
        uint32_t taken = order == TN_PICK_LEVEL ? walk_levels(&p) : walk(&p, order == TN_PICK_FAIR);
        if (taken != TN_PICK_NONE)
            return taken;
    }
    return draw(&p);
}
