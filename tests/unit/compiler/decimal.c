/* Decimal numbers are read as the nearest double: held to exact fractions, near ties too. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>
#include <math.h>

#include "compiler/common/lexical.h"
#include "runtime/base/random.h"

/* |exact - value|, of a text "DIGITSeEXPONENT". */
static void distance(const char *digits, long exponent, double value, mpq_t far)
{
    mpq_t other;
    mpz_t power;
    mpq_init(other);
    mpz_init(power);
    mpz_ui_pow_ui(power, 10, (unsigned long)labs(exponent));
    mpq_set_str(far, digits, 10);
    mpq_set_z(other, power);
    (exponent < 0 ? mpq_div : mpq_mul)(far, far, other);
    mpq_set_d(other, value);
    mpq_sub(far, far, other);
    mpq_abs(far, far);
    mpz_clear(power);
    mpq_clear(other);
}

/* No neighbour is nearer; of two that are as near, the one that is even. */
static void check_nearest(const char *digits, long exponent)
{
    char text[900];
    mpq_t far, beside;
    snprintf(text, sizeof text, "%se%ld", digits, exponent);
    double value = tn_decimal_value(text, strlen(text));
    mpq_inits(far, beside, NULL);
    distance(digits, exponent, value, far);
    for (int up = 0; up < 2; up++) {
        double next = nextafter(value, up ? INFINITY : -INFINITY);
        uint64_t bits;
        memcpy(&bits, &value, sizeof bits);
        distance(digits, exponent, next, beside);
        int order = mpq_cmp(far, beside);
        if (order > 0 || (order == 0 && bits % 2 != 0))
            fail_msg("%s is read as %.17g", text, value);
    }
    mpq_clears(far, beside, NULL);
}

static void reads_the_nearest(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 3000; i++) {
        char digits[24];
        uint64_t bits = tn_random64(7, 1, i);
        snprintf(digits, sizeof digits, "%llu", (unsigned long long)(bits >> (i % 60)) | 1);
        check_nearest(digits, (long)(tn_random64(7, 2, i) % 560) - 300);
    }
}

/* The middle between two doubles, written out, and a little beside it. */
static void reads_ties(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 200; i++) {
        mpz_t digits;
        mpz_init_set_ui(digits, (tn_random64(7, 3, i) >> 11) | (UINT64_C(1) << 52));
        mpz_mul_ui(digits, digits, 2);
        mpz_add_ui(digits, digits, 1); /* 54 bits: between two */
        for (int beside = -1; beside <= 1; beside++) {
            mpz_t near;
            mpz_init(near);
            mpz_mul_ui(near, digits, 1000000);
            beside < 0 ? mpz_sub_ui(near, near, 1) : mpz_add_ui(near, near, (unsigned long)beside);
            char *text = mpz_get_str(NULL, 10, near);
            check_nearest(text, -6);
            free(text);
            mpz_clear(near);
        }
        mpz_clear(digits);
    }
}

static void reads(const char *text, double wanted)
{
    double value = tn_decimal_value(text, strlen(text));
    if (memcmp(&value, &wanted, sizeof value) != 0)
        fail_msg("%s is read as %.17g", text, value);
}

static void reads_the_ends(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } numbers[] = {
        {"0", 0},
        {"-0.0", -0.0},
        {"0.1", 0.1},
        {"00012.50", 12.5},
        {"-12.5e3", -12500},
        {"+3.", 3},
        {"1e-300", 1e-300},
        {"5e-324", 5e-324},
        {"2.4703282292062327e-324", 0},
        {"1e-400", 0},
        {"1e-99999999999", 0},
        {"1e308", 1e308},
        {"1.7976931348623157e308", 1.7976931348623157e308},
        {"1e309", INFINITY},
        {"1e99999999999", INFINITY},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        reads(numbers[i].text, numbers[i].value);
}

/* A tie, and a digit behind a thousand zeros that breaks it. */
static void reads_long_numbers(void **state)
{
    (void)state;
    char text[1200] = "9007199254740993."; /* 2^53 + 1 */
    size_t size = strlen(text);
    memset(text + size, '0', 1000);
    reads(text, 9007199254740992.0);
    text[size + 1000] = '1';
    reads(text, 9007199254740994.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_the_nearest),
        cmocka_unit_test(reads_ties),
        cmocka_unit_test(reads_the_ends),
        cmocka_unit_test(reads_long_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
