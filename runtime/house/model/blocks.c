/* Makes blocks of a house's solids, and cuts blocks by planes across the axes. */
#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/model/model.h"

/* Of a block's polygon that has been cut: along two axes and by two levels. */
enum { POLYGON_MAX = TN_FACET_CORNERS + 4 };

/* Where a level cuts a slope is rounded to such a part of a nanometre, so that it is the same place wherever it is
 * worked out from: from the top of a slab, or from the wall below that. */
#define LEVEL_PARTS 64.0

/* A polygon that is cut. Pieces that share an edge, or a face, get the same corners where both are cut. */
typedef struct tn_block_polygon {
    tn_block_corner corners[POLYGON_MAX];
    size_t count;
} tn_block_polygon;

void tn_blocks_clear(tn_blocks *blocks)
{
    free(blocks->items);
    free(blocks->cuts);
    *blocks = (tn_blocks){0};
}

static void widen(double *low, double *high, double at)
{
    *low = at < *low ? at : *low;
    *high = at > *high ? at : *high;
}

static void bound(tn_house_block *block)
{
    const tn_block_corner *first = &block->corners[0];
    block->low[0] = block->high[0] = first->x;
    block->low[1] = block->high[1] = first->y;
    block->low[2] = first->low;
    block->high[2] = first->high;
    for (size_t i = 1; i < block->count; i++) {
        const tn_block_corner *corner = &block->corners[i];
        widen(&block->low[0], &block->high[0], corner->x);
        widen(&block->low[1], &block->high[1], corner->y);
        widen(&block->low[2], &block->high[2], corner->low);
        widen(&block->low[2], &block->high[2], corner->high);
    }
}

static tn_status add_block(tn_blocks *blocks, const tn_house_block *block, tn_error *error)
{
    if (!tn_array_reserve_from(&blocks->items, &blocks->room, 64, blocks->count, 1, sizeof *blocks->items))
        return tn_fail_memory(error);
    blocks->items[blocks->count++] = *block;
    return TN_OK;
}

/* Blocks like one, over a polygon: of more than four corners in parts. */
static tn_status add_polygon(tn_blocks *blocks, const tn_house_block *like, const tn_block_polygon *polygon,
                             tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 1; status == TN_OK && i + 1 < polygon->count; i += TN_BLOCK_CORNERS - 2) {
        tn_house_block block = *like;
        block.count = 0;
        block.corners[block.count++] = polygon->corners[0];
        for (size_t k = i; k < polygon->count && block.count < TN_BLOCK_CORNERS; k++)
            block.corners[block.count++] = polygon->corners[k];
        bound(&block);
        status = add_block(blocks, &block, error);
    }
    return status;
}

static tn_block_polygon polygon_of(const tn_house_block *block)
{
    tn_block_polygon polygon = {.count = block->count};
    for (size_t i = 0; i < block->count; i++)
        polygon.corners[i] = block->corners[i];
    return polygon;
}

/* ---- cutting polygons */

/* The corner between two others whose values are on either side of 0, where the value is 0. An edge gives the same one
 * whichever way it is gone along. */
static tn_block_corner between(const tn_block_corner *a, const tn_block_corner *b, double at_a, double at_b)
{
    if (b->x < a->x || (b->x == a->x && b->y < a->y))
        return between(b, a, at_b, at_a);
    double part = at_a / (at_a - at_b);
    return (tn_block_corner){a->x + part * (b->x - a->x), a->y + part * (b->y - a->y),
                             a->low + part * (b->low - a->low), a->high + part * (b->high - a->high)};
}

/* What is left of a polygon where a value is not below 0; nothing where that has no area. made: of each corner, is it
 * where the value is 0 between two others? */
static tn_block_polygon keep_above(const tn_block_polygon *polygon, const double values[POLYGON_MAX],
                                   bool made[POLYGON_MAX])
{
    tn_block_polygon kept = {.count = 0};
    bool any = false;
    for (size_t i = 0; i < polygon->count && kept.count + 1 < POLYGON_MAX; i++) {
        size_t next = (i + 1) % polygon->count;
        any = any || values[i] > 0;
        if (values[i] >= 0) {
            made[kept.count] = false;
            kept.corners[kept.count++] = polygon->corners[i];
        }
        if ((values[i] < 0 && values[next] > 0) || (values[i] > 0 && values[next] < 0)) {
            made[kept.count] = true;
            kept.corners[kept.count++] =
                between(&polygon->corners[i], &polygon->corners[next], values[i], values[next]);
        }
    }
    kept.count = any ? kept.count : 0;
    return kept;
}

