/* Fields: intervals hold the values of points, derivatives match differences, rows and the interpreter give the same
 * bits; and the mesh of any field is closed and manifold, and no triangles cross. */
#include <math.h>

#include "runtime/geometry/crossing.h"
#include "runtime/geometry/measure.h"
#include "tests/support/openmesh_takes.h"
#include "tests/support/share.h"
#include "tests/unit/field/support.h"

/* ---- random fields */

static void write_field(dice *d, unsigned depth, FILE *out)
{
    static const char *const forms[] = {
        "(#+#)",         "(#-#)",      "(#*#)",        "(#/#)",      "(#%#)",
        "(-#)",          "sqrt(#)",    "abs(#)",       "square(#)",  "sin(#)",
        "cos(#)",        "tan(#)",     "tanh(#)",      "exp(#)",     "log(#)",
        "floor(#)",      "min(#,#)",   "max(#,#,#)",   "pow(#,3)",   "pow(#,-2)",
        "pow(abs(#),#)", "atan2(#,#)", "clamp(#,#,#)", "mix(#,#,#)", "blend(#,#,abs(#))",
        "noise(#,#,#)",  "(#*#)",      "(#+#)"};
    if (depth == 0) {
        if (roll(d, 3) == 0)
            fprintf(out, "%.3f", between(d, 0, 3));
        else
            fputc("xyz"[roll(d, 3)], out);
        return;
    }
    for (const char *form = forms[roll(d, sizeof forms / sizeof *forms)]; *form; form++)
        if (*form == '#')
            write_field(d, depth - 1 - roll(d, depth), out);
        else
            fputc(*form, out);
}

static tn_module *random_module(dice *d)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    write_field(d, 5, out);
    fclose(out);
    tn_module *module = compile(text);
    free(text);
    return module;
}

static bool same(double a, double b)
{
    return (a != a && b != b) || a == b;
}

/* ---- evaluating */

static void check_rows(const tn_field *field, dice *d)
{
    tn_field_runner tape[3], plain;
    tn_error error;
    assert_int_equal(tn_field_runner_new(field, &field->samples, true, &plain, &error), TN_OK);
    for (int axis = 0; axis < 3; axis++)
        assert_int_equal(tn_field_runner_new(field, &field->along[axis], false, &tape[axis], &error), TN_OK);
    for (size_t i = 0; i < TN_ROW; i++)
        for (int k = 0; k < 3; k++)
            plain.rows.coordinates[k][i] = between(d, -3, 3);
    const double *wanted = tn_field_run(&plain);
    for (int axis = 0; axis < 3; axis++) {
        for (int k = 0; k < 3; k++)
            memcpy(tape[axis].rows.coordinates[k], plain.rows.coordinates[k], TN_ROW * sizeof(double));
        tn_field_prepare(&tape[axis]);
        tn_field_run(&tape[axis]); /* what is kept between runs stays as it is */
        const double *got = tn_field_run(&tape[axis]);
        for (size_t i = 0; i < TN_ROW; i++)
            assert_true(same(got[i], wanted[i]));
        tn_field_runner_clear(&tape[axis]);
    }
    tn_field_runner_clear(&plain);
}

static void check_bounds(const tn_field *field, dice *d)
{
    tn_interval *registers = calloc(field->samples.register_count, sizeof *registers);
    double *kept = calloc(field->kept + 1, sizeof *kept), low[3], high[3], point[3];
    assert_non_null(registers);
    assert_non_null(kept);
    for (int box = 0; box < 8; box++) {
        for (int k = 0; k < 3; k++) {
            low[k] = between(d, -3, 3);
            high[k] = low[k] + between(d, 0, box < 4 ? 0.1 : 3);
        }
        tn_interval bounds = tn_tape_bounds(&field->samples, low, high, &field->distances, registers);
        for (int i = 0; i < 40; i++) {
            for (int k = 0; k < 3; k++)
                point[k] = i < 8 ? (i >> k & 1 ? high[k] : low[k]) : between(d, low[k], high[k]);
            double v = tn_number_run_at(field->module->code, field->code, point, &field->distances, kept);
            if (v != v ? !bounds.fails : !(v >= bounds.low && v <= bounds.high))
                fail_msg("%a is not in %a to %a", v, bounds.low, bounds.high);
        }
    }
    free(registers);
    free(kept);
}

