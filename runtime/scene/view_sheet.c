/* Draws views side by side on a sheet, with a legend of what their colours mean. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/mesh.h"
#include "runtime/scene/view_parts.h"

#define MARGIN 14.0
#define TITLE_HEIGHT 26.0
#define FOOT_HEIGHT 30.0
#define LABEL_HEIGHT 16.0
#define LEGEND_LINE 11.0
#define LEGEND_ROWS_MAX 40u /* more labels than these tell nobody anything */
#define LARGE_FACE 14.0     /* points across: lines of smaller faces fade */

static const double given_ambient = 0.5; /* of views in colours that are given: dark sides keep theirs */

typedef struct sheet {
    double scale;     /* points per model unit */
    uint32_t *legend; /* labels that are seen; owned */
    uint32_t legend_count, legend_columns, legend_rows;
    double legend_cell; /* points a column */
    double cell[2];
    size_t columns, rows;
    double size[2];
    const double (*palette)[3]; /* or NULL */
    bool scaled, fades;
} sheet;

static void mark_seen(const tn_view *view, const tn_legend *legend, bool *seen)
{
    for (size_t f = 0; f < view->face_count; f++) {
        const tn_seen_face *face = &view->faces[f];
        if (legend->groups && face->group < legend->count)
            seen[face->group] = true;
        for (uint32_t c = face->first; c < face->first + face->size && !legend->groups; c++)
            if (view->edges[c] < legend->count)
                seen[view->edges[c]] = true;
    }
}

/* Lists what is seen, in one row where that is wide enough. False: out of memory. */
static bool lay_out_legend(tn_view *const *views, size_t count, const tn_legend *legend, sheet *s)
{
    size_t longest = 1;
    bool *seen = calloc(legend->count + 1u, sizeof *seen);
    s->legend = malloc((legend->count + 1u) * sizeof *s->legend);
    s->legend_count = 0;
    for (size_t i = 0; seen && i < count; i++)
        mark_seen(views[i], legend, seen);
    for (uint32_t number = 0; seen && s->legend && number < legend->count; number++) {
        if (!seen[number])
            continue;
        size_t length = strlen(legend->name(legend->names, number));
        longest = length > longest ? length : longest;
        s->legend[s->legend_count++] = number;
    }
    s->legend_cell = 26 + 5 * (double)longest; /* of 8 points, letters and digits are at most so wide on the mean */
    s->legend_columns = (uint32_t)fmax((s->size[0] - 2 * MARGIN) / s->legend_cell, 1);
    if (s->legend_count > LEGEND_ROWS_MAX * s->legend_columns)
        s->legend_count = LEGEND_ROWS_MAX * s->legend_columns;
    s->legend_rows = s->legend_count ? (s->legend_count + s->legend_columns - 1) / s->legend_columns : 1;
    bool fine = seen && s->legend;
    free(seen);
    return fine;
}

static sheet lay_out(tn_view *const *views, size_t count, const tn_view_options *options)
{
    sheet s = {
        .columns = options->columns, .palette = options->palette, .scaled = options->scaled, .fades = options->fades};
    double extent[2] = {1e-9, 1e-9};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            extent[k] = fmax(extent[k], views[i]->high[k] - views[i]->low[k]);
    if (s.columns == 0)
        for (s.columns = 1; s.columns * s.columns < count;)
            s.columns++;
    s.columns = s.columns < count ? s.columns : count;
    s.rows = (count + s.columns - 1) / s.columns;
    double width = views[0]->width / (count > 1 ? 2 : 1);
    s.scale = (width - 2 * MARGIN) / fmax(extent[0], extent[1]);
    s.cell[0] = extent[0] * s.scale + 2 * MARGIN;
    s.cell[1] = extent[1] * s.scale + 2 * MARGIN + (count > 1 || options->scaled ? LABEL_HEIGHT : 0);
    s.size[0] = fmax(s.cell[0] * (double)s.columns, 300);
    s.size[1] = s.cell[1] * (double)s.rows + FOOT_HEIGHT + (options->title && options->title[0] ? TITLE_HEIGHT : 0);
    return s;
}

