/* Draws how doors swing on a plan: clear of what stands in the rooms, where they can. */
#include <math.h>
#include <stdlib.h>

#include "runtime/house/model/marks_parts.h"
#include "runtime/house/model/model.h"

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
    for (size_t i = 0; status == TN_OK && i < flight.tread_count; i++) {
        tn_box at = flight.treads[i];
        status = tn_rectangles_add(&taken->items, (tn_rectangle){at.x0, at.x1, at.y0, at.y1}, error);
    }
    free(flight.treads);
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

/* A leaf that hangs at `hinge` and closes towards `shut`, both along a wall; it swings to `side` (1 or -1) of the place
 * `face` across it. in_y: the wall runs along y. */
typedef struct tn_swing {
    double hinge, shut, face, side;
    bool in_y;
} tn_swing;

static void put_leaf(tn_marks *marks, const tn_swing *leaf)
{
    double wide = fabs(leaf->shut - leaf->hinge), tip = leaf->face + leaf->side * wide;
    double h[2] = {leaf->hinge, leaf->face}, s[2] = {leaf->shut, leaf->face}, t[2] = {leaf->hinge, tip};
    int u = leaf->in_y ? 1 : 0, v = 1 - u;
    double turn = (s[u] - h[u]) * (t[v] - h[v]) - (s[v] - h[v]) * (t[u] - h[u]);
    const double *from = turn > 0 ? s : t; /* quarters go counter-clockwise */
    tn_marks_line(marks, TN_MARK_DOOR, h[u], h[v], t[u], t[v]);
    tn_marks_arc(marks, TN_MARK_DOOR, h[u], h[v], from[u], from[v]);
}

/* How far a stretch is from a place, seen in a direction; `far`: where it ends. */
static double ahead(double low, double high, double from, double direction, double *far)
{
    double a = (low - from) * direction, b = (high - from) * direction;
    *far = fmax(a, b);
    return fmax(fmin(a, b), 0);
}

/* Does its quarter of a circle meet one of them? */
static bool meets(const tn_swing *leaf, const tn_rectangles *taken)
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

static tn_status take_swing(const tn_swing *leaf, tn_taken *taken, tn_error *error)
{
    double wide = fabs(leaf->shut - leaf->hinge), tip = leaf->face + leaf->side * wide;
    int64_t a0 = (int64_t)fmin(leaf->hinge, leaf->shut), a1 = a0 + (int64_t)wide, b0 = (int64_t)fmin(leaf->face, tip),
            b1 = b0 + (int64_t)wide;
    tn_rectangle r = leaf->in_y ? (tn_rectangle){b0, b1, a0, a1} : (tn_rectangle){a0, a1, b0, b1};
    return tn_rectangles_add(&taken->swings, r, error);
}

/* ---- doors */

/* How a door can swing: one leaf or two. */
typedef struct tn_way {
    tn_swing leaves[2];
    int count;
} tn_way;

/* Into a room of the face, hung at the lower end of its wall or (late) at the higher one. */
static tn_way way_of(const tn_face *face, const tn_box *hole, const tn_cell *room, bool late)
{
    bool in_y = face->at.x0 == face->at.x1;
    double from = (double)(in_y ? hole->y0 : hole->x0), to = (double)(in_y ? hole->y1 : hole->x1);
    bool low = in_y ? room->at.x1 <= face->at.x0 : room->at.y1 <= face->at.y0;
    double at = (double)(in_y ? (low ? hole->x0 : hole->x1) : (low ? hole->y0 : hole->y1)), side = low ? -1 : 1;
    tn_way way = {{{late ? to : from, late ? from : to, at, side, in_y}}, 1};
    if (to - from > (double)DOUBLE_LEAF_NM) {
        way.leaves[0] = (tn_swing){from, (from + to) / 2, at, side, in_y};
        way.leaves[1] = (tn_swing){to, (from + to) / 2, at, side, in_y};
        way.count = 2;
    }
    return way;
}

static bool is_clear(const tn_way *way, const tn_rectangles *taken)
{
    bool clear = true;
    for (int i = 0; i < way->count; i++)
        clear = clear && !meets(&way->leaves[i], taken);
    return clear;
}

/* The first that meets nothing; else the first that meets no furniture; else the first. */
static tn_way choose_way(const tn_house *house, const tn_face *face, const tn_box *hole, const tn_taken *taken)
{
    const tn_cell *first = &house->cells[face->first],
                  *second = face->second == TN_NO_CELL ? NULL : &house->cells[face->second];
    tn_way ways[4] = {way_of(face, hole, first, false), way_of(face, hole, first, true)};
    int count = 2;
    for (int late = 0; second && !second->open && late < 2; late++)
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

tn_status tn_marks_door(const tn_house *house, const tn_face *face, tn_taken *taken, tn_marks *marks, tn_error *error)
{
    tn_box hole;
    tn_status status = TN_OK;
    if (!tn_house_hole(house, face, &hole) || !tn_house_is_filled(house, face) ||
        !(tn_form_opening(house->form, face->kind)->flags & TN_PASSAGE))
        return TN_OK;
    tn_way way = choose_way(house, face, &hole, taken);
    for (int i = 0; status == TN_OK && i < way.count; i++) {
        put_leaf(marks, &way.leaves[i]);
        status = take_swing(&way.leaves[i], taken, error);
    }
    return status;
}
