/* Corners of an outline in the plane, for one question: does any of them lie in this triangle?
 *
 * A k-d tree in one array, with the box and the number of corners left in each node; corners are taken out one by one.
 * Asking visits the nodes whose boxes the triangle meets and stops at the first corner found, so that a face of n
 * corners is asked n times in about n log n steps, whatever its shape (at worst each answer takes the square root of
 * n). The tree borrows the points; free it with tn_corner_tree_clear. */
#ifndef TARTAN_GEOMETRY_CORNER_TREE_H
#define TARTAN_GEOMETRY_CORNER_TREE_H

#include "runtime/base/error.h"

typedef struct tn_corner_node {
    double low[2], high[2];
    uint32_t left; /* corners that are still in it */
} tn_corner_node;

typedef struct tn_corner_tree {
    const double (*points)[2];
    uint32_t *order;       /* the corners, each leaf's side by side */
    uint32_t *place;       /* of each corner in the order */
    bool *there;           /* by place: not yet taken out */
    tn_corner_node *nodes; /* node n has the children 2n + 1 and 2n + 2 */
    uint32_t count, levels;
    uint32_t room;
} tn_corner_tree;

/* Room for trees of up to `room` corners. */
tn_status tn_corner_tree_new(tn_corner_tree *tree, uint32_t room, tn_error *error);
void tn_corner_tree_clear(tn_corner_tree *tree);

/* Makes the tree of the corners that `chosen` marks among points[0 .. all). */
void tn_corner_tree_make(tn_corner_tree *tree, const double (*points)[2], const bool *chosen, uint32_t all);

void tn_corner_tree_remove(tn_corner_tree *tree, uint32_t corner);

/* Does a corner other than a, b and c themselves lie in the counter-clockwise triangle of those three, or on its
 * border? */
bool tn_corner_tree_meets(const tn_corner_tree *tree, uint32_t a, uint32_t b, uint32_t c);

/* Does the corner lie in the counter-clockwise triangle, or on its border? */
bool tn_corner_in(const double (*points)[2], uint32_t corner, uint32_t a, uint32_t b, uint32_t c);

/* Twice the area of a triangle, positive where it is counter-clockwise. */
static inline double tn_corner_area(const double (*points)[2], uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = points[a], *q = points[b], *s = points[c];
    return (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
}

#endif
