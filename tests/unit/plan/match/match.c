/* Matching many plans at once: every instruction set decides as the reference engine does, plan by plan. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/match/rules.h"
#include "tests/support/test_rule.h"

#define RULES 150 /* three words of bits, many vectors */
#define WORDS 3
#define PLANS 61 /* the last lanes are not full; also one by one */

static const tn_simd sets[] = {TN_SIMD_BEST, TN_SIMD_NONE, TN_SIMD_AVX2, TN_SIMD_AVX512};

typedef struct fixture {
    tn_module *module;
    tn_schema *schema;
    uint32_t functions[RULES];
    tn_tray trays[PLANS * TEST_LENGTH_MAX];
    size_t ends[PLANS];
    tn_plan_array plans;
    uint64_t expected[PLANS * WORDS];
} fixture;

/* Rules of which most have a few states, some hundreds. */
static void make_rules(fixture *f, test_random *random, const test_schema *schema)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, schema);
    for (size_t i = 0; i < RULES; i++) {
        uint32_t whole;
        test_rule *rule = test_rule_random(random, schema, 1 + i % 3, i % 2);
        test_rule_emit(builder, rule, &whole, &f->functions[i]);
        test_rule_free(rule);
    }
    f->module = test_module(builder);
    f->schema = test_schema_open(f->module, 0);
}

/* Plans of up to `longest` trays that begin at tray `begin`. */
static void make_plans(fixture *f, test_random *random, uint32_t longest, size_t begin)
{
    size_t at = begin;
    for (size_t i = 0; i < PLANS; i++) {
        test_plan plan;
        uint32_t length = test_random_below(random, longest + 1);
        test_plan_random(random, f->schema, length, &plan, f->trays + at);
        f->ends[i] = at += length;
    }
    f->plans = (tn_plan_array){.trays = f->trays, .begin = begin, .ends = f->ends, .count = PLANS};
}

static tn_rules *compile(const fixture *f, size_t count, const tn_rules_options *options)
{
    tn_rules *rules;
    tn_error error;
    test_ok(tn_rules_new(f->schema, f->functions, count, options, &rules, &error), &error);
    return rules;
}

static void expect(fixture *f, size_t count)
{
    tn_rules *rules = compile(f, count, &(tn_rules_options){.engine = TN_ENGINE_VM});
    tn_matcher *matcher;
    tn_error error;
    test_ok(tn_matcher_new(rules, &matcher, &error), &error);
    for (size_t i = 0; i < PLANS; i++) {
        size_t begin = i ? f->ends[i - 1] : f->plans.begin;
        test_ok(tn_match(matcher, f->trays + begin, f->ends[i] - begin, f->expected + i * ((count + 63) / 64), &error),
                &error);
    }
    tn_matcher_free(matcher);
    tn_rules_free(rules);
}

static void check(const fixture *f, size_t count, tn_simd simd, uint32_t max_states, bool any)
{
    size_t words = (count + 63) / 64, done;
    tn_rules *rules = compile(f, count, &(tn_rules_options){.simd = simd, .max_states = max_states, .any = any});
    tn_matcher *matcher;
    tn_error error;
    test_ok(tn_matcher_new(rules, &matcher, &error), &error);
    uint64_t bits[PLANS * WORDS];
    uint8_t matches[PLANS];
    memset(bits, 0xff, sizeof bits);
    memset(matches, 0xff, sizeof matches);
    test_ok(tn_match_all(matcher, &f->plans, bits, &done, &error), &error);
    assert_int_equal(done, PLANS);
    assert_memory_equal(bits, f->expected, PLANS * words * sizeof *bits);
    tn_plan_array fewer = f->plans;
    fewer.count = PLANS / TN_LANES * TN_LANES + 1 - TN_LANES; /* one plan is left for the last lanes */
    memset(bits, 0xff, sizeof bits);
    test_ok(tn_match_all(matcher, &fewer, bits, &done, &error), &error);
    assert_memory_equal(bits, f->expected, fewer.count * words * sizeof *bits);
    test_ok(tn_match_any(matcher, &f->plans, matches, &done, &error), &error);
    assert_int_equal(done, PLANS);
    for (size_t i = 0; i < PLANS; i++) {
        bool expected = false;
        for (size_t w = 0; w < words; w++)
            expected |= f->expected[i * words + w] != 0;
        assert_int_equal(matches[i], expected);
        tn_plan_array one = {f->trays, i ? f->ends[i - 1] : f->plans.begin, f->ends + i, 1};
        test_ok(tn_match_all(matcher, &one, bits, &done, &error), &error);
        assert_memory_equal(bits, f->expected + i * words, words * sizeof *bits);
        test_ok(tn_match_any(matcher, &one, matches, &done, &error), &error);
        assert_int_equal(matches[0], expected);
    }
    tn_matcher_free(matcher);
    tn_rules_free(rules);
}

