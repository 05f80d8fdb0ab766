/* Finds how what stands in the rooms of a storey is drawn: where its back is, and at which sides a chair has room. */
#include <math.h>

#include "runtime/house/model/marks_names.h"
#include "runtime/house/model/model.h"

#define CHAIR_NM INT64_C(450000000)

/* The sides of a drawing: above, at the right, below, at the left. Quarters of a turn count so. */
enum { SIDES = 4 };

/* Which side its back may have: any, a long one, or a short one. Of these it is the one that is nearest to a wall. */
static const enum tn_symbol_back {
    BACK_ANY,
    BACK_LONG,
    BACK_SHORT
} backs[TN_SYMBOL_COUNT] = {
    [TN_SYMBOL_WC] = BACK_SHORT,     [TN_SYMBOL_BASIN] = BACK_LONG, [TN_SYMBOL_BATH] = BACK_SHORT,
    [TN_SYMBOL_SINK] = BACK_LONG,    [TN_SYMBOL_BED] = BACK_SHORT,  [TN_SYMBOL_TABLE] = BACK_LONG,
    [TN_SYMBOL_SOFA] = BACK_LONG,    [TN_SYMBOL_DESK] = BACK_LONG,  [TN_SYMBOL_WARDROBE] = BACK_LONG,
    [TN_SYMBOL_PIANO] = BACK_LONG,   [TN_SYMBOL_SHELF] = BACK_LONG, [TN_SYMBOL_STOVE] = BACK_LONG,
    [TN_SYMBOL_COUNTER] = BACK_LONG, [TN_SYMBOL_BENCH] = BACK_LONG,
};

/* Where the back of a tile is drawn that stands against a side of its room: the front is below. */
static uint32_t drawn_side(tn_house_side side)
{
    static const uint32_t sides[] = {
        [TN_HOUSE_BACK] = 0, [TN_HOUSE_LEFT] = 1, [TN_HOUSE_FRONT] = 2, [TN_HOUSE_RIGHT] = 3};
    return sides[side];
}

static int64_t distance_to(const tn_rectangle *at, const tn_rectangle *room, uint32_t side)
{
    switch (side) {
    case 0:
        return room->y1 - at->y1;
    case 1:
        return room->x1 - at->x1;
    case 2:
        return at->y0 - room->y0;
    default:
        return at->x0 - room->x0;
    }
}

static bool may_be_back(tn_item_symbol symbol, const tn_rectangle *at, uint32_t side)
{
    int64_t across = at->x1 - at->x0, upright = at->y1 - at->y0, own = side % 2 ? upright : across,
            other = side % 2 ? across : upright;
    return backs[symbol] == BACK_ANY || (backs[symbol] == BACK_LONG ? own >= other : own <= other);
}

/* Of the sides that may be its back, the one nearest to a wall; of equal ones the tile's. */
static uint32_t find_back(tn_item_symbol symbol, const tn_rectangle *at, const tn_rectangle *room, uint32_t tile)
{
    uint32_t best = tile;
    int64_t least = INT64_MAX;
    for (uint32_t i = 0; i < SIDES; i++) {
        uint32_t side = (tile + i) % SIDES;
        int64_t away = distance_to(at, room, side);
        if (!may_be_back(symbol, at, side) || away >= least)
            continue;
        best = side;
        least = away;
    }
    return best;
}

/* Has a chair room beside it? */
static bool is_free(const tn_rectangle *at, const tn_rectangle *room, const tn_taken *taken, uint32_t side)
{
    tn_rectangle strip = *at;
    if (distance_to(at, room, side) < CHAIR_NM)
        return false;
    if (side % 2) {
        strip.x0 = side == 1 ? at->x1 : at->x0 - CHAIR_NM;
        strip.x1 = strip.x0 + CHAIR_NM;
    } else {
        strip.y0 = side == 0 ? at->y1 : at->y0 - CHAIR_NM;
        strip.y1 = strip.y0 + CHAIR_NM;
    }
    for (size_t i = 0; i < taken->items.count; i++) {
        const tn_rectangle *r = &taken->items.items[i];
        if (r->x0 < strip.x1 && r->x1 > strip.x0 && r->y0 < strip.y1 && r->y1 > strip.y0)
            return false;
    }
    return true;
}

