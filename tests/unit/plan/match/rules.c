/* Rule sets: the automata decide as the brute force and the reference engine do. */
#include "runtime/plan/match/rules.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

#define RULES 24
#define PLANS 60

typedef struct test_set {
    test_rule *rules[RULES];
    uint32_t functions[RULES];
    tn_module *module;
    tn_schema *schema;
} test_set;

static void set_make(test_set *set, test_random *random, const test_schema *schema, unsigned depth, bool extensions)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, schema);
    for (size_t i = 0; i < RULES; i++) {
        uint32_t whole;
        set->rules[i] = test_rule_random(random, schema, depth, extensions);
        test_rule_emit(builder, set->rules[i], &whole, &set->functions[i]);
    }
    set->module = test_module(builder);
    set->schema = test_schema_open(set->module, 0);
}

static void set_clear(test_set *set)
{
    for (size_t i = 0; i < RULES; i++)
        test_rule_free(set->rules[i]);
    tn_schema_free(set->schema);
    tn_module_free(set->module);
}

static tn_rules *compile(const test_set *set, tn_matching_engine engine, uint32_t max_states)
{
    tn_rules_options options = {.engine = engine, .max_states = max_states};
    tn_rules *rules = NULL;
    tn_error error;
    test_ok(tn_rules_new(set->schema, set->functions, RULES, &options, &rules, &error), &error);
    return rules;
}

static uint64_t match(tn_matcher *matcher, const tn_tray *trays, uint32_t length)
{
    uint64_t bits = ~UINT64_C(0);
    tn_error error;
    test_ok(tn_match(matcher, trays, length, &bits, &error), &error);
    return bits;
}

static void differ(const test_set *set, const test_schema *schema, size_t i, const tn_tray *trays, uint32_t length,
                   bool expected)
{
    fprintf(stderr, "rule: ");
    test_rule_print(schema, set->rules[i], stderr);
    fprintf(stderr, "\nplan:");
    for (uint32_t k = 0; k < length; k++)
        fprintf(stderr, " %u", trays[k]);
    fail_msg("rule %zu should %smatch", i, expected ? "" : "not ");
}

/* Random rules on random plans: brute force, reference engine and automata agree. Returns how many rules fell back. */
static size_t compare(uint64_t seed, const test_schema *schema, unsigned depth, bool extensions)
{
    test_random random = {.seed = seed};
    test_set set;
    set_make(&set, &random, schema, depth, extensions);
    tn_rules *fast = compile(&set, TN_ENGINE_AUTO, 1000), *slow = compile(&set, TN_ENGINE_VM, 0);
    tn_matcher *fast_matcher, *slow_matcher;
    tn_error error;
    test_ok(tn_matcher_new(fast, &fast_matcher, &error), &error);
    test_ok(tn_matcher_new(slow, &slow_matcher, &error), &error);
    test_brute *brute = malloc(sizeof *brute);
    assert_non_null(brute);
    for (uint32_t p = 0; p < PLANS; p++) {
        tn_tray trays[TEST_LENGTH_MAX];
        test_plan plan;
        test_plan_random(&random, set.schema, p % 8, &plan, trays);
        uint64_t bits = match(fast_matcher, trays, plan.length);
        assert_int_equal(bits, match(slow_matcher, trays, plan.length));
        assert_int_equal(bits >> RULES, 0);
        for (size_t i = 0; i < RULES; i++) {
            test_brute_start(brute, schema, &plan);
            bool expected = test_brute_holds(brute, set.rules[i], 0, plan.length);
            if (expected != (bits >> i & 1))
                differ(&set, schema, i, trays, plan.length, expected);
        }
    }
    size_t fallen = 0;
    for (size_t i = 0; i < RULES; i++) {
        fallen += tn_rules_fallback(fast, i) != NULL;
        assert_int_equal(tn_rules_fallback(fast, i) == NULL, tn_rules_states(fast, i) > 0);
    }
    free(brute);
    tn_matcher_free(fast_matcher);
    tn_matcher_free(slow_matcher);
    tn_rules_free(fast);
    tn_rules_free(slow);
    set_clear(&set);
    return fallen;
}

static void random_rules_agree(void **state)
{
    (void)state;
    size_t fallen = 0, all = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        fallen += compare(seed, &test_schema_tiny, 2, false);
        fallen += compare(seed + 100, &test_schema_house, 3, false);
        all += 2 * RULES;
    }
    assert_true(fallen * 10 < all);
}

