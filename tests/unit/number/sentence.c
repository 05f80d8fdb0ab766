/* Sentences of `fit`: read into code that gives what the tree gives, and refused with the place of what is wrong. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/math/elementary.h"
#include "runtime/number/formula.h"
#include "runtime/number/run.h"
#include "tests/support/test_expression.h"

static const char *const names[TEST_TERMS] = {"x", "y", "x0", "x1", "long_name", "a-b", "X", "z9", "_"};

static double value_of(const char *text)
{
    static const double terms[TEST_TERMS] = {3, 0};
    tn_formula formula = {0};
    tn_error error;
    if (tn_sentence_read(text, strlen(text), names, 2, &formula, &error) != TN_OK)
        fail_msg("%s: %s", text, error.message);
    double value = tn_number_run(formula.code, 0, terms);
    tn_formula_clear(&formula);
    return value;
}

static void test_values(void **state)
{
    (void)state;
    assert_true(value_of("1 + 2 * 3") == 7);
    assert_true(value_of("(1 + 2) * 3 - 4 - 5") == 0);
    assert_true(value_of("x / 2 / 3") == 0.5);
    assert_true(value_of("x / y") == 1);
    assert_true(value_of("-x * -2.50") == 7.5);
    assert_true(value_of("sqrt(-4) + abs(-1) + square(x)") == 12);
    assert_true(value_of("min(x, 2) + max(x, y)") == 5);
    assert_true(value_of("sin(y) + cos(y) + exp(y) + tanh(y)") == 2);
    assert_true(value_of("log(y) + log(-x)") == tn_log(3));
    assert_true(value_of("exp(sin(x)) / tanh(x)") == tn_exp(tn_sin(3)) / tn_tanh(3));
    assert_true(value_of("x - cos(-x)") == 3 - tn_cos(3));
    assert_true(value_of("0.1") == 0.1);
    assert_true(value_of("123456.789") == 123456.789);
}

/* What Python programs write. */
static void test_python(void **state)
{
    (void)state;
    assert_true(value_of("x[:, 0] + x.iloc[:, 1] + x[0]") == 6);
    assert_true(value_of("np.sin(x)+np.exp(y)-np.tanh(y)") == tn_sin(3) + 1);
    assert_true(value_of("plog(-x)") == tn_log(4));
    assert_true(value_of("rlog(-x)") == tn_log(3));
    assert_true(value_of("pdiv(x, y) + psqrt(-4)") == 3);
    assert_true(value_of("aq(x, y)") == 3);
    assert_true(value_of("aq(y, x) + aq(10, x)") == 10 / sqrt(10));
    assert_true(value_of("np.maximum(x, 5) + np.minimum(x, 5)") == 8);
    assert_true(value_of("-x**2") == -9);
    assert_true(value_of("2**-1") == 0.5);
    assert_true(value_of("2**3**2") == 512);
    assert_true(value_of("x-y") == 3); /* no name has this minus */
    assert_true(value_of("x-sin(y)") == 3);
    assert_true(value_of("(x > 2) & ~(y == 1) | (x != 3)") == 1);
    assert_true(value_of("x <= 2") == 0);
    assert_true(value_of("np.where(x > 2, 7, 8) + np.where(x == 2, 7, 8)") == 15);
    assert_true(value_of("np.where(x > 2, np.where(y > 0, 1, 2), 3)") == 2);
    assert_true(value_of("np.log(y)") == -HUGE_VAL); /* not protected */
}

static void refused(const char *text, uint32_t column)
{
    tn_formula formula = {0};
    tn_error error;
    assert_int_equal(tn_sentence_read(text, strlen(text), names, 1, &formula, &error), TN_INVALID);
    assert_int_equal(error.code, E_EXPRESSION);
    if (error.column != column)
        fail_msg("`%s` is refused at column %u, not %u: %s", text, error.column, column, error.message);
    tn_formula_clear(&formula);
}

