/* Makes blocks of a house's solids, and cuts blocks by planes across the axes. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/model/model.h"

void tn_blocks_clear(tn_blocks *blocks)
{
    free(blocks->items);
    free(blocks->cuts);
    *blocks = (tn_blocks){0};
}

static tn_status add_block(tn_blocks *blocks, tn_house_block block, tn_error *error)
{
    block.low[2] = block.bottom[0] < block.bottom[1] ? block.bottom[0] : block.bottom[1];
    block.high[2] = block.top[0] > block.top[1] ? block.top[0] : block.top[1];
    if (!tn_array_reserve_from(&blocks->items, &blocks->room, 64, blocks->count, 1, sizeof *blocks->items))
        return tn_fail_memory(error);
    blocks->items[blocks->count++] = block;
    return TN_OK;
}

static tn_status add_cut(tn_blocks *blocks, tn_cut_face face, tn_error *error)
{
    if (!tn_array_reserve_from(&blocks->cuts, &blocks->cut_room, 64, blocks->cut_count, 1, sizeof *blocks->cuts))
        return tn_fail_memory(error);
    blocks->cuts[blocks->cut_count++] = face;
    return TN_OK;
}

/* ---- blocks of solids */

static tn_status add_box(tn_blocks *blocks, const tn_solid *solid, tn_error *error)
{
    const tn_box *b = &solid->at;
    tn_house_block block = {.kind = solid->kind,
                            .group = solid->kind,
                            .end_group = solid->kind,
                            .of = solid->of,
                            .item = solid->item,
                            .axis = 1,
                            .low = {(double)b->x0, (double)b->y0, 0},
                            .high = {(double)b->x1, (double)b->y1, 0},
                            .bottom = {(double)b->z0, (double)b->z0},
                            .top = {(double)b->z1, (double)b->z1}};
    return add_block(blocks, block, error);
}

/* Where lines of roofs have points, in x for those across and in y for the others. Roofs side by side are in one plane;
 * with all of them cut at the same places, rounding leaves no slivers between them. */
typedef struct tn_breaks {
    tn_fraction *at[2];
    size_t count[2];
} tn_breaks;

static int compare(tn_fraction a, tn_fraction b)
{
    tn_int128 x = a.top * b.bottom, y = b.top * a.bottom;
    return (x > y) - (x < y);
}

static int by_value(const void *a, const void *b)
{
    return compare(*(const tn_fraction *)a, *(const tn_fraction *)b);
}

/* Only roofs with slabs are cut so, and those with points that rounding moves. */
static tn_status gather_breaks(const tn_solids *solids, tn_breaks *breaks, tn_error *error)
{
    bool needed = false;
    *breaks = (tn_breaks){0};
    for (size_t i = 0; i < solids->prism_count; i++)
        needed |= solids->prisms[i].slab > 0;
    for (size_t i = 0; i < solids->point_count; i++)
        needed |= solids->points[i].y.bottom != 1 || solids->points[i].z.bottom != 1;
    if (!needed)
        return TN_OK;
    for (int axis = 0; axis < 2; axis++) {
        tn_fraction *at = breaks->at[axis] = malloc(solids->point_count * sizeof *at);
        size_t count = 0, kept = 0;
        if (!at)
            return tn_fail_memory(error);
        for (size_t i = 0; i < solids->prism_count; i++)
            for (size_t k = 0; solids->prisms[i].across == (axis == 0) && k < solids->prisms[i].point_count; k++)
                at[count++] = solids->points[solids->prisms[i].point_first + k].y;
        qsort(at, count, sizeof *at, by_value);
        for (size_t i = 0; i < count; i++)
            if (kept == 0 || compare(at[kept - 1], at[i]) != 0)
                at[kept++] = at[i];
        breaks->count[axis] = kept;
    }
    return TN_OK;
}

/* The height of the line between two points, at a place between them. */
static tn_fraction between(const tn_roof_point ends[2], tn_fraction at)
{
    tn_fraction run = tn_fraction_new(ends[1].y.top * ends[0].y.bottom - ends[0].y.top * ends[1].y.bottom,
                                      ends[1].y.bottom * ends[0].y.bottom),
                rise = tn_fraction_new(ends[1].z.top * ends[0].z.bottom - ends[0].z.top * ends[1].z.bottom,
                                       ends[1].z.bottom * ends[0].z.bottom),
                along = tn_fraction_new(at.top * ends[0].y.bottom - ends[0].y.top * at.bottom,
                                        at.bottom * ends[0].y.bottom),
                slope = tn_fraction_new(rise.top * run.bottom, rise.bottom * run.top),
                up = tn_fraction_new(along.top * slope.top, along.bottom * slope.bottom);
    return tn_fraction_new(ends[0].z.top * up.bottom + up.top * ends[0].z.bottom, ends[0].z.bottom * up.bottom);
}

