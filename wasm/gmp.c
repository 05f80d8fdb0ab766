/* mini-gmp, with the widths of gmp.h, and what of GMP it lacks. */
#include <assert.h>
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gmp.h"

#undef LONG_MAX
#undef LONG_MIN
#undef ULONG_MAX
#define LONG_MAX LLONG_MAX
#define LONG_MIN LLONG_MIN
#define ULONG_MAX ULLONG_MAX
#define long long long
#include <mini-gmp.c>
#include <mini-mpq.c>
#undef long

/* Calls `each` for the numbers of a list that ends with NULL. */
#define FOR_EACH(first, type, each)                                                                                    \
    do {                                                                                                               \
        va_list more;                                                                                                  \
        va_start(more, first);                                                                                         \
        for (type number = (first); number; number = va_arg(more, type))                                               \
            each(number);                                                                                              \
        va_end(more);                                                                                                  \
    } while (0)

void mpz_inits(mpz_t first, ...)
{
    FOR_EACH(first, mpz_ptr, mpz_init);
}

void mpz_clears(mpz_t first, ...)
{
    FOR_EACH(first, mpz_ptr, mpz_clear);
}

void mpq_inits(mpq_t first, ...)
{
    FOR_EACH(first, mpq_ptr, mpq_init);
}

void mpq_clears(mpq_t first, ...)
{
    FOR_EACH(first, mpq_ptr, mpq_clear);
}

double mpz_get_d_2exp(long *exponent, const mpz_t number)
{
    enum { DIGITS = 53 };
    size_t bits = mpz_sgn(number) ? mpz_sizeinbase(number, 2) : 0, spare = bits > DIGITS ? bits - DIGITS : 0;
    int power;
    mpz_t leading;
    mpz_init(leading);
    mpz_tdiv_q_2exp(leading, number, spare);
    double fraction = frexp(mpz_get_d(leading), &power);
    mpz_clear(leading);
    *exponent = (long)spare + power;
    return fraction;
}
