/* Patterns match the plans that the interpreter says the rule matches: POSIX's own matcher decides. */
#include <regex.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/text/export_regex.h"
#include "tests/support/test_rule.h"

#define RULES 300
#define PLANS 40

typedef struct counts {
    size_t patterns, empty, long_;
} counts;

static void compare(test_random *random, const tn_schema *schema, const tn_classes *classes, const tn_dfa *dfa,
                    uint32_t function, const char *pattern)
{
    regex_t compiled;
    tn_plan_vm *vm;
    tn_error error;
    if (pattern)
        assert_int_equal(regcomp(&compiled, pattern, REG_EXTENDED | REG_NOSUB), 0);
    test_ok(tn_plan_vm_new(schema, 0, &vm, &error), &error);
    for (uint32_t n = 0; n < PLANS; n++) {
        test_plan plan;
        tn_tray trays[TEST_LENGTH_MAX];
        tn_buffer word = {0};
        bool holds;
        test_plan_random(random, schema, n % 8, &plan, trays);
        test_ok(tn_plan_vm_plan(vm, trays, plan.length, &error), &error);
        test_ok(tn_plan_vm_holds(vm, function, &holds, &error), &error);
        assert_true(tn_regex_plan(dfa, classes, trays, plan.length, &word));
        bool matches = pattern && regexec(&compiled, word.data, 0, NULL, 0) == 0;
        if (matches != holds)
            fail_msg("%s on '%s': the rule says %d", pattern ? pattern : "(none)", word.data, holds);
        free(word.data);
    }
    tn_plan_vm_free(vm);
    if (pattern)
        regfree(&compiled);
}

static void export_rule(test_random *random, const test_schema *schema, counts *c)
{
    tn_builder *builder = tn_builder_new();
    uint32_t index = test_schema_add(builder, schema);
    test_rule *rule = test_rule_random(random, schema, 1 + test_random_below(random, 3), true);
    uint32_t record = test_rule_add(builder, "r", rule);
    tn_module *module = test_module(builder);
    tn_schema *ready = test_schema_open(module, index);
    uint32_t function = module->RULE_records[record].holds;
    tn_classes *classes;
    tn_lowering *lowering;
    tn_dfa *dfa = NULL;
    tn_buffer pattern = {0};
    tn_error error;
    test_ok(tn_classes_new(ready, &function, 1, &classes, &error), &error);
    test_ok(tn_lowering_new(classes, 500, &lowering, &error), &error);
    tn_status status = tn_lower(lowering, function, &dfa, &error);
    if (status == TN_OK)
        status = tn_export_regex(dfa, &pattern, &error);
    assert_true(status == TN_OK || status == TN_LIMIT);
    if (status == TN_OK)
        compare(random, ready, classes, dfa, function, pattern.data);
    c->patterns += status == TN_OK && pattern.data;
    c->empty += status == TN_OK && !pattern.data;
    c->long_ += status == TN_LIMIT;
    assert_true(pattern.size <= TN_REGEX_LENGTH_MAX);
    free(pattern.data);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    tn_schema_free(ready);
    tn_module_free(module);
    test_rule_free(rule);
}

static void random_rules(void **state)
{
    (void)state;
    test_random random = {.seed = 29};
    counts c = {0};
    for (uint32_t i = 0; i < RULES; i++)
        export_rule(&random, i % 2 ? &test_schema_house : &test_schema_tiny, &c);
    assert_true(c.patterns > RULES / 2);
    assert_true(c.empty > 0);
    assert_true(c.long_ > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_rules)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
