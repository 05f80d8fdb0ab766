/* Draws the marks of a roof plan: which way each plane of the roof falls, and how steeply; how large the roof is. The
 * front is below: u is -x, v is -y. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/model/marks.h"
#include "runtime/house/solids.h"
#include "runtime/math/elementary.h"

#define DEGREES (180 / 3.14159265358979323846)

/* A plane of a roof over a cell, or over cells of trays side by side. fall: how much it falls along u and along v; at:
 * its height over the origin, which tells planes apart. reaches: does it have an edge at the left end, and at the right
 * end, of its cells? said: a word, of roofs that do not fall evenly. */
typedef struct roof_plane {
    uint32_t zone, storey, tray;
    double fall[2], at;
    double area, middle[2], low[2], high[2];
    bool reaches[2];
    const char *said;
} roof_plane;

typedef struct roof_planes {
    roof_plane *items;
    size_t count, room;
} roof_planes;

/* ---- planes */

/* The area of a polygon, its middle and its bounds. */
static void measure(const tn_facet *facet, const tn_rectangle *cell, roof_plane *plane)
{
    double sum[2] = {0, 0}, edges[2] = {0, 0}, ends[2] = {(double)cell->x0, (double)cell->x1};
    for (size_t i = 0; i < facet->count; i++) {
        const tn_fraction *from = facet->at[i], *to = facet->at[(i + 1) % facet->count];
        double x0 = tn_fraction_value(from[0]), y0 = tn_fraction_value(from[1]), x1 = tn_fraction_value(to[0]),
               y1 = tn_fraction_value(to[1]), cross = x0 * y1 - x1 * y0;
        plane->area += cross / 2;
        sum[0] += (x0 + x1) * cross / 6;
        sum[1] += (y0 + y1) * cross / 6;
        for (int end = 0; end < 2; end++)
            edges[end] += x0 == ends[end] && x1 == ends[end] ? fabs(y1 - y0) : 0;
        const double seen[2] = {-x0, -y0};
        for (int k = 0; k < 2; k++) {
            plane->low[k] = i ? fmin(plane->low[k], seen[k]) : seen[k];
            plane->high[k] = i ? fmax(plane->high[k], seen[k]) : seen[k];
        }
    }
    for (int k = 0; k < 2; k++) {
        plane->middle[k] = plane->area > 0 ? -sum[k] / plane->area : (plane->low[k] + plane->high[k]) / 2;
        plane->reaches[k] = edges[k] > 0;
    }
}

static tn_status add_plane(roof_planes *planes, const roof_plane *plane, tn_error *error)
{
    if (!tn_array_reserve_from(&planes->items, &planes->room, 16, planes->count, 1, sizeof *planes->items))
        return tn_fail_memory(error);
    planes->items[planes->count++] = *plane;
    return TN_OK;
}

/* Those over a cell. A vault has many, which are one here. */
static tn_status add_planes(const tn_house *house, uint32_t index, roof_planes *planes, tn_error *error)
{
    const tn_cell *cell = &house->cells[index];
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    bool vault = shape && shape->roof == TN_ROOF_VAULT;
    tn_facet facets[TN_FACETS_MAX];
    tn_slopes slopes = tn_roof_slopes_of(house, index);
    size_t count = tn_slopes_cut(&slopes, cell->at, facets);
    double foot = (double)house->form->level[cell->storey + 1], bottom = (double)slopes.bottom;
    tn_status status = TN_OK;
    if (vault) {
        tn_fraction x0 = tn_fraction_whole(cell->at.x0), x1 = tn_fraction_whole(cell->at.x1),
                    y0 = tn_fraction_whole(cell->at.y0), y1 = tn_fraction_whole(cell->at.y1);
        facets[0] = (tn_facet){.count = 4, .at = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
        count = 1;
    }
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const tn_slope *slope = &slopes.items[facets[i].plane];
        roof_plane plane = {.zone = cell->zone, .storey = cell->storey, .tray = cell->tray};
        if (vault)
            plane.said = "vault";
        else if (slope->x == 0 && slope->y == 0)
            plane.said = "flat";
        plane.fall[0] = vault ? 0 : (double)slope->x / bottom;
        plane.fall[1] = vault ? 0 : (double)slope->y / bottom;
        plane.at = foot + (vault ? 0 : (double)slope->at / bottom);
        measure(&facets[i], &cell->at, &plane);
        status = add_plane(planes, &plane, error);
    }
    return status;
}