static void set_colour(tn_paint *paint, uint32_t number, double light)
{
    unsigned char rgb[3];
    tn_group_colour(number, rgb);
    tn_paint_colour(paint, light * rgb[0] / 255.0, light * rgb[1] / 255.0, light * rgb[2] / 255.0);
}

/* The longest of 1, 2, 5, 10 and so on, and of their tenths, that is no longer. */
static double round_length(double most)
{
    double unit = 1;
    for (; unit > most && unit > 1e-12; unit /= 10)
        ;
    for (; unit * 10 <= most && unit < 1e12; unit *= 10)
        ;
    return unit * 5 <= most ? unit * 5 : unit * 2 <= most ? unit * 2 : unit;
}

/* A bar of a round length of the model, its number before it; (right, y) is its right end. */
static void draw_scale(tn_paint *paint, double scale, double most, double right, double y)
{
    char text[40];
    double length = round_length(most / scale), left = right - length * scale;
    snprintf(text, sizeof text, "%.6g", length);
    tn_paint_colour(paint, 0.25, 0.25, 0.25);
    tn_paint_line_width(paint, 0.8);
    tn_paint_move_to(paint, left, y - 5);
    tn_paint_line_to(paint, left, y);
    tn_paint_line_to(paint, right, y);
    tn_paint_line_to(paint, right, y - 5);
    tn_paint_stroke(paint);
    tn_paint_face(paint, 8, false);
    tn_type_line(paint, left - 4 - tn_type_width(paint, text), y, TN_ALIGN_LEFT, text);
}

/* How far lines fade where faces are so small on the mean. */
static double fade_of(const tn_view *view, double scale)
{
    double across = scale * sqrt(view->extent[0] * view->extent[1] / fmax(1, (double)view->face_count));
    return across >= LARGE_FACE ? 0 : 0.9 * (1 - across / LARGE_FACE);
}

/* `label` is written below the view; NULL for none. */
static void paint_view(const tn_canvas *canvas, const tn_view *view, const sheet *s, double x, double y,
                       const char *label)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    double extent[2] = {view->high[0] - view->low[0], view->high[1] - view->low[1]}, scale = s->scale;
    double foot = label || s->scaled ? LABEL_HEIGHT : 0;
    if (s->scaled)
        scale = fmin((s->cell[0] - 2 * MARGIN) / fmax(extent[0], 1e-9),
                     (s->cell[1] - 2 * MARGIN - foot) / fmax(extent[1], 1e-9));
    double wide = extent[0] * scale, high = extent[1] * scale;
    double left = x + (s->cell[0] - wide) / 2, top = y + (s->cell[1] - foot - high) / 2;
    double line = 0.8;
    if (view->face_count > 300)
        line = fmax(0.12, 0.8 * sqrt(300.0 / (double)view->face_count));
    tn_view_place place = {.x = left - view->low[0] * scale,
                           .y = top + high + view->low[1] * scale,
                           .scale = scale,
                           .line = line,
                           .fade = s->fades ? fade_of(view, scale) : 0,
                           .ambient = s->palette ? given_ambient : 0,
                           .palette = s->palette};
    bool guided = view->guides.count > 0; /* they may reach beyond the cell */
    if (guided) {
        tn_paint_save(paint);
        tn_paint_rectangle(paint, x, y, s->cell[0], s->cell[1] - foot);
        tn_paint_clip(paint);
    }
    tn_view_paint_areas(paint, view, &place);
    tn_view_paint(canvas, view, &place);
    tn_view_paint_marks(paint, view, &place, s->columns > 1 || s->rows > 1);
    if (guided)
        tn_paint_restore(paint);
    if (s->scaled)
        draw_scale(paint, scale, (s->cell[0] - 2 * MARGIN) / 4, x + s->cell[0] - MARGIN, y + s->cell[1] - 5);
    if (label) {
        tn_paint_colour(paint, 0.25, 0.25, 0.25);
        tn_paint_face(paint, 9, false);
        tn_type_line(paint, x + MARGIN, y + s->cell[1] - 5, TN_ALIGN_LEFT, label);
    }
}

