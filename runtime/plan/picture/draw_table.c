/* One plan as a table: a box a tray, a row a field. For schemas whose roles do not say how to draw them. */
#include <math.h>

#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

#define TABLE_SIZE 6.0
#define ROW_HEIGHT 9.0
#define BOX_MIN 22.0

static const char *text_of(const tn_draw_roles *roles, tn_tray tray, uint32_t field)
{
    return tn_text(roles->schema->module, tn_tray_value_record(roles->schema, tray, field)->spelling);
}

void tn_draw_table_measure(cairo_t *context, const tn_draw_roles *roles, tn_draw_table *table)
{
    const tn_schema *schema = roles->schema;
    *table = (tn_draw_table){.box_width = BOX_MIN, .row_height = ROW_HEIGHT};
    tn_type_face(context, TABLE_SIZE, false);
    for (uint32_t f = 0; f < schema->field_count; f++)
        table->name_width =
            fmax(table->name_width, tn_type_width(context, tn_text(schema->module, schema->fields[f].name)) + 6);
    for (uint32_t v = 0; v < schema->value_count; v++)
        table->box_width =
            fmax(table->box_width, tn_type_width(context, tn_text(schema->module, schema->values[v].spelling)) + 8);
}

double tn_draw_table_width(const tn_draw_table *table, size_t length)
{
    return table->name_width + table->box_width * (double)length;
}

double tn_draw_table_height(const tn_draw_table *table, const tn_draw_roles *roles)
{
    return table->row_height * roles->schema->field_count;
}

static void draw_lines(cairo_t *context, const tn_draw_table *table, double x, double y, double width, double height,
                       size_t length)
{
    for (double row = table->row_height; row < height - 0.01; row += table->row_height) {
        cairo_move_to(context, x, y + row);
        cairo_line_to(context, x + width, y + row);
    }
    cairo_set_line_width(context, TN_LINE_HAIR);
    cairo_stroke(context);
    for (size_t i = 1; i < length; i++) {
        cairo_move_to(context, x + table->box_width * (double)i, y);
        cairo_line_to(context, x + table->box_width * (double)i, y + height);
    }
    cairo_set_line_width(context, TN_LINE_EDGE);
    cairo_stroke(context);
    cairo_rectangle(context, x, y, width, height);
    cairo_set_line_width(context, TN_LINE_CUT);
    cairo_stroke(context);
}

void tn_draw_table_plan(cairo_t *context, const tn_draw_roles *roles, const tn_draw_table *table,
                        const tn_drawn_plan *plan, double x, double y)
{
    const tn_schema *schema = roles->schema;
    double left = x + table->name_width;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        double baseline = y + table->row_height * (f + 1) - 2.6;
        tn_type_face(context, TABLE_SIZE - 0.8, false);
        tn_type_line(context, left - 5, baseline, TN_ALIGN_RIGHT, tn_text(schema->module, schema->fields[f].name));
        tn_type_face(context, TABLE_SIZE, false);
        for (size_t i = 0; i < plan->length; i++)
            tn_type_line(context, left + table->box_width * ((double)i + 0.5), baseline, TN_ALIGN_CENTRE,
                         text_of(roles, plan->trays[i], f));
    }
    if (plan->length > 0)
        draw_lines(context, table, left, y, table->box_width * (double)plan->length, tn_draw_table_height(table, roles),
                   plan->length);
    else
        tn_type_line(context, left, y + table->row_height - 2.6, TN_ALIGN_LEFT, "no trays");
}
