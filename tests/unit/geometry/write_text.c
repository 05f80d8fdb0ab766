/* Numbers in mesh files read back as the same doubles, and have no more digits than that takes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/buffer.h"
#include "runtime/base/bytes.h"
#include "runtime/base/random.h"
#include "runtime/geometry/write_text.h"

static tn_text_out out;

static const char *written(double number)
{
    tn_text_begin(&out, NULL, 1);
    tn_text_number(&out, number);
    out.bytes[out.used] = '\0';
    return out.bytes;
}

static size_t digit_count(const char *text)
{
    size_t count = 0, zeros = 0;
    for (; *text && *text != 'e'; text++) {
        if (*text == '-' || *text == '.' || (*text == '0' && count == 0))
            continue;
        zeros = *text == '0' ? zeros + 1 : 0;
        count++;
    }
    return count - zeros;
}

static void check(double number)
{
    char shortest[TN_NUMBER_TEXT_SIZE];
    const char *text = written(number);
    if (strtod(text, NULL) != number || digit_count(text) > digit_count(tn_number_text(number, shortest)))
        fail_msg("%.17g is written as %s", number, text);
}

static void test_known(void **state)
{
    (void)state;
    assert_string_equal(written(0), "0");
    assert_string_equal(written(-0.0), "0");
    assert_string_equal(written(1), "1");
    assert_string_equal(written(-0.5), "-0.5");
    assert_string_equal(written(0.1), "0.1");
    assert_string_equal(written(0.1 + 0.2), "0.30000000000000004");
    assert_string_equal(written(1.0 / 3), "0.3333333333333333");
    assert_string_equal(written(0.00001), "0.00001");
    assert_string_equal(written(120), "120");
    assert_string_equal(written(4503599627370495.5), "4503599627370495.5");
    assert_string_equal(written(6e-17), "6e-17");
}

static void test_edges(void **state)
{
    (void)state;
    for (int exponent = -1022; exponent < 1024; exponent++)
        for (int turn = -1; turn <= 1; turn++) {
            double power = ldexp(1, exponent), number = turn < 0 ? nextafter(power, 0)
                                                        : turn   ? nextafter(power, 2 * power)
                                                                 : power;
            if (isfinite(number))
                check(number);
        }
    for (int exponent = -30; exponent < 30; exponent++)
        for (int turn = -1; turn <= 1; turn++) {
            double power = pow(10, exponent);
            check(turn < 0 ? nextafter(power, 0) : turn ? nextafter(power, 2 * power) : power);
        }
}

static void test_random(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 100000; i++) {
        uint64_t bits = tn_random64(1, i, 0);
        double any = tn_double_of(bits), near = ldexp((double)(bits >> 11), -53 - 20 + (int)(bits % 40));
        if (isfinite(any))
            check(any);
        check(-near);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_known), cmocka_unit_test(test_edges),
                                       cmocka_unit_test(test_random)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
