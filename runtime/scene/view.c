/* Takes views of faces: turns them before the eye, finds what hides what, and keeps what is to be painted; and draws
 * views side by side on a sheet. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/geometry/hidden/hidden.h"
#include "runtime/geometry/mesh.h"
#include "runtime/geometry/vector.h"
#include "runtime/math/elementary.h"
#include "runtime/scene/seen.h"

/* ==== paints what explains a form: areas below it; lines, arrows, marks and texts over it */

#define MARK 3.2       /* points: half of how large a mark is */
#define ARROW_HEAD 5.0 /* points */
#define TEXT_SIZE 7.0
#define TEXT_MARGIN 12.0 /* of a view, that texts may use */

enum { POINTS_MAX = 64 }; /* of one guide */

typedef struct colour {
    double r, g, b;
} colour;

static const colour attractor_colour = {0.10, 0.48, 0.22}, repeller_colour = {0.76, 0.16, 0.14},
                    arrow_colour = {0.20, 0.20, 0.24}, boundary_colour = {0.18, 0.36, 0.68},
                    ground_colour = {0.35, 0.32, 0.26};

/* The view grows to show a point, as far as it may. */
static void widen(tn_view *view, const double most[2][2], tn_vector seen)
{
    const double at[2] = {seen.x, seen.y};
    for (int k = 0; k < 2; k++) {
        view->low[k] = fmin(view->low[k], fmax(at[k], most[0][k]));
        view->high[k] = fmax(view->high[k], fmin(at[k], most[1][k]));
    }
}

