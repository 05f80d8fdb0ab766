/* Draws the marks of a plan: how doors swing, stairs, spaces that are open to below, names of rooms, dimensions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/house/model/marks_parts.h"
#include "runtime/house/model/model.h"

#define DOUBLE_LEAF_NM INT64_C(1220000000) /* 4': wider doors have two leaves */
#define TREAD_NM 254000000.0               /* 10" */

static tn_box box_in_plan(tn_box hole, bool in_y) /* as if its wall ran along x */
{
    return in_y ? (tn_box){hole.y0, hole.y1, hole.x0, hole.x1, 0, 0} : hole;
}

/* A leaf that hangs at `hinge` and closes towards `shut`, both along a wall; it swings to `side` (1 or -1) of the place
 * `face` across it. in_y: the wall runs along y. */
static void put_leaf(tn_marks *marks, double hinge, double shut, double face, double side, bool in_y)
{
    double wide = fabs(shut - hinge), tip = face + side * wide;
    double h[2] = {hinge, face}, s[2] = {shut, face}, t[2] = {hinge, tip};
    int u = in_y ? 1 : 0, v = 1 - u;
    double turn = (s[u] - h[u]) * (t[v] - h[v]) - (s[v] - h[v]) * (t[u] - h[u]);
    const double *from = turn > 0 ? s : t; /* quarters go counter-clockwise */
    tn_marks_line(marks, TN_MARK_DOOR, h[u], h[v], t[u], t[v]);
    tn_marks_arc(marks, TN_MARK_DOOR, h[u], h[v], from[u], from[v]);
}

/* Doors swing into the room that comes first. */
static void put_door(const tn_house *house, const tn_face *face, tn_marks *marks)
{
    tn_box hole;
    if (!tn_house_hole(house, face, &hole) || !tn_house_is_filled(house, face) ||
        !(tn_form_opening(house->form, face->kind)->flags & TN_PASSAGE))
        return;
    const tn_cell *room = &house->cells[face->first];
    bool in_y = face->at.x0 == face->at.x1;
    hole = box_in_plan(hole, in_y);
    int64_t plane = in_y ? face->at.x0 : face->at.y0;
    bool low = in_y ? room->at.x1 <= plane : room->at.y1 <= plane;
    double at = (double)(low ? hole.y0 : hole.y1), side = low ? -1 : 1, from = (double)hole.x0, to = (double)hole.x1;
    if (hole.x1 - hole.x0 <= DOUBLE_LEAF_NM) {
        put_leaf(marks, from, to, at, side, in_y);
    } else {
        put_leaf(marks, from, (from + to) / 2, at, side, in_y);
        put_leaf(marks, to, (from + to) / 2, at, side, in_y);
    }
}

/* Treads across a stair, and a line up its middle. */
static void put_stair(tn_rectangle r, tn_marks *marks)
{
    double x0 = (double)r.x0, x1 = (double)r.x1, y0 = (double)r.y0, y1 = (double)r.y1;
    bool along_x = x1 - x0 > y1 - y0;
    double low = along_x ? x0 : y0, high = along_x ? x1 : y1, tip = TREAD_NM * 0.6;
    for (double at = low + TREAD_NM; at < high; at += TREAD_NM)
        tn_marks_line(marks, TN_MARK_STAIR, along_x ? at : x0, along_x ? y0 : at, along_x ? at : x1, along_x ? y1 : at);
    double mx = (x0 + x1) / 2, my = (y0 + y1) / 2;
    tn_marks_line(marks, TN_MARK_STAIR, along_x ? x0 : mx, along_x ? my : y0, along_x ? x1 : mx, along_x ? my : y1);
    for (int side = -1; side <= 1; side += 2)
        tn_marks_line(marks, TN_MARK_STAIR, along_x ? x1 - tip : mx + side * tip / 2,
                      along_x ? my + side * tip / 2 : y1 - tip, along_x ? x1 : mx, along_x ? my : y1);
}

