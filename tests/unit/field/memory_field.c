/* Meshes of fields where memory runs out at each allocation in turn: an error, and nothing is lost. */
#include "runtime/geometry/crossing.h"
#include "tests/support/failing_memory.h"
#include "tests/unit/field/support.h"

/* Reads the surface, meshes it and looks for crossings. */
static tn_status mesh_once(const tn_module *module, const tn_contour_options *options, size_t *faces)
{
    tn_field field;
    tn_contour contour = {0};
    tn_error error = {0};
    uint64_t crossings;
    tn_status status = tn_field_read(module, 0, NULL, &field, &error);
    if (status == TN_OK) {
        tn_field_grid grid = tn_field_grid_of(&field, 9);
        status = tn_contour_new(&field, &grid, options, &contour, &error);
    }
    if (status == TN_OK && !options->survey)
        status = tn_mesh_crossings(&contour.mesh, &crossings, &error);
    *faces = contour.mesh.face_count;
    if (status != TN_OK)
        assert_int_equal(error.status, status);
    tn_contour_clear(&contour);
    tn_field_clear(&field);
    return status;
}

static void fail_each(const tn_contour_options *options, bool has_faces)
{
    tn_module *module = compile("max(max(abs(x), abs(y)) - 3.1, floor(z) - 2)");
    for (size_t failing = 0;; failing++) {
        size_t faces;
        fail_allocation(failing, 0);
        tn_status status = mesh_once(module, options, &faces);
        if (stop_failing() <= failing) {
            assert_int_equal(status, TN_OK);
            assert_int_equal(faces > 0, has_faces);
            assert_true(failing >= 20);
            break;
        }
        assert_int_equal(status, TN_MEMORY);
    }
    tn_module_free(module);
}

static void test_mesh(void **state)
{
    (void)state;
    fail_each(&(tn_contour_options){.threads = 1}, true);
    fail_each(&(tn_contour_options){.threads = 1, .jumps_open = true}, true);
}

static void test_sharp(void **state)
{
    (void)state;
    fail_each(&(tn_contour_options){.threads = 1, .sharp = true}, true);
}

static void test_survey(void **state)
{
    (void)state;
    fail_each(&(tn_contour_options){.threads = 1, .survey = true}, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mesh),
        cmocka_unit_test(test_sharp),
        cmocka_unit_test(test_survey),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
