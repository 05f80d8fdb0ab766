/* How long numbers of any size are in decimal, and how wide the columns are that they stand in: next to every power of
 * ten, where an estimate from the number's bits is one too many. */
#include "driver/open/digits.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/integers.h"

enum { POWERS = 400 };

/* Both ways of telling are held to the text itself. */
static void check(const mpz_t number)
{
    char *plain = tn_digits(number, false), *grouped = tn_digits(number, true);
    size_t sign = mpz_sgn(number) < 0;
    assert_true(plain && grouped);
    assert_int_equal(tn_decimal_digits(number), strlen(plain) - sign);
    assert_int_equal(tn_digits_width(number, ""), strlen(grouped) - sign);
    assert_int_equal(tn_digits_width(number, "up to mirror"),
                     strlen(grouped) - sign > 12 ? strlen(grouped) - sign : 12);
    free(plain);
    free(grouped);
}

static void powers_of_ten_and_their_neighbours(void **state)
{
    (void)state;
    mpz_t number;
    mpz_init(number);
    for (unsigned long power = 0; power <= POWERS; power++) {
        for (long next = -1; next <= 1; next++) {
            mpz_ui_pow_ui(number, 10, power);
            next < 0 ? mpz_sub_ui(number, number, 1) : mpz_add_ui(number, number, (unsigned long)next);
            check(number);
            mpz_neg(number, number);
            check(number);
        }
    }
    mpz_clear(number);
}

/* Between powers of two and of ten, where the estimate is right and where it is not. */
static void powers_of_two_and_their_neighbours(void **state)
{
    (void)state;
    mpz_t number;
    mpz_init(number);
    for (unsigned bit = 0; bit <= 1200; bit++) {
        mpz_set_ui(number, 1);
        mpz_mul_2exp(number, number, bit);
        check(number);
        mpz_sub_ui(number, number, 1);
        check(number);
    }
    mpz_clear(number);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_of_ten_and_their_neighbours),
        cmocka_unit_test(powers_of_two_and_their_neighbours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
