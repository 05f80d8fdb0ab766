/* Keeps marks of drawings; writes lengths; draws chains of dimensions, and levels. */
#include "runtime/house/model/marks.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/utf8.h"
#include "runtime/house/solids.h"

void tn_marks_clear(tn_marks *marks)
{
    free(marks->items);
    *marks = (tn_marks){0};
}

static void add(tn_marks *marks, tn_mark mark)
{
    if (!tn_array_reserve_from(&marks->items, &marks->room, 64, marks->count, 1, sizeof *marks->items))
        marks->failed = true;
    else
        marks->items[marks->count++] = mark;
}

void tn_marks_line(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1)
{
    add(marks, (tn_mark){.kind = TN_MARK_LINE, .layer = layer, .u0 = u0, .v0 = v0, .u1 = u1, .v1 = v1});
}

void tn_marks_leaf(tn_marks *marks, double u0, double v0, double u1, double v1, bool right)
{
    add(marks,
        (tn_mark){.kind = TN_MARK_LEAF, .layer = TN_MARK_DOOR, .u0 = u0, .v0 = v0, .u1 = u1, .v1 = v1, .right = right});
}

void tn_marks_pane(tn_marks *marks, double u0, double v0, double u1, double v1, double thick)
{
    add(marks,
        (tn_mark){
            .kind = TN_MARK_PANE, .layer = TN_MARK_WINDOW, .u0 = u0, .v0 = v0, .u1 = u1, .v1 = v1, .high = thick});
}

void tn_marks_text(tn_marks *marks, tn_mark_layer layer, double u, double v, double high, bool upright,
                   const char *text)
{
    tn_mark mark = {
        .kind = TN_MARK_TEXT, .layer = layer, .u0 = u, .v0 = v, .u1 = u, .v1 = v, .high = high, .upright = upright};
    tn_utf8_copy(text, sizeof mark.text, mark.text);
    add(marks, mark);
}

void tn_marks_circle(tn_marks *marks, tn_mark_layer layer, double u, double v, double radius)
{
    add(marks, (tn_mark){.kind = TN_MARK_CIRCLE, .layer = layer, .u0 = u, .v0 = v, .u1 = u + radius, .v1 = v});
}

#define NORTH_OUT 5.5 /* in the size of lettering: where chains of dimensions would meet */
#define NORTH_RADIUS 3.4

void tn_marks_north(tn_marks *marks, const double high[2], const tn_mark_style *style)
{
    double l = style->lettering, u = high[0] + NORTH_OUT * l, v = high[1] + NORTH_OUT * l;
    add(marks, (tn_mark){.kind = TN_MARK_NORTH,
                         .layer = TN_MARK_TAG,
                         .u0 = u,
                         .v0 = v,
                         .u1 = u + NORTH_RADIUS * l,
                         .v1 = v,
                         .high = fmod(*style->north, 360)});
}

void tn_marks_item(tn_marks *marks, const tn_marked_item *item, double u0, double v0, double u1, double v1)
{
    add(marks,
        (tn_mark){
            .kind = TN_MARK_ITEM, .layer = TN_MARK_FURNITURE, .u0 = u0, .v0 = v0, .u1 = u1, .v1 = v1, .item = *item});
}

void tn_marks_turn(tn_marks *marks)
{
    for (size_t i = 0; i < marks->count; i++) {
        tn_mark *m = &marks->items[i];
        m->u0 = -m->u0;
        m->v0 = -m->v0;
        m->u1 = -m->u1;
        m->v1 = -m->v1;
    }
}

double tn_mark_width(const char *text)
{
    unsigned columns = 0;
    for (size_t left = strlen(text), size; left > 0; text += size, left -= size)
        columns += tn_character_width(tn_utf8_read(text, left, &size));
    return 0.62 * columns; /* letters and digits of a sans serif, on the mean, with a little room */
}

/* ---- lengths */

/* Feet, inches and parts of them, as drawings have them: 5'-6 1/2". */
static void write_feet(double nanometres, unsigned bottom, char text[32])
{
    int64_t parts = (int64_t)floor(nanometres / ((double)TN_INCH_NM / bottom) + 0.5), inches = parts / bottom;
    unsigned top = (unsigned)(parts % bottom);
    for (; top > 0 && top % 2 == 0; top /= 2)
        bottom /= 2;
    int used = snprintf(text, 32, "%" PRId64 "'-%" PRId64, inches / 12, inches % 12);
    snprintf(text + used, 32 - (size_t)used, top ? " %u/%u\"" : "\"", top, bottom);
}

void tn_mark_length(const tn_mark_style *style, double nanometres, char text[32])
{
    int64_t millimetres = (int64_t)floor(nanometres / 1e6 + 0.5);
    if (style->us)
        write_feet(nanometres, style->eighths ? 8 : 64, text);
    else if (style->millimetres)
        snprintf(text, 32, "%" PRId64, millimetres);
    else if (millimetres % 10 == 0)
        snprintf(text, 32, "%" PRId64 ".%02d", millimetres / 1000, (int)(millimetres % 1000 / 10));
    else
        snprintf(text, 32, "%" PRId64 ".%03d", millimetres / 1000, (int)(millimetres % 1000));
}

void tn_mark_area(bool us, double square_nanometres, char text[32])
{
    if (us)
        snprintf(text, 32, "%.0f SF", square_nanometres / ((double)TN_FOOT_NM * (double)TN_FOOT_NM));
    else
        snprintf(text, 32, "%.1f m\xc2\xb2", square_nanometres / 1e18);
}

/* ---- chains of dimensions */

