/* The houses on one plan: their number is that of those that all clauses keep when each is asked one by one; ranks and
 * houses are inverse; and too much work is an error that names a clause. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/house/count/listing.h"
#include "runtime/house/rule/change.h"
#include "tests/support/test_house.h"

static test_house made;

static tn_house_listing *variants_of(const tn_house_library_record *library, uint64_t work)
{
    tn_house_listing *variants;
    tn_error error = {0};
    assert_int_equal(tn_house_listing_new(&made.form, library, work, &variants, &error), TN_OK);
    return variants;
}

static uint64_t count_of(tn_house_listing *variants, const tn_plan *plan, tn_house_counts *counts)
{
    tn_error error = {0};
    tn_house_counts_init(counts);
    assert_int_equal(tn_house_listing_count(variants, plan->trays, plan->length, counts, &error), TN_OK);
    return mpz_get_ui(counts->houses);
}

/* The line of house `variant`; checks that its rank is `variant` again. */
static void take(tn_house_listing *variants, const tn_plan *plan, uint64_t variant, tn_house *house)
{
    tn_error error = {0};
    mpz_t rank;
    mpz_init_set_ui(rank, variant);
    assert_int_equal(tn_house_listing_at(variants, plan->trays, plan->length, rank, house, &error), TN_OK);
    mpz_set_ui(rank, 0);
    assert_int_equal(tn_house_listing_number(variants, house, rank, &error), TN_OK);
    assert_int_equal(mpz_get_ui(rank), variant);
    mpz_clear(rank);
}

typedef struct walk {
    tn_house_listing *variants; /* of their own, so that those that walk are left alone */
    const tn_plan *plan;
    uint64_t next, stop_at;
} walk;

static tn_status check_walked(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    walk *w = context;
    mpz_t rank;
    mpz_init(rank);
    assert_int_equal(tn_house_listing_number(w->variants, house, rank, error), TN_OK);
    assert_int_equal(mpz_get_ui(rank), w->next++);
    mpz_clear(rank);
    *stop = w->next == w->stop_at;
    return TN_OK;
}

/* Walks over the houses from a number on: none is left out, and the walk ends where it is told to. */
static void check_walk(tn_house_listing *walked, tn_house_listing *asked, const tn_plan *plan, uint64_t from,
                       uint64_t houses)
{
    tn_error error = {0};
    mpz_t first;
    walk w = {asked, plan, from, houses > from + 40 ? from + 40 : UINT64_MAX};
    mpz_init_set_ui(first, from);
    assert_int_equal(tn_house_listing_each(walked, plan->trays, plan->length, first, check_walked, &w, &error), TN_OK);
    assert_int_equal(w.next, w.stop_at == UINT64_MAX ? houses : w.stop_at);
    mpz_clear(first);
}

/* How many of all houses on the plan the clauses keep, each asked of each house; they come in the same order. */
static uint64_t count_one_by_one(tn_house_listing *all, tn_house_listing *some, const tn_plan *plan, uint64_t houses)
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
            assert_int_equal(tn_house_listing_number(some, &house, rank, &error), TN_OK);
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
    tn_house_listing *all = variants_of(made.all, 0), *some = variants_of(made.some, 0);
    uint64_t in_all = 0, looked_at = 0;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        tn_plan plan = test_house_plan(&made, lines[i]);
        tn_house_counts counts, kept;
        uint64_t houses = count_of(all, &plan, &counts), wanted = count_of(some, &plan, &kept);
        in_all += houses < 6000 ? wanted : 0;
        looked_at += houses < 6000;
        if (houses < 6000) {
            assert_int_equal(count_one_by_one(all, some, &plan, houses), wanted);
            tn_house_listing *asked = variants_of(made.some, 0);
            check_walk(some, asked, &plan, 0, wanted);
            check_walk(some, asked, &plan, wanted / 2, wanted);
            check_walk(some, asked, &plan, wanted, wanted);
            tn_house_listing_free(asked);
        } else
            assert_true(wanted < houses);
        tn_house_counts_clear(&counts);
        tn_house_counts_clear(&kept);
        free(plan.trays);
    }
    assert_true(in_all > 15 && looked_at == 5);
    tn_house_listing_free(all);
    tn_house_listing_free(some);
}

