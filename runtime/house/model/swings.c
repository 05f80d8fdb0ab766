/* How doors hang and swing: clear of what stands in the rooms, where they can. */
#include "runtime/house/model/swings.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/model/model.h"
#include "runtime/house/ways.h"

#define DOUBLE_LEAF_NM INT64_C(1220000000) /* 4': wider doors have two leaves */

/* ---- what is taken */

static tn_status take_items(const tn_house *house, uint32_t cell, tn_taken *taken, tn_error *error)
{
    tn_variants v;
    tn_status status = tn_tile_variants(house, cell, &v, error);
    const tn_tile_variant *tile = status == TN_OK && v.count > 0 ? &v.variants[house->cells[cell].variant] : NULL;
    for (size_t i = 0; tile && status == TN_OK && i < tile->item_count; i++) {
        tn_box at = v.items[tile->item_first + i].at;
        status = tn_rectangles_add(&taken->items, (tn_rectangle){at.x0, at.x1, at.y0, at.y1}, error);
    }
    tn_variants_clear(&v);
    return status;
}

static tn_status take_steps(const tn_house *house, const tn_face *face, tn_taken *taken, tn_error *error)
{
    tn_flight flight;
    tn_status status = tn_flight_stand(house, face, &flight, error);
    for (size_t i = 0; status == TN_OK && i < flight.tread_count + flight.wedge_count; i++) {
        tn_box at = i < flight.tread_count ? flight.treads[i] : tn_wedge_box(&flight.wedges[i - flight.tread_count]);
        status = tn_rectangles_add(&taken->items, (tn_rectangle){at.x0, at.x1, at.y0, at.y1}, error);
    }
    tn_flight_clear(&flight);
    return status;
}

tn_status tn_taken_find(const tn_house *house, uint32_t storey, tn_taken *taken, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (house->cells[i].storey == storey)
            status = take_items(house, i, taken, error);
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        bool here = face->relation == TN_FACE_UNDER && (face->storey == storey || face->storey + 1 == storey);
        if (here && tn_form_flight(house->form, face->kind))
            status = take_steps(house, face, taken, error);
        else if (here && face->kind == TN_FACE_STAIR)
            status = tn_rectangles_add(&taken->stairs, face->at, error);
    }
    return status;
}

void tn_taken_clear(tn_taken *taken)
{
    free(taken->items.items);
    free(taken->stairs.items);
    free(taken->swings.items);
    *taken = (tn_taken){0};
}

/* ---- leaves */

/* How far a stretch is from a place, seen in a direction; `far`: where it ends. */
static double ahead(double low, double high, double from, double direction, double *far)
{
    double a = (low - from) * direction, b = (high - from) * direction;
    *far = fmax(a, b);
    return fmax(fmin(a, b), 0);
}

/* Does its quarter of a circle meet one of them? */
static bool meets(const tn_door_leaf *leaf, const tn_rectangles *taken)
{
    double wide = fabs(leaf->shut - leaf->hinge), along_far, across_far;
    for (size_t i = 0; i < taken->count; i++) {
        const tn_rectangle *r = &taken->items[i];
        double low[2] = {(double)r->x0, (double)r->y0}, high[2] = {(double)r->x1, (double)r->y1};
        int u = leaf->in_y ? 1 : 0, v = 1 - u;
        double along = ahead(low[u], high[u], leaf->hinge, leaf->shut > leaf->hinge ? 1 : -1, &along_far),
               across = ahead(low[v], high[v], leaf->face, leaf->side, &across_far);
        if (along_far > 0 && across_far > 0 && along * along + across * across < wide * wide)
            return true;
    }
    return false;
}

static tn_status take_swing(const tn_door_leaf *leaf, tn_taken *taken, tn_error *error)
{
    double wide = fabs(leaf->shut - leaf->hinge), tip = leaf->face + leaf->side * wide;
    int64_t a0 = (int64_t)fmin(leaf->hinge, leaf->shut), a1 = a0 + (int64_t)wide, b0 = (int64_t)fmin(leaf->face, tip),
            b1 = b0 + (int64_t)wide;
    tn_rectangle r = leaf->in_y ? (tn_rectangle){b0, b1, a0, a1} : (tn_rectangle){a0, a1, b0, b1};
    return tn_rectangles_add(&taken->swings, r, error);
}

