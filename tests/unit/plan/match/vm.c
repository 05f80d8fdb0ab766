#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/compile_file.h"
#include "tests/support/test_rule.h"

/* ---- against the brute force */

static void report(const test_schema *schema, const test_rule *rule, const test_plan *plan)
{
    test_rule_print(schema, rule, stderr);
    fprintf(stderr, "\nplan:");
    for (uint32_t k = 0; k < plan->length; k++) {
        for (uint32_t f = 0; f < schema->field_count; f++)
            fprintf(stderr, " %s", schema->fields[f].values[plan->values[k][f]].spelling);
        fprintf(stderr, k + 1 < plan->length ? " |" : "\n");
    }
}

/* M and H on every stretch. */
static void compare_plan(tn_plan_vm *vm, const tn_rule_record *record, const test_schema *schema, const test_rule *rule,
                         test_brute *brute, const test_plan *plan, const tn_tray *trays)
{
    tn_error error;
    test_ok(tn_plan_vm_plan(vm, trays, plan->length, &error), &error);
    test_brute_start(brute, schema, plan);
    for (uint32_t i = 0; i <= plan->length; i++) {
        for (uint32_t j = i; j <= plan->length; j++) {
            bool whole, holds;
            test_ok(tn_plan_vm_relation(vm, record->whole, i, j, &whole, &error), &error);
            test_ok(tn_plan_vm_relation(vm, record->holds, i, j, &holds, &error), &error);
            if (whole == test_brute_whole(brute, rule, i, j) && holds == test_brute_holds(brute, rule, i, j))
                continue;
            report(schema, rule, plan);
            fail_msg("[%u, %u): the engine says M %d, H %d", i, j, whole, holds);
        }
    }
}

/* How many plans of which lengths a rule is tried on. */
typedef struct trial {
    unsigned depth;
    uint32_t plans, shortest, longest;
    bool extensions;
} trial;

static void compare_rule(test_random *random, const test_schema *schema, const trial *how, test_brute *brute)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    uint32_t index = test_schema_add(builder, schema);
    test_rule *rule = test_rule_random(random, schema, 1 + test_random_below(random, how->depth), how->extensions);
    uint32_t record = test_rule_add(builder, "r", rule);
    tn_module *module = test_module(builder);
    tn_schema *ready = test_schema_open(module, index);
    tn_plan_vm *vm = NULL;
    tn_error error;
    test_ok(tn_plan_vm_new(ready, 0, &vm, &error), &error);
    for (uint32_t n = 0; n < how->plans; n++) {
        test_plan plan;
        tn_tray trays[TEST_LENGTH_MAX];
        uint32_t length = how->shortest + n % (how->longest - how->shortest + 1);
        test_plan_random(random, ready, length, &plan, trays);
        compare_plan(vm, &module->RULE_records[record], schema, rule, brute, &plan, trays);
    }
    tn_plan_vm_free(vm);
    tn_schema_free(ready);
    tn_module_free(module);
    test_rule_free(rule);
}

static void compare_many(uint64_t seed, uint32_t rules, const trial *how)
{
    test_random random = {.seed = seed};
    test_brute *brute = malloc(sizeof *brute);
    assert_non_null(brute);
    for (uint32_t n = 0; n < rules; n++)
        compare_rule(&random, n % 3 == 0 ? &test_schema_tiny : &test_schema_house, how, brute);
    free(brute);
}

static void test_paper_rules_equal_brute_force(void **state)
{
    (void)state;
    compare_many(1, 600, &(trial){.depth = 4, .plans = 12, .shortest = 0, .longest = 7});
}

static void test_extensions_equal_brute_force(void **state)
{
    (void)state;
    compare_many(2, 600, &(trial){.depth = 4, .plans = 12, .shortest = 0, .longest = 7, .extensions = true});
}

