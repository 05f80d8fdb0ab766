/* Draws the curves that `curves` measured: bench_plot POINTS PICTURE */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

enum { POINTS_MAX = 64, PANELS = 6, COLUMNS = 3 };

#define PANEL_WIDTH 220.0
#define PANEL_HEIGHT 180.0
#define LEFT 44.0
#define BOTTOM 34.0
#define TOP 26.0
#define RIGHT 12.0

typedef struct panel {
    const char *curve, *title, *x_name;
    double x[POINTS_MAX], y[POINTS_MAX];
    size_t count;
} panel;

static panel panels[PANELS] = {
    {.curve = "plans", .title = "ns a plan, by plans", .x_name = "plans in the array"},
    {.curve = "trays", .title = "ns a tray, by length", .x_name = "trays of a plan"},
    {.curve = "rules", .title = "ns a plan, by rules", .x_name = "rules"},
    {.curve = "states", .title = "ns a tray, by states of one rule", .x_name = "states"},
    {.curve = "threads", .title = "ns a plan, by threads", .x_name = "threads"},
    {.curve = "text", .title = "ns a plan read as text, by threads", .x_name = "threads"},
};

static int read_points(const char *path)
{
    FILE *file = fopen(path, "r");
    char curve[32];
    double x, y;
    if (!file)
        return 1;
    while (fscanf(file, "%31s %lf %lf", curve, &x, &y) == 3) {
        for (size_t p = 0; p < PANELS; p++) {
            panel *to = &panels[p];
            if (strcmp(to->curve, curve) == 0 && to->count < POINTS_MAX) {
                to->x[to->count] = log10(x);
                to->y[to->count++] = log10(y);
            }
        }
    }
    return fclose(file);
}

static void range(const double *values, size_t count, double *low, double *high)
{
    *low = *high = count ? values[0] : 0;
    for (size_t i = 1; i < count; i++) {
        *low = fmin(*low, values[i]);
        *high = fmax(*high, values[i]);
    }
    *low = floor(*low * 1.0000001);
    *high = fmax(ceil(*high - 1e-9), *low + 1);
}

typedef struct frame {
    double x, y, width, height, x_low, x_high, y_low, y_high;
} frame;

static double place_x(const frame *f, double value)
{
    return f->x + (value - f->x_low) / (f->x_high - f->x_low) * f->width;
}

static double place_y(const frame *f, double value)
{
    return f->y + f->height - (value - f->y_low) / (f->y_high - f->y_low) * f->height;
}

/* Lines at 1, 2 and 5 times the powers of ten, with the powers (and, in one decade, all) named. */
static void draw_axis(tn_paint *paint, const frame *f, bool vertical)
{
    static const double steps[] = {1, 2, 5};
    double low = vertical ? f->y_low : f->x_low, high = vertical ? f->y_high : f->x_high;
    for (double decade = low; decade <= high; decade++) {
        for (size_t s = 0; s < 3; s++) {
            double value = decade + log10(steps[s]);
            char label[32];
            if (value > high + 1e-9)
                break;
            double at = vertical ? place_y(f, value) : place_x(f, value);
            tn_paint_colour(paint, s ? 0.93 : 0.8, s ? 0.93 : 0.8, s ? 0.93 : 0.8);
            tn_paint_move_to(paint, vertical ? f->x : at, vertical ? at : f->y);
            tn_paint_line_to(paint, vertical ? f->x + f->width : at, vertical ? at : f->y + f->height);
            tn_paint_stroke(paint);
            if (s && high - low > 2)
                continue;
            tn_paint_colour(paint, 0.3, 0.3, 0.3);
            double number = steps[s] * pow(10, decade);
            if (number > 999999)
                snprintf(label, sizeof label, "%gM", number / 1e6);
            else
                snprintf(label, sizeof label, number > 999 ? "%gk" : "%g", number > 999 ? number / 1e3 : number);
            tn_type_line(paint, vertical ? f->x - 4 : at, vertical ? at + 3 : f->y + f->height + 11,
                         vertical ? TN_ALIGN_RIGHT : TN_ALIGN_CENTRE, label);
        }
    }
}

static void draw_panel(tn_paint *paint, const panel *p, double left, double top)
{
    frame f = {
        .x = left + LEFT, .y = top + TOP, .width = PANEL_WIDTH - LEFT - RIGHT, .height = PANEL_HEIGHT - TOP - BOTTOM};
    range(p->x, p->count, &f.x_low, &f.x_high);
    range(p->y, p->count, &f.y_low, &f.y_high);
    tn_paint_line_width(paint, 0.6);
    tn_paint_face(paint, 8, false);
    draw_axis(paint, &f, false);
    draw_axis(paint, &f, true);
    tn_paint_colour(paint, 0, 0, 0);
    tn_type_line(paint, f.x + f.width / 2, f.y + f.height + 23, TN_ALIGN_CENTRE, p->x_name);
    tn_paint_face(paint, 10, false);
    tn_type_line(paint, f.x + f.width / 2, f.y - 8, TN_ALIGN_CENTRE, p->title);
    tn_paint_colour(paint, 0.1, 0.35, 0.6);
    tn_paint_line_width(paint, 1.5);
    tn_paint_new_path(paint);
    for (size_t i = 0; i < p->count; i++)
        tn_paint_line_to(paint, place_x(&f, p->x[i]), place_y(&f, p->y[i]));
    tn_paint_stroke(paint);
    for (size_t i = 0; i < p->count; i++) {
        tn_paint_arc(paint, place_x(&f, p->x[i]), place_y(&f, p->y[i]), 2.2, 0, 6.2831853);
        tn_paint_fill(paint);
    }
}

int main(int argc, char **argv)
{
    tn_canvas *canvas;
    tn_canvas_format format;
    tn_error error;
    if (argc != 3 || read_points(argv[1]) != 0) {
        fputs("usage: bench_plot POINTS PICTURE\n", stderr);
        return 2;
    }
    tn_canvas_options options = {
        .width = COLUMNS * PANEL_WIDTH, .height = 2 * PANEL_HEIGHT, .title = "How matching grows"};
    tn_status status = tn_canvas_format_of(argv[2], &format, &error);
    if (status == TN_OK)
        status = tn_canvas_new(argv[2], format, &options, &canvas, &error);
    if (status == TN_OK) {
        for (size_t p = 0; p < PANELS; p++)
            draw_panel(tn_canvas_paint(canvas), &panels[p], (double)(p % COLUMNS) * PANEL_WIDTH,
                       (double)(p / COLUMNS) * PANEL_HEIGHT);
        status = tn_canvas_commit(canvas, &error);
        tn_canvas_free(canvas);
    }
    if (status != TN_OK)
        fprintf(stderr, "bench_plot: %s\n", error.message);
    return status == TN_OK ? 0 : 1;
}
