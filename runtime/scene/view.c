/* Takes views of faces: turns them before the eye, finds what hides what, and keeps what is to be painted. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/geometry/hidden/hidden.h"
#include "runtime/geometry/vector.h"
#include "runtime/numeric/numeric.h"
#include "runtime/scene/view_parts.h"

void tn_view_free(tn_view *view)
{
    if (!view)
        return;
    free(view->faces);
    free(view->points);
    free(view->edges);
    free(view->sharpest);
    free(view->mends);
    tn_guides_clear(&view->guides);
    free(view);
}

/* ---- what is looked at */

tn_status tn_display_list_new(size_t faces, size_t corners, bool groups, tn_display_list *display, tn_error *error)
{
    *display = (tn_display_list){0};
    if (faces > TN_DRAWN_FACES_MAX) {
        tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "a picture of %zu faces would be too large; the limit is %u",
                faces, TN_DRAWN_FACES_MAX);
        tn_error_help(error, "draw less, or write a mesh instead");
        return TN_LIMIT;
    }
    display->points = malloc((corners + 1) * sizeof *display->points);
    display->first = malloc((faces + 1) * sizeof *display->first);
    display->edges = malloc((corners + 1) * sizeof *display->edges);
    display->groups = groups ? malloc((faces + 1) * sizeof *display->groups) : NULL;
    bool fine = display->points && display->first && display->edges && (!groups || display->groups);
    return fine ? TN_OK : tn_fail_memory(error);
}

void tn_display_list_clear(tn_display_list *display)
{
    free(display->points);
    free(display->first);
    free(display->edges);
    free(display->groups);
    tn_guides_clear(&display->guides);
    *display = (tn_display_list){0};
}

/* ---- before the eye */

/* A surface as it lies before the eye; its points are those of the display list, moved and scaled. */
typedef struct projection {
    const tn_display_list *display;
    tn_scene scene;
    float *light;    /* [face] */
    uint64_t *plane; /* [face] a number of the plane that it lies in */
    double middle[3], size;
} projection;

/* Turns the corners of a face before the eye; returns its normal, of unit length. */
static tn_vector turn_face(const tn_eye *eye, double (*points)[3], uint32_t count)
{
    tn_vector normal = {0, 0, 0}, origin = tn_vector_at(points[0]), before = {0};
    for (uint32_t c = 0; c < count; c++) {
        tn_vector p = tn_vector_at(points[c]), r = tn_sub(p, origin);
        tn_vector_put(points[c], tn_eye_sees(eye, p));
        normal = tn_add(normal, tn_cross(before, r));
        before = r;
    }
    return tn_normalised(normal);
}

/* A number of the plane through a point: the same for faces of one plane, as far as a millionth of the whole tells. */
static uint64_t plane_of(tn_vector normal, tn_vector through, double size)
{
    const double values[4] = {normal.x, normal.y, normal.z, tn_dot(normal, through) / size};
    uint64_t number = 1;
    for (int k = 0; k < 4; k++) {
        number = (number ^ (uint64_t)(int64_t)rint(1e6 * values[k])) * UINT64_C(0x9e3779b97f4a7c15);
        number ^= number >> 29;
    }
    return number;
}

static double farthest(const tn_display_list *display)
{
    double most = 1e-300;
    for (uint32_t c = 0; c < display->first[display->face_count]; c++)
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(display->points[c][k]));
    return most;
}

/* Turns all faces, and moves those that can be seen to the front of the display list's arrays. */
static void turn_faces(tn_display_list *display, const tn_eye *eye, float *light, uint64_t *plane)
{
    double size = farthest(display);
    uint32_t kept = 0, corners = 0, begin = display->first[0];
    for (uint32_t f = 0; f < display->face_count; f++) {
        uint32_t end = display->first[f + 1], count = end - begin;
        tn_vector corner = tn_vector_at(display->points[begin]);
        tn_vector normal = turn_face(eye, display->points + begin, count);
        if (!display->closed || tn_dot(normal, eye->towards) > 1e-12) {
            memmove(display->points + corners, display->points + begin, count * sizeof *display->points);
            memmove(display->edges + corners, display->edges + begin, count * sizeof *display->edges);
            if (display->groups)
                display->groups[kept] = display->groups[f];
            light[kept] = (float)tn_eye_light(eye, normal);
            plane[kept] = plane_of(normal, corner, size);
            display->first[kept++] = corners;
            corners += count;
        }
        begin = end;
    }
    display->first[kept] = corners;
    display->face_count = kept;
}

/* Moves and scales the scene to about the unit cube, as tn_scene wants it. */
static void measure(projection *seen, uint32_t corners)
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

static tn_status look(tn_display_list *display, const tn_eye *eye, projection *seen, tn_error *error)
{
    float *light = malloc((display->face_count + 1u) * sizeof *light);
    uint64_t *plane = malloc((display->face_count + 1u) * sizeof *plane);
    *seen = (projection){.display = display, .light = light, .plane = plane};
    if (!light || !plane)
        return tn_fail_memory(error);
    turn_faces(display, eye, light, plane);
    *seen = (projection){.display = display,
                         .scene = {.points = display->points,
                                   .first = display->first,
                                   .face_count = display->face_count,
                                   .threads = display->threads > 0 ? display->threads : (int)tn_crew_default(),
                                   .watch = display->watch},
                         .light = light,
                         .plane = plane};
    measure(seen, display->first[display->face_count]);
    return TN_OK;
}