static void test_random_fields(void **state)
{
    (void)state;
    dice d = {0};
    for (int i = 0; i < test_share(400); i++) {
        tn_module *module = random_module(&d);
        tn_field field;
        tn_error error;
        assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
        check_rows(&field, &d);
        check_bounds(&field, &d);
        tn_field_clear(&field);
        tn_module_free(module);
    }
}

/* Where a function is smooth its gradient is what small steps say. */
static void test_derivatives(void **state)
{
    (void)state;
    static const char *const smooth[] = {"x + 2*y - 3*z*z",
                                         "x*y/z - -z",
                                         "x % 2.5 + floor(y)",
                                         "abs(x) + sqrt(y) + square(z)",
                                         "min(x, y, z) + max(x, 2*y)",
                                         "exp(x/3)*log(y)",
                                         "sin(x)*cos(y) + tan(z/9)",
                                         "tanh(x) + atan2(y, x)",
                                         "pow(x, 1.7) + pow(y, z)",
                                         "clamp(x, 0.5, 2) + mix(x, y, z)",
                                         "blend(x, y*1.01, 0.7)",
                                         "noise(x, y*2, z)",
                                         "pow(x, 5) - pow(y, -3)"};
    dice d = {0};
    for (size_t i = 0; i < sizeof smooth / sizeof *smooth; i++) {
        tn_module *module = compile(smooth[i]);
        tn_field field;
        tn_error error;
        assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
        double *registers = calloc((size_t)field.samples.register_count * 4, sizeof *registers), h = 1e-6;
        assert_non_null(registers);
        for (int n = 0; n < 30; n++) {
            double p[3] = {between(&d, 0.6, 1.9), between(&d, 0.6, 1.9), between(&d, 0.6, 1.9)}, g[3], unused[3];
            tn_tape_gradient(&field.samples, p, &field.distances, registers, g);
            for (int k = 0; k < 3; k++) {
                double above[3] = {p[0], p[1], p[2]}, below[3] = {p[0], p[1], p[2]};
                above[k] += h;
                below[k] -= h;
                double slope = (tn_tape_gradient(&field.samples, above, &field.distances, registers, unused) -
                                tn_tape_gradient(&field.samples, below, &field.distances, registers, unused)) /
                               (2 * h);
                if (!(fabs(slope - g[k]) < 1e-5 * (1 + fabs(slope))))
                    fail_msg("%s: axis %d: %g is not %g", smooth[i], k, g[k], slope);
            }
        }
        free(registers);
        tn_field_clear(&field);
        tn_module_free(module);
    }
}

/* ---- meshes */

static int by_place(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(double));
}

static void check_same(const tn_contour *one, const tn_contour *other)
{
    assert_int_equal(one->mesh.vertex_count, other->mesh.vertex_count);
    assert_int_equal(one->mesh.face_count, other->mesh.face_count);
    assert_memory_equal(one->mesh.positions, other->mesh.positions, 3 * sizeof(double) * one->mesh.vertex_count);
    assert_memory_equal(one->mesh.corners, other->mesh.corners, 3 * sizeof(uint32_t) * one->mesh.face_count);
    assert_int_equal(one->jumps, other->jumps);
    assert_int_equal(one->moved, other->moved);
    assert_int_equal(one->no_values, other->no_values);
    assert_int_equal(one->cut, other->cut);
}

