/* Libraries: counting, ranking, sampling and walking agree with trying every plan. */
#include "runtime/plan/library.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_library.h"

typedef struct brute_count {
    uint64_t generated, kept, mirror;
    uint64_t prunes[TEST_CLAUSES_MAX], only[TEST_CLAUSES_MAX];
} brute_count;

static void tally(const test_library *made, uint32_t bits, brute_count *count)
{
    uint32_t pruned = 0, last = 0;
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        if (!test_library_prunes(made, i) && !(bits >> i & 1))
            return;
        if (test_library_prunes(made, i) && bits >> i & 1) {
            pruned++;
            last = i;
        }
    }
    count->generated++;
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++)
        count->prunes[i] += test_library_prunes(made, i) && bits >> i & 1;
    if (pruned == 1)
        count->only[last]++;
}

static bool next_plan(tn_tray *trays, uint32_t length, uint32_t count)
{
    for (uint32_t i = length; i-- > 0;) {
        if (++trays[i] < count)
            return true;
        trays[i] = 0;
    }
    return false;
}

static bool mirror_first(const test_library *made, const tn_tray *trays, uint32_t length)
{
    tn_tray turned[8] = {0};
    for (uint32_t i = 0; i < length; i++)
        turned[i] = trays[length - 1 - i];
    if (!test_library_keeps(made, test_library_clauses(made, turned, length)))
        return true;
    for (uint32_t i = 0; i < length; i++)
        if (trays[i] != turned[i])
            return trays[i] < turned[i];
    return true;
}

/* One plan: membership, rank, unrank and the cursor. `rank` is how many kept plans came before. */
static void check_plan(const test_library *made, const tn_tray *trays, uint32_t length, uint64_t rank, bool kept,
                       tn_cursor *cursor)
{
    mpz_t number;
    mpz_init(number);
    assert_int_equal(tn_library_has(made->library, trays, length), kept);
    assert_int_equal(tn_library_rank(made->library, trays, length, number), kept);
    assert_int_equal(tn_library_failing(made->library, trays, length) == UINT32_MAX, kept);
    if (kept) {
        assert_int_equal(mpz_cmp_ui(number, rank), 0);
        tn_tray again[8];
        uint32_t size;
        assert_true(tn_library_unrank(made->library, number, again, &size));
        assert_int_equal(size, length);
        assert_memory_equal(again, trays, length * sizeof *trays);
        const tn_tray *walked;
        assert_true(tn_cursor_next(cursor, &walked, &size));
        assert_int_equal(size, length);
        assert_memory_equal(walked, trays, length * sizeof *trays);
        assert_int_equal(tn_library_mirror_first(made->library, trays, length), mirror_first(made, trays, length));
    }
    mpz_clear(number);
}

static void check_counts(const test_library *made, uint32_t length, const brute_count *count)
{
    mpz_t number;
    mpz_init(number);
    tn_error error;
    tn_library_kept(made->library, length, number);
    assert_int_equal(mpz_cmp_ui(number, count->kept), 0);
    test_ok(tn_library_generated(made->library, length, number, &error), &error);
    assert_int_equal(mpz_cmp_ui(number, count->generated), 0);
    test_ok(tn_library_kept_mirror(made->library, length, number, &error), &error);
    assert_int_equal(mpz_cmp_ui(number, count->mirror), 0);
    mpz_clear(number);
}

static void check_prunes(const test_library *made, const brute_count *all)
{
    mpz_t matched, only;
    mpz_inits(matched, only, NULL);
    uint32_t expected = 0;
    for (size_t i = 0; i < tn_library_prune_count(made->library); i++) {
        uint32_t clause, states;
        tn_error error;
        test_ok(tn_library_prune(made->library, i, &clause, matched, only, &states, &error), &error);
        while (!test_library_prunes(made, expected))
            expected++;
        assert_int_equal(clause, expected++);
        assert_true(states > 0);
        assert_int_equal(mpz_cmp_ui(matched, all->prunes[clause]), 0);
        assert_int_equal(mpz_cmp_ui(only, all->only[clause]), 0);
    }
    mpz_clears(matched, only, NULL);
}

static void add_count(brute_count *sum, const brute_count *count)
{
    sum->generated += count->generated;
    sum->kept += count->kept;
    sum->mirror += count->mirror;
    for (size_t i = 0; i < TEST_CLAUSES_MAX; i++) {
        sum->prunes[i] += count->prunes[i];
        sum->only[i] += count->only[i];
    }
}

/* Tries every plan; returns how many are kept. */
static uint64_t check_library(const test_library *made, uint32_t min, uint32_t max)
{
    mpz_t from, to;
    mpz_init(from);
    mpz_init_set_ui(to, UINT64_MAX);
    tn_cursor *cursor;
    tn_error error;
    test_ok(tn_cursor_new(made->library, from, to, &cursor, &error), &error);
    brute_count all = {0};
    for (uint32_t length = min; length <= max; length++) {
        brute_count count = {0};
        tn_tray trays[8] = {0};
        do {
            uint32_t bits = test_library_clauses(made, trays, length);
            bool kept = test_library_keeps(made, bits);
            check_plan(made, trays, length, all.kept + count.kept, kept, cursor);
            tally(made, bits, &count);
            count.kept += kept;
            count.mirror += kept && mirror_first(made, trays, length);
        } while (next_plan(trays, length, made->schema->tray_count));
        check_counts(made, length, &count);
        add_count(&all, &count);
    }
    const tn_tray *trays;
    uint32_t length;
    assert_false(tn_cursor_next(cursor, &trays, &length));
    check_counts(made, TN_ALL_LENGTHS, &all);
    check_prunes(made, &all);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return all.kept;
}

static void everything_agrees_with_trying_every_plan(void **state)
{
    (void)state;
    uint32_t interesting = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        test_library made;
        uint32_t min = (uint32_t)(seed % 3);
        if (test_library_make(&made, seed, &test_schema_tiny, min, min + 3))
            interesting += check_library(&made, min, min + 3) > 10;
        test_library_clear(&made);
    }
    assert_true(interesting > 15);
    for (uint64_t seed = 100; seed < 110; seed++) {
        test_library made;
        if (test_library_make(&made, seed, &test_schema_house, 0, 2))
            check_library(&made, 0, 2);
        test_library_clear(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_agrees_with_trying_every_plan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
