/* Draws charts: histograms, and fronts over what lies behind them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/chart/chart.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/paint.h"
#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"

#define TEXT 8.5
#define SMALL 7.5

typedef struct chart_tone {
    double red, green, blue;
} chart_tone;

#define BLACK ((chart_tone){0.13, 0.13, 0.13})
#define GREY ((chart_tone){0.40, 0.40, 0.40})
#define LINE ((chart_tone){0.86, 0.86, 0.86})
#define BAR ((chart_tone){0.48, 0.61, 0.42})
#define MARK ((chart_tone){0.70, 0.20, 0.20})

/* Numbers along a line of the picture: `low` stands at `from`, `high` at `to`. */
typedef struct chart_scale {
    double low, high, from, to;
} chart_scale;

/* ==== colours, scales and marks of charts */

#define MARK_LENGTH 3.0
#define APART_ACROSS 14.0 /* between two numbers at least */
#define ROOM_UP 26.0

static void ink(tn_paint *paint, chart_tone tone)
{
    tn_paint_colour(paint, tone.red, tone.green, tone.blue);
}

static double chart_at(const chart_scale *scale, double value)
{
    return scale->from + (scale->to - scale->from) * ((value - scale->low) / (scale->high - scale->low));
}

/* The least distance between two bars; 0 of fewer than two. */
static double chart_gap(const tn_chart_bar *bars, size_t count)
{
    double gap = 0;
    for (size_t i = 1; i < count; i++) {
        double one = bars[i].from - bars[i - 1].from;
        gap = one > 0 && (gap == 0 || one < gap) ? one : gap;
    }
    return gap;
}

/* The scale that holds all bars, with half a gap of theirs beside the first and the last. */
static chart_scale chart_scale_of(const tn_chart_bar *bars, size_t count, double from, double to)
{
    if (count == 0)
        return (chart_scale){0, 1, from, to};
    double low = bars[0].from, high = bars[count - 1].to;
    double beside = bars[0].to > bars[0].from ? 0 : chart_gap(bars, count) / 2;
    if (!(high > low))
        beside = low == 0 ? 0.5 : fabs(low) / 20;
    return (chart_scale){low - beside, high + beside, from, to};
}

static double step_of(const chart_scale *scale, double room)
{
    double marks = fabs(scale->to - scale->from) / room;
    return tn_axis_step(scale->high - scale->low, marks > 2 ? marks : 2);
}

/* The widest number needs room. */
static double room_across(tn_paint *paint, const chart_scale *scale)
{
    char text[2][64];
    double step = step_of(scale, 60);
    tn_axis_write(scale->low, step, text[0], sizeof text[0]);
    tn_axis_write(scale->high, step, text[1], sizeof text[1]);
    return fmax(tn_type_width(paint, text[0]), tn_type_width(paint, text[1])) + APART_ACROSS;
}

/* Marks and numbers of a scale below a line at y, or, `upright`, left of a line at x; `grid`: how far lines go into the
 * plot, 0 for a short mark. */
static void chart_marks_across(tn_paint *paint, const chart_scale *scale, double y, double grid)
{
    char text[64];
    tn_paint_face(paint, TEXT, false);
    double step = step_of(scale, room_across(paint, scale));
    for (double i = ceil(scale->low / step - 1e-9); i * step <= scale->high + step * 1e-9; i++) {
        double x = chart_at(scale, i * step);
        ink(paint, grid > 0 ? LINE : GREY);
        tn_paint_line_width(paint, 0.5);
        tn_paint_move_to(paint, x, grid > 0 ? y - grid : y);
        tn_paint_line_to(paint, x, grid > 0 ? y : y + MARK_LENGTH);
        tn_paint_stroke(paint);
        ink(paint, BLACK);
        tn_axis_write(i * step, step, text, sizeof text);
        tn_type_line(paint, x, y + MARK_LENGTH + TEXT + 1, TN_ALIGN_CENTRE, text);
    }
}