static tn_status add_stretch(tn_blocks *blocks, const tn_prism *prism, const tn_roof_point ends[2], tn_error *error)
{
    int axis = prism->across ? 0 : 1;
    tn_house_block block = {
        .kind = TN_SOLID_ROOF, .group = TN_SOLID_ROOF, .end_group = TN_SOLID_OUTSIDE, .of = prism->of, .axis = axis};
    block.low[1 - axis] = (double)prism->from;
    block.high[1 - axis] = (double)prism->to;
    block.low[axis] = tn_fraction_value(ends[0].y);
    block.high[axis] = tn_fraction_value(ends[1].y);
    for (int end = 0; end < 2; end++) {
        tn_fraction under = ends[end].z;
        under.top -= (tn_int128)prism->slab * under.bottom;
        block.top[end] = tn_fraction_value(ends[end].z);
        block.bottom[end] = prism->slab ? tn_fraction_value(under) : (double)prism->base;
    }
    return add_block(blocks, block, error);
}

/* A block for each stretch of the roof's line. */
static tn_status add_prism(tn_blocks *blocks, const tn_prism *prism, const tn_roof_point *points,
                           const tn_breaks *breaks, tn_error *error)
{
    int axis = prism->across ? 0 : 1;
    tn_status status = TN_OK;
    for (size_t i = 0, b = 0; status == TN_OK && i + 1 < prism->point_count; i++) {
        tn_roof_point ends[2] = {points[i], points[i]};
        while (b < breaks->count[axis] && compare(breaks->at[axis][b], points[i].y) <= 0)
            b++;
        for (; status == TN_OK && b < breaks->count[axis] && compare(breaks->at[axis][b], points[i + 1].y) < 0; b++) {
            ends[0] = ends[1];
            ends[1] = (tn_roof_point){breaks->at[axis][b], between(points + i, breaks->at[axis][b])};
            status = add_stretch(blocks, prism, ends, error);
        }
        ends[0] = ends[1];
        ends[1] = points[i + 1];
        if (status == TN_OK)
            status = add_stretch(blocks, prism, ends, error);
    }
    return status;
}

tn_house_block tn_block_end(const tn_house_block *block)
{
    tn_house_block wall = *block;
    wall.kind = TN_SOLID_OUTSIDE;
    return wall;
}

/* The blocks from `first` on are the prism's. */
static void find_ends(const tn_house *house, const tn_prism *prism, size_t first, tn_blocks *blocks)
{
    const tn_shape_record *shape = tn_house_shape(house, house->cells[prism->of].zone, TN_CHOICE_ROOF);
    bool ends = prism->slab == 0 && shape && shape->roof != TN_ROOF_FLAT;
    for (size_t i = first; ends && i < blocks->count; i++)
        blocks->items[i].edge = (double)house->form->record->roof;
}

tn_status tn_blocks_of(const tn_house *house, const tn_solids *solids, tn_blocks *blocks, tn_error *error)
{
    tn_solids leaves = {0};
    tn_breaks breaks = {0};
    tn_status status = tn_house_leaves(house, &leaves, error);
    *blocks = (tn_blocks){0};
    if (status == TN_OK)
        status = gather_breaks(solids, &breaks, error);
    for (size_t i = 0; status == TN_OK && i < solids->box_count; i++)
        status = add_box(blocks, &solids->boxes[i], error);
    for (size_t i = 0; status == TN_OK && i < leaves.box_count; i++)
        status = add_box(blocks, &leaves.boxes[i], error);
    for (size_t i = 0; status == TN_OK && i < solids->prism_count; i++) {
        const tn_prism *prism = &solids->prisms[i];
        size_t first = blocks->count;
        status = add_prism(blocks, prism, solids->points + prism->point_first, &breaks, error);
        find_ends(house, prism, first, blocks);
    }
    tn_solids_clear(&leaves);
    free(breaks.at[0]);
    free(breaks.at[1]);
    return status;
}

/* ---- cutting */

/* Where the line from ends[0] to ends[1] is at a place between the block's ends. */
static double height_at(const tn_house_block *b, const double ends[2], double at)
{
    return ends[0] + (ends[1] - ends[0]) * ((at - b->low[b->axis]) / (b->high[b->axis] - b->low[b->axis]));
}

static tn_cut_face cut_face(const tn_house_block *b, const double at[4][2])
{
    tn_cut_face face = {.kind = b->kind, .of = b->of};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            face.at[i][k] = at[i][k];
    return face;
}

