/* Samples of libraries; hashes of their meaning; their limits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/integers.h"
#include "runtime/plan/library/sample.h"
#include "tests/support/test_library.h"

#define RANKS_MAX 2000

typedef struct ranks {
    mpz_t of[RANKS_MAX];
    size_t found;
} ranks;

static ranks *ranks_new(void)
{
    ranks *made = malloc(sizeof *made);
    assert_non_null(made);
    for (size_t i = 0; i < RANKS_MAX; i++)
        mpz_init(made->of[i]);
    return made;
}

static void ranks_free(ranks *made)
{
    for (size_t i = 0; i < RANKS_MAX; i++)
        mpz_clear(made->of[i]);
    free(made);
}

static void sample(const test_library *made, uint64_t seed, uint32_t length, size_t count, ranks *out)
{
    tn_error error;
    test_ok(tn_library_sample(made->library, seed, length, count, out->of, &out->found, &error), &error);
}

/* As many as there are, up to count; ascending, different, kept by the reference engine, and of the length asked for.
 */
static void check_sample(const test_library *made, uint64_t seed, uint32_t length, size_t count)
{
    ranks *drawn = ranks_new(), *again = ranks_new();
    mpz_t all;
    mpz_init(all);
    tn_library_kept(made->library, length, all);
    sample(made, seed, length, count, drawn);
    assert_int_equal(drawn->found, mpz_cmp_ui(all, count) < 0 ? mpz_get_ui(all) : count);
    sample(made, seed, length, count, again);
    assert_int_equal(again->found, drawn->found);
    for (size_t i = 0; i < drawn->found; i++) {
        tn_tray trays[8];
        uint32_t size;
        assert_int_equal(mpz_cmp(drawn->of[i], again->of[i]), 0);
        assert_true(i == 0 || mpz_cmp(drawn->of[i - 1], drawn->of[i]) < 0);
        assert_true(tn_library_unrank(made->library, drawn->of[i], trays, &size));
        assert_true(length == TN_ALL_LENGTHS || length == size);
        assert_true(test_library_keeps(made, test_library_clauses(made, trays, size)));
    }
    mpz_clear(all);
    ranks_free(drawn);
    ranks_free(again);
}

static void samples_are_kept_distinct_and_repeatable(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        test_library made;
        if (test_library_make(&made, seed, &test_schema_tiny, 1, 5)) {
            check_sample(&made, seed, TN_ALL_LENGTHS, 1);
            check_sample(&made, seed, TN_ALL_LENGTHS, 37);
            check_sample(&made, seed, TN_ALL_LENGTHS, 900);
            check_sample(&made, seed, TN_ALL_LENGTHS, 1999);
            check_sample(&made, seed, 4, 20);
            check_sample(&made, seed, 4, 200);
            check_sample(&made, seed, 9, 5);
        }
        test_library_clear(&made);
    }
}

/* ---- libraries written by hand: no clause, or one */

typedef struct hand {
    tn_module *module;
    tn_schema *schema;
} hand;

/* How the one clause, that no tray is open, is written. */
typedef enum wording { NO_CLAUSE, PRUNE_OPEN, REQUIRE_NONE, NOTHING, UNSATISFIABLE } wording;