static void chart_marks_up(tn_paint *paint, const chart_scale *scale, double x, double grid)
{
    char text[64];
    double step = step_of(scale, ROOM_UP);
    tn_paint_face(paint, TEXT, false);
    for (double i = ceil(scale->low / step - 1e-9); i * step <= scale->high + step * 1e-9; i++) {
        double y = chart_at(scale, i * step);
        ink(paint, grid > 0 ? LINE : GREY);
        tn_paint_line_width(paint, 0.5);
        tn_paint_move_to(paint, grid > 0 ? x + grid : x, y);
        tn_paint_line_to(paint, grid > 0 ? x : x - MARK_LENGTH, y);
        tn_paint_stroke(paint);
        ink(paint, BLACK);
        tn_axis_write(i * step, step, text, sizeof text);
        tn_type_line(paint, x - MARK_LENGTH - 2, y + 3, TN_ALIGN_RIGHT, text);
    }
}

/* "cost" or "area, m2". */
static void chart_axis_name(const char *name, const char *unit, char *text, size_t size)
{
    snprintf(text, size, "%.160s%s%.20s", name, *unit ? ", " : "", unit);
}

/* ==== draws a histogram: the bars over the measure's axis, above them a box from quartile to quartile, below them the
 * numbers */

#define HISTOGRAM_WIDTH 640.0
#define HEIGHT 372.0
#define HISTOGRAM_LEFT 58.0
#define HISTOGRAM_RIGHT 22.0
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

typedef struct histogram_picture {
    tn_paint *paint;
    const tn_histogram *h;
    chart_scale across, up; /* up: in per cent */
} histogram_picture;

static double highest(const tn_histogram *h)
{
    double most = 0;
    for (size_t i = 0; i < h->count; i++)
        most = fmax(most, 100 * h->bars[i].share);
    return most;
}

/* How wide a bar is, and how far apart two are. */
static double bar_pitch(const histogram_picture *p)
{
    double gap = chart_gap(p->h->bars, p->h->count);
    return gap > 0 ? chart_at(&p->across, p->across.low + gap) - p->across.from : p->across.to - p->across.from;
}

static void bar_sides(const histogram_picture *p, const tn_chart_bar *bar, double *left, double *right)
{
    if (bar->to > bar->from) {
        *left = chart_at(&p->across, bar->from);
        *right = chart_at(&p->across, bar->to);
        double apart = *right - *left > 6 ? 0.5 : 0;
        *left += apart;
        *right -= apart;
        return;
    }
    double middle = chart_at(&p->across, bar->from), half = fmin(WIDEST_BAR, fmax(1, bar_pitch(p) * 0.8)) / 2;
    *left = middle - half;
    *right = middle + half;
}

static double bar_top(const histogram_picture *p, const tn_chart_bar *bar)
{
    return fmin(chart_at(&p->up, 100 * bar->share), p->up.from - LEAST_BAR);
}

/* All of the plot above and below it belongs to a bar: one that is low can be clicked, too. */
static void draw_bar(const histogram_picture *p, size_t i)
{
    const tn_chart_bar *bar = &p->h->bars[i];
    double left, right, y = bar_top(p, bar);
    bar_sides(p, bar, &left, &right);
    tn_paint_group_begin(p->paint, TN_PAINT_BAR, i);
    tn_paint_target(p->paint, left, TOP, right - left, BOTTOM - TOP);
    ink(p->paint, BAR);
    tn_paint_rectangle(p->paint, left, y, right - left, p->up.from - y);
    tn_paint_fill(p->paint);
    tn_paint_group_end(p->paint);
}

static void draw_bars(const histogram_picture *p)
{
    for (size_t i = 0; i < p->h->count; i++)
        if (p->h->bars[i].share > 0)
            draw_bar(p, i);
}

/* What share a bar is, above it: over the lines through the bars. */
static void say_share(const histogram_picture *p, const tn_chart_bar *bar)
{
    double left, right, y = bar_top(p, bar) - 2.5;
    char text[32];
    bar_sides(p, bar, &left, &right);
    snprintf(text, sizeof text, bar->share >= 0.0005 ? "%.1f %%" : "< 0.1 %%", 100 * bar->share);
    double width = tn_type_width(p->paint, text) + 2;
    tn_type_veil(p->paint, (left + right - width) / 2, y - SMALL * 0.8, width, SMALL, 1);
    ink(p->paint, BLACK);
    tn_type_line(p->paint, (left + right) / 2, y, TN_ALIGN_CENTRE, text);
}

