#include "runtime/growth/picture/draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/hidden.h"
#include "runtime/geometry/mesh.h"
#include "runtime/geometry/vector.h"

#define NO_EDGE UINT16_MAX /* where a face was cut */

/* A face, or a piece of one: what is needed to paint it. */
typedef struct seen_face {
    uint32_t first, size; /* corners */
    float light;          /* 0 dark .. 1 */
} seen_face;

struct tn_view {
    seen_face *faces; /* the farthest first */
    size_t face_count;
    float (*points)[2]; /* [corner] in the picture's plane, y up */
    uint16_t *labels;   /* [corner] of the edge that starts there, or NO_EDGE */
    double low[2], high[2];
    double width;
    uint32_t step;
    uint32_t by_depth;
};

void tn_view_free(tn_view *view)
{
    if (!view)
        return;
    free(view->faces);
    free(view->points);
    free(view->labels);
    free(view);
}

/* ---- taking */

/* A surface as it lies before the eye. */
typedef struct prospect {
    tn_scene scene;
    float *light;     /* [face] */
    uint16_t *labels; /* [corner] */
    double middle[3], size;
} prospect;

static void clear_prospect(prospect *p)
{
    free(p->scene.points);
    free(p->scene.first);
    free(p->light);
    free(p->labels);
}

static void see_face(const tn_map *map, const tn_eye *eye, uint32_t face, prospect *seen, uint32_t *corner)
{
    uint32_t first = map->face_first[face], size = tn_face_size(map, face), number = seen->scene.face_count++;
    tn_vector normal = {0, 0, 0}, origin = tn_vector_at(map->positions + 3 * (size_t)map->origin[first]), before = {0};
    seen->scene.first[number] = *corner;
    for (uint32_t d = first; d < first + size; d++) {
        tn_vector p = tn_vector_at(map->positions + 3 * (size_t)map->origin[d]), r = tn_sub(p, origin);
        tn_vector_put(seen->scene.points[*corner], tn_eye_sees(eye, p));
        seen->labels[(*corner)++] = (uint16_t)tn_state_label(map->states[map->side[d] / 2]);
        normal = tn_add(normal, tn_cross(before, r));
        before = r;
    }
    seen->light[number] = (float)tn_eye_light(eye, tn_normalised(normal));
}

/* Moves and scales the scene to about the unit cube, as tn_scene wants it. */
static void measure(prospect *seen, uint32_t corners)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t c = 0; c < corners; c++) {
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], seen->scene.points[c][k]);
            high[k] = fmax(high[k], seen->scene.points[c][k]);
        }
    }
    seen->size = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    seen->size = seen->size > 1e-300 ? seen->size : 1;
    for (int k = 0; k < 3; k++)
        seen->middle[k] = low[k] + (high[k] - low[k]) / 2;
    for (uint32_t c = 0; c < corners; c++)
        for (int k = 0; k < 3; k++)
            seen->scene.points[c][k] = (seen->scene.points[c][k] - seen->middle[k]) / seen->size;
}

static tn_status look(const tn_map *map, const tn_eye *eye, prospect *seen, tn_error *error)
{
    size_t corners = 2 * (size_t)map->edge_count - tn_face_size(map, TN_OUTER_FACE);
    *seen = (prospect){0};
    seen->scene.points = malloc((corners + 1) * sizeof *seen->scene.points);
    seen->scene.first = malloc((map->face_count + 1) * sizeof *seen->scene.first);
    seen->light = malloc(map->face_count * sizeof *seen->light);
    seen->labels = malloc((corners + 1) * sizeof *seen->labels);
    if (!seen->scene.points || !seen->scene.first || !seen->light || !seen->labels)
        return tn_fail_memory(error);
    uint32_t corner = 0;
    for (uint32_t f = TN_OUTER_FACE + 1; f < map->face_count; f++)
        see_face(map, eye, f, seen, &corner);
    seen->scene.first[seen->scene.face_count] = corner;
    measure(seen, corner);
    return TN_OK;
}

/* One patch of the painting, back in model units. */
static void keep_patch(tn_view *view, const prospect *seen, const tn_painting *painting, const tn_patch *patch,
                       uint32_t *corner)
{
    view->faces[view->face_count++] = (seen_face){*corner, patch->count, seen->light[patch->face]};
    for (uint32_t c = patch->first; c < patch->first + patch->count; c++) {
        const double *p = patch->piece ? painting->points[c] : seen->scene.points[c];
        uint32_t side = patch->piece ? painting->sides[c] : c;
        for (int k = 0; k < 2; k++) {
            double at = p[k] * seen->size + seen->middle[k];
            view->points[*corner][k] = (float)at;
            view->low[k] = fmin(view->low[k], at);
            view->high[k] = fmax(view->high[k], at);
        }
        view->labels[(*corner)++] = side == TN_CUT ? NO_EDGE : seen->labels[side];
    }
}

