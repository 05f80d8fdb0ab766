/* Draws meshes on a sheet, each in a cell with its label. */
#include "runtime/scene/draw_meshes.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/crew.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/render.h"

#define MARGIN 14.0
#define GAP 10.0
#define TITLE_HEIGHT 26.0
#define LABEL_HEIGHT 16.0
#define CELL 150.0   /* of several, in points */
#define SINGLE 340.0 /* of one alone */
#define DPI 144u
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

static sheet lay_out(size_t count, const tn_meshes_picture *picture, uint32_t dpi)
{
    tn_camera camera = tn_camera_default();
    sheet s = {.eye = tn_camera_eye(&camera), .dpi = dpi ? dpi : DPI};
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
    sheet s = lay_out(count, picture, to->dpi);
    extent *extents = calloc(count, sizeof *extents);
    if (!extents)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        extents[i] = extent_of(meshes[i], &s.eye);
    tn_status status = draw(meshes, extents, count, &s, picture, to, error);
    free(extents);
    return status;
}
