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
#define HAIRLINE 0.5
#define PAPER 0.88      /* the grey that lines fade towards */
#define LARGE_FACE 14.0 /* points across: lines of smaller faces fade */

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

static void set_colour(cairo_t *cr, uint32_t number, double light)
{
    unsigned char rgb[3];
    tn_group_colour(number, rgb);
    cairo_set_source_rgb(cr, light * rgb[0] / 255.0, light * rgb[1] / 255.0, light * rgb[2] / 255.0);
}

static void set_edge_colour(cairo_t *cr, uint16_t edge, double fade)
{
    unsigned char rgb[3] = {33, 33, 38};
    if (edge != TN_EDGE_DARK)
        tn_group_colour(edge, rgb);
    cairo_set_source_rgb(cr, rgb[0] / 255.0 + fade * (PAPER - rgb[0] / 255.0),
                         rgb[1] / 255.0 + fade * (PAPER - rgb[1] / 255.0),
                         rgb[2] / 255.0 + fade * (PAPER - rgb[2] / 255.0));
}

/* Faces of groups are paler than lines of their colour, so that edges stand out. */
static void set_face_colour(cairo_t *cr, const tn_seen_face *face)
{
    unsigned char rgb[3];
    double light = (double)face->light;
    if (face->group == TN_NO_GROUP) {
        cairo_set_source_rgb(cr, 0.98 * light, 0.97 * light, 0.93 * light);
        return;
    }
    tn_group_colour(face->group, rgb);
    cairo_set_source_rgb(cr, light * (0.4 + 0.6 * rgb[0] / 255.0), light * (0.4 + 0.6 * rgb[1] / 255.0),
                         light * (0.4 + 0.6 * rgb[2] / 255.0));
}

static void outline(cairo_t *cr, const tn_view *view, const tn_seen_face *face)
{
    cairo_new_sub_path(cr);
    for (uint32_t c = face->first; c < face->first + face->size; c++)
        cairo_line_to(cr, (double)view->points[c][0], (double)view->points[c][1]);
    cairo_close_path(cr);
}

/* Strokes the sides of one kind, from one corner on; returns the next corner. */
static uint32_t stroke_run(cairo_t *cr, const tn_view *view, const tn_seen_face *face, uint32_t i)
{
    const uint16_t *edges = view->edges + face->first;
    const float(*points)[2] = (const float(*)[2])(view->points + face->first);
    uint16_t edge = edges[i];
    cairo_move_to(cr, (double)points[i][0], (double)points[i][1]);
    for (; i < face->size && edges[i] == edge; i++) {
        const float *next = points[(i + 1) % face->size];
        cairo_line_to(cr, (double)next[0], (double)next[1]);
    }
    cairo_stroke(cr);
    return i;
}

static void set_fill(cairo_t *cr, const tn_seen_face *face, const tn_view_place *place)
{
    const double(*palette)[3] = place->palette;
    double light = place->ambient + (1 - place->ambient) * (double)face->light;
    if (palette)
        cairo_set_source_rgb(cr, light * palette[face->group][0], light * palette[face->group][1],
                             light * palette[face->group][2]);
    else
        set_face_colour(cr, face);
}

/* How far seams keep away from lines at their ends: `line` is half as wide as these are, `stroke` half as wide as a
 * seam is. */
typedef struct clearance {
    double line, stroke;
} clearance;

/* The share of a seam that is left out at its end, so that no part of it touches a line that ends there, half of it at
 * most. Where the angle is sharp only as much as the line hides: it is mended behind that. */
static double left_out(const tn_view *view, size_t end, double length, const clearance *clear)
{
    double cosine = (double)view->sharpest[end];
    if (view->sharpest[end] == TN_MEETS_NOTHING)
        return 0;
    double sine = sqrt(fmax(1 - cosine * cosine, 0));
    double reach = cosine > (double)TN_SHARP ? clear->line / fmax(sine, 1e-9)
                   : cosine > 0              ? (clear->line + clear->stroke * cosine) / sine
                                             : clear->line;
    return fmin(reach / fmax(length, 1e-30), 0.5);
}

