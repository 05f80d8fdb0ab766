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
void tn_gene_tree_measure(tn_gene_tree *tree)
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
    tn_gene_tree_measure(tree);
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
    tn_gene_tree_measure(child);
    return TN_OK;
}
