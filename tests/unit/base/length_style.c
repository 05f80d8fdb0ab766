#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "runtime/base/length.h"

static void expect(const char *spelling, int64_t nanometres, const char *written)
{
    char text[48];
    tn_length_write_style(nanometres, tn_length_style_of(spelling), text, sizeof text);
    assert_string_equal(text, written);
}

static void test_styles(void **state)
{
    (void)state;
    const int64_t metre = 1000000000;
    expect("4'", 18 * TN_FOOT_NM, "18'");
    expect("2'6\"", 7 * TN_FOOT_NM + 6 * TN_INCH_NM, "7'6\"");
    expect("6\"", 0, "0'");
    expect("3m", 12 * metre, "12m");
    expect("3m", 5 * metre + 40 * (metre / 100), "5.4m");
    expect("3m", 5 * metre + 1, "5.000000001m");
    expect("45cm", 5 * metre + 4 * (metre / 1000), "500.4cm");
    expect("900mm", 0, "0mm");
    expect("900mm", 5 * metre + 400, "5000.0004mm");
    expect("", 4 * TN_FOOT_NM, "4'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_styles)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
