/* Labels of combinations, against tables of all combinations. */
#include "runtime/choices/labelling.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_choices.h"
#include "tests/support/test_rule.h"

enum { ROUNDS = 200, TESTS = 6 };

/* What the definition says: of each combination its label, or TN_UNLABELLED. */
typedef struct table {
    uint32_t label[TEST_COMBINATIONS];
} table;

static uint64_t random_mask(test_random *random)
{
    uint64_t all = (UINT64_C(1) << TEST_CHOICE_BITS) - 1;
    return (test_random_next(random) | test_random_next(random)) & all;
}

/* Numbers the labels of a table by their first combinations. */
static uint32_t number_labels(table *t)
{
    uint32_t of[TEST_COMBINATIONS * 64], made = 0;
    memset(of, 0xff, sizeof of);
    for (uint32_t c = 0; c < TEST_COMBINATIONS; c++) {
        if (t->label[c] == TN_UNLABELLED)
            continue;
        uint32_t *label = &of[t->label[c]];
        if (*label == TN_UNLABELLED)
            *label = made++;
        t->label[c] = *label;
    }
    return made;
}

/* Combinations that few random boxes leave. */
static tn_labelling *random_set(test_random *random, table *t)
{
    tn_choice_diagram *choices = tn_choices_new(test_choice_counts, TEST_FIELDS, TN_CHOICES_ROOM);
    tn_choice_set set = TN_CHOICE_ALL;
    tn_labelling *made;
    for (uint32_t c = 0; c < TEST_COMBINATIONS; c++)
        t->label[c] = 0;
    for (uint32_t i = test_random_below(random, TESTS); i-- > 0;) {
        uint64_t mask = random_mask(random);
        set = tn_choices_and(choices, set, tn_choices_not(choices, tn_choices_box(choices, &mask)));
        for (uint32_t c = 0; c < TEST_COMBINATIONS; c++) {
            uint8_t values[TEST_FIELDS];
            test_choice_values(c, values);
            if (test_choice_is_within(values, mask))
                t->label[c] = TN_UNLABELLED;
        }
    }
    assert_int_equal(tn_labelling_of_set(choices, set, &made), TN_OK);
    tn_choices_free(choices);
    return made;
}

/* Splits by a box or by a field, or keeps some of a field's values together. */
static tn_labelling *split(test_random *random, tn_labelling *before, table *t)
{
    tn_labelling *test, *made;
    uint64_t mask = random_mask(random);
    uint32_t field = test_random_below(random, TEST_FIELDS), letters[8], kinds[8];
    bool box = test_random_below(random, 2), joined = test_random_below(random, 2);
    for (uint32_t i = 0; i < 8; i++) {
        letters[i] = i < test_choice_counts[field] ? test_random_below(random, test_choice_counts[field]) : 0;
        kinds[i] = test_random_below(random, 3);
    }
    assert_int_equal(box ? tn_labelling_of_box(test_choice_counts, TEST_FIELDS, &mask, &test)
                         : tn_labelling_of_field(test_choice_counts, TEST_FIELDS, field, letters, &test),
                     TN_OK);
    assert_int_equal(tn_labelling_join(before, test, joined ? kinds : NULL, &made), TN_OK);
    for (uint32_t c = 0; c < TEST_COMBINATIONS; c++) {
        uint8_t values[TEST_FIELDS];
        test_choice_values(c, values);
        uint32_t letter = box ? test_choice_is_within(values, mask) : letters[values[field]];
        if (t->label[c] != TN_UNLABELLED)
            t->label[c] = t->label[c] * 8 + (joined ? kinds[letter] : letter);
    }
    tn_labelling_free(test);
    tn_labelling_free(before);
    return made;
}

/* Passes so many combinations of a label, and all others. */
typedef struct passing {
    uint32_t label, left;
} passing;

static bool pass(void *context, const tn_label_count *below, size_t count)
{
    passing *p = context;
    for (size_t i = 0; i < count; i++) {
        if (below[i].label != p->label)
            continue;
        if (below[i].count > p->left)
            return false;
        p->left -= below[i].count;
    }
    return true;
}