static double place_of(const tn_block_corner *corner, int axis)
{
    return axis == 0 ? corner->x : corner->y;
}

/* What of a polygon is beyond a plane across x or y, or before it. */
static tn_block_polygon upright_part(const tn_block_polygon *polygon, int axis, double at, bool beyond)
{
    double values[POLYGON_MAX];
    bool made[POLYGON_MAX];
    for (size_t i = 0; i < polygon->count; i++) {
        double over = place_of(&polygon->corners[i], axis) - at;
        values[i] = beyond ? over : -over;
    }
    tn_block_polygon part = keep_above(polygon, values, made);
    for (size_t i = 0; i < part.count; i++)
        if (made[i])
            *(axis == 0 ? &part.corners[i].x : &part.corners[i].y) = at;
    return part;
}

/* ---- blocks of solids */

static tn_status add_box(tn_blocks *blocks, const tn_solid *solid, tn_error *error)
{
    double x0 = (double)solid->at.x0, x1 = (double)solid->at.x1, y0 = (double)solid->at.y0, y1 = (double)solid->at.y1,
           low = (double)solid->at.z0, high = (double)solid->at.z1;
    tn_house_block block = {
        .kind = solid->kind,
        .group = solid->kind,
        .of = solid->of,
        .item = solid->item,
        .count = 4,
        .corners = {{x0, y0, low, high}, {x1, y0, low, high}, {x1, y1, low, high}, {x0, y1, low, high}},
        .low = {x0, y0, low},
        .high = {x1, y1, high}};
    return add_block(blocks, &block, error);
}

/* ---- blocks of prisms: cut exactly, so that those beside each other have the same corners */

typedef struct tn_prism_polygon {
    tn_prism_corner corners[POLYGON_MAX];
    size_t count;
} tn_prism_polygon;

/* Where corners of prisms are, in x and in y, of those that touch one another, directly or by way of others. Roofs side
 * by side are in one plane; if all that slope are cut at the same places, rounding leaves no slivers between them, and
 * those that meet have whole faces in common. Others are left whole: each piece of an edge is rounded by itself. */
typedef struct tn_breaks {
    uint32_t *cluster; /* [prisms]: the first of those that it belongs with */
    tn_fraction *at[2];
    size_t count[2];
    double (*bounds)[3][2]; /* [prisms] */
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

static tn_fraction place_of_exact(const tn_prism_corner *corner, int axis)
{
    return axis == 0 ? corner->x : corner->y;
}

static void bound_prism(const tn_solids *solids, const tn_prism *prism, double bounds[3][2])
{
    for (int k = 0; k < 3; k++) {
        bounds[k][0] = INFINITY;
        bounds[k][1] = -INFINITY;
    }
    for (size_t i = 0; i < prism->corner_count; i++) {
        const tn_prism_corner *c = &solids->corners[prism->corner_first + i];
        const tn_fraction at[4] = {c->x, c->y, c->low, c->high};
        for (int k = 0; k < 4; k++)
            widen(&bounds[k < 3 ? k : 2][0], &bounds[k < 3 ? k : 2][1], tn_fraction_value(at[k]));
    }
}

/* A step of rounding apart is still together. */
static bool touch(double a[3][2], double b[3][2])
{
    for (int k = 0; k < 3; k++)
        if (a[k][0] > b[k][1] + 1 || b[k][0] > a[k][1] + 1)
            return false;
    return true;
}

static uint32_t cluster_of(tn_breaks *breaks, uint32_t prism)
{
    while (breaks->cluster[prism] != prism)
        prism = breaks->cluster[prism] = breaks->cluster[breaks->cluster[prism]];
    return prism;
}

static tn_status find_clusters(const tn_solids *solids, tn_breaks *breaks, tn_error *error)
{
    breaks->cluster = malloc((solids->prism_count + 1) * sizeof *breaks->cluster);
    breaks->bounds = malloc((solids->prism_count + 1) * sizeof *breaks->bounds);
    for (int axis = 0; axis < 2; axis++)
        breaks->at[axis] = malloc((solids->corner_count + 1) * sizeof *breaks->at[axis]);
    if (!breaks->cluster || !breaks->bounds || !breaks->at[0] || !breaks->at[1])
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < solids->prism_count; i++) {
        breaks->cluster[i] = i;
        bound_prism(solids, &solids->prisms[i], breaks->bounds[i]);
        for (uint32_t k = 0; k < i; k++)
            if (touch(breaks->bounds[i], breaks->bounds[k])) {
                uint32_t a = cluster_of(breaks, i), b = cluster_of(breaks, k);
                breaks->cluster[a > b ? a : b] = a < b ? a : b;
            }
    }
    for (uint32_t i = 0; i < solids->prism_count; i++)
        breaks->cluster[i] = cluster_of(breaks, i);
    return TN_OK;
}

