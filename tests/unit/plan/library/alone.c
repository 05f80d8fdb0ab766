/* What clauses alone keep out, as automata, counts and shortest plans: agrees with trying every plan. */
#include "runtime/plan/library/alone.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/automata/count.h"
#include "tests/support/test_library.h"

#define LONGEST 4

typedef struct brute_clause {
    uint64_t alone, without[TEST_CLAUSES_MAX]; /* plans that all keep but perhaps this clause and the other */
    tn_tray first[LONGEST];                    /* of those that it alone keeps out, */
    uint32_t length;                           /* and its length */
} brute_clause;

static bool next_plan(tn_tray *trays, uint32_t length, uint32_t count)
{
    for (uint32_t i = length; i-- > 0;) {
        if (++trays[i] < count)
            return true;
        trays[i] = 0;
    }
    return false;
}

/* Which clauses keep the plan out, a bit each. */
static uint32_t keep_out(const test_library *made, uint32_t bits)
{
    uint32_t failing = 0;
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++)
        failing |= (uint32_t)((bits >> i & 1) == test_library_prunes(made, i)) << i;
    return failing;
}

static void tally(const test_library *made, const tn_tray *trays, uint32_t length, brute_clause *clauses)
{
    uint32_t failing = keep_out(made, test_library_clauses(made, trays, length));
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        for (uint32_t k = 0; k < made->module->CLAUSE_count; k++)
            clauses[i].without[k] += (failing & ~(1u << i) & ~(1u << k)) == 0;
        if (failing != 1u << i)
            continue;
        if (clauses[i].alone++ == 0) {
            memcpy(clauses[i].first, trays, length * sizeof *trays);
            clauses[i].length = length;
        }
    }
}

static void check_without(const test_library *made, uint32_t i, const brute_clause *clause)
{
    tn_dfa *all = NULL;
    tn_error error;
    mpz_t count;
    mpz_init(count);
    test_ok(tn_dfa_constant(tn_library_classes(made->library)->count, true, &all, &error), &error);
    for (uint32_t k = 0; k < made->module->CLAUSE_count; k++) {
        bool skipped[TEST_CLAUSES_MAX] = {false};
        skipped[i] = skipped[k] = true;
        test_ok(tn_library_count_without(made->library, skipped, all, count, &error), &error);
        assert_int_equal(mpz_cmp_ui(count, clause->without[k]), 0);
    }
    tn_dfa_free(all);
    mpz_clear(count);
}

static void check_clause(const test_library *made, uint32_t i, const brute_clause *clause)
{
    const tn_library *library = made->library;
    const tn_sparse *plans;
    tn_tray *trays = NULL;
    size_t length = 0;
    bool any, found;
    tn_error error;
    mpz_t count;
    mpz_init(count);
    test_ok(tn_library_alone_any(library, i, &any, &error), &error);
    assert_int_equal(any, clause->alone > 0);
    test_ok(tn_library_alone_shortest(library, i, &trays, &length, &found, &error), &error);
    assert_int_equal(found, clause->alone > 0);
    if (found) {
        assert_int_equal(length, clause->length);
        assert_memory_equal(trays, clause->first, length * sizeof *trays);
    }
    free(trays);
    test_ok(tn_library_alone(library, i, &plans, &error), &error);
    test_ok(tn_count_range(plans, tn_library_classes(library)->size, tn_library_min(library), tn_library_max(library),
                           count, NULL, &error),
            &error);
    assert_int_equal(mpz_cmp_ui(count, clause->alone), 0);
    mpz_clear(count);
}

static uint64_t check_library(const test_library *made, uint32_t min, uint32_t max)
{
    brute_clause clauses[TEST_CLAUSES_MAX] = {{0}};
    uint64_t alone = 0;
    tn_error error;
    for (uint32_t length = min; length <= max; length++) {
        tn_tray trays[LONGEST] = {0};
        do
            tally(made, trays, length, clauses);
        while (next_plan(trays, length, made->schema->tray_count));
    }
    for (int counted = 0; counted < 2; counted++) { /* the second time from what counting kept */
        for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
            check_clause(made, i, &clauses[i]);
            check_without(made, i, &clauses[i]);
            alone += clauses[i].alone;
        }
        test_ok(tn_library_find_alone(made->library, &error), &error);
    }
    return alone;
}

static void of_any_length(void **state)
{
    (void)state;
    assert_true(test_libraries(test_library_make, check_library, 40, 3, 2, 0) > 10);
}

static void within_the_lengths(void **state)
{
    (void)state;
    assert_true(test_libraries(test_library_make_within, check_library, 40, 3, 2, 0) > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_any_length), cmocka_unit_test(within_the_lengths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
