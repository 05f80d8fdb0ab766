/* The best score, the median and the quartiles over the generations, drawn. */
#include "runtime/genome/picture/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/math/elementary.h"

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
#define TIMES_SHOWN                                                                                                    \
    3.0 /* a score above so many times the median of the medians goes out of the picture, where the best would         \
          else be a flat line */
#define DECADES_FROM 100.0 /* from this range on, the axis has powers of ten */

typedef struct chart {
    tn_paint *paint;
    const tn_generation_stats *stats;
    size_t count;
    double low, high, step; /* with powers of ten: their exponents */
    bool decades;
} chart;

static double decimal_logarithm(double value)
{
    return tn_log(value) / tn_log(10);
}

/* What is drawn of a generation. */
typedef enum figure { BEST, MEDIAN, LOWER, UPPER } figure;

static double x_of(const chart *c, size_t i)
{
    double steps = c->count > 1 ? (double)(c->count - 1) : 1;
    return LEFT + (WIDTH - LEFT - RIGHT) * (double)i / steps;
}

/* Out of the picture at most by its height. */
static double y_of(const chart *c, double value)
{
    double at = c->decades ? decimal_logarithm(fmax(value, 1e-300)) : value;
    double y = HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (at - c->low) / (c->high - c->low);
    return fmin(fmax(y, TOP - HEIGHT), 2 * HEIGHT);
}

static bool value_of(const chart *c, size_t i, figure which, double *value)
{
    static const size_t quartile[] = {[MEDIAN] = 1, [LOWER] = 0, [UPPER] = 2};
    *value = which == BEST ? c->stats[i].best[0] : c->stats[i].quartiles[quartile[which]];
    return c->stats[i].scored > 0 && (isfinite(*value) || which == UPPER) && *value == *value;
}

static int compare_numbers(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return *x < *y ? -1 : *x > *y;
}

static double median_of_medians(const chart *c, double *scratch)
{
    size_t known = 0;
    for (size_t i = 0; i < c->count; i++)
        known += value_of(c, i, MEDIAN, &scratch[known]);
    qsort(scratch, known, sizeof *scratch, compare_numbers);
    return known ? scratch[known / 2] : HUGE_VAL;
}

/* The range of the best and the medians; above `most`, medians do not count. */
static void widen(chart *c, double most)
{
    bool any = false;
    double value;
    for (size_t i = 0; i < c->count; i++)
        for (figure which = BEST; which <= MEDIAN; which++) {
            if (!value_of(c, i, which, &value) || (which == MEDIAN && value > most))
                continue;
            c->low = !any || value < c->low ? value : c->low;
            c->high = !any || value > c->high ? value : c->high;
            any = true;
        }
}

static void find_range(chart *c, double *scratch)
{
    widen(c, HUGE_VAL);
    c->decades = c->low > 0 && c->high > DECADES_FROM * c->low;
    if (c->decades) {
        c->low = floor(decimal_logarithm(c->low) + 1e-9); /* a power of ten itself may come out a little lower */
        c->high = ceil(decimal_logarithm(c->high) - 1e-9);
        c->step = fmax(1, tn_axis_step(c->high - c->low, TICKS_Y));
        c->high = c->low + c->step * ceil((c->high - c->low) / c->step);
        return;
    }
    widen(c, TIMES_SHOWN * median_of_medians(c, scratch));
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
    tn_paint *paint = c->paint;
    char text[64];
    tn_paint_face(paint, 9, false);
    int lines = (int)floor((c->high - c->low) / c->step + 0.5);
    for (int i = 0; i <= lines; i++) {
        double at = c->low + c->step * i, value = c->decades ? tn_pow(10, at) : at, y = y_of(c, value);
        tn_paint_colour(paint, 0.85, 0.85, 0.85);
        tn_paint_line_width(paint, 0.5);
        tn_paint_move_to(paint, LEFT, y);
        tn_paint_line_to(paint, WIDTH - RIGHT, y);
        tn_paint_stroke(paint);
        tn_paint_colour(paint, 0.2, 0.2, 0.2);
        snprintf(text, sizeof text, "%.6g", !c->decades && fabs(value) < c->step / 1000 ? 0 : value);
        tn_type_line(paint, LEFT - 6, y + 3, TN_ALIGN_RIGHT, text);
    }
    double apart = c->count > 1 ? fmax(1, tn_axis_step((double)(c->count - 1), TICKS_X)) : 1;
    for (double i = 0; i < (double)c->count; i += apart) {
        snprintf(text, sizeof text, "%.0f", i);
        tn_type_line(paint, x_of(c, (size_t)i), HEIGHT - BOTTOM + 14, TN_ALIGN_CENTRE, text);
    }
    tn_type_line(paint, (LEFT + WIDTH - RIGHT) / 2, HEIGHT - BOTTOM + 30, TN_ALIGN_CENTRE, "generation");
}

