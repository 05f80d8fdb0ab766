/* Computes the angle of a point, by the arc tangent of its slope. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "runtime/numeric/numeric.h"
#include "runtime/numeric/pair.h"

static const pair half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
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