static tn_status keep(tn_view *view, const prospect *seen, const tn_painting *painting, tn_error *error)
{
    size_t corners = 0;
    uint32_t corner = 0;
    for (size_t i = 0; i < painting->patch_count; i++)
        corners += painting->patches[i].count;
    view->faces = malloc((painting->patch_count + 1) * sizeof *view->faces);
    view->points = malloc((corners + 1) * sizeof *view->points);
    view->labels = malloc((corners + 1) * sizeof *view->labels);
    if (!view->faces || !view->points || !view->labels)
        return tn_fail_memory(error);
    for (int k = 0; k < 2; k++) {
        view->low[k] = INFINITY;
        view->high[k] = -INFINITY;
    }
    view->by_depth = painting->by_depth;
    for (size_t i = 0; i < painting->patch_count; i++)
        keep_patch(view, seen, painting, &painting->patches[i], &corner);
    return TN_OK;
}

tn_status tn_view_take(const tn_growth *growth, const tn_camera *camera, tn_view **result, tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    *result = NULL;
    if (map->face_count - 1 > TN_DRAWN_FACES_MAX) {
        tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "a picture of %u faces would be too large; the limit is %u",
                map->face_count - 1, TN_DRAWN_FACES_MAX);
        tn_error_help(error, "draw an earlier step, or write a mesh instead");
        return TN_LIMIT;
    }
    tn_view *view = calloc(1, sizeof *view);
    if (!view)
        return tn_fail_memory(error);
    view->width = camera->width > 0 ? camera->width : 480;
    view->step = tn_growth_steps(growth);
    tn_eye eye = tn_camera_eye(camera);
    prospect seen;
    tn_painting painting = {0};
    tn_status status = look(map, &eye, &seen, error);
    int threads = tn_growth_settings(growth)->threads;
    seen.scene.watch = tn_growth_settings(growth)->watch;
    seen.scene.threads = threads > 0 ? threads : (int)tn_crew_default();
    if (status == TN_OK)
        status = tn_painting_make(&seen.scene, &painting, error);
    if (status == TN_OK)
        status = keep(view, &seen, &painting, error);
    tn_painting_clear(&painting);
    clear_prospect(&seen);
    if (status == TN_OK)
        *result = view;
    else
        tn_view_free(view);
    return status;
}

uint32_t tn_view_by_depth(const tn_view *view)
{
    return view->by_depth;
}

/* ---- drawing */

#define MARGIN 14.0
#define TITLE_HEIGHT 26.0
#define FOOT_HEIGHT 30.0
#define LABEL_HEIGHT 16.0
#define LEGEND_LINE 11.0
#define LEGEND_ROWS_MAX 40u /* more labels than these tell nobody anything */
#define HAIRLINE 0.5

typedef struct sheet {
    double scale;     /* points per model unit */
    uint32_t *legend; /* labels that are seen; owned */
    uint32_t legend_count, legend_columns, legend_rows;
    double legend_cell; /* points a column */
    double cell[2];
    size_t columns, rows;
    double size[2];
} sheet;

