/* Draws a histogram: the bars over the measure's axis, above them a box from quartile to quartile, below them the
 * numbers. */
#include <math.h>
#include <stdio.h>

#include "runtime/chart/chart_parts.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

#define WIDTH 640.0
#define HEIGHT 372.0
#define LEFT 58.0
#define RIGHT 22.0
#define TITLE 26.0
#define BOX_TOP 62.0 /* the box of quartiles */
#define BOX_HEIGHT 14.0
#define TOP 98.0 /* of the bars */
#define BOTTOM 292.0
#define FACTS 346.0
#define LEAST_BAR 0.7   /* what there is must be seen */
#define WIDEST_BAR 46.0 /* of single values */
#define SHARE_ROOM 30.0 /* between bars that say their share */
#define VALUE_APART 4.0

typedef struct picture {
    tn_paint *paint;
    const tn_histogram *h;
    tn_chart_scale across, up; /* up: in per cent */
} picture;

static double highest(const tn_histogram *h)
{
    double most = 0;
    for (size_t i = 0; i < h->count; i++)
        most = fmax(most, 100 * h->bars[i].share);
    return most;
}

/* How wide a bar is, and how far apart two are. */
static double bar_pitch(const picture *p)
{
    double gap = tn_chart_gap(p->h->bars, p->h->count);
    return gap > 0 ? tn_chart_at(&p->across, p->across.low + gap) - p->across.from : p->across.to - p->across.from;
}

static void bar_sides(const picture *p, const tn_chart_bar *bar, double *left, double *right)
{
    if (bar->to > bar->from) {
        *left = tn_chart_at(&p->across, bar->from);
        *right = tn_chart_at(&p->across, bar->to);
        double apart = *right - *left > 6 ? 0.5 : 0;
        *left += apart;
        *right -= apart;
        return;
    }
    double middle = tn_chart_at(&p->across, bar->from), half = fmin(WIDEST_BAR, fmax(1, bar_pitch(p) * 0.8)) / 2;
    *left = middle - half;
    *right = middle + half;
}

/* All of the plot above and below it belongs to a bar: one that is low can be clicked, too. */
static void draw_bar(const picture *p, size_t i, bool says)
{
    const tn_chart_bar *bar = &p->h->bars[i];
    double left, right, y = fmin(tn_chart_at(&p->up, 100 * bar->share), p->up.from - LEAST_BAR);
    char text[32];
    bar_sides(p, bar, &left, &right);
    tn_paint_group_begin(p->paint, TN_PAINT_BAR, i);
    tn_paint_target(p->paint, left, TOP, right - left, BOTTOM - TOP);
    tn_chart_ink(p->paint, TN_CHART_BAR);
    tn_paint_rectangle(p->paint, left, y, right - left, p->up.from - y);
    tn_paint_fill(p->paint);
    if (says) {
        tn_chart_ink(p->paint, TN_CHART_BLACK);
        snprintf(text, sizeof text, bar->share >= 0.0005 ? "%.1f %%" : "< 0.1 %%", 100 * bar->share);
        tn_type_line(p->paint, (left + right) / 2, y - 2.5, TN_ALIGN_CENTRE, text);
    }
    tn_paint_group_end(p->paint);
}

static void draw_bars(const picture *p)
{
    bool says = p->h->count > 0 && bar_pitch(p) >= SHARE_ROOM;
    tn_paint_face(p->paint, TN_CHART_SMALL, false);
    for (size_t i = 0; i < p->h->count; i++)
        if (p->h->bars[i].share > 0)
            draw_bar(p, i, says);
}

/* The line from least to most, the box that holds the middle half, its line where half of all are below, and the mean.
 */
static void draw_box(const picture *p)
{
    const tn_histogram *h = p->h;
    tn_paint *paint = p->paint;
    double middle = BOX_TOP + BOX_HEIGHT / 2, x[5];
    const double values[5] = {h->least, h->quartiles[0], h->quartiles[1], h->quartiles[2], h->most};
    for (int i = 0; i < 5; i++)
        x[i] = tn_chart_at(&p->across, values[i]);
    tn_chart_ink(paint, TN_CHART_BLACK);
    tn_paint_line_width(paint, 0.8);
    tn_paint_move_to(paint, x[0], middle);
    tn_paint_line_to(paint, x[4], middle);
    for (int end = 0; end < 5; end += 4) {
        tn_paint_move_to(paint, x[end], BOX_TOP + 3);
        tn_paint_line_to(paint, x[end], BOX_TOP + BOX_HEIGHT - 3);
    }
    tn_paint_stroke(paint);
    tn_paint_rectangle(paint, x[1], BOX_TOP, x[3] - x[1], BOX_HEIGHT);
    tn_paint_colour(paint, 0.90, 0.93, 0.88);
    tn_paint_fill_keep(paint);
    tn_chart_ink(paint, TN_CHART_BLACK);
    tn_paint_stroke(paint);
    tn_paint_line_width(paint, 2);
    tn_paint_move_to(paint, x[2], BOX_TOP);
    tn_paint_line_to(paint, x[2], BOX_TOP + BOX_HEIGHT);
    tn_paint_stroke(paint);
    double mean = tn_chart_at(&p->across, h->mean);
    tn_chart_ink(paint, TN_CHART_MARK);
    tn_paint_arc(paint, mean, middle, 3, 0, 2 * 3.14159265358979323846);
    tn_paint_fill(paint);
    tn_paint_face(paint, TN_CHART_SMALL, false);
    tn_type_line(paint, mean, BOX_TOP - 3, TN_ALIGN_CENTRE, "mean");
}

