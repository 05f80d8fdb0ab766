/* Sets of combinations, against trying all combinations. */
#include "runtime/choices/choices.h"
#include "runtime/choices/sums.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_choices.h"
#include "tests/support/test_rule.h"

enum { SETS = 24, ROOM = 4096 };

/* Which combinations are in it, in order. */
typedef struct plain_set {
    bool in[TEST_COMBINATIONS];
} plain_set;

static uint32_t number_of(const uint8_t *values)
{
    uint32_t number = 0;
    for (uint32_t f = 0; f < TEST_FIELDS; f++)
        number = number * test_choice_counts[f] + values[f];
    return number;
}

static plain_set plain_box(uint64_t mask)
{
    plain_set set;
    uint8_t values[TEST_FIELDS];
    for (uint32_t n = 0; n < TEST_COMBINATIONS; n++) {
        test_choice_values(n, values);
        set.in[n] = test_choice_is_within(values, mask);
    }
    return set;
}

typedef struct seen {
    plain_set set;
    uint32_t count, last;
    bool twice, unordered;
} seen;

static bool see(void *context, const uint8_t *values)
{
    seen *s = context;
    uint32_t number = number_of(values);
    s->unordered |= s->count > 0 && number <= s->last;
    s->set.in[number] = true;
    s->last = number;
    s->count++;
    return true;
}

static bool see_box(void *context, const uint64_t *mask)
{
    seen *s = context;
    plain_set box = plain_box(*mask);
    for (uint32_t n = 0; n < TEST_COMBINATIONS; n++) {
        s->twice |= box.in[n] && s->set.in[n];
        s->set.in[n] |= box.in[n];
        s->count += box.in[n];
    }
    return true;
}

static void check(tn_choice_diagram *choices, tn_choice_set set, const plain_set *wanted)
{
    seen each = {0}, boxes = {0};
    uint8_t first[TEST_FIELDS];
    uint32_t count = 0, least = TEST_COMBINATIONS;
    for (uint32_t n = TEST_COMBINATIONS; n-- > 0;) {
        count += wanted->in[n];
        least = wanted->in[n] ? n : least;
    }
    assert_int_not_equal(set, TN_CHOICE_LOST);
    uint64_t counted;
    assert_true(tn_choices_count(choices, set, &counted));
    assert_int_equal(counted, count);
    assert_true(tn_choices_each(choices, set, see, &each));
    assert_true(tn_choices_boxes(choices, set, see_box, &boxes));
    assert_memory_equal(&each.set, wanted, sizeof *wanted);
    assert_memory_equal(&boxes.set, wanted, sizeof *wanted);
    assert_false(each.unordered);
    assert_false(boxes.twice);
    assert_int_equal(tn_choices_first(choices, set, first), count > 0);
    if (count > 0)
        assert_int_equal(number_of(first), least);
}

static void test_sets(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 40; seed++) {
        test_random random = {seed, 0};
        tn_choice_diagram *choices = tn_choices_new(test_choice_counts, TEST_FIELDS, TN_CHOICES_ROOM);
        assert_non_null(choices);
        tn_choice_set sets[SETS], copies[SETS], any;
        plain_set plain[SETS], all = {0};
        for (int i = 0; i < SETS; i++) {
            uint32_t a = i ? test_random_below(&random, (uint32_t)i) : 0,
                     b = i ? test_random_below(&random, (uint32_t)i) : 0;
            uint64_t mask =
                test_random_below(&random, 1u << TEST_CHOICE_BITS) | test_random_below(&random, 1u << TEST_CHOICE_BITS);
            int kind = i < 6 ? 0 : (int)test_random_below(&random, 4);
            sets[i] = kind == 0   ? tn_choices_box(choices, &mask)
                      : kind == 1 ? tn_choices_not(choices, sets[a])
                      : kind == 2 ? tn_choices_and(choices, sets[a], sets[b])
                                  : tn_choices_or(choices, sets[a], sets[b]);
            plain[i] = plain_box(mask);
            for (uint32_t n = 0; kind != 0 && n < TEST_COMBINATIONS; n++)
                plain[i].in[n] = kind == 1   ? !plain[a].in[n]
                                 : kind == 2 ? plain[a].in[n] && plain[b].in[n]
                                             : plain[a].in[n] || plain[b].in[n];
            check(choices, sets[i], &plain[i]);
            for (int k = 0; k < i; k++) /* equal sets are one */
                assert_int_equal(sets[k] == sets[i], memcmp(&plain[k], &plain[i], sizeof plain[i]) == 0);
        }
        for (int count = 0; count <= 5; count++) {
            memcpy(copies, sets, sizeof sets);
            any = tn_choices_any_of(choices, copies, (size_t)count);
            check(choices, any, &all);
            for (uint32_t n = 0; n < TEST_COMBINATIONS; n++)
                all.in[n] |= plain[count].in[n];
        }
        tn_choices_free(choices);
    }
}

