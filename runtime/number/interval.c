/* Computes with intervals: for each operation one that holds all its values.
 *
 * IEEE 754 rounds sums, products, quotients and roots to the nearest number, so that one unit in the last place outward
 * holds the exact bound and every rounded value; functions of elementary.h are within one unit, and are given three.
 * Infinite operands of an expression are values like others.
 */
#include "runtime/number/interval.h"

#include <math.h>

#include "runtime/base/bytes.h"
#include "runtime/math/elementary.h"

static const tn_interval unbounded = {-INFINITY, INFINITY, true};
static const tn_interval none = {INFINITY, -INFINITY, true};

static double above(double x)
{
    if (x != x || x == INFINITY)
        return INFINITY;
    if (x == 0)
        return 0x1p-1074;
    uint64_t bits = tn_bits_of(x);
    return tn_double_of(x > 0 ? bits + 1 : bits - 1);
}

static double below(double x)
{
    return -above(-x);
}

tn_interval tn_interval_around(double low, double high, bool fails)
{
    return (tn_interval){below(low), above(high), fails};
}

/* Of a function that is within a unit of the exact value. */
static tn_interval widely(double low, double high, bool fails)
{
    return (tn_interval){below(below(below(low))), above(above(above(high))), fails};
}

static bool is_infinite(tn_interval a)
{
    return a.low == -INFINITY || a.high == INFINITY;
}

static bool has_zero(tn_interval a)
{
    return a.low <= 0 && a.high >= 0;
}

static double least_of(double a, double b)
{
    return a < b ? a : b;
}

static double most_of(double a, double b)
{
    return a > b ? a : b;
}

/* ---- arithmetic */

static tn_interval bounds_negative(tn_interval a)
{
    return (tn_interval){-a.high, -a.low, a.fails};
}

static tn_interval bounds_sum(tn_interval a, tn_interval b)
{
    bool opposed = (a.high == INFINITY && b.low == -INFINITY) || (a.low == -INFINITY && b.high == INFINITY);
    return tn_interval_around(a.low + b.low, a.high + b.high, a.fails || b.fails || opposed);
}

/* The least and the greatest of four. */
static tn_interval around_four(const double v[4], bool fails)
{
    return tn_interval_around(least_of(least_of(v[0], v[1]), least_of(v[2], v[3])),
                              most_of(most_of(v[0], v[1]), most_of(v[2], v[3])), fails);
}

/* Nothing times infinity has no value where it is met; near it there is any. */
static double times(double a, double b)
{
    return a == 0 || b == 0 ? 0 : a * b;
}

static tn_interval bounds_product(tn_interval a, tn_interval b)
{
    bool fails = a.fails || b.fails || (has_zero(a) && is_infinite(b)) || (has_zero(b) && is_infinite(a));
    double v[4] = {times(a.low, b.low), times(a.low, b.high), times(a.high, b.low), times(a.high, b.high)};
    return around_four(v, fails);
}

static tn_interval bounds_quotient(tn_interval a, tn_interval b)
{
    bool fails = a.fails || b.fails || (is_infinite(a) && is_infinite(b)) || (has_zero(a) && has_zero(b));
    if (has_zero(b) || (is_infinite(a) && is_infinite(b)))
        return (tn_interval){-INFINITY, INFINITY, fails};
    double v[4] = {a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high};
    return around_four(v, fails);
}

static tn_interval bounds_absolute(tn_interval a)
{
    if (a.low >= 0)
        return a;
    return a.high <= 0 ? bounds_negative(a) : (tn_interval){0, most_of(-a.low, a.high), a.fails};
}

static tn_interval bounds_square(tn_interval a)
{
    tn_interval size = bounds_absolute(a);
    double low = below(size.low * size.low);
    return (tn_interval){low > 0 ? low : 0, above(size.high * size.high), a.fails};
}

static tn_interval bounds_least(tn_interval a, tn_interval b)
{
    return (tn_interval){least_of(a.low, b.low), least_of(a.high, b.high), a.fails || b.fails};
}

static tn_interval bounds_most(tn_interval a, tn_interval b)
{
    return (tn_interval){most_of(a.low, b.low), most_of(a.high, b.high), a.fails || b.fails};
}

static tn_interval bounds_floor(tn_interval a)
{
    return (tn_interval){floor(a.low), floor(a.high), a.fails};
}

/* Within one period of a number the remainder rises; else it is anything between 0 and the divisor. */
static tn_interval bounds_remainder(tn_interval a, tn_interval b)
{
    bool fails = a.fails || b.fails || has_zero(b) || is_infinite(a);
    if (b.low == b.high && b.low > 0 && a.high - a.low < b.low) {
        double low = fmod(a.low, b.low), high = fmod(a.high, b.low);
        low += low < 0 ? b.low : 0;
        high += high < 0 ? b.low : 0;
        if (low <= high)
            return tn_interval_around(low, high, fails);
    }
    return (tn_interval){least_of(b.low, 0), most_of(b.high, 0), fails};
}

/* ---- functions */

static tn_interval bounds_rising(tn_interval a, double (*function)(double))
{
    return widely(function(a.low), function(a.high), a.fails);
}

static tn_interval bounds_root(tn_interval a)
{
    if (a.high < 0)
        return none;
    return tn_interval_around(a.low > 0 ? sqrt(a.low) : 0, sqrt(a.high), a.fails || a.low < 0);
}

static tn_interval bounds_logarithm(tn_interval a)
{
    if (a.high < 0)
        return none;
    return widely(a.low > 0 ? tn_log(a.low) : -INFINITY, tn_log(a.high), a.fails || a.low < 0);
}