/* Those of the prisms of one cluster. */
static void gather_breaks(const tn_solids *solids, uint32_t cluster, tn_breaks *breaks)
{
    for (int axis = 0; axis < 2; axis++) {
        tn_fraction *at = breaks->at[axis];
        size_t found = 0, kept = 0;
        for (size_t p = cluster; p < solids->prism_count; p++)
            for (size_t i = 0; breaks->cluster[p] == cluster && i < solids->prisms[p].corner_count; i++)
                at[found++] = place_of_exact(&solids->corners[solids->prisms[p].corner_first + i], axis);
        qsort(at, found, sizeof *at, by_value);
        for (size_t i = 0; i < found; i++)
            if (kept == 0 || compare(at[kept - 1], at[i]) != 0)
                at[kept++] = at[i];
        breaks->count[axis] = kept;
    }
}

static tn_fraction difference(tn_fraction a, tn_fraction b)
{
    return tn_fraction_new(a.top * b.bottom - b.top * a.bottom, a.bottom * b.bottom);
}

/* So far of the way from one number to another. */
static tn_fraction on_the_way(tn_fraction from, tn_fraction to, tn_fraction part)
{
    tn_fraction way = difference(to, from), step = tn_fraction_new(way.top * part.top, way.bottom * part.bottom);
    return tn_fraction_new(from.top * step.bottom + step.top * from.bottom, from.bottom * step.bottom);
}

/* The corner between two others where a plane across an axis is. */
static tn_prism_corner corner_at(const tn_prism_corner *a, const tn_prism_corner *b, int axis, tn_fraction at)
{
    tn_fraction way = difference(place_of_exact(b, axis), place_of_exact(a, axis)),
                over = difference(at, place_of_exact(a, axis)),
                part = tn_fraction_new(over.top * way.bottom, over.bottom * way.top);
    return (tn_prism_corner){axis == 0 ? at : on_the_way(a->x, b->x, part),
                             axis == 1 ? at : on_the_way(a->y, b->y, part), on_the_way(a->low, b->low, part),
                             on_the_way(a->high, b->high, part)};
}

/* What of a polygon is beyond a plane across x or y that cuts it, or before it. */
static tn_prism_polygon exact_part(const tn_prism_polygon *polygon, int axis, tn_fraction at, bool beyond)
{
    tn_prism_polygon part = {.count = 0};
    int turn = beyond ? 1 : -1;
    for (size_t i = 0; i < polygon->count && part.count + 1 < POLYGON_MAX; i++) {
        const tn_prism_corner *corner = &polygon->corners[i], *next = &polygon->corners[(i + 1) % polygon->count];
        int here = turn * compare(place_of_exact(corner, axis), at),
            then = turn * compare(place_of_exact(next, axis), at);
        if (here >= 0)
            part.corners[part.count++] = *corner;
        if (here * then < 0)
            part.corners[part.count++] = corner_at(corner, next, axis, at);
    }
    return part;
}

/* Does it have an edge along which it slopes, and which is not level, in the direction of an axis or across both? */
static bool slopes_along(const tn_prism_polygon *polygon, int axis)
{
    for (size_t i = 0; i < polygon->count; i++) {
        const tn_prism_corner *a = &polygon->corners[i], *b = &polygon->corners[(i + 1) % polygon->count];
        bool in_x = compare(a->x, b->x) != 0, in_y = compare(a->y, b->y) != 0;
        bool level = compare(a->low, b->low) == 0 && compare(a->high, b->high) == 0;
        if ((in_x && in_y) || ((axis == 0 ? in_x : in_y) && !level))
            return true;
    }
    return false;
}

