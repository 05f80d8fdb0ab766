#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/match/condition.h"
#include "tests/support/test_rule.h"

#define STEPS 4000

/* The least (threshold, period), found by trying all of them on the first STEPS values. */
static void slow_period(const test_condition *condition, int64_t unit, uint64_t *threshold, uint64_t *period)
{
    for (*period = 1;; ++*period) {
        *threshold = STEPS - *period;
        while (*threshold > 0 && test_condition_holds(condition, (int64_t)(*threshold - 1) * unit) ==
                                     test_condition_holds(condition, (int64_t)(*threshold - 1 + *period) * unit))
            --*threshold;
        if (*threshold < STEPS / 2)
            return;
    }
}

static void compare(test_random *random, int64_t constant_unit, int64_t unit)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, &test_schema_tiny);
    test_condition *condition = test_condition_random(random, constant_unit, 3);
    uint32_t function = test_condition_emit(builder, condition);
    tn_module *module = test_module(builder);
    for (int64_t n = 0; n < 40; n++)
        assert_int_equal(tn_condition_holds(module, function, n * unit), test_condition_holds(condition, n * unit));
    uint64_t threshold, period, slow_threshold, slow;
    tn_error error;
    test_ok(tn_condition_period(module, function, unit, 1000000, &threshold, &period, &error), &error);
    slow_period(condition, unit, &slow_threshold, &slow);
    assert_int_equal(period, slow);
    assert_int_equal(threshold, slow_threshold);
    tn_module_free(module);
    test_condition_free(condition);
}

static void test_counts(void **state)
{
    (void)state;
    test_random random = {.seed = 11};
    for (int n = 0; n < 500; n++)
        compare(&random, 1, 1);
}

/* Constants in multiples of 4' (and sometimes half of that), asked in steps of 4' or 1'. */
static void test_lengths(void **state)
{
    (void)state;
    test_random random = {.seed = 12};
    for (int n = 0; n < 300; n++)
        compare(&random, 4 * TN_FOOT_NM, n % 2 ? 4 * TN_FOOT_NM : TN_FOOT_NM);
}

static uint32_t emit_one(tn_builder *builder, tn_opcode opcode, int64_t first, int64_t second)
{
    test_condition condition = {.opcode = opcode, .first = first, .second = second};
    return test_condition_emit(builder, &condition);
}

static void test_extremes(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_tiny);
    uint32_t never = emit_one(builder, TN_OP_LESS, INT64_MIN, 0);
    uint32_t far = emit_one(builder, TN_OP_GREATER, INT64_MAX, 0);
    uint32_t wide = emit_one(builder, TN_OP_WITHIN, INT64_MIN, INT64_MAX);
    uint32_t slow = emit_one(builder, TN_OP_REMAINDER, INT64_MAX, 1);
    uint32_t impossible = emit_one(builder, TN_OP_REMAINDER, 6, 7);
    tn_module *module = test_module(builder);
    uint64_t threshold, period;
    tn_error error;
    assert_false(tn_condition_holds(module, far, INT64_MAX));
    assert_true(tn_condition_holds(module, wide, 0));
    test_ok(tn_condition_period(module, never, 1, 10, &threshold, &period, &error), &error);
    assert_int_equal(threshold, 0);
    assert_int_equal(period, 1);
    test_ok(tn_condition_period(module, impossible, 1, 10, &threshold, &period, &error), &error);
    assert_int_equal(period, 1);
    const uint32_t refused[] = {far, wide, slow};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(tn_condition_period(module, refused[i], 1, 1000, &threshold, &period, &error), TN_LIMIT);
        assert_int_equal(error.code, 802);
        assert_int_not_equal(error.code_offset, TN_NO_OFFSET);
    }
    tn_module_free(module);
}

/* n mod 2 = 0, n mod 3 = 0, n mod 5 = 0, ... multiply; the limit stops that. */
static void test_periods_multiply(void **state)
{
    (void)state;
    static const int64_t primes[] = {2, 3, 5, 7, 11, 13, 17, 19};
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_tiny);
    uint32_t functions[8];
    for (int count = 1; count <= 8; count++) {
        uint32_t begin = tn_builder_offset(builder);
        for (int i = 0; i < count; i++) {
            tn_builder_emit(builder, TN_OP_REMAINDER, primes[i], 0);
            if (i > 0)
                tn_builder_emit(builder, TN_OP_BOTH, 0, 0);
        }
        tn_builder_emit(builder, TN_OP_ANSWER, 0, 0);
        functions[count - 1] =
            tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, "E"),
                                                                   .kind = TN_FUNCTION_CONDITION,
                                                                   .code_begin = begin,
                                                                   .code_end = tn_builder_offset(builder),
                                                                   .stack_max = count > 1 ? 2 : 1});
    }
    tn_module *module = test_module(builder);
    uint64_t threshold, period;
    tn_error error;
    test_ok(tn_condition_period(module, functions[4], 1, 5000, &threshold, &period, &error), &error);
    assert_int_equal(period, 2310);
    assert_int_equal(threshold, 0);
    assert_int_equal(tn_condition_period(module, functions[7], 1, 5000, &threshold, &period, &error), TN_LIMIT);
    tn_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_lengths),
        cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_periods_multiply),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
