/* Works out frames and normals by rows. */
#include <stdbool.h>

#include "runtime/growth/pass/rows.h"

/* ---- finds the directions of branches in rows of edges */

#define SHORT 1e-300 /* edges up to here have no heading of their own */
#define STEEP 1e-18  /* square of what is left of a normal beside the heading: up to here it has no direction */

/* U is the sum of the faces' normals made normal to H; `square` is its square before it is made a unit. Holds where
 * is_plain says so. Without branches, so that many are worked out in one go. */
static inline tn_axes work_out(tn_vector from, tn_vector to, tn_vector left, tn_vector right, double *square)
{
    tn_vector h = tn_sub(to, from), both = tn_add(left, right);
    double length = tn_norm(h);
    h = tn_scale(h, 1 / length);
    tn_vector up = tn_along(both, h, -tn_dot(both, h));
    *square = tn_dot(up, up);
    up = tn_scale(up, 1 / sqrt(*square));
    return (tn_axes){h, tn_cross(up, h), up, length};
}

static inline bool is_plain(double length, double square)
{
    return length > SHORT && square > STEEP;
}

/* Where the normals cancel or are along H, U is of the left face's, of z, then away from the seed's axis: what is the
 * same on both sides of a mirror stays so. On the axis itself there is no such direction, and the path stays on the
 * edge. */
static tn_vector up_of(tn_vector left, tn_vector right, tn_vector heading, tn_vector outward)
{
    tn_vector candidates[] = {tn_add(left, right), left, {0, 0, 1}, outward};
    for (int i = 0; i < 4; i++) {
        tn_vector up = tn_along(candidates[i], heading, -tn_dot(candidates[i], heading));
        double square = tn_dot(up, up);
        if (square > STEEP)
            return tn_scale(up, 1 / sqrt(square));
    }
    return (tn_vector){0, 0, 0};
}

tn_axes tn_axes_of(tn_vector from, tn_vector to, tn_vector left, tn_vector right, tn_vector centre)
{
    double square;
    tn_axes axes = work_out(from, to, left, right, &square);
    if (is_plain(axes.length, square))
        return axes;
    if (axes.length <= SHORT)
        axes.heading = (tn_vector){1, 0, 0};
    tn_vector outward = tn_sub(tn_scale(tn_add(from, to), 0.5), centre);
    axes.up = up_of(left, right, axes.heading, (tn_vector){outward.x, outward.y, 0});
    axes.left = tn_cross(axes.up, axes.heading);
    return axes;
}

static inline void put_axes(tn_axes_rows *rows, uint32_t i, const tn_axes *axes)
{
    tn_rows_put(rows->heading, i, axes->heading);
    tn_rows_put(rows->left, i, axes->left);
    tn_rows_put(rows->up, i, axes->up);
    rows->length[i] = axes->length;
}

TN_INLINED void work_out_some(tn_axes_rows *restrict rows, double *restrict squares, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tn_axes axes = work_out(tn_rows_at(rows->from, i), tn_rows_at(rows->to, i), tn_rows_at(rows->left_normal, i),
                                tn_rows_at(rows->right_normal, i), &squares[i]);
        put_axes(rows, i, &axes);
    }
}

TN_ANY_WIDTH static void work_out_rows(tn_axes_rows *restrict rows, double *restrict squares, uint32_t count)
{
    TN_EACH_LENGTH(count, work_out_some, rows, squares);
}

void tn_axes_of_rows(tn_axes_rows *rows, uint32_t count, tn_vector centre)
{
    tn_row squares;
    tn_rows_fill(rows->from, count);
    tn_rows_fill(rows->to, count);
    tn_rows_fill(rows->left_normal, count);
    tn_rows_fill(rows->right_normal, count);
    work_out_rows(rows, squares, count);
    for (uint32_t i = 0; i < count; i++) {
        if (is_plain(rows->length[i], squares[i]))
            continue;
        tn_axes axes = tn_axes_of(tn_rows_at(rows->from, i), tn_rows_at(rows->to, i), tn_rows_at(rows->left_normal, i),
                                  tn_rows_at(rows->right_normal, i), centre);
        put_axes(rows, i, &axes);
    }
}

TN_INLINED void turn_some(const tn_axes_rows *restrict rows, const double turn[3], tn_row *restrict result,
                          uint32_t count)
{
    const double along = turn[0], left = turn[1], up = turn[2];
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < count; i++)
            result[k][i] = rows->heading[k][i] * along + rows->left[k][i] * left + rows->up[k][i] * up;
}

TN_ANY_WIDTH void tn_axes_turn(const tn_axes_rows *restrict rows, uint32_t count, const double turn[3],
                               tn_row *restrict result)
{
    TN_EACH_LENGTH(count, turn_some, rows, turn, result);
}

