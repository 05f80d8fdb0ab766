/* Areas that convex polygons cover, against counting points. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/union/cover.h"

enum { POLYGONS = 12, SIDE = 300 };

static uint64_t state = 17;

static double uniform(void)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) / 9007199254740992.0;
}

/* On a lattice, where sides and corners of polygons lie upon one another, or anywhere. */
static tn_cover make_polygon(bool lattice)
{
    double points[6][2], x = 4 * uniform(), y = 4 * uniform();
    tn_cover cover;
    for (int i = 0; i < 6; i++) {
        points[i][0] = x + 3 * uniform();
        points[i][1] = y + 3 * uniform();
        for (int k = 0; k < 2 && lattice; k++)
            points[i][k] = floor(points[i][k]);
    }
    assert_true(tn_cover_of((const double(*)[2])points, 6, &cover));
    return cover;
}

static bool holds(const tn_cover *cover, double x, double y)
{
    for (size_t i = 0; i < cover->count; i++) {
        const double *a = cover->at[i], *b = cover->at[(i + 1) % cover->count];
        if ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) < 0)
            return false;
    }
    return cover->count >= 3;
}

/* The share of points of a fine grid that some polygon holds and (where it is not NULL) `hole` does not. */
static double counted(const tn_cover *covers, size_t count, const tn_cover *hole)
{
    size_t inside = 0;
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            double x = 7 * (i + 0.5) / SIDE, y = 7 * (j + 0.5) / SIDE;
            bool found = false;
            for (size_t k = 0; k < count && !found; k++)
                found = holds(&covers[k], x, y);
            inside += found && !(hole && holds(hole, x, y));
        }
    return 49.0 * (double)inside / (SIDE * SIDE);
}

static void test_union(void **unused)
{
    (void)unused;
    for (int round = 0; round < 40; round++) {
        tn_cover covers[POLYGONS];
        for (int i = 0; i < POLYGONS; i++)
            covers[i] = make_polygon(round % 2);
        double wanted = counted(covers, POLYGONS, NULL), area = tn_cover_area(covers, POLYGONS);
        if (!(fabs(area - wanted) < 0.15))
            fail_msg("round %d: %g is covered, and counting says %g", round, area, wanted);
    }
}

static void test_less(void **unused)
{
    (void)unused;
    for (int round = 0; round < 40; round++) {
        tn_cover one = make_polygon(round % 2), other = make_polygon(round % 2);
        tn_cover_pieces work = {0};
        tn_cover_begin(&work, &one);
        tn_cover_less(&work, &other);
        double left = tn_cover_left(&work), wanted = counted(&one, 1, &other);
        assert_false(work.failed);
        if (!(fabs(left - wanted) < 0.1))
            fail_msg("round %d: %g is left, and counting says %g", round, left, wanted);
        tn_cover_less(&work, &one);
        assert_true(tn_cover_left(&work) < 1e-12);
        free(work.pieces);
    }
}

/* Nothing covers nothing; what is the same twice counts once. */
static void test_edges(void **unused)
{
    (void)unused;
    const double square[4][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, line[2][2] = {{0, 0}, {1, 1}};
    tn_cover covers[3];
    assert_true(tn_cover_of(square, 4, &covers[0]));
    assert_true(tn_cover_of(square, 4, &covers[1]));
    assert_true(tn_cover_of(line, 2, &covers[2]));
    assert_true(tn_cover_area(covers, 3) == 4);
    assert_true(tn_cover_area(covers, 0) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_union), cmocka_unit_test(test_less),
                                       cmocka_unit_test(test_edges)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
