/* Crosses two trees, and mutates one. */
#include "runtime/genome/tree/vary_tree.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/genome/breeding/normal.h"

#define CROSSINGS_MAX 20 /* until no child is too large */
#define SWAPS_MAX 64     /* until two subtrees lie apart */

/* ---- crossing */

static tn_gene_class class_of(const tn_gene_tree *tree, uint32_t node)
{
    return tn_gene_symbols[tree->nodes[node].symbol].class_;
}

/* The first parent's node, then the second's of the same class; where that has none, the first's again, of the other
 * class. */
static bool pick_pair(const tn_tree_variation *how, tn_chance *chance, const tn_gene_tree parents[2],
                      const double weights[2], uint32_t at[2])
{
    const double prob[2] = {how->maxprob * weights[0], how->maxprob * weights[1]};
    tn_gene_class wanted = TN_PICK_ANY;
    for (int attempt = 0; attempt < 2; attempt++) {
        at[0] = tn_pick_node(&parents[0], how->order, prob[0], wanted, chance);
        if (at[0] == TN_PICK_NONE)
            return false;
        tn_gene_class class_ = class_of(&parents[0], at[0]);
        at[1] = tn_pick_node(&parents[1], how->order, prob[1], class_, chance);
        if (at[1] != TN_PICK_NONE)
            return true;
        wanted = class_ == TN_CLASS_OPERATOR ? TN_CLASS_VALUE : TN_CLASS_OPERATOR;
    }
    return false;
}

static bool fits(const tn_tree_variation *how, const tn_gene_tree *tree)
{
    return tree->count <= how->max_nodes && tree->height <= TN_GENE_HEIGHT_MAX;
}

tn_status tn_tree_cross(const tn_tree_variation *how, tn_chance *chance, const tn_gene_tree parents[2],
                        const double weights[2], tn_gene_tree children[2], bool crossed[2], tn_error *error)
{
    tn_status status = TN_OK;
    crossed[0] = crossed[1] = false;
    for (int i = 0; i < CROSSINGS_MAX && status == TN_OK && !(crossed[0] && crossed[1]); i++) {
        uint32_t at[2];
        if (!pick_pair(how, chance, parents, weights, at))
            break;
        for (int k = 0; k < 2 && status == TN_OK; k++) {
            status = tn_gene_tree_graft(&parents[k], at[k], &parents[1 - k], at[1 - k], &children[k], error);
            crossed[k] = status == TN_OK && fits(how, &children[k]);
        }
    }
    for (int k = 0; k < 2 && status == TN_OK; k++)
        if (!crossed[k])
            status = tn_gene_tree_copy(&parents[k], &children[k], error);
    return status;
}

/* ---- two nodes */

/* Nodes whose labels may change places: binary operators, and terminals. */
static bool may_swap(const tn_gene_node *node)
{
    return node->symbol != TN_GENE_COMMA && tn_gene_symbols[node->symbol].operands != 1;
}

static bool differ(const tn_gene_node *a, const tn_gene_node *b)
{
    return a->symbol != b->symbol || a->value != b->value;
}

/* Draws evenly among the nodes that may change places with `other` (NULL: with any). */
static uint32_t draw_label(const tn_gene_tree *tree, const tn_gene_node *other, tn_chance *chance)
{
    for (int counting = 1, count = 0, at = 0; counting >= 0; counting--) {
        for (uint32_t i = 0; i < tree->count; i++) {
            const tn_gene_node *node = &tree->nodes[i];
            bool same_class = !other || tn_gene_symbols[node->symbol].class_ == tn_gene_symbols[other->symbol].class_;
            if (!may_swap(node) || !same_class || (other && !differ(node, other)))
                continue;
            if (counting)
                count++;
            else if (at-- == 0)
                return i;
        }
        if (count == 0)
            return TN_PICK_NONE;
        if (counting)
            at = (int)tn_chance_below(chance, (uint64_t)count);
    }
    return TN_PICK_NONE;
}

static bool swap_nodes(tn_gene_tree *tree, tn_chance *chance)
{
    uint32_t a = draw_label(tree, NULL, chance);
    uint32_t b = a == TN_PICK_NONE ? a : draw_label(tree, &tree->nodes[a], chance);
    if (b == TN_PICK_NONE)
        return false;
    tn_gene_node first = tree->nodes[a], second = tree->nodes[b];
    tree->nodes[a].symbol = second.symbol;
    tree->nodes[a].value = second.value;
    tree->nodes[b].symbol = first.symbol;
    tree->nodes[b].value = first.value;
    return true; /* sizes stay: both have as many operands */
}

/* ---- subtrees */

static bool holds(const tn_gene_tree *tree, uint32_t outer, uint32_t inner)
{
    return inner >= outer && inner < outer + tree->nodes[outer].size;
}