/* One patch of the painting, back in model units. */
static void keep_patch(tn_view *view, const projection *seen, const tn_painting *painting, const tn_patch *patch,
                       float *depths, uint32_t *corner)
{
    view->faces[view->face_count++] =
        (tn_seen_face){.first = *corner,
                       .size = patch->count,
                       .group = seen->display->groups ? seen->display->groups[patch->face] : TN_NO_GROUP,
                       .light = seen->light[patch->face],
                       .plane = seen->plane[patch->face]};
    for (uint32_t c = patch->first; c < patch->first + patch->count; c++) {
        const double *p = patch->piece ? painting->points[c] : seen->scene.points[c];
        uint32_t side = patch->piece ? painting->sides[c] : c;
        for (int k = 0; k < 2; k++) {
            double at = p[k] * seen->size + seen->middle[k];
            view->points[*corner][k] = (float)at;
            view->low[k] = fmin(view->low[k], at);
            view->high[k] = fmax(view->high[k], at);
        }
        depths[*corner] = (float)(p[2] * seen->size);
        view->edges[(*corner)++] = side == TN_CUT ? TN_EDGE_NONE : seen->display->edges[side];
    }
}

static tn_status keep(tn_view *view, const projection *seen, const tn_painting *painting, float **depths,
                      tn_error *error)
{
    size_t corners = 0;
    uint32_t corner = 0;
    for (size_t i = 0; i < painting->patch_count; i++)
        corners += painting->patches[i].count;
    view->faces = malloc((painting->patch_count + 1) * sizeof *view->faces);
    view->points = malloc((corners + 1) * sizeof *view->points);
    view->edges = malloc((corners + 1) * sizeof *view->edges);
    *depths = malloc((corners + 1) * sizeof **depths);
    if (!view->faces || !view->points || !view->edges || !*depths)
        return tn_fail_memory(error);
    for (int k = 0; k < 2; k++) { /* where there is nothing to see, the frame is about 0 */
        view->low[k] = painting->patch_count ? INFINITY : 0;
        view->high[k] = painting->patch_count ? -INFINITY : 0;
    }
    view->by_depth = painting->by_depth;
    for (size_t i = 0; i < painting->patch_count; i++)
        keep_patch(view, seen, painting, &painting->patches[i], *depths, &corner);
    return TN_OK;
}

/* ---- views from all around */

/* What shows a form at every azimuth, about the upright axis through its middle. */
typedef struct round_frame {
    double low[3], high[3]; /* of the form */
    double radius;          /* about the axis */
} round_frame;

static round_frame frame_of(const tn_display_list *display)
{
    round_frame f = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    for (uint32_t c = 0; c < display->first[display->face_count]; c++)
        for (int k = 0; k < 3; k++) {
            f.low[k] = fmin(f.low[k], display->points[c][k]);
            f.high[k] = fmax(f.high[k], display->points[c][k]);
        }
    return f;
}

/* Puts the axis at the origin. */
static void centre_points(round_frame *f, double (*points)[3], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++)
            points[i][k] -= (f->low[k] + f->high[k]) / 2;
        f->radius = fmax(f->radius, hypot(points[i][0], points[i][1]));
        f->low[2] = fmin(f->low[2], points[i][2]);
        f->high[2] = fmax(f->high[2], points[i][2]);
    }
}

/* Guides may make the frame twice as large. */
static round_frame centre(tn_display_list *display)
{
    round_frame f = frame_of(display), around;
    centre_points(&f, display->points, display->first[display->face_count]);
    around = f;
    centre_points(&around, display->guides.points, display->guides.point_count);
    double size = fmax(2 * f.radius, f.high[2] - f.low[2]);
    f.radius = fmin(around.radius, f.radius + size / 2);
    f.low[2] = fmax(around.low[2], f.low[2] - size / 2);
    f.high[2] = fmin(around.high[2], f.high[2] + size / 2);
    return f;
}

static void set_frame(tn_view *view, const round_frame *f, const tn_eye *eye)
{
    double tilt = fabs(eye->towards.z) * f->radius;
    view->low[0] = -f->radius;
    view->high[0] = f->radius;
    view->low[1] = f->low[2] * eye->up.z - tilt;
    view->high[1] = f->high[2] * eye->up.z + tilt;
}

tn_status tn_view_take(tn_display_list *display, const tn_camera *camera, tn_view **result, tn_error *error)
{
    tn_view *view = calloc(1, sizeof *view);
    *result = NULL;
    if (!view)
        return tn_fail_memory(error);
    view->width = camera->width > 0 ? camera->width : 480;
    view->step = display->step;
    tn_eye eye = tn_camera_eye(camera);
    projection seen;
    tn_painting painting = {0};
    round_frame frame = {0};
    float *depths = NULL; /* [corner] */
    if (display->turns && display->face_count)
        frame = centre(display);
    tn_status status = look(display, &eye, &seen, error);
    if (status == TN_OK)
        status = tn_painting_make(&seen.scene, &painting, error);
    if (status == TN_OK)
        status = keep(view, &seen, &painting, &depths, error);
    if (status == TN_OK)
        status = tn_view_join(view, error);
    if (status == TN_OK)
        status = tn_view_find_meets(view, depths, error);
    for (int k = 0; k < 2 && status == TN_OK; k++)
        view->extent[k] = view->high[k] - view->low[k];
    if (status == TN_OK)
        status = tn_view_take_guides(view, &display->guides, &eye, error);
    if (status == TN_OK && frame.radius > 0)
        set_frame(view, &frame, &eye);
    tn_painting_clear(&painting);
    free(depths);
    free(seen.light);
    free(seen.plane);
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
