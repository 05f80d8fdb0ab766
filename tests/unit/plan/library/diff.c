/* Comparing libraries: what it counts for random libraries is what trying every plan counts; trays are matched by name.
 */
#include "runtime/plan/library/diff.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_library.h"

enum { SEEDS = 60, LONGEST = 4 };

typedef struct tally {
    uint64_t parts[TN_DIFF_PARTS][LONGEST + 1];
    uint64_t removes[TEST_CLAUSES_MAX], adds[TEST_CLAUSES_MAX]; /* by clause of the new side, of the old one */
    uint64_t too_long, too_short; /* removed, added only because of the number of trays or also because of it */
} tally;

static bool holds(const test_library *made, uint32_t min, uint32_t max, uint32_t length, uint32_t bits)
{
    return length >= min && length <= max && test_library_keeps(made, bits);
}

static void count_drops(const test_library *made, uint32_t bits, uint64_t *drops)
{
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++)
        drops[i] += (bits >> i & 1) == test_library_prunes(made, i);
}

static void try_plan(const test_library *sides, const uint32_t lengths[2][2], const tn_tray *trays, uint32_t length,
                     tally *t)
{
    uint32_t before = test_library_clauses(&sides[0], trays, length);
    uint32_t after = test_library_clauses(&sides[1], trays, length);
    bool was = holds(&sides[0], lengths[0][0], lengths[0][1], length, before);
    bool is = holds(&sides[1], lengths[1][0], lengths[1][1], length, after);
    if (!was && !is)
        return;
    t->parts[was && is ? TN_DIFF_KEPT : was ? TN_DIFF_REMOVED : TN_DIFF_ADDED][length]++;
    if (was && !is)
        count_drops(&sides[1], after, t->removes);
    if (is && !was)
        count_drops(&sides[0], before, t->adds);
    t->too_long += was && !is && (length < lengths[1][0] || length > lengths[1][1]);
    t->too_short += is && !was && (length < lengths[0][0] || length > lengths[0][1]);
}

static void try_all(const test_library *sides, const uint32_t lengths[2][2], tally *t)
{
    for (uint32_t length = 0; length <= LONGEST; length++) {
        for (uint32_t code = 0; code < 1u << (2 * length); code++) {
            tn_tray trays[LONGEST + 1];
            for (uint32_t i = 0; i < length; i++)
                trays[i] = code >> (2 * i) & 3;
            try_plan(sides, lengths, trays, length, t);
        }
    }
}

static void check_counts(const tn_library_diff *diff, const tally *t)
{
    mpz_t count;
    mpz_init(count);
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        for (uint32_t length = 0; length <= LONGEST; length++) {
            tn_library_kept(tn_library_diff_part(diff, (tn_diff_part)part), length, count);
            assert_int_equal(mpz_get_ui(count), t->parts[part][length]);
        }
    }
    mpz_clear(count);
}

static void check_clauses(const tn_library_diff *diff, const tally *t)
{
    for (size_t i = 0; i < tn_library_diff_clauses(diff); i++) {
        const tn_changed_clause *clause = tn_library_diff_clause(diff, i);
        uint64_t removes = clause->lengths ? t->too_long : clause->after == UINT32_MAX ? 0 : t->removes[clause->after];
        uint64_t adds = clause->lengths ? t->too_short : clause->before == UINT32_MAX ? 0 : t->adds[clause->before];
        assert_int_equal(mpz_get_ui(clause->removes), removes);
        assert_int_equal(mpz_get_ui(clause->adds), adds);
    }
}

/* Every plan of a part is in the libraries that it should be in, and in no other. */
static void check_members(const tn_library_diff *diff, const test_library *sides)
{
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        const tn_library *library = tn_library_diff_part(diff, (tn_diff_part)part);
        mpz_t rank;
        mpz_init(rank);
        tn_tray trays[LONGEST + 1];
        for (uint32_t length; tn_library_unrank(library, rank, trays, &length); mpz_add_ui(rank, rank, 1)) {
            assert_int_equal(tn_library_has(sides[0].library, trays, length), part != TN_DIFF_ADDED);
            assert_int_equal(tn_library_has(sides[1].library, trays, length), part != TN_DIFF_REMOVED);
        }
        mpz_clear(rank);
    }
}

static void test_random_libraries(void **state)
{
    (void)state;
    size_t compared = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        static const uint32_t lengths[3][2][2] = {{{1, 4}, {1, 4}}, {{0, 3}, {2, 4}}, {{2, 3}, {1, 4}}};
        test_library sides[2];
        tally t = {0};
        bool made = true;
        for (int side = 0; side < 2; side++)
            made &= test_library_make(&sides[side], seed + (uint64_t)side * 1000, &test_schema_tiny,
                                      lengths[seed % 3][side][0], lengths[seed % 3][side][1]);
        if (made) {
            tn_library_diff *diff;
            tn_error error;
            compared++;
            test_ok(tn_library_diff_new(sides[0].library, sides[1].library, 0, NULL, &diff, &error), &error);
            try_all(sides, lengths[seed % 3], &t);
            check_counts(diff, &t);
            check_clauses(diff, &t);
            check_members(diff, sides);
            tn_library_diff_free(diff);
        }
        test_library_clear(&sides[0]);
        test_library_clear(&sides[1]);
    }
    assert_in_range(compared, SEEDS / 2, SEEDS);
}

static void test_same_library(void **state)
{
    (void)state;
    test_library sides[2];
    tn_library_diff *diff;
    tn_error error;
    for (int side = 0; side < 2; side++)
        assert_true(test_library_make(&sides[side], 3, &test_schema_house, 1, 3));
    test_ok(tn_library_diff_new(sides[0].library, sides[1].library, 0, NULL, &diff, &error), &error);
    assert_int_equal(tn_library_diff_clauses(diff), 0);
    mpz_t count;
    mpz_init(count);
    for (int part = TN_DIFF_REMOVED; part <= TN_DIFF_ADDED; part++) {
        tn_library_kept(tn_library_diff_part(diff, (tn_diff_part)part), TN_ALL_LENGTHS, count);
        assert_int_equal(mpz_sgn(count), 0);
    }
    mpz_clear(count);
    tn_library_diff_free(diff);
    test_library_clear(&sides[0]);
    test_library_clear(&sides[1]);
}

static void test_other_trays(void **state)
{
    (void)state;
    tn_builder *builders[2];
    tn_module *modules[2];
    tn_schema *schemas[2];
    const test_schema *described[2] = {&test_schema_tiny, &test_schema_house};
    for (int i = 0; i < 2; i++) {
        builders[i] = tn_builder_new();
        test_schema_add(builders[i], described[i]);
        modules[i] = test_module(builders[i]);
        schemas[i] = test_schema_open(modules[i], 0);
    }
    tn_tray *map = NULL;
    tn_error error;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(tn_tray_map(schemas[i], schemas[!i], &map, &error), TN_INVALID);
        assert_int_equal(error.code, 508);
        test_ok(tn_tray_map(schemas[i], schemas[i], &map, &error), &error);
        for (tn_tray t = 0; t < schemas[i]->tray_count; t++)
            assert_int_equal(map[t], t);
        free(map);
    }
    for (int i = 0; i < 2; i++) {
        tn_schema_free(schemas[i]);
        tn_module_free(modules[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_libraries), cmocka_unit_test(test_same_library),
                                       cmocka_unit_test(test_other_trays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
