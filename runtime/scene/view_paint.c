/* Paints a view: faces from the farthest on, each with its seams and lines. */
#include <math.h>

#include "runtime/draw/canvas.h"
#include "runtime/geometry/mesh.h"
#include "runtime/scene/view_parts.h"

#define HAIRLINE 0.5 /* points: of seams */
#define PAPER 0.88   /* the grey that lines fade towards */

static void set_edge_colour(tn_paint *paint, uint16_t edge, double fade)
{
    unsigned char rgb[3] = {33, 33, 38};
    if (edge != TN_EDGE_DARK)
        tn_group_colour(edge, rgb);
    tn_paint_colour(paint, rgb[0] / 255.0 + fade * (PAPER - rgb[0] / 255.0),
                    rgb[1] / 255.0 + fade * (PAPER - rgb[1] / 255.0), rgb[2] / 255.0 + fade * (PAPER - rgb[2] / 255.0));
}

void tn_view_face_colour(tn_paint *paint, const tn_seen_face *face)
{
    unsigned char rgb[3];
    double light = (double)face->light;
    if (face->group == TN_NO_GROUP) {
        tn_paint_colour(paint, 0.98 * light, 0.97 * light, 0.93 * light);
        return;
    }
    tn_group_colour(face->group, rgb);
    tn_paint_colour(paint, light * (0.4 + 0.6 * rgb[0] / 255.0), light * (0.4 + 0.6 * rgb[1] / 255.0),
                    light * (0.4 + 0.6 * rgb[2] / 255.0));
}

/* Paths are in points of the page, y downwards: an SVG with coordinates of the model and a matrix that makes them small
 * loses its thin lines in browsers. */
typedef struct tn_brush {
    tn_paint *paint;
    const tn_view *view;
    double scale;
} tn_brush;

static void move_to(const tn_brush *brush, double x, double y)
{
    tn_paint_move_to(brush->paint, x * brush->scale, -y * brush->scale);
}

static void line_to(const tn_brush *brush, double x, double y)
{
    tn_paint_line_to(brush->paint, x * brush->scale, -y * brush->scale);
}

static void set_width(const tn_brush *brush, double width)
{
    tn_paint_line_width(brush->paint, width * brush->scale);
}

static void outline(const tn_brush *brush, const tn_seen_face *face)
{
    tn_paint_new_sub_path(brush->paint);
    for (uint32_t c = face->first; c < face->first + face->size; c++)
        line_to(brush, (double)brush->view->points[c][0], (double)brush->view->points[c][1]);
    tn_paint_close_path(brush->paint);
}

/* Strokes the sides of one kind, from one corner on; returns the next corner. */
static uint32_t stroke_run(const tn_brush *brush, const tn_seen_face *face, uint32_t i)
{
    const uint16_t *edges = brush->view->edges + face->first;
    const float(*points)[2] = (const float(*)[2])(brush->view->points + face->first);
    uint16_t edge = edges[i];
    move_to(brush, (double)points[i][0], (double)points[i][1]);
    for (; i < face->size && edges[i] == edge; i++) {
        const float *next = points[(i + 1) % face->size];
        line_to(brush, (double)next[0], (double)next[1]);
    }
    tn_paint_stroke(brush->paint);
    return i;
}

static void set_fill(tn_paint *paint, const tn_seen_face *face, const tn_view_place *place)
{
    const double(*palette)[3] = place->palette;
    double light = place->ambient + (1 - place->ambient) * (double)face->light;
    if (palette)
        tn_paint_colour(paint, light * palette[face->group][0], light * palette[face->group][1],
                        light * palette[face->group][2]);
    else
        tn_view_face_colour(paint, face);
}

/* How far seams keep away from lines at their ends, in units of the model: `line` is half as wide as these are,
 * `stroke` half as wide as a seam is. */
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
static void draw_seams(const tn_brush *brush, const tn_seen_face *face, const clearance *clear)
{
    const tn_view *view = brush->view;
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
            move_to(brush, (double)a[0] + from * along[0], (double)a[1] + from * along[1]);
        line_to(brush, (double)b[0] - to * along[0], (double)b[1] - to * along[1]);
        goes_on = to == 0;
    }
    tn_paint_stroke(brush->paint);
}