static void hand_make(hand *made, wording worded)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, &test_schema_tiny);
    uint32_t spec = test_spec_add(builder, 0, 0xB); /* any width, open */
    uint32_t begin = tn_builder_offset(builder);
    tn_builder_emit(builder, TN_OP_TRAY, spec, 0);
    tn_builder_emit(builder, TN_OP_SOMEWHERE, 0, 0);
    if (worded == REQUIRE_NONE)
        tn_builder_emit(builder, TN_OP_NOT, 0, 0);
    if (worded == UNSATISFIABLE) {
        tn_builder_emit(builder, TN_OP_TRAY, spec, 0);
        tn_builder_emit(builder, TN_OP_SOMEWHERE, 0, 0);
        tn_builder_emit(builder, TN_OP_NOT, 0, 0);
        tn_builder_emit(builder, TN_OP_AND, 0, 0);
    }
    tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
    uint32_t function = tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, "H"),
                                                                               .kind = TN_FUNCTION_HOLDS,
                                                                               .code_begin = begin,
                                                                               .code_end = tn_builder_offset(builder),
                                                                               .stack_max = 2});
    tn_clause_record clause = {.name = tn_builder_string(builder, "closed"),
                               .kind = worded == PRUNE_OPEN ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE,
                               .holds = function};
    tn_library_record record = {.name = tn_builder_string(builder, "hand"),
                                .trays_min = worded == NOTHING ? 0 : 1,
                                .trays_max = worded == NOTHING ? 0 : 3,
                                .clause_count = worded == NO_CLAUSE || worded == NOTHING ? 0 : 1};
    if (record.clause_count)
        tn_builder_add_CLAUSE(builder, &clause);
    tn_builder_add_LIBRARY(builder, &record);
    made->module = test_module(builder);
    made->schema = test_schema_open(made->module, 0);
}

static void hand_clear(hand *made)
{
    tn_schema_free(made->schema);
    tn_module_free(made->module);
}

static tn_library *hand_library(const hand *made, const tn_library_options *options)
{
    tn_library *library = NULL;
    tn_error error;
    test_ok(tn_library_new(made->schema, 0, options, &library, &error), &error);
    return library;
}

static void hash_of(wording worded, const tn_library_options *options, char hex[33])
{
    hand made;
    hand_make(&made, worded);
    tn_library *library = hand_library(&made, options);
    tn_library_hash(library, hex);
    assert_int_equal(strlen(hex), 32);
    tn_library_free(library);
    hand_clear(&made);
}

static void equal_meaning_has_equal_hash(void **state)
{
    (void)state;
    char none[33], prune[33], require[33], longer[33];
    hash_of(NO_CLAUSE, NULL, none);
    hash_of(PRUNE_OPEN, NULL, prune);
    hash_of(REQUIRE_NONE, NULL, require);
    hash_of(PRUNE_OPEN, &(tn_library_options){.override_trays = true, .trays_min = 1, .trays_max = 4}, longer);
    assert_string_equal(prune, require);
    assert_string_not_equal(none, prune);
    assert_string_not_equal(prune, longer);
}

static void check_count(const tn_library *library, uint64_t expected)
{
    mpz_t count;
    mpz_init(count);
    tn_error error;
    tn_library_kept(library, TN_ALL_LENGTHS, count);
    assert_int_equal(mpz_cmp_ui(count, expected), 0);
    test_ok(tn_library_kept_mirror(library, TN_ALL_LENGTHS, count, &error), &error);
    assert_true(mpz_cmp_ui(count, expected) <= 0);
    size_t found;
    mpz_t one[1];
    mpz_init(one[0]);
    test_ok(tn_library_sample(library, 1, TN_ALL_LENGTHS, 1, one, &found, &error), &error);
    assert_int_equal(found, expected > 0);
    tn_tray trays[8];
    uint32_t length;
    mpz_set_ui(one[0], expected);
    assert_false(tn_library_unrank(library, one[0], trays, &length));
    mpz_set_ui(count, 0);
    tn_cursor *cursor;
    test_ok(tn_cursor_new(library, count, one[0], &cursor, &error), &error);
    const tn_tray *walked;
    uint64_t steps = 0;
    while (tn_cursor_next(cursor, &walked, &length))
        steps++;
    assert_int_equal(steps, expected);
    tn_cursor_free(cursor);
    mpz_clears(count, one[0], NULL);
}