static int compare(double a, double b)
{
    return a < b ? -1 : a > b;
}

static int by_plane(const void *a, const void *b)
{
    const roof_plane *x = a, *y = b;
    if (x->zone != y->zone)
        return x->zone < y->zone ? -1 : 1;
    if (x->storey != y->storey)
        return x->storey < y->storey ? -1 : 1;
    const double own[4] = {x->fall[0], x->fall[1], x->at, (double)x->tray},
                 other[4] = {y->fall[0], y->fall[1], y->at, (double)y->tray};
    for (int k = 0; k < 4; k++)
        if (own[k] != other[k])
            return compare(own[k], other[k]);
    return compare(y->low[0], x->low[0]); /* u goes to the left */
}

static bool go_together(const roof_plane *a, const roof_plane *b)
{
    return a->zone == b->zone && a->storey == b->storey && a->fall[0] == b->fall[0] && a->fall[1] == b->fall[1] &&
           a->at == b->at && a->tray + 1 == b->tray && a->reaches[1] && b->reaches[0];
}

/* Level ones of zones behind one another. */
static int by_level(const void *a, const void *b)
{
    const roof_plane *x = a, *y = b;
    const double own[5] = {x->said != NULL, x->at, x->low[0], x->high[0], x->low[1]},
                 other[5] = {y->said != NULL, y->at, y->low[0], y->high[0], y->low[1]};
    int order = 0;
    for (int k = 0; k < 5 && order == 0; k++)
        order = compare(own[k], other[k]);
    return order ? order : by_plane(a, b);
}

static bool are_level(const roof_plane *a, const roof_plane *b)
{
    return a->said && b->said && strcmp(a->said, "flat") == 0 && strcmp(b->said, "flat") == 0 && a->at == b->at &&
           a->low[0] == b->low[0] && a->high[0] == b->high[0] && a->high[1] == b->low[1];
}

/* Planes that go on in one another become one: each that goes together with the one before it. */
static void join_planes(roof_planes *planes, int (*order)(const void *, const void *),
                        bool (*together)(const roof_plane *, const roof_plane *))
{
    size_t kept = 0;
    if (planes->count > 0)
        qsort(planes->items, planes->count, sizeof *planes->items, order);
    for (size_t i = 0; i < planes->count; i++) {
        roof_plane next = planes->items[i], *last = kept ? &planes->items[kept - 1] : NULL;
        if (!last || !together(last, &next)) {
            planes->items[kept++] = next;
            continue;
        }
        double whole = last->area + next.area;
        for (int k = 0; k < 2; k++) {
            last->middle[k] = (last->middle[k] * last->area + next.middle[k] * next.area) / whole;
            last->low[k] = fmin(last->low[k], next.low[k]);
            last->high[k] = fmax(last->high[k], next.high[k]);
        }
        last->area = whole;
        last->tray = next.tray;
        last->reaches[1] = next.reaches[1];
    }
    planes->count = kept;
}

/* ---- what is drawn of them */

/* How steep a plane is: by how much it rises in 12, or in degrees. */
static void write_slope(const roof_plane *plane, bool us, char *text, size_t size)
{
    double slope = fabs(plane->fall[0]) + fabs(plane->fall[1]), degrees = tn_atan2(slope, 1) * DEGREES;
    if (us)
        snprintf(text, size, "%.3g:12", 12 * slope);
    else
        snprintf(text, size, fabs(degrees - floor(degrees + 0.5)) < 0.05 ? "%.0f\xc2\xb0" : "%.1f\xc2\xb0", degrees);
}

/* From one place along an axis to another, with its head there. */
static void put_arrow(tn_marks *marks, const double from[2], int axis, double length, double lettering)
{
    double to[2] = {from[0], from[1]}, barb = length < 0 ? 0.6 * lettering : -0.6 * lettering;
    to[axis] += length;
    tn_marks_line(marks, TN_MARK_ROOF, from[0], from[1], to[0], to[1]);
    for (int side = -1; side <= 1; side += 2) {
        double tail[2] = {to[0], to[1]};
        tail[axis] += barb;
        tail[1 - axis] += side * 0.3 * lettering;
        tn_marks_line(marks, TN_MARK_ROOF, tail[0], tail[1], to[0], to[1]);
    }
}

