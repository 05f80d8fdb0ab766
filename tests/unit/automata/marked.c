/* Relations over stretches, by letters alone: what they hold of every short word is found again by looking at it, and
 * words are counted as often as their letters have symbols. All of it for words of any length, and again for short ones
 * only. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "runtime/automata/count.h"
#include "runtime/automata/equations.h"
#include "runtime/automata/marked.h"

enum { LETTERS = 3, LONGEST = 6 };

typedef struct letters {
    tn_bounds bounds;
    tn_marked marked;
    tn_dfa *chosen; /* stretches of one letter 1 or 2 */
} letters;

static int setup(void **state)
{
    static letters l;
    static const uint8_t chosen[LETTERS] = {0, 1, 1};
    l.bounds = tn_bounds_make(10000);
    assert_int_equal(tn_marked_make(&l.marked, LETTERS, &l.bounds, NULL), TN_OK);
    assert_int_equal(tn_marked_letter(&l.marked, chosen, &l.chosen, NULL), TN_OK);
    *state = &l;
    return 0;
}

/* Automata may be wrong of longer words. */
static int setup_short(void **state)
{
    setup(state);
    letters *l = *state;
    l->bounds.longest = LONGEST;
    l->bounds.letters = LETTERS;
    return 0;
}

static int teardown(void **state)
{
    letters *l = *state;
    tn_dfa_free(l->chosen);
    tn_marked_clear(&l->marked);
    return 0;
}

/* The words whose whole stretch is in the relation, which is given up. */
static tn_dfa *whole(letters *l, tn_dfa *relation)
{
    tn_dfa *words;
    assert_int_equal(tn_marked_whole(&l->marked, relation, &words, NULL), TN_OK);
    assert_int_equal(words->letters, LETTERS);
    tn_dfa_free(relation);
    return words;
}

/* Compares an automaton with a predicate on all short words; gives the automaton up. */
static void compare(tn_dfa *words, bool (*wanted)(const uint8_t *word, size_t size))
{
    size_t all = 1, held = 0;
    for (size_t size = 0; size <= LONGEST; size++, all *= LETTERS)
        for (size_t number = 0; number < all; number++) {
            uint8_t word[LONGEST];
            uint32_t at = 0;
            for (size_t i = 0, rest = number; i < size; i++, rest /= LETTERS) {
                word[i] = (uint8_t)(rest % LETTERS);
                at = tn_dfa_read(words, at, word[i]);
            }
            assert_int_equal(words->accept[at], wanted(word, size));
            held += words->accept[at];
        }
    assert_true(held > 0);
    tn_dfa_free(words);
}

/* Letters 0 count 2, letters 1 count 3, letters 2 count 5: is their sum over chosen letters 3, 8, 13, ...? */
static const uint64_t counts[LETTERS] = {2, 3, 5};

static bool sums(const uint8_t *word, size_t size)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < size; i++)
        sum += word[i] > 0 ? counts[word[i]] : 0;
    return sum % 5 == 3;
}

static void test_letters_count_what_they_are_said_to(void **state)
{
    letters *l = *state;
    static const uint8_t holds[] = {0, 0, 0, 1, 0};
    tn_periodic_set set = {.threshold = 0, .period = 5, .holds = holds};
    tn_dfa *relation;
    assert_int_equal(tn_marked_count(&l->marked, l->chosen, TN_TALLY_SINGLES, &set, counts, &relation, NULL), TN_OK);
    compare(whole(l, relation), sums);
}

static bool at_least_two(const uint8_t *word, size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < size; i++)
        count += word[i] > 0;
    return count >= 2;
}

static void test_each_letter_counts_one(void **state)
{
    letters *l = *state;
    static const uint8_t holds[] = {0, 0, 1};
    tn_periodic_set set = {.threshold = 2, .period = 1, .holds = holds};
    tn_dfa *relation;
    assert_int_equal(tn_marked_count(&l->marked, l->chosen, TN_TALLY_SINGLES, &set, NULL, &relation, NULL), TN_OK);
    compare(whole(l, relation), at_least_two);
}

static bool pair(const uint8_t *word, size_t size)
{
    return size == 2 && word[0] > 0 && word[1] > 0;
}

static bool has_pair(const uint8_t *word, size_t size)
{
    for (size_t i = 0; i + 2 <= size; i++)
        if (pair(word + i, 2))
            return true;
    return false;
}

static void test_stretches_follow_and_are_found(void **state)
{
    letters *l = *state;
    tn_dfa *chain, *anywhere;
    assert_int_equal(tn_marked_chain(&l->marked, l->chosen, l->chosen, &chain, NULL), TN_OK);
    assert_int_equal(tn_marked_anywhere(&l->marked, chain, &anywhere, NULL), TN_OK);
    compare(anywhere, has_pair);
    compare(whole(l, chain), pair);
}