/* Seams that follow one another are one stroke, unless lines end where they meet. */
static void draw_seams(cairo_t *cr, const tn_view *view, const tn_seen_face *face, const clearance *clear)
{
    const float(*points)[2] = (const float(*)[2])(view->points + face->first);
    bool goes_on = false;
    for (uint32_t i = 0; i < face->size; i++) {
        const float *a = points[i], *b = points[(i + 1) % face->size];
        double along[2] = {(double)b[0] - (double)a[0], (double)b[1] - (double)a[1]};
        size_t end = 2 * ((size_t)face->first + i);
        if (view->edges[face->first + i] != TN_EDGE_NONE) {
            goes_on = false;
            continue;
        }
        double length = hypot(along[0], along[1]), from = left_out(view, end, length, clear),
               to = left_out(view, end + 1, length, clear);
        if (!goes_on || from > 0)
            cairo_move_to(cr, (double)a[0] + from * along[0], (double)a[1] + from * along[1]);
        cairo_line_to(cr, (double)b[0] - to * along[0], (double)b[1] - to * along[1]);
        goes_on = to == 0;
    }
    cairo_stroke(cr);
}

static void draw_edges(cairo_t *cr, const tn_view *view, const tn_seen_face *face, double fade)
{
    for (uint32_t i = 0; i < face->size;) {
        uint16_t edge = view->edges[face->first + i];
        if (edge == TN_EDGE_NONE || edge == TN_EDGE_JOINED) {
            i++;
            continue;
        }
        set_edge_colour(cr, edge, fade);
        i = stroke_run(cr, view, face, i);
    }
}

/* The first mend that is not of a corner before this one. */
static size_t first_mend(const tn_view *view, uint32_t corner)
{
    size_t low = 0, high = view->mend_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (view->mends[middle].corner < corner)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Adds to the path that half of a line into which the face and its seams reach, as far as they do. */
static void trace_mend(cairo_t *cr, const tn_view *view, const tn_mend *mend, const clearance *clear)
{
    double along[2] = {(double)mend->along[0], (double)mend->along[1]}, tangent = (double)mend->tangent,
           reach = fmin((clear->line + clear->stroke) / fmax(fabs(tangent), 1e-9), (double)mend->length),
           aside = copysign(clear->line / 2, tangent), x = (double)view->points[mend->corner][0] - aside * along[1],
           y = (double)view->points[mend->corner][1] + aside * along[0];
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x + reach * along[0], y + reach * along[1]);
}

/* Draws such halves again, those of one colour at a time. */
static void draw_mends(cairo_t *cr, const tn_view *view, const tn_seen_face *face, const clearance *clear, double fade)
{
    const tn_mend *mends = view->mends;
    size_t i = first_mend(view, face->first), end = first_mend(view, face->first + face->size);
    for (; i < end; i++) {
        trace_mend(cr, view, &mends[i], clear);
        if (i + 1 < end && mends[i + 1].edge == mends[i].edge)
            continue;
        set_edge_colour(cr, mends[i].edge, fade);
        cairo_stroke(cr);
    }
}

/* Fills faces of one plane as one shape, then draws their edges, runs of one colour at a time. Where they were cut, a
 * hairline of their own colour closes the seam that smoothed edges would leave. It does not reach into lines, which the
 * face on their other side may have drawn before. */
static void paint_faces(cairo_t *cr, const tn_view *view, const tn_seen_face *faces, size_t count,
                        const tn_view_place *place, double seam)
{
    const clearance clear = {place->line / place->scale / 2, seam / 2};
    cairo_new_path(cr); /* text leaves a point behind */
    for (size_t f = 0; f < count; f++)
        outline(cr, view, &faces[f]);
    set_fill(cr, faces, place);
    cairo_set_fill_rule(cr, count > 1 ? CAIRO_FILL_RULE_WINDING : CAIRO_FILL_RULE_EVEN_ODD);
    cairo_fill(cr);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cr, seam);
    for (size_t f = 0; f < count; f++)
        draw_seams(cr, view, &faces[f], &clear);
    cairo_set_line_width(cr, clear.line);
    for (size_t f = 0; f < count; f++)
        draw_mends(cr, view, &faces[f], &clear, place->fade);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cr, 2 * clear.line);
    for (size_t f = 0; f < count; f++)
        draw_edges(cr, view, &faces[f], place->fade);
}

/* As wide as a seam can be seen: a pixel at least where there are pixels. */
static double seam_width(cairo_t *cr, const tn_view_place *place)
{
    double pixel[2] = {1, 0};
    cairo_device_to_user_distance(cr, &pixel[0], &pixel[1]);
    bool has_pixels = cairo_surface_get_type(cairo_get_target(cr)) == CAIRO_SURFACE_TYPE_IMAGE;
    return fmax(HAIRLINE / place->scale, has_pixels ? hypot(pixel[0], pixel[1]) : 0);
}