/* The part of a block between two places along its slope. */
static tn_house_block stretch(const tn_house_block *b, double from, double to)
{
    tn_house_block part = *b;
    if (from > b->low[b->axis]) {
        part.low[b->axis] = from;
        part.top[0] = height_at(b, b->top, from);
        part.bottom[0] = height_at(b, b->bottom, from);
    }
    if (to < b->high[b->axis]) {
        part.high[b->axis] = to;
        part.top[1] = height_at(b, b->top, to);
        part.bottom[1] = height_at(b, b->bottom, to);
    }
    return part;
}

static tn_status cut_upright(tn_blocks *to, tn_house_block b, int axis, double at, bool above, tn_error *error)
{
    if (!(b.low[axis] < at && b.high[axis] > at))
        return (above ? b.low[axis] >= at : b.high[axis] <= at) ? add_block(to, b, error) : TN_OK;
    int other = 1 - axis;
    bool sloped = axis == b.axis; /* the plane is across the slope: level above and below */
    double bottom = height_at(&b, b.bottom, at), top = height_at(&b, b.top, at);
    const double face[4][2] = {{b.low[other], sloped ? bottom : b.bottom[0]},
                               {b.high[other], sloped ? bottom : b.bottom[1]},
                               {b.high[other], sloped ? top : b.top[1]},
                               {b.low[other], sloped ? top : b.top[0]}};
    tn_status status = add_cut(to, cut_face(&b, face), error);
    if (sloped)
        b = above ? stretch(&b, at, b.high[axis]) : stretch(&b, b.low[axis], at);
    else
        *(above ? &b.low[axis] : &b.high[axis]) = at;
    return status == TN_OK ? add_block(to, b, error) : status;
}

/* A block that the level `at` cuts all over: the level is at its top or below it. */
static tn_status keep_below(tn_blocks *to, tn_house_block b, double at, tn_error *error)
{
    const double face[4][2] = {
        {b.low[0], b.low[1]}, {b.high[0], b.low[1]}, {b.high[0], b.high[1]}, {b.low[0], b.high[1]}};
    b.top[0] = b.top[1] = at;
    tn_status status = add_cut(to, cut_face(&b, face), error);
    return status == TN_OK ? add_block(to, b, error) : status;
}

/* Where a line of the block crosses the level, if between its ends. */
static bool crossing(const tn_house_block *b, const double ends[2], double level, double *at)
{
    if ((ends[0] >= level) == (ends[1] >= level))
        return false;
    *at = b->low[b->axis] + (b->high[b->axis] - b->low[b->axis]) * ((level - ends[0]) / (ends[1] - ends[0]));
    return *at > b->low[b->axis] && *at < b->high[b->axis];
}

/* A part of a block that no line of crosses the level. */
static tn_status cut_part(tn_blocks *to, tn_house_block b, double level, tn_error *error)
{
    if (b.bottom[0] + b.bottom[1] >= 2 * level)
        return TN_OK;
    return b.top[0] + b.top[1] > 2 * level ? keep_below(to, b, level, error) : add_block(to, b, error);
}

/* Only what lies below a level is ever kept. */
static tn_status cut_z(tn_blocks *to, tn_house_block b, double level, tn_error *error)
{
    if (b.high[2] <= level)
        return add_block(to, b, error);
    if (b.low[2] >= level)
        return TN_OK;
    double at[2];
    bool top[2] = {true, false};
    size_t count = crossing(&b, b.top, level, &at[0]) ? 1 : 0;
    top[count] = false;
    if (crossing(&b, b.bottom, level, &at[count]))
        count++;
    if (count == 2 && at[1] < at[0]) {
        double first = at[1];
        at[1] = at[0];
        at[0] = first;
        top[0] = false;
        top[1] = true;
    }
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i <= count; i++) {
        tn_house_block part = stretch(&b, i == 0 ? b.low[b.axis] : at[i - 1], i == count ? b.high[b.axis] : at[i]);
        if (i > 0)
            *(top[i - 1] ? &part.top[0] : &part.bottom[0]) = level;
        if (i < count)
            *(top[i] ? &part.top[1] : &part.bottom[1]) = level;
        status = cut_part(to, part, level, error);
    }
    return status;
}

tn_status tn_blocks_cut(tn_blocks *blocks, int axis, double at, bool above, tn_error *error)
{
    tn_blocks kept = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < blocks->count; i++) {
        const tn_house_block *b = &blocks->items[i];
        status = axis == 2 ? cut_z(&kept, *b, at, error) : cut_upright(&kept, *b, axis, at, above, error);
    }
    tn_blocks_clear(blocks);
    *blocks = kept;
    return status;
}
