/* Draws a mesh on a page with a title and a line at the foot. */
#include "runtime/geometry/picture/draw_mesh.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/crew.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/hidden.h"
#include "runtime/geometry/render.h"

#define MARGIN 14.0
#define TITLE_HEIGHT 26.0
#define FOOT_HEIGHT 18.0
#define DPI 150u
#define HAIRLINE 0.6 /* closes the seams between faces that smoothed edges would leave */

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

static tn_status paint_pixels(cairo_t *cr, const tn_mesh *mesh, const page *p, uint32_t dpi, tn_error *error)
{
    double pixel = 72.0 / dpi; /* in points */
    tn_render_frame frame = {.width = (uint32_t)ceil(p->size[0] / pixel),
                             .height = (uint32_t)ceil(p->size[1] / pixel),
                             .left = p->low[0] - left_of(p) / p->scale,
                             .top = p->high[1] + p->top / p->scale,
                             .pixel = pixel / p->scale};
    double *normals;
    uint32_t *image = NULL;
    tn_status status = tn_mesh_normals(mesh, &normals, error);
    if (status != TN_OK)
        return status;
    status = tn_mesh_render(mesh, normals, &p->eye, &frame, &image, error);
    free(normals);
    if (status != TN_OK)
        return status;
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        (unsigned char *)image, CAIRO_FORMAT_ARGB32, (int)frame.width, (int)frame.height, (int)(4 * frame.width));
    cairo_save(cr);
    cairo_scale(cr, pixel, pixel);
    cairo_set_source_surface(cr, surface, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(surface);
    free(image);
    return TN_OK;
}

/* ---- vectors */

/* The scene of hidden.h: about as large as the unit cube. */
static tn_status make_scene(const tn_mesh *mesh, const page *p, tn_scene *scene, tn_error *error)
{
    double extent = fmax(fmax(p->high[0] - p->low[0], p->high[1] - p->low[1]), 1e-300);
    scene->face_count = (uint32_t)mesh->face_count;
    scene->points = malloc((3 * mesh->face_count + 1) * sizeof *scene->points);
    scene->first = malloc((mesh->face_count + 1) * sizeof *scene->first);
    if (!scene->points || !scene->first)
        return tn_fail_memory(error);
    for (size_t i = 0; i < 3 * mesh->face_count; i++) {
        tn_vector seen = tn_eye_sees(&p->eye, tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[i]));
        scene->points[i][0] = (seen.x - p->low[0]) / extent;
        scene->points[i][1] = (seen.y - p->low[1]) / extent;
        scene->points[i][2] = seen.z / extent;
    }
    for (size_t f = 0; f <= mesh->face_count; f++)
        scene->first[f] = (uint32_t)(3 * f);
    return TN_OK;
}

static void paint_patch(cairo_t *cr, const tn_mesh *mesh, const page *p, const tn_scene *scene,
                        const tn_painting *painting, const tn_patch *patch)
{
    double normal[3], rgb[3];
    tn_mesh_face_normal(mesh, mesh->corners + 3 * (size_t)patch->face, 3, normal);
    tn_light_colour(tn_eye_light_around(&p->eye, tn_normalised(tn_vector_at(normal))), rgb);
    cairo_new_path(cr);
    for (uint32_t c = patch->first; c < patch->first + patch->count; c++) {
        const double *at = patch->piece ? painting->points[c] : scene->points[c];
        cairo_line_to(cr, at[0], at[1]);
    }
    cairo_close_path(cr);
    cairo_set_source_rgb(cr, rgb[0], rgb[1], rgb[2]);
    cairo_fill_preserve(cr);
    cairo_stroke(cr);
}

static tn_status paint_vectors(cairo_t *cr, const tn_mesh *mesh, const page *p, const tn_mesh_picture *picture,
                               tn_error *error)
{
    tn_scene scene = {.threads = picture->threads ? picture->threads : (int)tn_crew_default(), .watch = picture->watch};
    tn_painting painting = {0};
    double extent = fmax(fmax(p->high[0] - p->low[0], p->high[1] - p->low[1]), 1e-300) * p->scale;
    tn_status status = make_scene(mesh, p, &scene, error);
    if (status == TN_OK)
        status = tn_painting_make(&scene, &painting, error);
    if (status == TN_OK) {
        cairo_save(cr);
        cairo_translate(cr, left_of(p), p->top + (p->high[1] - p->low[1]) * p->scale);
        cairo_scale(cr, extent, -extent);
        cairo_set_line_width(cr, HAIRLINE / extent);
        cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
        for (size_t i = 0; i < painting.patch_count; i++)
            paint_patch(cr, mesh, p, &scene, &painting, &painting.patches[i]);
        cairo_restore(cr);
    }
    tn_painting_clear(&painting);
    free(scene.points);
    free(scene.first);
    return status;
}

/* ---- the page */

static void write_words(cairo_t *cr, const page *p, const tn_mesh_picture *picture)
{
    if (picture->title && picture->title[0]) {
        cairo_set_source_rgb(cr, 0, 0, 0);
        tn_type_face(cr, 12, false);
        tn_type_fit(cr, MARGIN, 18, TN_ALIGN_LEFT, p->size[0] - 2 * MARGIN, picture->title);
    }
    if (picture->caption) {
        cairo_set_source_rgb(cr, 0.45, 0.45, 0.45);
        tn_type_face(cr, 6.5, false);
        tn_type_fit(cr, MARGIN, p->size[1] - 8, TN_ALIGN_LEFT, p->size[0] - 2 * MARGIN, picture->caption);
    }
}

static tn_status check_size(const tn_mesh *mesh, bool pixels, tn_error *error)
{
    if (pixels || mesh->face_count <= TN_DRAWN_TRIANGLES_MAX)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "a picture of %zu triangles would be too large; the limit is %u",
            mesh->face_count, TN_DRAWN_TRIANGLES_MAX);
    tn_error_help(error, "a .png can show any number; for the others take a coarser --grid");
    return TN_LIMIT;
}

tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    page p = lay_out(mesh, picture);
    tn_canvas_options options = {.width = p.size[0], .height = p.size[1], .dpi = picture->dpi, .title = picture->title};
    tn_canvas_format format;
    tn_canvas *canvas;
    tn_status status = tn_picture_format(to, &format, error);
    if (status == TN_OK)
        status = check_size(mesh, format == TN_CANVAS_PNG, error);
    if (status == TN_OK)
        status = tn_canvas_open(to, &options, &canvas, error);
    if (status != TN_OK)
        return status;
    cairo_t *cr = tn_canvas_context(canvas);
    status = format == TN_CANVAS_PNG ? paint_pixels(cr, mesh, &p, picture->dpi ? picture->dpi : DPI, error)
                                     : paint_vectors(cr, mesh, &p, picture, error);
    if (status == TN_OK) {
        write_words(cr, &p, picture);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}
