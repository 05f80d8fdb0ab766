/* Areas in a plane: what convex polygons cover, and the convex hull of points. */
#include "runtime/geometry/union/cover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* ---- areas that convex polygons cover: one is laid down, and what others cover of it is cut away along their sides */

/* A convex polygon with any number of corners up to this; a cut adds one at most. What has more is kept whole: then
 * areas come out too large, which takes forty sides that all cross one small piece. */
enum { PIECE_CORNERS = 48 };

typedef struct tn_cover_piece {
    double at[PIECE_CORNERS][2];
    size_t count;
} piece;

bool tn_cover_of(const double (*points)[2], size_t count, tn_cover *cover)
{
    memcpy(cover->at, points, count * sizeof *points);
    cover->count = count;
    if (!tn_hull(cover->at, &cover->count))
        return false;
    for (int k = 0; k < 2; k++) {
        cover->low[k] = INFINITY;
        cover->high[k] = -INFINITY;
        for (size_t i = 0; i < cover->count; i++) {
            cover->low[k] = fmin(cover->low[k], cover->at[i][k]);
            cover->high[k] = fmax(cover->high[k], cover->at[i][k]);
        }
    }
    return true;
}

static piece *add(tn_cover_pieces *work)
{
    if (!tn_array_reserve_from(&work->pieces, &work->room, 16, work->count, 1, sizeof *work->pieces)) {
        work->failed = true;
        return NULL;
    }
    return &work->pieces[work->count++];
}

void tn_cover_begin(tn_cover_pieces *work, const tn_cover *cover)
{
    work->count = 0;
    piece *whole = cover->count >= 3 ? add(work) : NULL;
    if (!whole)
        return;
    whole->count = cover->count;
    memcpy(whole->at, cover->at, cover->count * sizeof *cover->at);
}

static double beyond(const double a[2], const double b[2], const double p[2])
{
    return (b[1] - a[1]) * (p[0] - a[0]) - (b[0] - a[0]) * (p[1] - a[1]); /* above 0: right of a to b, outside */
}

/* The part of p on one side of the line from a to b: outside it, or inside. */
static void half(const piece *p, const double a[2], const double b[2], bool outside, piece *out)
{
    out->count = 0;
    for (size_t i = 0; i < p->count; i++) {
        const double *from = p->at[i], *to = p->at[(i + 1) % p->count];
        double s = beyond(a, b, from), t = beyond(a, b, to);
        if (outside ? s >= 0 : s <= 0)
            memcpy(out->at[out->count++], from, sizeof *out->at);
        if ((s > 0 && t < 0) || (s < 0 && t > 0)) {
            double share = s / (s - t);
            out->at[out->count][0] = from[0] + share * (to[0] - from[0]);
            out->at[out->count++][1] = from[1] + share * (to[1] - from[1]);
        }
    }
}

static double area_of(const piece *p)
{
    return p->count < 3 ? 0 : tn_hull_area((const double(*)[2])p->at, p->count);
}

/* Takes the polygon away from piece i, which is left empty; what lies outside each side in turn becomes pieces. */
static void cut(tn_cover_pieces *work, size_t i, const tn_cover *other)
{
    piece rest = work->pieces[i], part;
    if (rest.count + other->count >= PIECE_CORNERS)
        return;
    work->pieces[i].count = 0;
    for (size_t k = 0; k < other->count && rest.count >= 3; k++) {
        const double *a = other->at[k], *b = other->at[(k + 1) % other->count];
        half(&rest, a, b, true, &part);
        if (area_of(&part) > 0) {
            piece *more = add(work);
            if (!more)
                return;
            *more = part;
        }
        half(&rest, a, b, false, &part);
        rest = part;
    }
}

static bool meets(const piece *p, const tn_cover *other)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < p->count; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p->at[i][k]);
            high[k] = fmax(high[k], p->at[i][k]);
        }
    return p->count >= 3 && low[0] < other->high[0] && other->low[0] < high[0] && low[1] < other->high[1] &&
           other->low[1] < high[1];
}

void tn_cover_less(tn_cover_pieces *work, const tn_cover *other)
{
    size_t before = work->count, kept = 0;
    for (size_t i = 0; i < before && other->count >= 3; i++)
        if (meets(&work->pieces[i], other))
            cut(work, i, other);
    for (size_t i = 0; i < work->count; i++)
        if (work->pieces[i].count >= 3)
            work->pieces[kept++] = work->pieces[i];
    work->count = kept;
}

double tn_cover_left(const tn_cover_pieces *work)
{
    double area = 0;
    for (size_t i = 0; i < work->count; i++)
        area += area_of(&work->pieces[i]);
    return area;
}