/* The way up a flight, and a point at its upper end. */
static tn_status put_flight(const tn_house *house, const tn_face *face, tn_marks *marks, tn_error *error)
{
    tn_flight flight;
    tn_status status = tn_flight_stand(house, face, &flight, error);
    free(flight.treads);
    double u0 = 0, v0 = 0, tip = TREAD_NM * 0.6;
    for (size_t i = 0; i < flight.path_count; i++) {
        double u = (double)flight.path[i][0], v = (double)flight.path[i][1], along = fabs(u - u0) + fabs(v - v0);
        if (i > 0)
            tn_marks_line(marks, TN_MARK_STAIR, u0, v0, u, v);
        if (i > 0 && i + 1 == flight.path_count) {
            double du = (u - u0) / along * tip, dv = (v - v0) / along * tip;
            tn_marks_line(marks, TN_MARK_STAIR, u - du - dv / 2, v - dv + du / 2, u, v);
            tn_marks_line(marks, TN_MARK_STAIR, u - du + dv / 2, v - dv - du / 2, u, v);
        }
        u0 = u;
        v0 = v;
    }
    return status;
}

static void put_void(tn_rectangle r, tn_marks *marks)
{
    double x0 = (double)r.x0, x1 = (double)r.x1, y0 = (double)r.y0, y1 = (double)r.y1;
    tn_marks_line(marks, TN_MARK_VOID, x0, y0, x1, y1);
    tn_marks_line(marks, TN_MARK_VOID, x0, y1, x1, y0);
}

static tn_status put_symbols(const tn_house *house, uint32_t storey, tn_marks *marks, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER && face->kind == TN_FACE_STAIR) {
            uint32_t cell = face->storey == storey ? face->first : face->second;
            if (house->cells[cell].storey == storey)
                put_stair(tn_cell_clear(house, cell), marks);
        } else if (face->relation == TN_FACE_UNDER && tn_form_flight(house->form, face->kind)) {
            if (status == TN_OK && face->storey == storey)
                status = put_flight(house, face, marks, error);
        } else if (face->storey == storey && face->relation != TN_FACE_UNDER) {
            put_door(house, face, marks);
        }
    }
    for (uint32_t i = 0; i < house->cell_count; i++)
        if (house->cells[i].storey == storey && house->cells[i].open)
            put_void(tn_cell_clear(house, i), marks);
    return status;
}

/* ---- dimensions */

static int by_place(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* A chain of dimensions between places, and a second one over the whole. */
static void put_chain(const tn_house *house, double *places, size_t count, double edge, bool upright, double lettering,
                      tn_marks *marks)
{
    qsort(places, count, sizeof *places, by_place);
    double inner = edge - 3 * lettering, outer = edge - 5.5 * lettering;
    size_t stops = 1;
    for (size_t i = 1; i < count; i++)
        if (places[i] > places[stops - 1])
            places[stops++] = places[i];
    for (size_t i = 1; i < stops; i++)
        tn_marks_dimension(marks, house, places[i - 1], places[i], inner, upright, lettering);
    if (stops > 2)
        tn_marks_dimension(marks, house, places[0], places[stops - 1], outer, upright, lettering);
}

static bool put_dimensions(const tn_house *house, uint32_t storey, double lettering, tn_marks *marks)
{
    double *places = malloc((4 * house->cell_count + 1) * sizeof *places);
    size_t count = 0;
    if (!places)
        return false;
    double *deep = places + 2 * house->cell_count, low[2] = {INFINITY, INFINITY};
    int64_t half = house->form->record->wall / 2; /* walls reach so far beyond their planes */
    for (uint32_t i = 0; i < house->cell_count; i++) {
        const tn_rectangle *at = &house->cells[i].at;
        low[0] = fmin(low[0], (double)(at->x0 - half));
        low[1] = fmin(low[1], (double)(at->y0 - half));
        if (house->cells[i].storey != storey)
            continue;
        places[2 * count] = (double)at->x0;
        places[2 * count + 1] = (double)at->x1;
        deep[2 * count] = (double)at->y0;
        deep[2 * count++ + 1] = (double)at->y1;
    }
    if (count) {
        put_chain(house, places, 2 * count, low[1], false, lettering, marks);
        put_chain(house, deep, 2 * count, low[0], true, lettering, marks);
    }
    free(places);
    return true;
}

tn_status tn_marks_plan(const tn_house *house, uint32_t storey, double lettering, tn_marks *marks, tn_error *error)
{
    tn_status status = put_symbols(house, storey, marks, error);
    if (status != TN_OK)
        return status;
    if (!put_dimensions(house, storey, lettering, marks) || marks->failed)
        return tn_fail_memory(error);
    return tn_marks_names(house, storey, lettering, marks, error);
}