/* Plans around the 63 trays up to which a row is one word. */
static void test_wide_rows_equal_brute_force(void **state)
{
    (void)state;
    compare_many(3, 60, &(trial){.depth = 2, .plans = 3, .shortest = 63, .longest = 65, .extensions = true});
}

/* ---- hostile or large modules, and limits */

/* `count` functions, each calling or mirroring the one before it. */
static tn_module *chain_module(uint32_t count, tn_opcode opcode)
{
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_tiny);
    uint32_t spec = test_spec_add(builder, 0, 0xd); /* width 4' */
    tn_string name = tn_builder_string(builder, "f");
    for (uint32_t n = 0; n < count; n++) {
        uint32_t begin = tn_builder_offset(builder);
        if (n == 0)
            tn_builder_emit(builder, TN_OP_TRAY, spec, 0);
        else
            tn_builder_emit(builder, opcode, n - 1, 0);
        tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
        tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = name,
                                                               .kind = TN_FUNCTION_HOLDS,
                                                               .code_begin = begin,
                                                               .code_end = tn_builder_offset(builder),
                                                               .stack_max = 1});
    }
    return test_module(builder);
}

static void test_long_call_chain(void **state)
{
    (void)state;
    static const tn_opcode opcodes[] = {TN_OP_CALL, TN_OP_MIRROR};
    for (size_t n = 0; n < 2; n++) {
        tn_module *module = chain_module(200001, opcodes[n]);
        tn_schema *schema = test_schema_open(module, 0);
        tn_plan_vm *vm = NULL;
        tn_error error;
        test_ok(tn_plan_vm_new(schema, 0, &vm, &error), &error);
        const tn_tray trays[] = {0, 3, 3};
        bool in = false;
        test_ok(tn_plan_vm_plan(vm, trays, 3, &error), &error);
        test_ok(tn_plan_vm_relation(vm, 200000, 0, 1, &in, &error), &error); /* an even number of mirrors */
        assert_true(in);
        test_ok(tn_plan_vm_relation(vm, 200000, 2, 3, &in, &error), &error);
        assert_false(in);
        tn_plan_vm_free(vm);
        tn_schema_free(schema);
        tn_module_free(module);
    }
}

static void test_limits(void **state)
{
    (void)state;
    tn_module *module = chain_module(1000, TN_OP_CALL);
    tn_schema *schema = test_schema_open(module, 0);
    tn_plan_vm *vm = NULL;
    tn_error error;
    bool in;
    tn_tray trays[200] = {0};
    test_ok(tn_plan_vm_new(schema, 200, &vm, &error), &error);
    tn_tray too_long[201] = {0};
    assert_int_equal(tn_plan_vm_plan(vm, too_long, 201, &error), TN_LIMIT);
    assert_int_equal(error.code, 805);
    assert_non_null(strstr(error.message, "200"));

    test_ok(tn_plan_vm_plan(vm, trays, 200, &error), &error);
    tn_plan_vm_limit(vm, 0, 1000);
    assert_int_equal(tn_plan_vm_holds(vm, 999, &in, &error), TN_LIMIT);
    assert_int_equal(error.code, 808);
    assert_int_not_equal(error.code_offset, TN_NO_OFFSET);

    tn_plan_vm_limit(vm, 1 << 20, TN_VM_WORK_DEFAULT);
    assert_int_equal(tn_plan_vm_holds(vm, 999, &in, &error), TN_LIMIT);
    assert_int_equal(error.code, 807);

    /* After a refusal the vm still works. */
    tn_plan_vm_limit(vm, TN_VM_MEMORY_DEFAULT, 0);
    test_ok(tn_plan_vm_plan(vm, trays, 1, &error), &error);
    test_ok(tn_plan_vm_relation(vm, 999, 0, 1, &in, &error), &error);
    assert_true(in);
    tn_plan_vm_free(vm);
    tn_schema_free(schema);
    tn_module_free(module);
}

