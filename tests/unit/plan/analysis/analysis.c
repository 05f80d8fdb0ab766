/* Analysis: what it says of random rules and libraries over a tiny schema is what trying every short plan says. */
#include "runtime/plan/analysis/analysis.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/automata/search.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

enum { RULES = 4, LOW = 1, HIGH = 4, LONGEST = 5, PLANS = 4 + 16 + 64 + 256 + 1024, SEEDS = 300 };

typedef struct tried {
    uint32_t length, bits; /* bit r: rule r matches */
} tried;

typedef struct fixture {
    test_rule *rules[RULES];
    tn_module *module;
    tn_schema *schema;
    tn_plan_analysis *analysis;
    tried plans[PLANS];
} fixture;

/* Every plan of 1 to LONGEST trays, shortest first. */
static void try_all(fixture *f)
{
    tn_plan_vm *vm;
    tn_error error;
    size_t at = 0;
    test_ok(tn_plan_vm_new(f->schema, 0, &vm, &error), &error);
    for (uint32_t length = 1; length <= LONGEST; length++) {
        for (uint32_t code = 0; code < 1u << (2 * length); code++) {
            tn_tray trays[LONGEST];
            for (uint32_t i = 0; i < length; i++)
                trays[i] = code >> (2 * (length - 1 - i)) & 3;
            f->plans[at].length = length;
            test_ok(tn_plan_vm_plan(vm, trays, length, &error), &error);
            for (uint32_t r = 0; r < RULES; r++) {
                bool holds;
                test_ok(tn_plan_vm_holds(vm, f->module->RULE_records[r].holds, &holds, &error), &error);
                f->plans[at].bits |= (uint32_t)holds << r;
            }
            at++;
        }
    }
    assert_int_equal(at, PLANS);
    tn_plan_vm_free(vm);
}

static void add_rule(tn_builder *builder, const char *name, const test_rule *rule, uint32_t *holds)
{
    tn_rule_record record = {.name = tn_builder_string(builder, name)};
    test_rule_emit(builder, rule, &record.whole, &record.holds);
    tn_builder_add_RULE(builder, &record);
    *holds = record.holds;
}

/* false where a rule passes the limit, as some random ones do. */
static bool make(fixture *f, uint64_t seed)
{
    test_random random = {.seed = seed};
    tn_builder *builder = tn_builder_new();
    memset(f, 0, sizeof *f);
    test_schema_add(builder, &test_schema_tiny);
    static const char *const names[RULES] = {"a", "b", "c", "d"};
    uint32_t holds[RULES];
    for (uint32_t r = 0; r < RULES; r++) {
        f->rules[r] = test_rule_random(&random, &test_schema_tiny, 1 + r % 2, true);
        add_rule(builder, names[r], f->rules[r], &holds[r]);
    }
    tn_library_record library = {.name = tn_builder_string(builder, "some"),
                                 .trays_min = LOW,
                                 .trays_max = HIGH,
                                 .clause_first = (uint32_t)tn_builder_count(builder, TN_SECTION_CLAUSE),
                                 .clause_count = RULES};
    for (uint32_t r = 0; r < RULES; r++) {
        tn_clause_record clause = {.name = tn_builder_string(builder, names[r]),
                                   .kind = test_random_below(&random, 2) ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE,
                                   .holds = holds[r]};
        tn_builder_add_CLAUSE(builder, &clause);
    }
    tn_builder_add_LIBRARY(builder, &library);
    f->module = test_module(builder);
    f->schema = test_schema_open(f->module, 0);
    tn_error error;
    test_ok(tn_plan_analysis_new(f->schema, NULL, &f->analysis, &error), &error);
    for (size_t i = 0; i < tn_plan_analysis_count(f->analysis); i++)
        if (tn_plan_analysis_get(f->analysis, i)->found == TN_FOUND_NOT_ANALYSED)
            return false;
    try_all(f);
    return true;
}

static void clear(fixture *f)
{
    for (size_t r = 0; r < RULES; r++)
        test_rule_free(f->rules[r]);
    tn_plan_analysis_free(f->analysis);
    tn_schema_free(f->schema);
    tn_module_free(f->module);
}