/* Fields that have to be the same, the first with the last and so on: no small diagram in this order. */
static void test_room(void **state)
{
    (void)state;
    enum { PAIRS = 12 };
    uint32_t two[2 * PAIRS];
    for (int f = 0; f < 2 * PAIRS; f++)
        two[f] = 2;
    tn_choice_diagram *choices = tn_choices_new(two, 2 * PAIRS, ROOM);
    assert_non_null(choices);
    tn_choice_set same = TN_CHOICE_ALL;
    for (int f = 0; f < PAIRS; f++) {
        uint64_t all = (UINT64_C(1) << 4 * PAIRS) - 1, pair = UINT64_C(3) << 2 * f | UINT64_C(3) << 2 * (PAIRS + f);
        uint64_t no = (all & ~pair) | UINT64_C(1) << 2 * f | UINT64_C(1) << 2 * (PAIRS + f),
                 yes = (all & ~pair) | UINT64_C(2) << 2 * f | UINT64_C(2) << 2 * (PAIRS + f);
        same = tn_choices_and(choices, same,
                              tn_choices_or(choices, tn_choices_box(choices, &no), tn_choices_box(choices, &yes)));
    }
    assert_int_equal(same, TN_CHOICE_LOST);
    assert_true(tn_choices_full(choices));
    assert_int_equal(tn_choices_not(choices, same), TN_CHOICE_LOST);
    tn_choices_free(choices);
}

/* 64 fields of 255 values: more than can be counted. */
static void test_very_many(void **state)
{
    (void)state;
    uint32_t many[64];
    for (int f = 0; f < 64; f++)
        many[f] = 255;
    tn_choice_diagram *choices = tn_choices_new(many, 64, TN_CHOICES_ROOM);
    assert_non_null(choices);
    uint64_t count;
    assert_true(tn_choices_count(choices, TN_CHOICE_ALL, &count) && count == UINT64_MAX);
    assert_true(tn_choices_count(choices, TN_CHOICE_NONE, &count) && count == 0);
    tn_choices_free(choices);
}

/* ---- sums */

enum { TERMS = 4, TERM_VALUES = TEST_COMBINATIONS };

typedef struct drawn_term {
    uint32_t fields[TEST_FIELDS];
    mpz_t values[TERM_VALUES];
    uint8_t outcomes[TERM_VALUES];
    tn_choice_term term;
} drawn_term;

static void draw_term(test_random *random, drawn_term *t)
{
    *t = (drawn_term){.term = {.count = 1}};
    uint32_t chosen = test_random_below(random, 1u << TEST_FIELDS) & test_random_below(random, 1u << TEST_FIELDS);
    bool large = test_random_below(random, 4) == 0, holes = test_random_below(random, 5) == 0;
    for (uint32_t f = 0; f < TEST_FIELDS; f++)
        if (chosen >> f & 1) {
            t->fields[t->term.field_count++] = f;
            t->term.count *= test_choice_counts[f];
        }
    t->term.fields = t->fields;
    t->term.values = t->values;
    t->term.outcomes = t->outcomes;
    for (size_t i = 0; i < t->term.count; i++) {
        mpz_init_set_si(t->values[i], (long)test_random_below(random, 9) - 4);
        if (large)
            mpz_mul_2exp(t->values[i], t->values[i], 70);
        t->outcomes[i] = holes && test_random_below(random, 6) == 0 ? (uint8_t)(1 + test_random_below(random, 2)) : 0;
    }
}

/* What the combination's sum is: its sign, or 2 and 3 for the outcomes without a number. */
static int sum_of(const drawn_term *terms, const uint8_t *values)
{
    mpz_t sum;
    int outcome = 0;
    mpz_init(sum);
    for (int t = 0; t < TERMS; t++) {
        size_t place = 0;
        for (uint32_t i = 0; i < terms[t].term.field_count; i++)
            place = place * test_choice_counts[terms[t].fields[i]] + values[terms[t].fields[i]];
        mpz_add(sum, sum, terms[t].values[place]);
        outcome = outcome || terms[t].outcomes[place] == 0 ? outcome : 1 + terms[t].outcomes[place];
    }
    int sign = mpz_sgn(sum);
    mpz_clear(sum);
    return outcome ? outcome : sign;
}

/* Where terms of one combination differ in why they have no number, it is in neither set or in `no`. */
static bool is_mixed(const drawn_term *terms, const uint8_t *values)
{
    bool silent = false, undefined = false;
    for (int t = 0; t < TERMS; t++) {
        size_t place = 0;
        for (uint32_t i = 0; i < terms[t].term.field_count; i++)
            place = place * test_choice_counts[terms[t].fields[i]] + values[terms[t].fields[i]];
        silent |= terms[t].outcomes[place] == TN_CHOICE_SILENT;
        undefined |= terms[t].outcomes[place] == TN_CHOICE_UNDEFINED;
    }
    return silent && undefined;
}

