/* Exact rational numbers as texts. */
#include "runtime/number/rational.h"

#include <stdlib.h>
#include <string.h>

bool tn_rational_fits(const mpq_t number)
{
    return mpz_sizeinbase(mpq_numref(number), 2) <= TN_RATIONAL_BITS &&
           mpz_sizeinbase(mpq_denref(number), 2) <= TN_RATIONAL_BITS;
}

bool tn_decimal_read(const char *text, size_t size, mpq_t number)
{
    enum { DIGITS_MAX = TN_RATIONAL_BITS / 4 };
    char digits[DIGITS_MAX + 1];
    size_t count = 0, behind = 0;
    bool point = false;
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '.' && !point) {
            point = true;
            continue;
        }
        if (text[i] < '0' || text[i] > '9' || count == DIGITS_MAX)
            return false;
        digits[count++] = text[i];
        behind += point;
    }
    digits[count] = '\0';
    if (count == 0)
        return false;
    mpz_set_str(mpq_numref(number), digits, 10);
    mpz_ui_pow_ui(mpq_denref(number), 10, behind);
    mpq_canonicalize(number);
    return true;
}

bool tn_rational_read(const char *text, mpq_t number)
{
    enum { LENGTH_MAX = TN_RATIONAL_BITS }; /* digits are more than a bit each, but two numbers and signs must fit */
    const char *digits = text + (text[0] == '-');
    size_t numerator = strspn(digits, "0123456789");
    if (numerator == 0 || strlen(text) > LENGTH_MAX)
        return false;
    const char *slash = digits + numerator;
    size_t denominator = *slash == '/' ? strspn(slash + 1, "0123456789") : 0;
    if (*slash == '/' ? denominator == 0 || slash[1 + denominator] != '\0' || slash[1] == '0' : *slash != '\0')
        return false;
    if (mpq_set_str(number, text, 10) != 0)
        return false;
    mpz_t common;
    mpz_init(common);
    mpz_gcd(common, mpq_numref(number), mpq_denref(number));
    bool lowest = mpz_cmp_ui(common, 1) == 0 && (*slash == '\0' || mpz_cmp_ui(mpq_denref(number), 1) > 0);
    mpz_clear(common);
    return lowest && tn_rational_fits(number);
}

void tn_rational_power(mpq_t result, const mpq_t number, int exponent)
{
    unsigned times = (unsigned)abs(exponent);
    mpz_pow_ui(mpq_numref(result), mpq_numref(number), times);
    mpz_pow_ui(mpq_denref(result), mpq_denref(number), times);
    if (exponent < 0)
        mpq_inv(result, result);
    mpq_canonicalize(result);
}
