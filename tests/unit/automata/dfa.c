/* Automata: minimising, products, complements and keys, against running words through random automata. */
#include "runtime/automata/dfa.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/automata/half.h"
#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"
#include "tests/support/test_rule.h"

/* A random automaton, most often with unreachable states, equal states and equal columns. */
static tn_dfa *random_dfa(test_random *random, uint32_t letters, uint32_t states)
{
    uint32_t columns = 1 + test_random_below(random, letters);
    uint32_t distinct = 1 + test_random_below(random, states);
    tn_dfa *dfa = tn_dfa_new(letters, columns, states);
    assert_non_null(dfa);
    for (uint32_t l = 0; l < letters; l++)
        dfa->column[l] = test_random_below(random, columns);
    for (uint32_t s = 0; s < states; s++) {
        uint32_t like = s < distinct ? s : test_random_below(random, distinct);
        dfa->accept[s] = s < distinct ? test_random_below(random, 3) == 0 : dfa->accept[like];
        for (uint32_t c = 0; c < columns; c++)
            dfa->delta[s * columns + c] =
                s < distinct ? test_random_below(random, states) : dfa->delta[like * columns + c];
    }
    return dfa;
}

static bool accepts(const tn_dfa *dfa, uint32_t state, const uint32_t *word, uint32_t length)
{
    for (uint32_t i = 0; i < length; i++)
        state = tn_dfa_read(dfa, state, word[i]);
    return dfa->accept[state];
}

/* Number of classes of reachable states, by comparing pairs until nothing changes (Moore). */
static uint32_t count_distinct(const tn_dfa *dfa)
{
    uint32_t n = dfa->states, found = 1, order[64] = {0};
    bool seen[64] = {true}, differ[64][64] = {{false}};
    assert_true(n <= 64);
    for (uint32_t i = 0; i < found; i++)
        for (uint32_t l = 0; l < dfa->letters; l++) {
            uint32_t to = tn_dfa_read(dfa, order[i], l);
            if (!seen[to])
                order[found++] = to;
            seen[to] = true;
        }
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t p = 0; p < n; p++)
            for (uint32_t q = 0; q < n; q++) {
                bool now = dfa->accept[p] != dfa->accept[q];
                for (uint32_t l = 0; l < dfa->letters; l++)
                    now |= differ[tn_dfa_read(dfa, p, l)][tn_dfa_read(dfa, q, l)];
                changed |= now && !differ[p][q];
                differ[p][q] |= now;
            }
    }
    uint32_t classes = 0;
    for (uint32_t i = 0; i < found; i++) {
        uint32_t j = 0;
        while (j < i && differ[order[i]][order[j]])
            j++;
        classes += j == i;
    }
    return classes;
}

static tn_dfa *minimise(const tn_dfa *dfa)
{
    tn_dfa *out = NULL;
    tn_error error;
    test_ok(tn_dfa_minimise(dfa, 0, &out, &error), &error);
    return out;
}

static tn_dfa *product(const tn_dfa *a, const tn_dfa *b, tn_dfa_operation operation)
{
    tn_bounds bounds = tn_bounds_make(1000);
    tn_dfa *out = NULL;
    tn_error error;
    test_ok(tn_dfa_product(a, b, operation, "test", &bounds, &out, &error), &error);
    return out;
}

static tn_dfa *complement(const tn_dfa *dfa)
{
    tn_dfa *out = NULL;
    tn_error error;
    test_ok(tn_dfa_complement(dfa, &out, &error), &error);
    return out;
}

/* Equal columns or unused ones would not be canonical. */
static void check_columns(const tn_dfa *dfa)
{
    uint32_t next = 0;
    for (uint32_t l = 0; l < dfa->letters; l++) {
        assert_true(dfa->column[l] <= next);
        next += dfa->column[l] == next;
    }
    assert_int_equal(next, dfa->columns);
    for (uint32_t a = 0; a < dfa->columns; a++)
        for (uint32_t b = 0; b < a; b++) {
            uint32_t s = 0;
            while (s < dfa->states && dfa->delta[s * dfa->columns + a] == dfa->delta[s * dfa->columns + b])
                s++;
            assert_true(s < dfa->states);
        }
}