/* Is there a whole number n with low <= place + n * 2 pi <= high? Yes, where rounding leaves it open. */
static bool meets(tn_interval a, double place)
{
    const double turn = 6.283185307179586;
    return ceil((a.low - place) / turn - 1e-9) <= floor((a.high - place) / turn + 1e-9);
}

static tn_interval bounds_wave(tn_interval a, double (*wave)(double), double crest, double trough)
{
    bool fails = a.fails || is_infinite(a);
    if (!(a.high - a.low < 7) || fabs(a.low) > 1e6 || fabs(a.high) > 1e6) /* 1e-9 of a turn is a safe margin below */
        return tn_interval_around(-1, 1, fails);
    double low = wave(a.low), high = wave(a.high);
    return widely(meets(a, trough) ? -1 : least_of(low, high), meets(a, crest) ? 1 : most_of(low, high), fails);
}

static tn_interval bounds_sine(tn_interval a)
{
    return bounds_wave(a, tn_sin, 1.5707963267948966, -1.5707963267948966);
}

static tn_interval bounds_cosine(tn_interval a)
{
    return bounds_wave(a, tn_cos, 0, 3.141592653589793);
}

/* Over a rectangle that neither holds the centre nor meets the cut the extremes are at its corners. */
static tn_interval bounds_angle(tn_interval y, tn_interval x)
{
    bool fails = y.fails || x.fails;
    if (!(x.low > 0 || y.low > 0 || y.high < 0))
        return tn_interval_around(-3.1415926535897936, 3.1415926535897936, fails);
    double v[4] = {tn_atan2(y.low, x.low), tn_atan2(y.low, x.high), tn_atan2(y.high, x.low), tn_atan2(y.high, x.high)};
    tn_interval all = around_four(v, fails);
    return widely(all.low, all.high, fails);
}

/* Of a base that is not negative the extremes are at the ends. */
static tn_interval bounds_power(tn_interval a, tn_interval b)
{
    if (!(a.low >= 0))
        return unbounded;
    double v[4] = {tn_pow(a.low, b.low), tn_pow(a.low, b.high), tn_pow(a.high, b.low), tn_pow(a.high, b.high)};
    for (int i = 0; i < 4; i++)
        if (v[i] != v[i])
            return unbounded;
    bool fails = a.fails || b.fails, turns = has_zero(b) || (a.low <= 1 && a.high >= 1); /* there it is 1 */
    tn_interval all = around_four(v, fails);
    return widely(turns ? least_of(all.low, 1) : all.low, turns ? most_of(all.high, 1) : all.high, fails);
}

static tn_interval bounds_blend(tn_interval a, tn_interval b, tn_interval k)
{
    if (k.high < 0)
        return none;
    bool same = (a.high == INFINITY && b.high == INFINITY) || (a.low == -INFINITY && b.low == -INFINITY);
    tn_interval least = bounds_least(a, b);
    return widely(least.low - k.high / 4, least.high,
                  a.fails || b.fails || k.fails || k.low < 0 || same || k.high == INFINITY);
}

static tn_interval bounds_noise(tn_interval a, tn_interval b, tn_interval c)
{
    double reach = 2147483647;
    bool within =
        a.low > -reach && a.high < reach && b.low > -reach && b.high < reach && c.low > -reach && c.high < reach;
    return (tn_interval){-1.1, 1.1, a.fails || b.fails || c.fails || !within};
}

/* ---- conditions: 1 and 0 */

static tn_interval judged(bool always, bool never, bool fails)
{
    return (tn_interval){always ? 1 : 0, never ? 0 : 1, fails};
}

static tn_interval bounds_below(tn_interval a, tn_interval b)
{
    return judged(a.high < b.low, a.low >= b.high, a.fails || b.fails);
}

static tn_interval bounds_at_most(tn_interval a, tn_interval b)
{
    return judged(a.high <= b.low, a.low > b.high, a.fails || b.fails);
}

static tn_interval bounds_equal(tn_interval a, tn_interval b)
{
    bool one = a.low == a.high && b.low == b.high && a.low == b.low;
    return judged(one, a.high < b.low || b.high < a.low, a.fails || b.fails);
}

static tn_interval bounds_both(tn_interval a, tn_interval b)
{
    bool never = (a.low == 0 && a.high == 0) || (b.low == 0 && b.high == 0);
    return judged(!has_zero(a) && !has_zero(b), never, a.fails || b.fails);
}

static tn_interval bounds_not(tn_interval a)
{
    return judged(a.low == 0 && a.high == 0, !has_zero(a), a.fails);
}

/* ---- all of them */

#define UNBOUNDED unbounded
#define INTERVALS_1                                                                                                    \
    tn_interval A = *operands[0];                                                                                      \
    if (tn_interval_is_none(A))                                                                                        \
        return none;
#define INTERVALS_2                                                                                                    \
    INTERVALS_1 tn_interval B = *operands[1];                                                                          \
    if (tn_interval_is_none(B))                                                                                        \
        return none;
#define INTERVALS_3                                                                                                    \
    INTERVALS_2 tn_interval C = *operands[2];                                                                          \
    if (tn_interval_is_none(C))                                                                                        \
        return none;
#define UNUSED_1 (void)A;
#define UNUSED_2 UNUSED_1(void) B;
#define UNUSED_3 UNUSED_2(void) C;

tn_interval tn_operation_bounds(tn_opcode opcode, const tn_interval *const *operands)
{
    if (opcode == TN_OP_MULTIPLY && operands[0] == operands[1])
        return tn_interval_is_none(*operands[0]) ? none : bounds_square(*operands[0]);
    switch (opcode) {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    case TN_OP_##NAME: {                                                                                               \
        INTERVALS_##ARITY UNUSED_##ARITY return BOUNDS;                                                                \
    }
#include "runtime/module/operations.def"
#undef OPERATION
    default:
        return unbounded;
    }
}