static void check_schema(const test_schema *schema, uint64_t seed)
{
    test_random random = {.seed = seed};
    fixture *f = malloc(sizeof *f);
    assert_non_null(f);
    make_rules(f, &random, schema);
    static const uint32_t longest[] = {10, 16, TEST_LENGTH_MAX, 3, 0};
    static const size_t counts[] = {RULES, 10, 1, 64};
    for (size_t l = 0; l < sizeof longest / sizeof *longest; l++) {
        make_plans(f, &random, longest[l], l % 2 * 5);
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            expect(f, counts[c]);
            for (size_t s = 0; s < sizeof sets / sizeof *sets; s++)
                check(f, counts[c], sets[s], s == 0 ? 50 : 500, counts[c] <= 10);
        }
    }
    tn_schema_free(f->schema);
    tn_module_free(f->module);
    free(f);
}

static void every_set_decides_the_same(void **state)
{
    (void)state;
    check_schema(&test_schema_tiny, 1);
    check_schema(&test_schema_house, 2);
}

/* More trays than tables have rows for: plans are translated into classes. */
static void many_trays_decide_the_same(void **state)
{
    (void)state;
    check_schema(&test_schema_paper, 3);
}

/* A plan that the reference engine refuses ends matching there, with those before it decided. */
static void a_failure_says_where(void **state)
{
    (void)state;
    test_random random = {.seed = 4};
    fixture *f = malloc(sizeof *f);
    assert_non_null(f);
    make_rules(f, &random, &test_schema_tiny);
    make_plans(f, &random, 10, 0);
    expect(f, 1);
    size_t bad = 0, done;
    while (bad < PLANS && f->ends[bad] - (bad ? f->ends[bad - 1] : 0) <= 8)
        bad++;
    assert_true(bad > 0 && bad < PLANS);
    tn_rules *rules = compile(f, 1, &(tn_rules_options){.engine = TN_ENGINE_VM, .max_length = 8});
    tn_matcher *matcher;
    tn_error error;
    uint64_t bits[PLANS];
    test_ok(tn_matcher_new(rules, &matcher, &error), &error);
    assert_int_equal(tn_match_all(matcher, &f->plans, bits, &done, &error), TN_LIMIT);
    assert_int_equal(error.code, 805);
    assert_int_equal(done, bad);
    assert_memory_equal(bits, f->expected, bad * sizeof *bits);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    tn_schema_free(f->schema);
    tn_module_free(f->module);
    free(f);
}

static void a_set_past_the_processor_is_not_chosen(void **state)
{
    (void)state;
    assert_int_equal(tn_simd_choose(TN_SIMD_NONE), TN_SIMD_NONE);
    assert_true(tn_simd_choose(TN_SIMD_AVX2) <= TN_SIMD_AVX2);
    assert_true(tn_simd_choose(TN_SIMD_AVX512) == tn_simd_choose(TN_SIMD_BEST));
    assert_true(tn_simd_choose(TN_SIMD_BEST) != TN_SIMD_BEST);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_set_decides_the_same),
        cmocka_unit_test(many_trays_decide_the_same),
        cmocka_unit_test(a_failure_says_where),
        cmocka_unit_test(a_set_past_the_processor_is_not_chosen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
