/* The branches of a face with very many of them, so that each finds its nearest partner without looking at all others
 * (internal to the growth engine).
 *
 * Each region of the face has a k-d tree of its branches over place, direction and label, each node with its box. A
 * bound of a box is worked out with the operations of the exact comparison, in their order; rounding keeps order, so no
 * partner is ever missed. What leaves a tree stays in its boxes until half of it has left: then it is built anew.
 *
 * It borrows its loop and growth; tn_branch_trees_clear frees what it holds.
 */
#ifndef TARTAN_GROWTH_JOIN_BRANCH_TREE_H
#define TARTAN_GROWTH_JOIN_BRANCH_TREE_H

#include "runtime/growth/join/join.h"

enum { TN_BRANCH_AXES = 7 }; /* x, y, z of its place; x, y, z of its direction; its label */

typedef struct tn_branch_node {
    double low[TN_BRANCH_AXES], high[TN_BRANCH_AXES];
    uint32_t first, end;          /* its branches in the tree's order */
    uint32_t left, right, parent; /* nodes; left 0: a leaf */
    uint32_t least;               /* number of those that are still there; TN_NONE: none is */
} tn_branch_node;

typedef struct tn_branch_tree {
    tn_branch_node *nodes;
    uint32_t *order; /* branches, those of a leaf side by side */
    uint32_t node_count, count, left;
} tn_branch_tree;

typedef struct tn_branch_trees {
    const tn_loop *loop;
    const tn_growth *growth;
    double (*places)[TN_BRANCH_AXES]; /* [branch] */
    uint32_t *region;                 /* [branch]; TN_NONE: it is in no tree */
    uint32_t *leaf_of;                /* [branch] */
    tn_branch_tree *trees;            /* [region] there is room for half as many as branches, and one */
} tn_branch_trees;

/* All branches in region 0. False: out of memory; it has to be cleared all the same. */
bool tn_branch_trees_new(const tn_loop *loop, const tn_growth *growth, tn_branch_trees *trees);
void tn_branch_trees_clear(tn_branch_trees *trees);

/* How far two branches of one label come. */
typedef tn_join_failure (*tn_branch_reason)(const tn_loop *loop, const tn_growth *growth, const tn_loop_branch *a,
                                            const tn_loop_branch *b);

/* The furthest that any partner of its label and region comes; TN_FAIL_LABEL: there is none. */
tn_join_failure tn_branch_trees_furthest(const tn_branch_trees *trees, uint32_t branch, tn_branch_reason how);

#endif
