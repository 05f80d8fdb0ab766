/* Measures of errors on data small enough to work out by hand. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/genome/breeding/problem.h"
#include "runtime/genome/breeding/select.h"
#include "runtime/math/elementary.h"

static double cost(tn_fit_error measure, const double *wanted, const double *values, size_t count)
{
    tn_fit_wanted w;
    tn_error error;
    double scratch[16];
    assert_int_equal(tn_fit_wanted_of(measure, wanted, count, NULL, &w, &error), TN_OK);
    double result = tn_fit_cost(&w, values, scratch);
    tn_fit_wanted_clear(&w);
    return result;
}

static void test_numbers(void **state)
{
    (void)state;
    static const double wanted[] = {1, 2, 3, 6}, values[] = {2, 2, 1, 6};
    assert_true(cost(TN_FIT_MSE, wanted, values, 4) == 1.25);
    assert_true(cost(TN_FIT_RMSE, wanted, values, 4) == sqrt(1.25));
    assert_true(cost(TN_FIT_MAE, wanted, values, 4) == 0.75);
    assert_true(cost(TN_FIT_R2, wanted, values, 4) == 5.0 / 14);
    assert_true(cost(TN_FIT_R2, wanted, wanted, 4) == 0);
    static const double none[] = {1, NAN, 3, 6};
    for (tn_fit_error measure = TN_FIT_RMSE; measure <= TN_FIT_R2; measure++)
        assert_true(isnan(cost(measure, wanted, none, 4)));
}

static void test_classes(void **state)
{
    (void)state;
    static const double wanted[] = {0, 0, 1, 1, 1}, values[] = {-1, 0.5, 2, 3, -4};
    assert_true(cost(TN_FIT_ACCURACY, wanted, values, 5) == 0.4);
    assert_true(fabs(cost(TN_FIT_F1, wanted, values, 5) - (1 - 4.0 / 6)) < 1e-15); /* 2 found, 3 of it, 3 taken */
    static const double sure[] = {-800, -800, 800, 800, 800};
    assert_true(cost(TN_FIT_LOG_LOSS, wanted, sure, 5) == 0);
    static const double unsure[] = {0, 0, 0, 0, 0};
    assert_true(fabs(cost(TN_FIT_LOG_LOSS, wanted, unsure, 5) - tn_log(2)) < 1e-15);
    static const double three[] = {1, 2, 3}, near[] = {1.4, 2.6, 9};
    assert_true(fabs(cost(TN_FIT_ACCURACY, three, near, 3) - 1.0 / 3) < 1e-15);
    assert_true(fabs(cost(TN_FIT_F1, three, near, 3) - (1 - (1 + 0 + 2.0 / 3) / 3)) < 1e-15);
    static const double same[] = {1, 1, 1};
    tn_fit_wanted w;
    tn_error error;
    assert_int_equal(tn_fit_wanted_of(TN_FIT_F1, same, 3, NULL, &w, &error), TN_INVALID);
    tn_fit_wanted_clear(&w);
    assert_int_equal(tn_fit_wanted_of(TN_FIT_LOG_LOSS, three, 3, NULL, &w, &error), TN_INVALID);
    tn_fit_wanted_clear(&w);
}

static void test_line(void **state)
{
    (void)state;
    static const double wanted[] = {5, 7, 9, 11}, values[] = {1, 2, 3, 4}, flat[] = {3, 3, 3, 3};
    tn_fit_wanted w;
    tn_error error;
    double scratch[4], line[2];
    assert_int_equal(tn_fit_wanted_of(TN_FIT_RMSE, wanted, 4, NULL, &w, &error), TN_OK);
    tn_fit_line(&w, values, scratch, line);
    assert_true(line[0] == 3 && line[1] == 2);
    tn_fit_line(&w, flat, scratch, line);
    assert_true(line[0] == 8 && line[1] == 0);
    tn_fit_wanted_clear(&w);
}

/* Of three members one is the best in each case, and one in none. */
static void test_lexicase(void **state)
{
    (void)state;
    static const double errors[3][2] = {{0, 9}, {9, 0}, {1, 1}};
    tn_lexicase l;
    tn_error error;
    size_t drawn[3] = {0};
    assert_int_equal(tn_lexicase_new(3, 2, 1, &l, &error), TN_OK);
    for (size_t i = 0; i < 3; i++)
        tn_lexicase_put(&l, i, errors[i]);
    tn_chance chance = tn_chance_for(1, TN_PURPOSE_SELECT, 0, 0);
    for (int i = 0; i < 1000; i++)
        drawn[tn_lexicase_select(&l, 0, &chance)]++;
    assert_int_equal(drawn[2], 0);
    assert_in_range(drawn[0], 400, 600);
    assert_int_equal(tn_lexicase_find_epsilons(&l, &error), TN_OK);
    assert_true(l.epsilons[0] == 1); /* of 0, 9, 1: the median is 1, the distances 1, 8 and 0 */
    for (int i = 0; i < 1000; i++)
        drawn[tn_lexicase_select(&l, 0, &chance)]++;
    assert_true(drawn[2] > 400); /* good enough in both */
    tn_lexicase_clear(&l);
    assert_int_equal(tn_lexicase_new(1000000, 1000000, 1, &l, &error), TN_LIMIT);
    tn_lexicase_clear(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_numbers), cmocka_unit_test(test_classes),
                                       cmocka_unit_test(test_line), cmocka_unit_test(test_lexicase)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
