/* Values of measures as people read them: how many digits they have, next to every power of ten. */
#include "runtime/plan/measure/amount.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const tn_amount_unit plain = {.power = 0};

typedef bool writer(tn_amount_unit unit, const mpq_t value, tn_buffer *out);

/* What is written of "p/q". */
static void says(writer *write, const char *value, const char *expected)
{
    tn_buffer out = {0};
    mpq_t number;
    mpq_init(number);
    assert_int_equal(mpq_set_str(number, value, 10), 0);
    mpq_canonicalize(number);
    assert_true(write(plain, number, &out) && tn_buffer_append(&out, "", 1));
    if (strcmp(out.data, expected) != 0)
        fail_msg("%s is written as %s, not as %s", value, out.data, expected);
    free(out.data);
    mpq_clear(number);
}

static void decimals_have_twelve_digits(void **state)
{
    (void)state;
    says(tn_amount_write, "999999999999/10", "99,999,999,999.9");
    says(tn_amount_write, "100000000001/10", "10,000,000,000.1");
    says(tn_amount_write, "1000000000001/10", "1000000000001/10");
    says(tn_amount_write, "9999999999999/10", "9999999999999/10");
    says(tn_amount_write, "999999999999/1000000000000", "0.999999999999");
    for (int digits = 2; digits <= 15; digits++) { /* 9.9, 99.9 and so on */
        char value[64], expected[64];
        tn_buffer whole = {0};
        snprintf(value, sizeof value, "%.*s/1", digits - 1, "99999999999999");
        mpq_t number;
        mpq_init(number);
        mpq_set_str(number, value, 10);
        assert_true(tn_amount_write(plain, number, &whole) && tn_buffer_append(&whole, "", 1));
        snprintf(value, sizeof value, "%.*s/10", digits, "999999999999999");
        snprintf(expected, sizeof expected, "%s.9", whole.data);
        says(tn_amount_write, value, digits <= 12 ? expected : value);
        free(whole.data);
        mpq_clear(number);
    }
}

static void about_has_six_digits(void **state)
{
    (void)state;
    says(tn_amount_write_about, "9", "9");
    says(tn_amount_write_about, "10", "10");
    says(tn_amount_write_about, "99", "99");
    says(tn_amount_write_about, "100", "100");
    /* a ninth less than each power: 9.11111, 99.1111, 999.111, 9,999.11, 99,999.1, 999,999 */
    says(tn_amount_write_about, "82/9", "9.11111");
    says(tn_amount_write_about, "892/9", "99.1111");
    says(tn_amount_write_about, "8992/9", "999.111");
    says(tn_amount_write_about, "89992/9", "9,999.11");
    says(tn_amount_write_about, "899992/9", "99,999.1");
    says(tn_amount_write_about, "8999992/9", "999,999");
    says(tn_amount_write_about, "91/9", "10.1111");
    says(tn_amount_write_about, "901/9", "100.111");
    says(tn_amount_write_about, "9001/9", "1,000.11");
    says(tn_amount_write_about, "90001/9", "10,000.1");
    says(tn_amount_write_about, "900001/9", "100,000");
}

/* Roots of squares of numbers with more digits than are shown. */
static void roots_have_twelve_digits(void **state)
{
    (void)state;
    says(tn_amount_write_root, "0", "0");
    says(tn_amount_write_root, "2", "1.41421356237");
    says(tn_amount_write_root, "3", "1.73205080757");
    says(tn_amount_write_root, "80", "8.94427191");
    says(tn_amount_write_root, "99", "9.94987437107");
    says(tn_amount_write_root, "9801", "99");
    says(tn_amount_write_root, "10000", "100");
    says(tn_amount_write_root, "9999", "99.994999875");
    says(tn_amount_write_root, "99999999", "9999.99995");
    says(tn_amount_write_root, "50", "7.07106781187");
    says(tn_amount_write_root, "90", "9.48683298051");
    says(tn_amount_write_root, "1/2", "0.707106781187");
    says(tn_amount_write_root, "81/100", "0.9");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decimals_have_twelve_digits),
        cmocka_unit_test(about_has_six_digits),
        cmocka_unit_test(roots_have_twelve_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
