/* The convex hull of points (Andrew 1979), its area, and how deep a point lies in it. */
#include "runtime/geometry/union/footprint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
