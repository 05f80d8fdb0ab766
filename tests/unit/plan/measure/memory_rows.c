/* Schemas of libraries where memory runs out at each allocation in turn: the joint distribution of measures, the census
 * that the compiler takes, and the plans that trays stand for. An error, and nothing is lost. And modules whose trays
 * stand for other plans than they say, which are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/common/arena.h"
#include "driver/open/census.h"
#include "runtime/plan/library/plan_rows.h"
#include "runtime/plan/measure/crosstab.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/measure/standing_plans.h"
#include "tests/support/fail_each.h"
#include "tests/support/load_plan.h"

/* Houses of one tray or two, 3 m or 4 m wide, 20 in all. */
static const char text[] =
    "schema house { width = 3m | 4m  use = home | shop }\n"
    "measure front using house = sum(width)\n"
    "measure share using house = sum(width of tray(shop)) / sum(width)\n"
    "rule corner using house = neighbour(beginning, tray(shop))\n"
    "library houses using house { trays 1..2 }\n"
    "schema lots of houses { frontage = measure front  shops = measure share  corner = rule corner }\n"
    "library street using lots { trays 0..2  prune tray(3m) }\n";

static struct {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *house, *lots;
    tn_library *houses, *street;
} opened;

static tn_schema *schema_of(uint32_t library)
{
    tn_schema *schema;
    assert_int_equal(tn_schema_new(opened.module, opened.module->LIBRARY_records[library].schema, 0, &schema, NULL),
                     TN_OK);
    return schema;
}

static int setup(void **state)
{
    (void)state;
    opened.module = load_plan(text, &opened.compilation);
    opened.house = schema_of(0);
    opened.lots = schema_of(1);
    assert_int_equal(tn_library_new(opened.house, 0, NULL, &opened.houses, NULL), TN_OK);
    assert_int_equal(tn_library_new(opened.lots, 1, NULL, &opened.street, NULL), TN_OK);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    tn_library_free(opened.street);
    tn_library_free(opened.houses);
    tn_schema_free(opened.lots);
    tn_schema_free(opened.house);
    tn_module_free(opened.module);
    tn_compilation_clear(&opened.compilation);
    return 0;
}

/* Fronts of 3, 4, 6, 7 and 8 m, with the shares of shops that these have. */
static tn_status joint(void)
{
    tn_crosstab table;
    tn_error error = {0};
    const tn_bundle_measure measures[] = {tn_bundle_measure_of(opened.module, tn_library_record_of(opened.houses), 0),
                                          tn_bundle_measure_of(opened.module, tn_library_record_of(opened.houses), 1)};
    tn_status status = tn_crosstab_make(&table, opened.houses, measures, 2, 0, &error);
    if (status == TN_OK) {
        uint64_t plans = 0;
        for (size_t i = 0; i < table.count; i++)
            plans += mpz_get_ui(table.rows[i].plans);
        assert_int_equal(plans, 20);
        assert_int_equal(table.count, 2 + 2 + 3 + 4 + 3);
    }
    assert_int_equal(error.status, status);
    tn_crosstab_clear(&table);
    return status;
}

static tn_status census(void)
{
    static const char *const measures[] = {"front", "share"};
    const tn_census_request request = {.module = opened.compilation.module,
                                       .module_size = opened.compilation.module_size,
                                       .library = "houses",
                                       .measures = measures,
                                       .measure_count = 2,
                                       .most_values = 255};
    tn_census taken = {0};
    tn_error error = {0};
    size_t column;
    tn_arena *arena = tn_arena_new();
    tn_status status =
        arena ? tn_plan_census.take(NULL, &request, arena, &taken, &column, &error) : tn_fail_memory(&error);
    if (status == TN_OK) {
        assert_int_equal(taken.count, 14);
        assert_int_equal(taken.powers[0], 1);
        assert_string_equal(taken.rows[0].texts[1], "0");
    }
    assert_int_equal(error.status, status);
    tn_arena_free(arena);
    return status;
}

/* The last row of plans of two lots, which are its first and its last plan, is the one that it was found by. */
static tn_status back_and_forth(tn_plan_rows *rows, tn_standing_plans *plans, tn_error *error)
{
    tn_tray trays[2], stands[2];
    mpz_t rank, again, numbers[2];
    uint32_t count, length;
    bool is_one = false;
    mpz_inits(rank, again, numbers[0], numbers[1], NULL);
    tn_plan_rows_count(rows, TN_ALL_LENGTHS, rank);
    assert_int_equal(mpz_get_ui(rank), 1 + 18 + 18 * 18);
    mpz_sub_ui(rank, rank, 1);
    assert_true(tn_plan_rows_unrank(rows, rank, trays, &count, numbers));
    tn_status status = tn_standing_plans_unrank(plans, trays[1], numbers[1], stands, &length, error);
    if (status == TN_OK)
        status = tn_standing_plans_rank(plans, trays[1], stands, length, again, &is_one, error);
    if (status == TN_OK) {
        assert_true(is_one && mpz_cmp(again, numbers[1]) == 0);
        assert_true(tn_plan_rows_rank(rows, trays, count, (const mpz_t *)numbers, again));
        assert_int_equal(mpz_cmp(again, rank), 0);
    }
    mpz_clears(rank, again, numbers[0], numbers[1], NULL);
    return status;
}

static tn_status standing(void)
{
    tn_plan_rows *rows = NULL;
    tn_standing_plans *plans = NULL;
    tn_error error = {0};
    tn_status status = tn_plan_rows_new(opened.street, &rows, &error);
    if (status == TN_OK)
        status = tn_standing_plans_new(opened.houses, opened.lots, &plans, &error);
    if (status == TN_OK)
        status = back_and_forth(rows, plans, &error);
    assert_int_equal(error.status, status);
    tn_standing_plans_free(plans);
    tn_plan_rows_free(rows);
    return status;
}

static void assert_refused(void)
{
    tn_standing_plans *plans = NULL;
    tn_error error = {0};
    assert_int_equal(tn_standing_plans_new(opened.houses, opened.lots, &plans, &error), TN_INVALID);
    assert_int_equal(error.code, E_REFUSED_MODULE);
    assert_null(plans);
}

/* Two trays change places, which stand for one plan and for two: all plans are as many as before. */
static void test_other_numbers(void **state)
{
    tn_tray_plans_record *records = (tn_tray_plans_record *)(uintptr_t)opened.module->TRAY_PLANS_records;
    size_t other = 1;
    (void)state;
    while (strcmp(tn_text(opened.module, records[other].plans), tn_text(opened.module, records[0].plans)) == 0)
        other++;
    tn_string plans = records[0].plans;
    records[0].plans = records[other].plans;
    records[other].plans = plans;
    assert_refused();
    records[other].plans = records[0].plans;
    records[0].plans = plans;
}

/* A field that says something of plans, of which the module does not hold what. */
static void test_nothing_said(void **state)
{
    tn_said_record *said = (tn_said_record *)(uintptr_t)opened.module->SAID_records;
    uint32_t field = said[0].field;
    (void)state;
    said[0].field = 0;
    assert_refused();
    said[0].field = field;
}

static void test_joint(void **state)
{
    (void)state;
    fail_each(joint, false);
}

static void test_census(void **state)
{
    (void)state;
    fail_each(census, false);
}

static void test_standing(void **state)
{
    (void)state;
    fail_each(standing, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_joint), cmocka_unit_test(test_census),
                                       cmocka_unit_test(test_standing), cmocka_unit_test(test_other_numbers),
                                       cmocka_unit_test(test_nothing_said)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
