/* Searching plans where memory runs out at each allocation in turn: an error, and nothing is lost. And what searching
 * finds, where clauses are too large for gates. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/search/search.h"
#include "tests/support/fail_each.h"
#include "tests/support/load_plan.h"

/* Counts, sums, circles, distances: two of the three trays in the middle are 6' wide. */
static const char text[] = "schema s { width = 3' | 6'  use = hall | room | stair }\n"
                           "measure narrow-hall using s = quantity(tray(hall, 3'))\n"
                           "rule bay = tray(hall) or neighbour(tray(room), bay, tray(room))\n"
                           "library rows using s {\n"
                           "  trays 5\n"
                           "  generate bay\n"
                           "  require sum(width) = 21' and quantity(tray(6')) >= 2\n"
                           "  prune distance(from tray(6'), to tray(hall), by quantity(any, n = 1))\n"
                           "}\n"
                           "library none using s {\n"
                           "  trays 1..3\n"
                           "  require quantity(tray(stair)) = 1\n"
                           "  require quantity(tray(hall)) >= 2\n"
                           "  prune neighbour(tray(3'), tray(3'))\n"
                           "  require quantity(tray(room)) >= 1\n"
                           "}\n";

static tn_module *module;
static tn_schema *schema;

static tn_status find_plans(uint32_t max_gates, uint32_t *found)
{
    tn_search_options options = {.max_gates = max_gates};
    tn_plan_search *search;
    tn_error error;
    const tn_tray *trays;
    uint32_t length;
    *found = 0;
    tn_status status = tn_plan_search_new(schema, 0, &options, &search, &error);
    if (status != TN_OK)
        return status;
    do {
        status = tn_plan_search_next(search, &trays, &length, &error);
        *found += status == TN_OK && trays;
    } while (status == TN_OK && trays);
    tn_plan_search_free(search);
    return status;
}

static tn_status all_plans(void)
{
    uint32_t found;
    tn_status status = find_plans(0, &found);
    assert_true(status != TN_OK || found > 0);
    return status;
}

/* Draws more plans than there are, and the best. */
static tn_status drawn_and_best(void)
{
    tn_searched_plans plans = {0};
    tn_search_proof proof;
    tn_plan_search *search;
    tn_error error;
    tn_status status = tn_plan_search_new(schema, 0, NULL, &search, &error);
    if (status != TN_OK)
        return status;
    mpq_init(proof.bound);
    status = tn_plan_search_sample(search, 7, 0, UINT32_MAX, 9, &plans, &error);
    assert_true(status != TN_OK || plans.count == 3);
    tn_searched_plans_clear(&plans);
    if (status == TN_OK)
        status = tn_plan_search_best(search, module->MEASURE_records[0].sum, true, 2, &plans, &proof, &error);
    if (status == TN_OK) {
        assert_true(proof.proven);
        assert_int_equal(plans.count, 2);
        assert_int_equal(mpq_cmp_ui(plans.items[0].value, 1, 1), 0); /* both rooms beside the hall are wide */
    }
    tn_searched_plans_clear(&plans);
    mpq_clear(proof.bound);
    tn_plan_search_free(search);
    return status;
}

/* Three trays cannot have a stair, two halls and a room; that no two narrow ones stand side by side has no part in it.
 */
static tn_status conflict(void)
{
    tn_search_conflict found = {0};
    tn_plan_search *search;
    tn_status status = tn_plan_search_new(schema, 1, NULL, &search, NULL);
    if (status != TN_OK)
        return status;
    status = tn_plan_search_conflict(search, &found, NULL);
    if (status == TN_OK) {
        const uint32_t expected[] = {0, 1, 3};
        assert_true(found.empty);
        assert_int_equal(found.count, 3);
        assert_memory_equal(found.clauses, expected, sizeof expected);
        assert_int_equal(found.plans.count, 3);
    }
    tn_search_conflict_clear(&found);
    tn_plan_search_free(search);
    return status;
}

/* Of five narrow trays, the nearest plans have two wide ones, and are all of the library's; of these the hall is narrow
 * or wide. */
