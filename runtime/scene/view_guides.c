/* Paints what explains a form: areas below it; lines, arrows, marks and texts over it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/scene/view_parts.h"

#define MARK 3.2       /* points: half of how large a mark is */
#define ARROW_HEAD 5.0 /* points */
#define TEXT_SIZE 7.0
#define MARGIN 12.0 /* of a view, that texts may use */

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
tn_status tn_view_take_guides(tn_view *view, const tn_guides *guides, const tn_eye *eye, tn_error *error)
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

static void set_colour(tn_paint *paint, colour c, double opacity)
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

void tn_view_paint_areas(tn_paint *paint, const tn_view *view, const tn_view_place *place)
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
        set_colour(paint, ground ? ground_colour : boundary_colour, ground ? 0.10 : 0.14);
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
    set_colour(paint, boundary_colour, 0.45);
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
    set_colour(paint, arrow_colour, 0.9);
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
        set_colour(paint, attractor_colour, 0.95);
        tn_paint_fill(paint);
        return;
    }
    tn_paint_colour(paint, 1, 1, 1);
    tn_paint_fill_keep(paint);
    set_colour(paint, repeller_colour, 0.95);
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

void tn_view_paint_marks(tn_paint *paint, const tn_view *view, const tn_view_place *place, bool brief)
{
    double most = place->x + view->high[0] * place->scale + MARGIN;
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