static void minimising_is_exact_and_canonical(void **state)
{
    (void)state;
    test_random random = {.seed = 11};
    for (int round = 0; round < 2000; round++) {
        uint32_t letters = 1 + test_random_below(&random, 5);
        tn_dfa *dfa = random_dfa(&random, letters, 1 + test_random_below(&random, 24));
        tn_dfa *small = minimise(dfa), *again = minimise(small);
        assert_int_equal(small->states, count_distinct(dfa));
        check_columns(small);
        assert_true(tn_dfa_equal(small, again));
        for (int w = 0; w < 20; w++) {
            uint32_t word[12];
            uint32_t length = test_random_below(&random, 12);
            for (uint32_t i = 0; i < length; i++)
                word[i] = test_random_below(&random, letters);
            assert_int_equal(accepts(dfa, 0, word, length), accepts(small, 0, word, length));
        }
        tn_dfa_free(dfa);
        tn_dfa_free(small);
        tn_dfa_free(again);
    }
}

static void products_decide_as_their_operands(void **state)
{
    (void)state;
    test_random random = {.seed = 12};
    for (int round = 0; round < 400; round++) {
        uint32_t letters = 1 + test_random_below(&random, 5);
        tn_dfa *raw[2], *d[2], *out[3];
        for (int i = 0; i < 2; i++) {
            raw[i] = random_dfa(&random, letters, 1 + test_random_below(&random, 12));
            d[i] = minimise(raw[i]);
        }
        for (int o = 0; o < 3; o++)
            out[o] = product(d[0], d[1], (tn_dfa_operation)o);
        for (int w = 0; w < 40; w++) {
            uint32_t word[16], length = test_random_below(&random, 16);
            for (uint32_t i = 0; i < length; i++)
                word[i] = test_random_below(&random, letters);
            bool a = accepts(d[0], 0, word, length), b = accepts(d[1], 0, word, length);
            assert_int_equal(accepts(out[TN_DFA_AND], 0, word, length), a && b);
            assert_int_equal(accepts(out[TN_DFA_OR], 0, word, length), a || b);
            assert_int_equal(accepts(out[TN_DFA_MINUS], 0, word, length), a && !b);
        }
        for (int i = 0; i < 2; i++) {
            tn_dfa_free(raw[i]);
            tn_dfa_free(d[i]);
        }
        for (int o = 0; o < 3; o++)
            tn_dfa_free(out[o]);
    }
}

/* not (a and b) = not a or not b; a minus b = a and not b; not not a = a: the same arrays, since all is canonical. */
static void de_morgan(void **state)
{
    (void)state;
    test_random random = {.seed = 13};
    for (int round = 0; round < 300; round++) {
        uint32_t letters = 1 + test_random_below(&random, 5);
        tn_dfa *raw_a = random_dfa(&random, letters, 10), *raw_b = random_dfa(&random, letters, 10);
        tn_dfa *a = minimise(raw_a), *b = minimise(raw_b);
        tn_dfa *not_a = complement(a), *not_b = complement(b), *not_not_a = complement(not_a);
        tn_dfa *both = product(a, b, TN_DFA_AND), *not_both = complement(both);
        tn_dfa *either = product(not_a, not_b, TN_DFA_OR);
        tn_dfa *minus = product(a, b, TN_DFA_MINUS), *and_not = product(a, not_b, TN_DFA_AND);
        assert_true(tn_dfa_equal(not_both, either));
        assert_true(tn_dfa_equal(minus, and_not));
        assert_true(tn_dfa_equal(a, not_not_a));
        tn_dfa *all[] = {raw_a, raw_b, a, b, not_a, not_b, not_not_a, both, not_both, either, minus, and_not};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++)
            tn_dfa_free(all[i]);
    }
}

