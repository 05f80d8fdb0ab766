/* Draws a mesh on a page with a title and a line at the foot. */
#include "runtime/scene/draw_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/render.h"

#define MARGIN 14.0
#define TITLE_HEIGHT 26.0
#define FOOT_HEIGHT 18.0
#define DPI 150u

typedef struct page {
    tn_eye eye;
    double low[2], high[2]; /* of the mesh, before the eye */
    double scale;           /* points a unit */
    double top;             /* of the view */
    double size[2];         /* points */
} page;

static page lay_out(const tn_mesh *mesh, const tn_mesh_picture *picture)
{
    page p = {.eye = tn_camera_eye(&picture->camera), .low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        tn_vector seen = tn_eye_sees(&p.eye, tn_vector_at(mesh->positions + 3 * v));
        p.low[0] = fmin(p.low[0], seen.x);
        p.high[0] = fmax(p.high[0], seen.x);
        p.low[1] = fmin(p.low[1], seen.y);
        p.high[1] = fmax(p.high[1], seen.y);
    }
    for (int k = 0; k < 2 && mesh->vertex_count == 0; k++)
        p.low[k] = p.high[k] = 0;
    double extent[2] = {p.high[0] - p.low[0], p.high[1] - p.low[1]};
    double width = picture->camera.width > 0 ? picture->camera.width : tn_camera_default().width;
    p.scale = (width - 2 * MARGIN) / fmax(fmax(extent[0], extent[1]), 1e-300);
    p.top = MARGIN + (picture->title && picture->title[0] ? TITLE_HEIGHT : 0);
    p.size[0] = width;
    p.size[1] = p.top + extent[1] * p.scale + MARGIN + (picture->caption ? FOOT_HEIGHT : 0);
    return p;
}

/* Where the view begins from the left: it stands in the middle. */
static double left_of(const page *p)
{
    return (p->size[0] - (p->high[0] - p->low[0]) * p->scale) / 2;
}

/* ---- pixels */

static tn_status paint_pixels(tn_paint *paint, const tn_mesh *mesh, const tn_mesh_picture *picture, const page *p,
                              tn_error *error)
{
    const double *given = picture->normals;
    double pixel = 72.0 / (picture->dpi ? picture->dpi : DPI); /* in points */
    tn_render_frame frame = {.width = (uint32_t)ceil(p->size[0] / pixel),
                             .height = (uint32_t)ceil(p->size[1] / pixel),
                             .left = p->low[0] - left_of(p) / p->scale,
                             .top = p->high[1] + p->top / p->scale,
                             .pixel = pixel / p->scale,
                             .open = picture->open};
    double *normals = NULL;
    uint32_t *image = NULL;
    tn_status status = given ? TN_OK : tn_mesh_normals(mesh, &normals, error);
    if (status != TN_OK)
        return status;
    status = tn_mesh_render(mesh, given ? given : normals, &p->eye, &frame, &image, error);
    free(normals);
    if (status != TN_OK)
        return status;
    tn_paint_pixels(paint, image, frame.width, frame.height, 0, 0, pixel);
    free(image);
    return TN_OK;
}

/* ---- vectors */

static tn_status look_at(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_display_list *display, tn_error *error)
{
    tn_status status = tn_display_list_new(mesh->face_count, 3 * mesh->face_count, false, display, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < 3 * mesh->face_count; i++) {
        memcpy(display->points[i], mesh->positions + 3 * (size_t)mesh->corners[i], sizeof display->points[i]);
        display->edges[i] = TN_EDGE_NONE;
    }
    for (size_t f = 0; f <= mesh->face_count; f++)
        display->first[f] = (uint32_t)(3 * f);
    display->face_count = (uint32_t)mesh->face_count;
    display->closed = !picture->open;
    display->threads = picture->threads;
    display->watch = picture->watch;
    return TN_OK;
}

static tn_status draw_vectors(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    tn_display_list display = {0};
    tn_view *view = NULL;
    tn_view_options options = {.title = picture->title, .caption = picture->caption};
    tn_status status = look_at(mesh, picture, &display, error);
    if (status == TN_OK)
        status = tn_view_take(&display, &picture->camera, &view, error);
    if (status == TN_OK)
        status = tn_views_draw(&view, 1, &options, to, error);
    tn_view_free(view);
    tn_display_list_clear(&display);
    return status;
}

/* ---- the page */

static void write_words(tn_paint *paint, const page *p, const tn_mesh_picture *picture)
{
    if (picture->title && picture->title[0]) {
        tn_paint_colour(paint, 0, 0, 0);
        tn_paint_face(paint, 12, false);
        tn_type_fit(paint, MARGIN, 18, TN_ALIGN_LEFT, p->size[0] - 2 * MARGIN, picture->title);
    }
    if (picture->caption) {
        tn_paint_colour(paint, 0.45, 0.45, 0.45);
        tn_paint_face(paint, 6.5, false);
        tn_type_fit(paint, MARGIN, p->size[1] - 8, TN_ALIGN_LEFT, p->size[0] - 2 * MARGIN, picture->caption);
    }
}

static tn_status draw_pixels(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    page p = lay_out(mesh, picture);
    tn_canvas_options options = {.width = p.size[0], .height = p.size[1], .dpi = picture->dpi, .title = picture->title};
    tn_canvas *canvas;
    tn_status status = tn_canvas_open(to, &options, &canvas, error);
    if (status != TN_OK)
        return status;
    tn_paint *paint = tn_canvas_paint(canvas);
    status = paint_pixels(paint, mesh, picture, &p, error);
    if (status == TN_OK) {
        write_words(paint, &p, picture);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}

tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    tn_canvas_format format;
    tn_status status = tn_picture_format(to, &format, error);
    if (status == TN_OK && format == TN_CANVAS_PNG)
        return draw_pixels(mesh, picture, to, error);
    if (status == TN_OK && mesh->face_count > TN_DRAWN_TRIANGLES_MAX) {
        status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE,
                         "a picture of %zu triangles would be too large; the limit is %u", mesh->face_count,
                         TN_DRAWN_TRIANGLES_MAX);
        tn_error_help(error, "a .png can show any number; for the others take a coarser --grid");
    }
    return status == TN_OK ? draw_vectors(mesh, picture, to, error) : status;
}
