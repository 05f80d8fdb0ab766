/* Random rules, written in the plan language, compiled, and decided by the reference engine as the brute force decides
 * them from the equations. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/compile_file.h"
#include "tests/support/test_rule.h"

enum { RULES = 12, PLANS = 12, LONGEST = 7 };

/* One file with the schema and so many rules, r0, r1, ...: each is also given out as r0-again = r0. */
static char *write_file(const test_schema *schema, test_rule **rules, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    assert_non_null(out);
    test_schema_print(schema, out);
    for (int i = 0; i < RULES; i++) {
        fprintf(out, "rule r%d = ", i);
        test_rule_print(schema, rules[i], out);
        fprintf(out, "\nrule again%d = r%d\n", i, i);
    }
    fclose(out);
    return text;
}

static void compare(tn_plan_vm *vm, const tn_module *module, const test_schema *schema, test_rule **rules,
                    const test_plan *plan, test_brute *brute)
{
    tn_error error;
    for (uint32_t n = 0; n < 2 * RULES; n++) {
        const tn_rule_record *record = &module->RULE_records[n];
        const test_rule *rule = rules[n / 2];
        test_brute_start(brute, schema, plan);
        for (uint32_t i = 0; i <= plan->length; i++) {
            for (uint32_t j = i; j <= plan->length; j++) {
                bool whole, holds;
                test_ok(tn_plan_vm_relation(vm, record->whole, i, j, &whole, &error), &error);
                test_ok(tn_plan_vm_relation(vm, record->holds, i, j, &holds, &error), &error);
                if (whole == test_brute_whole(brute, rule, i, j) && holds == test_brute_holds(brute, rule, i, j))
                    continue;
                test_rule_print(schema, rule, stderr);
                fail_msg("[%u, %u): compiled, M is %d, H %d", i, j, whole, holds);
            }
        }
    }
}

static void compile_and_compare(test_random *random, const test_schema *schema, test_brute *brute)
{
    test_rule *rules[RULES];
    for (int i = 0; i < RULES; i++)
        rules[i] = test_rule_random(random, schema, 1 + test_random_below(random, 4), true);
    size_t size;
    char *text = write_file(schema, rules, &size);
    tn_compilation compilation;
    tn_status status = compile_text("random.plan", text, size, &(library_folders){0}, &compilation);
    if (status != TN_OK) {
        tn_diagnostics_show(&compilation.diagnostics, &(tn_show_options){0}, stderr);
        fail_msg("a random rule does not compile");
    }
    tn_module *module;
    tn_error error;
    test_ok(tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error), &error);
    tn_schema *ready = test_schema_open(module, 0);
    tn_plan_vm *vm;
    test_ok(tn_plan_vm_new(ready, 0, &vm, &error), &error);
    for (uint32_t n = 0; n < PLANS; n++) {
        test_plan plan;
        tn_tray trays[TEST_LENGTH_MAX];
        test_plan_random(random, ready, n % (LONGEST + 1), &plan, trays);
        test_ok(tn_plan_vm_plan(vm, trays, plan.length, &error), &error);
        compare(vm, module, schema, rules, &plan, brute);
    }
    tn_plan_vm_free(vm);
    tn_schema_free(ready);
    tn_module_free(module);
    tn_compilation_clear(&compilation);
    free(text);
    for (int i = 0; i < RULES; i++)
        test_rule_free(rules[i]);
}

static void compare_many(const test_schema *schema, uint64_t seed)
{
    test_random random = {.seed = seed};
    test_brute *brute = malloc(sizeof *brute);
    assert_non_null(brute);
    for (int i = 0; i < 20; i++)
        compile_and_compare(&random, schema, brute);
    free(brute);
}

static void tiny(void **state)
{
    (void)state;
    compare_many(&test_schema_tiny, 101);
}

static void house(void **state)
{
    (void)state;
    compare_many(&test_schema_house, 102);
}

static void paper(void **state)
{
    (void)state;
    compare_many(&test_schema_paper, 103);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiny),
        cmocka_unit_test(house),
        cmocka_unit_test(paper),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