static void check_sums(test_random *random, const drawn_term *drawn, unsigned signs)
{
    tn_choice_diagram *choices = tn_choices_new(test_choice_counts, TEST_FIELDS, TN_CHOICES_ROOM);
    assert_non_null(choices);
    tn_choice_term terms[TERMS];
    tn_choice_set sets[2];
    bool longer = true;
    for (int t = 0; t < TERMS; t++)
        terms[t] = drawn[t].term;
    tn_choices_by_sum(choices, terms, TERMS, signs, 1000, &sets[0], &sets[1], &longer);
    assert_false(longer);
    plain_set yes = {0}, no = {0};
    seen found[2] = {0};
    assert_true(tn_choices_each(choices, sets[0], see, &found[0]));
    assert_true(tn_choices_each(choices, sets[1], see, &found[1]));
    for (uint32_t n = 0; n < TEST_COMBINATIONS; n++) {
        uint8_t values[TEST_FIELDS];
        test_choice_values(n, values);
        int sum = sum_of(drawn, values);
        yes.in[n] = sum < 2 && signs & (sum < 0 ? TN_CHOICE_BELOW : sum > 0 ? TN_CHOICE_ABOVE : TN_CHOICE_ZERO);
        no.in[n] = is_mixed(drawn, values) ? found[1].set.in[n] : sum == 2 || (sum < 2 && !yes.in[n]);
    }
    check(choices, sets[0], &yes);
    check(choices, sets[1], &no);
    tn_choices_by_sum(choices, terms, TERMS, signs, test_random_below(random, 8), &sets[0], &sets[1], &longer);
    assert_true(!longer || sets[0] == TN_CHOICE_LOST);
    assert_int_equal(sets[0] == TN_CHOICE_LOST, longer);
    tn_choices_free(choices);
}

static void test_sums(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 400; seed++) {
        test_random random = {seed, 1};
        static drawn_term drawn[TERMS];
        for (int t = 0; t < TERMS; t++)
            draw_term(&random, &drawn[t]);
        for (unsigned signs = 0; signs < 8; signs++)
            check_sums(&random, drawn, signs);
        for (int t = 0; t < TERMS; t++)
            for (size_t i = 0; i < drawn[t].term.count; i++)
                mpz_clear(drawn[t].values[i]);
    }
}

/* Ten fields of ten digits each: few sums, and ten thousand million combinations. */
static void test_many_added(void **state)
{
    (void)state;
    enum { DIGITS = 10 };
    uint32_t ten[DIGITS], fields[DIGITS];
    mpz_t values[DIGITS], limit;
    uint8_t outcomes[DIGITS] = {0};
    tn_choice_term terms[DIGITS + 1];
    mpz_init_set_si(limit, -40);
    for (uint32_t f = 0; f < DIGITS; f++) {
        ten[f] = DIGITS;
        fields[f] = f;
        mpz_init_set_ui(values[f], f);
    }
    for (uint32_t f = 0; f < DIGITS; f++)
        terms[f] = (tn_choice_term){&fields[f], 1, values, outcomes, DIGITS};
    terms[DIGITS] = (tn_choice_term){NULL, 0, &limit, outcomes, 1};
    tn_choice_diagram *choices = tn_choices_new(ten, DIGITS, TN_CHOICES_ROOM);
    assert_non_null(choices);
    uint64_t ways[9 * DIGITS + 1] = {1}; /* in how many ways digits add up to that */
    for (int digit = 0; digit < DIGITS; digit++)
        for (int sum = 9 * DIGITS; sum >= 0; sum--)
            for (int last = 1; last < 10 && last <= sum; last++)
                ways[sum] += ways[sum - last];
    tn_choice_set yes, no;
    uint64_t count, others;
    bool longer;
    tn_choices_by_sum(choices, terms, DIGITS + 1, TN_CHOICE_ZERO, 1 << 14, &yes, &no, &longer);
    assert_false(longer);
    assert_true(tn_choices_count(choices, yes, &count) && tn_choices_count(choices, no, &others));
    assert_int_equal(count, ways[40]);
    assert_int_equal(count + others, 10000000000);
    tn_choices_free(choices);
    for (uint32_t f = 0; f < DIGITS; f++)
        mpz_clear(values[f]);
    mpz_clear(limit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sets), cmocka_unit_test(test_room),
                                       cmocka_unit_test(test_very_many), cmocka_unit_test(test_sums),
                                       cmocka_unit_test(test_many_added)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
