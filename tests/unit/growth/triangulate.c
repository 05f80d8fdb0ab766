/* Faces in triangles: as many as there have to be, none turned over, and together as large as the face. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/mesh.h"

/* One face with corners in the plane, tilted in space. */
static void make_face(tn_mesh *mesh, const double (*corners)[2], uint32_t count)
{
    tn_error error;
    assert_int_equal(tn_mesh_new(count, 1, count, mesh, &error), TN_OK);
    for (uint32_t i = 0; i < count; i++) {
        double x = corners[i][0], y = corners[i][1];
        mesh->positions[3 * (size_t)i] = 0.8 * x + 5;
        mesh->positions[3 * (size_t)i + 1] = y - 7;
        mesh->positions[3 * (size_t)i + 2] = 0.6 * x;
        mesh->corners[i] = i;
    }
    mesh->face_first[0] = 0;
    mesh->face_first[1] = count;
}

static double size_along(const tn_mesh *mesh, size_t face, const double n[3])
{
    double m[3];
    uint32_t first = mesh->face_first[face];
    tn_mesh_face_normal(mesh, mesh->corners + first, mesh->face_first[face + 1] - first, m);
    return m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
}

static void check_cut(const double (*corners)[2], uint32_t count)
{
    static const double n[3] = {-0.6, 0, 0.8};
    tn_mesh mesh;
    tn_error error;
    make_face(&mesh, corners, count);
    double whole = size_along(&mesh, 0, n), sum = 0;
    assert_true(whole > 0);
    assert_int_equal(tn_mesh_triangulate(&mesh, &error), TN_OK);
    assert_int_equal(mesh.face_count, count - 2);
    for (size_t t = 0; t < mesh.face_count; t++) {
        double size = size_along(&mesh, t, n);
        assert_true(size > -1e-12 * whole);
        sum += size;
    }
    assert_true(fabs(sum - whole) < 1e-9 * whole);
    tn_mesh_clear(&mesh);
}

/* Koch's snowflake: `steps` times four sides for one. */
static uint32_t koch(double (**result)[2], int steps)
{
    uint32_t count = 3;
    double(*p)[2] = malloc(3 * sizeof *p);
    for (int i = 0; i < 3; i++) {
        p[i][0] = cos(2.0943951023931953 * i);
        p[i][1] = sin(2.0943951023931953 * i);
    }
    for (int n = 0; n < steps; n++, count *= 4) {
        double(*q)[2] = malloc(4 * (size_t)count * sizeof *q);
        for (uint32_t i = 0; i < count; i++) {
            const double *a = p[i], *b = p[(i + 1) % count];
            double dx = (b[0] - a[0]) / 3, dy = (b[1] - a[1]) / 3, h = 0.8660254037844386;
            double points[4][2] = {{a[0], a[1]},
                                   {a[0] + dx, a[1] + dy},
                                   {a[0] + 1.5 * dx + h * dy, a[1] + 1.5 * dy - h * dx},
                                   {a[0] + 2 * dx, a[1] + 2 * dy}};
            memcpy(q[4 * (size_t)i], points, sizeof points);
        }
        free(p);
        p = q;
    }
    *result = p;
    return count;
}

static void test_snowflakes(void **state)
{
    (void)state;
    for (int steps = 0; steps <= 7; steps++) {
        double(*p)[2];
        uint32_t count = koch(&p, steps);
        check_cut((const double(*)[2])p, count);
        free(p);
    }
}

/* Combs, spirals and stars: long teeth, few ears, corners of all kinds. */
static void test_combs_spirals_and_stars(void **state)
{
    (void)state;
    enum { MOST = 2000 };
    static double p[2 * MOST + 2][2];
    uint64_t random = 11;
    for (uint32_t count = 3; count < MOST; count = count * 3 / 2 + 1) {
        for (uint32_t i = 0; i < count; i++) { /* a comb's teeth, then its back */
            p[i][0] = count - i;
            p[i][1] = i % 2 ? 10 : 1;
        }
        p[count][0] = 0;
        p[count][1] = 0;
        p[count + 1][0] = count + 1;
        p[count + 1][1] = 0;
        check_cut((const double(*)[2])p, count + 2);
        for (uint32_t i = 0; i < count; i++) { /* a spiral's outer side outwards, its inner one back */
            double turn = 0.2 * i, far = 1 + 0.05 * i;
            p[i][0] = far * cos(turn);
            p[i][1] = far * sin(turn);
            p[2 * count - 1 - i][0] = (far - 0.4) * cos(turn);
            p[2 * count - 1 - i][1] = (far - 0.4) * sin(turn);
        }
        check_cut((const double(*)[2])p, 2 * count);
        for (uint32_t i = 0; i < count; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            double far = 0.1 + (double)(random >> 11) * 0x1p-53, turn = 6.283185307179586 * i / count;
            p[i][0] = far * cos(turn);
            p[i][1] = far * sin(turn);
        }
        if (count > 4)
            check_cut((const double(*)[2])p, count);
    }
}

/* Without an area, or crossed: no triangle is lost, and it ends. */
static void test_faces_that_are_no_faces(void **state)
{
    (void)state;
    static const double flat[5][2] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5, 0}},
                        eight[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}}, one_place[6][2] = {{0}};
    const struct {
        const double (*corners)[2];
        uint32_t count;
    } faces[] = {{flat, 5}, {eight, 4}, {one_place, 6}};
    for (size_t i = 0; i < 3; i++) {
        tn_mesh mesh;
        tn_error error;
        make_face(&mesh, faces[i].corners, faces[i].count);
        assert_int_equal(tn_mesh_triangulate(&mesh, &error), TN_OK);
        assert_int_equal(mesh.face_count, faces[i].count - 2);
        tn_mesh_clear(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_snowflakes),
        cmocka_unit_test(test_combs_spirals_and_stars),
        cmocka_unit_test(test_faces_that_are_no_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
