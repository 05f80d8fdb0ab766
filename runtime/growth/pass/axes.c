/* Finds the directions of branches in rows of edges. */
#include "runtime/growth/pass/axes.h"

#include <stdbool.h>

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
