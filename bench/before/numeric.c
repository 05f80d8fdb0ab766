/* The elementary functions as they were before rows of numbers (version 1 of the arithmetic): what bench_numeric
 * compares with. Nothing else uses them. */
#include "bench/before/numeric.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* Where one double is not enough, values are the unevaluated sum of two (Dekker, "A floating-point technique for
 * extending the available precision", 1971). */
typedef struct pair {
    double high, low;
} pair;

static pair quick_sum(double a, double b) /* |a| >= |b| */
{
    double s = a + b;
    return (pair){s, b - (s - a)};
}

static pair sum(double a, double b)
{
    double s = a + b, t = s - a;
    return (pair){s, (a - (s - t)) + (b - t)};
}

static pair product(double a, double b)
{
    double p = a * b;
    double ta = a * 134217729.0, tb = b * 134217729.0; /* 2^27 + 1 splits a double in two halves */
    double ah = ta - (ta - a), al = a - ah, bh = tb - (tb - b), bl = b - bh;
    return (pair){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

static pair pair_add(pair a, pair b)
{
    pair s = sum(a.high, b.high);
    return quick_sum(s.high, s.low + (a.low + b.low));
}

static pair pair_multiply(pair a, pair b)
{
    pair p = product(a.high, b.high);
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

static pair pair_divide(pair a, pair b)
{
    double q = a.high / b.high;
    pair p = product(q, b.high);
    double rest = ((a.high - p.high) - p.low) + a.low - q * b.low;
    return quick_sum(q, rest / b.high);
}

/* ---- sine and cosine */

/* The binary digits of 2/pi, enough for the largest double. */
static const uint64_t two_over_pi[] = {
    0xa2f9836e4e441529u, 0xfc2757d1f534ddc0u, 0xdb6295993c439041u, 0xfe5163abdebbc561u, 0xb7246e3a424dd2e0u,
    0x06492eea09d1921cu, 0xfe1deb1cb129a73eu, 0xe88235f52ebb4484u, 0xe99c7026b45f7e41u, 0x3991d639835339f4u,
    0x9c845f8bbdf9283bu, 0x1ff897ffde05980fu, 0xef2f118b5a0a6d1fu, 0x6d367ecf27cb09b7u, 0x4f463f669e5fea2du,
    0x7527bac7ebe5f17bu, 0x3d0739f78a5292eau, 0x6bfb5fb11f8d5d08u, 0x56033046fc7b6babu, 0xf0cfbc209af4361du,
    0xa9e391615ee61b08u,
};

static const pair half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

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

static double horner(const double *coefficients, int count, double z)
{
    double sum_so_far = coefficients[count - 1];
    for (int i = count - 2; i >= 0; i--)
        sum_so_far = sum_so_far * z + coefficients[i];
    return sum_so_far;
}

/* |r| <= pi/4: the series of the sine; its first term carries the low part. */
static double sine_of(pair r)
{
    static const double c[] = {-1.0 / 6,
                               1.0 / 120,
                               -1.0 / 5040,
                               1.0 / 362880,
                               -1.0 / 39916800,
                               1.0 / 6227020800.0,
                               -1.0 / 1307674368000.0,
                               1.0 / 355687428096000.0};
    double z = r.high * r.high;
    return r.high + (r.high * z * horner(c, 8, z) + r.low * (1 - 0.5 * z));
}

static double cosine_of(pair r)
{
    static const double c[] = {1.0 / 24,
                               -1.0 / 720,
                               1.0 / 40320,
                               -1.0 / 3628800,
                               1.0 / 479001600.0,
                               -1.0 / 87178291200.0,
                               1.0 / 20922789888000.0,
                               -1.0 / 6402373705728000.0};
    double z = r.high * r.high, half = 0.5 * z, first = 1 - half;
    return first + (((1 - first) - half) + (z * z * horner(c, 8, z) - r.high * r.low));
}

static double sine_in_quadrant(double x, unsigned turn)
{
    if (!isfinite(x))
        return x - x;
    unsigned quadrant = 0;
    pair r = {x, 0};
    if (fabs(x) > 0.78) /* a little under pi/4: the series hold there too */
        r = reduce(x, &quadrant);
    switch ((quadrant + turn) & 3) {
    case 0:
        return sine_of(r);
    case 1:
        return cosine_of(r);
    case 2:
        return -sine_of(r);
    default:
        return -cosine_of(r);
    }
}

double before_sin(double x)
{
    if (fabs(x) < 0x1p-27) /* also keeps the sign of zero */
        return x;
    return sine_in_quadrant(x, 0);
}

double before_cos(double x)
{
    return sine_in_quadrant(x, 1);
}

/* ---- exponential */

static const pair third = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
static const pair fifth = {0x1.999999999999ap-3, -0x1.999999999999ap-57};
static const pair sixth = {0x1.5555555555555p-3, 0x1.5555555555555p-57};
static const double inverse_ln2 = 0x1.71547652b82fep+0;
/* ln 2 in three parts; a whole number below 2^20 times either of the first two is exact. */
static const double ln2_first = 0x1.62e42feep-1, ln2_second = 0x1.a39ef35792p-33, ln2_third = 0x1.c7673007e5ed6p-73;

/* e^r - 1 for |r| <= 0.36, to about 2^-62 of its value: the series, its first three terms in pairs. */
static pair exponential_less_one(pair r)
{
    static const double c[] = {1.0 / 24,        1.0 / 120,          1.0 / 720,          1.0 / 5040,
                               1.0 / 40320,     1.0 / 362880,       1.0 / 3628800,      1.0 / 39916800,
                               1.0 / 479001600, 1.0 / 6227020800.0, 1.0 / 87178291200.0};
    double z = r.high, tail = z * horner(c, 11, z);
    pair s = pair_add(sixth, (pair){tail, 0});
    s = pair_add((pair){0.5, 0}, pair_multiply(r, s));
    s = pair_add((pair){1, 0}, pair_multiply(r, s));
    return pair_multiply(r, s);
}

/* x = k ln 2 + r */
static pair reduce_by_ln2(pair x, double *k)
{
    *k = rint(x.high * inverse_ln2);
    pair r = sum(x.high - *k * ln2_first, -*k * ln2_second);
    return pair_add(r, (pair){x.low - *k * ln2_third, 0});
}

static double exponential(pair x)
{
    if (x.high > 710)
        return INFINITY;
    if (x.high < -746)
        return 0;
    double k;
    pair e = exponential_less_one(reduce_by_ln2(x, &k));
    pair whole = quick_sum(1, e.high);
    return ldexp(whole.high + (whole.low + e.low), (int)k);
}

double before_exp(double x)
{
    return isnan(x) ? x : exponential((pair){x, 0});
}

/* ---- logarithm */

/* ln x for finite x > 0, to about 2^-68 of its value: x = 2^k m, s = (m-1)/(m+1), ln m = 2s + 2s^3/3 + 2s^5/5 + ... */
static pair logarithm(double x)
{
    static const double c[] = {1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13, 1.0 / 15,
                               1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25};
    int k;
    double m = frexp(x, &k);
    if (m < 0x1.6a09e667f3bcdp-1) { /* sqrt(1/2) */
        m *= 2;
        k--;
    }
    pair s = pair_divide((pair){m - 1, 0}, sum(m, 1));
    pair z = pair_multiply(s, s);
    pair t = pair_add(fifth, (pair){z.high * horner(c, 10, z.high), 0});
    t = pair_add(third, pair_multiply(z, t));
    t = pair_add((pair){1, 0}, pair_multiply(z, t));
    t = pair_multiply(s, t);
    t = (pair){2 * t.high, 2 * t.low};
    pair whole = pair_add((pair){k * ln2_first, 0}, (pair){k * ln2_second, k * ln2_third});
    return pair_add(whole, t);
}

double before_log(double x)
{
    if (x == 0)
        return -INFINITY;
    if (x < 0)
        return NAN;
    if (!isfinite(x))
        return x;
    pair l = logarithm(x);
    return l.high + l.low;
}

/* ---- powers */

/* 0: not a whole number; 1: odd; 2: even */
static int parity(double y)
{
    if (!isfinite(y) || y != rint(y))
        return isinf(y) ? 2 : 0;
    return fmod(y, 2) == 0 ? 2 : 1;
}

double before_pow(double x, double y)
{
    if (y == 0 || x == 1)
        return 1;
    if (isnan(x) || isnan(y))
        return x + y;
    int whole = parity(y);
    double sign = signbit(x) && whole == 1 ? -1 : 1, magnitude = fabs(x);
    if (magnitude == 0)
        return y < 0 ? sign * INFINITY : sign * 0.0;
    if (isinf(y)) {
        if (magnitude == 1)
            return 1;
        return (magnitude > 1) == (y > 0) ? INFINITY : 0;
    }
    if (isinf(magnitude))
        return y > 0 ? sign * INFINITY : sign * 0.0;
    if (x < 0 && whole == 0)
        return NAN;
    pair l = logarithm(magnitude);
    if (fabs(l.high) * fabs(y) > 800) /* past the ends of the range, where products of pairs could overflow */
        return sign * ((l.high > 0) == (y > 0) ? INFINITY : 0);
    return sign * exponential(pair_multiply(l, (pair){y, 0}));
}

/* ---- arc tangent */

/* atan(i / 32), of which the argument leaves at most 1/64. */
static const pair arc_tangents[] = {
    {0, 0},
    {0x1.ffd55bba97625p-6, -0x1.5ec431444912cp-60},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.7ee182602f10fp-4, -0x1.cfb654c0c3d98p-58},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.3d6eee8c6626cp-3, 0x1.61a3b0ce9281bp-57},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.b90d7529260a2p-3, 0x1.17b10d2e0e5abp-61},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.18bf5a30bf178p-2, 0x1.30ca4748b1bf9p-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.530ad9951cd4ap-2, -0x1.2566480884082p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.8b24d394a1b25p-2, 0x1.b6d0ba3748fa8p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.c0db4c94ec9f0p-2, -0x1.cc1ce70934c34p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.f40dd0b541418p-2, -0x1.a3992dc382a23p-57},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1255d9bfbd2a9p-1, -0x1.2bdaee1c0ee35p-58},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.2958e59308e31p-1, -0x1.09e73b0c6c087p-56},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.3f13fb89e96f4p-1, 0x1.ecf8b492644f0p-56},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.538f57b89061fp-1, -0x1.1bb74abda520cp-55},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.66d663923e087p-1, -0x1.6ea6febe8bbbap-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.78f6bbd5d315ep-1, 0x1.406a089803740p-55},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.89ff5ff57f1f8p-1, -0x1.55b9a5e177a1bp-55},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

