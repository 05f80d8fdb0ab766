/* Out of memory in what runs other things than plans, and in what has the source: allocations fail once, and then all
 * from there on; each of the first, later ones at growing distances. Every call must say so, and leave nothing behind.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "include/tartan/tartan.h"
#include "tests/support/failing_memory.h"

static const char field_text[] = "surface ball = x*x + y*y + z*z - 1\nbox (-2, -2, -2)..(2, 2, 2)\ngrid 6\n";
static const char wall_text[] = "Wall -> 'FillRect(4,3,2)' 'SetColor(4)' 'Place(3004)'\n";
static const char plan_text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                                "rule pair = neighbour(tray(lid), tray(lid))\n"
                                "library rows using box { trays 1..2 prune pair }\n"
                                "test pair {\n  match [1m lid | 1m lid]\n  match [1m]\n}\n";

typedef struct modules {
    tartan_module *field, *wall;
    tartan_source *plan;
    tartan_mesh *mesh;
} modules;

typedef tartan_status operation(const modules *m, tartan_error *error);

static tartan_status mesh_field(const modules *m, tartan_error *error)
{
    tartan_mesh *mesh = NULL;
    tartan_field_options options = tartan_field_options_init();
    options.threads = 1;
    tartan_status status = tartan_field_mesh(m->field, &options, NULL, &mesh, NULL, error);
    tartan_mesh_free(mesh);
    return status;
}

static tartan_status write_mesh(const modules *m, tartan_error *error)
{
    tartan_status status = TARTAN_OK;
    for (int format = TARTAN_OBJ; format <= TARTAN_GLB && status == TARTAN_OK; format++) {
        void *bytes = NULL;
        size_t size;
        status = tartan_mesh_write(m->mesh, (tartan_mesh_format)format, NULL, NULL, &bytes, &size, error);
        tartan_bytes_free(bytes);
    }
    return status;
}

static tartan_status place(const modules *m, tartan_error *error)
{
    tartan_placement *placement = NULL;
    char *model = NULL, *list = NULL;
    size_t size;
    tartan_status status = tartan_place(m->wall, NULL, NULL, &placement, error);
    if (status == TARTAN_OK)
        status = tartan_placement_ldraw(placement, &model, &size, error);
    if (status == TARTAN_OK)
        status = tartan_placement_list(placement, &list, &size, error);
    tartan_text_free(model);
    tartan_text_free(list);
    tartan_placement_free(placement);
    return status;
}

static tartan_status lay_out(const modules *m, tartan_error *error)
{
    (void)m;
    char *laid = NULL;
    size_t size;
    tartan_status status =
        tartan_format_text("a.plan", plan_text, sizeof plan_text - 1, NULL, NULL, &laid, &size, error);
    tartan_text_free(laid);
    return status;
}

static tartan_status open_source(const modules *m, tartan_error *error)
{
    (void)m;
    tartan_source *source = NULL;
    tartan_status status = tartan_source_open("a.plan", plan_text, sizeof plan_text - 1, NULL, &source, error);
    tartan_source_free(source);
    return status;
}

static tartan_status test_source(const modules *m, tartan_error *error)
{
    tartan_tests *tests = NULL;
    tartan_status status = tartan_source_test(m->plan, 0, NULL, &tests, error);
    if (status == TARTAN_OK)
        assert_int_equal(tartan_tests_failed(tests), 1);
    tartan_tests_free(tests);
    return status;
}

static tartan_status cover(const modules *m, tartan_error *error)
{
    tartan_coverage *coverage = NULL;
    tartan_status status = tartan_source_cover(m->plan, NULL, 0, NULL, &coverage, error);
    tartan_coverage_free(coverage);
    return status;
}

static void fails_cleanly(void **state)
{
    static operation *const operations[] = {mesh_field, write_mesh, place, lay_out, open_source, test_source, cover};
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        size_t failures = 0;
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number += 1 + number / 32) {
                tartan_error error = {0};
                fail_allocation(number, all_after);
                tartan_status status = operations[i](*state, &error);
                if (stop_failing() <= number) {
                    assert_int_equal(status, TARTAN_OK);
                    break;
                }
                if (status == TARTAN_OK)
                    continue; /* GMP's and OpenMP's own allocations, and what can do without */
                if (status != TARTAN_MEMORY || !error.message[0])
                    fail_msg("operation %zu, allocation %zu: status %d, %s", i, number, (int)status, error.message);
                failures++;
            }
        }
        assert_true(failures > 0);
    }
}

static int make(void **state)
{
    static modules m;
    tartan_status status = tartan_compile_text("a.field", field_text, sizeof field_text - 1, NULL, &m.field, NULL);
    if (status == TARTAN_OK)
        status = tartan_compile_text("a.pcfg", wall_text, sizeof wall_text - 1, NULL, &m.wall, NULL);
    if (status == TARTAN_OK)
        status = tartan_source_open("a.plan", plan_text, sizeof plan_text - 1, NULL, &m.plan, NULL);
    if (status == TARTAN_OK)
        status = tartan_field_mesh(m.field, NULL, NULL, &m.mesh, NULL, NULL);
    *state = &m;
    return status != TARTAN_OK;
}

static int unmake(void **state)
{
    modules *m = *state;
    tartan_mesh_free(m->mesh);
    tartan_source_free(m->plan);
    tartan_module_free(m->wall);
    tartan_module_free(m->field);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fails_cleanly)};
    return cmocka_run_group_tests(tests, make, unmake);
}