/* A rank that no house has; too little work. */
static void test_limits(void **state)
{
    (void)state;
    tn_house_listing *variants = variants_of(made.some, 40);
    tn_plan plan = test_house_plan(&made, "8' room:10' empty | 8' room:10' empty");
    tn_house_counts counts;
    tn_error error = {0};
    tn_house_counts_init(&counts);
    assert_int_equal(tn_house_listing_count(variants, plan.trays, plan.length, &counts, &error), TN_LIMIT);
    assert_int_equal(error.code, E_VARIANTS);
    assert_non_null(strstr(error.help, "most of them ask `"));
    tn_house_counts_clear(&counts);
    tn_house_listing_free(variants);

    variants = variants_of(made.some, 0);
    uint64_t houses = count_of(variants, &plan, &counts);
    tn_house house;
    mpz_t rank;
    mpz_init_set_ui(rank, houses);
    assert_int_equal(tn_house_listing_at(variants, plan.trays, plan.length, rank, &house, &error), TN_INVALID);
    assert_int_equal(error.code, E_NO_VARIANT);
    mpz_clear(rank);
    tn_house_clear(&house);
    tn_house_counts_clear(&counts);
    tn_house_listing_free(variants);
    free(plan.trays);
}

/* ---- changes */

/* Ranks that were listed. */
typedef struct listed {
    tn_house_listing *variants;
    bool of[6000];
    size_t count;
} listed;

static tn_status list(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    listed *l = context;
    mpz_t rank;
    (void)change;
    mpz_init(rank);
    tn_status status = tn_house_listing_number(l->variants, changed, rank, error);
    if (status == TN_OK) {
        assert_false(l->of[mpz_get_ui(rank)]); /* each once */
        l->of[mpz_get_ui(rank)] = true;
        l->count++;
    }
    mpz_clear(rank);
    return status;
}

static void tile_text(const tn_house *house, uint32_t cell, char text[TN_VARIANT_TEXT])
{
    tn_variants v;
    tn_error error;
    text[0] = '\0';
    assert_int_equal(tn_tile_variants(house, cell, &v, &error), TN_OK);
    if (house->cells[cell].variant < v.count)
        tn_variant_text(&made.form, &v.variants[house->cells[cell].variant], text);
    tn_variants_clear(&v);
}

/* In how many choices two houses on one plan differ; many, where their cells are not the same. */
static size_t differences(const tn_house *a, const tn_house *b)
{
    size_t count = 0;
    if (a->cell_count != b->cell_count || a->face_count != b->face_count)
        return 100;
    for (uint32_t i = 0; i < made.form.record->choice_count; i++)
        count += a->shapes[i] != b->shapes[i];
    for (uint32_t i = 0; i < a->cell_count; i++) {
        char one[TN_VARIANT_TEXT], other[TN_VARIANT_TEXT];
        tile_text(a, i, one);
        tile_text(b, i, other);
        count += a->cells[i].function != b->cells[i].function;
        count += strcmp(one, other) != 0;
    }
    for (size_t i = 0; i < a->face_count; i++)
        count += a->faces[i].kind != b->faces[i].kind;
    return count;
}

/* Every house that differs in one choice is listed, and each listed one is a house of the library. */
static void test_changes(void **state)
{
    (void)state;
    tn_house_listing *some = variants_of(made.some, 0);
    tn_plan plan = test_house_plan(&made, "8' room:12' open:4' | 10' room:10' empty");
    tn_house_rules *rules;
    tn_house_counts counts;
    tn_error error = {0};
    size_t found = 0, more = 0;
    uint64_t houses = count_of(some, &plan, &counts);
    assert_int_equal(tn_house_rules_new(&made.form, 0, &rules, &error), TN_OK);
    for (uint64_t i = 0; i < houses; i += 3) {
        tn_house house;
        listed l = {.variants = some};
        take(some, &plan, i, &house);
        assert_int_equal(tn_house_changes(&house, rules, made.some, TN_NO_CELL, list, &l, &error), TN_OK);
        assert_false(l.of[i]);
        for (uint64_t k = 0; k < houses; k++) {
            tn_house other;
            take(some, &plan, k, &other);
            bool near = differences(&house, &other) == 1;
            assert_true(!near || l.of[k]);
            found += near;
            tn_house_clear(&other);
        }
        more += l.count;
        tn_house_clear(&house);
    }
    assert_true(found > 5 && more >= found);
    tn_house_rules_free(rules);
    tn_house_counts_clear(&counts);
    tn_house_listing_free(some);
    free(plan.trays);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_counts), cmocka_unit_test(test_limits),
                                       cmocka_unit_test(test_changes)};
    test_house_make(&made);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    test_house_clear(&made);
    return failed;
}
