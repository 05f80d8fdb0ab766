/* Draws meshes: one on a page with a title and a line at the foot, or several on a sheet, each in a cell with its
 * label. */
#include "runtime/scene/draw_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/edges.h"
#include "runtime/geometry/render.h"
#include "runtime/scene/view.h"

/* ==== lists the faces of a mesh for a picture */

static void add_face(const tn_mesh *mesh, const bool *creases, uint32_t face, tn_display_list *display)
{
    uint32_t begin = mesh->face_first[face], end = mesh->face_first[face + 1];
    display->first[face] = begin;
    for (uint32_t c = begin; c < end; c++) {
        for (size_t k = 0; k < 3; k++)
            display->points[c][k] = mesh->positions[3 * (size_t)mesh->corners[c] + k];
        display->edges[c] = !creases || creases[c] ? TN_EDGE_DARK : TN_EDGE_NONE;
    }
    if (mesh->face_group)
        display->groups[face] = mesh->face_group[face];
}

static bool all_triangles(const tn_mesh *mesh)
{
    for (size_t f = 0; f <= mesh->face_count; f++)
        if (mesh->face_first[f] != 3 * f)
            return false;
    return true;
}

tn_status tn_display_list_of_mesh(const tn_mesh *mesh, tn_display_list *display, tn_error *error)
{
    bool *creases = NULL;
    tn_status status =
        tn_display_list_new(mesh->face_count, mesh->face_first[mesh->face_count], mesh->face_group, display, error);
    if (status == TN_OK && all_triangles(mesh))
        status = tn_mesh_creases(mesh, &creases, error);
    if (status != TN_OK)
        return status;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        add_face(mesh, creases, f, display);
    display->first[mesh->face_count] = mesh->face_first[mesh->face_count];
    display->face_count = (uint32_t)mesh->face_count;
    display->watch = mesh->watch;
    free(creases);
    return TN_OK;
}

/* ==== draws a mesh on a page with a title and a line at the foot */

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

/* ==== draws meshes on a sheet, each in a cell with its label */

#define GAP 10.0
#define LABEL_HEIGHT 16.0
#define CELL 150.0   /* of several, in points */
#define SINGLE 340.0 /* of one alone */
#define SHEET_DPI 144u
#define ENLARGED 2.0    /* at most, what would be small beside others */
#define BATCH_CELLS 32u /* an image takes 360 kB */

/* What the eye sees of a mesh. */
typedef struct extent {
    double low[2], high[2];
} extent;

typedef struct sheet {
    tn_eye eye;
    size_t columns, rows;
    double cell, top, label; /* points */
    uint32_t dpi;
} sheet;

static extent extent_of(const tn_mesh *mesh, const tn_eye *eye)
{
    extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        tn_vector seen = tn_eye_sees(eye, tn_vector_at(mesh->positions + 3 * v));
        e.low[0] = fmin(e.low[0], seen.x);
        e.high[0] = fmax(e.high[0], seen.x);
        e.low[1] = fmin(e.low[1], seen.y);
        e.high[1] = fmax(e.high[1], seen.y);
    }
    for (int k = 0; k < 2 && mesh->vertex_count == 0; k++)
        e.low[k] = e.high[k] = 0;
    return e;
}

static double side_of(const extent *e)
{
    return fmax(fmax(e->high[0] - e->low[0], e->high[1] - e->low[1]), 1e-300);
}

static sheet lay_out_sheet(size_t count, const tn_meshes_picture *picture, uint32_t dpi)
{
    tn_camera camera = tn_camera_default();
    sheet s = {.eye = tn_camera_eye(&camera), .dpi = dpi ? dpi : SHEET_DPI};
    s.columns = (size_t)ceil(sqrt((double)count) * 1.2);
    s.columns = s.columns > count ? count : s.columns;
    s.rows = (count + s.columns - 1) / s.columns;
    s.cell = count > 1 ? CELL : SINGLE;
    s.top = MARGIN + (picture->title && picture->title[0] ? TITLE_HEIGHT : 0);
    s.label = picture->labels ? LABEL_HEIGHT : 0;
    return s;
}

/* Cells whose images are made at once. */
typedef struct batch {
    const tn_mesh *const *meshes;
    double *const *normals; /* or NULL */
    const extent *extents;
    const sheet *s;
    bool open;
    uint32_t side;                 /* of an image, in pixels */
    double largest;                /* side of what is drawn */
    uint32_t *images[BATCH_CELLS]; /* owned */
} batch;

