/* The digits of whole numbers of any size. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/integers.h"

static void test_digits(void **state)
{
    static const char *const texts[] = {
        "0", "9", "-10", "99", "18446744073709551616", "-340282366920938463463374607431768211457"};
    (void)state;
    mpz_t number;
    mpz_init(number);
    tn_buffer text = {0};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        size_t before = text.size, size = strlen(texts[i]);
        mpz_set_str(number, texts[i], 10);
        assert_true(tn_buffer_integer(&text, number));
        assert_string_equal(text.data + before, texts[i]);
        assert_int_equal(text.size - before, size);
        assert_int_equal(tn_decimal_digits(number), size - (texts[i][0] == '-'));
    }
    mpz_clear(number);
    free(text.data);
}

/* A number of 64 bits is taken whole, however wide `long` is. */
static void test_wide(void **state)
{
    (void)state;
    tn_buffer text = {0};
    mpz_t number;
    mpz_init_set_ui(number, UINT64_MAX);
    assert_true(tn_buffer_integer(&text, number));
    assert_string_equal(text.data, "18446744073709551615");
    assert_true(mpz_get_ui(number) == UINT64_MAX);
    mpz_clear(number);
    free(text.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_digits),
        cmocka_unit_test(test_wide),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