static void say_shares(const histogram_picture *p)
{
    tn_paint_face(p->paint, SMALL, false);
    for (size_t i = 0; p->h->count > 0 && bar_pitch(p) >= SHARE_ROOM && i < p->h->count; i++)
        if (p->h->bars[i].share > 0)
            say_share(p, &p->h->bars[i]);
}

/* The line from least to most, the box that holds the middle half, its line where half of all are below, and the mean.
 */
static void draw_box(const histogram_picture *p)
{
    const tn_histogram *h = p->h;
    tn_paint *paint = p->paint;
    double middle = BOX_TOP + BOX_HEIGHT / 2, x[5];
    const double values[5] = {h->least, h->quartiles[0], h->quartiles[1], h->quartiles[2], h->most};
    for (int i = 0; i < 5; i++)
        x[i] = chart_at(&p->across, values[i]);
    ink(paint, BLACK);
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
    ink(paint, BLACK);
    tn_paint_stroke(paint);
    tn_paint_line_width(paint, 2);
    tn_paint_move_to(paint, x[2], BOX_TOP);
    tn_paint_line_to(paint, x[2], BOX_TOP + BOX_HEIGHT);
    tn_paint_stroke(paint);
    double mean = chart_at(&p->across, h->mean);
    ink(paint, MARK);
    tn_paint_arc(paint, mean, middle, 3, 0, 2 * 3.14159265358979323846);
    tn_paint_fill(paint);
    tn_paint_face(paint, SMALL, false);
    tn_type_line(paint, mean, BOX_TOP - 3, TN_ALIGN_CENTRE, "mean");
}

