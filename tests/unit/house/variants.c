/* The houses on one plan: their number is that of those that all clauses keep when each is asked one by one; ranks and
 * houses are inverse; and too much work is an error that names a clause. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/house/variant/variant.h"
#include "tests/support/test_house.h"

static test_house made;

static tn_house_variants *variants_of(const tn_house_library_record *library, uint64_t work)
{
    tn_house_variants *variants;
    tn_error error = {0};
    assert_int_equal(tn_house_variants_new(&made.form, library, work, &variants, &error), TN_OK);
    return variants;
}

static uint64_t count_of(tn_house_variants *variants, const tn_plan *plan, tn_house_counts *counts)
{
    tn_error error = {0};
    tn_house_counts_init(counts);
    assert_int_equal(tn_house_variants_count(variants, plan->trays, plan->length, counts, &error), TN_OK);
    return mpz_get_ui(counts->houses);
}

/* The line of house `variant`; checks that its rank is `variant` again. */
static void take(tn_house_variants *variants, const tn_plan *plan, uint64_t variant, tn_house *house)
{
    tn_error error = {0};
    mpz_t rank;
    mpz_init_set_ui(rank, variant);
    assert_int_equal(tn_house_variants_at(variants, plan->trays, plan->length, rank, house, &error), TN_OK);
    mpz_set_ui(rank, 0);
    assert_int_equal(tn_house_variants_rank(variants, house, rank, &error), TN_OK);
    assert_int_equal(mpz_get_ui(rank), variant);
    mpz_clear(rank);
}

/* How many of all houses on the plan the clauses keep, each asked of each house; they come in the same order. */
static uint64_t count_one_by_one(tn_house_variants *all, tn_house_variants *some, const tn_plan *plan, uint64_t houses)
{
    tn_house_rules *rules;
    tn_error error = {0};
    uint64_t kept = 0;
    assert_int_equal(tn_house_rules_new(&made.form, 0, &rules, &error), TN_OK);
    for (uint64_t i = 0; i < houses; i++) {
        tn_house house;
        bool keep;
        take(all, plan, i, &house);
        assert_int_equal(tn_house_rules_start(rules, &house, &error), TN_OK);
        assert_int_equal(tn_house_rules_keep(rules, made.some, &keep, &error), TN_OK);
        if (keep) {
            mpz_t rank;
            mpz_init(rank);
            assert_int_equal(tn_house_variants_rank(some, &house, rank, &error), TN_OK);
            assert_int_equal(mpz_get_ui(rank), kept);
            mpz_clear(rank);
        }
        kept += keep;
        tn_house_clear(&house);
    }
    tn_house_rules_free(rules);
    return kept;
}

static void test_counts(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "8' room:10' empty", "10' room:12' open:4'", "8' room:10' empty | 8' room:10' empty",
        "8' room:12' open:4' | 10' room:10' empty", "10' room:10' empty | 10' room:10' empty"};
    tn_house_variants *all = variants_of(made.all, 0), *some = variants_of(made.some, 0);
    uint64_t in_all = 0, looked_at = 0;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        tn_plan plan = test_house_plan(&made, lines[i]);
        tn_house_counts counts, kept;
        uint64_t houses = count_of(all, &plan, &counts), wanted = count_of(some, &plan, &kept);
        in_all += houses < 6000 ? wanted : 0;
        looked_at += houses < 6000;
        if (houses < 6000)
            assert_int_equal(count_one_by_one(all, some, &plan, houses), wanted);
        else
            assert_true(wanted < houses);
        tn_house_counts_clear(&counts);
        tn_house_counts_clear(&kept);
        free(plan.trays);
    }
    assert_true(in_all > 15 && looked_at == 5);
    tn_house_variants_free(all);
    tn_house_variants_free(some);
}

/* A rank that no house has; too little work. */
static void test_limits(void **state)
{
    (void)state;
    tn_house_variants *variants = variants_of(made.some, 40);
    tn_plan plan = test_house_plan(&made, "8' room:10' empty | 8' room:10' empty");
    tn_house_counts counts;
    tn_error error = {0};
    tn_house_counts_init(&counts);
    assert_int_equal(tn_house_variants_count(variants, plan.trays, plan.length, &counts, &error), TN_LIMIT);
    assert_int_equal(error.code, E_VARIANTS);
    assert_non_null(strstr(error.help, "most of them ask `"));
    tn_house_counts_clear(&counts);
    tn_house_variants_free(variants);

    variants = variants_of(made.some, 0);
    uint64_t houses = count_of(variants, &plan, &counts);
    tn_house house;
    mpz_t rank;
    mpz_init_set_ui(rank, houses);
    assert_int_equal(tn_house_variants_at(variants, plan.trays, plan.length, rank, &house, &error), TN_INVALID);
    assert_int_equal(error.code, E_NO_VARIANT);
    mpz_clear(rank);
    tn_house_clear(&house);
    tn_house_counts_clear(&counts);
    tn_house_variants_free(variants);
    free(plan.trays);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_counts), cmocka_unit_test(test_limits)};
    test_house_make(&made);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    test_house_clear(&made);
    return failed;
}
