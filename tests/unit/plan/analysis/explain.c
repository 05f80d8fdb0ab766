/* Explanations agree with the brute force, node for node as far as it can tell, and hold together. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/analysis/explain.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

#define RULES 400
#define LONGEST 7

/* A neighbour that matched: its parts follow one another and fill it. */
static void check_row(const tn_explanation *why, const tn_why *node)
{
    tn_stretch at = why->stretches[node->stretch_first];
    uint32_t place = at.begin;
    for (uint32_t child = node->first; child != TN_NO_WHY; child = why->nodes[child].next) {
        const tn_why *part = &why->nodes[child];
        if (part->absent)
            continue;
        assert_true(part->matched);
        assert_int_equal(part->region.begin, place);
        assert_true(part->region.end > place);
        place = part->region.end;
    }
    assert_int_equal(place, at.end);
}

static void check_joined(const tn_explanation *why, const tn_why *node, tn_part_kind kind)
{
    bool all = true, any = false;
    for (uint32_t child = node->first; child != TN_NO_WHY; child = why->nodes[child].next) {
        all = all && why->nodes[child].matched;
        any = any || why->nodes[child].matched;
    }
    assert_int_equal(node->matched, kind == TN_PART_AND ? all : kind == TN_PART_OR ? any : !any);
}

static void check_node(const tn_explanation *why, const tn_why *node)
{
    const tn_part *part = tn_why_part(why, node);
    for (uint32_t i = 0; i < node->stretch_count; i++) {
        tn_stretch s = why->stretches[node->stretch_first + i];
        assert_true(node->region.begin <= s.begin && s.begin < s.end && s.end <= node->region.end);
        if (part->kind == TN_PART_TRAY)
            assert_int_equal(tn_spec_failing(why->schema, part->spec, why->trays[s.begin]), 0);
    }
    if (node->cut || node->absent)
        return;
    if (part->kind == TN_PART_NEIGHBOUR && node->matched)
        check_row(why, node);
    bool joined = part->kind == TN_PART_NOT || part->kind == TN_PART_AND || part->kind == TN_PART_OR;
    if (joined && (node->whole || node->matched))
        check_joined(why, node, part->kind);
    if (part->kind == TN_PART_TRAY && node->closest != TN_NO_WHY)
        assert_true(tn_spec_failing(why->schema, part->spec, why->trays[node->closest]) != 0);
    for (uint32_t g = 0; g < node->gap_count; g++)
        assert_int_equal(why->gaps[node->gap_first + g].fits, node->matched);
}

static void explain_rule(test_random *random, test_brute *brute, const test_schema *schema)
{
    tn_builder *builder = tn_builder_new();
    uint32_t index = test_schema_add(builder, schema);
    test_rule *rule = test_rule_random(random, schema, 1 + test_random_below(random, 4), true);
    uint32_t record = test_rule_add(builder, "r", rule);
    tn_module *module = test_module(builder);
    tn_schema *ready = test_schema_open(module, index);
    for (uint32_t length = 0; length <= LONGEST; length++) {
        test_plan plan;
        tn_tray trays[TEST_LENGTH_MAX];
        tn_explanation why;
        tn_error error;
        test_plan_random(random, ready, length, &plan, trays);
        test_brute_start(brute, schema, &plan);
        test_ok(tn_explain(ready, module->RULE_records[record].holds, trays, length, 0, &why, &error), &error);
        assert_int_equal(why.nodes[0].matched, test_brute_holds(brute, rule, 0, length));
        for (uint32_t i = 0; i < why.node_count; i++)
            check_node(&why, &why.nodes[i]);
        uint32_t largest = tn_explanation_largest(&why);
        assert_true(largest == TN_NO_WHY || largest < why.node_count);
        tn_explanation_clear(&why);
    }
    tn_schema_free(ready);
    tn_module_free(module);
    test_rule_free(rule);
}

static void random_rules(void **state)
{
    (void)state;
    test_random random = {.seed = 71};
    test_brute *brute = malloc(sizeof *brute);
    assert_non_null(brute);
    for (uint32_t i = 0; i < RULES; i++)
        explain_rule(&random, brute, i % 3 ? &test_schema_house : &test_schema_tiny);
    free(brute);
}

/* A plan past the limit is refused by its length. */
static void too_long(void **state)
{
    (void)state;
    test_random random = {.seed = 5};
    tn_builder *builder = tn_builder_new();
    uint32_t index = test_schema_add(builder, &test_schema_tiny);
    test_rule *rule = test_rule_random(&random, &test_schema_tiny, 2, false);
    uint32_t record = test_rule_add(builder, "r", rule);
    tn_module *module = test_module(builder);
    tn_schema *ready = test_schema_open(module, index);
    tn_tray trays[3] = {0};
    tn_explanation why;
    tn_error error;
    assert_int_equal(tn_explain(ready, module->RULE_records[record].holds, trays, 3, 2, &why, &error), TN_LIMIT);
    assert_int_equal(error.code, 805);
    tn_explanation_clear(&why);
    tn_schema_free(ready);
    tn_module_free(module);
    test_rule_free(rule);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_rules), cmocka_unit_test(too_long)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
