/* The marks of an axis: round, few enough, and written as people write numbers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/draw/scales.h"

static void steps_are_round(void **state)
{
    static const struct {
        double range, marks, step;
    } cases[] = {{100, 10, 10}, {100, 6, 20}, {90, 2, 50}, {1, 5, 0.2}, {0.07, 8, 0.01}, {250000, 6, 50000}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double step = tn_axis_step(cases[i].range, cases[i].marks);
        assert_true(fabs(step - cases[i].step) < 1e-9 * cases[i].step);
    }
}

static void marks_are_written(void **state)
{
    static const struct {
        double value, step;
        const char *text;
    } cases[] = {{1250, 50, "1,250"}, {-1250000, 50000, "-1,250,000"}, {0.05, 0.01, "0.05"},
                 {0.5, 0.25, "0.50"}, {1234.5, 0.5, "1,234.5"},        {-1e-18, 0.1, "0.0"},
                 {999, 1, "999"}};
    (void)state;
    char text[64];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        tn_axis_write(cases[i].value, cases[i].step, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
    tn_axis_write(1234567, 1, text, 6);
    assert_true(strlen(text) < 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(steps_are_round), cmocka_unit_test(marks_are_written)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