static void test_refused(void **state)
{
    (void)state;
    refused("", 1);
    refused("1 +", 4);
    refused("x y", 3);
    refused("(x", 3);
    refused("z", 1);
    refused("tan(x)", 5);
    refused("np.sinh(x)", 9);
    refused("x[:, 1]", 6);
    refused("x[:, y]", 6);
    refused("x[0", 4);
    refused("c[0]", 1);
    refused("np.where(x, 1)", 14);
    refused("x = 3", 3);
    refused("min(x)", 6);
    refused("min(x, x, x)", 9);
    refused("sqrt()", 6);
    refused("1.5.2", 4);
    refused("x <> 3", 4);
    refused("1234567890123456", 16);
    refused("0.1234567890123456", 18);
}

static void test_functions_are_told(void **state)
{
    (void)state;
    tn_formula formula = {0};
    tn_error error;
    assert_int_equal(tn_sentence_read("tan(x)", 6, names, 1, &formula, &error), TN_INVALID);
    assert_string_equal(error.message, "there is no function `tan`: there are abs, square, exp, sin, cos, tanh, sqrt, "
                                       "log, min and max");
    tn_formula_clear(&formula);
}

static tn_status read_repeated(const char *part, size_t times, const char *tail, tn_formula *formula)
{
    size_t size = strlen(part), end = strlen(tail);
    char *text = malloc(times * size + end);
    assert_non_null(text);
    for (size_t i = 0; i < times; i++)
        memcpy(text + i * size, part, size);
    memcpy(text + times * size, tail, end);
    tn_error error;
    tn_status status = tn_sentence_read(text, times * size + end, names, 1, formula, &error);
    free(text);
    return status;
}

static void test_deep_and_long(void **state)
{
    (void)state;
    static const double one[TEST_TERMS] = {1};
    tn_formula formula = {0};
    assert_int_equal(read_repeated("(", 3000, "", &formula), TN_LIMIT);
    assert_int_equal(read_repeated("-", 3000, "x", &formula), TN_LIMIT);
    assert_int_equal(read_repeated("sqrt(", 3000, "x", &formula), TN_LIMIT);
    assert_int_equal(read_repeated("-", TN_SENTENCE_NEST, "", &formula), TN_LIMIT);
    assert_int_equal(read_repeated("-", TN_SENTENCE_NEST - 1, "x", &formula), TN_OK);
    assert_true(tn_number_run(formula.code, 0, one) == -1);
    assert_int_equal(read_repeated("x + ", 100000, "x", &formula), TN_OK); /* long is not deep */
    assert_int_equal(formula.depth, 2);
    assert_true(tn_number_run(formula.code, 0, one) == 100001);
    tn_formula_clear(&formula);
}

/* ---- beside the tree */

typedef struct fixture {
    tn_formula formula;
    tn_number_rows rows;
} fixture;

static void compile(const test_expression *tree, tn_formula *formula)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    test_expression_write(tree, names, out);
    fclose(out);
    tn_error error;
    if (tn_sentence_read(text, size, names, TEST_TERMS, formula, &error) != TN_OK)
        fail_msg("%s: %s", text, error.message);
    free(text);
}

static void check_tree(fixture *f, test_random *random, const test_expression *tree)
{
    enum { POINTS = 2 * TN_ROW + 7 };
    static double columns[TEST_TERMS][3 * TN_ROW], values[POINTS];
    const double *pointers[TEST_TERMS];
    tn_error error;
    for (size_t t = 0; t < TEST_TERMS; t++) {
        pointers[t] = columns[t];
        for (size_t i = 0; i < POINTS; i++)
            columns[t][i] = test_number(random);
    }
    compile(tree, &f->formula);
    assert_int_equal(
        tn_number_run_rows(&f->rows, f->formula.code, 0, f->formula.depth, pointers, POINTS, values, &error), TN_OK);
    for (size_t i = 0; i < POINTS; i++) {
        double terms[TEST_TERMS];
        for (size_t t = 0; t < TEST_TERMS; t++)
            terms[t] = columns[t][i];
        double wanted = test_expression_value(tree, terms, true);
        assert_true(test_same(values[i], wanted));
        assert_true(test_same(tn_number_run(f->formula.code, 0, terms), wanted));
    }
}

static void test_random_trees(void **state)
{
    (void)state;
    fixture f = {0};
    test_random random = {.seed = 3};
    for (size_t round = 0; round < 2000; round++) {
        test_expression *tree = test_expression_new(&random, 2 + (unsigned)(round % 6), true);
        check_tree(&f, &random, tree);
        test_expression_free(tree);
    }
    tn_formula_clear(&f.formula);
    tn_number_rows_clear(&f.rows);
}