static int by_place(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Where what is written on either side of a chain ends so far. */
typedef struct chain_text {
    double end[2];
} chain_text;

/* A dimension and what it says: above the line if it has room there, or else below it, or nothing. */
static void put_length(tn_marks *marks, double from, double to, double at, bool upright, const tn_mark_style *style,
                       chain_text *so_far)
{
    tn_mark mark = {.kind = TN_MARK_SPAN,
                    .layer = TN_MARK_DIMENSION,
                    .u0 = upright ? at : from,
                    .v0 = upright ? from : at,
                    .u1 = upright ? at : to,
                    .v1 = upright ? to : at,
                    .high = style->lettering,
                    .upright = upright,
                    .heavy = style->us};
    char text[32];
    tn_mark_length(style, to - from, text);
    double half = tn_mark_width(text) * style->lettering / 2, middle = (from + to) / 2;
    for (int below = 2 * half > to - from; below < 2 && !mark.text[0]; below++) {
        if (middle - half < so_far->end[below])
            continue;
        mark.below = below > 0;
        tn_utf8_copy(text, sizeof mark.text, mark.text);
        so_far->end[below] = middle + half;
    }
    add(marks, mark);
}

void tn_marks_chain(tn_marks *marks, double *places, size_t count, double at, bool upright, const tn_mark_style *style)
{
    size_t stops = 0;
    chain_text so_far = {{-INFINITY, -INFINITY}};
    qsort(places, count, sizeof *places, by_place);
    for (size_t i = 0; i < count; i++)
        if (stops == 0 || places[i] > places[stops - 1])
            places[stops++] = places[i];
    for (size_t i = 1; i < stops; i++)
        put_length(marks, places[i - 1], places[i], at, upright, style, &so_far);
}

/* ---- levels */

#define EARTH 1.2 /* how deep it is shown where it is cut, in the size of lettering */

/* Heights of roofs are fractions: they are written to the nearest 1/8" or millimetre, as one would build them. */
static double rounded(bool us, double v)
{
    double step = us ? (double)TN_INCH_NM / 8 : 1e6;
    return floor(v / step + 0.5) * step;
}

/* A height above the lowest floor with the name of what is there, over a line with a triangle that points to it. */
static void put_level(tn_marks *marks, double u, double v, const char *name, const tn_mark_style *style)
{
    char text[sizeof marks->items->text], shown[24], length[32];
    double lettering = style->lettering, said = rounded(style->us, v), tip = 0.45 * lettering;
    tn_mark_length(style, fabs(said), length);
    tn_utf8_copy(name, sizeof shown, shown);
    snprintf(text, sizeof text, "%s%s%s%s", shown, shown[0] ? " " : "",
             style->us  ? ""
             : said > 0 ? "+"
             : said < 0 ? "-"
                        : "\xc2\xb1",
             length);
    double wide = tn_mark_width(text) * lettering;
    tn_marks_line(marks, TN_MARK_DIMENSION, u - wide - 2 * lettering, v, u, v);
    tn_marks_line(marks, TN_MARK_DIMENSION, u - 2 * tip, v + tip, u - tip, v);
    tn_marks_line(marks, TN_MARK_DIMENSION, u - tip, v, u, v + tip);
    tn_marks_line(marks, TN_MARK_DIMENSION, u - 2 * tip, v + tip, u, v + tip);
    tn_marks_text(marks, TN_MARK_DIMENSION, u - 1.5 * lettering - wide / 2, v + 0.75 * lettering, lettering, false,
                  text);
}

/* Up to the highest in which there is something: forms have storeys that not each house has. */
static uint32_t count_storeys(const tn_house *house)
{
    uint32_t count = house->form->record->storey_count;
    while (count > 0 && !tn_house_has_storey(house, count - 1))
        count--;
    return count;
}

/* Of each storey its floor and its ceiling, at the right of what is cut. */
static void put_heights(const tn_house *house, double u, double top, const tn_mark_style *style, tn_marks *marks)
{
    uint32_t storeys = count_storeys(house);
    double places[2 * TN_STOREYS_MAX + 2];
    size_t count = 0;
    for (uint32_t k = 0; k < storeys; k++) {
        double floor_at = (double)house->form->level[k], ceiling = floor_at + (double)tn_form_clear(house->form, k);
        if (ceiling > top)
            break;
        places[count++] = floor_at;
        places[count++] = ceiling;
    }
    if ((double)house->form->level[storeys] < top) /* the roof's deck */
        places[count++] = (double)house->form->level[storeys];
    places[count++] = rounded(style->us, top);
    tn_marks_chain(marks, places, count, u, true, style);
}

tn_status tn_marks_levels(const tn_house *house, const double low[2], const double high[2], bool cut,
                          const tn_mark_style *style, tn_marks *marks, tn_error *error)
{
    const tn_house_form *form = house->form;
    double lettering = style->lettering, ground = -(double)form->record->deck, u = low[0] - lettering,
           beyond = 3 * lettering;
    tn_marks_line(marks, TN_MARK_GROUND, low[0] - beyond, ground, high[0] + beyond, ground);
    if (cut && marks->count)
        marks->items[marks->count - 1].high = 2 * EARTH * lettering;
    double last = -1e30;
    uint32_t storeys = count_storeys(house);
    for (uint32_t k = 0; k <= storeys; k++) {
        bool top = k == storeys;
        double v = (double)form->level[k];
        if (v > high[1] || v - last < 1.6 * lettering)
            continue;
        put_level(marks, u, v,
                  top ? "" : tn_text(form->module, form->module->STOREY_records[form->record->storey_first + k].name),
                  style);
        last = v;
    }
    if (high[1] - last >= 1.6 * lettering)
        put_level(marks, u, high[1], "top", style);
    if (cut)
        put_heights(house, high[0] + 3 * lettering, high[1], style, marks);
    return marks->failed ? tn_fail_memory(error) : TN_OK;
}
