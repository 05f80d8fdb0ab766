/* Reads, writes, copies and grafts the trees that fields are bred as. */
#include "runtime/genome/tree/gene_tree.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

const tn_gene_symbol_row tn_gene_symbols[TN_GENE_SYMBOL_COUNT] = {
#define X(NAME, TEXT, OPERANDS, CLASS) {TEXT, OPERANDS, TN_CLASS_##CLASS},
    TN_GENE_SYMBOLS(X)
#undef X
};

void tn_gene_tree_clear(tn_gene_tree *tree)
{
    free(tree->nodes);
    *tree = (tn_gene_tree){0};
}

static tn_status reserve(tn_gene_tree *tree, size_t count, tn_error *error)
{
    return tn_array_reserve(&tree->nodes, &tree->capacity, 0, count + 1, sizeof *tree->nodes) ? TN_OK
                                                                                              : tn_fail_memory(error);
}

/* Sizes come from the last node on: those of a node's operands are known when it is reached. Depths from the first. */
static void gene_tree_measure(tn_gene_tree *tree)
{
    tn_gene_node *nodes = tree->nodes;
    for (uint32_t i = tree->count; i-- > 0;) {
        uint32_t end = i + 1;
        for (uint32_t k = tn_gene_symbols[nodes[i].symbol].operands; k > 0; k--)
            end += nodes[end].size;
        nodes[i].size = end - i;
    }
    tree->height = 0;
    nodes[0].depth = 0;
    for (uint32_t i = 0; i < tree->count; i++) {
        uint32_t at = i + 1;
        for (uint32_t k = tn_gene_symbols[nodes[i].symbol].operands; k > 0; k--, at += nodes[at].size)
            nodes[at].depth = nodes[i].depth + 1;
        tree->height = nodes[i].depth > tree->height ? nodes[i].depth : tree->height;
    }
}

static tn_status no_tree(tn_error *error)
{
    return tn_fail(error, TN_INVALID, E_RUN_DATABASE, "a genome is not the tree of an expression");
}

tn_status tn_gene_tree_read(const tn_genome *genome, uint32_t constants, tn_gene_tree *tree, tn_error *error)
{
    size_t at = 0, open = 1; /* subtrees that are still to come */
    tree->count = 0;
    tn_status status = reserve(tree, genome->count, error);
    for (; status == TN_OK && open && at < genome->count && tree->count < TN_GENE_NODES_MAX; at++) {
        uint64_t token = genome->codons[at];
        bool holds = token == TN_GENE_NUMBER || token == TN_GENE_CONSTANT;
        if (token >= TN_GENE_SYMBOL_COUNT || (holds && at + 1 == genome->count) ||
            (token == TN_GENE_CONSTANT && genome->codons[at + 1] >= constants))
            return no_tree(error);
        tree->nodes[tree->count++] =
            (tn_gene_node){.symbol = (tn_gene_symbol)token, .value = holds ? genome->codons[++at] : 0};
        open += tn_gene_symbols[token].operands;
        open--;
    }
    if (status != TN_OK || open || at < genome->count)
        return status == TN_OK ? no_tree(error) : status;
    gene_tree_measure(tree);
    return TN_OK;
}

tn_status tn_gene_tree_write(const tn_gene_tree *tree, tn_genome *genome, tn_error *error)
{
    if (!tn_genome_reserve(genome, 2 * (size_t)tree->count))
        return tn_fail_memory(error);
    genome->count = 0;
    for (uint32_t i = 0; i < tree->count; i++) {
        const tn_gene_node *node = &tree->nodes[i];
        genome->codons[genome->count++] = node->symbol;
        if (node->symbol == TN_GENE_NUMBER || node->symbol == TN_GENE_CONSTANT)
            genome->codons[genome->count++] = node->value;
    }
    return TN_OK;
}

tn_status tn_gene_tree_copy(const tn_gene_tree *tree, tn_gene_tree *copy, tn_error *error)
{
    tn_status status = reserve(copy, tree->count, error);
    if (status != TN_OK)
        return status;
    memcpy(copy->nodes, tree->nodes, tree->count * sizeof *copy->nodes);
    copy->count = tree->count;
    copy->height = tree->height;
    return TN_OK;
}

tn_status tn_gene_tree_graft(const tn_gene_tree *tree, uint32_t at, const tn_gene_tree *other, uint32_t from,
                             tn_gene_tree *child, tn_error *error)
{
    uint32_t grafted = other->nodes[from].size, behind = at + tree->nodes[at].size;
    tn_status status = reserve(child, (size_t)at + grafted + tree->count - behind, error);
    if (status != TN_OK)
        return status;
    memcpy(child->nodes, tree->nodes, at * sizeof *child->nodes);
    memcpy(child->nodes + at, other->nodes + from, grafted * sizeof *child->nodes);
    memcpy(child->nodes + at + grafted, tree->nodes + behind, (tree->count - behind) * sizeof *child->nodes);
    child->count = at + grafted + tree->count - behind;
    gene_tree_measure(child);
    return TN_OK;
}

/* ---- walks a tree until a node is taken */

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