static void random_rules_with_extensions_agree(void **state)
{
    (void)state;
    size_t fallen = 0, all = 0;
    for (uint64_t seed = 200; seed < 212; seed++) {
        fallen += compare(seed, &test_schema_tiny, 2, true);
        fallen += compare(seed + 100, &test_schema_house, 3, true);
        all += 2 * RULES;
    }
    assert_true(fallen * 5 < all);
}

/* ---- code that no compiler emits: any operations on any relations, which the two engines must still agree on */

#define FUNCTIONS 40

typedef struct code_writer {
    test_random random;
    tn_builder *builder;
    uint32_t depth, depth_max;
    uint32_t first_function, functions; /* rule functions so far */
    uint32_t specs[4], conditions[6];
} code_writer;

static void write_op(code_writer *writer, tn_opcode opcode, int64_t first, int64_t second, uint32_t pops)
{
    tn_builder_emit(writer->builder, opcode, first, second);
    writer->depth += 1 - pops;
    if (writer->depth > writer->depth_max)
        writer->depth_max = writer->depth;
}

/* An instruction that fits the stack's depth. */
static void write_random_op(code_writer *writer)
{
    static const tn_opcode one[] = {TN_OP_NOT,       TN_OP_SOMEWHERE, TN_OP_NONEMPTY, TN_OP_OPTIONAL,
                                    TN_OP_BEGINNING, TN_OP_END,       TN_OP_MANY};
    uint32_t condition = writer->conditions[test_random_below(&writer->random, 6)];
    uint32_t pick = test_random_below(&writer->random, 20);
    if (writer->depth >= 3 && pick < 4) {
        write_op(writer, TN_OP_DISTANCE, 0, 0, 3);
    } else if (writer->depth >= 2 && pick < 9) {
        static const tn_opcode two[] = {TN_OP_AND, TN_OP_OR, TN_OP_CHAIN};
        write_op(writer, two[test_random_below(&writer->random, 3)], 0, 0, 2);
    } else if (writer->depth >= 1 && pick < 13) {
        write_op(writer, one[test_random_below(&writer->random, 7)], 0, 0, 1);
    } else if (writer->depth >= 1 && pick < 15) {
        write_op(writer, pick == 13 ? TN_OP_QUANTITY : TN_OP_OCCURRENCES, condition, 0, 1);
    } else if (writer->depth >= 1 && pick == 15) {
        write_op(writer, TN_OP_SUM, 0, condition, 1);
    } else if (writer->functions > writer->first_function && pick < 18) {
        uint32_t known = test_random_below(&writer->random, writer->functions - writer->first_function);
        write_op(writer, pick == 16 ? TN_OP_CALL : TN_OP_MIRROR, writer->first_function + known, 0, 0);
    } else {
        write_op(writer, TN_OP_TRAY, writer->specs[test_random_below(&writer->random, 4)], 0, 0);
    }
}

static uint32_t write_function(code_writer *writer)
{
    uint32_t begin = tn_builder_offset(writer->builder);
    writer->depth = writer->depth_max = 0;
    for (uint32_t i = test_random_below(&writer->random, 7); i > 0; i--)
        write_random_op(writer);
    if (writer->depth == 0)
        write_op(writer, TN_OP_TRAY, writer->specs[0], 0, 0);
    while (writer->depth > 1)
        write_op(writer, test_random_below(&writer->random, 2) ? TN_OP_CHAIN : TN_OP_OR, 0, 0, 2);
    tn_builder_emit(writer->builder, TN_OP_RETURN, 0, 0);
    tn_function_record record = {.name = tn_builder_string(writer->builder, "f"),
                                 .kind = TN_FUNCTION_HOLDS,
                                 .code_begin = begin,
                                 .code_end = tn_builder_offset(writer->builder),
                                 .stack_max = writer->depth_max};
    return tn_builder_add_FUNCTION(writer->builder, &record);
}

static tn_module *random_code(uint64_t seed, uint32_t *functions)
{
    code_writer writer = {.random = {.seed = seed}, .builder = tn_builder_new()};
    assert_non_null(writer.builder);
    test_schema_add(writer.builder, &test_schema_tiny);
    for (uint64_t i = 0; i < 4; i++)
        writer.specs[i] = test_spec_add(writer.builder, 0, (uint64_t[]){0xB, 0xD, 0xF, 0x6}[i]);
    for (uint32_t i = 0; i < 6; i++) {
        test_condition *condition = test_condition_random(&writer.random, i < 4 ? 1 : 4 * TN_FOOT_NM, 1);
        writer.conditions[i] = test_condition_emit(writer.builder, condition);
        test_condition_free(condition);
    }
    writer.first_function = writer.conditions[5] + 1;
    writer.functions = writer.first_function;
    for (uint32_t i = 0; i < FUNCTIONS; i++) {
        functions[i] = write_function(&writer);
        writer.functions = functions[i] + 1;
    }
    return test_module(writer.builder);
}