/* A tile's left is at the right of a drawing where its back is above: its own lines are mirrored, unless it is. */
static void put_item(const tn_house *house, const tn_tile_variant *tile, const tn_standing_item *item,
                     const tn_rectangle *room, const tn_taken *taken, tn_marks *marks)
{
    const tn_tile_box_record *record = &house->form->module->TILE_BOX_records[item->box];
    tn_rectangle at = tn_turned((tn_rectangle){item->at.x0, item->at.x1, item->at.y0, item->at.y1});
    tn_marked_item drawn = {.box = item->box, .symbol = record->symbol, .quarter = drawn_side(tile->side)};
    if (record->symbol == TN_SYMBOL_NONE)
        drawn.mirrored = record->line_count > 0 && !tile->mirrored;
    else
        drawn.quarter = find_back(record->symbol, &at, room, drawn.quarter);
    uint32_t q = drawn.quarter, corner = (q + drawn.mirrored) % SIDES;
    drawn.wide = (double)(q % 2 ? at.y1 - at.y0 : at.x1 - at.x0);
    drawn.deep = (double)(q % 2 ? at.x1 - at.x0 : at.y1 - at.y0);
    const uint32_t sides[SIDES] = {q, (q + 2) % SIDES, (q + 3) % SIDES, (q + 1) % SIDES};
    for (uint32_t i = 0; i < SIDES; i++)
        if (is_free(&at, room, taken, sides[i]))
            drawn.free_sides |= 1u << i;
    if (record->symbol != TN_SYMBOL_TABLE && record->symbol != TN_SYMBOL_DESK)
        drawn.free_sides = 0;
    bool right = corner == 1 || corner == 2, below = corner >= 2; /* corners from above at the left on, clockwise */
    tn_marks_item(marks, &drawn, (double)(right ? at.x1 : at.x0), (double)(below ? at.y0 : at.y1),
                  (double)(right ? at.x0 : at.x1), (double)(below ? at.y1 : at.y0));
}

/* What hangs above the plane of the cut: dashed. */
static void put_overhead(const tn_box *box, tn_marks *marks)
{
    tn_rectangle at = tn_turned((tn_rectangle){box->x0, box->x1, box->y0, box->y1});
    double x0 = (double)at.x0, x1 = (double)at.x1, y0 = (double)at.y0, y1 = (double)at.y1;
    tn_marks_line(marks, TN_MARK_VOID, x0, y0, x1, y0);
    tn_marks_line(marks, TN_MARK_VOID, x1, y0, x1, y1);
    tn_marks_line(marks, TN_MARK_VOID, x1, y1, x0, y1);
    tn_marks_line(marks, TN_MARK_VOID, x0, y1, x0, y0);
}

static tn_status put_cell(const tn_house *house, uint32_t cell, const tn_taken *taken, tn_marks *marks, tn_error *error)
{
    tn_variants v;
    uint32_t storey = house->cells[cell].storey;
    int64_t cut = tn_plan_level(house->form, storey) - house->form->level[storey];
    tn_rectangle room = tn_turned(tn_cell_clear(house, cell));
    tn_status status = tn_tile_variants(house, cell, &v, error);
    const tn_tile_variant *tile = status == TN_OK && v.count > 0 ? &v.variants[house->cells[cell].variant] : NULL;
    for (size_t i = 0; tile && i < tile->item_count; i++) {
        const tn_standing_item *item = &v.items[tile->item_first + i];
        if (item->at.z0 < cut)
            put_item(house, tile, item, &room, taken, marks);
        else
            put_overhead(&item->at, marks);
    }
    tn_variants_clear(&v);
    return status;
}

tn_status tn_marks_items(const tn_house *house, uint32_t storey, const tn_taken *taken, tn_marks *marks,
                         tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (house->cells[i].storey == storey)
            status = put_cell(house, i, taken, marks, error);
    return status == TN_OK && marks->failed ? tn_fail_memory(error) : status;
}