/* Nothing is somewhere in the empty plan. */
static void test_empty_plan(void **state)
{
    (void)state;
    tn_module *module = chain_module(2, TN_OP_CALL);
    tn_schema *schema = test_schema_open(module, 0);
    tn_plan_vm *vm = NULL;
    tn_error error;
    bool in = true;
    test_ok(tn_plan_vm_new(schema, 0, &vm, &error), &error);
    test_ok(tn_plan_vm_plan(vm, NULL, 0, &error), &error);
    test_ok(tn_plan_vm_holds(vm, 1, &in, &error), &error);
    assert_false(in);
    tn_plan_vm_free(vm);
    tn_schema_free(schema);
    tn_module_free(module);
}

/* What no rule of the language compiles to, but a module may hold: `somewhere` of a relation with empty stretches. */
static void test_somewhere_needs_a_tray(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_tiny);
    uint32_t spec = test_spec_add(builder, 0, 0xd); /* width 4' */
    tn_builder_emit(builder, TN_OP_TRAY, spec, 0);
    tn_builder_emit(builder, TN_OP_NOT, 0, 0);
    tn_builder_emit(builder, TN_OP_SOMEWHERE, 0, 0);
    tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
    tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, "f"),
                                                           .kind = TN_FUNCTION_HOLDS,
                                                           .code_end = tn_builder_offset(builder),
                                                           .stack_max = 1});
    tn_module *module = test_module(builder);
    tn_schema *schema = test_schema_open(module, 0);
    tn_plan_vm *vm = NULL;
    tn_error error;
    test_ok(tn_plan_vm_new(schema, 0, &vm, &error), &error);
    const tn_tray trays[] = {0, 3}; /* 4', then 8' */
    for (size_t length = 0; length <= 2; length++) {
        bool in = false;
        test_ok(tn_plan_vm_plan(vm, trays, length, &error), &error);
        test_ok(tn_plan_vm_holds(vm, 0, &in, &error), &error);
        assert_int_equal(in, length == 2);
    }
    tn_plan_vm_free(vm);
    tn_schema_free(schema);
    tn_module_free(module);
}

/* Nobody has to ask why: a sum that divides by nothing, with and without an error to say so in. */
static void test_failure_without_error(void **state)
{
    (void)state;
    static const char text[] = "schema s { width = 3m | 4m  zone deep = none | full(1m) }\n"
                               "rule r = sum(width / deep) > 2\n";
    tn_compilation compilation;
    tn_module *module;
    tn_plan_vm *vm = NULL;
    tn_error error;
    const tn_tray trays[] = {0, 1};
    bool in;
    assert_int_equal(compile_text("r.plan", text, sizeof text - 1, &(library_folders){0}, &compilation), TN_OK);
    test_ok(tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error), &error);
    tn_schema *schema = test_schema_open(module, 0);
    test_ok(tn_plan_vm_new(schema, 0, &vm, &error), &error);
    test_ok(tn_plan_vm_plan(vm, trays, 2, &error), &error);
    const uint32_t holds = module->RULE_records[0].holds;
    assert_int_equal(tn_plan_vm_holds(vm, holds, &in, &error), TN_INVALID);
    assert_int_equal(error.code, E_DIVIDED_BY_ZERO);
    assert_int_not_equal(error.code_offset, TN_NO_OFFSET);
    test_ok(tn_plan_vm_plan(vm, trays, 2, &error), &error);
    assert_int_equal(tn_plan_vm_holds(vm, holds, &in, NULL), TN_INVALID);
    tn_plan_vm_free(vm);
    tn_schema_free(schema);
    tn_module_free(module);
    tn_compilation_clear(&compilation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paper_rules_equal_brute_force),
        cmocka_unit_test(test_extensions_equal_brute_force),
        cmocka_unit_test(test_wide_rows_equal_brute_force),
        cmocka_unit_test(test_long_call_chain),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_empty_plan),
        cmocka_unit_test(test_somewhere_needs_a_tray),
        cmocka_unit_test(test_failure_without_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
