/* The mapping and the union against the reference's fixtures: boxes, planes, volumes, faces, contacts, parts. They are
 * read from the folder of references, where that is at hand. */
#include <jansson.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/union/contacts.h"
#include "runtime/geometry/union/union.h"
#include "runtime/math/elementary.h"
#include "runtime/solid/measure.h"

static double real(const json_t *value)
{
    return json_number_value(value);
}

static void read_box(const json_t *genes, const json_t *depth, bool planes, tn_solid_box *box)
{
    double g[9];
    for (size_t i = 0; i < 9; i++)
        g[i] = real(json_array_get(genes, i));
    if (json_is_number(depth)) {
        g[2] = 0;
        g[5] = real(depth);
        g[7] = 90;
    }
    for (int k = 0; k < 3; k++) {
        box->low[k] = g[k] - fabs(g[3 + k]) / 2;
        box->high[k] = g[k] + fabs(g[3 + k]) / 2;
        box->void_ |= !(box->high[k] > box->low[k]);
    }
    box->normal[0] = tn_cos_degrees(g[8]) * tn_sin_degrees(g[7]);
    box->normal[1] = tn_sin_degrees(g[8]);
    box->normal[2] = tn_cos_degrees(g[8]) * tn_cos_degrees(g[7]);
    box->distance = g[6];
    box->clipped = planes;
}

static void read_design(const json_t *json, tn_design *design)
{
    const json_t *boxes = json_object_get(json, "primitives"), *rigid = json_object_get(json, "inflexible");
    const char *symmetry = json_string_value(json_object_get(json, "symmetry"));
    *design = (tn_design){.box_count = (uint32_t)json_array_size(boxes)};
    design->boxes = calloc(design->box_count + 1, sizeof *design->boxes);
    for (; *symmetry; symmetry++)
        design->flags |= TN_SOLID_SYMMETRY_X << (*symmetry - 'x');
    for (size_t i = 0; i < design->box_count; i++)
        read_box(json_array_get(boxes, i), json_object_get(json, "two_d"),
                 json_is_true(json_object_get(json, "planes")), &design->boxes[i]);
    for (size_t i = 0; i < json_array_size(rigid); i++)
        design->boxes[json_integer_value(json_array_get(rigid, i))].rigid = true;
}

static void assert_near(double a, double b, double by)
{
    if (!(fabs(a - b) <= by))
        fail_msg("%.17g is not %.17g", a, b);
}

static void check_cell(const tn_cut_box *cell, const tn_solid_box *box, const json_t *wanted)
{
    tn_moments moments = {0};
    assert_int_equal(box->void_, json_is_true(json_object_get(wanted, "void")));
    assert_int_equal(cell->face_count, json_integer_value(json_object_get(wanted, "faces")));
    assert_int_equal(cell->corner_count, json_integer_value(json_object_get(wanted, "vertices")));
    tn_cut_box_moments(cell, &moments);
    assert_near(moments.volume, real(json_object_get(wanted, "volume")), 1e-9);
    for (size_t k = 0; k < 3 && !box->void_; k++) {
        assert_near(cell->low[k], real(json_array_get(json_object_get(wanted, "lo"), k)), 1e-12);
        assert_near(cell->high[k], real(json_array_get(json_object_get(wanted, "hi"), k)), 1e-12);
    }
}

static double volume_of(const tn_mesh *mesh)
{
    double volume = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const double *a = mesh->positions + 3 * mesh->corners[3 * f],
                     *b = mesh->positions + 3 * mesh->corners[3 * f + 1],
                     *c = mesh->positions + 3 * mesh->corners[3 * f + 2];
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume / 6;
}

static void check_union(const tn_built *built, const json_t *wanted, double volume)
{
    tn_union u;
    tn_error error = {0};
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    if (tn_union_make(built->cells, built->cell_count, &u, &error) != TN_OK)
        fail_msg("%s", error.message);
    assert_near(volume_of(&u.mesh), volume, 1e-9);
    tn_union_clear(&u);
    tn_contacts contacts;
    assert_int_equal(tn_contacts_find(built->cells, built->cell_count, TN_CONTACT_LEAST, &contacts, &error), TN_OK);
    assert_int_equal(contacts.count, json_integer_value(json_object_get(wanted, "contacts")));
    tn_contacts_clear(&contacts);
    assert_int_equal(tn_built_measure(built, UINT64_MAX, values, &error), TN_OK);
    assert_near(values[TN_SOLID_AREA_MEASURED], real(json_object_get(wanted, "surface_area")), 1e-7);
    assert_near(values[TN_SOLID_VOLUME_MEASURED], volume, 1e-9);
    assert_int_equal((int)values[TN_SOLID_PARTS_MEASURED],
                     json_integer_value(json_object_get(wanted, "face_connected_components")));
}

static void check_fixture(const json_t *fixture)
{
    const json_t *phenotype = json_object_get(fixture, "phenotype"), *boxes = json_object_get(phenotype, "primitives");
    tn_built built = {0};
    tn_error error = {0};
    read_design(json_object_get(fixture, "design"), &built.written);
    assert_int_equal(tn_design_copy(&built.written, &built.built, &error), TN_OK);
    assert_int_equal(tn_design_correct(&built.built, &built.history, &error), TN_OK);
    uint32_t n = built.built.box_count;
    built.cell_count = (size_t)n * tn_design_images(&built.built);
    assert_int_equal(built.cell_count, json_array_size(boxes));
    built.cells = calloc(built.cell_count + 1, sizeof *built.cells);
    for (uint32_t i = 0; i < built.cell_count; i++) {
        tn_design_cell(&built.built, i % n, tn_design_image(&built.built, i / n), &built.cells[i]);
        check_cell(&built.cells[i], &built.built.boxes[i % n], json_array_get(boxes, i));
    }
    check_union(&built, json_object_get(fixture, "union"), real(json_object_get(phenotype, "total_volume")));
    tn_built_clear(&built);
}

static void test_fixtures(void **state)
{
    (void)state;
    const char *folder = getenv("TARTAN_ORACLES");
    char path[512];
    if (!folder || !*folder)
        skip();
    snprintf(path, sizeof path, "%s/solid/fixtures.json", folder);
    json_error_t wrong;
    json_t *all = json_load_file(path, 0, &wrong);
    if (!all)
        skip();
    const json_t *fixtures = json_object_get(all, "fixtures");
    assert_true(json_array_size(fixtures) > 0);
    for (size_t i = 0; i < json_array_size(fixtures); i++) {
        const json_t *fixture = json_array_get(fixtures, i);
        print_message("%s\n", json_string_value(json_object_get(fixture, "name")));
        check_fixture(fixture);
    }
    json_decref(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fixtures)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