/* Products without dead states are the same automata in the end. */
static void sparse_products_are_the_same(void **state)
{
    (void)state;
    test_random random = {.seed = 15};
    for (int round = 0; round < 500; round++) {
        uint32_t letters = 1 + test_random_below(&random, 6);
        tn_dfa *raw_a = random_dfa(&random, letters, 1 + test_random_below(&random, 14));
        tn_dfa *raw_b = random_dfa(&random, letters, 1 + test_random_below(&random, 14)), *b = minimise(raw_b);
        tn_dfa_operation operation = round % 2 ? TN_DFA_AND : TN_DFA_MINUS;
        tn_sparse *a = NULL, *both = NULL, *small = NULL;
        tn_bounds bounds = tn_bounds_make(1000);
        tn_dfa *made = NULL, *expected = product(raw_a, b, operation);
        tn_error error;
        test_ok(tn_sparse_make(raw_a, 0, &a, &error), &error);
        test_ok(tn_sparse_product(a, b, operation, "test", &bounds, &both, &error), &error);
        test_ok(tn_sparse_minimise(both, &small, &error), &error);
        test_ok(tn_sparse_complete(small, &made, &error), &error);
        assert_true(tn_dfa_equal(made, expected));
        assert_in_range(expected->states, small->states, small->states + 1);
        tn_sparse_free(a);
        tn_sparse_free(both);
        tn_sparse_free(small);
        tn_dfa *all[] = {raw_a, raw_b, b, made, expected};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++)
            tn_dfa_free(all[i]);
    }
}

/* The half of a palindrome decides what the palindrome does. */
static void halves_decide_palindromes(void **state)
{
    (void)state;
    test_random random = {.seed = 16};
    for (int round = 0; round < 300; round++) {
        uint32_t letters = 1 + test_random_below(&random, 4);
        tn_dfa *raw = random_dfa(&random, letters, 1 + test_random_below(&random, 7)), *dfa = minimise(raw), *half[2];
        for (int odd = 0; odd < 2; odd++) {
            tn_bounds bounds = tn_bounds_make(20000);
            tn_error error;
            test_ok(tn_half(dfa, odd, &bounds, &half[odd], &error), &error);
        }
        for (int w = 0; w < 40; w++) {
            uint32_t word[20], length = test_random_below(&random, 10);
            for (uint32_t i = 0; i < length; i++)
                word[i] = test_random_below(&random, letters);
            for (uint32_t i = 0; i < length; i++)
                word[length + i] = word[length - 1 - i];
            assert_int_equal(accepts(half[0], 0, word, length), accepts(dfa, 0, word, 2 * length));
            for (uint32_t i = 0; i + 1 < length; i++)
                word[length + i] = word[length - 2 - i];
            bool whole = length > 0 && accepts(dfa, 0, word, 2 * length - 1);
            assert_int_equal(accepts(half[1], 0, word, length), whole);
        }
        tn_dfa *all[] = {raw, dfa, half[0], half[1]};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++)
            tn_dfa_free(all[i]);
    }
}

static void products_stop_at_their_bounds(void **state)
{
    (void)state;
    test_random random = {.seed = 14};
    tn_dfa *a = random_dfa(&random, 3, 40), *b = random_dfa(&random, 3, 40);
    tn_dfa *out = NULL;
    tn_error error;
    tn_bounds few = tn_bounds_make(3);
    assert_int_equal(tn_dfa_product(a, b, TN_DFA_AND, "and", &few, &out, &error), TN_LIMIT);
    assert_int_equal(error.code, 802);
    assert_null(out);
    tn_bounds quick = tn_bounds_make(10000);
    quick.max_work = 5;
    assert_int_equal(tn_dfa_product(a, b, TN_DFA_AND, "and", &quick, &out, &error), TN_LIMIT);
    tn_bounds narrow = tn_bounds_make(10000);
    narrow.max_transitions = 5;
    assert_int_equal(tn_dfa_product(a, b, TN_DFA_AND, "and", &narrow, &out, &error), TN_LIMIT);
    tn_dfa_free(a);
    tn_dfa_free(b);
}

/* The letters of the shortest word to each state: UINT32_MAX, none. */
static void find_levels(const tn_dfa *dfa, uint32_t *level)
{
    for (uint32_t s = 0; s < dfa->states; s++)
        level[s] = s == 0 ? 0 : UINT32_MAX;
    for (uint32_t letters = 0; letters < dfa->states; letters++)
        for (uint32_t s = 0; s < dfa->states; s++)
            for (uint32_t l = 0; level[s] == letters && l < dfa->letters; l++) {
                uint32_t *to = &level[tn_dfa_read(dfa, s, l)];
                *to = *to < letters + 1 ? *to : letters + 1;
            }
}

