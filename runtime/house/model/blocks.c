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
                            .of = solid->of,
                            .item = solid->item,
                            .low = {(double)b->x0, (double)b->y0, (double)b->z0},
                            .high = {(double)b->x1, (double)b->y1, 0},
                            .top = {(double)b->z1, (double)b->z1}};
    return add_block(blocks, block, error);
}

/* A block for each stretch of the roof's line. */
static tn_status add_prism(tn_blocks *blocks, const tn_prism *prism, const tn_roof_point *points, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i + 1 < prism->point_count; i++) {
        tn_house_block block = {.kind = TN_SOLID_ROOF,
                                .group = TN_SOLID_ROOF,
                                .of = prism->of,
                                .low = {(double)prism->x0, tn_fraction_value(points[i].y), (double)prism->base},
                                .high = {(double)prism->x1, tn_fraction_value(points[i + 1].y), 0},
                                .top = {tn_fraction_value(points[i].z), tn_fraction_value(points[i + 1].z)}};
        status = add_block(blocks, block, error);
    }
    return status;
}

tn_status tn_blocks_of(const tn_house *house, const tn_solids *solids, tn_blocks *blocks, tn_error *error)
{
    tn_solids leaves = {0};
    tn_status status = tn_house_leaves(house, &leaves, error);
    *blocks = (tn_blocks){0};
    for (size_t i = 0; status == TN_OK && i < solids->box_count; i++)
        status = add_box(blocks, &solids->boxes[i], error);
    for (size_t i = 0; status == TN_OK && i < leaves.box_count; i++)
        status = add_box(blocks, &leaves.boxes[i], error);
    for (size_t i = 0; status == TN_OK && i < solids->prism_count; i++)
        status = add_prism(blocks, &solids->prisms[i], solids->points + solids->prisms[i].point_first, error);
    tn_solids_clear(&leaves);
    return status;
}

/* ---- cutting */

/* The top of a block over a place between its ends. */
static double top_at(const tn_house_block *b, double y)
{
    return b->top[0] + (b->top[1] - b->top[0]) * ((y - b->low[1]) / (b->high[1] - b->low[1]));
}

static tn_cut_face cut_face(const tn_house_block *b, const double at[4][2])
{
    tn_cut_face face = {.kind = b->kind, .of = b->of};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            face.at[i][k] = at[i][k];
    return face;
}

static tn_status cut_x(tn_blocks *to, tn_house_block b, double at, bool above, tn_error *error)
{
    if (b.low[0] < at && b.high[0] > at) {
        const double face[4][2] = {
            {b.low[1], b.low[2]}, {b.high[1], b.low[2]}, {b.high[1], b.top[1]}, {b.low[1], b.top[0]}};
        tn_status status = add_cut(to, cut_face(&b, face), error);
        *(above ? &b.low[0] : &b.high[0]) = at;
        return status == TN_OK ? add_block(to, b, error) : status;
    }
    return (above ? b.low[0] >= at : b.high[0] <= at) ? add_block(to, b, error) : TN_OK;
}

static tn_status cut_y(tn_blocks *to, tn_house_block b, double at, bool above, tn_error *error)
{
    if (b.low[1] < at && b.high[1] > at) {
        double top = top_at(&b, at);
        const double face[4][2] = {{b.low[0], b.low[2]}, {b.high[0], b.low[2]}, {b.high[0], top}, {b.low[0], top}};
        tn_status status = add_cut(to, cut_face(&b, face), error);
        *(above ? &b.low[1] : &b.high[1]) = at;
        b.top[above ? 0 : 1] = top;
        return status == TN_OK ? add_block(to, b, error) : status;
    }
    return (above ? b.low[1] >= at : b.high[1] <= at) ? add_block(to, b, error) : TN_OK;
}

/* The part of a block between two places in y. */
static tn_house_block stretch(const tn_house_block *b, double from, double to)
{
    tn_house_block part = *b;
    if (from > b->low[1]) {
        part.low[1] = from;
        part.top[0] = top_at(b, from);
    }
    if (to < b->high[1]) {
        part.high[1] = to;
        part.top[1] = top_at(b, to);
    }
    return part;
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

/* Only what lies below a level is ever kept. */
static tn_status cut_z(tn_blocks *to, tn_house_block b, double at, tn_error *error)
{
    if (b.high[2] <= at)
        return add_block(to, b, error);
    if (b.low[2] >= at)
        return TN_OK;
    if (b.top[0] >= at && b.top[1] >= at)
        return keep_below(to, b, at, error);
    double y = b.low[1] + (b.high[1] - b.low[1]) * ((at - b.top[0]) / (b.top[1] - b.top[0]));
    if (!(y > b.low[1] && y < b.high[1])) /* it only rounds to one of the ends */
        return b.top[0] + b.top[1] > 2 * at ? keep_below(to, b, at, error) : add_block(to, b, error);
    tn_house_block back = stretch(&b, b.low[1], y), front = stretch(&b, y, b.high[1]);
    back.top[1] = front.top[0] = at;
    bool rises = b.top[1] > b.top[0];
    tn_status status = rises ? add_block(to, back, error) : keep_below(to, back, at, error);
    if (status != TN_OK)
        return status;
    return rises ? keep_below(to, front, at, error) : add_block(to, front, error);
}

tn_status tn_blocks_cut(tn_blocks *blocks, int axis, double at, bool above, tn_error *error)
{
    tn_blocks kept = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < blocks->count; i++) {
        const tn_house_block *b = &blocks->items[i];
        status = axis == 0   ? cut_x(&kept, *b, at, above, error)
                 : axis == 1 ? cut_y(&kept, *b, at, above, error)
                             : cut_z(&kept, *b, at, error);
    }
    tn_blocks_clear(blocks);
    *blocks = kept;
    return status;
}