/* 0 < n <= d, both near 1. */
static pair arc_tangent(double n, double d)
{
    static const double c[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13};
    int i = (int)rint(n / d * 32);
    double base = i / 32.0;
    pair over = product(base, d), under = product(base, n);
    pair t = pair_divide(pair_add((pair){n, 0}, (pair){-over.high, -over.low}), pair_add((pair){d, 0}, under));
    double z = t.high * t.high;
    return pair_add(arc_tangents[i], quick_sum(t.high, t.low + t.high * z * horner(c, 6, z)));
}

double before_atan2(double y, double x)
{
    if (isnan(x) || isnan(y))
        return x + y;
    double n = fabs(y), d = fabs(x), sign = signbit(y) ? -1 : 1;
    if (isinf(n) && isinf(d))
        n = d = 1;
    bool steep = n > d;
    if (steep) {
        double other = n;
        n = d;
        d = other;
    }
    pair angle = {0, 0};
    int exponent = 0;
    frexp(d, &exponent);
    double scaled = ldexp(n, -exponent);
    if (n != 0 && !isinf(d) && scaled > 0x1p-60)
        angle = arc_tangent(scaled, ldexp(d, -exponent));
    else if (n != 0 && !isinf(d) && !steep && !signbit(x))
        return sign * (n / d);
    if (steep)
        angle = pair_add(half_pi, (pair){-angle.high, -angle.low});
    if (signbit(x))
        angle = pair_add((pair){2 * half_pi.high, 2 * half_pi.low}, (pair){-angle.high, -angle.low});
    return sign * (angle.high + angle.low);
}

/* ---- hyperbolic tangent */

double before_tanh(double x)
{
    double magnitude = fabs(x);
    if (isnan(x) || magnitude < 0x1p-28)
        return x;
    if (magnitude > 22)
        return x < 0 ? -1 : 1;
    double k;
    pair e = exponential_less_one(reduce_by_ln2((pair){2 * magnitude, 0}, &k)); /* e^2x - 1 = 2^k e + (2^k - 1) */
    double scale = ldexp(1, (int)k);
    pair less = pair_add((pair){scale - 1, 0}, (pair){scale * e.high, scale * e.low});
    pair t = pair_divide(less, pair_add(less, (pair){2, 0}));
    double result = t.high + t.low;
    return x < 0 ? -result : result;
}
