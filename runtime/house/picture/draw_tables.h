/* Tables on sheets of drawings: the rooms of a house with their numbers and net areas, and its doors and windows by
 * their tags. A tn_sheet_tables owns its rows; free them with tn_sheet_tables_clear. */
#ifndef TARTAN_HOUSE_DRAW_TABLES_H
#define TARTAN_HOUSE_DRAW_TABLES_H

#include "runtime/draw/paint.h"
#include "runtime/house/model/marks.h"

#define TN_TABLE_LEADING 13.0 /* points from row to row */

/* A row: what is called how, what it is, and how large it is; or, without the last, a heading. */
typedef struct tn_table_row {
    char name[16], what[48], size[72];
} tn_table_row;

typedef struct tn_sheet_tables {
    tn_table_row *rows;
    size_t count;
} tn_sheet_tables;

/* Clear it in any case. TN_MEMORY. */
tn_status tn_sheet_tables_make(const tn_house *house, const tn_mark_style *style, tn_sheet_tables *tables,
                               tn_error *error);
void tn_sheet_tables_clear(tn_sheet_tables *tables);

/* How many rows are below one another where the columns may be so wide together: as few as possible, `least` at least.
 */
size_t tn_sheet_tables_deep(const tn_sheet_tables *tables, double width, size_t least);

/* Paints them in columns of so many rows, with their upper left corner at (x, y). */
void tn_sheet_tables_paint(const tn_sheet_tables *tables, tn_paint *paint, double x, double y, size_t deep,
                           double lettering);

#endif