/* What prisms are cut at, and one of them. */
typedef struct tn_breaking {
    tn_blocks *blocks;
    const tn_breaks *breaks;
    tn_house_block like;
    bool along[2]; /* which breaks it is cut at */
} tn_breaking;

static tn_status add_exact(const tn_breaking *b, const tn_prism_polygon *polygon, tn_error *error)
{
    tn_block_polygon rounded = {.count = polygon->count};
    for (size_t i = 0; i < polygon->count; i++) {
        const tn_prism_corner *corner = &polygon->corners[i];
        rounded.corners[i] = (tn_block_corner){tn_fraction_value(corner->x), tn_fraction_value(corner->y),
                                               tn_fraction_value(corner->low), tn_fraction_value(corner->high)};
    }
    return add_polygon(b->blocks, &b->like, &rounded, error);
}

/* Cuts a polygon at the breaks of one axis, and each part at those of the next. */
static tn_status add_broken(const tn_breaking *b, const tn_prism_polygon *polygon, int axis, tn_error *error)
{
    if (axis == 2)
        return add_exact(b, polygon, error);
    tn_fraction low = place_of_exact(&polygon->corners[0], axis), high = low;
    for (size_t i = 1; i < polygon->count; i++) {
        tn_fraction at = place_of_exact(&polygon->corners[i], axis);
        low = tn_fraction_less(at, low) ? at : low;
        high = tn_fraction_less(high, at) ? at : high;
    }
    tn_prism_polygon rest = *polygon;
    tn_status status = TN_OK;
    for (size_t k = 0; status == TN_OK && b->along[axis] && k < b->breaks->count[axis]; k++) {
        tn_fraction at = b->breaks->at[axis][k];
        if (!tn_fraction_less(low, at) || !tn_fraction_less(at, high))
            continue;
        tn_prism_polygon part = exact_part(&rest, axis, at, false);
        rest = exact_part(&rest, axis, at, true);
        status = add_broken(b, &part, axis + 1, error);
    }
    return status == TN_OK ? add_broken(b, &rest, axis + 1, error) : status;
}

static tn_prism_polygon polygon_of_prism(const tn_solids *solids, const tn_prism *prism)
{
    tn_prism_polygon polygon = {.count = prism->corner_count};
    for (size_t i = 0; i < polygon.count; i++)
        polygon.corners[i] = solids->corners[prism->corner_first + i];
    return polygon;
}

static tn_status add_prism(tn_blocks *blocks, const tn_solids *solids, const tn_prism *prism, double slab,
                           const tn_breaks *breaks, tn_error *error)
{
    tn_prism_polygon polygon = polygon_of_prism(solids, prism);
    const tn_breaking breaking = {.blocks = blocks,
                                  .breaks = breaks,
                                  .like = {.kind = prism->kind,
                                           .group = prism->kind,
                                           .of = prism->of,
                                           .item = prism->item,
                                           .slab = prism->kind == TN_SOLID_GABLE ? slab : 0},
                                  .along = {slopes_along(&polygon, 0), slopes_along(&polygon, 1)}};
    return add_broken(&breaking, &polygon, 0, error);
}

tn_status tn_blocks_of_prisms(const tn_solids *solids, tn_blocks *blocks, tn_error *error)
{
    *blocks = (tn_blocks){0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < solids->prism_count; i++) {
        const tn_prism *prism = &solids->prisms[i];
        tn_breaking whole = {.blocks = blocks, .like = {.kind = prism->kind, .of = prism->of}};
        tn_prism_polygon polygon = polygon_of_prism(solids, prism);
        status = add_exact(&whole, &polygon, error);
    }
    return status;
}