static tn_status swap_subtrees(const tn_tree_variation *how, tn_gene_tree *tree, tn_gene_tree *spare, tn_chance *chance,
                               bool *mutated, tn_error *error)
{
    uint32_t a = tn_pick_node(tree, how->order, how->maxprob, TN_PICK_ANY, chance), b = TN_PICK_NONE;
    bool apart = false;
    for (int i = 0; i < SWAPS_MAX && !apart && a != TN_PICK_NONE; i++) {
        b = tn_pick_node(tree, how->order, how->maxprob, class_of(tree, a), chance);
        apart = b != TN_PICK_NONE && !holds(tree, a, b) && !holds(tree, b, a);
    }
    if (!apart)
        return TN_OK;
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    tn_gene_tree part = {0};
    tn_status status = tn_gene_tree_graft(tree, high, tree, low, &part, error);
    if (status == TN_OK)
        status = tn_gene_tree_graft(&part, low, tree, high, spare, error);
    tn_gene_tree_clear(&part);
    if (status != TN_OK || !fits(how, spare))
        return status;
    *mutated = true;
    return tn_gene_tree_copy(spare, tree, error);
}

/* ---- destruction */

/* A terminal: x, y, z, or one of the tree's numbers and constants, each as likely. */
static tn_status draw_terminal(const tn_gene_tree *tree, tn_chance *chance, tn_gene_node *terminal, tn_error *error)
{
    tn_gene_node *known = malloc((tree->count + 3u) * sizeof *known);
    uint32_t count = 0;
    if (!known)
        return tn_fail_memory(error);
    for (int axis = 0; axis < 3; axis++)
        known[count++] = (tn_gene_node){.symbol = (tn_gene_symbol)(TN_GENE_X + axis)};
    for (uint32_t i = 0; i < tree->count; i++) {
        const tn_gene_node *node = &tree->nodes[i];
        bool fresh = node->symbol == TN_GENE_NUMBER || node->symbol == TN_GENE_CONSTANT;
        for (uint32_t k = 3; k < count && fresh; k++)
            fresh = differ(node, &known[k]);
        if (fresh)
            known[count++] = *node;
    }
    *terminal = known[tn_chance_below(chance, count)];
    terminal->size = 1;
    free(known);
    return TN_OK;
}

static tn_status destroy(const tn_tree_variation *how, tn_gene_tree *tree, tn_gene_tree *spare, tn_chance *chance,
                         bool *mutated, tn_error *error)
{
    uint32_t at = tn_pick_node(tree, how->order, how->maxprob, TN_PICK_ANY, chance);
    tn_gene_node terminal;
    tn_gene_tree single = {.nodes = &terminal, .count = 1};
    if (at == TN_PICK_NONE)
        return TN_OK;
    tn_status status = draw_terminal(tree, chance, &terminal, error);
    if (status == TN_OK)
        status = tn_gene_tree_graft(tree, at, &single, 0, spare, error);
    *mutated = status == TN_OK;
    return status == TN_OK ? tn_gene_tree_copy(spare, tree, error) : status;
}

/* ---- numbers */

/* Numbers are written without a sign, so that what is written reads back as the same tree. */
static bool nudge(tn_gene_tree *tree, tn_chance *chance)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < tree->count; i++)
        count += tree->nodes[i].symbol == TN_GENE_NUMBER;
    uint64_t at = tn_chance_below(chance, count);
    for (uint32_t i = 0; i < tree->count; i++) {
        tn_gene_node *node = &tree->nodes[i];
        if (node->symbol != TN_GENE_NUMBER || at-- > 0)
            continue;
        double value = fabs(tn_double_of(node->value) * (1 + 0.2 * tn_chance_normal(chance)));
        if (!isfinite(value))
            return false;
        node->value = tn_bits_of(value);
        return true;
    }
    return false;
}

/* ---- mutation */

/* The kind of mutation, by its share; TN_TREE_MUTATION_COUNT where all shares are 0. */
static tn_tree_mutation draw_kind(const tn_tree_variation *how, tn_chance *chance)
{
    double total = 0;
    for (int i = 0; i < TN_TREE_MUTATION_COUNT; i++)
        total += how->shares[i];
    double at = tn_chance_unit(chance) * total;
    int kind = 0;
    while (kind < TN_TREE_MUTATION_COUNT && at >= how->shares[kind])
        at -= how->shares[kind++];
    return (tn_tree_mutation)kind;
}

tn_status tn_tree_mutate(const tn_tree_variation *how, tn_chance *chance, tn_gene_tree *tree, tn_gene_tree *spare,
                         bool *mutated, tn_error *error)
{
    *mutated = false;
    if (!tn_chance_is(chance, how->mutation_rate))
        return TN_OK;
    switch (draw_kind(how, chance)) {
    case TN_TREE_SWAP_NODES:
        *mutated = swap_nodes(tree, chance);
        return TN_OK;
    case TN_TREE_SWAP_SUBTREES:
        return swap_subtrees(how, tree, spare, chance, mutated, error);
    case TN_TREE_DESTROY:
        return destroy(how, tree, spare, chance, mutated, error);
    case TN_TREE_NUDGE:
        *mutated = nudge(tree, chance);
        return TN_OK;
    default:
        return TN_OK;
    }
}