/* The first plan tried of which the rules in `mask` say just what `bits` says; NULL where there is none. */
static const tried *first(const fixture *f, uint32_t mask, uint32_t bits, uint32_t longest)
{
    for (size_t p = 0; p < PLANS && f->plans[p].length <= longest; p++)
        if ((f->plans[p].bits & mask) == bits)
            return &f->plans[p];
    return NULL;
}

/* What a plan that is shown really is. */
static uint32_t bits_of(const fixture *f, const tn_shown_plan *plan)
{
    size_t at = 0;
    assert_in_range(plan->length, 1, LONGEST);
    for (size_t length = 1; length < plan->length; length++)
        at += (size_t)1 << (2 * length);
    size_t code = 0;
    for (size_t i = 0; i < plan->length; i++)
        code = code << 2 | plan->trays[i];
    return f->plans[at + code].bits;
}

/* ---- rules */

static void check_example(const fixture *f, uint32_t mask, uint32_t bits, const tn_shown_plan *shown)
{
    const tried *shortest = first(f, mask, bits, LONGEST);
    if (!shortest) {
        assert_true(!shown->shown || shown->length > LONGEST);
        return;
    }
    assert_true(shown->shown);
    assert_int_equal(shown->length, shortest->length);
    assert_int_equal(bits_of(f, shown) & mask, bits);
}

static void check_pair(const fixture *f, size_t i, size_t j)
{
    tn_shown_plan shown[3];
    tn_error error;
    uint32_t a = 1u << tn_plan_analysis_rule(f->analysis, i), b = 1u << tn_plan_analysis_rule(f->analysis, j);
    test_ok(tn_plan_analysis_examples(f->analysis, i, j, shown, &error), &error);
    check_example(f, a | b, a | b, &shown[0]);
    check_example(f, a | b, a, &shown[1]);
    check_example(f, a | b, b, &shown[2]);
    tn_rule_relation expected = TN_RULES_OVERLAP;
    if (!shown[1].shown && !shown[2].shown)
        expected = TN_RULES_EQUAL;
    else if (!shown[0].shown)
        expected = TN_RULES_APART;
    else if (!shown[1].shown)
        expected = TN_RULES_INSIDE;
    else if (!shown[2].shown)
        expected = TN_RULES_CONTAINS;
    assert_int_equal(tn_plan_analysis_relation(f->analysis, i, j), expected);
    for (int e = 0; e < 3; e++)
        tn_shown_plan_clear(&shown[e]);
}

static bool found(const fixture *f, tn_found what, uint32_t rule)
{
    for (size_t i = 0; i < tn_plan_analysis_count(f->analysis); i++) {
        const tn_plan_analysis_finding *finding = tn_plan_analysis_get(f->analysis, i);
        if (finding->found == what && finding->rule == rule)
            return true;
    }
    return false;
}

static void check_rules(const fixture *f)
{
    assert_int_equal(tn_plan_analysis_rule_count(f->analysis), RULES);
    for (uint32_t r = 0; r < RULES; r++) {
        if (first(f, 1u << r, 1u << r, LONGEST))
            assert_false(found(f, TN_FOUND_NEVER, r));
        if (first(f, 1u << r, 0, LONGEST))
            assert_false(found(f, TN_FOUND_ALWAYS, r));
        for (uint32_t other = 0; other < RULES; other++)
            if (other != r)
                check_pair(f, r, other);
    }
}

/* ---- the library */

static uint32_t wanted_bits(const fixture *f)
{
    uint32_t bits = 0;
    for (uint32_t c = 0; c < RULES; c++)
        bits |= (uint32_t)(f->module->CLAUSE_records[c].kind == TN_CLAUSE_REQUIRE) << c;
    return bits;
}

