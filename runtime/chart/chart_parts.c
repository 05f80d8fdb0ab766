/* Colours, scales and marks of charts. */
#include "runtime/chart/chart_parts.h"

#include <math.h>
#include <stdio.h>

#include "runtime/draw/axis.h"
#include "runtime/draw/type.h"

#define MARK 3.0
#define APART_ACROSS 14.0 /* between two numbers at least */
#define ROOM_UP 26.0

void tn_chart_ink(tn_paint *paint, tn_chart_tone tone)
{
    tn_paint_colour(paint, tone.red, tone.green, tone.blue);
}

double tn_chart_at(const tn_chart_scale *scale, double value)
{
    return scale->from + (scale->to - scale->from) * ((value - scale->low) / (scale->high - scale->low));
}

double tn_chart_gap(const tn_chart_bar *bars, size_t count)
{
    double gap = 0;
    for (size_t i = 1; i < count; i++) {
        double one = bars[i].from - bars[i - 1].from;
        gap = one > 0 && (gap == 0 || one < gap) ? one : gap;
    }
    return gap;
}

tn_chart_scale tn_chart_scale_of(const tn_chart_bar *bars, size_t count, double from, double to)
{
    if (count == 0)
        return (tn_chart_scale){0, 1, from, to};
    double low = bars[0].from, high = bars[count - 1].to;
    double beside = bars[0].to > bars[0].from ? 0 : tn_chart_gap(bars, count) / 2;
    if (!(high > low))
        beside = low == 0 ? 0.5 : fabs(low) / 20;
    return (tn_chart_scale){low - beside, high + beside, from, to};
}

static double step_of(const tn_chart_scale *scale, double room)
{
    double marks = fabs(scale->to - scale->from) / room;
    return tn_axis_step(scale->high - scale->low, marks > 2 ? marks : 2);
}

/* The widest number needs room. */
static double room_across(tn_paint *paint, const tn_chart_scale *scale)
{
    char text[2][64];
    double step = step_of(scale, 60);
    tn_axis_write(scale->low, step, text[0], sizeof text[0]);
    tn_axis_write(scale->high, step, text[1], sizeof text[1]);
    return fmax(tn_type_width(paint, text[0]), tn_type_width(paint, text[1])) + APART_ACROSS;
}

void tn_chart_marks_across(tn_paint *paint, const tn_chart_scale *scale, double y, double grid)
{
    char text[64];
    tn_paint_face(paint, TN_CHART_TEXT, false);
    double step = step_of(scale, room_across(paint, scale));
    for (double i = ceil(scale->low / step - 1e-9); i * step <= scale->high + step * 1e-9; i++) {
        double x = tn_chart_at(scale, i * step);
        tn_chart_ink(paint, grid > 0 ? TN_CHART_LINE : TN_CHART_GREY);
        tn_paint_line_width(paint, 0.5);
        tn_paint_move_to(paint, x, grid > 0 ? y - grid : y);
        tn_paint_line_to(paint, x, grid > 0 ? y : y + MARK);
        tn_paint_stroke(paint);
        tn_chart_ink(paint, TN_CHART_BLACK);
        tn_axis_write(i * step, step, text, sizeof text);
        tn_type_line(paint, x, y + MARK + TN_CHART_TEXT + 1, TN_ALIGN_CENTRE, text);
    }
}

void tn_chart_marks_up(tn_paint *paint, const tn_chart_scale *scale, double x, double grid)
{
    char text[64];
    double step = step_of(scale, ROOM_UP);
    tn_paint_face(paint, TN_CHART_TEXT, false);
    for (double i = ceil(scale->low / step - 1e-9); i * step <= scale->high + step * 1e-9; i++) {
        double y = tn_chart_at(scale, i * step);
        tn_chart_ink(paint, grid > 0 ? TN_CHART_LINE : TN_CHART_GREY);
        tn_paint_line_width(paint, 0.5);
        tn_paint_move_to(paint, grid > 0 ? x + grid : x, y);
        tn_paint_line_to(paint, grid > 0 ? x : x - MARK, y);
        tn_paint_stroke(paint);
        tn_chart_ink(paint, TN_CHART_BLACK);
        tn_axis_write(i * step, step, text, sizeof text);
        tn_type_line(paint, x - MARK - 2, y + 3, TN_ALIGN_RIGHT, text);
    }
}

void tn_chart_axis_name(const char *name, const char *unit, char *text, size_t size)
{
    snprintf(text, size, "%.160s%s%.20s", name, *unit ? ", " : "", unit);
}
