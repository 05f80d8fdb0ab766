/* The table of operations: what each row gives, one point and many by the same bits, and that its words are documented.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/file.h"
#include "runtime/number/interval.h"
#include "runtime/number/operation.h"
#include "tests/support/test_expression.h"

static double of(tn_opcode opcode, double a, double b, double c)
{
    return tn_operation_apply(opcode, (const double[]){a, b, c});
}

static void same(const tn_operation *operation, const double *operands, double got, double wanted)
{
    if (!test_same(got, wanted))
        fail_msg("%s of %a, %a, %a is %a in a row and %a by itself",
                 tn_opcode_describe((uint8_t)operation->opcode)->name, operands[0], operands[1], operands[2], got,
                 wanted);
}

/* All specials with all. */
static void test_rows_are_points(void **state)
{
    (void)state;
    static double columns[3][TN_ROW], out[TN_ROW];
    const double *const rows[] = {columns[0], columns[1], columns[2]};
    for (size_t i = 0; i < TN_OPERATION_COUNT; i++) {
        const tn_operation *operation = &tn_operations[i];
        for (size_t from = 0; from < TEST_SPECIALS * TEST_SPECIALS * TEST_SPECIALS; from += TN_ROW) {
            for (size_t k = 0; k < TN_ROW; k++) {
                size_t n = from + k;
                for (size_t j = 0; j < 3; j++, n /= TEST_SPECIALS)
                    columns[j][k] = test_specials[n % TEST_SPECIALS];
            }
            tn_operation_row(operation->opcode, rows, out);
            for (size_t k = 0; k < TN_ROW; k++) {
                double operands[] = {columns[0][k], columns[1][k], columns[2][k]};
                same(operation, operands, out[k], tn_operation_apply(operation->opcode, operands));
            }
        }
    }
}

/* From -4 to 4, and often whole, so that bounds are met. */
static double small_number(test_random *random)
{
    double number = (double)test_draw(random, 8001) / 1000 - 4;
    return test_draw(random, 2) ? rint(number) : number;
}

/* Every value of an operation lies in the interval that is said to hold all of them. */
static void test_bounds_hold_values(void **state)
{
    (void)state;
    test_random random = {.seed = 3};
    for (size_t round = 0; round < 20000; round++) {
        const tn_operation *operation = &tn_operations[round % TN_OPERATION_COUNT];
        tn_interval boxes[3];
        for (int j = 0; j < 3; j++) {
            double a = small_number(&random), b = test_draw(&random, 3) ? small_number(&random) : a;
            boxes[j] = (tn_interval){fmin(a, b), fmax(a, b), false};
        }
        tn_interval bounds =
            tn_operation_bounds(operation->opcode, (const tn_interval *[]){&boxes[0], &boxes[1], &boxes[2]});
        for (int i = 0; i < 8; i++) {
            double operands[3];
            for (int j = 0; j < 3; j++)
                operands[j] = i >> j & 1 ? boxes[j].high : boxes[j].low;
            double value = tn_operation_apply(operation->opcode, operands);
            if (value != value ? !bounds.fails : !(value >= bounds.low && value <= bounds.high))
                fail_msg("%s of %a, %a, %a is %a, not in %a to %a",
                         tn_opcode_describe((uint8_t)operation->opcode)->name, operands[0], operands[1], operands[2],
                         value, bounds.low, bounds.high);
        }
    }
}

static void test_random_rows_are_points(void **state)
{
    (void)state;
    static double columns[3][TN_ROW], out[TN_ROW];
    const double *const rows[] = {columns[0], columns[1], columns[2]};
    test_random random = {.seed = 2};
    for (size_t round = 0; round < 200; round++)
        for (size_t i = 0; i < TN_OPERATION_COUNT; i++) {
            for (size_t k = 0; k < TN_ROW; k++)
                for (size_t j = 0; j < 3; j++)
                    columns[j][k] = test_number(&random);
            tn_operation_row(tn_operations[i].opcode, rows, out);
            for (size_t k = 0; k < TN_ROW; k++) {
                double operands[] = {columns[0][k], columns[1][k], columns[2][k]};
                same(&tn_operations[i], operands, out[k], tn_operation_apply(tn_operations[i].opcode, operands));
            }
        }
}

/* But for the protected `min` and `max`, which say so. */
static void test_no_value_stays_none(void **state)
{
    (void)state;
    for (size_t i = 0; i < TN_OPERATION_COUNT; i++) {
        const tn_operation *operation = &tn_operations[i];
        if (operation->opcode == TN_OP_PROTECTED_LEAST || operation->opcode == TN_OP_PROTECTED_MOST ||
            operation->opcode == TN_OP_PROTECTED_DIVIDE)
            continue;
        for (uint32_t none = 0; none < operation->arity; none++)
            for (size_t k = 0; k < TEST_SPECIALS; k++) {
                double operands[3] = {test_specials[k], test_specials[k], test_specials[k]};
                operands[none] = NAN;
                if (!isnan(tn_operation_apply(operation->opcode, operands)))
                    fail_msg("%s gives a value of none", tn_opcode_describe((uint8_t)operation->opcode)->name);
            }
    }
    assert_true(of(TN_OP_PROTECTED_LEAST, NAN, 2, 0) == 2);
    assert_true(isnan(of(TN_OP_PROTECTED_LEAST, 2, NAN, 0)));
    assert_true(of(TN_OP_PROTECTED_DIVIDE, NAN, 0, 0) == 1);
}