static void check_empty(const fixture *f, const tn_plan_analysis_finding *finding)
{
    uint32_t wanted = wanted_bits(f), set = 0, longest = finding->with_lengths ? HIGH : LONGEST;
    for (size_t i = 0; i < finding->reason_count; i++)
        set |= 1u << finding->reasons[i];
    assert_null(first(f, set, wanted & set, longest));
    for (size_t i = 0; i < finding->reason_count; i++) {
        uint32_t rest = set & ~(1u << finding->reasons[i]);
        assert_true(finding->plans[i].shown);
        if (finding->plans[i].length <= LONGEST)
            assert_int_equal(bits_of(f, &finding->plans[i]) & rest, wanted & rest);
        if (finding->with_lengths)
            assert_non_null(first(f, rest, wanted & rest, HIGH));
    }
}

static bool is_idle(const fixture *f, uint32_t clause)
{
    for (size_t i = 0; i < tn_plan_analysis_count(f->analysis); i++) {
        const tn_plan_analysis_finding *finding = tn_plan_analysis_get(f->analysis, i);
        if ((finding->found == TN_FOUND_IDLE_PRUNE || finding->found == TN_FOUND_IDLE_REQUIRE) &&
            finding->clause == clause)
            return true;
    }
    return false;
}

static bool check_library(const fixture *f)
{
    uint32_t all = (1u << RULES) - 1, wanted = wanted_bits(f);
    const tn_plan_analysis_finding *empty = NULL;
    for (size_t i = 0; i < tn_plan_analysis_count(f->analysis); i++)
        if (tn_plan_analysis_get(f->analysis, i)->found == TN_FOUND_EMPTY)
            empty = tn_plan_analysis_get(f->analysis, i);
    assert_int_equal(empty == NULL, first(f, all, wanted, HIGH) != NULL);
    if (empty) {
        check_empty(f, empty);
        return true;
    }
    for (uint32_t c = 0; c < RULES; c++)
        assert_int_equal(is_idle(f, c), first(f, all, wanted ^ 1u << c, HIGH) == NULL);
    return false;
}

static void test_random_rules(void **state)
{
    (void)state;
    size_t analysed = 0, empty = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        fixture *f = malloc(sizeof *f);
        assert_non_null(f);
        if (make(f, seed)) {
            analysed++;
            check_rules(f);
            empty += check_library(f);
        }
        clear(f);
        free(f);
    }
    assert_in_range(analysed, SEEDS / 2, SEEDS);
    assert_in_range(empty, SEEDS / 20, SEEDS * 3 / 4);
}

/* ---- searching */

/* Over one letter: words of a length that divides by `steps`. */
static tn_dfa *multiples(uint32_t steps)
{
    tn_dfa *dfa = tn_dfa_new(1, 1, steps);
    assert_non_null(dfa);
    for (uint32_t s = 0; s < steps; s++)
        dfa->delta[s] = (s + 1) % steps;
    dfa->accept[0] = 1;
    return dfa;
}

static void test_lengths(void **state)
{
    (void)state;
    tn_dfa *fours = multiples(4), *sixes = multiples(6);
    tn_search_part parts[2] = {{fours, true}, {sixes, true}};
    const struct {
        uint32_t min, max;
        bool sixes, found;
        size_t length;
    } cases[] = {{0, 100, true, true, 0},   {1, 100, true, true, 12}, {13, 100, true, true, 24},
                 {1, 11, true, false, 0},   {12, 12, true, true, 12}, {1, 100, false, true, 4},
                 {9, 100, false, true, 16}, {13, 15, false, false, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        tn_search search = {parts, 2, cases[i].min, cases[i].max, "test", 1000, 0, NULL};
        tn_key word;
        tn_error error;
        bool found;
        parts[1].accepts = cases[i].sixes;
        test_ok(tn_search_shortest(&search, &word, &found, &error), &error);
        assert_int_equal(found, cases[i].found);
        if (found)
            assert_int_equal(word.size, cases[i].length);
        free(word.data);
    }
    tn_search search = {parts, 2, 1, UINT32_MAX, "test", 5, 0, NULL};
    tn_key word;
    tn_error error;
    bool found;
    parts[1].accepts = true;
    assert_int_equal(tn_search_shortest(&search, &word, &found, &error), TN_LIMIT);
    assert_int_equal(error.code, 802);
    free(word.data);
    tn_dfa_free(fours);
    tn_dfa_free(sixes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_rules), cmocka_unit_test(test_lengths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