static tn_status make_image(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    batch *b = context;
    const extent *e = &b->extents[item];
    double pixel = 72.0 / b->s->dpi, scale = b->s->cell / fmax(side_of(e), b->largest / ENLARGED);
    tn_render_frame frame = {.width = b->side,
                             .height = b->side,
                             .left = (e->low[0] + e->high[0]) / 2 - b->s->cell / scale / 2,
                             .top = (e->low[1] + e->high[1]) / 2 + b->s->cell / scale / 2,
                             .pixel = pixel / scale,
                             .open = b->open};
    double *normals = NULL;
    tn_status status = b->normals ? TN_OK : tn_mesh_normals(b->meshes[item], &normals, error);
    if (status == TN_OK)
        status = tn_mesh_render(b->meshes[item], b->normals ? b->normals[item] : normals, &b->s->eye, &frame,
                                &b->images[item], error);
    free(normals);
    return status;
}

static double largest_side(const extent *extents, size_t count)
{
    double side = 1e-300;
    for (size_t i = 0; i < count; i++)
        side = fmax(side, side_of(&extents[i]));
    return side;
}

static tn_status draw_cells(tn_paint *paint, const tn_mesh *const *meshes, const extent *extents, size_t count,
                            const sheet *s, const tn_meshes_picture *picture, tn_error *error)
{
    double pixel = 72.0 / s->dpi, largest = largest_side(extents, count);
    uint32_t side = (uint32_t)ceil(s->cell / pixel);
    tn_crew *crew = tn_crew_new(0, NULL);
    tn_status status = crew ? TN_OK : tn_fail_memory(error);
    tn_paint_face(paint, 9, false);
    tn_paint_colour(paint, 0, 0, 0);
    for (size_t first = 0; first < count && status == TN_OK; first += BATCH_CELLS) {
        batch b = {.meshes = meshes + first,
                   .normals = picture->normals ? picture->normals + first : NULL,
                   .extents = extents + first,
                   .s = s,
                   .open = picture->open,
                   .side = side,
                   .largest = largest};
        size_t here = count - first < BATCH_CELLS ? count - first : BATCH_CELLS;
        status = tn_crew_run(crew, here, 1, make_image, &b, error);
        for (size_t i = 0; i < here && status == TN_OK; i++) {
            double corner[2] = {MARGIN + (double)((first + i) % s->columns) * (s->cell + GAP),
                                s->top + (double)((first + i) / s->columns) * (s->cell + s->label + GAP)};
            tn_paint_pixels(paint, b.images[i], side, side, corner[0], corner[1], pixel);
            if (picture->labels)
                tn_type_fit(paint, corner[0] + s->cell / 2, corner[1] + s->cell + 11, TN_ALIGN_CENTRE, s->cell,
                            picture->labels[first + i]);
        }
        for (size_t i = 0; i < here; i++)
            free(b.images[i]);
    }
    tn_crew_free(crew);
    return status;
}

static tn_status draw(const tn_mesh *const *meshes, const extent *extents, size_t count, const sheet *s,
                      const tn_meshes_picture *picture, tn_picture *to, tn_error *error)
{
    double width = 2 * MARGIN + (double)s->columns * (s->cell + GAP) - GAP,
           height = s->top + (double)s->rows * (s->cell + s->label + GAP) - GAP + MARGIN;
    tn_canvas_options options = {.width = width, .height = height, .dpi = s->dpi, .title = picture->title};
    tn_canvas *canvas;
    tn_status status = tn_canvas_open(to, &options, &canvas, error);
    if (status != TN_OK)
        return status;
    tn_paint *paint = tn_canvas_paint(canvas);
    if (picture->title && picture->title[0]) {
        tn_paint_face(paint, 12, false);
        tn_type_fit(paint, MARGIN, 18, TN_ALIGN_LEFT, width - 2 * MARGIN, picture->title);
    }
    status = draw_cells(paint, meshes, extents, count, s, picture, error);
    if (status == TN_OK)
        status = tn_canvas_commit(canvas, error);
    tn_canvas_free(canvas);
    return status;
}

tn_status tn_meshes_draw(const tn_mesh *const *meshes, size_t count, const tn_meshes_picture *picture, tn_picture *to,
                         tn_error *error)
{
    if (count == 0)
        return TN_OK;
    sheet s = lay_out_sheet(count, picture, to->dpi);
    extent *extents = calloc(count, sizeof *extents);
    if (!extents)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        extents[i] = extent_of(meshes[i], &s.eye);
    tn_status status = draw(meshes, extents, count, &s, picture, to, error);
    free(extents);
    return status;
}