static void test_protected(void **state)
{
    (void)state;
    assert_true(of(TN_OP_PROTECTED_DIVIDE, 3, 0, 0) == 1);
    assert_true(of(TN_OP_PROTECTED_DIVIDE, 3, -0.0, 0) == 1);
    assert_true(of(TN_OP_PROTECTED_DIVIDE, 3, 4, 0) == 0.75);
    assert_true(of(TN_OP_PROTECTED_ROOT, -4, 0, 0) == 2);
    assert_true(of(TN_OP_PROTECTED_LOGARITHM, 0, 0, 0) == 0);
    assert_true(of(TN_OP_PROTECTED_LOGARITHM, -1, 0, 0) == 0);
    assert_true(isinf(of(TN_OP_DIVIDE, 3, 0, 0)));
    assert_true(isnan(of(TN_OP_ROOT, -4, 0, 0)));
}

static void test_violations(void **state)
{
    (void)state;
    assert_true(of(TN_OP_SHORT_OF_AT_MOST, 5, 3, 0) == 2);
    assert_true(of(TN_OP_SHORT_OF_AT_MOST, 3, 3, 0) == 0);
    assert_true(of(TN_OP_SHORT_OF_BELOW, 3, 3, 0) == 1e-9);
    assert_true(of(TN_OP_SHORT_OF_BELOW, INFINITY, INFINITY, 0) == 1e-9);
    assert_true(of(TN_OP_SHORT_OF_BELOW, 3 + 1e-12, 3, 0) == 1e-9);
    assert_true(of(TN_OP_SHORT_OF_ABOVE, 3, 5, 0) == 2);
    assert_true(of(TN_OP_SHORT_OF_EQUAL, 3, 5, 0) == 2);
    assert_true(of(TN_OP_SHORT_OF_EQUAL, INFINITY, INFINITY, 0) == 0);
    assert_true(of(TN_OP_SHORT_OF_UNEQUAL, 3, 3, 0) == 1e-9);
    assert_true(of(TN_OP_SHORT_OF_UNEQUAL, 3, 4, 0) == 0);
    assert_true(of(TN_OP_SHORT_OF_BETWEEN, 5, 1, 3) == 2);
    assert_true(of(TN_OP_SHORT_OF_BETWEEN, 0, 1, 3) == 1);
    assert_true(of(TN_OP_SHORT_OF_OUTSIDE, 1.5, 1, 3) == 0.5);
    assert_true(of(TN_OP_SHORT_OF_OUTSIDE, 1, 1, 3) == 1e-9);
    assert_true(of(TN_OP_SHORT_OF_OUTSIDE, 0, 1, 3) == 0);
}

static void test_functions_have_names(void **state)
{
    (void)state;
    const char *names[TN_OPERATION_COUNT];
    assert_int_equal(tn_function_named(TN_WORDS_PLAIN, "sqrt", 4)->opcode, TN_OP_ROOT);
    assert_int_equal(tn_function_named(TN_WORDS_PROTECTED, "sqrt", 4)->opcode, TN_OP_PROTECTED_ROOT);
    assert_null(tn_function_named(TN_WORDS_PLAIN, "sqr", 3));
    assert_null(tn_function_named(TN_WORDS_PLAIN, "", 0));
    assert_null(tn_function_named(TN_WORDS_PLAIN, "and", 3));
    assert_int_equal(tn_function_names(TN_WORDS_PLAIN, names), tn_function_names(TN_WORDS_PROTECTED, names));
}

static bool tells(const char *name, const tn_operation *operation)
{
    uint8_t *page = NULL;
    char word[32], path[400];
    size_t size;
    tn_error error;
    snprintf(path, sizeof path, TARTAN_SOURCE_DIR "/docs/%s", name);
    snprintf(word, sizeof word, operation->words ? "`%s(" : "`%s`", operation->word);
    assert_int_equal(tn_file_read(path, SIZE_MAX, &page, &size, &error), TN_OK);
    bool told = memmem(page, size, word, strlen(word)) != NULL;
    free(page);
    return told;
}

/* Every function stands on the pages of those who have it; every operator on one of them. */
static void test_words_are_documented(void **state)
{
    (void)state;
    for (size_t i = 0; i < TN_OPERATION_COUNT; i++) {
        const tn_operation *o = &tn_operations[i];
        if (o->word[0] == '\0')
            continue;
        bool growth = tells("growth.md", o), field = tells("field-language.md", o);
        bool others = o->words & (TN_WORDS_PLAIN | TN_WORDS_PROTECTED);
        if ((others && !growth) || ((o->words & TN_WORDS_FIELD) && !field) || (!growth && !field))
            fail_msg("docs do not tell %s", o->word);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_are_points),
        cmocka_unit_test(test_bounds_hold_values),
        cmocka_unit_test(test_random_rows_are_points),
        cmocka_unit_test(test_no_value_stays_none),
        cmocka_unit_test(test_protected),
        cmocka_unit_test(test_violations),
        cmocka_unit_test(test_functions_have_names),
        cmocka_unit_test(test_words_are_documented),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
