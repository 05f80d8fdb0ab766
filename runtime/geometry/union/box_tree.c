/* Finds the boxes that meet a box: a k-d tree over their middles, whose nodes know the bounds of what is in them. */
#include "runtime/geometry/union/box_tree.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/geometry/select_nth.h"

#define LEAF 8u /* boxes of a leaf: looking at them takes about as long as looking at two more nodes */

static double twice_middle(const tn_box_bounds *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

static bool comes_before(const void *context, uint32_t a, uint32_t b, int axis)
{
    const tn_box_bounds *boxes = context;
    double p = twice_middle(&boxes[a], axis), q = twice_middle(&boxes[b], axis);
    return p < q || (p == q && a < b);
}

/* The bounds of a run, and the axis along which its middles spread most. */
static int bound(const tn_box_tree *tree, uint32_t first, uint32_t end, tn_box_bounds *bounds)
{
    tn_box_bounds middles = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    *bounds = middles;
    for (uint32_t i = first; i < end; i++) {
        const tn_box_bounds *box = &tree->boxes[tree->order[i]];
        for (int k = 0; k < 3; k++) {
            double middle = twice_middle(box, k);
            bounds->low[k] = box->low[k] < bounds->low[k] ? box->low[k] : bounds->low[k];
            bounds->high[k] = box->high[k] > bounds->high[k] ? box->high[k] : bounds->high[k];
            middles.low[k] = middle < middles.low[k] ? middle : middles.low[k];
            middles.high[k] = middle > middles.high[k] ? middle : middles.high[k];
        }
    }
    int axis = 0;
    for (int k = 1; k < 3; k++)
        axis = middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis] ? k : axis;
    return axis;
}

static uint32_t middle_of(uint32_t first, uint32_t end)
{
    return first + (end - first + 1) / 2;
}

static void make_node(tn_box_tree *tree, uint32_t node, uint32_t level, uint32_t first, uint32_t end)
{
    int axis = bound(tree, first, end, &tree->nodes[node]);
    if (level == tree->levels)
        return;
    uint32_t middle = middle_of(first, end);
    if (middle < end)
        tn_select_nth(tree->order, first, end, middle, axis, comes_before, tree->boxes);
    make_node(tree, 2 * node + 1, level + 1, first, middle);
    make_node(tree, 2 * node + 2, level + 1, middle, end);
}

tn_status tn_box_tree_make(const tn_box_bounds *boxes, uint32_t count, tn_box_tree *tree, tn_error *error)
{
    *tree = (tn_box_tree){.boxes = boxes, .count = count};
    for (uint32_t run = count; run > LEAF; run = (run + 1) / 2)
        tree->levels++;
    tree->order = malloc((count + 1u) * sizeof *tree->order);
    tree->nodes = malloc(((size_t)2 << tree->levels) * sizeof *tree->nodes);
    if (!tree->order || !tree->nodes)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        tree->order[i] = i;
    make_node(tree, 0, 0, 0, count);
    return TN_OK;
}

void tn_box_tree_clear(tn_box_tree *tree)
{
    free(tree->order);
    free(tree->nodes);
    *tree = (tn_box_tree){0};
}

static bool meets(const tn_box_bounds *p, const tn_box_bounds *q)
{
    return p->low[0] <= q->high[0] && q->low[0] <= p->high[0] && p->low[1] <= q->high[1] && q->low[1] <= p->high[1] &&
           p->low[2] <= q->high[2] && q->low[2] <= p->high[2];
}

static void wait(tn_box_search *s, uint32_t node, uint32_t level, uint32_t first, uint32_t end)
{
    s->nodes[s->waiting].node = node;
    s->nodes[s->waiting].level = level;
    s->nodes[s->waiting].first = first;
    s->nodes[s->waiting++].end = end;
}

void tn_box_tree_search(const tn_box_tree *tree, const tn_box_bounds *box, tn_box_search *search)
{
    search->tree = tree;
    search->box = *box;
    search->at = search->end = search->waiting = 0;
    wait(search, 0, 0, 0, tree->count);
}

/* Goes down to the next leaf that the box meets. */
static bool next_leaf(tn_box_search *s)
{
    while (s->waiting > 0) {
        s->waiting--;
        uint32_t node = s->nodes[s->waiting].node, level = s->nodes[s->waiting].level,
                 first = s->nodes[s->waiting].first, end = s->nodes[s->waiting].end;
        if (!meets(&s->box, &s->tree->nodes[node]))
            continue;
        if (level == s->tree->levels) {
            s->at = first;
            s->end = end;
            return true;
        }
        uint32_t middle = middle_of(first, end);
        wait(s, 2 * node + 2, level + 1, middle, end);
        wait(s, 2 * node + 1, level + 1, first, middle);
    }
    return false;
}

bool tn_box_search_next(tn_box_search *s, uint32_t *found)
{
    for (;;) {
        while (s->at < s->end) {
            uint32_t box = s->tree->order[s->at++];
            if (!meets(&s->box, &s->tree->boxes[box]))
                continue;
            *found = box;
            return true;
        }
        if (!next_leaf(s))
            return false;
    }
}

static int by_number(const void *a, const void *b)
{
    const uint32_t *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

bool tn_box_tree_list(const tn_box_tree *tree, const tn_box_bounds *box, tn_box_hits *hits)
{
    tn_box_search search;
    uint32_t found;
    hits->count = 0;
    tn_box_tree_search(tree, box, &search);
    while (tn_box_search_next(&search, &found)) {
        if (!tn_array_reserve(&hits->items, &hits->capacity, hits->count, 1, sizeof *hits->items))
            return false;
        hits->items[hits->count++] = found;
    }
    if (hits->count > 1)
        qsort(hits->items, hits->count, sizeof *hits->items, by_number);
    return true;
}