/* Where the box stands in the bars. */
static void draw_guides(const histogram_picture *p)
{
    static const double dashes[] = {2, 2};
    tn_paint *paint = p->paint;
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_line_width(paint, 0.6);
    for (int q = 0; q < 3; q++) {
        double x = chart_at(&p->across, p->h->quartiles[q]);
        ink(paint, GREY);
        tn_paint_move_to(paint, x, BOX_TOP + BOX_HEIGHT);
        tn_paint_line_to(paint, x, BOTTOM);
        tn_paint_stroke(paint);
    }
    double mean = chart_at(&p->across, p->h->mean);
    ink(paint, MARK);
    tn_paint_move_to(paint, mean, BOX_TOP + BOX_HEIGHT);
    tn_paint_line_to(paint, mean, BOTTOM);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

static void draw_bar_axes(const histogram_picture *p)
{
    char text[256];
    chart_marks_up(p->paint, &p->up, HISTOGRAM_LEFT, HISTOGRAM_WIDTH - HISTOGRAM_LEFT - HISTOGRAM_RIGHT);
    chart_marks_across(p->paint, &p->across, BOTTOM, 0);
    ink(p->paint, BLACK);
    tn_paint_line_width(p->paint, 0.8);
    tn_paint_move_to(p->paint, HISTOGRAM_LEFT, BOTTOM);
    tn_paint_line_to(p->paint, HISTOGRAM_WIDTH - HISTOGRAM_RIGHT, BOTTOM);
    tn_paint_stroke(p->paint);
    chart_axis_name(p->h->title, p->h->unit, text, sizeof text);
    tn_paint_face(p->paint, TEXT, true);
    tn_type_fit(p->paint, (HISTOGRAM_LEFT + HISTOGRAM_WIDTH - HISTOGRAM_RIGHT) / 2, BOTTOM + 28, TN_ALIGN_CENTRE,
                HISTOGRAM_WIDTH - HISTOGRAM_LEFT - HISTOGRAM_RIGHT, text);
    tn_paint_face(p->paint, SMALL, false);
    tn_type_line(p->paint, HISTOGRAM_LEFT - 5, TOP - 9, TN_ALIGN_RIGHT, "% of all");
    ink(p->paint, GREY);
    tn_type_line(p->paint, HISTOGRAM_LEFT - 5, BOX_TOP + 10, TN_ALIGN_RIGHT, "quarters");
}

/* The numbers in a row, each under its name. */
static void draw_facts(const histogram_picture *p)
{
    double room = (HISTOGRAM_WIDTH - 48) / (double)(p->h->fact_count ? p->h->fact_count : 1);
    for (size_t i = 0; i < p->h->fact_count; i++) {
        double x = 24 + room * (double)i;
        ink(p->paint, GREY);
        tn_paint_face(p->paint, SMALL, false);
        tn_type_fit(p->paint, x, FACTS, TN_ALIGN_LEFT, room - VALUE_APART, p->h->facts[i].name);
        ink(p->paint, BLACK);
        tn_paint_face(p->paint, TEXT, true);
        tn_type_fit(p->paint, x, FACTS + 12, TN_ALIGN_LEFT, room - VALUE_APART, p->h->facts[i].value);
    }
}

static void draw_histogram_titles(const histogram_picture *p)
{
    ink(p->paint, BLACK);
    tn_paint_face(p->paint, 13, true);
    double used = fmin(tn_type_width(p->paint, p->h->title), HISTOGRAM_WIDTH / 2) + 8;
    tn_type_fit(p->paint, 24, TITLE, TN_ALIGN_LEFT, HISTOGRAM_WIDTH / 2, p->h->title);
    tn_paint_face(p->paint, TEXT + 0.5, false);
    tn_type_fit(p->paint, 24 + used, TITLE, TN_ALIGN_LEFT, HISTOGRAM_WIDTH - 48 - used, p->h->doc);
    ink(p->paint, GREY);
    tn_paint_face(p->paint, TEXT, false);
    tn_type_fit(p->paint, 24, TITLE + 15, TN_ALIGN_LEFT, HISTOGRAM_WIDTH - 48, p->h->about);
}

tn_status tn_histogram_draw(const tn_histogram *h, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    tn_status status = tn_canvas_begin(to, HISTOGRAM_WIDTH, HEIGHT, h->title, &canvas, error);
    if (status != TN_OK)
        return status;
    histogram_picture p = {tn_canvas_paint(canvas),
                           h,
                           chart_scale_of(h->bars, h->count, HISTOGRAM_LEFT, HISTOGRAM_WIDTH - HISTOGRAM_RIGHT),
                           {0, fmax(highest(h) * 1.06, 1e-9), BOTTOM, TOP}};
    draw_histogram_titles(&p);
    if (h->count > 0) {
        draw_bar_axes(&p);
        draw_bars(&p);
        draw_guides(&p);
        say_shares(&p);
        draw_box(&p);
        draw_facts(&p);
    }
    status = tn_canvas_commit(canvas, error);
    tn_canvas_free(canvas);
    return status;
}

/* ==== draws fronts: for two measures the points that nothing betters in both, over how all are spread; for three, each
 * two of them; and a table of the points */

#define WIDTH 680.0
#define LEFT 74.0
#define RIGHT 90.0 /* with the bars of the measure that goes up */
#define TITLES 52.0
#define BARS 40.0 /* how far the bars beside the plot reach */
#define BARS_APART 6.0
#define PLOT_HEIGHT 300.0
#define PANEL_HEIGHT (BARS + BARS_APART + PLOT_HEIGHT + 44.0)
#define TABLE_GAP 20.0
#define ROW 12.0
#define DOT 3.0
#define NEAR 4.5   /* from a point what still belongs to it */
#define CELLS 64.0 /* along the plot at most */
#define NUMBER_APART 15.0

/* Values along an axis are gathered in cells of one width, each around a multiple of it from the least value. */
typedef struct cells {
    double low, width;
    size_t count;
} cells;

typedef struct picture {
    tn_paint *paint;
    const tn_front_panel *panel;
    chart_scale across, up;
    cells columns, rows;
    double top; /* of the plot */
} picture;

/* As wide as the least gap between values, or a whole number of such, so that no cell has more of them by chance. */
static cells cells_of(const tn_chart_axis *axis)
{
    if (axis->count == 0)
        return (cells){0, 1, 1};
    double low = axis->bars[0].from, range = axis->bars[axis->count - 1].from - low,
           gap = chart_gap(axis->bars, axis->count);
    if (!(gap > 0))
        return (cells){low, fmax(1, fabs(low) / 10), 1};
    double width = range / gap <= CELLS ? gap : gap * ceil(range / gap / CELLS);
    return (cells){low, width, (size_t)floor(range / width + 0.5) + 1};
}

static size_t cell_of(const cells *c, double value)
{
    double at = floor((value - c->low) / c->width + 0.5);
    return at < 0 ? 0 : at >= (double)c->count ? c->count - 1 : (size_t)at;
}

static chart_scale scale_of(const cells *c, double from, double to)
{
    return (chart_scale){c->low - c->width / 2, c->low + c->width * ((double)c->count - 0.5), from, to};
}

/* The sample as cells: the darker, the more of it. */
static bool draw_cloud(const picture *p)
{
    size_t count = p->columns.count * p->rows.count;
    uint32_t *hits = calloc(count + 1, sizeof *hits), most = 0;
    if (!hits)
        return false;
    for (size_t i = 0; i < p->panel->cloud_count; i++) {
        size_t at =
            cell_of(&p->rows, p->panel->cloud[i].y) * p->columns.count + cell_of(&p->columns, p->panel->cloud[i].x);
        most = ++hits[at] > most ? hits[at] : most;
    }
    double wide = (p->across.to - p->across.from) / (double)p->columns.count,
           high = (p->up.from - p->up.to) / (double)p->rows.count;
    for (size_t at = 0; at < count; at++) {
        if (hits[at] == 0)
            continue;
        double strength = 0.12 + 0.88 * sqrt((double)hits[at] / most);
        size_t column = at % p->columns.count, row = at / p->columns.count;
        tn_paint_colour(p->paint, 1 - 0.52 * strength, 1 - 0.39 * strength, 1 - 0.58 * strength);
        tn_paint_rectangle(p->paint, p->across.from + wide * (double)column, p->up.from - high * (double)(row + 1),
                           wide, high);
        tn_paint_fill(p->paint);
    }
    free(hits);
    return true;
}

/* The whole distribution of one measure, in the cells. */
static bool draw_side(const picture *p, const tn_chart_axis *axis, const cells *c, bool upright)
{
    double *shares = calloc(c->count + 1, sizeof *shares), most = 0;
    if (!shares)
        return false;
    for (size_t i = 0; i < axis->count; i++) {
        double *share = &shares[cell_of(c, axis->bars[i].from)];
        *share += axis->bars[i].share;
        most = fmax(most, *share);
    }
    const chart_scale *scale = upright ? &p->up : &p->across;
    double size = fabs(scale->to - scale->from) / (double)c->count, apart = size > 5 ? size * 0.1 : 0;
    ink(p->paint, BAR);
    for (size_t i = 0; i < c->count; i++) {
        double reach = BARS * shares[i] / (most > 0 ? most : 1);
        if (!(shares[i] > 0))
            continue;
        reach = fmax(reach, 0.7);
        if (upright)
            tn_paint_rectangle(p->paint, WIDTH - RIGHT + BARS_APART, p->up.from - size * (double)(i + 1) + apart, reach,
                               size - 2 * apart);
        else
            tn_paint_rectangle(p->paint, p->across.from + size * (double)i + apart, p->top - BARS_APART - reach,
                               size - 2 * apart, reach);
        tn_paint_fill(p->paint);
    }
    free(shares);
    return true;
}

static void place(const picture *p, size_t i, double *x, double *y)
{
    *x = chart_at(&p->across, p->panel->front[i].x);
    *y = chart_at(&p->up, p->panel->front[i].y);
}

/* Steps from point to point, each as good as the worse of two in either measure: beyond them there is nothing. */
static void draw_stairs(const picture *p)
{
    double x, y, next_x, next_y;
    bool level_first = p->panel->across.most; /* towards the worse of x first */
    tn_paint_line_width(p->paint, 1);
    ink(p->paint, MARK);
    for (size_t i = 0; i < p->panel->front_count; i++) {
        place(p, i, &next_x, &next_y);
        if (i == 0)
            tn_paint_move_to(p->paint, next_x, next_y);
        else if ((next_x > x) == level_first)
            tn_paint_line_to(p->paint, x, next_y);
        else
            tn_paint_line_to(p->paint, next_x, y);
        tn_paint_line_to(p->paint, next_x, next_y);
        x = next_x;
        y = next_y;
    }
    tn_paint_stroke(p->paint);
}

/* A number stands on the side of its point where nothing lies, unless that is outside the plot. */
static void draw_number(const picture *p, size_t i, double x, double y)
{
    char number[24];
    snprintf(number, sizeof number, "%zu", i + 1);
    double width = tn_type_width(p->paint, number) + DOT + 2;
    bool right = p->panel->across.most, below = !p->panel->up.most;
    if (right ? x + width > p->across.to : x - width < p->across.from)
        right = !right;
    double baseline = below ? y + DOT + 6 : y - DOT;
    if (baseline < p->top + 7 || baseline > p->top + PLOT_HEIGHT - 2)
        baseline = y + 3;
    ink(p->paint, BLACK);
    tn_type_line(p->paint, right ? x + DOT + 2 : x - DOT - 2, baseline, right ? TN_ALIGN_LEFT : TN_ALIGN_RIGHT, number);
}

/* The points, with their numbers where there is room from the number before. */
static void draw_points(const picture *p)
{
    double x, y, last_x = -1e9, last_y = -1e9;
    tn_paint_face(p->paint, SMALL, true);
    for (size_t i = 0; i < p->panel->front_count; i++) {
        place(p, i, &x, &y);
        bool numbered = fabs(x - last_x) >= NUMBER_APART || fabs(y - last_y) >= NUMBER_APART;
        tn_paint_group_begin(p->paint, TN_PAINT_POINT, i);
        tn_paint_target(p->paint, x - NEAR, y - NEAR, 2 * NEAR, 2 * NEAR);
        ink(p->paint, MARK);
        tn_paint_arc(p->paint, x, y, DOT, 0, 2 * 3.14159265358979323846);
        tn_paint_fill(p->paint);
        if (numbered) {
            draw_number(p, i, x, y);
            last_x = x;
            last_y = y;
        }
        tn_paint_group_end(p->paint);
    }
}

static void draw_axes(const picture *p)
{
    char text[256], name[220];
    tn_paint *paint = p->paint;
    ink(paint, GREY);
    tn_paint_line_width(paint, 0.6);
    tn_paint_rectangle(paint, LEFT, p->top, WIDTH - LEFT - RIGHT, PLOT_HEIGHT);
    tn_paint_stroke(paint);
    chart_marks_across(paint, &p->across, p->top + PLOT_HEIGHT, 0);
    chart_marks_up(paint, &p->up, LEFT, 0);
    tn_paint_face(paint, TEXT, true);
    chart_axis_name(p->panel->across.name, p->panel->across.unit, name, sizeof name);
    snprintf(text, sizeof text,
             p->panel->across.most ? "%s  (more is better \xE2\x86\x92)" : "(\xE2\x86\x90 less is better)  %s", name);
    tn_type_fit(paint, (LEFT + WIDTH - RIGHT) / 2, p->top + PLOT_HEIGHT + 28, TN_ALIGN_CENTRE, WIDTH - LEFT - RIGHT,
                text);
    chart_axis_name(p->panel->up.name, p->panel->up.unit, name, sizeof name);
    snprintf(text, sizeof text,
             p->panel->up.most ? "%s  (more is better \xE2\x86\x92)" : "(\xE2\x86\x90 less is better)  %s", name);
    tn_paint_save(paint);
    tn_paint_translate(paint, 20, p->top + PLOT_HEIGHT / 2);
    tn_paint_rotate(paint, -3.14159265358979323846 / 2);
    tn_type_fit(paint, 0, 0, TN_ALIGN_CENTRE, PLOT_HEIGHT, text);
    tn_paint_restore(paint);
}

static bool draw_panel(tn_paint *paint, const tn_front_panel *panel, double top)
{
    picture p = {.paint = paint, .panel = panel, .top = top + BARS + BARS_APART};
    p.columns = cells_of(&panel->across);
    p.rows = cells_of(&panel->up);
    p.across = scale_of(&p.columns, LEFT, WIDTH - RIGHT);
    p.up = scale_of(&p.rows, p.top + PLOT_HEIGHT, p.top);
    if (!draw_cloud(&p) || !draw_side(&p, &panel->across, &p.columns, false) ||
        !draw_side(&p, &panel->up, &p.rows, true))
        return false;
    draw_axes(&p);
    if (panel->stairs)
        draw_stairs(&p);
    draw_points(&p);
    return true;
}

/* ---- the table */

static size_t rows_shown(const tn_front_drawing *d)
{
    return d->rows < TN_CHART_ROWS_SHOWN ? d->rows : TN_CHART_ROWS_SHOWN;
}

static double column_width(tn_paint *paint, const tn_front_drawing *d, size_t column)
{
    tn_paint_face(paint, TEXT, true);
    double width = tn_type_width(paint, d->headings[column]);
    tn_paint_face(paint, TEXT, false);
    for (size_t r = 0; r < rows_shown(d); r++)
        width = fmax(width, tn_type_width(paint, d->cells[r * d->columns + column]));
    return width;
}

/* All columns but the last are of numbers and stand to the right. */
static void draw_column(tn_paint *paint, const tn_front_drawing *d, size_t column, double *x, double top)
{
    bool last = column + 1 == d->columns;
    double width = last ? WIDTH - 24 - *x : column_width(paint, d, column), at = last ? *x : *x + width;
    tn_align align = last ? TN_ALIGN_LEFT : TN_ALIGN_RIGHT;
    tn_paint_face(paint, TEXT, true);
    tn_type_fit(paint, at, top, align, width, d->headings[column]);
    tn_paint_face(paint, TEXT, false);
    for (size_t r = 0; r < rows_shown(d); r++)
        tn_type_fit(paint, at, top + ROW * (double)(r + 1), align, width, d->cells[r * d->columns + column]);
    *x += width + 16;
}

static void draw_table(tn_paint *paint, const tn_front_drawing *d, double top)
{
    char number[64];
    double x = 24 + 22 + 14;
    ink(paint, BLACK);
    tn_paint_face(paint, TEXT, true);
    for (size_t r = 0; r < rows_shown(d); r++) {
        snprintf(number, sizeof number, "%zu", r + 1);
        tn_type_line(paint, 24 + 22, top + ROW * (double)(r + 1), TN_ALIGN_RIGHT, number);
    }
    for (size_t column = 0; column < d->columns; column++)
        draw_column(paint, d, column, &x, top);
    if (rows_shown(d) == d->rows)
        return;
    snprintf(number, sizeof number, "and %zu more points", d->rows - rows_shown(d));
    ink(paint, GREY);
    tn_paint_face(paint, TEXT, false);
    tn_type_line(paint, 24 + 36, top + ROW * (double)(rows_shown(d) + 1), TN_ALIGN_LEFT, number);
}

static void draw_titles(tn_paint *paint, const tn_front_drawing *d)
{
    ink(paint, BLACK);
    tn_paint_face(paint, 13, true);
    tn_type_fit(paint, 24, 26, TN_ALIGN_LEFT, WIDTH - 48, d->title);
    ink(paint, GREY);
    tn_paint_face(paint, TEXT, false);
    tn_type_fit(paint, 24, 41, TN_ALIGN_LEFT, WIDTH - 48, d->about);
}

tn_status tn_front_draw(const tn_front_drawing *d, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    double table = TITLES + PANEL_HEIGHT * (double)d->panel_count + TABLE_GAP;
    double height = table + ROW * (double)(rows_shown(d) + (rows_shown(d) < d->rows) + 1) + 22;
    tn_status status = tn_canvas_begin(to, WIDTH, height, d->title, &canvas, error);
    if (status != TN_OK)
        return status;
    tn_paint *paint = tn_canvas_paint(canvas);
    draw_titles(paint, d);
    bool ok = true;
    for (size_t i = 0; ok && i < d->panel_count; i++)
        ok = draw_panel(paint, &d->panels[i], TITLES + PANEL_HEIGHT * (double)i);
    ink(paint, GREY);
    tn_paint_face(paint, SMALL, false);
    tn_type_fit(paint, 24, table - 10, TN_ALIGN_LEFT, WIDTH - 48, d->note);
    draw_table(paint, d, table + 8);
    status = ok ? tn_canvas_commit(canvas, error) : tn_fail_memory(error);
    tn_canvas_free(canvas);
    return status;
}
