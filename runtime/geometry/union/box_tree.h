/* Boxes along the axes, for one question: which of them meet this one?
 *
 * A k-d tree in one array, made by halving runs of boxes along the longest side of what their middles fill: n boxes are
 * sorted in about n log n steps, and each question looks at the few nodes that the box meets. The tree borrows the
 * boxes; clear it in any case. */
#ifndef TARTAN_GEOMETRY_BOX_TREE_H
#define TARTAN_GEOMETRY_BOX_TREE_H

#include "runtime/base/error.h"

typedef struct tn_box_bounds {
    double low[3], high[3];
} tn_box_bounds;

typedef struct tn_box_tree {
    const tn_box_bounds *boxes;
    uint32_t *order;      /* the boxes, each leaf's side by side */
    tn_box_bounds *nodes; /* node n has the children 2n + 1 and 2n + 2 */
    uint32_t count, levels;
} tn_box_tree;

tn_status tn_box_tree_make(const tn_box_bounds *boxes, uint32_t count, tn_box_tree *tree, tn_error *error);
void tn_box_tree_clear(tn_box_tree *tree);

/* Asks for the boxes that share a point with one, their borders among it; in the same order each time. */
typedef struct tn_box_search {
    const tn_box_tree *tree;
    tn_box_bounds box;
    uint32_t at, end; /* of the leaf's run that is looked at */
    uint32_t waiting; /* nodes that are still to be looked at */
    struct {
        uint32_t node, level, first, end;
    } nodes[34]; /* of each level one at most waits */
} tn_box_search;

void tn_box_tree_search(const tn_box_tree *tree, const tn_box_bounds *box, tn_box_search *search);
bool tn_box_search_next(tn_box_search *search, uint32_t *found);

/* All of them, in the order of their numbers. The list is used again and again: starts all zero, free `items`
 * afterwards. False: out of memory. */
typedef struct tn_box_hits {
    uint32_t *items;
    size_t count, capacity;
} tn_box_hits;

bool tn_box_tree_list(const tn_box_tree *tree, const tn_box_bounds *box, tn_box_hits *hits);

#endif
