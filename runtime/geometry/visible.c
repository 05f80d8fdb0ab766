/* Removes hidden lines: cuts each crease where triangles hide it. */
#include "runtime/geometry/visible.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/geometry/edges.h"

/* A triangle that faces the eye, before it. */
typedef struct screen {
    double low[3], high[3];
    double at[3][3];
    double slope[2], height; /* depth = height + slope . (u, v) */
} screen;

/* A part of a line, from 0 to 1 along it. */
typedef struct shade {
    double from, to;
} shade;

typedef struct looking {
    const tn_mesh *mesh;
    double (*points)[3]; /* [vertex] before the eye; owned */
    screen *screens;     /* by their low u; owned */
    size_t screen_count;
    shade *shades; /* of the line at hand; owned */
    size_t shade_count, shade_room;
    double tolerance;
    uint32_t face, other; /* of the line at hand */
    tn_seen_line *lines;
    size_t line_count, line_room;
} looking;

static int by_low(const void *a, const void *b)
{
    double x = ((const screen *)a)->low[0], y = ((const screen *)b)->low[0];
    return x < y ? -1 : x > y;
}

/* False if it looks away from the eye or is seen as a line. */
static bool make_screen(const looking *l, size_t face, screen *s)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            s->at[i][k] = l->points[l->mesh->corners[3 * face + (size_t)i]][k];
    for (int k = 0; k < 3; k++) {
        s->low[k] = fmin(s->at[0][k], fmin(s->at[1][k], s->at[2][k]));
        s->high[k] = fmax(s->at[0][k], fmax(s->at[1][k], s->at[2][k]));
    }
    tn_vector a = tn_sub(tn_vector_at(s->at[1]), tn_vector_at(s->at[0])),
              b = tn_sub(tn_vector_at(s->at[2]), tn_vector_at(s->at[0])), n = tn_cross(a, b);
    if (!(n.z > 1e-9 * tn_norm(n)))
        return false;
    s->slope[0] = -n.x / n.z;
    s->slope[1] = -n.y / n.z;
    s->height = s->at[0][2] - s->slope[0] * s->at[0][0] - s->slope[1] * s->at[0][1];
    return true;
}

/* Keeps the part of [*from, *to] in which a + t (b - a) is at least `least`. */
static void clip(double a, double b, double least, double *from, double *to)
{
    if (a >= least && b >= least)
        return;
    if (a < least && b < least) {
        *to = *from - 1;
        return;
    }
    double t = (least - a) / (b - a);
    if (a < least)
        *from = fmax(*from, t);
    else
        *to = fmin(*to, t);
}

/* The part of a line that a triangle hides; false for none. Lines along its sides are hidden too: its own side is seen
 * there. */
static bool hides(const looking *l, const screen *s, const double p[3], const double q[3], shade *hidden)
{
    double from = 0, to = 1;
    for (int i = 0; i < 3 && from < to; i++) {
        const double *a = s->at[i], *b = s->at[(i + 1) % 3];
        double du = b[0] - a[0], dv = b[1] - a[1], length = sqrt(du * du + dv * dv);
        if (length == 0)
            continue;
        clip((du * (p[1] - a[1]) - dv * (p[0] - a[0])) / length, (du * (q[1] - a[1]) - dv * (q[0] - a[0])) / length,
             -l->tolerance, &from, &to);
    }
    double over_p = s->height + s->slope[0] * p[0] + s->slope[1] * p[1] - p[2],
           over_q = s->height + s->slope[0] * q[0] + s->slope[1] * q[1] - q[2];
    clip(over_p, over_q, l->tolerance, &from, &to);
    *hidden = (shade){from, to};
    return from < to;
}

static int by_from(const void *a, const void *b)
{
    double x = ((const shade *)a)->from, y = ((const shade *)b)->from;
    return x < y ? -1 : x > y;
}

