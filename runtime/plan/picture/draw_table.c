/* One plan as a table: a box a tray, a row a field. For schemas whose roles do not say how to draw them. */
#include <math.h>

#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

#define TABLE_SIZE 6.0
#define ROW_HEIGHT 9.0
#define BOX_MIN 22.0
#define HEAD_SIZE 7.6 /* of what a tray is for */
#define HEAD_HEIGHT 15.0

static const char *text_of(const tn_draw_roles *roles, tn_tray tray, uint32_t field)
{
    return tn_text(roles->schema->module, tn_tray_value_record(roles->schema, tray, field)->spelling);
}

void tn_draw_table_measure(tn_paint *paint, const tn_draw_roles *roles, tn_draw_table *table)
{
    const tn_schema *schema = roles->schema;
    *table = (tn_draw_table){.box_width = BOX_MIN, .row_height = ROW_HEIGHT};
    table->head_height = roles->text == TN_NO_FIELD ? 0 : HEAD_HEIGHT;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_paint_face(paint, TABLE_SIZE, false);
        table->name_width =
            fmax(table->name_width, tn_type_width(paint, tn_text(schema->module, schema->fields[f].name)) + 6);
        tn_paint_face(paint, f == roles->text ? HEAD_SIZE : TABLE_SIZE, f == roles->text);
        for (uint32_t v = schema->value_start[f]; v < schema->value_start[f + 1]; v++)
            table->box_width =
                fmax(table->box_width, tn_type_width(paint, tn_text(schema->module, schema->values[v].spelling)) + 8);
    }
}

double tn_draw_table_width(const tn_draw_table *table, size_t length)
{
    return table->name_width + table->box_width * (double)length;
}

double tn_draw_table_height(const tn_draw_table *table, const tn_draw_roles *roles)
{
    return table->head_height + table->row_height * (roles->schema->field_count - (table->head_height > 0));
}

static void draw_lines(tn_paint *paint, const tn_draw_table *table, double x, double y, double width, double height,
                       size_t length)
{
    for (double row = table->head_height > 0 ? table->head_height : table->row_height; row < height - 0.01;
         row += table->row_height) {
        tn_paint_move_to(paint, x, y + row);
        tn_paint_line_to(paint, x + width, y + row);
    }
    tn_paint_line_width(paint, TN_LINE_HAIR);
    tn_paint_stroke(paint);
    for (size_t i = 1; i < length; i++) {
        tn_paint_move_to(paint, x + table->box_width * (double)i, y);
        tn_paint_line_to(paint, x + table->box_width * (double)i, y + height);
    }
    tn_paint_line_width(paint, TN_LINE_EDGE);
    tn_paint_stroke(paint);
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_line_width(paint, TN_LINE_CUT);
    tn_paint_stroke(paint);
}

/* A field's row, with its tones or hatches under the words. */
static void draw_row(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_table *table, const tn_drawn_plan *plan,
                     uint32_t field, double left, double y)
{
    bool head = field == roles->text;
    double height = head ? table->head_height : table->row_height, size = head ? HEAD_SIZE : TABLE_SIZE;
    bool flag = roles->schema->fields[field].kind == TN_FIELD_FLAG;
    tn_paint_face(paint, TABLE_SIZE - 0.8, head);
    tn_type_line(paint, left - 5, y + height / 2 + 2.1, TN_ALIGN_RIGHT,
                 tn_text(roles->schema->module, roles->schema->fields[field].name));
    for (size_t i = 0; i < plan->length; i++) {
        double x = left + table->box_width * (double)i;
        uint32_t value = tn_tray_value(roles->schema, plan->trays[i], field);
        if (field == roles->tone)
            tn_draw_tone(paint, roles, value, x, y, table->box_width, height);
        if (field == roles->hatch)
            tn_draw_hatch(paint, roles, value, x, y, table->box_width, height);
        tn_paint_face(paint, size, head);
        if (!flag || value) /* a flag that is not set says nothing */
            tn_type_line(paint, x + table->box_width / 2, y + height / 2 + size * 0.36, TN_ALIGN_CENTRE,
                         text_of(roles, plan->trays[i], field));
    }
}

void tn_draw_table_plan(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_table *table,
                        const tn_drawn_plan *plan, double x, double y)
{
    double left = x + table->name_width, row = y + table->head_height;
    for (uint32_t f = 0; f < roles->schema->field_count; f++) {
        bool head = f == roles->text;
        draw_row(paint, roles, table, plan, f, left, head ? y : row);
        row += head ? 0 : table->row_height;
    }
    if (plan->length > 0)
        draw_lines(paint, table, left, y, table->box_width * (double)plan->length, tn_draw_table_height(table, roles),
                   plan->length);
    else
        tn_type_line(paint, left, y + table->row_height - 2.6, TN_ALIGN_LEFT, "no trays");
    for (size_t i = 0; i < plan->length; i++) {
        tn_paint_group_begin(paint, TN_PAINT_TRAY, i);
        tn_paint_target(paint, left + table->box_width * (double)i, y, table->box_width,
                        tn_draw_table_height(table, roles));
        tn_paint_group_end(paint);
    }
}
