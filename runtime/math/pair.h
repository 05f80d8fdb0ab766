/* Numbers as unevaluated sums of two doubles, where one is not enough (Dekker, "A floating-point technique for
 * extending the available precision", 1971), and what the kernels of elementary functions share.
 *
 * A kernel is a function without branches, which compilers turn into code for many numbers at once. Where a number is
 * not for the kernel (too large, below 0, not a number ...) it gives what is not a number, and a plain function is
 * asked. So one number and a row of numbers take the same way, and give the same bits.
 */
#ifndef TARTAN_NUMERIC_PAIR_H
#define TARTAN_NUMERIC_PAIR_H

#include "runtime/base/bytes.h"
#include "runtime/numeric/any_width.h"

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

static inline pair pair_add(pair a, pair b)
{
    pair s = sum(a.high, b.high);
    return quick_sum(s.high, s.low + (a.low + b.low));
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

#endif
