/* The nearest kept plans are those that trying every kept plan finds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/library/near.h"
#include "tests/support/test_library.h"

#define LONGEST 5
#define MOST 3

/* The distance of two plans, straight from its definition: the best of the three ways to go on. */
static uint32_t distance(const tn_schema *schema, const tn_tray *a, size_t n, const tn_tray *b, size_t m)
{
    uint32_t table[LONGEST + 3][LONGEST + 3], fields = schema->field_count;
    for (size_t i = 0; i <= n; i++) {
        for (size_t j = 0; j <= m; j++) {
            uint32_t best = i == 0 && j == 0 ? 0 : UINT32_MAX;
            if (i > 0 && table[i - 1][j] + fields < best)
                best = table[i - 1][j] + fields;
            if (j > 0 && table[i][j - 1] + fields < best)
                best = table[i][j - 1] + fields;
            if (i > 0 && j > 0) {
                uint32_t change = 0;
                for (uint32_t f = 0; f < fields; f++)
                    change += tn_tray_value(schema, a[i - 1], f) != tn_tray_value(schema, b[j - 1], f);
                best = table[i - 1][j - 1] + change < best ? table[i - 1][j - 1] + change : best;
            }
            table[i][j] = best;
        }
    }
    return table[n][m];
}

/* Walks all kept plans in rank order, keeping the first few of the nearest. */
static void brute_force(const test_library *made, const tn_tray *trays, size_t length, tn_near *best)
{
    mpz_t from, to;
    tn_cursor *cursor;
    const tn_tray *plan;
    uint32_t plan_length;
    tn_error error;
    mpz_inits(from, to, NULL);
    tn_library_kept(made->library, TN_ALL_LENGTHS, to);
    test_ok(tn_cursor_new(made->library, from, to, &cursor, &error), &error);
    best->cost = UINT32_MAX;
    while (tn_cursor_next(cursor, &plan, &plan_length)) {
        uint32_t cost = distance(made->schema, trays, length, plan, plan_length);
        if (cost > best->cost)
            continue;
        if (cost < best->cost)
            best->count = best->more = 0;
        best->cost = cost;
        if (best->count == MOST) {
            best->more = true;
            continue;
        }
        memcpy(best->plans[best->count].trays, plan, plan_length * sizeof *plan);
        best->plans[best->count++].length = plan_length;
    }
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
}

static void compare(const test_library *made, tn_near_finder *finder, const tn_tray *trays, size_t length)
{
    tn_tray room[MOST][LONGEST];
    tn_near_plan plans[MOST] = {{room[0], 0}, {room[1], 0}, {room[2], 0}};
    tn_near wanted = {.plans = plans}, near;
    tn_error error;
    brute_force(made, trays, length, &wanted);
    test_ok(tn_near_find(finder, trays, length, MOST, &near, &error), &error);
    assert_int_equal(near.count, wanted.count);
    assert_int_equal(near.more, wanted.more);
    if (wanted.count)
        assert_int_equal(near.cost, wanted.cost);
    for (size_t i = 0; i < near.count; i++) {
        assert_int_equal(near.plans[i].length, wanted.plans[i].length);
        assert_memory_equal(near.plans[i].trays, wanted.plans[i].trays, near.plans[i].length * sizeof(tn_tray));
        assert_true(tn_library_has(made->library, near.plans[i].trays, near.plans[i].length));
    }
    tn_near_clear(&near);
}

/* However much is combined, the answer is the same: every clause by itself, some together, all; and combined only when
 * a search turns out long. */
static void compare_all(const test_library *made, test_random *random, const tn_near_options *options, uint32_t plans,
                        uint32_t longest)
{
    tn_near_finder *finder;
    tn_error error;
    test_ok(tn_near_finder_new(made->schema, 0, options, &finder, &error), &error);
    for (uint32_t n = 0; n < plans; n++) {
        test_plan plan;
        tn_tray trays[TEST_LENGTH_MAX];
        uint32_t length = test_random_below(random, longest + 1);
        test_plan_random(random, made->schema, length, &plan, trays);
        compare(made, finder, trays, length);
    }
    tn_near_finder_free(finder);
}

static const tn_near_options several[] = {
    {.combine = 1}, {.combine = 30}, {.combine = 0}, {.combine = 1, .patience = 10}, {.combine = 30, .patience = 40},
};
#define SEVERAL (sizeof several / sizeof *several)

static void random_libraries(void **state)
{
    (void)state;
    test_random random = {.seed = 11};
    for (uint64_t seed = 0; seed < 60; seed++) {
        test_library made;
        uint32_t min = test_random_below(&random, 3), max = min + test_random_below(&random, LONGEST + 1 - min);
        for (size_t i = 0; i < SEVERAL && (i > 0 || test_library_make(&made, seed, &test_schema_tiny, min, max)); i++)
            compare_all(&made, &random, &several[i], 4, LONGEST + 1);
        test_library_clear(&made);
    }
}

/* More fields, so that changes cost differently. */
static void a_larger_schema(void **state)
{
    (void)state;
    test_random random = {.seed = 12};
    for (uint64_t seed = 0; seed < 12; seed++) {
        test_library made;
        for (size_t i = 0; i < SEVERAL && (i > 0 || test_library_make(&made, seed, &test_schema_house, 1, 3)); i++)
            compare_all(&made, &random, &several[i], 1, 4);
        test_library_clear(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_libraries), cmocka_unit_test(a_larger_schema)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
