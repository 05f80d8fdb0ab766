/* Rules that repeat and rules that use themselves, where memory runs out at each allocation in turn: interpreted,
 * turned into automata (by elimination, and round by round), and asked how far a plan goes. An error, and nothing is
 * lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/analysis/generated.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/failing_memory.h"
#include "tests/support/load_plan.h"
#include "tests/support/test_rule.h"

static const char text[] = "schema s { use = hall | room }\n"
                           "rule right = tray(hall) or neighbour(tray(room), left)\n"
                           "rule left = right or neighbour(many(tray(hall)), optional(right))\n"
                           "rule middle = tray(hall) or neighbour(tray(room), middle, tray(room))\n"
                           "rule twice = repeat(neighbour(tray(hall), tray(room)), 2..3)\n"
                           "library l { trays 0..5 generate repeat(middle, 1..) }\n";

typedef struct opened {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *schema;
} opened;

static int setup(void **state)
{
    static opened o;
    o.module = load_plan(text, &o.compilation);
    assert_int_equal(tn_schema_new(o.module, 0, 0, &o.schema, NULL), TN_OK);
    *state = &o;
    return 0;
}

static int teardown(void **state)
{
    opened *o = *state;
    tn_schema_free(o->schema);
    tn_module_free(o->module);
    tn_compilation_clear(&o->compilation);
    return 0;
}

typedef tn_status question(const opened *o, uint32_t function, tn_error *error);

static tn_status lowered(const opened *o, uint32_t function, tn_error *error)
{
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_status status = tn_classes_new(o->schema, &function, 1, &classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(classes, 0, &lowering, error);
    if (status == TN_OK) {
        tn_lowering_within(lowering, 5);
        status = tn_lower(lowering, function, &dfa, error);
    }
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return status;
}

static tn_status interpreted(const opened *o, uint32_t function, tn_error *error)
{
    static const tn_tray trays[] = {1, 0, 1, 0, 1};
    tn_plan_vm *vm = NULL;
    bool holds = false;
    tn_status status = tn_plan_vm_new(o->schema, 0, &vm, error);
    if (status == TN_OK)
        status = tn_plan_vm_plan(vm, trays, 5, error);
    if (status == TN_OK)
        status = tn_plan_vm_holds(vm, function, &holds, error);
    assert_true(holds || status != TN_OK);
    tn_plan_vm_free(vm);
    return status;
}

static tn_status begun(const opened *o, uint32_t function, tn_error *error)
{
    static const tn_tray trays[] = {1, 0, 0};
    tn_generated_beginning beginning;
    (void)function;
    tn_status status =
        tn_generated_beginning_find(o->schema, o->module->CLAUSE_records[0].holds, 0, 5, trays, 3, &beginning, error);
    if (status == TN_OK) /* `1 0 1` is one, and no other begins so */
        assert_true(beginning.known && beginning.length == 2 && !beginning.may_end && beginning.count == 1);
    tn_generated_beginning_clear(&beginning);
    return status;
}

static void fail_each(const opened *o, question *ask)
{
    for (size_t r = 0; r < o->module->RULE_count; r++) {
        for (size_t failing = 0;; failing++) {
            tn_error error = {0};
            fail_allocation(failing, 0);
            tn_status status = ask(o, o->module->RULE_records[r].holds, &error);
            size_t asked = stop_failing();
            if (asked <= failing) {
                assert_int_equal(status, TN_OK);
                break;
            }
            assert_int_equal(status, TN_MEMORY);
            assert_int_equal(error.status, status);
        }
    }
}

static void test_lowering(void **state)
{
    fail_each(*state, lowered);
}

static void test_interpreting(void **state)
{
    fail_each(*state, interpreted);
}

static void test_beginnings(void **state)
{
    fail_each(*state, begun);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lowering), cmocka_unit_test(test_interpreting),
                                       cmocka_unit_test(test_beginnings)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
