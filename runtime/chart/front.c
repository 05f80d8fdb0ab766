/* Draws fronts: for two measures the points that nothing betters in both, over how all are spread; for three, each two
 * of them; and a table of the points. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/chart/chart_parts.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

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
    tn_chart_scale across, up;
    cells columns, rows;
    double top; /* of the plot */
} picture;

/* As wide as the least gap between values, or a whole number of such, so that no cell has more of them by chance. */
static cells cells_of(const tn_chart_axis *axis)
{
    if (axis->count == 0)
        return (cells){0, 1, 1};
    double low = axis->bars[0].from, range = axis->bars[axis->count - 1].from - low,
           gap = tn_chart_gap(axis->bars, axis->count);
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

static tn_chart_scale scale_of(const cells *c, double from, double to)
{
    return (tn_chart_scale){c->low - c->width / 2, c->low + c->width * ((double)c->count - 0.5), from, to};
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
    const tn_chart_scale *scale = upright ? &p->up : &p->across;
    double size = fabs(scale->to - scale->from) / (double)c->count, apart = size > 5 ? size * 0.1 : 0;
    tn_chart_ink(p->paint, TN_CHART_BAR);
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
    *x = tn_chart_at(&p->across, p->panel->front[i].x);
    *y = tn_chart_at(&p->up, p->panel->front[i].y);
}

/* Steps from point to point, each as good as the worse of two in either measure: beyond them there is nothing. */
static void draw_stairs(const picture *p)
{
    double x, y, next_x, next_y;
    bool level_first = p->panel->across.most; /* towards the worse of x first */
    tn_paint_line_width(p->paint, 1);
    tn_chart_ink(p->paint, TN_CHART_MARK);
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
    tn_chart_ink(p->paint, TN_CHART_BLACK);
    tn_type_line(p->paint, right ? x + DOT + 2 : x - DOT - 2, baseline, right ? TN_ALIGN_LEFT : TN_ALIGN_RIGHT, number);
}

/* The points, with their numbers where there is room from the number before. */
static void draw_points(const picture *p)
{
    double x, y, last_x = -1e9, last_y = -1e9;
    tn_paint_face(p->paint, TN_CHART_SMALL, true);
    for (size_t i = 0; i < p->panel->front_count; i++) {
        place(p, i, &x, &y);
        bool numbered = fabs(x - last_x) >= NUMBER_APART || fabs(y - last_y) >= NUMBER_APART;
        tn_paint_group_begin(p->paint, TN_PAINT_POINT, i);
        tn_paint_target(p->paint, x - NEAR, y - NEAR, 2 * NEAR, 2 * NEAR);
        tn_chart_ink(p->paint, TN_CHART_MARK);
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
    tn_chart_ink(paint, TN_CHART_GREY);
    tn_paint_line_width(paint, 0.6);
    tn_paint_rectangle(paint, LEFT, p->top, WIDTH - LEFT - RIGHT, PLOT_HEIGHT);
    tn_paint_stroke(paint);
    tn_chart_marks_across(paint, &p->across, p->top + PLOT_HEIGHT, 0);
    tn_chart_marks_up(paint, &p->up, LEFT, 0);
    tn_paint_face(paint, TN_CHART_TEXT, true);
    tn_chart_axis_name(p->panel->across.name, p->panel->across.unit, name, sizeof name);
    snprintf(text, sizeof text,
             p->panel->across.most ? "%s  (more is better \xE2\x86\x92)" : "(\xE2\x86\x90 less is better)  %s", name);
    tn_type_fit(paint, (LEFT + WIDTH - RIGHT) / 2, p->top + PLOT_HEIGHT + 28, TN_ALIGN_CENTRE, WIDTH - LEFT - RIGHT,
                text);
    tn_chart_axis_name(p->panel->up.name, p->panel->up.unit, name, sizeof name);
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
    tn_paint_face(paint, TN_CHART_TEXT, true);
    double width = tn_type_width(paint, d->headings[column]);
    tn_paint_face(paint, TN_CHART_TEXT, false);
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
    tn_paint_face(paint, TN_CHART_TEXT, true);
    tn_type_fit(paint, at, top, align, width, d->headings[column]);
    tn_paint_face(paint, TN_CHART_TEXT, false);
    for (size_t r = 0; r < rows_shown(d); r++)
        tn_type_fit(paint, at, top + ROW * (double)(r + 1), align, width, d->cells[r * d->columns + column]);
    *x += width + 16;
}

static void draw_table(tn_paint *paint, const tn_front_drawing *d, double top)
{
    char number[64];
    double x = 24 + 22 + 14;
    tn_chart_ink(paint, TN_CHART_BLACK);
    tn_paint_face(paint, TN_CHART_TEXT, true);
    for (size_t r = 0; r < rows_shown(d); r++) {
        snprintf(number, sizeof number, "%zu", r + 1);
        tn_type_line(paint, 24 + 22, top + ROW * (double)(r + 1), TN_ALIGN_RIGHT, number);
    }
    for (size_t column = 0; column < d->columns; column++)
        draw_column(paint, d, column, &x, top);
    if (rows_shown(d) == d->rows)
        return;
    snprintf(number, sizeof number, "and %zu more points", d->rows - rows_shown(d));
    tn_chart_ink(paint, TN_CHART_GREY);
    tn_paint_face(paint, TN_CHART_TEXT, false);
    tn_type_line(paint, 24 + 36, top + ROW * (double)(rows_shown(d) + 1), TN_ALIGN_LEFT, number);
}

static void draw_titles(tn_paint *paint, const tn_front_drawing *d)
{
    tn_chart_ink(paint, TN_CHART_BLACK);
    tn_paint_face(paint, 13, true);
    tn_type_fit(paint, 24, 26, TN_ALIGN_LEFT, WIDTH - 48, d->title);
    tn_chart_ink(paint, TN_CHART_GREY);
    tn_paint_face(paint, TN_CHART_TEXT, false);
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
    tn_chart_ink(paint, TN_CHART_GREY);
    tn_paint_face(paint, TN_CHART_SMALL, false);
    tn_type_fit(paint, 24, table - 10, TN_ALIGN_LEFT, WIDTH - 48, d->note);
    draw_table(paint, d, table + 8);
    status = ok ? tn_canvas_commit(canvas, error) : tn_fail_memory(error);
    tn_canvas_free(canvas);
    return status;
}