/* ---- folding */

static void test_constants_are_folded(void **state)
{
    (void)state;
    tn_formula formula = {0};
    double number;
    tn_formula_begin(&formula);
    tn_formula_number(&formula, 2);
    tn_formula_number(&formula, 3);
    tn_formula_operation(&formula, TN_OP_MULTIPLY, 2);
    tn_formula_operation(&formula, TN_OP_NEGATE, 1);
    assert_int_equal(tn_formula_end(&formula, NULL), TN_OK);
    assert_true(tn_formula_is_constant(&formula, &number) && number == -6);
    tn_formula_begin(&formula);
    tn_formula_number(&formula, 1);
    tn_formula_number(&formula, 0);
    tn_formula_operation(&formula, TN_OP_DIVIDE, 2); /* has no value that code can hold */
    assert_int_equal(tn_formula_end(&formula, NULL), TN_OK);
    assert_false(tn_formula_is_constant(&formula, &number));
    assert_true(isinf(tn_number_run(formula.code, 0, NULL)));
    tn_formula_begin(&formula);
    tn_formula_number(&formula, 4);
    tn_formula_term(&formula, 0);
    tn_formula_number(&formula, 5);
    tn_formula_operation(&formula, TN_OP_ADD, 2); /* one operand is no number */
    tn_formula_operation(&formula, TN_OP_ADD, 2);
    assert_int_equal(tn_formula_end(&formula, NULL), TN_OK);
    assert_int_equal(formula.size, 9 + 5 + 9 + 1 + 1 + 1);
    tn_formula_clear(&formula);
}

/* A tree of numbers, folded, has the value of the same with terms in their places, run. */
static void add(tn_formula *formula, const test_expression *e, const double *terms, bool as_terms)
{
    for (uint32_t i = 0; i < e->count; i++)
        add(formula, e->operands[i], terms, as_terms);
    if (e->kind == TEST_NUMBER)
        tn_formula_number(formula, atof(e->text));
    else if (e->kind == TEST_TERM && !as_terms)
        tn_formula_number(formula, terms[e->term]);
    else if (e->kind == TEST_TERM)
        tn_formula_term(formula, e->term);
    for (size_t i = 0; e->kind == TEST_APPLY && i < TN_OPERATION_COUNT; i++)
        if (strcmp(tn_operations[i].word, e->text) == 0 && tn_operations[i].arity == e->count) {
            tn_formula_operation(formula, tn_operations[i].opcode, e->count);
            return;
        }
}

static void test_folding_is_running(void **state)
{
    (void)state;
    tn_formula folded = {0}, run = {0};
    test_random random = {.seed = 4};
    size_t constants = 0;
    for (size_t round = 0; round < 20000; round++) {
        test_expression *tree = test_expression_new(&random, 2 + (unsigned)(round % 6), false);
        double terms[TEST_TERMS], number;
        for (size_t t = 0; t < TEST_TERMS; t++)
            do
                terms[t] = test_number(&random);
            while (!isfinite(terms[t]));
        tn_formula_begin(&folded);
        tn_formula_begin(&run);
        add(&folded, tree, terms, false);
        add(&run, tree, terms, true);
        assert_int_equal(tn_formula_end(&folded, NULL), TN_OK);
        assert_int_equal(tn_formula_end(&run, NULL), TN_OK);
        double wanted = tn_number_run(run.code, 0, terms);
        assert_true(test_same(tn_number_run(folded.code, 0, NULL), wanted));
        assert_true(test_same(wanted, test_expression_value(tree, terms, false)));
        if (isfinite(wanted) && tn_formula_is_constant(&folded, &number))
            constants++;
        test_expression_free(tree);
    }
    assert_true(constants > 10000);
    tn_formula_clear(&folded);
    tn_formula_clear(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_python),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_functions_are_told),
        cmocka_unit_test(test_deep_and_long),
        cmocka_unit_test(test_random_trees),
        cmocka_unit_test(test_constants_are_folded),
        cmocka_unit_test(test_folding_is_running),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
