/* Draws the marks of a plan: how doors swing, stairs, spaces that are open to below, dimensions; with them names. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/house/model/marks_names.h"
#include "runtime/house/model/model.h"

#define TREAD_NM 254000000.0 /* 10"; more where a stair is so long that it would have more than TREADS_MOST */
#define TREADS_MOST 1000

/* Treads across a stair, and a line up its middle. It goes the same way on both storeys: their cells are equal, though
 * the walls around them may not be. */
static void put_stair(const tn_house *house, uint32_t cell, tn_marks *marks)
{
    tn_rectangle whole = house->cells[cell].at, r = tn_cell_clear(house, cell);
    bool along_x = whole.x1 - whole.x0 > whole.y1 - whole.y0;
    double x0 = (double)r.x0, x1 = (double)r.x1, y0 = (double)r.y0, y1 = (double)r.y1;
    double low = along_x ? x0 : y0, high = along_x ? x1 : y1, tip = TREAD_NM * 0.6,
           tread = fmax(TREAD_NM, (high - low) / TREADS_MOST);
    for (double at = low + tread; at < high; at += tread)
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
    tn_flight_clear(&flight);
    return status;
}

static void put_leaf(tn_marks *marks, const tn_door_leaf *leaf)
{
    double wide = fabs(leaf->shut - leaf->hinge), tip = leaf->face + leaf->side * wide;
    double h[2] = {leaf->hinge, leaf->face}, s[2] = {leaf->shut, leaf->face}, t[2] = {leaf->hinge, tip};
    int u = leaf->in_y ? 1 : 0, v = 1 - u;
    double turn = (s[u] - h[u]) * (t[v] - h[v]) - (s[v] - h[v]) * (t[u] - h[u]);
    const double *from = turn > 0 ? s : t; /* quarters go counter-clockwise */
    tn_marks_line(marks, TN_MARK_DOOR, h[u], h[v], t[u], t[v]);
    tn_marks_arc(marks, TN_MARK_DOOR, h[u], h[v], from[u], from[v]);
}

/* A leaf that slides, where it is shut. */
static void put_sliding(tn_marks *marks, const tn_door_leaf *leaf)
{
    double h[2] = {leaf->hinge, leaf->face}, s[2] = {leaf->shut, leaf->face};
    int u = leaf->in_y ? 1 : 0, v = 1 - u;
    tn_marks_line(marks, TN_MARK_DOOR, h[u], h[v], s[u], s[v]);
}

static void put_door(tn_marks *marks, const tn_swing *door)
{
    for (int k = 0; k < door->count; k++)
        if (door->sliding)
            put_sliding(marks, &door->leaves[k]);
        else
            put_leaf(marks, &door->leaves[k]);
}

static void put_void(tn_rectangle r, tn_marks *marks)
{
    double x0 = (double)r.x0, x1 = (double)r.x1, y0 = (double)r.y0, y1 = (double)r.y1;
    tn_marks_line(marks, TN_MARK_VOID, x0, y0, x1, y1);
    tn_marks_line(marks, TN_MARK_VOID, x0, y1, x1, y0);
}

static tn_status put_symbols(const tn_house *house, uint32_t storey, const tn_swings *doors, tn_marks *marks,
                             tn_error *error)
{
    tn_status status = TN_OK;
    size_t door = 0;
    for (uint32_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER && face->kind == TN_FACE_STAIR) {
            uint32_t cell = face->storey == storey ? face->first : face->second;
            if (house->cells[cell].storey == storey)
                put_stair(house, cell, marks);
        } else if (face->relation == TN_FACE_UNDER && tn_form_flight(house->form, face->kind)) {
            if (status == TN_OK && face->storey == storey)
                status = put_flight(house, face, marks, error);
        } else if (door < doors->count && doors->items[door].of == i) {
            put_door(marks, &doors->items[door]);
            door++;
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
    tn_taken taken = {0};
    tn_swings doors = {0};
    tn_status status = tn_taken_find(house, storey, &taken, error);
    if (status == TN_OK)
        status = tn_swings_find(house, storey, &taken, &doors, error);
    if (status == TN_OK)
        status = put_symbols(house, storey, &doors, marks, error);
    if (status == TN_OK && (!put_dimensions(house, storey, lettering, marks) || marks->failed))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_marks_names(house, storey, lettering, &taken, marks, error);
    tn_swings_clear(&doors);
    tn_taken_clear(&taken);
    return status;
}
