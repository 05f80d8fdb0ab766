/* Writes the tables of a sheet: what rooms, doors and windows are called in its drawings. */
#include "runtime/house/picture/draw_tables.h"

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/utf8.h"
#include "runtime/draw/type.h"
#include "runtime/house/model/designations.h"

#define NAME_WIDTH 34.0
#define WHAT_WIDTH 92.0
#define MEASURE_WIDTH 120.0
#define COLUMN_WIDTH (NAME_WIDTH + WHAT_WIDTH + MEASURE_WIDTH + 16)

void tn_sheet_tables_clear(tn_sheet_tables *tables)
{
    free(tables->rows);
    *tables = (tn_sheet_tables){0};
}

static void add_heading(tn_sheet_tables *tables, const char *text)
{
    tn_table_row *row = &tables->rows[tables->count++];
    *row = (tn_table_row){.name = "", .size = ""};
    snprintf(row->what, sizeof row->what, "%s", text);
}

static void add_opening(tn_sheet_tables *tables, const tn_house *house, const tn_mark_style *style,
                        const tn_tagged_opening *tagged)
{
    const tn_opening_record *opening = tn_form_opening(house->form, tagged->kind);
    tn_table_row *row = &tables->rows[tables->count++];
    char wide[32], high[32];
    *row = (tn_table_row){.name = ""};
    snprintf(row->name, sizeof row->name, "%s", tagged->tag);
    tn_utf8_copy(tn_form_kind_text(house->form, tagged->kind), sizeof row->what, row->what);
    tn_mark_length(style, (double)opening->wide, wide);
    tn_mark_length(style, (double)opening->high, high);
    snprintf(row->size, sizeof row->size, "%zu: %s \xc3\x97 %s", tagged->count, wide, high);
}

static void add_room(tn_sheet_tables *tables, const tn_mark_style *style, const tn_numbered_room *room)
{
    tn_table_row *row = &tables->rows[tables->count++];
    char area[32];
    *row = (tn_table_row){.name = ""};
    snprintf(row->name, sizeof row->name, "%s", room->number);
    snprintf(row->what, sizeof row->what, "%s", room->name);
    tn_mark_area(style->us, room->net, area);
    snprintf(row->size, sizeof row->size, "%s net", area);
}

tn_status tn_sheet_tables_make(const tn_house *house, const tn_mark_style *style, tn_sheet_tables *tables,
                               tn_error *error)
{
    tn_designations names;
    tn_status status = tn_designations_find(house, style->us, &names, error);
    *tables = (tn_sheet_tables){0};
    if (status == TN_OK &&
        !(tables->rows = malloc((names.room_count + names.opening_count + 2) * sizeof *tables->rows)))
        status = tn_fail_memory(error);
    if (status == TN_OK && names.opening_count > 0)
        add_heading(tables, "doors and windows");
    for (size_t i = 0; status == TN_OK && i < names.opening_count; i++)
        add_opening(tables, house, style, &names.openings[i]);
    if (status == TN_OK && names.room_count > 0)
        add_heading(tables, "rooms");
    for (size_t i = 0; status == TN_OK && i < names.room_count; i++)
        add_room(tables, style, &names.numbered[i]);
    tn_designations_clear(&names);
    return status;
}

static bool is_heading(const tn_table_row *row)
{
    return row->size[0] == '\0';
}

/* Where a row stands that comes after so many: a heading is not the last of a column. */
static size_t place_row(const tn_table_row *row, size_t before, size_t deep)
{
    return is_heading(row) && before % deep == deep - 1 ? before + 1 : before;
}

static size_t count_places(const tn_sheet_tables *tables, size_t deep)
{
    size_t places = 0;
    for (size_t i = 0; i < tables->count; i++)
        places = place_row(&tables->rows[i], places, deep) + 1;
    return places;
}

size_t tn_sheet_tables_deep(const tn_sheet_tables *tables, double width, size_t least)
{
    size_t columns = width > COLUMN_WIDTH ? (size_t)(width / COLUMN_WIDTH) : 1,
           deep = (tables->count + columns - 1) / columns;
    if (deep < least)
        deep = least;
    while (count_places(tables, deep) > deep * columns)
        deep++;
    return deep;
}

void tn_sheet_tables_paint(const tn_sheet_tables *tables, tn_paint *paint, double x, double y, size_t deep,
                           double lettering)
{
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_layer(paint, TN_LAYER_TEXT);
    for (size_t i = 0, place = 0; i < tables->count; i++, place++) {
        const tn_table_row *row = &tables->rows[i];
        place = place_row(row, place, deep);
        double left = x + (double)(place / deep) * COLUMN_WIDTH,
               baseline = y + (double)(place % deep + 1) * TN_TABLE_LEADING - 3;
        bool heading = is_heading(row);
        tn_paint_face(paint, lettering, heading);
        tn_type_line(paint, left, baseline, TN_ALIGN_LEFT, row->name);
        tn_type_fit(paint, left + (heading ? 0 : NAME_WIDTH), baseline, TN_ALIGN_LEFT,
                    heading ? COLUMN_WIDTH : WHAT_WIDTH, row->what);
        tn_type_fit(paint, left + NAME_WIDTH + WHAT_WIDTH + 4, baseline, TN_ALIGN_LEFT, MEASURE_WIDTH, row->size);
    }
}
