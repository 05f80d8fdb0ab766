/* What the charts share: their colours, and an axis with its marks along an edge of the plot. */
#ifndef TARTAN_CHART_CHART_PARTS_H
#define TARTAN_CHART_CHART_PARTS_H

#include "runtime/chart/chart.h"
#include "runtime/draw/paint.h"

#define TN_CHART_TEXT 8.5
#define TN_CHART_SMALL 7.5

typedef struct tn_chart_tone {
    double red, green, blue;
} tn_chart_tone;

#define TN_CHART_BLACK ((tn_chart_tone){0.13, 0.13, 0.13})
#define TN_CHART_GREY ((tn_chart_tone){0.40, 0.40, 0.40})
#define TN_CHART_LINE ((tn_chart_tone){0.86, 0.86, 0.86})
#define TN_CHART_BAR ((tn_chart_tone){0.48, 0.61, 0.42})
#define TN_CHART_MARK ((tn_chart_tone){0.70, 0.20, 0.20})

void tn_chart_ink(tn_paint *paint, tn_chart_tone tone);

/* Numbers along a line of the picture: `low` stands at `from`, `high` at `to`. */
typedef struct tn_chart_scale {
    double low, high, from, to;
} tn_chart_scale;

double tn_chart_at(const tn_chart_scale *scale, double value);

/* The scale that holds all bars, with half a gap of theirs beside the first and the last. */
tn_chart_scale tn_chart_scale_of(const tn_chart_bar *bars, size_t count, double from, double to);

/* The least distance between two bars; 0 of fewer than two. */
double tn_chart_gap(const tn_chart_bar *bars, size_t count);

/* Marks and numbers of a scale below a line at y, or, `upright`, left of a line at x; `grid`: how far lines go into the
 * plot, 0 for a short mark. */
void tn_chart_marks_across(tn_paint *paint, const tn_chart_scale *scale, double y, double grid);
void tn_chart_marks_up(tn_paint *paint, const tn_chart_scale *scale, double x, double grid);

/* "cost" or "area, m2". */
void tn_chart_axis_name(const char *name, const char *unit, char *text, size_t size);

#endif
