/* Whole numbers of 128 and 256 bits, for what has to be decided exactly. Two's complement; nothing here overflows as
 * long as results fit, which whoever calculates sees to. */
#ifndef TARTAN_GEOMETRY_WIDE_H
#define TARTAN_GEOMETRY_WIDE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "runtime/base/int128.h"

typedef struct tn_wide {
    uint64_t limb[4]; /* the lowest first */
} tn_wide;

static inline tn_wide tn_wide_of(tn_int128 a)
{
    uint64_t fill = a < 0 ? UINT64_MAX : 0;
    return (tn_wide){{(uint64_t)a, (uint64_t)((tn_uint128)a >> 64), fill, fill}};
}

static inline tn_wide tn_wide_add(tn_wide a, tn_wide b)
{
    tn_uint128 carry = 0;
    for (int i = 0; i < 4; i++) {
        carry += (tn_uint128)a.limb[i] + b.limb[i];
        a.limb[i] = (uint64_t)carry;
        carry >>= 64;
    }
    return a;
}

static inline tn_wide tn_wide_negate(tn_wide a)
{
    for (int i = 0; i < 4; i++)
        a.limb[i] = ~a.limb[i];
    return tn_wide_add(a, tn_wide_of(1));
}

static inline tn_wide tn_wide_subtract(tn_wide a, tn_wide b)
{
    return tn_wide_add(a, tn_wide_negate(b));
}

static inline tn_wide tn_wide_multiply(tn_wide a, tn_wide b)
{
    tn_wide product = {{0}};
    for (int i = 0; i < 4; i++) {
        tn_uint128 carry = 0;
        for (int j = 0; i + j < 4; j++) {
            carry += (tn_uint128)a.limb[i] * b.limb[j] + product.limb[i + j];
            product.limb[i + j] = (uint64_t)carry;
            carry >>= 64;
        }
    }
    return product;
}

static inline tn_wide tn_wide_product(tn_int128 a, tn_int128 b)
{
    return tn_wide_multiply(tn_wide_of(a), tn_wide_of(b));
}

static inline int tn_wide_sign(tn_wide a)
{
    if (a.limb[3] >> 63)
        return -1;
    return (a.limb[0] | a.limb[1] | a.limb[2] | a.limb[3]) != 0;
}

/* Of what is not negative. */
static inline tn_wide tn_wide_shifted(tn_wide a, unsigned left)
{
    tn_wide out = {{0}};
    unsigned limbs = left / 64, bits = left % 64;
    for (unsigned i = limbs; i < 4; i++) {
        out.limb[i] = a.limb[i - limbs] << bits;
        if (bits && i > limbs)
            out.limb[i] |= a.limb[i - limbs - 1] >> (64 - bits);
    }
    return out;
}

/* Bits of what is not negative, without leading zeros. */
static inline unsigned tn_wide_bits(tn_wide a)
{
    for (int i = 3; i >= 0; i--)
        if (a.limb[i])
            return (unsigned)(64 * i + 64 - __builtin_clzll(a.limb[i]));
    return 0;
}

/* The whole quotient of two that are not negative, below 2^127; *exact: there is no remainder. */
static inline tn_int128 tn_wide_quotient(tn_wide a, tn_wide b, bool *exact)
{
    tn_uint128 quotient = 0;
    unsigned high = tn_wide_bits(a), low = tn_wide_bits(b);
    for (int shift = (int)high - (int)low; shift >= 0; shift--) {
        tn_wide rest = tn_wide_subtract(a, tn_wide_shifted(b, (unsigned)shift));
        if (tn_wide_sign(rest) < 0)
            continue;
        a = rest;
        quotient |= (tn_uint128)1 << shift;
    }
    *exact = tn_wide_sign(a) == 0;
    return (tn_int128)quotient;
}

/* Below 0, 0 or above 0 as a is less than b, equal to it or more. */
static inline int tn_wide_compare(tn_wide a, tn_wide b)
{
    return tn_wide_sign(tn_wide_subtract(a, b));
}

/* Half of it, rounded down. */
static inline tn_wide tn_wide_half(tn_wide a)
{
    uint64_t fill = a.limb[3] & (UINT64_C(1) << 63);
    for (int i = 0; i < 3; i++)
        a.limb[i] = a.limb[i] >> 1 | a.limb[i + 1] << 63;
    a.limb[3] = a.limb[3] >> 1 | fill;
    return a;
}

/* numerator / denominator as the nearest double, ties to even; the denominator is above 0, and the quotient is below
 * 2^127. */
static inline double tn_wide_ratio(tn_wide numerator, tn_wide denominator)
{
    enum { BITS = 64 }; /* of the quotient at least: more than a double holds */
    bool exact, negative = tn_wide_sign(numerator) < 0;
    tn_wide a = negative ? tn_wide_negate(numerator) : numerator;
    int shift = BITS + (int)tn_wide_bits(denominator) - (int)tn_wide_bits(a);
    shift = shift < 0 ? 0 : shift;
    tn_uint128 quotient = (tn_uint128)tn_wide_quotient(tn_wide_shifted(a, (unsigned)shift), denominator, &exact);
    double value = ldexp((double)(quotient | !exact), -shift); /* what is left over only breaks ties */
    return negative ? -value : value;
}

static inline double tn_ratio(tn_int128 numerator, tn_int128 denominator)
{
    return tn_wide_ratio(tn_wide_of(numerator), tn_wide_of(denominator));
}

#endif