tn_status tn_blocks_of(const tn_house *house, const tn_solids *solids, tn_blocks *blocks, tn_error *error)
{
    tn_solids leaves = {0};
    tn_breaks breaks = {0};
    tn_status status = tn_house_leaves(house, &leaves, error);
    *blocks = (tn_blocks){0};
    if (status == TN_OK)
        status = find_clusters(solids, &breaks, error);
    for (size_t i = 0; status == TN_OK && i < solids->box_count; i++)
        status = add_box(blocks, &solids->boxes[i], error);
    for (size_t i = 0; status == TN_OK && i < leaves.box_count; i++)
        status = add_box(blocks, &leaves.boxes[i], error);
    for (uint32_t c = 0; status == TN_OK && c < solids->prism_count; c++) {
        if (breaks.cluster[c] != c)
            continue;
        gather_breaks(solids, c, &breaks);
        for (size_t i = c; status == TN_OK && i < solids->prism_count; i++)
            if (breaks.cluster[i] == c)
                status =
                    add_prism(blocks, solids, &solids->prisms[i], (double)house->form->record->roof, &breaks, error);
    }
    tn_solids_clear(&leaves);
    free(breaks.cluster);
    free(breaks.bounds);
    free(breaks.at[0]);
    free(breaks.at[1]);
    return status;
}

/* ---- cutting blocks */

static tn_status add_cut(tn_blocks *blocks, tn_cut_face face, tn_error *error)
{
    if (!tn_array_reserve_from(&blocks->cuts, &blocks->cut_room, 64, blocks->cut_count, 1, sizeof *blocks->cuts))
        return tn_fail_memory(error);
    blocks->cuts[blocks->cut_count++] = face;
    return TN_OK;
}

/* The face that an upright cut leaves of a block, between the two corners of a part that are in its plane. */
static tn_status add_upright_cut(tn_blocks *to, const tn_house_block *b, const tn_block_polygon *part, int axis,
                                 double at, tn_error *error)
{
    const tn_block_corner *ends[2] = {NULL, NULL};
    for (size_t i = 0; i < part->count; i++) {
        const tn_block_corner *corner = &part->corners[i];
        if (place_of(corner, axis) != at)
            continue;
        if (!ends[0] || place_of(corner, 1 - axis) < place_of(ends[0], 1 - axis))
            ends[0] = corner;
        if (!ends[1] || place_of(corner, 1 - axis) > place_of(ends[1], 1 - axis))
            ends[1] = corner;
    }
    if (!ends[0] || ends[0] == ends[1])
        return TN_OK;
    double from = place_of(ends[0], 1 - axis), end = place_of(ends[1], 1 - axis);
    return add_cut(
        to,
        (tn_cut_face){.kind = b->kind,
                      .item = b->item,
                      .of = b->of,
                      .at = {{from, ends[0]->low}, {end, ends[1]->low}, {end, ends[1]->high}, {from, ends[0]->high}}},
        error);
}

static tn_status cut_upright(tn_blocks *to, const tn_house_block *b, int axis, double at, bool above, tn_error *error)
{
    if (!(b->low[axis] < at && b->high[axis] > at))
        return (above ? b->low[axis] >= at : b->high[axis] <= at) ? add_block(to, b, error) : TN_OK;
    tn_block_polygon whole = polygon_of(b), part = upright_part(&whole, axis, at, above);
    tn_status status = add_upright_cut(to, b, &part, axis, at, error);
    return status == TN_OK ? add_polygon(to, b, &part, error) : status;
}

/* Where the top, or the bottom, of an edge crosses a level; false: nowhere between its ends. */
static bool cross_level(const tn_block_corner *a, const tn_block_corner *b, bool top, double level, tn_block_corner *at)
{
    double from = (top ? a->high : a->low) - level, to = (top ? b->high : b->low) - level;
    if (!((from < 0 && to > 0) || (from > 0 && to < 0)))
        return false;
    *at = between(a, b, from, to);
    double *numbers[4] = {&at->x, &at->y, &at->low, &at->high};
    for (int k = 0; k < 4; k++)
        *numbers[k] = rint(*numbers[k] * LEVEL_PARTS) / LEVEL_PARTS;
    *(top ? &at->high : &at->low) = level;
    return true;
}

/* A polygon with corners wherever its top or its bottom crosses a level: on whole edges, so that those beside it have
 * the same. */
static tn_block_polygon with_crossings(const tn_block_polygon *polygon, double level)
{
    tn_block_polygon with = {.count = 0};
    for (size_t i = 0; i < polygon->count && with.count + 3 <= POLYGON_MAX; i++) {
        const tn_block_corner *a = &polygon->corners[i], *b = &polygon->corners[(i + 1) % polygon->count];
        tn_block_corner at[2];
        size_t count = 0;
        for (int top = 0; top < 2; top++)
            count += cross_level(a, b, top, level, &at[count]);
        bool turned = count == 2 && (at[0].x - at[1].x) * (b->x - a->x) + (at[0].y - at[1].y) * (b->y - a->y) > 0;
        with.corners[with.count++] = *a;
        for (size_t k = 0; k < count; k++)
            with.corners[with.count++] = at[turned ? 1 - k : k];
    }
    return with;
}

