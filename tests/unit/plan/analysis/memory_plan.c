/* Out of memory in the plan engines: each allocation of lowering, of opening a library, of its late counts, of
 * analysing and comparing fails once. What fails must say so, leave nothing behind (the sanitized build would see it)
 * and work again afterwards. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/analysis/analysis.h"
#include "runtime/plan/library/diff.h"
#include "runtime/plan/match/rules.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_library.h"

/* `result` is a number that what came out is told by. */
typedef tn_status (*operation)(void *context, uint64_t *result, tn_error *error);

/* A few allocations can fail without harm (shrinking, remembering a failure), so success is allowed, where what comes
 * out is what comes out otherwise. */
static void expect_robust(operation operate, void *context)
{
    size_t failures = 0;
    uint64_t wanted = 0;
    tn_error none = {0};
    test_ok(operate(context, &wanted, &none), &none);
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number += 1 + number / 128) { /* all of the first ones, then a few of each kind */
            tn_error error = {0};
            uint64_t result = 0;
            fail_allocation(number, all_after);
            tn_status status = operate(context, &result, &error);
            bool reached = stop_failing() > number;
            if (!reached) {
                test_ok(status, &error);
                break;
            }
            if (status == TN_OK) {
                assert_int_equal(result, wanted);
                continue;
            }
            assert_int_equal(status, TN_MEMORY);
            assert_int_equal(error.code, 801);
            failures++;
        }
    }
    assert_true(failures > 20);
}

static tn_status open_rules(void *context, uint64_t *result, tn_error *error)
{
    const test_library *made = context;
    uint32_t functions[TEST_CLAUSES_MAX];
    for (size_t i = 0; i < made->module->CLAUSE_count; i++)
        functions[i] = made->module->CLAUSE_records[i].holds;
    tn_rules *rules = NULL;
    tn_rules_options options = {.max_states = 2000};
    tn_status status = tn_rules_new(made->schema, functions, made->module->CLAUSE_count, &options, &rules, error);
    tn_matcher *matcher = NULL;
    if (status == TN_OK)
        status = tn_matcher_new(rules, &matcher, error);
    tn_tray trays[5] = {0, 1, 2, 3, 1};
    if (status == TN_OK)
        status = tn_match(matcher, trays, 5, result, error);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    return status;
}

/* Mixes a number into the result. */
static void add(uint64_t *result, const mpz_t number)
{
    *result = *result * 1000003 + mpz_get_ui(number);
}

static tn_status open_and_use(const test_library *made, uint64_t max_eager, uint64_t *result, tn_error *error)
{
    tn_library *library = NULL;
    tn_library_options options = {.max_states = 2000, .max_eager = max_eager};
    tn_status status = tn_library_new(made->schema, 0, &options, &library, error);
    mpz_t count, only, ranks[3];
    mpz_inits(count, only, ranks[0], ranks[1], ranks[2], NULL);
    if (status == TN_OK)
        status = tn_library_kept_mirror(library, TN_ALL_LENGTHS, count, error);
    add(result, count);
    uint32_t states;
    if (status == TN_OK && made->module->CLAUSE_count > 0)
        status = tn_library_effect(library, 0, count, only, &states, error);
    add(result, count);
    add(result, only);
    if (status == TN_OK)
        status = tn_library_matches(library, &made->module->RULE_records[0].holds, 1, ranks, error);
    add(result, ranks[0]);
    size_t found;
    if (status == TN_OK)
        status = tn_library_sample(library, 1, TN_ALL_LENGTHS, 3, ranks, &found, error);
    tn_cursor *cursor = NULL;
    if (status == TN_OK) {
        mpz_set_ui(count, 0);
        mpz_set_ui(only, 10);
        status = tn_cursor_new(library, count, only, &cursor, error);
    }
    const tn_tray *trays;
    uint32_t length;
    while (cursor && tn_cursor_next(cursor, &trays, &length))
        *result += tn_library_has(library, trays, length) ? 1 : UINT64_MAX / 2;
    tn_cursor_free(cursor);
    tn_library_free(library);
    mpz_clears(count, only, ranks[0], ranks[1], ranks[2], NULL);
    return status;
}

static tn_status analyse(void *context, uint64_t *result, tn_error *error)
{
    const test_library *made = context;
    tn_plan_analysis *analysis = NULL;
    tn_shown_plan examples[3] = {{0}};
    tn_status status = tn_plan_analysis_new(made->schema, &(tn_plan_analysis_options){.max_states = 2000, .threads = 1},
                                            &analysis, error);
    if (status == TN_OK && tn_plan_analysis_rule_count(analysis) > 1)
        status = tn_plan_analysis_examples(analysis, 0, 1, examples, error);
    for (size_t i = 0; status == TN_OK && i < tn_plan_analysis_rule_count(analysis); i++)
        *result = *result * 7 + (uint64_t)tn_plan_analysis_relation(analysis, 0, i);
    for (int e = 0; e < 3; e++)
        tn_shown_plan_clear(&examples[e]);
    tn_plan_analysis_free(analysis);
    return status;
}

