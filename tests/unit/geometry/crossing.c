/* Triangles that cross: those of two tetrahedra, and random ones against a brute force of all pairs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/geometry/crossing.h"

static uint64_t count(size_t vertices, double *positions, size_t faces, uint32_t *corners)
{
    tn_mesh mesh = {.vertex_count = vertices, .positions = positions, .face_count = faces, .corners = corners};
    uint64_t crossings;
    tn_error error;
    assert_int_equal(tn_mesh_crossings(&mesh, &crossings, &error), TN_OK);
    return crossings;
}

static void test_two(void **state)
{
    (void)state;
    double p[] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, -1, 0.5, 0.5, 1, 5, 5, 0, 0, 0, 1};
    assert_int_equal(count(7, p, 2, (uint32_t[]){0, 1, 2, 3, 4, 5}), 1); /* one side runs through the first */
    assert_int_equal(count(7, p, 2, (uint32_t[]){0, 1, 2, 0, 3, 4}), 1); /* they share a corner */
    assert_int_equal(count(7, p, 2, (uint32_t[]){0, 1, 2, 1, 0, 6}), 0); /* a side */
    assert_int_equal(count(7, p, 2, (uint32_t[]){0, 1, 2, 4, 5, 6}), 0); /* one is above the other */
    assert_int_equal(count(7, p, 0, NULL), 0);
}

/* Each pair of triangles, as a mesh of its own, is in one cube. */
static void test_random(void **state)
{
    (void)state;
    enum { FACES = 300 };
    double p[9 * FACES];
    uint32_t corners[3 * FACES];
    uint64_t wanted = 0;
    for (uint32_t f = 0; f < FACES; f++)
        for (uint32_t k = 0; k < 9; k++) {
            uint64_t bits = tn_random64(1, f, k) >> 40, middle = tn_random64(2, f, k % 3) >> 40;
            p[9 * f + k] = 2 * (double)middle * 0x1p-24 + (double)bits * 0x1p-24 - 3;
        }
    for (uint32_t i = 0; i < 3 * FACES; i++)
        corners[i] = i;
    for (uint32_t a = 0; a < FACES; a++)
        for (uint32_t b = a + 1; b < FACES; b++)
            wanted += count(3 * FACES, p, 2, (uint32_t[]){3 * a, 3 * a + 1, 3 * a + 2, 3 * b, 3 * b + 1, 3 * b + 2});
    assert_true(wanted > 20);
    assert_int_equal(count(3 * FACES, p, FACES, corners), wanted);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_two), cmocka_unit_test(test_random)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
