/* Parts of a form between the samples of a grid: thin walls, needles and grains are found wherever they lie, alone or
 * beside others; forms that the grid has are not complained of, and where there is nothing, that is proven. */
#include <math.h>

#include "tests/support/share.h"
#include "tests/unit/field/support.h"

/* Meshes a text; clear the contour. */
static tn_status look(const char *text, uint32_t samples, bool open, tn_contour *c, tn_error *error)
{
    tn_module *module = compile(text);
    tn_field field;
    assert_int_equal(tn_field_read(module, 0, NULL, &field, error), TN_OK);
    tn_field_grid grid = tn_field_grid_of(&field, samples);
    tn_contour_options options = {.threads = 1, .between = true, .open = open}, many = options;
    tn_contour other;
    many.threads = 3;
    tn_status status = tn_contour_new(&field, &grid, &options, c, error);
    assert_int_equal(tn_contour_new(&field, &grid, &many, &other, error), status);
    assert_int_equal(other.missed, c->missed);
    assert_memory_equal(other.missed_at, c->missed_at, sizeof c->missed_at);
    tn_contour_clear(&other);
    if (c->missed) {
        double *kept = calloc(field.kept + 1, sizeof *kept);
        assert_non_null(kept);
        assert_true(tn_number_run_at(module->code, field.code, c->missed_at, &field.distances, kept) < 0);
        free(kept);
    }
    tn_field_clear(&field);
    tn_module_free(module);
    return status;
}

/* A form that is much thinner than a cell, somewhere, leaning by a little. */
static void write_thin(dice *d, char *text, size_t size)
{
    double thin = pow(10, between(d, -5, -2)), x = between(d, -3, 3), y = between(d, -3, 3), z = between(d, -3, 3);
    double a = between(d, -0.4, 0.4), b = between(d, -0.4, 0.4);
    switch (roll(d, 3)) {
    case 0: /* a wall */
        snprintf(text, size, "max(max(abs(x - %.9g*y - %.9g*z - %.9g) - %.9g, abs(y) - 2), abs(z) - 2)", a, b, x, thin);
        break;
    case 1: /* a needle */
        snprintf(text, size, "max(square(x - %.9g*z - %.9g) + square(y - %.9g*z - %.9g) - %.9g, abs(z) - 2)", a, x, b,
                 y, thin * thin);
        break;
    default: /* a grain */
        snprintf(text, size, "square(x - %.9g) + square(y - %.9g) + square(z - %.9g) - %.9g", x, y, z, thin * thin);
        break;
    }
}

/* Alone it is an error; beside a ball that does not touch it, it is told of. */
static void test_thin(void **state)
{
    (void)state;
    dice d = {0};
    for (int i = 0; i < test_share(400); i++) {
        char thin[400], both[600];
        tn_contour c;
        tn_error error = {0};
        write_thin(&d, thin, sizeof thin);
        tn_status status = look(thin, 30, false, &c, &error);
        if (c.inside) /* a sample met it */
            assert_int_equal(status, TN_OK);
        else if (status != TN_INVALID || error.code != E_FIELD_MISSED)
            fail_msg("%s is not found", thin);
        bool met = c.inside;
        tn_contour_clear(&c);
        snprintf(both, sizeof both, "min(%s, square(x - 5.5) + square(y - 5.5) + square(z - 5.5) - 1)", thin);
        assert_int_equal(look(both, 30, false, &c, &error), TN_OK);
        if (!met && !c.missed)
            fail_msg("%s is not told of", both);
        tn_contour_clear(&c);
    }
}

/* What the grid has is no part that it misses: smooth forms, edges, forms that the box cuts. */
static void test_nothing_missed(void **state)
{
    (void)state;
    static const char *const forms[] = {"use \"primitives\" surface s = sphere at (x, y, z)",
                                        "use \"primitives\" surface s = torus at (x, y, z)",
                                        "use \"primitives\" surface s = klein at (x, y, z)",
                                        "use \"primitives\" surface s = blobby at (x, y, z)",
                                        "max(max(abs(x) - 3, abs(y) - 2), abs(z) - 4)",
                                        "max(abs(x), abs(y)) - 3.03",
                                        "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)",
                                        "abs(sqrt(x*x + y*y + z*z) - 4) - 0.6",
                                        "x*x + y*y - 4",
                                        "abs(x) + abs(y) + abs(z) - 5"};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        for (uint32_t samples = 20; samples <= 80; samples += 15) {
            tn_contour c;
            tn_error error;
            assert_int_equal(look(forms[i], samples, i % 2, &c, &error), TN_OK);
            if (c.missed)
                fail_msg("%s: %llu cells at %u samples", forms[i], (unsigned long long)c.missed, samples);
            assert_false(c.empty);
            tn_contour_clear(&c);
        }
}

static void test_empty(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool proven;
    } forms[] = {{"x*x + y*y + z*z + 1", true},
                 {"square(x - 0.03)", true},
                 {"max(x - 1, 1.6 - x)", true},
                 {"sqrt(x*x + y*y + z*z - 400) - 1", true},
                 {"max(x - 1, 1.00001 - x)", false}}; /* nearly below 0 */
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        tn_contour c;
        tn_error error;
        assert_int_equal(look(forms[i].text, 40, false, &c, &error), TN_OK);
        assert_false(c.inside);
        assert_int_equal(c.mesh.face_count, 0);
        if (c.empty != forms[i].proven)
            fail_msg("%s is %s", forms[i].text, c.empty ? "proven to be empty" : "left open");
        tn_contour_clear(&c);
    }
}

/* Sides of the box that are thin have samples between them. */
static void test_thin_boxes(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++) {
        char text[200];
        tn_contour c;
        tn_error error;
        double thin = pow(10, -0.1 * i);
        snprintf(text, sizeof text, "surface s = x*x + y*y - 1 box (-2,-2,%.9g)..(2,2,%.9g)", -thin, thin);
        assert_int_equal(look(text, 2 + (uint32_t)i, false, &c, &error), TN_OK);
        assert_true(c.mesh.face_count > 0);
        assert_int_equal(c.missed, 0);
        check_manifold(&c.mesh);
        tn_contour_clear(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_thin), cmocka_unit_test(test_nothing_missed),
                                       cmocka_unit_test(test_empty), cmocka_unit_test(test_thin_boxes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