static tn_status compare(void *context, uint64_t *result, tn_error *error)
{
    const test_library *sides = context;
    tn_library_diff *diff = NULL;
    tn_status status = tn_library_diff_new(sides[0].library, sides[1].library, 0, NULL, &diff, error);
    mpz_t kept;
    mpz_init(kept);
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++) {
        tn_library_kept(tn_library_diff_part(diff, (tn_diff_part)part), TN_ALL_LENGTHS, kept);
        add(result, kept);
    }
    mpz_clear(kept);
    tn_library_diff_free(diff);
    return status;
}

static void comparing_runs_out_of_memory(void **state)
{
    (void)state;
    for (uint64_t seed = 3; seed < 6; seed++) {
        test_library sides[2];
        bool made = test_library_make(&sides[0], seed, &test_schema_tiny, 1, 3);
        made &= test_library_make(&sides[1], seed + 20, &test_schema_tiny, 1, seed == 3 ? 3 : 4);
        if (made)
            expect_robust(compare, sides);
        test_library_clear(&sides[0]);
        test_library_clear(&sides[1]);
    }
}

static tn_status open_library(void *context, uint64_t *result, tn_error *error)
{
    return open_and_use(context, 0, result, error);
}

static tn_status open_library_within(void *context, uint64_t *result, tn_error *error)
{
    return open_and_use(context, 1, result, error);
}

/* A library that may have few states, for counting its plans and those before one. */
typedef struct few_states {
    const test_library *made;
    uint32_t states;
} few_states;

/* The rank of the last plan. */
static tn_status rank_last(const few_states *few, const tn_library *library, mpz_t rank, tn_error *error)
{
    tn_tray trays[8];
    uint32_t length;
    bool has;
    tn_library_kept(few->made->library, TN_ALL_LENGTHS, rank);
    mpz_sub_ui(rank, rank, 1);
    if (!tn_library_unrank(few->made->library, rank, trays, &length))
        return TN_OK;
    return tn_library_counted_rank(library, trays, length, &has, rank, error);
}

static tn_status count_few(void *context, uint64_t *result, tn_error *error)
{
    const few_states *few = context;
    tn_library_options options = {.max_states = few->states, .max_eager = 1, .only_counted = true, .threads = 1};
    tn_library *library = NULL;
    tn_status status = tn_library_new(few->made->schema, 0, &options, &library, error);
    mpz_t out, only;
    mpz_inits(out, only, NULL);
    if (status == TN_OK && tn_library_apart(library) != SIZE_MAX) {
        uint32_t states;
        tn_library_kept(library, TN_ALL_LENGTHS, only);
        add(result, only);
        status = tn_library_effect(library, (uint32_t)tn_library_apart(library), out, only, &states, error);
        add(result, only);
        if (status == TN_OK)
            status = rank_last(few, library, only, error);
        add(result, only);
        *result |= 1;
    }
    mpz_clears(out, only, NULL);
    tn_library_free(library);
    return status;
}

static void counting_apart_runs_out_of_memory(void **state)
{
    (void)state;
    uint32_t apart = 0;
    for (uint64_t seed = 200; apart < 2 && seed < 300; seed++) {
        test_library made;
        bool ok = test_library_make(&made, seed, &test_schema_house, 0, 4);
        for (uint32_t states = 8; ok && apart < 2 && states < 64; states += 8) {
            few_states few = {&made, states};
            uint64_t result = 0;
            if (count_few(&few, &result, NULL) != TN_OK || !(result & 1))
                continue;
            expect_robust(count_few, &few);
            apart++;
        }
        test_library_clear(&made);
    }
    assert_int_equal(apart, 2);
}

static void memory_runs_out(void **state)
{
    (void)state;
    static const uint64_t seeds[] = {3, 4, 12}; /* 12 has rules that count, in sets of states */
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        test_library made;
        if (test_library_make(&made, seeds[i], &test_schema_tiny, 1, 3) && made.module->CLAUSE_count > 0) {
            expect_robust(open_rules, &made);
            expect_robust(open_library, &made);
            expect_robust(analyse, &made);
            expect_robust(open_library_within, &made);
        }
        test_library_clear(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_runs_out),
        cmocka_unit_test(counting_apart_runs_out_of_memory),
        cmocka_unit_test(comparing_runs_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
