/* Draws many houses on one page: each in space, small, to one scale, with what is said of it below. */
#include <math.h>
#include <stdlib.h>

#include "runtime/draw/type.h"
#include "runtime/house/picture/draw_parts.h"

#define MARGIN 28.0
#define HEADING 26.0
#define PICTURE_WIDTH 190.0 /* the most that the largest house takes, in points */
#define PICTURE_HEIGHT 150.0
#define GAP 18.0
#define CAPTION 24.0
#define NOTE_LEADING 9.0
#define LEAST_WIDTH 460.0 /* so that the notes have room */

typedef struct gallery {
    const tn_house_gallery *what;
    tn_house_drawn *drawn; /* [what->count]; owned */
    size_t columns, rows;
    double points;              /* a nanometre, in points */
    double width, height, left; /* left: of the first column */
} gallery;

static double across(const tn_house_drawn *d)
{
    return d->high[0] - d->low[0];
}

static double upright(const tn_house_drawn *d)
{
    return d->high[1] - d->low[1];
}

/* Somewhat wider than high, where nobody says how many stand in a row. */
static void lay_out(gallery *g)
{
    size_t count = g->what->count;
    g->columns = g->what->columns ? g->what->columns : (size_t)ceil(sqrt((double)count * 4 / 3));
    g->columns = g->columns < count ? g->columns : count;
    g->rows = (count + g->columns - 1) / g->columns;
    g->points = INFINITY;
    for (size_t i = 0; i < count; i++)
        g->points = fmin(g->points, fmin(PICTURE_WIDTH / across(&g->drawn[i]), PICTURE_HEIGHT / upright(&g->drawn[i])));
    double grid = (double)g->columns * (PICTURE_WIDTH + GAP) - GAP;
    g->width = fmax(2 * MARGIN + grid, LEAST_WIDTH);
    g->left = (g->width - grid) / 2;
    g->height = 2 * MARGIN + (g->what->title ? HEADING : 0) + (double)g->rows * (PICTURE_HEIGHT + CAPTION + GAP) +
                NOTE_LEADING * (double)g->what->note_count;
    double top = MARGIN + (g->what->title ? HEADING : 0);
    for (size_t i = 0; i < count; i++) {
        tn_house_drawn *d = &g->drawn[i];
        d->x = g->left + (double)(i % g->columns) * (PICTURE_WIDTH + GAP) + (PICTURE_WIDTH - across(d) * g->points) / 2;
        d->y = top + (double)(i / g->columns) * (PICTURE_HEIGHT + CAPTION + GAP) + PICTURE_HEIGHT;
    }
}

static void paint_all(const gallery *g, const tn_canvas *canvas)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    if (g->what->title) {
        tn_paint_face(paint, 13, true);
        tn_type_fit(paint, MARGIN, MARGIN + 6, TN_ALIGN_LEFT, g->width - 2 * MARGIN, g->what->title);
    }
    for (size_t i = 0; i < g->what->count && !tn_canvas_stopped(canvas); i++) {
        const tn_house_drawn *d = &g->drawn[i];
        double middle = g->left + (double)(i % g->columns) * (PICTURE_WIDTH + GAP) + PICTURE_WIDTH / 2;
        tn_paint_group_begin(paint, TN_PAINT_HOUSE, i);
        tn_paint_target(paint, middle - PICTURE_WIDTH / 2, d->y - PICTURE_HEIGHT, PICTURE_WIDTH,
                        PICTURE_HEIGHT + CAPTION);
        tn_draw_projection(canvas, d, g->points);
        tn_paint_colour(paint, 0, 0, 0);
        tn_paint_face(paint, 7.5, true);
        tn_type_fit(paint, middle, d->y + 11, TN_ALIGN_CENTRE, PICTURE_WIDTH, g->what->houses[i].name);
        tn_paint_face(paint, 7, false);
        tn_type_fit(paint, middle, d->y + 21, TN_ALIGN_CENTRE, PICTURE_WIDTH, g->what->houses[i].said);
        tn_paint_group_end(paint);
    }
    tn_paint_face(paint, 6.5, false);
    tn_paint_colour(paint, 0.25, 0.25, 0.25);
    for (size_t i = 0; i < g->what->note_count; i++)
        tn_type_fit(paint, MARGIN, g->height - MARGIN - NOTE_LEADING * (double)(g->what->note_count - 1 - i),
                    TN_ALIGN_LEFT, g->width - 2 * MARGIN, g->what->notes[i]);
}

static tn_status take_all(gallery *g, tn_watch *watch, tn_error *error)
{
    const tn_aspect aspect = {.kind = TN_ASPECT_AXONOMETRIC, .camera = g->what->camera, .bare = true};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < g->what->count; i++) {
        const tn_pictured_house *one = &g->what->houses[i];
        status = tn_house_view_take(one->solids, &aspect, one->house, &g->drawn[i], watch, error);
        if (status == TN_OK)
            tn_house_projection_extent(&g->drawn[i].projection, g->drawn[i].low, g->drawn[i].high);
    }
    return status;
}

tn_status tn_house_gallery_draw(const tn_house_gallery *what, tn_picture *to, tn_error *error)
{
    gallery g = {.what = what, .drawn = calloc(what->count + 1, sizeof *g.drawn)};
    tn_canvas *canvas = NULL;
    tn_status status = g.drawn ? take_all(&g, to->watch, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        lay_out(&g);
        status = tn_canvas_begin(to, g.width, g.height, what->title, &canvas, error);
    }
    if (status == TN_OK) {
        paint_all(&g, canvas);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    for (size_t i = 0; g.drawn && i < what->count; i++)
        tn_house_drawn_clear(&g.drawn[i]);
    free(g.drawn);
    return status;
}
