/* Picking the node of a tree at which it is crossed or mutated.
 *
 * A node at depth H of a tree of height Hmax is taken with probability H / Hmax * maxprob (Evolutionary surfaces,
 * 2.2.1), so that the larger maxprob is, the more is exchanged. The tree is walked from its root on until a node is
 * taken; a walk that takes none begins again. The root is taken only where there is nothing else, and a comma never.
 */
#ifndef TARTAN_GENOME_TREE_PICK_H
#define TARTAN_GENOME_TREE_PICK_H

#include "runtime/genome/breeding/chance.h"
#include "runtime/genome/tree/gene_tree.h"

typedef enum tn_pick_order {
    TN_PICK_FAIR,     /* a node before what is below it, and a fair draw says which operand comes first */
    TN_PICK_PREORDER, /* the left operand always first */
    TN_PICK_LEVEL,    /* by depth */
    TN_PICK_ROULETTE, /* no walk: in proportion to the depth */
    TN_PICK_COUNT
} tn_pick_order;

#define TN_PICK_NONE UINT32_MAX
#define TN_PICK_ANY TN_CLASS_COMMA /* either class */

/* The node taken among those of a class, or TN_PICK_NONE where none can be. */
uint32_t tn_pick_node(const tn_gene_tree *tree, tn_pick_order order, double maxprob, tn_gene_class wanted,
                      tn_chance *chance);

#endif