/* Lists the labels that are seen, in one row where that is wide enough. False: out of memory. */
static bool lay_out_legend(tn_view *const *views, size_t count, const tn_growth_system *system, sheet *s)
{
    uint32_t labels = system ? system->label_count : 0;
    size_t longest = 1;
    bool *seen = calloc(labels + 1, sizeof *seen);
    s->legend = malloc((labels + 1) * sizeof *s->legend);
    s->legend_count = 0;
    for (size_t i = 0; seen && i < count; i++)
        for (size_t f = 0; f < views[i]->face_count; f++)
            for (uint32_t c = 0; c < views[i]->faces[f].size; c++) {
                uint16_t label = views[i]->labels[views[i]->faces[f].first + c];
                if (label < labels)
                    seen[label] = true;
            }
    for (uint32_t label = 0; seen && s->legend && label < labels; label++) {
        if (!seen[label])
            continue;
        size_t length = strlen(system->labels[label].name);
        longest = length > longest ? length : longest;
        s->legend[s->legend_count++] = label;
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
    sheet s = {.columns = options->columns};
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
    s.cell[1] = extent[1] * s.scale + 2 * MARGIN + (count > 1 ? LABEL_HEIGHT : 0);
    s.size[0] = fmax(s.cell[0] * (double)s.columns, 300);
    s.size[1] = s.cell[1] * (double)s.rows + FOOT_HEIGHT + (options->title && options->title[0] ? TITLE_HEIGHT : 0);
    return s;
}

static void set_label_colour(cairo_t *cr, uint32_t label)
{
    unsigned char rgb[3];
    tn_group_colour(label, rgb);
    cairo_set_source_rgb(cr, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

static void outline(cairo_t *cr, const tn_view *view, const seen_face *face)
{
    cairo_new_path(cr); /* text leaves a point behind */
    for (uint32_t c = face->first; c < face->first + face->size; c++)
        cairo_line_to(cr, (double)view->points[c][0], (double)view->points[c][1]);
    cairo_close_path(cr);
}

/* Strokes the sides of one kind, from one corner on; returns the next corner. */
static uint32_t stroke_run(cairo_t *cr, const tn_view *view, const seen_face *face, uint32_t i)
{
    uint16_t label = view->labels[face->first + i];
    const float *start = view->points[face->first + i];
    cairo_move_to(cr, (double)start[0], (double)start[1]);
    for (; i < face->size && view->labels[face->first + i] == label; i++) {
        uint32_t next = face->first + (i + 1 == face->size ? 0 : i + 1);
        cairo_line_to(cr, (double)view->points[next][0], (double)view->points[next][1]);
    }
    cairo_stroke(cr);
    return i;
}

/* Fills a face and draws its edges, runs of one colour at a time. Where it was cut, a hairline of its own colour closes
 * the seam that smoothed edges would leave. */
static void paint_face(cairo_t *cr, const tn_view *view, const seen_face *face, double line, double hairline)
{
    double light = (double)face->light;
    outline(cr, view, face);
    cairo_set_source_rgb(cr, 0.98 * light, 0.97 * light, 0.93 * light);
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_fill(cr);
    cairo_set_line_width(cr, hairline);
    for (uint32_t i = 0; i < face->size;)
        i = view->labels[face->first + i] == NO_EDGE ? stroke_run(cr, view, face, i) : i + 1;
    cairo_set_line_width(cr, line);
    for (uint32_t i = 0; i < face->size;) {
        uint16_t label = view->labels[face->first + i];
        if (label == NO_EDGE) {
            i++;
            continue;
        }
        set_label_colour(cr, label);
        i = stroke_run(cr, view, face, i);
    }
}

/* `label` is written below the view; NULL for none. */
static void paint_view(cairo_t *cr, const tn_view *view, const sheet *s, double x, double y, const char *label)
{
    double wide = (view->high[0] - view->low[0]) * s->scale, high = (view->high[1] - view->low[1]) * s->scale;
    double left = x + (s->cell[0] - wide) / 2, top = y + (s->cell[1] - (label ? LABEL_HEIGHT : 0) - high) / 2;
    double line = 0.8;
    if (view->face_count > 300)
        line = fmax(0.12, 0.8 * sqrt(300.0 / (double)view->face_count));
    cairo_save(cr);
    cairo_translate(cr, left, top + high);
    cairo_scale(cr, s->scale, -s->scale);
    cairo_translate(cr, -view->low[0], -view->low[1]);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    for (size_t f = 0; f < view->face_count; f++)
        paint_face(cr, view, &view->faces[f], line / s->scale, HAIRLINE / s->scale);
    cairo_restore(cr);
    if (label) {
        cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
        tn_type_face(cr, 9, false);
        tn_type_line(cr, x + MARGIN, y + s->cell[1] - 5, TN_ALIGN_LEFT, label);
    }
}

static void write_foot(cairo_t *cr, const sheet *s, const tn_view_options *options)
{
    double x = MARGIN, y = s->size[1] - FOOT_HEIGHT - LEGEND_LINE * (s->legend_rows - 1) + 10;
    tn_type_face(cr, 8, false);
    for (uint32_t i = 0; i < s->legend_count; i++) {
        uint32_t label = s->legend[i];
        if (s->legend_rows > 1) {
            x = MARGIN + i % s->legend_columns * s->legend_cell;
            y += i > 0 && i % s->legend_columns == 0 ? LEGEND_LINE : 0;
        }
        set_label_colour(cr, label);
        cairo_set_line_width(cr, 2);
        cairo_move_to(cr, x, y - 2.5);
        cairo_line_to(cr, x + 12, y - 2.5);
        cairo_stroke(cr);
        cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
        tn_type_line(cr, x + 15, y, TN_ALIGN_LEFT, options->system->labels[label].name);
        x += 26 + tn_type_width(cr, options->system->labels[label].name);
    }
    if (options->caption) {
        cairo_set_source_rgb(cr, 0.45, 0.45, 0.45);
        tn_type_face(cr, 6.5, false);
        tn_type_line(cr, MARGIN, s->size[1] - 8, TN_ALIGN_LEFT, options->caption);
    }
}

static void paint_sheet(cairo_t *cr, tn_view *const *views, size_t count, const sheet *s,
                        const tn_view_options *options)
{
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
        paint_view(cr, views[i], s, (double)(i % s->columns) * s->cell[0], top + (double)(i / s->columns) * s->cell[1],
                   options->labels || count > 1 ? label : NULL);
    }
    write_foot(cr, s, options);
}

tn_status tn_views_draw(tn_view *const *views, size_t count, const tn_view_options *options, tn_picture *to,
                        tn_error *error)
{
    sheet s = lay_out(views, count, options);
    if (!lay_out_legend(views, count, options->system, &s)) {
        free(s.legend);
        return tn_fail_memory(error);
    }
    s.size[1] += LEGEND_LINE * (s.legend_rows - 1);
    tn_canvas_options canvas_options = {
        .width = s.size[0], .height = s.size[1], .dpi = options->dpi, .title = options->title};
    tn_canvas *canvas;
    tn_status status = tn_canvas_open(to, &canvas_options, &canvas, error);
    if (status == TN_OK) {
        paint_sheet(tn_canvas_context(canvas), views, count, &s, options);
        status = tn_canvas_commit(canvas, error);
        tn_canvas_free(canvas);
    }
    free(s.legend);
    return status;
}