static void check_mesh(const char *text, uint32_t grid_size, bool closed)
{
    tn_module *module = compile(text);
    tn_field field;
    tn_error error;
    assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
    tn_field_grid grid = tn_field_grid_of(&field, grid_size);
    tn_contour one, other;
    tn_mesh_measures m;
    uint64_t crossings;
    assert_int_equal(tn_contour_new(&field, &grid, &(tn_contour_options){.threads = 3, .open = !closed}, &one, &error),
                     TN_OK);
    const tn_contour_options others[] = {{.threads = 1, .interpret = true, .every_sample = true, .open = !closed},
                                         {.threads = 1, .open = !closed},
                                         {.threads = 4, .every_sample = true, .open = !closed}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        assert_int_equal(tn_contour_new(&field, &grid, &others[i], &other, &error), TN_OK);
        check_same(&one, &other);
        tn_contour_clear(&other);
    }
    if (closed) {
        check_manifold(&one.mesh);
        assert_int_equal(tn_mesh_measure(&one.mesh, 0, &m, &error), TN_OK);
        assert_true(one.mesh.face_count == 0 || m.volume > 0);
    }
    assert_true(openmesh_takes(&one.mesh));
    assert_int_equal(tn_mesh_crossings(&one.mesh, &crossings, &error), TN_OK);
    assert_int_equal(crossings, 0);
    qsort(one.mesh.positions, one.mesh.vertex_count, 3 * sizeof(double), by_place);
    for (size_t v = 1; v < one.mesh.vertex_count; v++)
        assert_true(by_place(one.mesh.positions + 3 * v, one.mesh.positions + 3 * v - 3) != 0);
    tn_contour_clear(&one);
    tn_field_clear(&field);
    tn_module_free(module);
}

static void test_meshes(void **state)
{
    (void)state;
    static const char *const forms[] = {
        "x*x + y*y + z*z - 20",
        "sin(91*x + 37*y*x)*cos(77*y + 53*z) + sin(83*z + 41*x)",            /* noise */
        "floor(3*sin(91*x + 37*y*x)*cos(77*y + 53*z) + 2*sin(83*z + 41*x))", /* with exact zeros */
        "1/x + 0.05*y",
        "sqrt(x) - 1 - 0.1*y",
        "floor(x)*0.5 + z",
        "x % 2 + y*y/9 + z*z/9 - 1.5",
        "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)",
        "x",
        "x - 7",
        "-1",
        "1",
        "max(abs(x % 2) - 0.5, sqrt(y*y + z*z) - 3)",
        "log(x) + log(y) + log(z)"};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        check_mesh(forms[i], 21, true);
        check_mesh(forms[i], 21, false);
        check_mesh(forms[i], 2, true);
        if (i % (size_t)(4 / test_share(4)) == 0)
            check_mesh(forms[i], 66, true); /* more samples than a word has bits */
    }
}

/* Boxes whose sides differ, none a multiple of a block. */
static void test_long_box(void **state)
{
    (void)state;
    check_mesh("surface a = sqrt(x*x/9 + y*y + z*z) - 0.9 box (-3, -1, -1.3)..(3, 1, 1) grid 75", 0, true);
    check_mesh("surface a = noise(x*3, y*3, z*3) box (0, 0, 0)..(1, 9, 0.01) grid 90", 0, true);
}

/* ---- limits */

static void test_limits(void **state)
{
    (void)state;
    tn_module *module = compile("x*x + y*y + z*z - 20");
    tn_field field;
    tn_error error;
    tn_contour contour;
    assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
    tn_field_grid grid = tn_field_grid_of(&field, 20);
    assert_int_equal(tn_contour_new(&field, &grid, &(tn_contour_options){.samples = 7999}, &contour, &error), TN_LIMIT);
    assert_int_equal(error.code, E_FIELD_SAMPLES);
    tn_contour_clear(&contour);
    assert_int_equal(tn_contour_new(&field, &grid, &(tn_contour_options){.triangles = 10}, &contour, &error), TN_LIMIT);
    assert_int_equal(error.code, E_FIELD_TRIANGLES);
    tn_contour_clear(&contour);
    tn_field_clear(&field);
    tn_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_fields), cmocka_unit_test(test_derivatives), cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_long_box),      cmocka_unit_test(test_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