/* A line of the legend: a stroke in the colour of a label, or a square in that of a group. */
static void write_entry(tn_paint *paint, const tn_legend *legend, uint32_t number, double x, double y)
{
    if (legend->groups) {
        tn_view_face_colour(paint, &(tn_seen_face){.group = number, .light = 0.9F});
        tn_paint_rectangle(paint, x + 4, y - 6, 7, 7);
        tn_paint_fill(paint);
    } else {
        set_colour(paint, number, 1);
        tn_paint_line_width(paint, 2);
        tn_paint_move_to(paint, x, y - 2.5);
        tn_paint_line_to(paint, x + 12, y - 2.5);
        tn_paint_stroke(paint);
    }
    tn_paint_colour(paint, 0.25, 0.25, 0.25);
    tn_type_line(paint, x + 15, y, TN_ALIGN_LEFT, legend->name(legend->names, number));
}

static void write_foot(tn_paint *paint, const sheet *s, const tn_view_options *options)
{
    double x = MARGIN, y = s->size[1] - FOOT_HEIGHT - LEGEND_LINE * (s->legend_rows - 1) + 10;
    tn_paint_face(paint, 8, false);
    for (uint32_t i = 0; i < s->legend_count; i++) {
        if (s->legend_rows > 1) {
            x = MARGIN + i % s->legend_columns * s->legend_cell;
            y += i > 0 && i % s->legend_columns == 0 ? LEGEND_LINE : 0;
        }
        write_entry(paint, &options->legend, s->legend[i], x, y);
        x += 26 + tn_type_width(paint, options->legend.name(options->legend.names, s->legend[i]));
    }
    if (options->caption) {
        tn_paint_colour(paint, 0.45, 0.45, 0.45);
        tn_paint_face(paint, 6.5, false);
        tn_type_line(paint, MARGIN, s->size[1] - 8, TN_ALIGN_LEFT, options->caption);
    }
}

static void paint_sheet(const tn_canvas *canvas, tn_view *const *views, size_t count, const sheet *s,
                        const tn_view_options *options)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    double top = 0;
    if (options->title && options->title[0]) {
        tn_paint_face(paint, 12, false);
        tn_type_line(paint, MARGIN, 18, TN_ALIGN_LEFT, options->title);
        top = TITLE_HEIGHT;
    }
    for (size_t i = 0; i < count; i++) {
        char label[96];
        if (options->labels)
            snprintf(label, sizeof label, "%s", options->labels[i]);
        else
            snprintf(label, sizeof label, "step %u", views[i]->step);
        paint_view(canvas, views[i], s, (double)(i % s->columns) * s->cell[0],
                   top + (double)(i / s->columns) * s->cell[1], options->labels || count > 1 ? label : NULL);
    }
    write_foot(paint, s, options);
}

tn_status tn_views_draw(tn_view *const *views, size_t count, const tn_view_options *options, tn_picture *to,
                        tn_error *error)
{
    sheet s = lay_out(views, count, options);
    if (!lay_out_legend(views, count, &options->legend, &s)) {
        free(s.legend);
        return tn_fail_memory(error);
    }
    s.size[1] += LEGEND_LINE * (s.legend_rows - 1);
    tn_canvas_options canvas_options = {
        .width = s.size[0], .height = s.size[1], .dpi = options->dpi, .title = options->title};
    tn_canvas *canvas;
    tn_status status = tn_canvas_open(to, &canvas_options, &canvas, error);
    if (status == TN_OK) {
        paint_sheet(canvas, views, count, &s, options);
        status = tn_canvas_commit(canvas, error);
        tn_canvas_free(canvas);
    }
    free(s.legend);
    return status;
}
