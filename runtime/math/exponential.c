/* Computes exponentials, logarithms, powers and hyperbolic tangents. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "runtime/numeric/numeric.h"
#include "runtime/numeric/pair.h"

/* ln 2 in two parts; a whole number below 2^20 times the first is exact. */
#define LN2_FIRST 0x1.62e42feep-1
#define LN2_REST 0x1.a39ef35793c76p-33

/* ---- exponential */

/* x = k ln 2 + r; `shifted` holds k in its last bits. */
static inline pair reduce_by_ln2(pair x, double *shifted)
{
    *shifted = x.high * 0x1.71547652b82fep+0 + NEAREST; /* 1 / ln 2 */
    double k = *shifted - NEAREST;
    pair r = sum(x.high - k * LN2_FIRST, -(k * LN2_REST));
    return quick_sum(r.high, r.low + x.low);
}

/* What e^r - 1 has beyond r.high, for |r| <= 0.35: (e^r - 1 - r) / r^2 within 2^-61. */
static inline double exponential_tail(pair r)
{
    static const double c[] = {0x1.0000000000000p-1,  0x1.5555555555557p-3,  0x1.5555555555556p-5,
                               0x1.11111111100d3p-7,  0x1.6c16c16c162cfp-10, 0x1.a01a01abeccc3p-13,
                               0x1.a01a01a6db488p-16, 0x1.71de02225a2f3p-19, 0x1.27e4db5bb725ap-22,
                               0x1.af4e092e1705bp-26, 0x1.1f7315649f2d7p-29};
    return (r.low + r.low * r.high) + r.high * r.high * horner(c, 11, r.high);
}

/* 2 to the power in the last bits of a shifted number, -1022 to 1023. */
static inline double power_of_two(uint64_t shifted_bits)
{
    return tn_double_of((shifted_bits + 1023) << 52);
}

/* For |x| < 1000. The power of two comes in two halves, so that only the last product rounds, where it leaves the range
 * of doubles. */
static inline double exponential(pair x)
{
    double shifted;
    pair r = reduce_by_ln2(x, &shifted);
    double half = (shifted - NEAREST) * 0.5 + NEAREST;
    double value = 1 + (r.high + exponential_tail(r));
    return value * power_of_two(tn_bits_of(half)) * power_of_two(tn_bits_of(shifted) - tn_bits_of(half));
}

static inline double exp_kernel(double x)
{
    double value = exponential((pair){x, 0});
    return __builtin_fabs(x) <= 750 ? value : NOTHING;
}

static double exp_rarely(double x)
{
    return isnan(x) ? x : x > 0 ? INFINITY : 0;
}

TN_FUNCTION_OF_1(exp)

/* ---- logarithm */

/* ln(i/32) for i = 23 and up, its first part a multiple of 2^-40. */
#define LEAST_OF_TABLE 23
static const pair logarithms[] = {
    {-0x1.522ae0738c000p-2, 0x1.c2831efd36715p-42},  {-0x1.269621134c000p-2, -0x1.b92783beb7677p-42},
    {-0x1.f991c6cb38000p-3, -0x1.9bcbecca0cdf3p-42}, {-0x1.a93ed3c8b0000p-3, 0x1.30e486a0ac42dp-42},
    {-0x1.5bf406b540000p-3, -0x1.ed8fdc149767ep-42}, {-0x1.1178e82280000p-3, 0x1.b8421cc74be04p-43},
    {-0x1.9335e5d590000p-4, -0x1.2622b8757a8fbp-42}, {-0x1.08598b59e0000p-4, -0x1.d034451fecdfbp-43},
    {-0x1.0415d89e80000p-5, 0x1.77771fd187145p-42},  {0, 0},
    {0x1.f829b0e780000p-6, 0x1.980267c7e09e4p-45},   {0x1.f0a30c0120000p-5, -0x1.3ab33d066d1d2p-42},
    {0x1.6f0d28ae50000p-4, 0x1.ad2e6f9266e7bp-42},   {0x1.e27076e2b0000p-4, -0x1.a342c2af0003cp-45},
    {0x1.29552f8200000p-3, -0x1.5b967f4471dfcp-44},  {0x1.5ff3070a78000p-3, 0x1.3d3c873e20a07p-43},
    {0x1.9525a9cf48000p-3, -0x1.4a5c4df67c564p-42},  {0x1.c8ff7c79a8000p-3, 0x1.a21ac25d81ef3p-43},
    {0x1.fb9186d5e0000p-3, 0x1.f1546aaa3361cp-42},   {0x1.1675cababc000p-2, -0x1.9f1fc63382a8fp-42},
    {0x1.2e8e2bae10000p-2, 0x1.d309c2cc91a85p-42},   {0x1.4618bc21c4000p-2, 0x1.ec27d0b7b37b3p-42},
    {0x1.5d1bdbf580000p-2, 0x1.394a11b1c1ee4p-43},
};

