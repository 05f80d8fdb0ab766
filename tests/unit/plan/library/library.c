/* Libraries: counting, ranking, sampling and walking agree with trying every plan. */
#include "runtime/plan/library/library.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/library/rank.h"
#include "tests/support/test_library.h"

typedef struct brute_count {
    uint64_t generated, kept, mirror;
    uint64_t out[TEST_CLAUSES_MAX], only[TEST_CLAUSES_MAX];
    uint64_t beside[2]; /* of those generated and kept, matched by the rule that is no clause */
} brute_count;

static void tally(const test_library *made, uint32_t bits, brute_count *count)
{
    uint32_t failing = 0, last = 0;
    bool generated = true;
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        if ((bits >> i & 1) != test_library_prunes(made, i))
            continue;
        failing++;
        last = i;
        generated = generated && test_library_prunes(made, i);
    }
    count->generated += generated;
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        bool prunes = test_library_prunes(made, i);
        count->out[i] += (bits >> i & 1) == prunes && (generated || !prunes);
    }
    if (failing == 1)
        count->only[last]++;
    bool beside = bits >> made->module->CLAUSE_count & 1;
    count->beside[0] += beside && generated;
    count->beside[1] += beside && failing == 0;
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

/* Plans in any order, many with a beginning like that of the one before. */
static void check_ranking(const test_library *made, uint64_t kept)
{
    tn_ranking *ranking;
    tn_error error;
    mpz_t rank;
    test_ok(tn_ranking_new(made->library, &ranking, &error), &error);
    mpz_init(rank);
    for (uint64_t i = 0; i < 2 * kept; i++) {
        tn_tray trays[8];
        uint32_t length;
        mpz_set_ui(rank, i < kept ? i : i * 37 % kept);
        assert_true(tn_library_unrank(made->library, rank, trays, &length));
        mpz_srcptr found = tn_ranking_next(ranking, trays, length);
        assert_true(found && mpz_cmp(found, rank) == 0);
        assert_null(tn_ranking_next(ranking, trays, (size_t)tn_library_max(made->library) + 1));
    }
    mpz_clear(rank);
    tn_ranking_free(ranking);
}

static void check_effects(const test_library *made, const brute_count *all)
{
    mpz_t out, only;
    mpz_inits(out, only, NULL);
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        uint32_t states;
        tn_error error;
        test_ok(tn_library_effect(made->library, i, out, only, &states, &error), &error);
        assert_true(states > 0);
        assert_int_equal(mpz_cmp_ui(out, all->out[i]), 0);
        assert_int_equal(mpz_cmp_ui(only, all->only[i]), 0);
    }
    mpz_clears(out, only, NULL);
}

/* The rule that is no clause, and each that is one. */
static void check_matches(const test_library *made, const brute_count *all)
{
    mpz_t matched[2 * (TEST_CLAUSES_MAX + 1)];
    uint32_t functions[TEST_CLAUSES_MAX + 1], count = made->module->RULE_count;
    tn_error error;
    for (uint32_t i = 0; i < count; i++) {
        functions[i] = made->module->RULE_records[i].holds;
        mpz_inits(matched[2 * i], matched[2 * i + 1], NULL);
    }
    test_ok(tn_library_matches(made->library, functions, count, matched, &error), &error);
    for (uint32_t i = 0; i + 1 < count; i++) {
        bool prunes = test_library_prunes(made, i);
        assert_int_equal(mpz_cmp_ui(matched[2 * i], prunes ? all->out[i] : all->generated), 0);
        assert_int_equal(mpz_cmp_ui(matched[2 * i + 1], prunes ? 0 : all->kept), 0);
    }
    if (mpz_sgn(matched[2 * count - 2]) >= 0) { /* not past the limit */
        assert_int_equal(mpz_cmp_ui(matched[2 * count - 2], all->beside[0]), 0);
        assert_int_equal(mpz_cmp_ui(matched[2 * count - 1], all->beside[1]), 0);
    }
    for (uint32_t i = 0; i < count; i++)
        mpz_clears(matched[2 * i], matched[2 * i + 1], NULL);
}