/* Where the box stands in the bars. */
static void draw_guides(const picture *p)
{
    static const double dashes[] = {2, 2};
    tn_paint *paint = p->paint;
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_line_width(paint, 0.6);
    for (int q = 0; q < 3; q++) {
        double x = tn_chart_at(&p->across, p->h->quartiles[q]);
        tn_chart_ink(paint, TN_CHART_GREY);
        tn_paint_move_to(paint, x, BOX_TOP + BOX_HEIGHT);
        tn_paint_line_to(paint, x, BOTTOM);
        tn_paint_stroke(paint);
    }
    double mean = tn_chart_at(&p->across, p->h->mean);
    tn_chart_ink(paint, TN_CHART_MARK);
    tn_paint_move_to(paint, mean, BOX_TOP + BOX_HEIGHT);
    tn_paint_line_to(paint, mean, BOTTOM);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

static void draw_axes(const picture *p)
{
    char text[256];
    tn_chart_marks_up(p->paint, &p->up, LEFT, WIDTH - LEFT - RIGHT);
    tn_chart_marks_across(p->paint, &p->across, BOTTOM, 0);
    tn_chart_ink(p->paint, TN_CHART_BLACK);
    tn_paint_line_width(p->paint, 0.8);
    tn_paint_move_to(p->paint, LEFT, BOTTOM);
    tn_paint_line_to(p->paint, WIDTH - RIGHT, BOTTOM);
    tn_paint_stroke(p->paint);
    tn_chart_axis_name(p->h->title, p->h->unit, text, sizeof text);
    tn_paint_face(p->paint, TN_CHART_TEXT, true);
    tn_type_fit(p->paint, (LEFT + WIDTH - RIGHT) / 2, BOTTOM + 28, TN_ALIGN_CENTRE, WIDTH - LEFT - RIGHT, text);
    tn_paint_face(p->paint, TN_CHART_SMALL, false);
    tn_type_line(p->paint, LEFT - 5, TOP - 9, TN_ALIGN_RIGHT, "% of all");
    tn_chart_ink(p->paint, TN_CHART_GREY);
    tn_type_line(p->paint, LEFT - 5, BOX_TOP + 10, TN_ALIGN_RIGHT, "quarters");
}

/* The numbers in a row, each under its name. */
static void draw_facts(const picture *p)
{
    double room = (WIDTH - 48) / (double)(p->h->fact_count ? p->h->fact_count : 1);
    for (size_t i = 0; i < p->h->fact_count; i++) {
        double x = 24 + room * (double)i;
        tn_chart_ink(p->paint, TN_CHART_GREY);
        tn_paint_face(p->paint, TN_CHART_SMALL, false);
        tn_type_fit(p->paint, x, FACTS, TN_ALIGN_LEFT, room - VALUE_APART, p->h->facts[i].name);
        tn_chart_ink(p->paint, TN_CHART_BLACK);
        tn_paint_face(p->paint, TN_CHART_TEXT, true);
        tn_type_fit(p->paint, x, FACTS + 12, TN_ALIGN_LEFT, room - VALUE_APART, p->h->facts[i].value);
    }
}

static void draw_titles(const picture *p)
{
    tn_chart_ink(p->paint, TN_CHART_BLACK);
    tn_paint_face(p->paint, 13, true);
    double used = fmin(tn_type_width(p->paint, p->h->title), WIDTH / 2) + 8;
    tn_type_fit(p->paint, 24, TITLE, TN_ALIGN_LEFT, WIDTH / 2, p->h->title);
    tn_paint_face(p->paint, TN_CHART_TEXT + 0.5, false);
    tn_type_fit(p->paint, 24 + used, TITLE, TN_ALIGN_LEFT, WIDTH - 48 - used, p->h->doc);
    tn_chart_ink(p->paint, TN_CHART_GREY);
    tn_paint_face(p->paint, TN_CHART_TEXT, false);
    tn_type_fit(p->paint, 24, TITLE + 15, TN_ALIGN_LEFT, WIDTH - 48, p->h->about);
}

tn_status tn_histogram_draw(const tn_histogram *h, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    tn_status status = tn_canvas_begin(to, WIDTH, HEIGHT, h->title, &canvas, error);
    if (status != TN_OK)
        return status;
    picture p = {tn_canvas_paint(canvas),
                 h,
                 tn_chart_scale_of(h->bars, h->count, LEFT, WIDTH - RIGHT),
                 {0, fmax(highest(h) * 1.06, 1e-9), BOTTOM, TOP}};
    draw_titles(&p);
    if (h->count > 0) {
        draw_axes(&p);
        draw_bars(&p);
        draw_guides(&p);
        draw_box(&p);
        draw_facts(&p);
    }
    status = tn_canvas_commit(canvas, error);
    tn_canvas_free(canvas);
    return status;
}
