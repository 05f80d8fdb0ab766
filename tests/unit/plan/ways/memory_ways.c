/* Counting derivations where memory runs out at each allocation in turn: of one plan, and of a library, told apart or
 * added up. An error, and nothing is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/ways/library_ways.h"
#include "runtime/plan/ways/plan_ways.h"
#include "tests/support/fail_each.h"
#include "tests/support/load_plan.h"

static const char text[] = "schema s { use = hall | room }\n"
                           "rule right = tray(hall) or neighbour(tray(room), left)\n"
                           "rule left = right or neighbour(left, many(tray(hall)), optional(right))\n"
                           "rule near = tray(hall) beside tray(room)\n"
                           "library l { trays 0..4 generate repeat(left or (near and any), 1..2)"
                           " or symmetric neighbour(beginning, near, not near) }\n";

static struct {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *schema;
    tn_library *library;
    uint32_t function;
} opened;

static int setup(void **state)
{
    (void)state;
    opened.module = load_plan(text, &opened.compilation);
    assert_int_equal(tn_schema_new(opened.module, 0, 0, &opened.schema, NULL), TN_OK);
    assert_int_equal(tn_library_new(opened.schema, 0, NULL, &opened.library, NULL), TN_OK);
    opened.function = opened.module->CLAUSE_records[tn_library_generator(opened.library)].holds;
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

static tn_status one_plan(void)
{
    static const tn_tray trays[] = {1, 0, 0, 0};
    tn_derivation derivation;
    tn_plan_vm *vm = NULL;
    tn_error error = {0};
    mpz_t ways;
    mpz_init(ways);
    tn_status status = tn_derivation_read(opened.module, opened.function, &derivation, &error);
    if (status == TN_OK)
        status = tn_plan_vm_new(opened.schema, 0, &vm, &error);
    if (status == TN_OK)
        status = tn_plan_ways(&derivation, vm, trays, 4, ways, &error);
    assert_true(status != TN_OK || mpz_sgn(ways) > 0);
    tn_plan_vm_free(vm);
    tn_derivation_clear(&derivation);
    mpz_clear(ways);
    return status;
}

static tn_status count(uint32_t max_nodes)
{
    tn_derived_ways found;
    tn_error error = {0};
    tn_status status = tn_library_count_ways(opened.library, max_nodes, &found, &error);
    assert_true(status != TN_OK || mpz_cmp(found.ways, found.plans) > 0);
    tn_derived_ways_clear(&found);
    return status;
}

static tn_status told_apart(void)
{
    return count(0);
}

static tn_status added_up(void)
{
    return count(1);
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