/* Both engines on random plans; returns how many functions fell back. */
static size_t compare_functions(const tn_module *module, const uint32_t *functions, size_t count, uint64_t seed)
{
    tn_schema *schema = test_schema_open(module, 0);
    tn_rules *fast = NULL, *slow = NULL;
    tn_matcher *fast_matcher = NULL, *slow_matcher = NULL;
    tn_error error;
    tn_rules_options small = {.max_states = 300}, vm = {.engine = TN_ENGINE_VM};
    test_ok(tn_rules_new(schema, functions, count, &small, &fast, &error), &error);
    test_ok(tn_rules_new(schema, functions, count, &vm, &slow, &error), &error);
    test_ok(tn_matcher_new(fast, &fast_matcher, &error), &error);
    test_ok(tn_matcher_new(slow, &slow_matcher, &error), &error);
    test_random random = {.seed = seed + 1};
    for (uint32_t p = 0; p < 80; p++) {
        tn_tray trays[8];
        for (uint32_t i = 0; i < p % 8; i++)
            trays[i] = test_random_below(&random, 4);
        uint64_t by_automata = match(fast_matcher, trays, p % 8), by_vm = match(slow_matcher, trays, p % 8);
        for (size_t i = 0; i < count; i++)
            if ((by_automata ^ by_vm) >> i & 1)
                fail_msg("seed %llu: function %zu should be %d", (unsigned long long)seed, i, (int)(by_vm >> i & 1));
    }
    size_t fallen = 0;
    for (size_t i = 0; i < count; i++)
        fallen += tn_rules_fallback(fast, i) != NULL;
    tn_matcher_free(fast_matcher);
    tn_matcher_free(slow_matcher);
    tn_rules_free(fast);
    tn_rules_free(slow);
    tn_schema_free(schema);
    return fallen;
}

static uint32_t add_code(tn_builder *builder, tn_function_kind kind, const int64_t (*code)[2], size_t count)
{
    tn_function_record record = {.name = tn_builder_string(builder, "f"), .kind = kind, .stack_max = 3};
    record.code_begin = tn_builder_offset(builder);
    for (size_t i = 0; i < count; i++)
        tn_builder_emit(builder, (tn_opcode)code[i][0], code[i][1], 0);
    tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
    record.code_end = tn_builder_offset(builder);
    return tn_builder_add_FUNCTION(builder, &record);
}

/* Where source and destination overlap, the gap is the empty stretch at the source's start; mirrored, at its end. The
 * separator here holds only at the plan's beginning, so that it matters. */
static void overlaps_mirror(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, &test_schema_tiny);
    uint32_t any = test_spec_add(builder, 0, 0xF), open = test_spec_add(builder, 0, 0xB);
    const int64_t distance[][2] = {{TN_OP_TRAY, any},   {TN_OP_MANY, 0},      {TN_OP_TRAY, open}, {TN_OP_TRAY, any},
                                   {TN_OP_OPTIONAL, 0}, {TN_OP_BEGINNING, 0}, {TN_OP_DISTANCE, 0}};
    uint32_t whole = add_code(builder, TN_FUNCTION_WHOLE, distance, 7), functions[3];
    for (size_t i = 0; i < 3; i++) {
        const int64_t code[][2] = {{i == 1 ? TN_OP_MIRROR : TN_OP_CALL, i == 2 ? functions[1] : whole},
                                   {TN_OP_SOMEWHERE, 0}};
        functions[i] = add_code(builder, TN_FUNCTION_HOLDS, code, 2);
    }
    tn_module *module = test_module(builder);
    assert_int_equal(compare_functions(module, functions, 3, 1), 0);
    tn_module_free(module);
}

static void random_code_agrees(void **state)
{
    (void)state;
    size_t fallen = 0;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        uint32_t functions[FUNCTIONS];
        tn_module *module = random_code(seed, functions);
        fallen += compare_functions(module, functions, FUNCTIONS, seed);
        tn_module_free(module);
    }
    assert_true(fallen * 4 < 40 * FUNCTIONS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_rules_agree),
        cmocka_unit_test(random_rules_with_extensions_agree),
        cmocka_unit_test(overlaps_mirror),
        cmocka_unit_test(random_code_agrees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
