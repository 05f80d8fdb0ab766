/* The best and the mean score over the generations, drawn. */
#include "runtime/genome/picture/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/draw/axis.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

/* In points. */
#define WIDTH 640.0
#define HEIGHT 360.0
#define LEFT 64.0
#define RIGHT 96.0
#define TOP 58.0
#define BOTTOM 46.0
#define LABEL_APART 12.0 /* between the names of two curves */

#define TICKS_Y 6.0
#define TICKS_X 10.0
#define MEANS_SHOWN                                                                                                    \
    3.0 /* a mean above so many times its median goes out of the picture, which the best would else be flat in */

typedef struct chart {
    cairo_t *context;
    const tn_generation_stats *stats;
    size_t count;
    double low, high, step;
} chart;

static double x_of(const chart *c, size_t i)
{
    double steps = c->count > 1 ? (double)(c->count - 1) : 1;
    return LEFT + (WIDTH - LEFT - RIGHT) * (double)i / steps;
}

static double y_of(const chart *c, double value)
{
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (value - c->low) / (c->high - c->low);
}

static bool value_of(const chart *c, size_t i, bool mean, double *value)
{
    *value = mean ? c->stats[i].mean : c->stats[i].best[0];
    return c->stats[i].scored > 0 && isfinite(*value);
}

static int compare_numbers(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return *x < *y ? -1 : *x > *y;
}

static double median_mean(const chart *c, double *scratch)
{
    size_t known = 0;
    for (size_t i = 0; i < c->count; i++)
        known += value_of(c, i, true, &scratch[known]);
    qsort(scratch, known, sizeof *scratch, compare_numbers);
    return known ? scratch[known / 2] : 0;
}

static void find_range(chart *c, double *scratch)
{
    bool any = false;
    double value, most = MEANS_SHOWN * median_mean(c, scratch);
    for (size_t i = 0; i < c->count; i++)
        for (int mean = 0; mean < 2; mean++) {
            if (!value_of(c, i, mean, &value) || (mean && value > most))
                continue;
            c->low = !any || value < c->low ? value : c->low;
            c->high = !any || value > c->high ? value : c->high;
            any = true;
        }
    if (c->low >= 0 && c->low < 0.5 * c->high)
        c->low = 0; /* what is aimed at */
    if (!(c->high > c->low))
        c->high = c->low + 1;
    c->step = tn_axis_step(c->high - c->low, TICKS_Y);
    c->low = floor(c->low / c->step) * c->step;
    c->high = ceil(c->high / c->step) * c->step;
}

static void draw_axes(const chart *c)
{
    cairo_t *t = c->context;
    char text[64];
    tn_type_face(t, 9, false);
    int lines = (int)floor((c->high - c->low) / c->step + 0.5);
    for (int i = 0; i <= lines; i++) {
        double value = c->low + c->step * i, y = y_of(c, value);
        cairo_set_source_rgb(t, 0.85, 0.85, 0.85);
        cairo_set_line_width(t, 0.5);
        cairo_move_to(t, LEFT, y);
        cairo_line_to(t, WIDTH - RIGHT, y);
        cairo_stroke(t);
        cairo_set_source_rgb(t, 0.2, 0.2, 0.2);
        snprintf(text, sizeof text, "%.6g", fabs(value) < c->step / 1000 ? 0 : value);
        tn_type_line(t, LEFT - 6, y + 3, TN_ALIGN_RIGHT, text);
    }
    double apart = c->count > 1 ? fmax(1, tn_axis_step((double)(c->count - 1), TICKS_X)) : 1;
    for (double i = 0; i < (double)c->count; i += apart) {
        snprintf(text, sizeof text, "%.0f", i);
        tn_type_line(t, x_of(c, (size_t)i), HEIGHT - BOTTOM + 14, TN_ALIGN_CENTRE, text);
    }
    tn_type_line(t, (LEFT + WIDTH - RIGHT) / 2, HEIGHT - BOTTOM + 30, TN_ALIGN_CENTRE, "generation");
}

static void set_colour(cairo_t *t, bool mean)
{
    cairo_set_source_rgb(t, mean ? 0.45 : 0.75, mean ? 0.45 : 0.1, mean ? 0.45 : 0.1);
}

static void draw_curve(const chart *c, bool mean)
{
    cairo_t *t = c->context;
    bool open = false;
    cairo_save(t);
    cairo_rectangle(t, 0, TOP - 1, WIDTH, HEIGHT - TOP - BOTTOM + 2);
    cairo_clip(t);
    set_colour(t, mean);
    cairo_set_line_width(t, mean ? 1 : 1.6);
    for (size_t i = 0; i < c->count; i++) {
        double value;
        if (!value_of(c, i, mean, &value)) {
            open = false;
            continue;
        }
        double y = fmax(y_of(c, value), TOP - HEIGHT); /* what is far out stays out */
        if (open)
            cairo_line_to(t, x_of(c, i), y);
        else
            cairo_move_to(t, x_of(c, i), y);
        open = true;
    }
    if (c->count == 1 && open)
        cairo_line_to(t, x_of(c, 0) + 3, y_of(c, mean ? c->stats[0].mean : c->stats[0].best[0]));
    cairo_stroke(t);
    cairo_restore(t);
}

/* The curves' names and last values, at their ends but not on one another. */
static void draw_names(const chart *c)
{
    double value[2], y[2];
    char text[64];
    for (int mean = 0; mean < 2; mean++) {
        if (c->count == 0 || !value_of(c, c->count - 1, mean, &value[mean]))
            return;
        y[mean] = fmax(TOP, y_of(c, value[mean]));
    }
    double apart = LABEL_APART - (y[0] - y[1]); /* the best lies below the mean */
    if (apart > 0)
        y[1] -= apart;
    tn_type_face(c->context, 9, false);
    for (int mean = 0; mean < 2; mean++) {
        set_colour(c->context, mean);
        snprintf(text, sizeof text, "%s %.5g", mean ? "mean" : "best", value[mean]);
        tn_type_line(c->context, WIDTH - RIGHT + 8, y[mean] + 3, TN_ALIGN_LEFT, text);
    }
}

static void draw_title(cairo_t *t, const char *title)
{
    cairo_set_source_rgb(t, 0, 0, 0);
    tn_type_face(t, 12, true);
    tn_type_fit(t, LEFT, 24, TN_ALIGN_LEFT, WIDTH - LEFT - 20, title);
    cairo_set_source_rgb(t, 0.45, 0.45, 0.45);
    tn_type_face(t, 9, false);
    tn_type_line(t, LEFT, 38, TN_ALIGN_LEFT, "score: lower is better");
}

tn_status tn_stats_plot(const tn_generation_stats *stats, size_t count, const char *title, const char *path,
                        tn_error *error)
{
    tn_canvas_format format;
    tn_canvas *canvas = NULL;
    tn_canvas_options options = {.width = WIDTH, .height = HEIGHT, .title = title};
    double *scratch = calloc(count + 1, sizeof *scratch);
    tn_status status = scratch ? tn_canvas_format_of(path, &format, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_canvas_new(path, format, &options, &canvas, error);
    if (status == TN_OK) {
        chart c = {.context = tn_canvas_context(canvas), .stats = stats, .count = count};
        find_range(&c, scratch);
        draw_title(c.context, title);
        draw_axes(&c);
        draw_curve(&c, true);
        draw_curve(&c, false);
        draw_names(&c);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    free(scratch);
    return status;
}
