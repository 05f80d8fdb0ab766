/* Expressions where memory runs out at each allocation in turn: an error, and nothing is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/number/formula.h"
#include "runtime/number/run.h"
#include "tests/support/failing_memory.h"

/* Reads a sentence of many rows of code and evaluates it; how many allocations it took. */
static tn_status read_and_run(const char *text, double *value)
{
    static const char *const names[] = {"x"};
    static const double column[TN_ROW] = {2};
    const double *const columns[] = {column};
    tn_formula formula = {0};
    tn_number_rows rows = {0};
    tn_error error = {0};
    tn_status status = tn_sentence_read(text, strlen(text), names, 1, &formula, &error);
    if (status == TN_OK)
        status = tn_number_run_rows(&rows, formula.code, 0, formula.depth, columns, 1, value, &error);
    if (status != TN_OK)
        assert_int_equal(error.status, status);
    tn_formula_clear(&formula);
    tn_number_rows_clear(&rows);
    return status;
}

static void test_failing(void **state)
{
    (void)state;
    static const char text[] =
        "x + (x + (x + (x + (x + (x + (x + (x + (x + (x + (x + (x + (x + (x + x) * 2))))))))))))";
    double value = 0;
    for (size_t failing = 0;; failing++) {
        fail_allocation(failing, 0);
        tn_status status = read_and_run(text, &value);
        if (stop_failing() <= failing) {
            assert_int_equal(status, TN_OK);
            assert_true(value == 34);
            assert_true(failing >= 4);
            return;
        }
        assert_int_equal(status, TN_MEMORY);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_failing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