#define ARROW_LEAST 2.0 /* lengths of arrows, in the size of lettering */
#define ARROW_MOST 5.0
#define ARROW_APART 0.5 /* from what is written */

/* How far a plane reaches through its middle along an axis: all of a rectangle, two thirds of a triangle. */
static double room_through(const roof_plane *plane, int axis)
{
    double across = plane->high[1 - axis] - plane->low[1 - axis], along = plane->high[axis] - plane->low[axis];
    return across > 0 ? fmin(along, plane->area / across * 4 / 3) : 0;
}

/* An arrow down the plane, with what is written before it along the slope, or, where the slope has no room for that,
 * beside it; nothing where there is no room for either. */
static void put_fall(const roof_plane *plane, const tn_mark_style *style, tn_marks *marks)
{
    char text[32];
    double l = style->lettering, falls[2] = {plane->fall[0], plane->fall[1]};
    int axis = fabs(falls[1]) > fabs(falls[0]);
    double sign = falls[axis] < 0 ? -1 : 1, room[2];
    write_slope(plane, style->us, text, sizeof text);
    const double size[2] = {tn_mark_width(text) * l, l};
    double middle[2] = {plane->middle[0], plane->middle[1]}, tail[2] = {middle[0], middle[1]};
    for (int k = 0; k < 2; k++)
        room[k] = room_through(plane, k) - 0.6 * l;
    bool before = room[axis] >= size[axis] + (ARROW_APART + ARROW_LEAST) * l && room[1 - axis] >= size[1 - axis];
    bool beside = room[1 - axis] >= size[1 - axis] + 2 * ARROW_APART * l && room[axis] >= ARROW_LEAST * l;
    double taken = before ? size[axis] + ARROW_APART * l : 0, length = fmin(ARROW_MOST * l, room[axis] - taken);
    if (!before && !beside)
        return;
    if (before) {
        double from = middle[axis] - sign * (taken + length) / 2;
        middle[axis] = from + sign * size[axis] / 2;
        tail[axis] = from + sign * taken;
    } else {
        middle[1 - axis] += ARROW_APART * l;
        tail[1 - axis] -= size[1 - axis] / 2;
        tail[axis] -= sign * length / 2;
    }
    put_arrow(marks, tail, axis, sign * length, l);
    tn_marks_text(marks, TN_MARK_ROOF, middle[0], middle[1], l, false, text);
}

static void put_plane(const roof_plane *plane, const tn_mark_style *style, tn_marks *marks)
{
    double l = style->lettering;
    if (!plane->said) {
        put_fall(plane, style, marks);
        return;
    }
    if (plane->high[0] - plane->low[0] > (tn_mark_width(plane->said) + 0.6) * l &&
        plane->high[1] - plane->low[1] > 1.6 * l)
        tn_marks_text(marks, TN_MARK_ROOF, plane->middle[0], plane->middle[1], l, false, plane->said);
}

#define CHAIN 3.4 /* from the roof, in the size of lettering */

tn_status tn_marks_roof(const tn_house *house, const double low[2], const double high[2], const tn_mark_style *style,
                        tn_marks *marks, tn_error *error)
{
    roof_planes planes = {0};
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (tn_cell_is_top(house, i))
            status = add_planes(house, i, &planes, error);
    join_planes(&planes, by_plane, go_together);
    join_planes(&planes, by_level, are_level);
    for (size_t i = 0; status == TN_OK && i < planes.count; i++)
        put_plane(&planes.items[i], style, marks);
    free(planes.items);
    double across[2] = {low[0], high[0]}, along[2] = {low[1], high[1]}, out = CHAIN * style->lettering;
    if (!style->undimensioned) {
        tn_marks_chain(marks, across, 2, low[1] - out, false, style);
        tn_marks_chain(marks, along, 2, low[0] - out, true, style);
    }
    if (style->north)
        tn_marks_north(marks, high, style);
    return status == TN_OK && marks->failed ? tn_fail_memory(error) : status;
}