TN_INLINED void place_some(const tn_axes_rows *restrict rows, const double turn[3], tn_row *restrict result,
                           uint32_t count)
{
    turn_some(rows, turn, result, count);
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < count; i++)
            result[k][i] = rows->from[k][i] + result[k][i] * rows->length[i];
}

TN_ANY_WIDTH void tn_axes_place(const tn_axes_rows *restrict rows, uint32_t count, const double turn[3],
                                tn_row *restrict result)
{
    TN_EACH_LENGTH(count, place_some, rows, turn, result);
}

/* ---- finds the normals of faces in rows */

#define FLAT                                                                                                           \
    1e-12 /* of the squares of a face's extent: a face this flat has no normal, rather than one that rounding chose */
#define MANY 5u /* faces; fewer are sooner done one by one */

/* Newell's sum for one more point of each face. Points are taken relative to the first, so that a face far from the
 * origin keeps its precision. */
TN_INLINED void add_some(tn_normals *restrict n, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tn_vector a = tn_rows_at(n->before, i), b = tn_sub(tn_rows_at(n->point, i), tn_rows_at(n->first, i));
        tn_rows_put(n->sum, i, tn_add(tn_rows_at(n->sum, i), tn_cross(a, b)));
        tn_rows_put(n->before, i, b);
        n->span[i] += tn_dot(b, b);
    }
}

TN_ANY_WIDTH static void add_points(tn_normals *restrict n)
{
    TN_EACH_LENGTH(n->count, add_some, n);
}

/* Sums become units; `before` gets their squares. */
TN_INLINED void make_some(tn_normals *restrict n, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tn_vector sum = tn_rows_at(n->sum, i);
        double square = tn_dot(sum, sum);
        n->before[0][i] = square;
        tn_rows_put(n->sum, i, tn_scale(sum, 1 / sqrt(square)));
    }
}

TN_ANY_WIDTH static void make_units(tn_normals *restrict n)
{
    TN_EACH_LENGTH(n->count, make_some, n);
}

static void gather(const tn_normals *n, uint32_t corner, tn_row *points)
{
    const tn_map *map = n->map;
    for (uint32_t i = 0; i < n->count; i++) {
        uint32_t vertex = map->origin[n->darts[i] + corner];
        tn_rows_put(points, i, tn_vector_at(map->positions + 3 * (size_t)vertex));
    }
    tn_rows_fill(points, n->count);
}

static bool is_flat(double square, double span)
{
    return !(square > FLAT * FLAT * span * span && sqrt(square) > 1e-300);
}

/* The same for one face. */
static tn_vector normal_of(const tn_map *map, uint32_t face)
{
    const uint32_t *origin = map->origin + map->face_first[face];
    uint32_t size = tn_face_size(map, face);
    tn_vector first = tn_vector_at(map->positions + 3 * (size_t)origin[0]), n = {0, 0, 0}, before = {0, 0, 0};
    double span = 0;
    for (uint32_t i = 1; i < size; i++) {
        tn_vector p = tn_sub(tn_vector_at(map->positions + 3 * (size_t)origin[i]), first);
        n = tn_add(n, tn_cross(before, p));
        span += tn_dot(p, p);
        before = p;
    }
    double square = tn_dot(n, n);
    return is_flat(square, span) ? (tn_vector){0, 0, 0} : tn_scale(n, 1 / sqrt(square));
}

static void find_together(tn_normals *n)
{
    gather(n, 0, n->first);
    for (uint32_t i = 0; i < tn_row_length(n->count); i++) {
        tn_rows_put(n->before, i, (tn_vector){0, 0, 0});
        tn_rows_put(n->sum, i, (tn_vector){0, 0, 0});
        n->span[i] = 0;
    }
    for (uint32_t corner = 1; corner < n->size; corner++) {
        gather(n, corner, n->point);
        add_points(n);
    }
    make_units(n);
    for (uint32_t i = 0; i < n->count; i++) {
        tn_vector normal = is_flat(n->before[0][i], n->span[i]) ? (tn_vector){0, 0, 0} : tn_rows_at(n->sum, i);
        tn_vector_put(n->normals + 3 * (size_t)n->faces[i], normal);
    }
}

void tn_normals_finish(tn_normals *n)
{
    if (n->count >= MANY)
        find_together(n);
    else
        for (uint32_t i = 0; i < n->count; i++)
            tn_vector_put(n->normals + 3 * (size_t)n->faces[i], normal_of(n->map, n->faces[i]));
    n->count = 0;
}

void tn_normals_start(tn_normals *n, const tn_map *map, double *normals)
{
    n->map = map;
    n->normals = normals;
    n->count = n->size = 0;
}

void tn_normals_add(tn_normals *n, uint32_t face)
{
    uint32_t size = tn_face_size(n->map, face);
    if (size != n->size) {
        tn_normals_finish(n);
        n->size = size;
    }
    n->faces[n->count] = face;
    n->darts[n->count] = n->map->face_first[face];
    if (++n->count == TN_ROW)
        tn_normals_finish(n);
}