/* ---- doors */

/* Into a room of the face, hung at the lower end of its wall or (late) at the higher one. */
static tn_swing way_of(const tn_face *face, const tn_box *hole, const tn_cell *room, bool late)
{
    bool in_y = face->at.x0 == face->at.x1;
    double from = (double)(in_y ? hole->y0 : hole->x0), to = (double)(in_y ? hole->y1 : hole->x1);
    bool low = in_y ? room->at.x1 <= face->at.x0 : room->at.y1 <= face->at.y0;
    double at = (double)(in_y ? (low ? hole->x0 : hole->x1) : (low ? hole->y0 : hole->y1)), side = low ? -1 : 1;
    tn_swing way = {.leaves = {{late ? to : from, late ? from : to, at, side, in_y}}, .count = 1};
    if (to - from > (double)DOUBLE_LEAF_NM) {
        way.leaves[0] = (tn_door_leaf){from, (from + to) / 2, at, side, in_y};
        way.leaves[1] = (tn_door_leaf){to, (from + to) / 2, at, side, in_y};
        way.count = 2;
    }
    return way;
}

static bool is_clear(const tn_swing *way, const tn_rectangles *taken)
{
    bool clear = true;
    for (int i = 0; i < way->count; i++)
        clear = clear && !meets(&way->leaves[i], taken);
    return clear;
}

/* One that slides is on the first side. If the form asks for ways, its line says into which cell a leaf opens. Of
 * others, the first that meets nothing; else the first that meets no furniture; else the first. */
static tn_swing choose_way(const tn_house *house, const tn_face *face, const tn_box *hole, const tn_taken *taken)
{
    const tn_cell *first = &house->cells[face->first],
                  *second = face->second == TN_NO_CELL ? NULL : &house->cells[face->second];
    tn_swing ways[4] = {way_of(face, hole, first, false), way_of(face, hole, first, true)};
    int count = 2;
    if (tn_form_opening(house->form, face->kind)->flags & TN_SLIDING) {
        ways[0].sliding = true;
        return ways[0];
    }
    uint32_t leaf = tn_form_asks_ways(house->form) ? tn_face_leaf(house, face) : TN_NO_CELL;
    if (leaf != TN_NO_CELL && leaf == face->second)
        count = 0;
    for (int late = 0; second && !second->open && leaf != face->first && late < 2; late++)
        ways[count++] = way_of(face, hole, second, late);
    for (int i = 0; i < count; i++)
        if (is_clear(&ways[i], &taken->items) && is_clear(&ways[i], &taken->stairs) &&
            is_clear(&ways[i], &taken->swings))
            return ways[i];
    for (int i = 0; i < count; i++)
        if (is_clear(&ways[i], &taken->items))
            return ways[i];
    return ways[0];
}

static bool is_hung(const tn_house *house, const tn_face *face, uint32_t storey)
{
    return face->storey == storey && face->relation != TN_FACE_UNDER && tn_house_is_filled(house, face) &&
           tn_form_opening(house->form, face->kind)->flags & TN_PASSAGE;
}

tn_status tn_swings_find(const tn_house *house, uint32_t storey, tn_taken *taken, tn_swings *swings, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < house->face_count; i++) {
        tn_box hole;
        const tn_face *face = &house->faces[i];
        if (!is_hung(house, face, storey) || !tn_house_hole(house, face, &hole))
            continue;
        tn_swing way = choose_way(house, face, &hole, taken);
        way.of = i;
        for (int k = 0; status == TN_OK && !way.sliding && k < way.count; k++)
            status = take_swing(&way.leaves[k], taken, error);
        if (!tn_array_reserve_from(&swings->items, &swings->room, 16, swings->count, 1, sizeof *swings->items))
            return tn_fail_memory(error);
        swings->items[swings->count++] = way;
    }
    return status;
}

void tn_swings_clear(tn_swings *swings)
{
    free(swings->items);
    *swings = (tn_swings){0};
}
