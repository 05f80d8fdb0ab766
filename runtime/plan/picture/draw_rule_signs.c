/* The signs of rules: frames, arrows, walls, tags. */
#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_rule_data.h"

/* ---- lines */

void tn_draw_rule_box(tn_paint *paint, double x, double y, tn_size s)
{
    tn_paint_rectangle(paint, x, y, s.width, s.height);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

void tn_draw_rule_dashes(tn_paint *paint, double x1, double y1, double x2, double y2)
{
    static const double dashes[] = {4, 3};
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_move_to(paint, x1, y1);
    tn_paint_line_to(paint, x2, y2);
    tn_paint_line_width(paint, 0.6);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

/* A head at (x, y) that points to the left or right. */
static void arrow_head(tn_paint *paint, double x, double y, double direction)
{
    tn_paint_move_to(paint, x, y);
    tn_paint_line_to(paint, x - direction * 5, y - 2.6);
    tn_paint_line_to(paint, x - direction * 5, y + 2.6);
    tn_paint_close_path(paint);
    tn_paint_fill(paint);
}

void tn_draw_rule_arrow(tn_paint *paint, double from, double to, double y)
{
    tn_paint_move_to(paint, from, y);
    tn_paint_line_to(paint, to, y);
    tn_paint_line_width(paint, 0.8);
    tn_paint_stroke(paint);
    arrow_head(paint, to, y, to > from ? 1 : -1);
}

void tn_draw_neighbour_sign(tn_paint *paint, double x, double y)
{
    tn_paint_rectangle(paint, x, y, 5, 7.5);
    tn_paint_rectangle(paint, x + 5, y, 5, 7.5);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

void tn_draw_symmetric_sign(tn_paint *paint, double x, double y)
{
    tn_paint_face(paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(paint, x + 2, y + 9.5, TN_ALIGN_LEFT, "or");
    tn_draw_rule_arrow(paint, x + 7, x + 15, y);
    tn_draw_rule_arrow(paint, x + 7, x - 1, y);
}

void tn_draw_plan_end(tn_paint *paint, double x, double y, double height, bool left)
{
    double wall = left ? x + TN_RULE_END_WIDTH - 2 : x + 2, out = left ? -5 : 5;
    tn_paint_move_to(paint, wall, y);
    tn_paint_line_to(paint, wall, y + height);
    tn_paint_line_width(paint, 2.2);
    tn_paint_stroke(paint);
    for (double at = y + 3; at < y + height - 1; at += 5) {
        tn_paint_move_to(paint, wall, at);
        tn_paint_line_to(paint, wall + out, at + 4);
    }
    tn_paint_line_width(paint, 0.5);
    tn_paint_stroke(paint);
}

void tn_draw_check_mark(tn_paint *paint, double x, double y)
{
    tn_paint_move_to(paint, x - 4, y + 3);
    tn_paint_line_to(paint, x - 1, y + 6.5);
    tn_paint_line_to(paint, x + 5, y - 1);
    tn_paint_line_width(paint, 1.4);
    tn_paint_stroke(paint);
}

void tn_draw_tag(tn_paint *paint, const char *name, double x, double y, tn_size s)
{
    double r = 6;
    tn_paint_new_sub_path(paint);
    tn_paint_arc(paint, x + s.width - 2 - r, y + 2 + r, r, -1.5707963, 0);
    tn_paint_arc(paint, x + s.width - 2 - r, y + s.height - 2 - r, r, 0, 1.5707963);
    tn_paint_arc(paint, x + 2 + r, y + s.height - 2 - r, r, 1.5707963, 3.1415927);
    tn_paint_arc(paint, x + 2 + r, y + 2 + r, r, 3.1415927, 4.712389);
    tn_paint_close_path(paint);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
    tn_paint_face(paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(paint, x + s.width / 2, y + s.height / 2 + 3, TN_ALIGN_CENTRE, name);
}

void tn_draw_optional(tn_paint *paint, double x, double y, tn_size s)
{
    static const double dashes[] = {2, 2};
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_rectangle(paint, x + 1, y + 1, s.width - 2, s.height - 2);
    tn_paint_line_width(paint, 0.8);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
    tn_paint_face(paint, TN_RULE_SIGN_SIZE - 1.5, false);
    tn_type_line(paint, x + s.width / 2, y + 9, TN_ALIGN_CENTRE, "or none");
}