/* Does some word of at most so many letters lead from one state to acceptance, and from the other not? */
static bool told_apart(const tn_dfa *a, uint32_t p, const tn_dfa *b, uint32_t q, uint32_t letters)
{
    if (a->accept[p] != b->accept[q])
        return true;
    bool apart = false;
    for (uint32_t l = 0; letters > 0 && !apart && l < a->letters; l++)
        apart = told_apart(a, tn_dfa_read(a, p, l), b, tn_dfa_read(b, q, l), letters - 1);
    return apart;
}

/* Of two states that short words lead to, some short word tells apart what follows. The state that accepts nothing is
 * one more. */
static void check_dissimilar(const tn_dfa *dfa, uint32_t longest)
{
    uint32_t level[64];
    assert_true(dfa->states <= 64);
    find_levels(dfa, level);
    uint32_t nothing = tn_dfa_sink(dfa, 0);
    for (uint32_t p = 0; p < dfa->states; p++)
        for (uint32_t q = 0; q < p; q++) {
            uint32_t most = level[p] > level[q] ? level[p] : level[q];
            if (most <= longest && p != nothing && q != nothing)
                assert_true(told_apart(dfa, p, dfa, q, longest - most));
        }
}

static void covers_are_right_of_short_words(void **state)
{
    (void)state;
    test_random random = {.seed = 19};
    uint32_t fewer = 0;
    for (int round = 0; round < 1500; round++) {
        uint32_t letters = 1 + test_random_below(&random, 3), longest = 1 + test_random_below(&random, 5);
        tn_bounds bounds = tn_bounds_make(1000);
        bounds.longest = longest;
        bounds.letters = letters;
        tn_dfa *raw[2], *d[2], *cover, *both;
        for (int i = 0; i < 2; i++) {
            raw[i] = random_dfa(&random, letters, 1 + test_random_below(&random, 20));
            d[i] = minimise(raw[i]);
        }
        assert_int_equal(tn_cover_minimise(raw[0], &bounds, &cover, NULL), TN_OK);
        assert_false(told_apart(cover, 0, raw[0], 0, longest));
        assert_true(cover->states <= d[0]->states);
        check_dissimilar(cover, longest);
        fewer += cover->states < d[0]->states;
        assert_int_equal(tn_dfa_product(cover, d[1], TN_DFA_MINUS, "test", &bounds, &both, NULL), TN_OK);
        tn_dfa *exact = product(d[0], d[1], TN_DFA_MINUS);
        assert_false(told_apart(both, 0, exact, 0, longest));
        assert_true(both->states <= exact->states + 1);
        check_dissimilar(both, longest);
        tn_dfa *all[] = {raw[0], raw[1], d[0], d[1], cover, both, exact};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++)
            tn_dfa_free(all[i]);
    }
    assert_true(fewer > 100);
}

static void keys_are_numbered_in_order(void **state)
{
    (void)state;
    tn_numbering numbers = {0};
    tn_interner keys = {0};
    for (uint32_t round = 0; round < 2; round++) {
        for (uint32_t i = 0; i < 5000; i++) {
            uint32_t words[3] = {i % 3, i, i * 7};
            assert_int_equal(tn_number(&numbers, (uint64_t)i << 32 | i * 3), i);
            assert_int_equal(tn_intern(&keys, words, i % 4 == 3 ? 2 : 3), i);
        }
        assert_int_equal(tn_intern(&keys, NULL, 0), 5000);
    }
    size_t size;
    assert_int_equal(tn_interned(&keys, 3, &size)[1], 3);
    assert_int_equal(size, 2);
    tn_numbering_clear(&numbers);
    tn_interner_clear(&keys);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(minimising_is_exact_and_canonical),
        cmocka_unit_test(products_decide_as_their_operands),
        cmocka_unit_test(de_morgan),
        cmocka_unit_test(sparse_products_are_the_same),
        cmocka_unit_test(halves_decide_palindromes),
        cmocka_unit_test(products_stop_at_their_bounds),
        cmocka_unit_test(covers_are_right_of_short_words),
        cmocka_unit_test(keys_are_numbered_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