/* What of such a polygon has its top, or its bottom, not above a level; or not below it. */
static tn_block_polygon level_part(const tn_block_polygon *polygon, bool top, double level, bool above)
{
    double values[POLYGON_MAX] = {0};
    bool made[POLYGON_MAX];
    for (size_t i = 0; i < polygon->count; i++) {
        double over = (top ? polygon->corners[i].high : polygon->corners[i].low) - level;
        values[i] = above ? over : -over;
    }
    return keep_above(polygon, values, made);
}

/* A part of a block that the level cuts all over: the level becomes its top. */
static tn_status keep_below(tn_blocks *to, const tn_house_block *b, tn_block_polygon part, double level,
                            tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < part.count; i++)
        part.corners[i].high = level;
    for (size_t i = 1; status == TN_OK && i + 1 < part.count; i += 2) {
        tn_cut_face face = {.kind = b->kind, .of = b->of, .item = b->item};
        for (size_t k = 0; k < 4; k++) {
            size_t corner = k == 0 ? 0 : i + k - 1 < part.count ? i + k - 1 : part.count - 1;
            face.at[k][0] = part.corners[corner].x;
            face.at[k][1] = part.corners[corner].y;
        }
        status = add_cut(to, face, error);
    }
    return status == TN_OK ? add_polygon(to, b, &part, error) : status;
}

/* What of a part of a block is below a level. */
static tn_status cut_polygon(tn_blocks *to, const tn_house_block *b, const tn_block_polygon *polygon, double level,
                             tn_error *error)
{
    tn_block_polygon whole = with_crossings(polygon, level), below = level_part(&whole, true, level, false),
                     cut = level_part(&whole, true, level, true);
    tn_status status = add_polygon(to, b, &below, error);
    cut = level_part(&cut, false, level, false);
    return status == TN_OK ? keep_below(to, b, cut, level, error) : status;
}

/* Only what lies below a level is ever kept. A wall below a slab is cut where the slab is: where the level goes through
 * the top of that, too. */
static tn_status cut_level(tn_blocks *to, const tn_house_block *b, double level, tn_error *error)
{
    if (b->slab == 0 && b->high[2] <= level)
        return add_block(to, b, error);
    if (b->low[2] >= level)
        return TN_OK;
    tn_block_polygon whole = polygon_of(b);
    if (b->slab == 0)
        return cut_polygon(to, b, &whole, level, error);
    double top = level - b->slab;
    whole = with_crossings(&whole, top);
    tn_block_polygon lower = level_part(&whole, true, top, false), upper = level_part(&whole, true, top, true);
    tn_status status = cut_polygon(to, b, &lower, level, error);
    return status == TN_OK ? cut_polygon(to, b, &upper, level, error) : status;
}

tn_status tn_blocks_cut(tn_blocks *blocks, int axis, double at, bool above, tn_error *error)
{
    tn_blocks kept = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < blocks->count; i++) {
        const tn_house_block *b = &blocks->items[i];
        status = axis == 2 ? cut_level(&kept, b, at, error) : cut_upright(&kept, b, axis, at, above, error);
    }
    tn_blocks_clear(blocks);
    *blocks = kept;
    return status;
}

tn_status tn_blocks_split(tn_blocks *blocks, tn_solid_kind kind, int axis, double at, tn_error *error)
{
    tn_blocks parts = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < blocks->count; i++) {
        const tn_house_block *b = &blocks->items[i];
        if (b->kind != kind || b->low[axis] >= at || b->high[axis] <= at) {
            status = add_block(&parts, b, error);
            continue;
        }
        for (int beyond = 0; status == TN_OK && beyond < 2; beyond++) {
            tn_block_polygon whole = polygon_of(b), part = upright_part(&whole, axis, at, beyond == 1);
            status = add_polygon(&parts, b, &part, error);
        }
    }
    free(blocks->items);
    blocks->items = parts.items;
    blocks->count = parts.count;
    blocks->room = parts.room;
    return status;
}
