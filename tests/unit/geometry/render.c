/* Pictures in pixels: what is nearer hides what is farther, in any order; what nothing covers stays transparent; a
 * triangle covers its area. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/render.h"

enum { SIDE = 40 };

/* From above: right is x, up is y. */
static const tn_eye above = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const tn_render_frame frame = {.width = SIDE, .height = SIDE, .left = 0, .top = SIDE, .pixel = 1};

static const double slope = 0.6; /* the first triangle is tilted, so that its light is another */

static uint32_t *render(const uint32_t *corners, size_t triangles)
{
    static double positions[] = {0, 0, 0, 30, 0, 0, 0, 30, 0, 5, 5, 9, 15, 5, 9, 5, 15, 9};
    static uint32_t first[] = {0, 3, 6};
    positions[5] = 30 * slope; /* z of the first triangle's second corner */
    double normals[18] = {0};
    uint32_t copy[6], *image;
    tn_error error;
    memcpy(copy, corners, 3 * triangles * sizeof *copy);
    tn_mesh mesh = {
        .positions = positions, .vertex_count = 6, .face_first = first, .corners = copy, .face_count = triangles};
    assert_int_equal(tn_mesh_render(&mesh, normals, &above, &frame, &image, &error), TN_OK);
    return image;
}

static uint32_t pixel(const uint32_t *image, uint32_t x, uint32_t y)
{
    return image[(SIDE - 1 - y) * SIDE + x];
}

static void test_nearer_hides_farther(void **state)
{
    (void)state;
    static const uint32_t orders[2][6] = {{0, 1, 2, 3, 4, 5}, {3, 4, 5, 0, 1, 2}};
    uint32_t *one = render(orders[0], 2), *other = render(orders[1], 2), *alone = render(orders[0], 1);
    assert_memory_equal(one, other, SIDE * SIDE * sizeof *one);
    assert_int_equal(pixel(alone, 6, 6), pixel(alone, 2, 2));   /* flat: the same light everywhere */
    assert_int_not_equal(pixel(one, 6, 6), pixel(alone, 6, 6)); /* the second lies over it there */
    assert_int_equal(pixel(one, 2, 2), pixel(alone, 2, 2));
    assert_int_equal(pixel(one, 35, 35), 0);
    assert_int_equal(pixel(one, 2, 2) >> 24, 255);
    free(one);
    free(other);
    free(alone);
}

static void test_area(void **state)
{
    (void)state;
    static const uint32_t corners[] = {0, 1, 2};
    uint32_t *image = render(corners, 1);
    double covered = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++)
        covered += (image[i] >> 24) / 255.0;
    assert_true(fabs(covered - 450) < 8); /* the points on its sides */
    free(image);
}

/* One triangle with normals that all point up, or none. */
static uint32_t *render_one(const double positions[9], double up, bool open)
{
    uint32_t first[] = {0, 3}, corners[] = {0, 1, 2}, *image;
    double copy[9], normals[9] = {0, 0, up, 0, 0, up, 0, 0, up};
    tn_render_frame whole = frame;
    tn_error error;
    whole.open = open;
    memcpy(copy, positions, sizeof copy);
    tn_mesh mesh = {.positions = copy, .vertex_count = 3, .face_first = first, .corners = corners, .face_count = 1};
    assert_int_equal(tn_mesh_render(&mesh, normals, &above, &whole, &image, &error), TN_OK);
    return image;
}

/* Of a closed mesh what looks away is not painted; of an open one it is, as it is lit from this side. */
static void test_behind(void **state)
{
    (void)state;
    static const double front[] = {0, 0, 0, 30, 0, 18, 0, 30, 0}, back[] = {0, 0, 0, 0, 30, 0, 30, 0, 18};
    uint32_t *wanted = render_one(front, 0, false), *closed = render_one(back, 0, false),
             *open = render_one(back, 0, true), *same = render_one(front, 0, true);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        assert_int_equal(closed[i], 0);
    assert_int_not_equal(pixel(wanted, 5, 5), 0);
    assert_memory_equal(open, wanted, SIDE * SIDE * sizeof *open);
    assert_memory_equal(same, wanted, SIDE * SIDE * sizeof *same);
    free(wanted);
    free(closed);
    free(open);
    free(same);
}

/* A triangle that is nearly a line is lit as the surface is there, and not as it lies itself. */
static void test_thin(void **state)
{
    (void)state;
    static const double flat[] = {1, 10, 0, 39, 10, 0, 19, 30, 0}, thin[] = {1, 20, 0, 39, 20, 0, 19, 21.3, 1.3};
    uint32_t *wanted = render_one(flat, 1, false), *found = render_one(thin, 1, false);
    assert_int_equal(pixel(found, 19, 20), pixel(wanted, 19, 20));
    free(wanted);
    free(found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearer_hides_farther),
        cmocka_unit_test(test_area),
        cmocka_unit_test(test_behind),
        cmocka_unit_test(test_thin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