static bool add_line(looking *l, const double p[3], const double q[3], double from, double to)
{
    double length = sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]));
    if ((to - from) * length <= 2 * l->tolerance)
        return true;
    if (!tn_array_reserve_from(&l->lines, &l->line_room, 256, l->line_count, 1, sizeof *l->lines))
        return false;
    tn_seen_line *line = &l->lines[l->line_count++];
    line->face = l->face;
    line->other = l->other;
    for (int k = 0; k < 3; k++) {
        line->from[k] = p[k] + from * (q[k] - p[k]);
        line->to[k] = p[k] + to * (q[k] - p[k]);
    }
    return true;
}

static bool cut_line(looking *l, const double p[3], const double q[3])
{
    double left = fmin(p[0], q[0]), right = fmax(p[0], q[0]), bottom = fmin(p[1], q[1]), top = fmax(p[1], q[1]);
    double near = fmin(p[2], q[2]);
    l->shade_count = 0;
    for (size_t i = 0; i < l->screen_count && l->screens[i].low[0] <= right + l->tolerance; i++) {
        const screen *s = &l->screens[i];
        if (s->high[0] < left - l->tolerance || s->high[1] < bottom - l->tolerance || s->low[1] > top + l->tolerance ||
            s->high[2] <= near)
            continue;
        if (!tn_array_reserve_from(&l->shades, &l->shade_room, 64, l->shade_count, 1, sizeof *l->shades))
            return false;
        l->shade_count += hides(l, s, p, q, &l->shades[l->shade_count]);
    }
    if (l->shade_count)
        qsort(l->shades, l->shade_count, sizeof *l->shades, by_from);
    double seen = 0;
    for (size_t i = 0; i < l->shade_count; i++) {
        if (l->shades[i].from > seen && !add_line(l, p, q, seen, l->shades[i].from))
            return false;
        seen = fmax(seen, l->shades[i].to);
    }
    return seen >= 1 || add_line(l, p, q, seen, 1);
}

static tn_status prepare(looking *l, const tn_eye *eye, tn_error *error)
{
    const tn_mesh *mesh = l->mesh;
    l->points = malloc((mesh->vertex_count + 1) * sizeof *l->points);
    l->screens = malloc((mesh->face_count + 1) * sizeof *l->screens);
    if (!l->points || !l->screens)
        return tn_fail_memory(error);
    for (size_t v = 0; v < mesh->vertex_count; v++)
        tn_vector_put(l->points[v], tn_eye_sees(eye, tn_vector_at(mesh->positions + 3 * v)));
    for (size_t f = 0; f < mesh->face_count; f++)
        l->screen_count += make_screen(l, f, &l->screens[l->screen_count]);
    if (l->screen_count)
        qsort(l->screens, l->screen_count, sizeof *l->screens, by_low);
    return TN_OK;
}

static bool faces_eye(const looking *l, size_t face)
{
    screen s;
    return make_screen(l, face, &s);
}

/* Each crease once: from the side of the triangle whose corner has the lower number. */
static tn_status cut_all(looking *l, const bool *creases, const uint32_t *twins, tn_error *error)
{
    const tn_mesh *mesh = l->mesh;
    for (size_t c = 0; c < 3 * mesh->face_count; c++) {
        uint32_t a = mesh->corners[c], b = mesh->corners[c % 3 == 2 ? c - 2 : c + 1];
        if (!creases[c] || a >= b)
            continue;
        uint32_t own = (uint32_t)(c / 3), twin = twins[c] == TN_NO_TWIN ? own : twins[c] / 3;
        l->face = faces_eye(l, own) ? own : twin;
        l->other = faces_eye(l, twin) ? twin : l->face;
        if (!cut_line(l, l->points[a], l->points[b]))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

tn_status tn_mesh_visible(const tn_mesh *mesh, const tn_eye *eye, double tolerance, tn_seen_line **lines, size_t *count,
                          tn_error *error)
{
    looking l = {.mesh = mesh, .tolerance = tolerance};
    bool *creases = NULL;
    uint32_t *twins = tn_mesh_twins(mesh);
    tn_status status = twins ? tn_mesh_creases(mesh, &creases, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = prepare(&l, eye, error);
    if (status == TN_OK)
        status = cut_all(&l, creases, twins, error);
    *lines = l.lines;
    *count = l.line_count;
    free(twins);
    free(creases);
    free(l.points);
    free(l.screens);
    free(l.shades);
    return status;
}
