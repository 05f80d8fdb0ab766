/* Designs of boxes: read from a module, corrected so that no boxes overlap, and as genes. */
#include "runtime/solid/design.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/geometry/union/box_tree.h"

/* ==== reads a design from a module, and gives its cells */

tn_status tn_design_read(const tn_module *module, uint32_t solid, tn_design *design, tn_error *error)
{
    const tn_solid_record *record = &module->SOLID_records[solid];
    *design = (tn_design){
        .box_count = record->box_count, .flags = record->flags, .unit = {record->unit_top, record->unit_bottom}};
    design->boxes = calloc(record->box_count + 1u, sizeof *design->boxes);
    if (!design->boxes)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < record->box_count; i++) {
        const tn_box_record *b = &module->BOX_records[record->box_first + i];
        tn_solid_box *box = &design->boxes[i];
        *box = (tn_solid_box){.low = {b->low_x, b->low_y, b->low_z},
                              .high = {b->high_x, b->high_y, b->high_z},
                              .normal = {b->normal_x, b->normal_y, b->normal_z},
                              .distance = b->planedist,
                              .rigid = b->flags & TN_BOX_RIGID,
                              .clipped = (b->flags & TN_BOX_CLIPPED) && !(record->flags & TN_SOLID_NOCLIP)};
        for (int k = 0; k < 3; k++)
            box->void_ |= !(box->high[k] > box->low[k]);
    }
    return TN_OK;
}

tn_status tn_design_copy(const tn_design *design, tn_design *copy, tn_error *error)
{
    *copy = *design;
    copy->boxes = malloc((design->box_count + 1u) * sizeof *copy->boxes);
    if (!copy->boxes)
        return tn_fail_memory(error);
    memcpy(copy->boxes, design->boxes, design->box_count * sizeof *copy->boxes);
    return TN_OK;
}

void tn_design_clear(tn_design *design)
{
    free(design->boxes);
    *design = (tn_design){0};
}

void tn_history_clear(tn_history *history)
{
    free(history->items);
    *history = (tn_history){0};
}

uint32_t tn_design_images(const tn_design *design)
{
    return 1u << __builtin_popcount(design->flags & TN_SOLID_SYMMETRY);
}

uint32_t tn_design_image(const tn_design *design, uint32_t number)
{
    uint32_t mask = 0;
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (!(design->flags & TN_SOLID_SYMMETRY_X << axis))
            continue;
        mask |= (number & 1) << axis;
        number >>= 1;
    }
    return mask;
}

void tn_design_cell(const tn_design *design, uint32_t box, uint32_t image, tn_cut_box *cell)
{
    const tn_solid_box *b = &design->boxes[box];
    if (b->void_) {
        memset(cell, 0, sizeof *cell);
        return;
    }
    tn_cut_box_clip(b->low, b->high, b->clipped ? b->normal : NULL, b->distance, cell);
    for (int axis = 0; axis < 3; axis++)
        if (image >> axis & 1)
            tn_cut_box_mirror(cell, axis);
}

/* ==== squashes boxes that overlap (Bentley, chapter 4.3.1 to 4.3.3). Boxes only shrink, so that the pairs that overlap
 * as written are all that can ever need it. They are found by a tree of boxes and taken in the chapter's order; only
 * the boxes as written are stored, and an image is made when it is compared */

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

/* ---- blocks */

/* A box's faces as whole numbers (exact.h): what is decided here is decided exactly. */
typedef struct block {
    tn_wide low[3], high[3];
    bool rigid, void_;
} block;

static bool less(tn_wide a, tn_wide b)
{
    return tn_wide_compare(a, b) < 0;
}

static bool overlap(const block *p, const block *q)
{
    bool all = !p->void_ && !q->void_;
    for (int k = 0; k < 3; k++)
        all = all && less(p->low[k], q->high[k]) && less(q->low[k], p->high[k]);
    return all;
}

static void mirror(block *one, uint32_t image)
{
    for (int k = 0; k < 3; k++) {
        if (!(image >> k & 1))
            continue;
        tn_wide low = one->low[k];
        one->low[k] = tn_wide_negate(one->high[k]);
        one->high[k] = tn_wide_negate(low);
    }
}

static block block_of(const tn_design *design, uint32_t i)
{
    const tn_solid_box *box = &design->boxes[i];
    block one = {.rigid = box->rigid, .void_ = box->void_};
    for (int k = 0; k < 3; k++) {
        one.low[k] = tn_face_units(&design->unit, box->low[k]);
        one.high[k] = tn_face_units(&design->unit, box->high[k]);
    }
    return one;
}

