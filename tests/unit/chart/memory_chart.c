/* Out of memory while charts are drawn: each of our allocations fails once, and then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/chart/chart.h"
#include "tests/support/failing_memory.h"

static const tn_chart_bar bars[] = {{1, 1, 0.25}, {2, 2, 0.5}, {4, 4, 0.25}};

static tn_status histogram(tn_error *error)
{
    const tn_histogram h = {.title = "cost",
                            .doc = "in dollars",
                            .about = "4 plans",
                            .unit = "",
                            .bars = bars,
                            .count = 3,
                            .least = 1,
                            .quartiles = {1, 2, 2},
                            .most = 4,
                            .mean = 2.25,
                            .facts = {{"least", "1"}},
                            .fact_count = 1};
    tn_picture to = {.format = TN_CANVAS_SVG};
    tn_status status = tn_histogram_draw(&h, &to, error);
    free(to.element);
    return status;
}

static tn_status front(tn_error *error)
{
    static const tn_chart_point points[] = {{1, 4}, {2, 1}};
    static const char *const cells[] = {"1", "4", "2", "1"};
    const tn_chart_axis axis = {"cost", "m", true, bars, 3};
    const tn_front_drawing d = {.title = "front",
                                .about = "2 points",
                                .note = "",
                                .panels = {{axis, axis, points, 2, points, 2, true}},
                                .panel_count = 1,
                                .headings = {"a", "b"},
                                .cells = cells,
                                .rows = 2,
                                .columns = 2};
    tn_picture to = {.format = TN_CANVAS_SVG};
    tn_status status = tn_front_draw(&d, &to, error);
    free(to.element);
    return status;
}

static void fails_cleanly(void **state)
{
    static tn_status (*const operations[])(tn_error *) = {histogram, front};
    (void)state;
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        size_t failures = 0;
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number++) {
                tn_error error = {0};
                fail_allocation(number, all_after);
                tn_status status = operations[i](&error);
                if (stop_failing() <= number) {
                    assert_int_equal(status, TN_OK);
                    break;
                }
                if (status == TN_OK)
                    continue;
                assert_int_equal(status, TN_MEMORY);
                failures++;
            }
        }
        assert_true(failures > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fails_cleanly)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