static void draw_edges(const tn_brush *brush, const tn_seen_face *face, double fade)
{
    for (uint32_t i = 0; i < face->size;) {
        uint16_t edge = brush->view->edges[face->first + i];
        if (edge == TN_EDGE_NONE || edge == TN_EDGE_JOINED) {
            i++;
            continue;
        }
        set_edge_colour(brush->paint, edge, fade);
        i = stroke_run(brush, face, i);
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
static void trace_mend(const tn_brush *brush, const tn_mend *mend, const clearance *clear)
{
    const float *corner = brush->view->points[mend->corner];
    double along[2] = {(double)mend->along[0], (double)mend->along[1]}, tangent = (double)mend->tangent,
           reach = fmin((clear->line + clear->stroke) / fmax(fabs(tangent), 1e-9), (double)mend->length),
           aside = copysign(clear->line / 2, tangent), x = (double)corner[0] - aside * along[1],
           y = (double)corner[1] + aside * along[0];
    move_to(brush, x, y);
    line_to(brush, x + reach * along[0], y + reach * along[1]);
}

/* Draws such halves again, those of one colour at a time. */
static void draw_mends(const tn_brush *brush, const tn_seen_face *face, const clearance *clear, double fade)
{
    const tn_mend *mends = brush->view->mends;
    size_t i = first_mend(brush->view, face->first), end = first_mend(brush->view, face->first + face->size);
    for (; i < end; i++) {
        trace_mend(brush, &mends[i], clear);
        if (i + 1 < end && mends[i + 1].edge == mends[i].edge)
            continue;
        set_edge_colour(brush->paint, mends[i].edge, fade);
        tn_paint_stroke(brush->paint);
    }
}

/* Fills faces of one plane as one shape, then draws their edges, runs of one colour at a time. Where they were cut, a
 * hairline of their own colour closes the seam that smoothed edges would leave. It does not reach into lines, which the
 * face on their other side may have drawn before. */
static void paint_faces(const tn_brush *brush, const tn_seen_face *faces, size_t count, const tn_view_place *place,
                        double seam)
{
    tn_paint *paint = brush->paint;
    const clearance clear = {place->line / place->scale / 2, seam / 2};
    tn_paint_new_path(paint); /* text leaves a point behind */
    for (size_t f = 0; f < count; f++)
        outline(brush, &faces[f]);
    set_fill(paint, faces, place);
    tn_paint_even_odd(paint, count == 1);
    tn_paint_fill(paint);
    tn_paint_line_cap(paint, TN_CAP_BUTT);
    set_width(brush, seam);
    for (size_t f = 0; f < count; f++)
        draw_seams(brush, &faces[f], &clear);
    set_width(brush, clear.line);
    for (size_t f = 0; f < count; f++)
        draw_mends(brush, &faces[f], &clear, place->fade);
    tn_paint_line_cap(paint, TN_CAP_ROUND);
    set_width(brush, 2 * clear.line);
    for (size_t f = 0; f < count; f++)
        draw_edges(brush, &faces[f], place->fade);
}

/* As wide as a seam can be seen, in units of the model: a pixel at least where there are pixels. */
static double seam_width(tn_paint *paint, const tn_view_place *place)
{
    return fmax(HAIRLINE, tn_paint_pixel(paint)) / place->scale;
}

void tn_view_paint(const tn_canvas *canvas, const tn_view *view, const tn_view_place *place)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    const tn_brush brush = {paint, view, place->scale};
    tn_paint_save(paint);
    tn_paint_translate(paint, place->x, place->y);
    tn_paint_line_join(paint, TN_JOIN_ROUND);
    tn_paint_line_cap(paint, TN_CAP_ROUND);
    double seam = seam_width(paint, place);
    for (size_t f = 0, end, painted = 0; f < view->face_count; f = end) {
        if (painted++ % 256 == 0 && tn_canvas_stopped(canvas))
            break;
        for (end = f + 1; end < view->face_count && view->faces[end].joined;)
            end++;
        paint_faces(&brush, view->faces + f, end - f, place, seam);
    }
    tn_paint_restore(paint);
}
