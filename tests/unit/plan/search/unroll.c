/* Rules as gates: what they say of each plan is what the interpreter says, for random rules and plans. */
#include "runtime/plan/search/unroll.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

#define RULES 400
#define PLANS 6
#define LONGEST 6

typedef struct asked {
    tn_schema *schema;
    tn_circuit *circuit;
    tn_letters letters;
    tn_plan_vm *vm;
} asked;

/* Can the trays be these, with a gate? */
static bool is_possible(const asked *a, const tn_tray *trays, tn_signal gate)
{
    tn_signal assumed[LONGEST * TEST_FIELDS_MAX + 1];
    size_t count = 0;
    tn_solver_answer answer;
    tn_error error;
    for (uint32_t k = 0; k < a->letters.length; k++)
        for (uint32_t f = 0; f < a->schema->field_count; f++)
            assumed[count++] = tn_letters_is(&a->letters, k, f, tn_tray_value(a->schema, trays[k], f));
    assumed[count++] = gate;
    test_ok(tn_circuit_solve(a->circuit, assumed, count, 100000, NULL, &answer, &error), &error);
    assert_int_not_equal(answer, TN_SOLVER_UNDECIDED);
    return answer == TN_SOLVER_YES;
}

static void check_plans(test_random *random, const asked *a, uint32_t function, tn_signal gate)
{
    for (unsigned i = 0; i < PLANS; i++) {
        test_plan plan;
        tn_tray trays[TEST_LENGTH_MAX];
        bool holds;
        tn_error error;
        test_plan_random(random, a->schema, a->letters.length, &plan, trays);
        test_ok(tn_plan_vm_plan(a->vm, trays, a->letters.length, &error), &error);
        test_ok(tn_plan_vm_holds(a->vm, function, &holds, &error), &error);
        assert_int_equal(is_possible(a, trays, gate), holds);
        assert_int_equal(is_possible(a, trays, tn_signal_not(gate)), !holds);
    }
}

static void check_length(test_random *random, asked *a, uint32_t function, uint32_t length)
{
    tn_unrolled *unrolled;
    tn_signal gate;
    tn_error error;
    test_ok(tn_circuit_new(1u << 20, &a->circuit, &error), &error);
    test_ok(tn_letters_make(&a->letters, a->circuit, a->schema, length, &error), &error);
    test_ok(tn_unrolled_new(&a->letters, &unrolled, &error), &error);
    test_ok(tn_unrolled_holds(unrolled, function, &gate, &error), &error);
    check_plans(random, a, function, gate);
    tn_unrolled_free(unrolled);
    tn_letters_clear(&a->letters);
    tn_circuit_free(a->circuit);
}

static void check_rule(uint64_t seed, const test_schema *schema)
{
    test_random random = {.seed = seed};
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, schema);
    test_rule *rule = test_rule_random(&random, schema, 4, true);
    uint32_t whole, holds;
    tn_error error;
    test_rule_emit(builder, rule, &whole, &holds);
    tn_module *module = test_module(builder);
    asked a = {.schema = test_schema_open(module, 0)};
    test_ok(tn_plan_vm_new(a.schema, LONGEST, &a.vm, &error), &error);
    for (uint32_t length = 0; length <= LONGEST; length++)
        check_length(&random, &a, holds, length);
    tn_plan_vm_free(a.vm);
    tn_schema_free(a.schema);
    tn_module_free(module);
    test_rule_free(rule);
}

static void test_as_interpreted(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= RULES; seed++)
        check_rule(seed, seed % 2 ? &test_schema_house : &test_schema_tiny);
}

/* What was made before a limit was passed stays, and others can be asked. */
static void test_limit(void **state)
{
    (void)state;
    tn_circuit *circuit;
    tn_error error;
    test_ok(tn_circuit_new(4, &circuit, &error), &error);
    tn_signal a = tn_circuit_input(circuit), b = tn_circuit_input(circuit), c = tn_circuit_input(circuit);
    assert_int_equal(tn_circuit_and(circuit, a, b), TN_SIGNAL_FALSE);
    assert_int_equal(tn_circuit_status(circuit, &error), TN_LIMIT);
    assert_int_equal(error.code, E_SEARCH_TOO_LARGE);
    tn_circuit_go_on(circuit);
    assert_int_not_equal(tn_circuit_and(circuit, a, c), TN_SIGNAL_FALSE);
    assert_int_equal(tn_circuit_status(circuit, &error), TN_OK);
    tn_circuit_free(circuit);
}

/* Gates that are alike are one, and constants are seen. */
static void test_gates(void **state)
{
    (void)state;
    tn_circuit *circuit;
    tn_error error;
    test_ok(tn_circuit_new(100, &circuit, &error), &error);
    tn_signal a = tn_circuit_input(circuit), b = tn_circuit_input(circuit), c = tn_circuit_input(circuit);
    assert_int_equal(tn_circuit_and(circuit, a, b), tn_circuit_and(circuit, b, a));
    assert_int_equal(tn_circuit_and(circuit, a, tn_signal_not(a)), TN_SIGNAL_FALSE);
    assert_int_equal(tn_circuit_or(circuit, a, tn_signal_not(a)), TN_SIGNAL_TRUE);
    assert_int_equal(tn_circuit_and(circuit, a, a), a);
    assert_int_equal(tn_circuit_choose(circuit, a, b, b), b);
    assert_int_equal(tn_circuit_choose(circuit, a, TN_SIGNAL_TRUE, TN_SIGNAL_FALSE), a);
    assert_int_equal(tn_circuit_choose(circuit, tn_signal_not(a), b, c), tn_circuit_choose(circuit, a, c, b));
    assert_int_equal(tn_circuit_all(circuit, NULL, 0), TN_SIGNAL_TRUE);
    tn_circuit_free(circuit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gates),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_as_interpreted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