void tn_view_paint(const tn_canvas *canvas, const tn_view *view, const tn_view_place *place)
{
    cairo_t *cr = tn_canvas_context(canvas);
    cairo_save(cr);
    cairo_translate(cr, place->x, place->y);
    cairo_scale(cr, place->scale, -place->scale);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    double seam = seam_width(cr, place);
    for (size_t f = 0, end, painted = 0; f < view->face_count; f = end) {
        if (painted++ % 256 == 0 && tn_canvas_stopped(canvas))
            break;
        for (end = f + 1; end < view->face_count && view->faces[end].joined;)
            end++;
        paint_faces(cr, view, view->faces + f, end - f, place, seam);
    }
    cairo_restore(cr);
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
static void draw_scale(cairo_t *cr, double scale, double most, double right, double y)
{
    char text[40];
    double length = round_length(most / scale), left = right - length * scale;
    snprintf(text, sizeof text, "%.6g", length);
    cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
    cairo_set_line_width(cr, 0.8);
    cairo_move_to(cr, left, y - 5);
    cairo_line_to(cr, left, y);
    cairo_line_to(cr, right, y);
    cairo_line_to(cr, right, y - 5);
    cairo_stroke(cr);
    tn_type_face(cr, 8, false);
    tn_type_line(cr, left - 4 - tn_type_width(cr, text), y, TN_ALIGN_LEFT, text);
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
    cairo_t *cr = tn_canvas_context(canvas);
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
        cairo_save(cr);
        cairo_rectangle(cr, x, y, s->cell[0], s->cell[1] - foot);
        cairo_clip(cr);
    }
    tn_view_paint_areas(cr, view, &place);
    tn_view_paint(canvas, view, &place);
    tn_view_paint_marks(cr, view, &place, s->columns > 1 || s->rows > 1);
    if (guided)
        cairo_restore(cr);
    if (s->scaled)
        draw_scale(cr, scale, (s->cell[0] - 2 * MARGIN) / 4, x + s->cell[0] - MARGIN, y + s->cell[1] - 5);
    if (label) {
        cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
        tn_type_face(cr, 9, false);
        tn_type_line(cr, x + MARGIN, y + s->cell[1] - 5, TN_ALIGN_LEFT, label);
    }
}

/* A line of the legend: a stroke in the colour of a label, or a square in that of a group. */
static void write_entry(cairo_t *cr, const tn_legend *legend, uint32_t number, double x, double y)
{
    if (legend->groups) {
        set_face_colour(cr, &(tn_seen_face){.group = number, .light = 0.9F});
        cairo_rectangle(cr, x + 4, y - 6, 7, 7);
        cairo_fill(cr);
    } else {
        set_colour(cr, number, 1);
        cairo_set_line_width(cr, 2);
        cairo_move_to(cr, x, y - 2.5);
        cairo_line_to(cr, x + 12, y - 2.5);
        cairo_stroke(cr);
    }
    cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
    tn_type_line(cr, x + 15, y, TN_ALIGN_LEFT, legend->name(legend->names, number));
}

static void write_foot(cairo_t *cr, const sheet *s, const tn_view_options *options)
{
    double x = MARGIN, y = s->size[1] - FOOT_HEIGHT - LEGEND_LINE * (s->legend_rows - 1) + 10;
    tn_type_face(cr, 8, false);
    for (uint32_t i = 0; i < s->legend_count; i++) {
        if (s->legend_rows > 1) {
            x = MARGIN + i % s->legend_columns * s->legend_cell;
            y += i > 0 && i % s->legend_columns == 0 ? LEGEND_LINE : 0;
        }
        write_entry(cr, &options->legend, s->legend[i], x, y);
        x += 26 + tn_type_width(cr, options->legend.name(options->legend.names, s->legend[i]));
    }
    if (options->caption) {
        cairo_set_source_rgb(cr, 0.45, 0.45, 0.45);
        tn_type_face(cr, 6.5, false);
        tn_type_line(cr, MARGIN, s->size[1] - 8, TN_ALIGN_LEFT, options->caption);
    }
}

static void paint_sheet(const tn_canvas *canvas, tn_view *const *views, size_t count, const sheet *s,
                        const tn_view_options *options)
{
    cairo_t *cr = tn_canvas_context(canvas);
    double top = 0;
    if (options->title && options->title[0]) {
        tn_type_face(cr, 12, false);
        tn_type_line(cr, MARGIN, 18, TN_ALIGN_LEFT, options->title);
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
    write_foot(cr, s, options);
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
