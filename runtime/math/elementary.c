/* Elementary functions: each is a kernel without branches, which compilers turn into code for many numbers at once, and
 * a plain function for the few numbers that are not for the kernel. */
#include "runtime/math/elementary.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "runtime/base/bytes.h"
#include "runtime/math/any_width.h"

typedef struct pair {
    double high, low;
} pair;

/* Added to a number below 2^51, it leaves the nearest whole number in the last bits; taken away, that number. */
#define NEAREST 0x1.8p52

/* The first 26 bits: products of two such numbers are exact. */
static inline double head(double a)
{
    return tn_double_of(tn_bits_of(a) & ~(uint64_t)0x7ffffff);
}

static inline pair quick_sum(double a, double b) /* |a| >= |b|, or a = 0 */
{
    double s = a + b;
    return (pair){s, b - (s - a)};
}

static inline pair sum(double a, double b)
{
    double s = a + b, t = s - a;
    return (pair){s, (a - (s - t)) + (b - t)};
}

static inline pair product(double a, double b)
{
    double p = a * b, ah = head(a), al = a - ah, bh = head(b), bl = b - bh;
    return (pair){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

static inline pair pair_divide(pair a, pair b)
{
    double over = 1 / b.high, q = a.high * over;
    pair p = product(q, b.high);
    double rest = ((a.high - p.high) - p.low) + a.low - q * b.low;
    return quick_sum(q, rest * over);
}

/* c[0] + c[1] z + ... */
static inline double horner(const double *c, int count, double z)
{
    double so_far = c[count - 1];
    for (int i = count - 2; i >= 0; i--)
        so_far = so_far * z + c[i];
    return so_far;
}

/* Where `test` holds a, else b: by bits, so that both are computed. */
static inline double choose(uint64_t all_ones_or_none, double a, double b)
{
    return tn_double_of((tn_bits_of(a) & all_ones_or_none) | (tn_bits_of(b) & ~all_ones_or_none));
}

#define SIGN_BIT ((uint64_t)1 << 63)
#define NOTHING __builtin_nan("")

/* Makes tn_NAME and tn_NAME_row of NAME_kernel and NAME_rarely. */
#define TN_FUNCTION_OF_1(NAME)                                                                                         \
    double tn_##NAME(double x)                                                                                         \
    {                                                                                                                  \
        double value = NAME##_kernel(x);                                                                               \
        return value == value ? value : NAME##_rarely(x);                                                              \
    }                                                                                                                  \
    TN_ANY_WIDTH static bool NAME##_quickly(const double *restrict x, double *restrict out, size_t count)              \
    {                                                                                                                  \
        uint64_t rare = 0;                                                                                             \
        for (size_t i = 0; i < count; i++) {                                                                           \
            out[i] = NAME##_kernel(x[i]);                                                                              \
            rare |= out[i] != out[i];                                                                                  \
        }                                                                                                              \
        return rare;                                                                                                   \
    }                                                                                                                  \
    void tn_##NAME##_row(const double *x, double *out, size_t count)                                                   \
    {                                                                                                                  \
        if (!NAME##_quickly(x, out, count))                                                                            \
            return;                                                                                                    \
        for (size_t i = 0; i < count; i++)                                                                             \
            out[i] = out[i] == out[i] ? out[i] : NAME##_rarely(x[i]);                                                  \
    }

#define TN_FUNCTION_OF_2(NAME)                                                                                         \
    double tn_##NAME(double a, double b)                                                                               \
    {                                                                                                                  \
        double value = NAME##_kernel(a, b);                                                                            \
        return value == value ? value : NAME##_rarely(a, b);                                                           \
    }                                                                                                                  \
    TN_ANY_WIDTH static bool NAME##_quickly(const double *restrict a, const double *restrict b, double *restrict out,  \
                                            size_t count)                                                              \
    {                                                                                                                  \
        uint64_t rare = 0;                                                                                             \
        for (size_t i = 0; i < count; i++) {                                                                           \
            out[i] = NAME##_kernel(a[i], b[i]);                                                                        \
            rare |= out[i] != out[i];                                                                                  \
        }                                                                                                              \
        return rare;                                                                                                   \
    }                                                                                                                  \
    void tn_##NAME##_row(const double *a, const double *b, double *out, size_t count)                                  \
    {                                                                                                                  \
        if (!NAME##_quickly(a, b, out, count))                                                                         \
            return;                                                                                                    \
        for (size_t i = 0; i < count; i++)                                                                             \
            out[i] = out[i] == out[i] ? out[i] : NAME##_rarely(a[i], b[i]);                                            \
    }

/* ==== computes exponentials, logarithms, powers and hyperbolic tangents */

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

/* ==== computes sines and cosines: the argument is brought within pi/4 of a multiple of pi/2, and a series does the
 * rest */

static const pair half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/* |r| <= pi/4 and a little: (sin r - r) / r^3 and (cos r - 1 + r^2/2) / r^4 of r^2, within 2^-57 of the values. */
static inline double sine_of(pair r)
{
    static const double c[] = {-0x1.5555555555555p-3, 0x1.1111111111110p-7,   -0x1.a01a01a019927p-13,
                               0x1.71de3a545e95cp-19, -0x1.ae64540f4d1dbp-26, 0x1.61217c4c31493p-33,
                               -0x1.ab1635d19009bp-41};
    double z = r.high * r.high;
    return r.high + (r.high * z * horner(c, 7, z) + r.low * (1 - 0.5 * z));
}

static inline double cosine_of(pair r)
{
    static const double c[] = {0x1.5555555555555p-5,   -0x1.6c16c16c16960p-10, 0x1.a01a019f4d2b8p-16,
                               -0x1.27e4fa15e29e5p-22, 0x1.1eeb66dd1cdd4p-29,  -0x1.907c2a257c22cp-37};
    double z = r.high * r.high, half = 0.5 * z, first = 1 - half;
    return first + (((1 - first) - half) + (z * z * horner(c, 6, z) - r.high * r.low));
}

/* The sine of an angle of so many quarters of a turn and r more. */
static inline double sine_in_quarter(pair r, uint64_t quarter)
{
    double value = choose(0 - (quarter & 1), cosine_of(r), sine_of(r));
    return tn_double_of(tn_bits_of(value) ^ (quarter & 2) << 62);
}

/* pi/2 in four parts: a whole number up to 2^20 times any of the first three is exact (Cody and Waite, "Software Manual
 * for the Elementary Functions", 1980). */
#define QUARTERS_MAX 0x1p20
#define HALF_PI_1 0x1.921fb544p+0
#define HALF_PI_2 0x1.0b4611a6p-34
#define HALF_PI_3 0x1.3198a2ep-69
#define HALF_PI_4 0x1.b839a252049c1p-104
#define TWO_OVER_PI 0x1.45f306dc9c883p-1

static inline double sine_kernel(double x, uint64_t turn)
{
    double shifted = x * TWO_OVER_PI + NEAREST, quarters = shifted - NEAREST;
    pair a = sum(x - quarters * HALF_PI_1, -(quarters * HALF_PI_2));
    pair b = sum(a.high, -(quarters * HALF_PI_3));
    pair r = quick_sum(b.high, b.low + (a.low - quarters * HALF_PI_4));
    double value = sine_in_quarter(r, tn_bits_of(shifted) + turn);
    return __builtin_fabs(x) <= QUARTERS_MAX ? value : NOTHING;
}

static inline double sin_kernel(double x)
{
    double value = sine_kernel(x, 0);
    return x == 0 ? x : value; /* keeps the sign of zero */
}

static inline double cos_kernel(double x)
{
    return sine_kernel(x, 1);
}

/* ---- large angles */

/* The binary digits of 2/pi, enough for the largest double. */
static const uint64_t two_over_pi[] = {
    0xa2f9836e4e441529u, 0xfc2757d1f534ddc0u, 0xdb6295993c439041u, 0xfe5163abdebbc561u, 0xb7246e3a424dd2e0u,
    0x06492eea09d1921cu, 0xfe1deb1cb129a73eu, 0xe88235f52ebb4484u, 0xe99c7026b45f7e41u, 0x3991d639835339f4u,
    0x9c845f8bbdf9283bu, 0x1ff897ffde05980fu, 0xef2f118b5a0a6d1fu, 0x6d367ecf27cb09b7u, 0x4f463f669e5fea2du,
    0x7527bac7ebe5f17bu, 0x3d0739f78a5292eau, 0x6bfb5fb11f8d5d08u, 0x56033046fc7b6babu, 0xf0cfbc209af4361du,
    0xa9e391615ee61b08u,
};

static uint64_t digits_at(int64_t bit) /* 64 digits of 2/pi after the first `bit`; digits before the point are 0 */
{
    const int64_t words = sizeof two_over_pi / sizeof *two_over_pi;
    int64_t word = bit >> 6;
    int shift = (int)(bit & 63);
    uint64_t first = word >= 0 && word < words ? two_over_pi[word] : 0;
    uint64_t next = word + 1 >= 0 && word + 1 < words ? two_over_pi[word + 1] : 0;
    return shift ? first << shift | next >> (64 - shift) : first;
}

__extension__ typedef unsigned __int128 wide;

static pair pair_multiply(pair a, pair b)
{
    pair p = product(a.high, b.high);
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/* x = quadrant * pi/2 + r with |r| <= pi/4 (Payne and Hanek: only the digits of 2/pi that matter modulo 4). */
static pair reduce(double x, unsigned *quadrant)
{
    int exponent;
    double magnitude = frexp(fabs(x), &exponent);
    uint64_t mantissa = (uint64_t)ldexp(magnitude, 53), part[4];
    int64_t first = (int64_t)exponent - 53 - 2; /* digits before this give multiples of 4 */
    wide carry = 0;
    for (int i = 3; i >= 0; i--) {
        carry += (wide)mantissa * digits_at(first + 64 * i);
        part[i] = (uint64_t)carry;
        carry >>= 64;
    }
    unsigned q = (unsigned)(part[0] >> 62);
    bool negative = part[0] >> 61 & 1; /* past the middle: count back from the next quadrant */
    uint64_t f[3];
    for (int i = 0; i < 3; i++)
        f[i] = part[i] << 2 | part[i + 1] >> 62;
    if (negative) {
        q++;
        for (int i = 0; i < 3; i++)
            f[i] = ~f[i];
    }
    int skip = 0; /* leading zeros: x may lie very near a multiple of pi/2 */
    while (!(f[0] >> 63) && skip < 128) {
        f[0] = f[0] << 1 | f[1] >> 63;
        f[1] = f[1] << 1 | f[2] >> 63;
        f[2] <<= 1;
        skip++;
    }
    double high = (double)(f[0] >> 11), low = (double)((f[0] & 0x7ff) << 42 | f[1] >> 22);
    pair fraction = quick_sum(ldexp(high, -53 - skip), ldexp(low, -106 - skip));
    pair r = pair_multiply(fraction, half_pi);
    bool turn = negative != (x < 0);
    *quadrant = x < 0 ? 0u - q : q;
    return turn ? (pair){-r.high, -r.low} : r;
}

static double sine_rarely(double x, unsigned turn)
{
    if (!isfinite(x))
        return x - x;
    unsigned quadrant;
    pair r = reduce(x, &quadrant);
    return sine_in_quarter(r, quadrant + turn);
}

static double sin_rarely(double x)
{
    return sine_rarely(x, 0);
}

static double cos_rarely(double x)
{
    return sine_rarely(x, 1);
}

TN_FUNCTION_OF_1(sin)
TN_FUNCTION_OF_1(cos)

/* ---- degrees */

double tn_sin_degrees(double degrees)
{
    double whole = fmod(degrees, 360), half_turns = whole / 30;
    if (half_turns == rint(half_turns)) {
        static const double twelfths[] = {0, 0.5, 0, 1, 0, 0.5, 0, -0.5, 0, -1, 0, -0.5};
        int i = (int)half_turns;
        i = i < 0 ? i + 12 : i;
        if (i % 3 == 0 || i % 2 == 1)
            return twelfths[i];
    }
    pair radians = pair_multiply((pair){whole, 0}, pair_divide(half_pi, (pair){90, 0}));
    return tn_sin(radians.high) + radians.low * tn_cos(radians.high);
}

double tn_cos_degrees(double degrees)
{
    return tn_sin_degrees(fmod(degrees, 360) + 90);
}

/* ==== computes the angle of a point, by the arc tangent of its slope */

static const pair of_half = {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56}; /* atan(1/2) */

/* Of coordinates whose larger one lies between 2^-500 and 2^500, and whose smaller one is not much smaller. Of the
 * slopes b = 0, 1/2 and 1 the nearest is taken off: the tangent of the angle between the directions (1, b) and (d, n)
 * is (n - b d) / (d + b n), at most 1/4, where n - b d is exact. */
static inline double atan2_kernel(double y, double x)
{
    /* (atan(t) - t) / t^3 for t^2 <= 1/16, within 2^-55 of the angle */
    static const double c[] = {-0x1.5555555555550p-2, 0x1.999999999432bp-3,  -0x1.2492491d772adp-3,
                               0x1.c71c6aa40998ep-4,  -0x1.745b535dfbc67p-4, 0x1.3ad6b411934cap-4,
                               -0x1.0c76e1ede1b78p-4, 0x1.832cd1c0d67b8p-5};
    double ay = __builtin_fabs(y), ax = __builtin_fabs(x), n = ay < ax ? ay : ax, d = ay < ax ? ax : ay;
    double over_quarter = n > 0.25 * d ? 0.5 : 0.0, over_half = n > 0.75 * d ? 0.5 : 0.0, b = over_quarter + over_half;
    double over_one = over_quarter - over_half, base = over_one * (2 * of_half.high) + over_half * half_pi.high;
    double base_rest = over_one * (2 * of_half.low) + over_half * half_pi.low;
    pair under = quick_sum(d, b * n);
    double over = 1 / under.high, dh = head(under.high), dl = under.low + (under.high - dh);
    double th = head((n - b * d) * over), tl = (((n - b * d) - th * dh) - th * dl) * over, t = th + tl;
    double z = t * t, tail = tl + t * (z * horner(c, 8, z));
    /* The angle is whole quarters of a turn, and so much more or less. */
    double steep = ay < ax ? 0.0 : 1.0, back = x < 0 ? 2.0 - 2.0 * steep : 0.0, quarters = steep + back;
    uint64_t less = (tn_bits_of(x) ^ tn_bits_of(0.5 - steep)) & SIGN_BIT;
    pair first = quick_sum(base, th);
    pair whole = quick_sum(quarters * half_pi.high, tn_double_of(tn_bits_of(first.high) ^ less));
    double rest = tn_double_of(tn_bits_of(first.low + (base_rest + tail)) ^ less);
    double value = whole.high + (whole.low + (quarters * half_pi.low + rest));
    value = tn_double_of(tn_bits_of(value) | (tn_bits_of(y) & SIGN_BIT));
    return ((d >= 0x1p-500) & (d <= 0x1p500) & (n >= d * 0x1p-60)) ? value : NOTHING;
}

static double atan2_rarely(double y, double x)
{
    if (isnan(x) || isnan(y))
        return x + y;
    double n = fabs(y), d = fabs(x), sign = signbit(y) ? -1 : 1;
    if (isinf(n) && isinf(d))
        return sign * atan2_kernel(1, signbit(x) ? -1 : 1);
    double larger = n > d ? n : d, smaller = n > d ? d : n;
    int exponent = 0;
    frexp(larger, &exponent);
    if (larger > 0 && !isinf(larger) && ldexp(smaller, -exponent) > 0x1p-59)
        return atan2_kernel(ldexp(y, -exponent), ldexp(x, -exponent));
    if (n > d)
        return sign * half_pi.high;
    if (signbit(x))
        return sign * 2 * half_pi.high;
    return n == 0 ? y : sign * (n / d);
}

TN_FUNCTION_OF_2(atan2)