static void set_colour(tn_paint *paint, figure which)
{
    bool best = which == BEST;
    tn_paint_colour(paint, best ? 0.75 : 0.45, best ? 0.1 : 0.45, best ? 0.1 : 0.45);
}

static void clip_to_axes(tn_paint *paint)
{
    tn_paint_save(paint);
    tn_paint_rectangle(paint, 0, TOP - 1, WIDTH, HEIGHT - TOP - BOTTOM + 2);
    tn_paint_clip(paint);
}

/* Between the quartiles, from a generation to the next. */
static void draw_band(const chart *c)
{
    tn_paint *paint = c->paint;
    clip_to_axes(paint);
    tn_paint_colour(paint, 0.9, 0.9, 0.9);
    for (size_t i = 0; i + 1 < c->count; i++) {
        double low[2], high[2];
        if (!value_of(c, i, LOWER, &low[0]) || !value_of(c, i + 1, LOWER, &low[1]) ||
            !value_of(c, i, UPPER, &high[0]) || !value_of(c, i + 1, UPPER, &high[1]))
            continue;
        tn_paint_move_to(paint, x_of(c, i), y_of(c, low[0]));
        tn_paint_line_to(paint, x_of(c, i + 1), y_of(c, low[1]));
        tn_paint_line_to(paint, x_of(c, i + 1), y_of(c, high[1]));
        tn_paint_line_to(paint, x_of(c, i), y_of(c, high[0]));
        tn_paint_close_path(paint);
    }
    tn_paint_fill(paint);
    tn_paint_restore(paint);
}

static void draw_curve(const chart *c, figure which)
{
    tn_paint *paint = c->paint;
    bool open = false;
    double value = 0;
    clip_to_axes(paint);
    set_colour(paint, which);
    tn_paint_line_width(paint, which == BEST ? 1.6 : 1);
    for (size_t i = 0; i < c->count; i++) {
        if (!value_of(c, i, which, &value)) {
            open = false;
            continue;
        }
        if (open)
            tn_paint_line_to(paint, x_of(c, i), y_of(c, value));
        else
            tn_paint_move_to(paint, x_of(c, i), y_of(c, value));
        open = true;
    }
    if (c->count == 1 && open)
        tn_paint_line_to(paint, x_of(c, 0) + 3, y_of(c, value));
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

/* The curves' names and last values, at their ends but not on one another. */
static void draw_names(const chart *c)
{
    double value[2], y[2];
    char text[64];
    for (figure which = BEST; which <= MEDIAN; which++) {
        if (c->count == 0 || !value_of(c, c->count - 1, which, &value[which]))
            return;
        y[which] = fmin(fmax(TOP, y_of(c, value[which])), HEIGHT - BOTTOM);
    }
    double apart = LABEL_APART - (y[0] - y[1]); /* the best lies below the median */
    if (apart > 0)
        y[1] -= apart;
    tn_paint_face(c->paint, 9, false);
    for (figure which = BEST; which <= MEDIAN; which++) {
        set_colour(c->paint, which);
        snprintf(text, sizeof text, "%s %.5g", which == BEST ? "best" : "median", value[which]);
        tn_type_line(c->paint, WIDTH - RIGHT + 8, y[which] + 3, TN_ALIGN_LEFT, text);
    }
}

static void draw_title(tn_paint *paint, const char *title)
{
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_face(paint, 12, true);
    tn_type_fit(paint, LEFT, 24, TN_ALIGN_LEFT, WIDTH - LEFT - 20, title);
    tn_paint_colour(paint, 0.45, 0.45, 0.45);
    tn_paint_face(paint, 9, false);
    tn_type_line(paint, LEFT, 38, TN_ALIGN_LEFT,
                 "score: lower is better; the band holds the middle half of the members");
}

tn_status tn_stats_plot(const tn_generation_stats *stats, size_t count, const char *title, tn_picture *to,
                        tn_error *error)
{
    tn_canvas_format format;
    tn_canvas *canvas = NULL;
    tn_canvas_options options = {.width = WIDTH, .height = HEIGHT, .title = title};
    double *scratch = calloc(count + 1, sizeof *scratch);
    tn_status status = scratch ? tn_picture_format(to, &format, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_canvas_open(to, &options, &canvas, error);
    if (status == TN_OK) {
        chart c = {.paint = tn_canvas_paint(canvas), .stats = stats, .count = count};
        find_range(&c, scratch);
        draw_title(c.paint, title);
        draw_band(&c);
        draw_axes(&c);
        draw_curve(&c, MEDIAN);
        draw_curve(&c, BEST);
        draw_names(&c);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    free(scratch);
    return status;
}
