/* A k-d tree over the corners of an outline: made by halving runs of corners along the longer side of their box. */
#include "runtime/geometry/corner_tree.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/select_nth.h"

#define LEAF 8u /* corners of a leaf: looking at them takes about as long as looking at two more nodes */

static uint32_t levels_for(uint32_t count)
{
    uint32_t levels = 0;
    while (count > LEAF) {
        count = (count + 1) / 2;
        levels++;
    }
    return levels;
}

tn_status tn_corner_tree_new(tn_corner_tree *tree, uint32_t room, tn_error *error)
{
    *tree = (tn_corner_tree){.room = room};
    size_t nodes = (size_t)2 << levels_for(room);
    tree->order = malloc(room * sizeof *tree->order);
    tree->place = malloc(room * sizeof *tree->place);
    tree->there = malloc(room * sizeof *tree->there);
    tree->nodes = malloc(nodes * sizeof *tree->nodes);
    return tree->order && tree->place && tree->there && tree->nodes ? TN_OK : tn_fail_memory(error);
}

void tn_corner_tree_clear(tn_corner_tree *tree)
{
    free(tree->order);
    free(tree->place);
    free(tree->there);
    free(tree->nodes);
    *tree = (tn_corner_tree){0};
}

static bool comes_before(const void *context, uint32_t a, uint32_t b, int axis)
{
    const tn_corner_tree *tree = context;
    double p = tree->points[a][axis], q = tree->points[b][axis];
    return p < q || (p == q && a < b);
}

static void box_of(const tn_corner_tree *tree, uint32_t first, uint32_t end, tn_corner_node *node)
{
    for (int k = 0; k < 2; k++) {
        node->low[k] = INFINITY;
        node->high[k] = -INFINITY;
        for (uint32_t i = first; i < end; i++) {
            double at = tree->points[tree->order[i]][k];
            node->low[k] = at < node->low[k] ? at : node->low[k];
            node->high[k] = at > node->high[k] ? at : node->high[k];
        }
    }
    node->left = end - first;
}

static uint32_t middle_of(uint32_t first, uint32_t end)
{
    return first + (end - first + 1) / 2;
}

static void make_node(tn_corner_tree *tree, uint32_t node, uint32_t level, uint32_t first, uint32_t end)
{
    tn_corner_node *n = &tree->nodes[node];
    box_of(tree, first, end, n);
    if (level == tree->levels)
        return;
    uint32_t middle = middle_of(first, end);
    int axis = n->high[1] - n->low[1] > n->high[0] - n->low[0];
    if (middle < end)
        tn_select_nth(tree->order, first, end, middle, axis, comes_before, tree);
    make_node(tree, 2 * node + 1, level + 1, first, middle);
    make_node(tree, 2 * node + 2, level + 1, middle, end);
}

void tn_corner_tree_make(tn_corner_tree *tree, const double (*points)[2], const bool *chosen, uint32_t all)
{
    tree->points = points;
    tree->count = 0;
    for (uint32_t i = 0; i < all; i++)
        if (chosen[i])
            tree->order[tree->count++] = i;
    tree->levels = levels_for(tree->count);
    make_node(tree, 0, 0, 0, tree->count);
    for (uint32_t i = 0; i < tree->count; i++) {
        tree->place[tree->order[i]] = i;
        tree->there[i] = true;
    }
}

void tn_corner_tree_remove(tn_corner_tree *tree, uint32_t corner)
{
    uint32_t place = tree->place[corner], node = 0, first = 0, end = tree->count;
    tree->there[place] = false;
    tree->nodes[0].left--;
    for (uint32_t level = 0; level < tree->levels; level++) {
        uint32_t middle = middle_of(first, end);
        node = 2 * node + (place < middle ? 1 : 2);
        *(place < middle ? &end : &first) = middle;
        tree->nodes[node].left--;
    }
}

bool tn_corner_in(const double (*points)[2], uint32_t i, uint32_t a, uint32_t b, uint32_t c)
{
    return tn_corner_area(points, a, b, i) >= 0 && tn_corner_area(points, b, c, i) >= 0 &&
           tn_corner_area(points, c, a, i) >= 0;
}

/* ---- asking */

typedef struct question {
    const tn_corner_tree *tree;
    uint32_t corners[3];
    double low[2], high[2]; /* the triangle's box */
    double left[3][3];      /* what is left of each side, as areas: at the origin, and what x and y add; see beside() */
} question;

/* Is all of the box to the right of one of the triangle's sides? The areas that decide are worked out otherwise than
 * those of single corners, so that a box may only be passed over where rounding cannot matter. */
static bool beside(const question *q, const tn_corner_node *node)
{
    for (int i = 0; i < 3; i++) {
        const double *side = q->left[i];
        double x = side[1] > 0 ? node->high[0] : node->low[0], y = side[2] > 0 ? node->high[1] : node->low[1];
        double area = side[0] + side[1] * x + side[2] * y;
        double size = fabs(side[0]) + fabs(side[1] * x) + fabs(side[2] * y);
        if (area < -1e-14 * size)
            return true;
    }
    return false;
}

/* Boxes larger than the triangle are rarely beside it where they meet its own box. */
static bool is_small(const question *q, const tn_corner_node *node)
{
    return node->high[0] - node->low[0] < q->high[0] - q->low[0] ||
           node->high[1] - node->low[1] < q->high[1] - q->low[1];
}

static bool leaf_meets(const question *q, uint32_t first, uint32_t end)
{
    const uint32_t *c = q->corners;
    for (uint32_t i = first; i < end; i++) {
        uint32_t corner = q->tree->order[i];
        if (q->tree->there[i] && corner != c[0] && corner != c[1] && corner != c[2] &&
            tn_corner_in(q->tree->points, corner, c[0], c[1], c[2]))
            return true;
    }
    return false;
}

static bool node_meets(const question *q, uint32_t node, uint32_t level, uint32_t first, uint32_t end)
{
    const tn_corner_node *n = &q->tree->nodes[node];
    if (n->left == 0 || n->low[0] > q->high[0] || n->high[0] < q->low[0] || n->low[1] > q->high[1] ||
        n->high[1] < q->low[1] || (is_small(q, n) && beside(q, n)))
        return false;
    if (level == q->tree->levels)
        return leaf_meets(q, first, end);
    uint32_t middle = middle_of(first, end);
    return node_meets(q, 2 * node + 1, level + 1, first, middle) || node_meets(q, 2 * node + 2, level + 1, middle, end);
}

bool tn_corner_tree_meets(const tn_corner_tree *tree, uint32_t a, uint32_t b, uint32_t c)
{
    question q = {.tree = tree, .corners = {a, b, c}};
    for (int k = 0; k < 2; k++) {
        double p = tree->points[a][k], r = tree->points[b][k], s = tree->points[c][k];
        q.low[k] = fmin(p, fmin(r, s));
        q.high[k] = fmax(p, fmax(r, s));
    }
    for (int i = 0; i < 3; i++) {
        const double *p = tree->points[q.corners[i]], *r = tree->points[q.corners[(i + 1) % 3]];
        q.left[i][1] = p[1] - r[1];
        q.left[i][2] = r[0] - p[0];
        q.left[i][0] = -q.left[i][1] * p[0] - q.left[i][2] * p[1];
    }
    return node_meets(&q, 0, 0, 0, tree->count);
}
