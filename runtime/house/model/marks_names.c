/* Letters the rooms of a plan: the name of each and its area, as large as its largest cell allows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/length_style.h"
#include "runtime/house/model/marks_parts.h"

#define SQUARE_FOOT_NM2 ((double)TN_FOOT_NM * (double)TN_FOOT_NM)

/* Words with blanks between them. */
static void write_name(const tn_house *house, const tn_cell *cell, char *text, size_t size)
{
    snprintf(text, size, "%s", tn_text(house->form->module, tn_form_rule(house->form, cell->function)->name));
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

static void put_name(const tn_house *house, uint32_t cell, double area, double lettering, tn_marks *marks)
{
    char name[48], size[32];
    tn_rectangle r = tn_cell_clear(house, cell);
    write_name(house, &house->cells[cell], name, sizeof name);
    write_area(house, area, size, sizeof size);
    double x = (double)(r.x0 + r.x1) / 2, y = (double)(r.y0 + r.y1) / 2;
    double w = (double)(r.x1 - r.x0), d = (double)(r.y1 - r.y0);
    double wide = fmax(tn_mark_width(name), 0.8 * tn_mark_width(size)) * lettering, high = 2.6 * lettering;
    double across = shrink_to(wide, high, w, d), along = shrink_to(wide, high, d, w);
    bool upright = along > 1.2 * across, alone = fmax(along, across) < 0.75;
    if (alone) { /* the name by itself needs less */
        wide = tn_mark_width(name) * lettering;
        across = shrink_to(wide, 1.3 * lettering, w, d);
        along = shrink_to(wide, 1.3 * lettering, d, w);
        upright = along > 1.2 * across;
    }
    double letter = lettering * (upright ? along : across);
    if (letter < 0.4 * lettering)
        return; /* nobody could read it */
    double up = alone ? 0 : 0.65 * letter;
    tn_marks_text(marks, TN_MARK_NAME, upright ? x - up : x, upright ? y : y + up, letter, upright, name);
    if (!alone)
        tn_marks_text(marks, TN_MARK_NAME, upright ? x + up : x, upright ? y : y - up, 0.8 * letter, upright, size);
}

tn_status tn_marks_names(const tn_house *house, uint32_t storey, double lettering, tn_marks *marks, tn_error *error)
{
    uint32_t *rooms;
    tn_status status = tn_house_rooms(house, &rooms, error);
    if (status != TN_OK)
        return status;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        uint32_t largest = TN_NO_CELL;
        if (rooms[i] != i)
            continue;
        double area = room_area(house, rooms, i, storey, &largest);
        if (largest != TN_NO_CELL)
            put_name(house, largest, area, lettering, marks);
    }
    free(rooms);
    return marks->failed ? tn_fail_memory(error) : TN_OK;
}
