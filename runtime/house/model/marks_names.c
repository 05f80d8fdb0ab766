/* Letters the rooms of a plan: the name of each and its area, where no furniture is below and no door swings. */
#include "runtime/house/model/marks_names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/length.h"
#include "runtime/base/utf8.h"

#define SQUARE_FOOT_NM2 ((double)TN_FOOT_NM * (double)TN_FOOT_NM)

/* Words with blanks between them: what the room is for or, as long as that is not known, its zone. */
static void write_name(const tn_house *house, const tn_cell *cell, char *text, size_t size)
{
    const tn_schema *schema = house->form->schema;
    const char *name = cell->function == TN_NO_FUNCTION
                           ? tn_text(schema->module, schema->fields[cell->zone].name)
                           : tn_text(house->form->module, tn_form_rule(house->form, cell->function)->name);
    tn_utf8_copy(name, size, text);
    for (char *c = text; *c; c++)
        *c = (char)(*c == '-' || *c == '_' ? ' ' : *c);
}

static void write_area(const tn_house *house, double area, char *text, size_t size)
{
    const tn_schema *schema = house->form->schema;
    const char *spelt = tn_text(schema->module, schema->values[schema->value_start[house->form->width]].name);
    if (tn_length_style_of(spelt) == TN_STYLE_FEET)
        snprintf(text, size, "%.0f sf", area / SQUARE_FOOT_NM2);
    else
        snprintf(text, size, "%.1f m2", area / 1e18);
}

/* The area of a room in a storey, and the cell of it that is largest there. */
static double room_area(const tn_house *house, const uint32_t *rooms, uint32_t room, uint32_t storey, uint32_t *largest)
{
    double area = 0, most = -1;
    for (uint32_t i = room; i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        if (rooms[i] != room || cell->storey != storey || cell->open)
            continue;
        double a = (double)tn_cell_area(cell);
        area += a;
        *largest = a > most ? i : *largest;
        most = fmax(most, a);
    }
    return area;
}

/* How much the lettering has to shrink to fit into a space; 1: not at all. */
static double shrink_to(double wide, double high, double room_wide, double room_high)
{
    return fmin(1, fmin(room_wide / wide, room_high / high));
}

/* Where a name stands, and how much of what is taken is below it. letter: how high it is. alone: without the area. */
typedef struct tn_name_place {
    double x, y, letter, covered;
    bool upright, alone;
} tn_name_place;

typedef struct tn_naming {
    const tn_house *house;
    const tn_taken *taken;
    double lettering;
    char name[48], size[32];
} tn_naming;

static double overlap(double low, double high, double from, double to)
{
    return fmax(fmin(high, to) - fmax(low, from), 0);
}

static double covered_of(const tn_rectangles *taken, double x, double y, double half_wide, double half_high)
{
    double covered = 0;
    for (size_t i = 0; i < taken->count; i++) {
        const tn_rectangle *r = &taken->items[i];
        covered += overlap(x - half_wide, x + half_wide, (double)r->x0, (double)r->x1) *
                   overlap(y - half_high, y + half_high, (double)r->y0, (double)r->y1);
    }
    return covered;
}

enum { PLACES = 16 }; /* on either side of the middle, along and across */

/* The place in a room where least is below it, and of those the nearest to the middle. */
static void find_place(const tn_naming *n, tn_rectangle room, double wide, double high, tn_name_place *place)
{
    double x = place->x, y = place->y, near = INFINITY;
    double half_wide = (place->upright ? high : wide) / 2, half_high = (place->upright ? wide : high) / 2;
    double out = fmax((double)(room.x1 - room.x0) / 2 - half_wide, 0) / PLACES,
           up = fmax((double)(room.y1 - room.y0) / 2 - half_high, 0) / PLACES;
    place->covered = INFINITY;
    for (int i = -PLACES; i <= PLACES; i++)
        for (int k = -PLACES; k <= PLACES; k++) {
            double u = x + i * out, v = y + k * up, away = (u - x) * (u - x) + (v - y) * (v - y);
            double covered = covered_of(&n->taken->items, u, v, half_wide, half_high) +
                             covered_of(&n->taken->swings, u, v, half_wide, half_high);
            if (covered > place->covered || (covered == place->covered && away >= near))
                continue;
            *place = (tn_name_place){u, v, place->letter, covered, place->upright, place->alone};
            near = away;
        }
}