static void add_count(brute_count *sum, const brute_count *count)
{
    sum->generated += count->generated;
    sum->kept += count->kept;
    sum->mirror += count->mirror;
    for (size_t i = 0; i < 2; i++)
        sum->beside[i] += count->beside[i];
    for (size_t i = 0; i < TEST_CLAUSES_MAX; i++) {
        sum->out[i] += count->out[i];
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
    check_ranking(made, all.kept);
    check_effects(made, &all);
    check_matches(made, &all);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return all.kept;
}

static void try_every_plan(test_library_maker *make)
{
    assert_true(test_libraries(make, check_library, 60, 3, 3, 10) > 15);
    for (uint64_t seed = 100; seed < 110; seed++) {
        test_library made;
        if (make(&made, seed, &test_schema_house, 0, 2))
            check_library(&made, 0, 2);
        test_library_clear(&made);
    }
}

static void everything_agrees_with_trying_every_plan(void **state)
{
    (void)state;
    try_every_plan(test_library_make);
}

static void within_the_lengths_too(void **state)
{
    (void)state;
    try_every_plan(test_library_make_within);
}

static void check_equal_counts(const test_library *a, const test_library *b)
{
    mpz_t x, y, only_x, only_y;
    mpz_inits(x, y, only_x, only_y, NULL);
    tn_error error;
    for (uint32_t length = tn_library_min(a->library); length <= tn_library_max(a->library); length++) {
        tn_library_kept(a->library, length, x);
        tn_library_kept(b->library, length, y);
        assert_int_equal(mpz_cmp(x, y), 0);
        test_ok(tn_library_generated(a->library, length, x, &error), &error);
        test_ok(tn_library_generated(b->library, length, y, &error), &error);
        assert_int_equal(mpz_cmp(x, y), 0);
        test_ok(tn_library_kept_mirror(a->library, length, x, &error), &error);
        test_ok(tn_library_kept_mirror(b->library, length, y, &error), &error);
        assert_int_equal(mpz_cmp(x, y), 0);
    }
    for (uint32_t i = 0; i < a->module->CLAUSE_count; i++) {
        uint32_t states;
        test_ok(tn_library_effect(a->library, i, x, only_x, &states, &error), &error);
        test_ok(tn_library_effect(b->library, i, y, only_y, &states, &error), &error);
        assert_int_equal(mpz_cmp(x, y), 0);
        assert_int_equal(mpz_cmp(only_x, only_y), 0);
    }
    mpz_clears(x, y, only_x, only_y, NULL);
}

/* Lengths at which trying every plan takes too long. */
static void both_ways_of_building_agree(void **state)
{
    (void)state;
    uint32_t compared = 0, within = 0;
    for (uint64_t seed = 200; seed < 230; seed++) {
        test_library a, b;
        char hash_a[33], hash_b[33];
        bool ok_a = test_library_make(&a, seed, &test_schema_house, 1 + seed % 4, 9);
        bool ok_b = test_library_make_within(&b, seed, &test_schema_house, 1 + seed % 4, 9);
        if (ok_a && ok_b) {
            check_equal_counts(&a, &b);
            tn_library_hash(a.library, hash_a);
            tn_library_hash(b.library, hash_b);
            assert_string_equal(hash_a, hash_b);
            compared++;
            within += tn_library_within(b.library);
        }
        test_library_clear(&a);
        test_library_clear(&b);
    }
    assert_true(compared > 10);
    assert_true(within > 10);
}

/* A library that leaves a clause out of its automaton has the same plans as the whole one, with the same ranks; the
 * plans are drawn, from any trays and from those of the library. */
static void check_ranks_apart(const test_library *whole, const tn_library *apart, uint64_t seed)
{
    test_random random = {.seed = seed};
    tn_tray trays[8];
    mpz_t kept, x, y;
    mpz_inits(kept, x, y, NULL);
    tn_library_kept(whole->library, TN_ALL_LENGTHS, kept);
    for (uint32_t i = 0; i < 40; i++) {
        uint32_t length = (uint32_t)test_random_below(&random, tn_library_max(apart) + 2);
        for (uint32_t k = 0; k < length; k++)
            trays[k] = (tn_tray)test_random_below(&random, whole->schema->tray_count);
        if (i % 2 == 0 && mpz_sgn(kept) > 0) {
            mpz_set_ui(x, (unsigned long)test_random_below(&random, (uint32_t)mpz_get_ui(kept)));
            assert_true(tn_library_unrank(whole->library, x, trays, &length));
        }
        bool has = false;
        tn_error error;
        bool there = tn_library_rank(whole->library, trays, length, x);
        assert_int_equal(tn_library_has(apart, trays, length), there);
        test_ok(tn_library_counted_rank(apart, trays, length, &has, y, &error), &error);
        assert_int_equal(has, there);
        assert_true(!there || mpz_cmp(x, y) == 0);
    }
    mpz_clears(kept, x, y, NULL);
}

/* A library that leaves a clause out of its automaton has the same counts as the whole one. */
static void check_apart(const test_library *whole, const tn_library *apart)
{
    mpz_t x, y, only_x, only_y;
    mpz_inits(x, y, only_x, only_y, NULL);
    tn_error error;
    for (uint32_t length = tn_library_min(apart); length <= tn_library_max(apart) + 1; length++) {
        uint32_t asked = length <= tn_library_max(apart) ? length : TN_ALL_LENGTHS;
        tn_library_kept(whole->library, asked, x);
        tn_library_kept(apart, asked, y);
        assert_int_equal(mpz_cmp(x, y), 0);
        test_ok(tn_library_generated(whole->library, asked, x, &error), &error);
        test_ok(tn_library_generated(apart, asked, y, &error), &error);
        assert_int_equal(mpz_cmp(x, y), 0);
    }
    for (uint32_t i = 0; i < whole->module->CLAUSE_count; i++) {
        uint32_t states;
        test_ok(tn_library_effect(whole->library, i, x, only_x, &states, &error), &error);
        tn_status status = tn_library_effect(apart, i, y, only_y, &states, &error);
        assert_int_equal(status, i == tn_library_apart(apart) ? TN_OK : TN_LIMIT);
        assert_int_equal(mpz_cmp(x, y), 0);
        assert_true(status == TN_OK ? mpz_cmp(only_x, only_y) == 0 : mpz_sgn(only_y) < 0);
    }
    mpz_clears(x, y, only_x, only_y, NULL);
}

static void a_clause_is_counted_apart(void **state)
{
    (void)state;
    uint32_t required = 0, pruned = 0;
    for (uint64_t seed = 200; seed < 300; seed++) {
        test_library made;
        bool ok = test_library_make(&made, seed, &test_schema_house, seed % 3, 6);
        for (uint32_t states = 8; ok && states < 128; states += 1 + states / 8) {
            tn_library *library = NULL;
            tn_library_options options = {.max_states = states, .max_eager = 1, .only_counted = true, .threads = 1};
            tn_error error;
            if (tn_library_new(made.schema, 0, &options, &library, &error) == TN_OK &&
                tn_library_apart(library) != SIZE_MAX) {
                bool prunes = test_library_prunes(&made, (uint32_t)tn_library_apart(library));
                assert_true(tn_library_states(library) <= states + 1);
                check_apart(&made, library);
                check_ranks_apart(&made, library, seed);
                pruned += prunes;
                required += !prunes;
            }
            tn_library_free(library);
        }
        test_library_clear(&made);
    }
    assert_true(required > 10);
    assert_true(pruned > 10);
}

static void a_hash_tells_libraries_apart(void **state)
{
    (void)state;
    char hashes[40][33];
    mpz_t kept[40];
    uint32_t count = 0;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        test_library made;
        if (test_library_make(&made, seed, &test_schema_tiny, 1, 4)) {
            tn_library_hash(made.library, hashes[count]);
            mpz_init(kept[count]);
            tn_library_kept(made.library, TN_ALL_LENGTHS, kept[count++]);
        }
        test_library_clear(&made);
    }
    uint32_t different = 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < i; j++)
            if (mpz_cmp(kept[i], kept[j]) != 0) {
                assert_string_not_equal(hashes[i], hashes[j]);
                different++;
            }
    assert_true(different > 40);
    for (uint32_t i = 0; i < count; i++)
        mpz_clear(kept[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_agrees_with_trying_every_plan),
        cmocka_unit_test(within_the_lengths_too),
        cmocka_unit_test(both_ways_of_building_agree),
        cmocka_unit_test(a_clause_is_counted_apart),
        cmocka_unit_test(a_hash_tells_libraries_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
