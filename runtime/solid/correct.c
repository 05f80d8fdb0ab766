/* Squashes boxes that overlap (Bentley, chapter 4.3.1 to 4.3.3).
 *
 * Boxes only shrink, so that the pairs that overlap as written are all that can ever need it. They are found by
 * a tree of boxes and taken in the chapter's order; only the boxes as written are stored, and an image is made when it
 * is compared. */
#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"

#include "runtime/geometry/union/box_tree.h"
#include "runtime/solid/design.h"

/* Box i and the image of box j; i <= j. Both are squashed by the same rule if they still overlap at their turn. */
typedef struct pair {
    uint32_t stage; /* 0: as written; 1 + axis: images across it */
    uint32_t j, i;
    uint32_t image;
} pair;

typedef struct pairs {
    pair *items;
    size_t count, capacity;
    bool failed;
} pairs;

static bool overlap(const tn_solid_box *p, const tn_solid_box *q)
{
    bool all = !p->void_ && !q->void_;
    for (int k = 0; k < 3; k++)
        all = all && p->low[k] < q->high[k] && q->low[k] < p->high[k];
    return all;
}

static void mirror(tn_solid_box *box, uint32_t image)
{
    for (int k = 0; k < 3; k++) {
        if (!(image >> k & 1))
            continue;
        double low = box->low[k];
        box->low[k] = -box->high[k];
        box->high[k] = -low;
        box->normal[k] = -box->normal[k];
    }
}

/* ---- finding pairs */

static void add_pair(pairs *found, pair one)
{
    if (found->failed)
        return;
    found->failed = !tn_array_reserve(&found->items, &found->capacity, found->count, 1, sizeof *found->items);
    if (!found->failed)
        found->items[found->count++] = one;
}

static int in_order(const void *a, const void *b)
{
    const pair *x = a, *y = b;
    if (x->stage != y->stage)
        return x->stage < y->stage ? -1 : 1;
    if (x->j != y->j)
        return x->j < y->j ? -1 : 1;
    if (x->i != y->i)
        return x->i < y->i ? -1 : 1;
    return x->image < y->image ? -1 : x->image > y->image;
}

static void take(pairs *found, const tn_design *design, uint32_t a, uint32_t b, const tn_solid_box *image_of_b,
                 uint32_t stage, uint32_t image)
{
    bool once = a < b || (image && a == b && (image & (image - 1)) == 0);
    if (once && overlap(&design->boxes[a], image_of_b))
        add_pair(found, (pair){stage, b, a, image});
}

static tn_box_bounds bounds_of(const tn_solid_box *box)
{
    return (tn_box_bounds){{box->low[0], box->low[1], box->low[2]}, {box->high[0], box->high[1], box->high[2]}};
}

/* All i <= j whose boxes overlap, box j in its image. */
static void match(pairs *found, const tn_design *design, const tn_box_tree *tree, uint32_t stage, uint32_t image)
{
    tn_box_search search;
    for (uint32_t b = 0, a; b < design->box_count && !found->failed; b++) {
        tn_solid_box other = design->boxes[b];
        mirror(&other, image);
        tn_box_bounds bounds = bounds_of(&other);
        tn_box_tree_search(tree, &bounds, &search);
        while (tn_box_search_next(&search, &a))
            take(found, design, a, b, &other, stage, image);
    }
}

static void match_all(pairs *found, const tn_design *design, const tn_box_tree *tree)
{
    match(found, design, tree, 0, 0);
    for (uint32_t axis = 0, group = 0; axis < 3; axis++) {
        uint32_t flag = 1u << axis;
        if (!(design->flags & flag))
            continue;
        for (uint32_t g = 0; g <= group; g++)
            if ((g & group) == g)
                match(found, design, tree, 1 + axis, g | flag);
        group |= flag;
    }
}

static tn_status find_pairs(const tn_design *design, pairs *found, tn_error *error)
{
    tn_box_tree tree = {0};
    tn_box_bounds *bounds = malloc((design->box_count + 1u) * sizeof *bounds);
    for (uint32_t i = 0; bounds && i < design->box_count; i++)
        bounds[i] = bounds_of(&design->boxes[i]);
    tn_status status = bounds ? tn_box_tree_make(bounds, design->box_count, &tree, error) : tn_fail_memory(error);
    if (status == TN_OK)
        match_all(found, design, &tree);
    tn_box_tree_clear(&tree);
    free(bounds);
    if (status == TN_OK && found->failed)
        status = tn_fail_memory(error);
    if (status == TN_OK && found->count)
        qsort(found->items, found->count, sizeof *found->items, in_order);
    return status;
}

/* ---- squashing a pair */

typedef struct meeting {
    tn_solid_box *p, *q;
    const pair *of;
    tn_history *history;
    bool failed;
} meeting;