/* Faces that are the same become the same double. */
static void take_back(tn_design *design, const block *blocks)
{
    for (uint32_t i = 0; i < design->box_count; i++) {
        tn_solid_box *box = &design->boxes[i];
        box->void_ = blocks[i].void_;
        for (int k = 0; k < 3; k++) {
            box->low[k] = tn_face_value(&design->unit, blocks[i].low[k]);
            box->high[k] = tn_face_value(&design->unit, blocks[i].high[k]);
        }
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

/* Of the box in its image. */
static tn_box_bounds bounds_of(const tn_solid_box *box, uint32_t image)
{
    tn_box_bounds bounds;
    for (int k = 0; k < 3; k++) {
        bool turned = image >> k & 1;
        bounds.low[k] = turned ? -box->high[k] : box->low[k];
        bounds.high[k] = turned ? -box->low[k] : box->high[k];
    }
    return bounds;
}

/* All i <= j whose boxes overlap, box j in its image. */
static void match(pairs *found, const tn_design *design, const block *blocks, const tn_box_tree *tree, uint32_t stage,
                  uint32_t image)
{
    tn_box_search search;
    for (uint32_t b = 0, a; b < design->box_count && !found->failed; b++) {
        block other = blocks[b];
        tn_box_bounds bounds = bounds_of(&design->boxes[b], image);
        mirror(&other, image);
        tn_box_tree_search(tree, &bounds, &search);
        while (tn_box_search_next(&search, &a)) {
            bool once = a < b || (image && a == b && (image & (image - 1)) == 0);
            if (once && overlap(&blocks[a], &other))
                add_pair(found, (pair){stage, b, a, image});
        }
    }
}

static void match_all(pairs *found, const tn_design *design, const block *blocks, const tn_box_tree *tree)
{
    match(found, design, blocks, tree, 0, 0);
    for (uint32_t axis = 0, group = 0; axis < 3; axis++) {
        uint32_t flag = 1u << axis;
        if (!(design->flags & flag))
            continue;
        for (uint32_t g = 0; g <= group; g++)
            if ((g & group) == g)
                match(found, design, blocks, tree, 1 + axis, g | flag);
        group |= flag;
    }
}

static tn_status find_pairs(const tn_design *design, const block *blocks, pairs *found, tn_error *error)
{
    tn_box_tree tree = {0};
    tn_box_bounds *bounds = malloc((design->box_count + 1u) * sizeof *bounds);
    for (uint32_t i = 0; bounds && i < design->box_count; i++)
        bounds[i] = bounds_of(&design->boxes[i], 0);
    tn_status status = bounds ? tn_box_tree_make(bounds, design->box_count, &tree, error) : tn_fail_memory(error);
    if (status == TN_OK)
        match_all(found, design, blocks, &tree);
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
    block *p, *q;
    const pair *of;
    const tn_face_unit *unit;
    tn_history *history;
    bool failed;
} meeting;

static tn_wide twice_centre(const block *one, int axis)
{
    return tn_wide_add(one->low[axis], one->high[axis]);
}

static void note(meeting *m, const block *one, int axis, bool high, tn_wide before, tn_wide after)
{
    tn_history *history = m->history;
    bool told = m->of->i == m->of->j && one != m->p; /* an image of its own is squashed as the box is */
    if (!history || m->failed || told || (tn_wide_compare(before, after) == 0 && !one->void_))
        return;
    m->failed = !tn_array_reserve(&history->items, &history->capacity, history->count, 1, sizeof *history->items);
    if (m->failed)
        return;
    bool first = one == m->p, turned = !first && m->of->image >> axis & 1; /* the second is told as it is written */
    double from = tn_face_value(m->unit, before), to = tn_face_value(m->unit, after);
    history->items[history->count++] = (tn_squash){.box = first ? m->of->i : m->of->j,
                                                   .by = first ? m->of->j : m->of->i,
                                                   .image = (uint8_t)m->of->image,
                                                   .axis = (uint8_t)axis,
                                                   .high = high != turned,
                                                   .whole = one->void_,
                                                   .before = turned ? -from : from,
                                                   .after = turned ? -to : to};
}

static void move_face(meeting *m, block *one, int axis, bool high, tn_wide to)
{
    tn_wide *face = high ? &one->high[axis] : &one->low[axis], before = *face;
    *face = to;
    one->void_ |= !less(one->low[axis], one->high[axis]);
    note(m, one, axis, high, before, to);
}

/* What the axes are ordered by, the least first: how far the boxes reach into each other, or how near their centres
 * are. */
static tn_wide key_of(const block *p, const block *q, bool penetration, int axis)
{
    if (penetration) {
        tn_wide high = less(p->high[axis], q->high[axis]) ? p->high[axis] : q->high[axis];
        tn_wide low = less(p->low[axis], q->low[axis]) ? q->low[axis] : p->low[axis];
        return tn_wide_subtract(high, low);
    }
    tn_wide between = tn_wide_subtract(twice_centre(p, axis), twice_centre(q, axis));
    return tn_wide_sign(between) < 0 ? between : tn_wide_negate(between);
}

/* The axes, the one to squash along first; equal ones in the order x, y, z. */
static void order_axes(const block *p, const block *q, bool penetration, int axes[3])
{
    tn_wide key[3];
    for (int k = 0; k < 3; k++) {
        axes[k] = k;
        key[k] = key_of(p, q, penetration, k);
    }
    for (int i = 1; i < 3; i++)
        for (int k = i; k > 0 && less(key[axes[k]], key[axes[k - 1]]); k--) {
            int other = axes[k];
            axes[k] = axes[k - 1];
            axes[k - 1] = other;
        }
}

/* One is rigid: the other goes back to its face, on the first axis on which it sticks out on its own side. */
static void yield_to(meeting *m, const block *rigid, block *one, const int axes[3], int count)
{
    for (int i = 0; i < count; i++) {
        int k = axes[i], order = tn_wide_compare(twice_centre(one, k), twice_centre(rigid, k));
        bool below = order < 0 || (order == 0 && one == m->p);
        if (below ? less(one->low[k], rigid->low[k]) : less(rigid->high[k], one->high[k])) {
            move_face(m, one, k, below, below ? rigid->low[k] : rigid->high[k]);
            return;
        }
    }
    one->void_ = true;
    note(m, one, axes[0], true, one->high[axes[0]], one->low[axes[0]]);
}

/* Both give way: they meet halfway, and between their centres where one is inside the other. */
static void share(meeting *m, int axis, bool own_image)
{
    block *p = m->p, *q = m->q;
    int order = tn_wide_compare(twice_centre(p, axis), twice_centre(q, axis));
    bool p_low = order == 0 ? !own_image : order < 0; /* an image of its own: the box as written takes the high side */
    block *u = p_low ? p : q, *v = p_low ? q : p;
    tn_wide twice = tn_wide_add(u->high[axis], v->low[axis]), low = twice_centre(u, axis), high = twice_centre(v, axis);
    if (less(twice, low))
        twice = low;
    else if (less(high, twice))
        twice = high;
    tn_wide middle = tn_wide_half(twice);
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

/* ---- all of them */

/* Takes the pairs in their order. */
static bool squash_all(const tn_design *design, const pairs *found, block *blocks, tn_history *history)
{
    meeting m = {.unit = &design->unit, .history = history};
    for (size_t k = 0; k < found->count && !m.failed; k++) {
        const pair *one = &found->items[k];
        block other = blocks[one->j];
        mirror(&other, one->image);
        m.p = &blocks[one->i];
        m.q = &other;
        m.of = one;
        if (!overlap(m.p, m.q))
            continue;
        meet(&m, design->flags & TN_SOLID_PENETRATION);
        if (one->i == one->j) /* the image is what the box as written implies */
            continue;
        mirror(&other, one->image);
        blocks[one->j] = other;
    }
    return !m.failed;
}

tn_status tn_design_correct(tn_design *design, tn_history *history, tn_error *error)
{
    pairs found = {0};
    block *blocks = malloc((design->box_count + 1u) * sizeof *blocks);
    for (uint32_t i = 0; blocks && i < design->box_count; i++)
        blocks[i] = block_of(design, i);
    tn_status status = blocks ? find_pairs(design, blocks, &found, error) : tn_fail_memory(error);
    if (status == TN_OK && found.count) {
        if (!squash_all(design, &found, blocks, history))
            status = tn_fail_memory(error);
        take_back(design, blocks);
    }
    free(blocks);
    free(found.items);
    return status;
}

/* ==== makes boxes of their genes */

void tn_box_of_genes(const double genes[TN_BOX_GENES], uint32_t flags, double depth, tn_solid_box *box)
{
    bool flat = flags & TN_SOLID_FLAT;
    *box = (tn_solid_box){.distance = genes[6], .clipped = !(flags & TN_SOLID_NOCLIP)};
    for (int k = 0; k < 3; k++) {
        double centre = nearbyint(genes[k] * TN_GENE_STEPS), half = nearbyint(fabs(genes[3 + k]) * TN_GENE_STEPS / 2);
        box->low[k] = (centre - half) / TN_GENE_STEPS; /* one rounding: numerator and steps are whole */
        box->high[k] = (centre + half) / TN_GENE_STEPS;
    }
    if (flat) {
        box->low[2] = -depth / 2;
        box->high[2] = depth / 2;
    }
    for (int k = 0; k < 3; k++)
        box->void_ |= !(box->high[k] > box->low[k]);
    tn_normal_of_angles(flat ? 90 : genes[7], genes[8], box->normal);
}
