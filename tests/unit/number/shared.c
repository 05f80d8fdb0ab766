/* Formulas that are evaluated together have the values that each has alone, to the bit, and what they share is one
 * node. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/number/formula.h"
#include "runtime/number/run.h"
#include "runtime/number/shared.h"

enum { POINTS = 700, FORMULAS = 60, TERMS = 3 };

static const char *const names[TERMS] = {"x", "y", "z"};

/* A random sentence of limited depth. */
static size_t write_sentence(char *out, uint64_t seed, uint64_t *draw, int depth)
{
    static const char *const leaves[] = {"x", "y", "z", "0.5", "2"};
    static const char *const heads[] = {"sin(", "exp(", "tanh(", "log("};
    uint64_t drawn = tn_random64(seed, 1, (*draw)++);
    if (depth == 0 || drawn % 5 == 0)
        return (size_t)sprintf(out, "%s", leaves[drawn / 5 % 5]);
    size_t size = (size_t)sprintf(out, "%s", drawn % 2 ? heads[drawn / 5 % 4] : "(");
    size += write_sentence(out + size, seed, draw, depth - 1);
    if (drawn % 2 == 0) {
        out[size++] = "+-*/"[drawn / 5 % 4];
        size += write_sentence(out + size, seed, draw, depth - 1);
    }
    out[size++] = ')';
    out[size] = '\0';
    return size;
}

static void test_values(void **state)
{
    (void)state;
    static double columns[TERMS][POINTS + TN_ROW], together[FORMULAS * POINTS], alone[POINTS];
    const double *pointers[TERMS] = {columns[0], columns[1], columns[2]};
    tn_formula formulas[FORMULAS] = {0};
    tn_number_rows rows = {0};
    tn_shared shared = {0};
    tn_error error;
    for (uint64_t t = 0; t < TERMS; t++)
        for (uint64_t i = 0; i < POINTS; i++)
            columns[t][i] = (double)(tn_random64(9, t, i) % 2000) / 500 - 2;
    for (uint64_t round = 0; round < 20; round++) {
        tn_shared_begin(&shared);
        for (uint64_t f = 0; f < FORMULAS; f++) {
            char text[4000];
            uint64_t draw = 0;
            size_t size = write_sentence(text, round * FORMULAS + f % 50, &draw, 5); /* the last ten again */
            if (tn_sentence_read(text, size, names, TERMS, &formulas[f], &error) != TN_OK)
                fail_msg("%s: %s", text, error.message);
            assert_int_equal(tn_shared_add(&shared, formulas[f].code, &error), TN_OK);
        }
        assert_int_equal(tn_shared_run(&shared, pointers, POINTS, together, &error), TN_OK);
        for (size_t f = 0; f < FORMULAS; f++) {
            assert_int_equal(
                tn_number_run_rows(&rows, formulas[f].code, 0, formulas[f].depth, pointers, POINTS, alone, &error),
                TN_OK);
            for (size_t i = 0; i < POINTS; i++)
                assert_true(alone[i] == together[f * POINTS + i] ||
                            (alone[i] != alone[i] && together[f * POINTS + i] != together[f * POINTS + i]));
        }
    }
    for (size_t f = 0; f < FORMULAS; f++)
        tn_formula_clear(&formulas[f]);
    tn_number_rows_clear(&rows);
    tn_shared_clear(&shared);
}

static void test_sharing(void **state)
{
    (void)state;
    static const char *const texts[] = {"sin(x + y) * z", "exp(sin(y + x))", "sin(x + y)"};
    tn_formula formula = {0};
    tn_shared shared = {0};
    tn_error error;
    tn_shared_begin(&shared);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(tn_sentence_read(texts[i], strlen(texts[i]), names, TERMS, &formula, &error), TN_OK);
        assert_int_equal(tn_shared_add(&shared, formula.code, &error), TN_OK);
    }
    assert_int_equal(tn_shared_operations(&shared), 4); /* +, sin, *, exp */
    tn_formula_clear(&formula);
    tn_shared_clear(&shared);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_sharing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