/* What is shown around a form takes no more than its size on each side, so that the form is not lost in it. */
static tn_status view_take_guides(tn_view *view, const tn_guides *guides, const tn_eye *eye, tn_error *error)
{
    double size = fmax(view->high[0] - view->low[0], view->high[1] - view->low[1]);
    const double most[2][2] = {{view->low[0] - size, view->low[1] - size},
                               {view->high[0] + size, view->high[1] + size}};
    for (size_t i = 0; i < guides->count; i++) {
        tn_vector seen[POINTS_MAX];
        const tn_guide *guide = &guides->items[i];
        uint32_t count = guide->count < POINTS_MAX ? guide->count : POINTS_MAX;
        for (uint32_t p = 0; p < count; p++) {
            seen[p] = tn_eye_sees(eye, tn_vector_at(guides->points[guide->first + p]));
            widen(view, most, seen[p]);
        }
        if (!tn_guides_add(&view->guides, *guide, seen, count))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

static void set_guide_colour(tn_paint *paint, colour c, double opacity)
{
    tn_paint_translucent(paint, c.r, c.g, c.b, opacity);
}

/* Where a guide's point is on the page. */
static void place_point(const tn_view *view, const tn_view_place *place, const tn_guide *guide, uint32_t i,
                        double at[2])
{
    const double *p = view->guides.points[guide->first + i];
    at[0] = place->x + p[0] * place->scale;
    at[1] = place->y - p[1] * place->scale;
}

/* ---- areas */

/* Twice the polygon's area: positive where it runs counter-clockwise before the eye. */
static double turn_of(const tn_view *view, const tn_guide *guide)
{
    double sum = 0;
    for (uint32_t i = 0; i < guide->count; i++) {
        const double *p = view->guides.points[guide->first + i],
                     *q = view->guides.points[guide->first + (i + 1) % guide->count];
        sum += p[0] * q[1] - q[0] * p[1];
    }
    return sum;
}

/* All polygons run the same way round, so that what they cover together is filled once. */
static void outline(tn_paint *paint, const tn_view *view, const tn_view_place *place, const tn_guide *guide)
{
    bool backwards = turn_of(view, guide) < 0;
    tn_paint_new_sub_path(paint);
    for (uint32_t i = 0; i < guide->count; i++) {
        double at[2];
        place_point(view, place, guide, backwards ? guide->count - 1 - i : i, at);
        tn_paint_line_to(paint, at[0], at[1]);
    }
    tn_paint_close_path(paint);
}

/* Of a shape whose areas begin before: an area of it, or what lies among them. */
static bool is_part(const tn_guide *guide, uint32_t whole)
{
    return guide->kind != TN_GUIDE_AREA || guide->whole == whole;
}

/* Paint them: what is filled, below the form; lines, marks and texts over it. `brief`: values without their names. */
static void view_paint_areas(tn_paint *paint, const tn_view *view, const tn_view_place *place)
{
    const tn_guide *items = view->guides.items;
    tn_paint_save(paint);
    tn_paint_even_odd(paint, false);
    for (size_t i = 0, end; i < view->guides.count; i = end) {
        end = i + 1;
        if (items[i].kind != TN_GUIDE_AREA)
            continue;
        tn_paint_new_path(paint);
        outline(paint, view, place, &items[i]);
        for (; end < view->guides.count && is_part(&items[end], items[i].whole); end++)
            if (items[end].kind == TN_GUIDE_AREA)
                outline(paint, view, place, &items[end]);
        bool ground = items[i].subject == TN_GUIDE_GROUND;
        set_guide_colour(paint, ground ? ground_colour : boundary_colour, ground ? 0.10 : 0.14);
        tn_paint_fill(paint);
    }
    tn_paint_restore(paint);
}

/* ---- lines and marks */

static void stroke_line(tn_paint *paint, const tn_view *view, const tn_view_place *place, const tn_guide *guide)
{
    static const double dash = 3;
    tn_paint_new_path(paint);
    for (uint32_t i = 0; i < guide->count; i++) {
        double at[2];
        place_point(view, place, guide, i, at);
        tn_paint_line_to(paint, at[0], at[1]);
    }
    set_guide_colour(paint, boundary_colour, 0.45);
    tn_paint_dash(paint, &dash, guide->dashed, 0);
    tn_paint_line_width(paint, 0.6);
    tn_paint_stroke(paint);
    tn_paint_dash(paint, NULL, 0, 0);
}

/* An arrow that would be a point, because it runs towards the eye, has its head all the same. */
static void draw_arrow(tn_paint *paint, const double from[2], const double to[2])
{
    double along[2] = {to[0] - from[0], to[1] - from[1]}, length = hypot(along[0], along[1]);
    for (int k = 0; k < 2; k++)
        along[k] = length > 1e-9 ? along[k] / length : k;
    double neck[2] = {to[0] - along[0] * ARROW_HEAD, to[1] - along[1] * ARROW_HEAD};
    set_guide_colour(paint, arrow_colour, 0.9);
    tn_paint_line_width(paint, 1.1);
    tn_paint_move_to(paint, from[0], from[1]);
    tn_paint_line_to(paint, neck[0], neck[1]);
    tn_paint_stroke(paint);
    tn_paint_move_to(paint, to[0], to[1]);
    tn_paint_line_to(paint, neck[0] - along[1] * ARROW_HEAD / 2.5, neck[1] + along[0] * ARROW_HEAD / 2.5);
    tn_paint_line_to(paint, neck[0] + along[1] * ARROW_HEAD / 2.5, neck[1] - along[0] * ARROW_HEAD / 2.5);
    tn_paint_close_path(paint);
    tn_paint_fill(paint);
}

/* A full disc pulls; a ring with a hole pushes. */
static void draw_mark(tn_paint *paint, bool pulls, const double at[2])
{
    static const double whole = 6.283185307179586;
    tn_paint_new_path(paint);
    tn_paint_arc(paint, at[0], at[1], MARK, 0, whole);
    if (pulls) {
        set_guide_colour(paint, attractor_colour, 0.95);
        tn_paint_fill(paint);
        return;
    }
    tn_paint_colour(paint, 1, 1, 1);
    tn_paint_fill_keep(paint);
    set_guide_colour(paint, repeller_colour, 0.95);
    tn_paint_line_width(paint, 1.4);
    tn_paint_stroke(paint);
}

/* To the right of the mark, or to its left where the right border, `most`, is near. */
static void write_text(tn_paint *paint, const tn_guide *guide, const double at[2], double most, bool brief)
{
    char text[64];
    if (!guide->name || (brief && guide->kind == TN_GUIDE_ARROW))
        return;
    snprintf(text, sizeof text, brief ? "%.0s%.4g" : "%s %.4g", guide->name, guide->value);
    tn_paint_colour(paint, 0.2, 0.2, 0.22);
    tn_paint_face(paint, TEXT_SIZE, false);
    bool left = at[0] + MARK + 2 + tn_type_width(paint, text) > most;
    tn_type_line(paint, left ? at[0] - MARK - 2 : at[0] + MARK + 2, at[1] + TEXT_SIZE / 3,
                 left ? TN_ALIGN_RIGHT : TN_ALIGN_LEFT, text);
    tn_paint_new_path(paint);
}

static void view_paint_marks(tn_paint *paint, const tn_view *view, const tn_view_place *place, bool brief)
{
    double most = place->x + view->high[0] * place->scale + TEXT_MARGIN;
    tn_paint_save(paint);
    for (size_t i = 0; i < view->guides.count; i++) {
        const tn_guide *guide = &view->guides.items[i];
        double at[2], to[2];
        if (guide->kind == TN_GUIDE_AREA)
            continue;
        if (guide->kind == TN_GUIDE_LINE) {
            stroke_line(paint, view, place, guide);
            continue;
        }
        place_point(view, place, guide, 0, at);
        place_point(view, place, guide, guide->count - 1, to);
        if (guide->kind == TN_GUIDE_ARROW)
            draw_arrow(paint, at, to);
        else
            draw_mark(paint, guide->kind == TN_GUIDE_ATTRACTOR, at);
        write_text(paint, guide, at, most, brief);
    }
    tn_paint_restore(paint);
}

/* ==== takes views of faces: turns them before the eye, finds what hides what, and keeps what is to be painted */

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
        status = view_take_guides(view, &display->guides, &eye, error);
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

/* ==== draws views side by side on a sheet, with a legend of what their colours mean */

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
    view_paint_areas(paint, view, &place);
    tn_view_paint(canvas, view, &place);
    view_paint_marks(paint, view, &place, s->columns > 1 || s->rows > 1);
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