static int by_low(const void *a, const void *b)
{
    const tn_cover *p = a, *q = b;
    for (int k = 0; k < 2; k++)
        if (p->low[k] != q->low[k])
            return p->low[k] < q->low[k] ? -1 : 1;
    return p->high[0] < q->high[0] ? -1 : p->high[0] > q->high[0];
}

tn_box_bounds tn_cover_bounds(const tn_cover *cover)
{
    return (tn_box_bounds){{cover->low[0], cover->low[1], 0}, {cover->high[0], cover->high[1], 0}};
}

/* Each polygon less those before it. */
static double area_by(const tn_cover *covers, size_t count, const tn_box_tree *tree, tn_cover_pieces *work)
{
    tn_box_hits hits = {0};
    double area = 0;
    for (size_t i = 0; i < count && !work->failed; i++) {
        const tn_box_bounds bounds = tn_cover_bounds(&covers[i]);
        work->failed |= !tn_box_tree_list(tree, &bounds, &hits);
        tn_cover_begin(work, &covers[i]);
        for (size_t k = 0; k < hits.count && hits.items[k] < i && work->count; k++)
            tn_cover_less(work, &covers[hits.items[k]]);
        area += tn_cover_left(work);
    }
    free(hits.items);
    return area;
}

double tn_cover_area(tn_cover *covers, size_t count)
{
    tn_cover_pieces work = {0};
    tn_box_tree tree = {0};
    tn_box_bounds *bounds = malloc((count + 1) * sizeof *bounds);
    double area = 0;
    if (count)
        qsort(covers, count, sizeof *covers, by_low);
    for (size_t i = 0; bounds && i < count; i++)
        bounds[i] = tn_cover_bounds(&covers[i]);
    work.failed = !bounds || tn_box_tree_make(bounds, (uint32_t)count, &tree, &(tn_error){0}) != TN_OK;
    if (!work.failed)
        area = area_by(covers, count, &tree, &work);
    tn_box_tree_clear(&tree);
    free(bounds);
    free(work.pieces);
    return work.failed ? -1 : area;
}

/* ---- the convex hull of points (Andrew 1979), its area, and how deep a point lies in it */

static int by_place(const void *a, const void *b)
{
    const double *p = a, *q = b;
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static size_t without_repeats(double (*points)[2], size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || points[kept - 1][0] != points[i][0] || points[kept - 1][1] != points[i][1])
            memmove(points[kept++], points[i], sizeof *points);
    return kept;
}

/* Along the lower side from left to right, then along the upper one back. */
bool tn_hull(double (*points)[2], size_t *count)
{
    size_t n = *count, kept = 0;
    if (n > 1)
        qsort(points, n, sizeof *points, by_place);
    n = *count = without_repeats(points, n);
    if (n < 3)
        return true;
    double(*hull)[2] = malloc((2 * n + 1) * sizeof *hull);
    if (!hull)
        return false;
    for (size_t i = 0; i < n; i++) {
        while (kept >= 2 && turn(hull[kept - 2], hull[kept - 1], points[i]) <= 0)
            kept--;
        memcpy(hull[kept++], points[i], sizeof *hull);
    }
    for (size_t i = n - 1, lower = kept + 1; i-- > 0;) {
        while (kept >= lower && turn(hull[kept - 2], hull[kept - 1], points[i]) <= 0)
            kept--;
        memcpy(hull[kept++], points[i], sizeof *hull);
    }
    *count = kept - 1; /* the last is the first again */
    memcpy(points, hull, *count * sizeof *hull);
    free(hull);
    return true;
}

double tn_hull_area(const double (*hull)[2], size_t count)
{
    double twice = 0;
    for (size_t i = 1; i + 1 < count; i++)
        twice += turn(hull[0], hull[i], hull[i + 1]);
    return twice / 2;
}

static double distance_to(const double a[2], const double b[2], const double p[2])
{
    double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double t = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    double x = a[0] + t * dx - p[0], y = a[1] + t * dy - p[1];
    return sqrt(x * x + y * y);
}

double tn_hull_depth(const double (*hull)[2], size_t count, const double point[2])
{
    double nearest = INFINITY;
    int inside = count >= 3;
    for (size_t i = 0; i < count; i++) {
        const double *a = hull[i], *b = hull[(i + 1) % count];
        nearest = fmin(nearest, distance_to(a, b, point));
        inside = inside && turn(a, b, point) >= 0;
    }
    return count == 0 ? 0 : inside ? nearest : -nearest;
}