/* Of LONGEST symbols, those with a pair: by the predicate, each word as often as its letters have symbols. */
static void test_words_are_counted_by_their_symbols(void **state)
{
    letters *l = *state;
    static const uint32_t sizes[LETTERS] = {7, 1, 4};
    uint64_t wanted = 0;
    for (size_t number = 0; number < 729; number++) {
        uint8_t word[LONGEST];
        uint64_t times = 1;
        for (size_t i = 0, rest = number; i < LONGEST; i++, rest /= LETTERS) {
            word[i] = (uint8_t)(rest % LETTERS);
            times *= sizes[word[i]];
        }
        wanted += has_pair(word, LONGEST) ? times : 0;
    }
    tn_dfa *chain, *anywhere;
    tn_sparse *sparse;
    mpz_t count;
    mpz_init(count);
    assert_int_equal(tn_marked_chain(&l->marked, l->chosen, l->chosen, &chain, NULL), TN_OK);
    assert_int_equal(tn_marked_anywhere(&l->marked, chain, &anywhere, NULL), TN_OK);
    assert_int_equal(tn_sparse_make(anywhere, 0, &sparse, NULL), TN_OK);
    assert_int_equal(tn_count_range(sparse, sizes, LONGEST, LONGEST, count, NULL, NULL), TN_OK);
    assert_int_equal(mpz_get_ui(count), wanted);
    mpz_clear(count);
    tn_sparse_free(sparse);
    tn_dfa_free(anywhere);
    tn_dfa_free(chain);
}

/* Cut into two or three stretches, each some letters 0 and then one that is chosen. */
static bool twice_or_thrice(const uint8_t *word, size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < size; i++)
        count += word[i] > 0;
    return size > 0 && word[size - 1] > 0 && count >= 2 && count <= 3;
}

static bool twice_or_more(const uint8_t *word, size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < size; i++)
        count += word[i] > 0;
    return size > 0 && word[size - 1] > 0 && count >= 2;
}

/* A stretch that ends with a chosen letter and has no other one. */
static tn_dfa *up_to_chosen(letters *l)
{
    static const uint8_t others[LETTERS] = {1, 0, 0};
    tn_dfa *other, *before, *maybe, *all;
    assert_int_equal(tn_marked_letter(&l->marked, others, &other, NULL), TN_OK);
    assert_int_equal(tn_marked_repeat(&l->marked, other, 1, 0, &before, NULL), TN_OK);
    assert_int_equal(tn_dfa_product(before, l->marked.empty, TN_DFA_OR, "test", &l->bounds, &maybe, NULL), TN_OK);
    assert_int_equal(tn_marked_chain(&l->marked, maybe, l->chosen, &all, NULL), TN_OK);
    tn_dfa_free(other);
    tn_dfa_free(before);
    tn_dfa_free(maybe);
    return all;
}

static void test_stretches_are_repeated(void **state)
{
    letters *l = *state;
    tn_dfa *each = up_to_chosen(l), *repeated;
    assert_int_equal(tn_marked_repeat(&l->marked, each, 2, 3, &repeated, NULL), TN_OK);
    compare(whole(l, repeated), twice_or_thrice);
    assert_int_equal(tn_marked_repeat(&l->marked, each, 2, 0, &repeated, NULL), TN_OK);
    compare(whole(l, repeated), twice_or_more);
    tn_dfa_free(each);
}

/* Any number of letters 0, and then some that are chosen: X = a X or Y, Y = b Y or b. */
static bool ones_then_others(const uint8_t *word, size_t size)
{
    size_t i = 0;
    while (i < size && word[i] == 0)
        i++;
    size_t others = 0;
    while (i < size && word[i] > 0) {
        i++;
        others++;
    }
    return i == size && others > 0;
}

static void test_linear_equations_are_solved(void **state)
{
    letters *l = *state;
    static const uint8_t zero[LETTERS] = {1, 0, 0};
    tn_dfa *a, *found[2];
    assert_int_equal(tn_marked_letter(&l->marked, zero, &a, NULL), TN_OK);
    for (int left = 0; left < 2; left++) { /* left-linear: X = X b or Y b, Y = Y a or a, or b alone */
        tn_linear sides[2] = {{0}}, other = {0};
        for (uint32_t i = 0; i < 2; i++) {
            assert_int_equal(tn_linear_make(&l->marked, 2, i, &sides[i], NULL), TN_OK);
            assert_int_equal(tn_linear_chain(&l->marked, &sides[i], (i == 0) == !left ? a : l->chosen, !left, NULL),
                             TN_OK);
        }
        assert_int_equal(tn_linear_make(&l->marked, 2, 1, &other, NULL), TN_OK);
        if (left)
            assert_int_equal(tn_linear_chain(&l->marked, &other, l->chosen, false, NULL), TN_OK);
        assert_int_equal(tn_linear_or(&l->marked, &sides[0], &other, NULL), TN_OK);
        sides[1].rest = tn_dfa_share(left ? a : l->chosen);
        if (left)
            sides[0].rest = tn_dfa_share(l->chosen);
        assert_true(tn_linear_has_unknowns(&sides[0]));
        assert_int_equal(tn_linear_solve(&l->marked, sides, 2, left, found, NULL), TN_OK);
        compare(whole(l, found[0]), ones_then_others);
        tn_dfa_free(found[1]);
        tn_linear_clear(&sides[0]);
        tn_linear_clear(&sides[1]);
        tn_linear_clear(&other);
    }
    tn_dfa_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_letters_count_what_they_are_said_to),
                                       cmocka_unit_test(test_each_letter_counts_one),
                                       cmocka_unit_test(test_stretches_follow_and_are_found),
                                       cmocka_unit_test(test_stretches_are_repeated),
                                       cmocka_unit_test(test_linear_equations_are_solved),
                                       cmocka_unit_test(test_words_are_counted_by_their_symbols)};
    int failed = cmocka_run_group_tests_name("any length", tests, setup, teardown);
    return failed + cmocka_run_group_tests_name("short words", tests, setup_short, teardown);
}