static tn_status near_and_front(void)
{
    const tn_tray middle[5] = {1, 1, 0, 1, 1}; /* of five narrow trays */
    const bool most[2] = {true, false};
    const uint32_t sums[2] = {module->MEASURE_records[0].sum, module->MEASURE_records[0].sum};
    tn_searched_plans plans = {0};
    tn_searched_front front = {0};
    tn_plan_search *search;
    tn_error error;
    uint32_t distance = 0;
    bool more = true;
    tn_status status = tn_plan_search_new(schema, 0, NULL, &search, &error);
    if (status != TN_OK)
        return status;
    status = tn_plan_search_near(search, middle, 5, 9, &plans, &distance, &more, &error);
    if (status == TN_OK) {
        assert_int_equal(plans.count, 3);
        assert_int_equal(distance, 2);
        assert_false(more);
    }
    tn_searched_plans_clear(&plans);
    tn_plan_search_free(search);
    if (status == TN_OK)
        status = tn_plan_search_new(schema, 0, NULL, &search, &error);
    if (status != TN_OK)
        return status;
    status = tn_plan_search_front(search, sums, most, 2, &front, &error);
    if (status == TN_OK) {
        assert_true(front.proven);
        assert_int_equal(front.count, 2); /* as many halls that are narrow as can be, and as few */
    }
    tn_searched_front_clear(&front);
    tn_plan_search_free(search);
    return status;
}

/* Plans begin with two rooms, and none with more than what may follow; the library has none that it has not itself. */
static tn_status open_and_without(void)
{
    bool rooms[6] = {false, true, false, false, true, false}, none[6] = {false};
    const tn_open_tray parts[4] = {{.fits = rooms}, {.fits = rooms}, {.gap = true}, {.fits = none}};
    const tn_open_plan open = {.trays = parts, .count = 3}, wrong = {.trays = parts, .count = 4};
    const uint32_t fields[2] = {0, 1};
    const uint8_t values[5] = {0, 1, 0, 1, 2};
    const tn_tray same[6] = {0, 1, 2, 3, 4, 5};
    const tn_tray *trays;
    tn_plan_search *search, *other = NULL;
    tn_error error;
    uint32_t length;
    size_t begins = 0;
    bool any = false;
    tn_status status = tn_plan_search_new(schema, 0, NULL, &search, &error);
    if (status != TN_OK)
        return status;
    status = tn_plan_search_beginning(search, &wrong, &any, &begins, &error);
    assert_true(status != TN_OK || (any && begins == 3));
    if (status == TN_OK)
        status = tn_plan_search_new(schema, 0, NULL, &other, &error);
    const tn_search_other left_out = {other, fields, values, same};
    tn_plan_search_narrow(search, &open);
    if (status == TN_OK) {
        tn_plan_search_leave_out(search, &left_out);
        status = tn_plan_search_next(search, &trays, &length, &error);
        assert_true(status != TN_OK || !trays);
    }
    tn_plan_search_free(search);
    tn_plan_search_free(other);
    return status;
}

static void test_memory(void **state)
{
    (void)state;
    fail_each(all_plans, false);
    fail_each(drawn_and_best, false);
    fail_each(conflict, false);
    fail_each(near_and_front, false);
    fail_each(open_and_without, false);
}

/* Brute force: all plans of five trays, judged by the interpreter. */
static uint32_t count_plans(void)
{
    tn_plan_search *search;
    tn_tray trays[5];
    uint32_t kept = 0;
    assert_int_equal(tn_plan_search_new(schema, 0, NULL, &search, NULL), TN_OK);
    for (uint32_t code = 0; code < 6 * 6 * 6 * 6 * 6; code++) {
        bool keeps;
        for (uint32_t i = 0, rest = code; i < 5; i++, rest /= 6)
            trays[i] = rest % 6;
        assert_int_equal(tn_plan_search_keeps(search, trays, 5, &keeps, NULL), TN_OK);
        kept += keeps;
    }
    tn_plan_search_free(search);
    return kept;
}

/* As many plans with all clauses as gates, and with some or all of them judged by the interpreter. */
static void test_judged(void **state)
{
    (void)state;
    uint32_t expected = count_plans(), found;
    assert_int_equal(expected, 3);
    for (uint32_t gates = 60; gates < 3000; gates += gates / 2) {
        assert_int_equal(find_plans(gates, &found), TN_OK);
        assert_int_equal(found, expected);
    }
    assert_int_equal(find_plans(10, &found), TN_LIMIT); /* not even the trays */
}

static int setup(void **state)
{
    static tn_compilation compilation;
    module = load_plan(text, &compilation);
    assert_int_equal(tn_schema_new(module, 0, 0, &schema, NULL), TN_OK);
    *state = &compilation;
    return 0;
}

static int teardown(void **state)
{
    tn_schema_free(schema);
    tn_module_free(module);
    tn_compilation_clear(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_judged),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
