/* Faces in triangles: as many as there have to be, none turned over, and together as large as the face. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/bit_tree.h"
#include "runtime/geometry/corner_tree.h"
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

/* Crossed many times, or all on few places: each cut is a triangle, together as large as the face, and the time is that
 * of sorting (looking at all corners for each cut would take hours). */
static void check_crossed(const double (*corners)[2], uint32_t count)
{
    static const double n[3] = {-0.6, 0, 0.8};
    tn_mesh mesh;
    tn_error error;
    make_face(&mesh, corners, count);
    double whole = size_along(&mesh, 0, n), sum = 0, all = 0;
    assert_int_equal(tn_mesh_triangulate(&mesh, &error), TN_OK);
    assert_int_equal(mesh.face_count, count - 2);
    for (size_t t = 0; t < mesh.face_count; t++) {
        double size = size_along(&mesh, t, n);
        sum += size;
        all += fabs(size);
    }
    assert_true(fabs(sum - whole) <= 1e-9 * all);
    tn_mesh_clear(&mesh);
}

static void test_large_faces_that_cross_themselves(void **state)
{
    (void)state;
    enum { MOST = 200000 };
    double(*p)[2] = malloc(MOST * sizeof *p);
    uint64_t random = 5;
    for (uint32_t i = 0; i < MOST; i++) { /* corners anywhere */
        for (int k = 0; k < 2; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            p[i][k] = (double)(random >> 11) * 0x1p-53;
        }
    }
    check_crossed((const double(*)[2])p, MOST);
    for (uint32_t i = 1; i < MOST; i++) { /* a walk over a lattice, which comes by the same places again and again */
        random = random * 6364136223846793005u + 1442695040888963407u;
        p[i][0] = p[i - 1][0] + (double)(random >> 62) - 1.5;
        p[i][1] = p[i - 1][1] + (double)(random >> 60 & 3) - 1.5;
    }
    check_crossed((const double(*)[2])p, MOST);
    for (uint32_t i = 0; i < MOST; i++) { /* a circle, walked round three times */
        p[i][0] = cos(3 * 6.283185307179586 * i / MOST);
        p[i][1] = sin(3 * 6.283185307179586 * i / MOST);
    }
    check_crossed((const double(*)[2])p, MOST);
    for (uint32_t i = 0; i < MOST; i++) { /* a convex face, whose ears hold nothing anywhere */
        p[i][0] = cos(6.283185307179586 * i / MOST);
        p[i][1] = sin(6.283185307179586 * i / MOST);
    }
    check_cut((const double(*)[2])p, MOST);
    free(p);
}

/* The tree's answer is that of looking at every corner, also while corners are taken out. */
static void test_corners_in_triangles(void **state)
{
    (void)state;
    enum { MOST = 300 };
    static double p[MOST][2];
    static bool chosen[MOST];
    uint64_t random = 9;
    for (uint32_t round = 0; round < 60; round++) {
        uint32_t count = 3 + round * 5 % (MOST - 3);
        for (uint32_t i = 0; i < count; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            p[i][0] = (double)(random >> 33 & (round % 2 ? 7 : 1023));
            p[i][1] = (double)(random >> 45 & (round % 2 ? 7 : 1023));
            chosen[i] = random >> 60 & 1;
        }
        tn_corner_tree tree;
        tn_error error;
        assert_int_equal(tn_corner_tree_new(&tree, count, &error), TN_OK);
        tn_corner_tree_make(&tree, (const double(*)[2])p, chosen, count);
        for (uint32_t asked = 0; asked < 500; asked++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            uint32_t a = (uint32_t)(random >> 20) % count, b = (uint32_t)(random >> 35) % count,
                     c = (uint32_t)(random >> 50) % count;
            if (tn_corner_area((const double(*)[2])p, a, b, c) <= 0)
                continue;
            bool found = false;
            for (uint32_t i = 0; i < count; i++)
                found |= chosen[i] && i != a && i != b && i != c && tn_corner_in((const double(*)[2])p, i, a, b, c);
            assert_int_equal(tn_corner_tree_meets(&tree, a, b, c), found);
            if (asked % 4 == 0 && chosen[a]) {
                tn_corner_tree_remove(&tree, a);
                chosen[a] = false;
            }
        }
        tn_corner_tree_clear(&tree);
    }
}

static void test_sets_that_find_their_next_member(void **state)
{
    (void)state;
    enum { MOST = 5000 };
    static bool there[MOST];
    const uint32_t sizes[] = {1, 2, 63, 64, 65, 4095, 4096, 4097, MOST};
    uint64_t random = 3;
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        tn_bit_tree tree = {0};
        assert_true(tn_bit_tree_new(&tree, sizes[s]));
        memset(there, 0, sizeof there);
        for (uint32_t turn = 0; turn < 3000; turn++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            uint32_t member = (uint32_t)(random >> 33) % sizes[s], from = (uint32_t)(random >> 13) % sizes[s];
            there[member] = random >> 62 == 0;
            if (there[member])
                tn_bit_tree_add(&tree, member);
            else
                tn_bit_tree_remove(&tree, member);
            uint32_t wanted = from;
            while (wanted < sizes[s] && !there[wanted])
                wanted++;
            assert_int_equal(tn_bit_tree_next(&tree, from), wanted < sizes[s] ? wanted : TN_BIT_TREE_NONE);
        }
        tn_bit_tree_clear(&tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_large_faces_that_cross_themselves), cmocka_unit_test(test_corners_in_triangles),
        cmocka_unit_test(test_sets_that_find_their_next_member),  cmocka_unit_test(test_snowflakes),
        cmocka_unit_test(test_combs_spirals_and_stars),           cmocka_unit_test(test_faces_that_are_no_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