static double twice_centre(const tn_solid_box *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

static void note(meeting *m, const tn_solid_box *box, int axis, bool high, double before, double after)
{
    tn_history *history = m->history;
    bool told = m->of->i == m->of->j && box != m->p; /* an image of its own is squashed as the box is */
    if (!history || m->failed || told || (before == after && !box->void_))
        return;
    m->failed = !tn_array_reserve(&history->items, &history->capacity, history->count, 1, sizeof *history->items);
    if (m->failed)
        return;
    bool first = box == m->p, turned = !first && m->of->image >> axis & 1; /* the second is told as it is written */
    history->items[history->count++] = (tn_squash){.box = first ? m->of->i : m->of->j,
                                                   .by = first ? m->of->j : m->of->i,
                                                   .image = (uint8_t)m->of->image,
                                                   .axis = (uint8_t)axis,
                                                   .high = high != turned,
                                                   .whole = box->void_,
                                                   .before = turned ? -before : before,
                                                   .after = turned ? -after : after};
}

static void move_face(meeting *m, tn_solid_box *box, int axis, bool high, double to)
{
    double *face = high ? &box->high[axis] : &box->low[axis], before = *face;
    *face = to;
    box->void_ |= !(box->high[axis] > box->low[axis]);
    note(m, box, axis, high, before, to);
}

/* The axes, the one to squash along first; equal ones in the order x, y, z. */
static void order_axes(const tn_solid_box *p, const tn_solid_box *q, bool penetration, int axes[3])
{
    double key[3];
    for (int k = 0; k < 3; k++) {
        axes[k] = k;
        key[k] = penetration ? fmin(p->high[k], q->high[k]) - fmax(p->low[k], q->low[k])
                             : -fabs(twice_centre(p, k) - twice_centre(q, k));
    }
    for (int i = 1; i < 3; i++)
        for (int k = i; k > 0 && key[axes[k]] < key[axes[k - 1]]; k--) {
            int other = axes[k];
            axes[k] = axes[k - 1];
            axes[k - 1] = other;
        }
}

/* One is rigid: the other goes back to its face, on the first axis on which it sticks out on its own side. */
static void yield_to(meeting *m, const tn_solid_box *rigid, tn_solid_box *box, const int axes[3], int count)
{
    for (int i = 0; i < count; i++) {
        int k = axes[i];
        double own = twice_centre(box, k), its = twice_centre(rigid, k);
        bool below = own < its || (own == its && box == m->p);
        if (below ? box->low[k] < rigid->low[k] : box->high[k] > rigid->high[k]) {
            move_face(m, box, k, below, below ? rigid->low[k] : rigid->high[k]);
            return;
        }
    }
    box->void_ = true;
    note(m, box, axes[0], true, box->high[axes[0]], box->low[axes[0]]);
}

/* Both give way: they meet halfway, and between their centres where one is inside the other. */
static void share(meeting *m, int axis, bool own_image)
{
    tn_solid_box *p = m->p, *q = m->q;
    double a = twice_centre(p, axis), b = twice_centre(q, axis);
    bool p_low = a == b ? !own_image : a < b; /* an image of its own: the box as written takes the high side */
    tn_solid_box *u = p_low ? p : q, *v = p_low ? q : p;
    double middle = (u->high[axis] + v->low[axis]) / 2;
    double low = (u->low[axis] + u->high[axis]) / 2, high = (v->low[axis] + v->high[axis]) / 2;
    if (!(low <= middle && middle <= high))
        middle = middle > low ? fmin(middle, high) : fmin(low, high);
    move_face(m, u, axis, true, middle);
    move_face(m, v, axis, false, middle);
}

static void meet(meeting *m, bool penetration)
{
    uint32_t image = m->of->image;
    bool own_image = m->of->i == m->of->j;
    int axes[3];
    if (own_image)
        axes[0] = image == 1 ? 0 : image == 2 ? 1 : 2;
    else
        order_axes(m->p, m->q, penetration, axes);
    if (m->p->rigid != m->q->rigid)
        yield_to(m, m->p->rigid ? m->p : m->q, m->p->rigid ? m->q : m->p, axes, own_image ? 1 : 3);
    else
        share(m, axes[0], own_image);
}

tn_status tn_design_correct(tn_design *design, tn_history *history, tn_error *error)
{
    pairs found = {0};
    bool penetration = design->flags & TN_SOLID_PENETRATION, failed = false;
    tn_status status = find_pairs(design, &found, error);
    for (size_t k = 0; k < found.count && status == TN_OK && !failed; k++) {
        const pair *one = &found.items[k];
        tn_solid_box *p = &design->boxes[one->i], q = design->boxes[one->j];
        mirror(&q, one->image);
        if (!overlap(p, &q))
            continue;
        meeting m = {.p = p, .q = &q, .of = one, .history = history};
        meet(&m, penetration);
        failed = m.failed;
        if (one->i == one->j) /* the image is what the box as written implies */
            continue;
        mirror(&q, one->image);
        design->boxes[one->j] = q;
    }
    free(found.items);
    return status == TN_OK && failed ? tn_fail_memory(error) : status;
}
