/* In how many ways plans of a projected library come about: of one plan, and of the library, told apart or added up;
 * and where memory runs out at each allocation in turn. An error, and nothing is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/ways/library_ways.h"
#include "runtime/plan/ways/projected.h"
#include "tests/support/fail_each.h"
#include "tests/support/load_plan.h"

/* A hall is open in two colours, a room is open in two or shut in two; shut trays are no neighbours. */
static const char text[] = "schema row { use = hall | room }\n"
                           "schema bays from row { bay = open | shut  tone = red | blue  forbid tray(hall, shut) }\n"
                           "rule shuts using bays = neighbour(tray(shut), tray(shut))\n"
                           "library zoned using bays { trays 0..3 prune shuts }\n"
                           "library bare from zoned onto row { }\n";

static struct {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *schema;
    tn_library *library;
    tn_instruction image;
} opened;

static int setup(void **state)
{
    (void)state;
    opened.module = load_plan(text, &opened.compilation);
    assert_int_equal(tn_schema_new(opened.module, 0, 0, &opened.schema, NULL), TN_OK);
    assert_int_equal(tn_library_new(opened.schema, 1, NULL, &opened.library, NULL), TN_OK);
    uint32_t clause = opened.module->LIBRARY_records[1].clause_first + tn_library_generator(opened.library);
    assert_true(tn_function_is_image(opened.module, opened.module->CLAUSE_records[clause].holds, &opened.image));
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    tn_library_free(opened.library);
    tn_schema_free(opened.schema);
    tn_module_free(opened.module);
    tn_compilation_clear(&opened.compilation);
    return 0;
}

/* Room, hall, room: each room open or shut, in two tones; the hall in two. */
static tn_status one_plan(void)
{
    static const tn_tray trays[] = {1, 0, 1};
    tn_projected *projected = NULL;
    tn_error error = {0};
    mpz_t ways;
    mpz_init(ways);
    tn_status status = tn_projected_new(opened.schema, &opened.image, NULL, 0, 3, &projected, &error);
    if (status == TN_OK)
        status = tn_projected_ways(projected, trays, 3, ways, &error);
    if (status == TN_OK)
        assert_int_equal(mpz_get_ui(ways), 4 * 2 * 4);
    assert_int_equal(error.status, status);
    tn_projected_free(projected);
    mpz_clear(ways);
    return status;
}

/* As many ways as `zoned` has plans: a tray has 6, of which 2 are shut. The most have three rooms: 4^3 less 24. */
static tn_status counted(uint32_t max_nodes, bool apart)
{
    tn_derived_ways found;
    tn_error error = {0};
    tn_status status = tn_library_count_ways(opened.library, max_nodes, &found, &error);
    if (status == TN_OK) {
        assert_int_equal(mpz_get_ui(found.plans), 15);
        assert_int_equal(mpz_get_ui(found.ways), 215);
        assert_int_equal(found.has_rows, apart);
        assert_true(found.projected);
        if (apart)
            assert_true(mpz_cmp_ui(found.most, 40) == 0 && found.length == 3);
    }
    assert_int_equal(error.status, status);
    tn_derived_ways_clear(&found);
    return status;
}

static tn_status told_apart(void)
{
    return counted(0, true);
}

static tn_status added_up(void)
{
    return counted(1, false);
}

static void test_one_plan(void **state)
{
    (void)state;
    fail_each(one_plan, false);
}

static void test_told_apart(void **state)
{
    (void)state;
    fail_each(told_apart, false);
}

static void test_added_up(void **state)
{
    (void)state;
    fail_each(added_up, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_one_plan), cmocka_unit_test(test_told_apart),
                                       cmocka_unit_test(test_added_up)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