static void empty_libraries_and_empty_plans(void **state)
{
    (void)state;
    static const struct {
        wording worded;
        bool override_trays;
        uint32_t min, max;
        uint64_t plans;
    } cases[] = {
        {NO_CLAUSE, false, 0, 0, 4 + 16 + 64},
        {PRUNE_OPEN, false, 0, 0, 2 + 4 + 8},
        {NOTHING, false, 0, 0, 1}, /* the plan of no trays */
        {UNSATISFIABLE, false, 0, 0, 0},
        {UNSATISFIABLE, true, 0, 0, 0},
        {NO_CLAUSE, true, 3, 2, 0},
        {NO_CLAUSE, true, 0, 1, 5},
        {REQUIRE_NONE, true, 0, 0, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        hand made;
        hand_make(&made, cases[i].worded);
        tn_library_options options = {
            .override_trays = cases[i].override_trays, .trays_min = cases[i].min, .trays_max = cases[i].max};
        tn_library *library = hand_library(&made, &options);
        check_count(library, cases[i].plans);
        tn_library_free(library);
        hand_clear(&made);
    }
}

static void refuse(const hand *made, const tn_library_options *options, uint32_t code)
{
    tn_library *library = NULL;
    tn_error error;
    assert_int_equal(tn_library_new(made->schema, 0, options, &library, &error), TN_LIMIT);
    assert_int_equal(error.code, code);
    assert_true(error.help[0] != 0);
    assert_null(library);
}

static void limits_are_reported(void **state)
{
    (void)state;
    hand made;
    hand_make(&made, PRUNE_OPEN);
    refuse(&made, &(tn_library_options){.override_trays = true, .trays_max = 5000}, 805);
    refuse(&made, &(tn_library_options){.max_length = 2}, 805);
    refuse(&made, &(tn_library_options){.override_trays = true, .trays_max = 4000, .max_table = 10000}, 806);
    tn_error error;
    tn_library *library = NULL;
    assert_int_equal(tn_library_new(made.schema, 0, &(tn_library_options){.max_states = 1}, &library, &error),
                     TN_LIMIT);
    assert_int_equal(error.code, 802);
    assert_non_null(strstr(error.message, "closed"));
    hand_clear(&made);
}

/* Shares of a sample together are the sample, whatever memory its counting has; also where the others are drawn. */
static void check_shares(uint64_t seed, const char *all, size_t wanted, uint32_t shares)
{
    tn_error error;
    ranks *whole = ranks_new();
    mpz_t bound, *bounds = tn_integers_new(shares + 1);
    uint64_t counts[8], again[8];
    mpz_init_set_str(bound, all, 10);
    for (uint32_t i = 0; i <= shares; i++) {
        mpz_mul_ui(bounds[i], bound, i);
        mpz_fdiv_q_ui(bounds[i], bounds[i], shares);
    }
    test_ok(tn_ranks_sample(seed, 3, bound, wanted, whole->of, &whole->found, &error), &error);
    tn_draws draws = {.seed = seed, .stream = 3, .bound = bound, .wanted = wanted}, small = draws;
    test_ok(tn_draws_count(&draws, (const mpz_t *)bounds, shares, counts, 1 << 20, NULL, &error), &error);
    test_ok(tn_draws_count(&small, (const mpz_t *)bounds, shares, again, 1000, NULL, &error), &error);
    assert_true(draws.attempts == small.attempts);
    assert_memory_equal(counts, again, shares * sizeof *counts);
    size_t at = 0;
    for (uint32_t i = 0; i < shares; i++) {
        mpz_t *given;
        size_t count;
        test_ok(tn_draws_between(&draws, bounds[i], bounds[i + 1], &given, &count, NULL, &error), &error);
        assert_int_equal(count, counts[i]);
        for (size_t k = 0; k < count; k++)
            assert_int_equal(mpz_cmp(given[k], whole->of[at++]), 0);
        tn_integers_free(given, count);
    }
    assert_int_equal(at, whole->found);
    tn_integers_free(bounds, shares + 1);
    mpz_clear(bound);
    ranks_free(whole);
}

static void shares_are_the_whole(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 20; seed++) {
        check_shares(seed, "1", seed % 2, 1);
        check_shares(seed, "100", 5 * seed, 4);
        check_shares(seed, "2001", 1000 + 50 * seed, 8);
        check_shares(seed, "4294967296", 2000, 7);
        check_shares(seed, "340282366920938463463374607431768211457", 500, 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_kept_distinct_and_repeatable),
        cmocka_unit_test(shares_are_the_whole),
        cmocka_unit_test(equal_meaning_has_equal_hash),
        cmocka_unit_test(empty_libraries_and_empty_plans),
        cmocka_unit_test(limits_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
