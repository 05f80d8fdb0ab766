/* Finds the edges of a house that a drawing shows, gives them their weights, and makes one line of those that lie in
 * one. */
#include "runtime/house/model/lines.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/visible.h"

#define TOLERANCE_NM 1000.0
#define TOUCH_NM 3000.0 /* what hides a line takes so much of what goes on beside it, at either end */
#define TURN 1e-6       /* of two lines in one direction, at most */

const int tn_line_weight_widths[TN_STROKE_WEIGHTS] = {
    [TN_STROKE_CUT] = 50, [TN_STROKE_SEEN] = 35, [TN_STROKE_THIN] = 25, [TN_STROKE_HATCH] = 18};

/* ---- edges that are seen */

/* How near the plane of the cut is to the eye; INFINITY where nothing is cut. */
static double cut_depth(const tn_seen_line *lines, size_t count, bool cut)
{
    double depth = -INFINITY;
    for (size_t i = 0; i < count; i++)
        depth = fmax(depth, fmax(lines[i].from[2], lines[i].to[2]));
    return cut ? depth - TOLERANCE_NM : INFINITY;
}

static tn_drawn_line drawn_as(const tn_mesh *mesh, const tn_seen_line *seen, bool cut, const tn_line_weights *weights)
{
    uint32_t groups[2] = {mesh->face_group[seen->face], mesh->face_group[seen->other]};
    tn_line_weight own = weights->of(weights->context, groups[0], cut),
                   other = weights->of(weights->context, groups[1], cut);
    return (tn_drawn_line){.at = {{seen->from[0], seen->from[1]}, {seen->to[0], seen->to[1]}},
                           .weight = other < own ? other : own,
                           .group = groups[other < own],
                           .cut = cut};
}

tn_status tn_house_lines(const tn_mesh *mesh, const tn_camera *camera, bool cut, const tn_line_weights *weights,
                         tn_drawn_line **lines, size_t *count, tn_error *error)
{
    tn_eye eye = tn_camera_eye(camera);
    tn_seen_line *seen = NULL;
    size_t seen_count = 0;
    *lines = NULL;
    *count = 0;
    tn_status status = tn_mesh_visible(mesh, &eye, TOLERANCE_NM, &seen, &seen_count, error);
    if (status == TN_OK && !(*lines = malloc((seen_count + 1) * sizeof **lines)))
        status = tn_fail_memory(error);
    double depth = cut_depth(seen, status == TN_OK ? seen_count : 0, cut);
    for (size_t i = 0; status == TN_OK && i < seen_count; i++)
        (*lines)[(*count)++] = drawn_as(mesh, &seen[i], seen[i].from[2] > depth && seen[i].to[2] > depth, weights);
    free(seen);
    return status;
}

/* ---- lines that lie in one */

/* A line as it lies along its direction: how far from the origin, and from where to where. */
typedef struct laid_line {
    double angle, offset, from, to;
    tn_drawn_line line;
    uint32_t key; /* of what may become one line */
} laid_line;

static int compare(double x, double y)
{
    return x < y ? -1 : x > y;
}

static int by_angle(const void *a, const void *b)
{
    const laid_line *x = a, *y = b;
    return x->key != y->key ? (x->key < y->key ? -1 : 1) : compare(x->angle, y->angle);
}

static int by_offset(const void *a, const void *b)
{
    return compare(((const laid_line *)a)->offset, ((const laid_line *)b)->offset);
}

static int by_start(const void *a, const void *b)
{
    const laid_line *x = a, *y = b;
    return x->from != y->from ? compare(x->from, y->from) : compare(x->to, y->to);
}

static void swap_ends(tn_drawn_line *line)
{
    for (int k = 0; k < 2; k++) {
        double first = line->at[0][k];
        line->at[0][k] = line->at[1][k];
        line->at[1][k] = first;
    }
}

/* Its ends in order: to the right where it is level, otherwise upwards. */
static laid_line lay(tn_drawn_line line, bool grouped)
{
    double du = line.at[1][0] - line.at[0][0], dv = line.at[1][1] - line.at[0][1];
    bool level = fabs(dv) < TURN * fabs(du);
    if (level ? du < 0 : dv < 0)
        swap_ends(&line);
    uint32_t key = (uint32_t)line.weight;
    return (laid_line){.angle = level ? 0 : atan2(fabs(dv), dv < 0 ? -du : du),
                       .line = line,
                       .key = grouped ? key << 24 | line.group << 1 | line.cut : key};
}

/* Along the direction of the first of a run of lines that have nearly the same. */
static void turn_run(laid_line *run, size_t count)
{
    double du = run[0].line.at[1][0] - run[0].line.at[0][0], dv = run[0].line.at[1][1] - run[0].line.at[0][1],
           length = hypot(du, dv);
    for (size_t i = 0; i < count; i++) {
        const double(*at)[2] = (const double(*)[2])run[i].line.at;
        run[i].offset = (at[0][1] * du - at[0][0] * dv) / length;
        run[i].from = (at[0][0] * du + at[0][1] * dv) / length;
        run[i].to = (at[1][0] * du + at[1][1] * dv) / length;
    }
    qsort(run, count, sizeof *run, by_offset);
}

/* Those at one distance from the origin: appends what they come to. */
static size_t join(laid_line *run, size_t count, tn_drawn_line *lines, size_t used)
{
    qsort(run, count, sizeof *run, by_start);
    for (size_t i = 0, next; i < count; i = next) {
        const laid_line *last = &run[i];
        for (next = i + 1; next < count && run[next].from <= last->to + TOUCH_NM; next++)
            last = run[next].to > last->to ? &run[next] : last;
        tn_drawn_line line = run[i].line;
        for (int k = 0; k < 2; k++)
            line.at[1][k] = last->line.at[1][k];
        lines[used++] = line;
    }
    return used;
}

tn_status tn_lines_merge(tn_drawn_line *lines, size_t *count, bool grouped, tn_error *error)
{
    laid_line *laid = malloc((*count + 1) * sizeof *laid);
    size_t used = 0;
    if (!laid)
        return tn_fail_memory(error);
    for (size_t i = 0; i < *count; i++)
        laid[i] = lay(lines[i], grouped);
    qsort(laid, *count, sizeof *laid, by_angle);
    for (size_t i = 0, end; i < *count; i = end) {
        for (end = i + 1; end < *count && laid[end].key == laid[i].key && laid[end].angle - laid[i].angle < TURN;)
            end++;
        turn_run(laid + i, end - i);
        for (size_t k = i, next; k < end; k = next) {
            for (next = k + 1; next < end && laid[next].offset - laid[next - 1].offset < 2 * TOLERANCE_NM;)
                next++;
            used = join(laid + k, next - k, lines, used);
        }
    }
    free(laid);
    *count = used;
    return TN_OK;
}