/* The better of the best place so far and one in this cell, smaller lettering by `share`. */
static void try_place(const tn_naming *n, uint32_t cell, bool upright, double share, tn_name_place *best)
{
    tn_rectangle r = tn_cell_clear(n->house, cell);
    double w = (double)(r.x1 - r.x0), d = (double)(r.y1 - r.y0), along = upright ? d : w, across = upright ? w : d;
    double wide = fmax(tn_mark_width(n->name), 0.8 * tn_mark_width(n->size)) * n->lettering, high = 2.6 * n->lettering;
    double shrunk = shrink_to(wide, high, along, across);
    bool alone = shrunk < 0.75;
    if (alone) { /* the name by itself needs less */
        wide = tn_mark_width(n->name) * n->lettering;
        high = 1.3 * n->lettering;
        shrunk = shrink_to(wide, high, along, across);
    }
    double letter = n->lettering * shrunk * share, by = shrunk * share;
    tn_name_place place = {(double)(r.x0 + r.x1) / 2, (double)(r.y0 + r.y1) / 2, letter, 0, upright, alone};
    if (letter < 0.4 * n->lettering || letter < 0.7 * best->letter)
        return; /* nobody could read it */
    find_place(n, r, wide * by, high * by, &place);
    if (place.covered < best->covered)
        *best = place;
}

/* First as the lettering is larger; upright only where that makes much of a difference. */
static void try_cell(const tn_naming *n, uint32_t cell, double share, tn_name_place *best)
{
    tn_rectangle r = tn_cell_clear(n->house, cell);
    double w = (double)(r.x1 - r.x0), d = (double)(r.y1 - r.y0), wide = tn_mark_width(n->name) * n->lettering;
    bool upright = shrink_to(wide, n->lettering, d, w) > 1.2 * shrink_to(wide, n->lettering, w, d);
    for (int turned = 0; turned < 2 && best->covered > 0; turned++)
        try_place(n, cell, upright != (bool)turned, share, best);
}

static void put_name(const tn_naming *n, const uint32_t *rooms, uint32_t largest, tn_marks *marks)
{
    const tn_cell *cells = n->house->cells;
    tn_name_place best = {.covered = INFINITY};
    for (double share = 1; share > 0.7 && best.covered > 0; share -= 0.2) {
        try_cell(n, largest, share, &best);
        for (uint32_t i = rooms[largest]; i < n->house->cell_count && best.covered > 0; i++)
            if (rooms[i] == rooms[largest] && cells[i].storey == cells[largest].storey && !cells[i].open)
                try_cell(n, i, share, &best);
    }
    if (best.letter == 0)
        return;
    double up = best.alone ? 0 : 0.65 * best.letter;
    tn_marks_text(marks, TN_MARK_NAME, best.upright ? best.x - up : best.x, best.upright ? best.y : best.y + up,
                  best.letter, best.upright, n->name);
    if (!best.alone)
        tn_marks_text(marks, TN_MARK_NAME, best.upright ? best.x + up : best.x, best.upright ? best.y : best.y - up,
                      0.8 * best.letter, best.upright, n->size);
}

tn_status tn_marks_names(const tn_house *house, uint32_t storey, double lettering, const tn_taken *taken,
                         tn_marks *marks, tn_error *error)
{
    uint32_t *rooms;
    tn_status status = tn_house_rooms(house, &rooms, error);
    tn_naming naming = {.house = house, .taken = taken, .lettering = lettering};
    if (status != TN_OK)
        return status;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        uint32_t largest = TN_NO_CELL;
        if (rooms[i] != i)
            continue;
        double area = room_area(house, rooms, i, storey, &largest);
        if (largest == TN_NO_CELL)
            continue;
        write_name(house, &house->cells[largest], naming.name, sizeof naming.name);
        write_area(house, area, naming.size, sizeof naming.size);
        put_name(&naming, rooms, largest, marks);
    }
    free(rooms);
    return marks->failed ? tn_fail_memory(error) : TN_OK;
}
