/* Computes sines and cosines: the argument is brought within pi/4 of a multiple of pi/2, and a series does the rest. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "runtime/numeric/numeric.h"
#include "runtime/numeric/pair.h"

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
