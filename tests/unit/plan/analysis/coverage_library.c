/* Coverage in a library counts the generated plans that are kept with a part and not without it, or the other way
 * round: what its own automata say of every plan, added up. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/analysis/coverage.h"
#include "runtime/plan/match/parts.h"
#include "tests/support/test_library.h"

#define PARTS 4 /* of each clause */

static bool next_plan(tn_tray *trays, uint32_t length, uint32_t count)
{
    for (uint32_t i = length; i-- > 0;) {
        if (++trays[i] < count)
            return true;
        trays[i] = 0;
    }
    return false;
}

/* Is a plan kept? *generated: do the requirements, as they are, leave it? */
static bool is_kept(const test_library *made, const tn_coverage *coverage, bool without, const tn_tray *trays,
                    uint32_t length, bool *generated)
{
    bool kept = true;
    *generated = true;
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        bool prunes = test_library_prunes(made, i);
        kept = kept && tn_coverage_holds(coverage, i, without, trays, length) != prunes;
        *generated = *generated && (prunes || tn_coverage_holds(coverage, i, false, trays, length));
    }
    return kept;
}

static uint64_t brute_force(const test_library *made, const tn_coverage *coverage, uint32_t min, uint32_t max)
{
    uint64_t flips = 0;
    for (uint32_t length = min; length <= max; length++) {
        tn_tray trays[8] = {0};
        do {
            bool generated;
            bool with = is_kept(made, coverage, false, trays, length, &generated);
            flips += generated && with != is_kept(made, coverage, true, trays, length, &generated);
        } while (next_plan(trays, length, made->schema->tray_count));
    }
    return flips;
}

/* Leaves out these parts, of one clause or of two. */
static uint64_t check_parts(const test_library *made, tn_coverage *coverage, const uint32_t *offsets, size_t count,
                            uint32_t min, uint32_t max)
{
    tn_error error;
    mpz_t flips;
    mpz_init(flips);
    test_ok(tn_coverage_without(coverage, offsets, count, &error), &error);
    test_ok(tn_coverage_flips(coverage, flips, &error), &error);
    uint64_t wanted = brute_force(made, coverage, min, max);
    assert_int_equal(mpz_cmp_ui(flips, wanted), 0);
    mpz_clear(flips);
    return wanted;
}

static uint64_t check_library(const test_library *made, uint32_t min, uint32_t max)
{
    tn_coverage *coverage;
    tn_error error;
    uint64_t flips = 0;
    uint32_t before = TN_NO_OFFSET;
    test_ok(tn_coverage_of_library(made->library, &coverage, &error), &error);
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++) {
        tn_parts parts;
        test_ok(tn_parts_read(made->module, made->module->CLAUSE_records[i].holds, &parts, &error), &error);
        for (uint32_t p = 0; p < parts.count && p < PARTS; p++) {
            uint32_t offsets[2] = {parts.parts[p].root, before};
            flips += check_parts(made, coverage, offsets, 1, min, max);
            if (before != TN_NO_OFFSET)
                flips += check_parts(made, coverage, offsets, 2, min, max);
        }
        before = parts.parts[0].root;
        tn_parts_clear(&parts);
    }
    tn_coverage_free(coverage);
    return flips;
}

static void of_any_length(void **state)
{
    (void)state;
    assert_true(test_libraries(test_library_make, check_library, 30, 2, 2, 0) > 10);
}

static void within_the_lengths(void **state)
{
    (void)state;
    assert_true(test_libraries(test_library_make_within, check_library, 30, 2, 2, 0) > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_any_length), cmocka_unit_test(within_the_lengths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