/* Counts the combinations of each label. */
static void add(void *context, const tn_label_count *below, size_t count)
{
    uint32_t *passed = context;
    for (size_t i = 0; i < count; i++)
        passed[below[i].label] += below[i].count;
}

static bool is_label(void *context, uint32_t label)
{
    return label % 3 == *(const uint32_t *)context;
}

static void check(const tn_labelling *l, const table *t, uint32_t labels)
{
    uint32_t number = 0, before[TEST_COMBINATIONS] = {0}, passed[TEST_COMBINATIONS], next[3];
    assert_int_equal(l->labels, labels);
    for (uint32_t c = 0; c < TEST_COMBINATIONS; c++) {
        uint8_t values[TEST_FIELDS], found[TEST_FIELDS];
        test_choice_values(c, values);
        if (t->label[c] == TN_UNLABELLED) {
            assert_int_equal(tn_labelling_number(l, values), TN_UNLABELLED);
            continue;
        }
        assert_int_equal(tn_labelling_number(l, values), number);
        assert_int_equal(tn_labelling_at(l, number, found), t->label[c]);
        assert_memory_equal(found, values, TEST_FIELDS);
        if (before[t->label[c]] == 0)
            assert_int_equal(l->first[t->label[c]], number);
        memset(passed, 0, sizeof passed);
        tn_labelling_before(l, number, add, passed);
        passing p = {t->label[c], before[t->label[c]]};
        assert_int_equal(tn_labelling_find(l, pass, &p), number);
        assert_int_equal(p.left, 0);
        assert_memory_equal(passed, before, sizeof passed);
        before[t->label[c]]++;
        number++;
    }
    assert_int_equal(l->count, number);
    passing all = {0, UINT32_MAX};
    assert_int_equal(tn_labelling_find(l, pass, &all), number);
    tn_labelling_before(l, number, add, memset(passed, 0, sizeof passed));
    assert_memory_equal(passed, before, sizeof passed);
    for (uint32_t k = 0; k < labels; k++)
        assert_int_equal(tn_labelling_size(l, k), before[k]);
    for (uint32_t k = 0; k < 3; k++)
        next[k] = number;
    for (uint32_t c = TEST_COMBINATIONS, n = number; c-- > 0;) {
        if (t->label[c] == TN_UNLABELLED)
            continue;
        next[t->label[c] % 3] = --n;
        for (uint32_t k = 0; k < 3; k++)
            assert_int_equal(tn_labelling_next(l, n, is_label, &k), next[k]);
    }
}

static void test_against_tables(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= ROUNDS; seed++) {
        test_random random = {.seed = seed};
        table t;
        tn_labelling *made = random_set(&random, &t);
        check(made, &t, number_labels(&t));
        for (uint32_t i = test_random_below(&random, TESTS); i-- > 0;) {
            made = split(&random, made, &t);
            check(made, &t, number_labels(&t));
        }
        tn_labelling_free(made);
    }
}

/* 2^31 combinations in a handful of nodes; 2^33 are too many to be numbered. */
static void test_many(void **state)
{
    (void)state;
    uint32_t flags[33];
    for (uint32_t f = 0; f < 33; f++)
        flags[f] = 2;
    tn_choice_diagram *choices = tn_choices_new(flags, 31, TN_CHOICES_ROOM);
    tn_labelling *made;
    uint8_t values[33];
    assert_int_equal(tn_labelling_of_set(choices, TN_CHOICE_ALL, &made), TN_OK);
    assert_int_equal(made->nodes.count, 31);
    assert_int_equal(made->count, UINT32_C(1) << 31);
    assert_int_equal(tn_labelling_at(made, (UINT32_C(1) << 31) - 2, values), 0);
    assert_int_equal(values[0], 1);
    assert_int_equal(values[30], 0);
    tn_labelling_free(made);
    tn_choices_free(choices);
    choices = tn_choices_new(flags, 33, TN_CHOICES_ROOM);
    assert_int_equal(tn_labelling_of_set(choices, TN_CHOICE_ALL, &made), TN_LIMIT);
    assert_null(made);
    tn_choices_free(choices);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_tables), cmocka_unit_test(test_many)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
