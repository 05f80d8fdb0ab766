/* Rule sets: the automata decide as the brute force and the reference engine do. */
#include "runtime/plan/rules.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/plan/vm.h"
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

static tn_rules *compile(const test_set *set, tn_engine engine, uint32_t max_states)
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_rules_agree),
        cmocka_unit_test(random_rules_with_extensions_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
