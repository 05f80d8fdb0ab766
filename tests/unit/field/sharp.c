/* Sharp edges: the points lie on edges and corners, the mesh stays closed and manifold, and neither threads nor the
 * engine change a bit. */
#include <math.h>

#include "runtime/geometry/measure.h"
#include "tests/unit/field/support.h"

/* The surface of a text, meshed with sharp edges twice. The caller clears it. */
static tn_contour sharpen(const char *text, uint32_t samples, bool jumps_open)
{
    tn_module *module = compile(text);
    tn_field field;
    tn_error error;
    tn_contour one, other;
    tn_contour_options fast = {.threads = 3, .sharp = true, .jumps_open = jumps_open};
    tn_contour_options slow = {.threads = 1, .sharp = true, .jumps_open = jumps_open, .interpret = true};
    assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
    tn_field_grid grid = tn_field_grid_of(&field, samples);
    assert_int_equal(tn_contour_new(&field, &grid, &fast, &one, &error), TN_OK);
    assert_int_equal(tn_contour_new(&field, &grid, &slow, &other, &error), TN_OK);
    assert_int_equal(one.sharp, other.sharp);
    assert_int_equal(one.mesh.vertex_count, other.mesh.vertex_count);
    assert_int_equal(one.mesh.face_count, other.mesh.face_count);
    assert_memory_equal(one.mesh.positions, other.mesh.positions, 3 * sizeof(double) * one.mesh.vertex_count);
    assert_memory_equal(one.mesh.corners, other.mesh.corners, 3 * sizeof(uint32_t) * one.mesh.face_count);
    tn_contour_clear(&other);
    tn_field_clear(&field);
    tn_module_free(module);
    return one;
}

static double volume_of(const tn_contour *c)
{
    tn_mesh_measures m;
    tn_error error;
    assert_int_equal(tn_mesh_measure(&c->mesh, 0, &m, &error), TN_OK);
    return m.volume;
}

/* A block has its whole volume, to the last corner; without sharp edges it lacks a strip along each. */
static void test_block(void **state)
{
    (void)state;
    tn_contour c = sharpen("use \"shapes\" surface b = block(x, y, z, 4.1, 3.2, 2.3) grid 30", 0, false);
    check_manifold(&c.mesh);
    assert_true(c.sharp > 100);
    if (!(fabs(volume_of(&c) - 8 * 4.1 * 3.2 * 2.3) < 1e-6))
        fail_msg("the volume is %.12g", volume_of(&c));
    tn_contour_clear(&c);
}

/* Where the box cuts a form, the rim is sharp: an upright square pillar from end to end of the box. */
static void test_rim(void **state)
{
    (void)state;
    tn_contour c = sharpen("max(abs(x), abs(y)) - 3.03", 31, false);
    double h = 14.0 / 30;
    check_manifold(&c.mesh);
    double wanted = 6.06 * 6.06 * (14 - 2 * h / 4096);
    if (!(fabs(volume_of(&c) - wanted) < 1e-6))
        fail_msg("the volume is %.12g, not %.12g", volume_of(&c), wanted);
    tn_contour_clear(&c);
}

/* A smooth form is left as it is. */
static void test_smooth(void **state)
{
    (void)state;
    tn_contour c = sharpen("x*x + y*y + z*z - 20", 50, false);
    assert_int_equal(c.sharp, 0);
    tn_contour_clear(&c);
}

/* Whatever the field, the mesh is closed and manifold. */
static void test_any(void **state)
{
    (void)state;
    static const char *const forms[] = {"sin(91*x + 37*y*x)*cos(77*y + 53*z) + sin(83*z + 41*x)", /* noise */
                                        "floor(3*sin(91*x + 37*y*x)*cos(77*y + 53*z) + 2*sin(83*z + 41*x))",
                                        "abs(sin(9*x + 3*y*x)*cos(7*y + 5*z) + sin(8*z + 4*x)) - 0.5",
                                        "1/x + 0.05*y",
                                        "sqrt(x) - 1 - 0.1*y",
                                        "x % 2 + y*y/9 + z*z/9 - 1.5",
                                        "use \"primitives\" surface a = hunt",
                                        "use \"primitives\" surface a = roman",
                                        "max(abs(x % 2) - 0.5, sqrt(y*y + z*z) - 3)",
                                        "x",
                                        "-1",
                                        "1"};
    uint64_t points = 0;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        for (uint32_t samples = 2; samples < 40; samples += 32) {
            tn_contour c = sharpen(forms[i], samples, false);
            check_manifold(&c.mesh);
            points += c.sharp;
            tn_contour_clear(&c);
        }
    assert_true(points > 500);
}

/* Walls where the field jumps are left out where that is asked for, also beside sharp edges. */
static void test_jumps(void **state)
{
    (void)state;
    tn_contour with = sharpen("floor(x)*0.5 + abs(z) - 1.2", 31, false),
               without = sharpen("floor(x)*0.5 + abs(z) - 1.2", 31, true);
    assert_true(with.jumps > 0 && without.mesh.face_count < with.mesh.face_count);
    tn_contour_clear(&with);
    tn_contour_clear(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_block), cmocka_unit_test(test_rim),   cmocka_unit_test(test_smooth),
        cmocka_unit_test(test_any),   cmocka_unit_test(test_jumps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