/* ln(x 2^more) for normal x > 0, to about 2^-66 of its value: x = 2^k m with m from sqrt(1/2) to sqrt(2); c is the
 * nearest of the table to m; s = (m - c) / (m + c); ln m = ln c + 2s + 2s^3/3 + 2s^5/5 + ... */
static inline pair logarithm(double x, double more)
{
    static const double series[] = {2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9};
    uint64_t bits = tn_bits_of(x);
    uint64_t exponent = (bits - 0x3fe6a09e667f3bcdu + ((uint64_t)1023 << 52)) >> 52; /* bits of sqrt(1/2) */
    double k = tn_double_of(exponent | 0x4330000000000000u) - (0x1p52 + 1023) + more;
    double m = tn_double_of(bits - ((exponent - 1023) << 52));
    double shifted = m * 32 + NEAREST, c = (shifted - NEAREST) * 0x1p-5;
    double dh = head(m + c), dl = m - (dh - c), over = 1 / (m + c);
    double s = (m - c) * over, sh = head(s), sl = (((m - c) - sh * dh) - sh * dl) * over;
    double z = s * s, tail = 2 * sl + s * (z * horner(series, 4, z));
    const pair *of_c = &logarithms[(tn_bits_of(shifted) & 63) - LEAST_OF_TABLE];
    pair first = quick_sum(k * LN2_FIRST + of_c->high, 2 * sh); /* the sum before is exact */
    return quick_sum(first.high, first.low + (tail + (of_c->low + k * LN2_REST)));
}

static inline double log_kernel(double x)
{
    pair l = logarithm(x, 0);
    return ((x >= 0x1p-1022) & (x < INFINITY)) ? l.high : NOTHING;
}

static double log_rarely(double x)
{
    if (x == 0)
        return -INFINITY;
    if (x < 0)
        return NAN;
    return isfinite(x) ? logarithm(x * 0x1p54, -54).high : x;
}

TN_FUNCTION_OF_1(log)

/* ---- powers */

/* e^(l y) */
static inline double raised(pair l, double y)
{
    pair p = product(l.high, y);
    double value = exponential((pair){p.high, p.low + l.low * y});
    return __builtin_fabs(p.high) <= 750 ? value : NOTHING;
}

static inline double pow_kernel(double x, double y)
{
    double value = raised(logarithm(x, 0), y);
    return ((x >= 0x1p-1022) & (x < INFINITY) & (__builtin_fabs(y) <= 0x1p500)) ? value : NOTHING;
}

/* 0: not a whole number; 1: odd; 2: even */
static int parity(double y)
{
    if (!isfinite(y) || y != rint(y))
        return isinf(y) ? 2 : 0;
    return fmod(y, 2) == 0 ? 2 : 1;
}

/* Of 0 and infinities; NAN where it is not one of these. */
static double power_of_extremes(double magnitude, double y)
{
    if (magnitude == 0)
        return y < 0 ? INFINITY : 0;
    if (isinf(y))
        return magnitude == 1 ? 1 : (magnitude > 1) == (y > 0) ? INFINITY : 0;
    return !isinf(magnitude) ? NAN : y > 0 ? INFINITY : 0;
}

static double pow_rarely(double x, double y)
{
    if (y == 0 || x == 1)
        return 1;
    if (isnan(x) || isnan(y))
        return x + y;
    int whole = parity(y);
    double sign = signbit(x) && whole == 1 ? -1 : 1, magnitude = fabs(x);
    double extreme = power_of_extremes(magnitude, y);
    if (!isnan(extreme))
        return sign * extreme;
    if (x < 0 && whole == 0)
        return NAN;
    pair l = magnitude < 0x1p-1022 ? logarithm(magnitude * 0x1p54, -54) : logarithm(magnitude, 0);
    if (fabs(l.high) * fabs(y) > 750)
        return sign * ((l.high > 0) == (y > 0) ? INFINITY : 0);
    return sign * raised(l, y);
}

TN_FUNCTION_OF_2(pow)

/* ---- hyperbolic tangent */

/* (e^2x - 1) / (e^2x + 1); from 22 on it is 1 to the last bit. What is not a number stays that. */
static inline double tanh_kernel(double x)
{
    double size = __builtin_fabs(x), shifted;
    pair r = reduce_by_ln2((pair){2 * (size > 22 ? 22 : size), 0}, &shifted);
    double scale = power_of_two(tn_bits_of(shifted));
    pair less = sum(scale - 1, scale * r.high);
    less = quick_sum(less.high, less.low + scale * exponential_tail(r));
    pair more = sum(less.high, 2);
    pair t = pair_divide(less, (pair){more.high, more.low + less.low});
    return tn_double_of(tn_bits_of(t.high) | (tn_bits_of(x) & SIGN_BIT));
}

static double tanh_rarely(double x)
{
    return x; /* no number */
}

TN_FUNCTION_OF_1(tanh)
