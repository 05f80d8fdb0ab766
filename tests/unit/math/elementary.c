/* The numeric core: at most 1 ulp from MPFR's values, Annex F's special values, and rows that give the bits of single
 * numbers. Without MPFR its part is left out. The long test (tests/cli/numeric_long.sh) sets how many points are tried
 * of each function; here it is a share. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/math/elementary.h"

static double between(uint64_t stream, uint64_t i, double low, double high)
{
    return low + (high - low) * ((double)(tn_random64(7, stream, i) >> 11) * 0x1p-53);
}

/* A double of any magnitude in [2^low, 2^high), either sign. */
static double of_any_size(uint64_t stream, uint64_t i, int low, int high)
{
    double m = 1 + (double)(tn_random64(8, stream, i) >> 12) * 0x1p-52;
    double x = ldexp(m, low + (int)(tn_random64(9, stream, i) % (uint64_t)(high - low)));
    return tn_random64(10, stream, i) & 1 ? x : -x;
}

/* Where a function is hard: near multiples of pi/2, near 1, at the ends of its range. */
static double near_quarter_turn(uint64_t stream, uint64_t i)
{
    double turns = rint(of_any_size(stream, i, 0, 20));
    double x = turns * 0x1.921fb54442d18p+0;
    return nextafter(x, tn_random64(11, stream, i) & 1 ? INFINITY : -INFINITY);
}

typedef double sampler(uint64_t i);
static double wide_angle(uint64_t i)
{
    return of_any_size(1, i, -30, 1023);
}
static double angle(uint64_t i)
{
    return of_any_size(2, i, -40, 21);
}
static double small_angle(uint64_t i)
{
    return between(3, i, -10, 10);
}
static double quarter_turn(uint64_t i)
{
    return near_quarter_turn(4, i);
}
static double exponent(uint64_t i)
{
    return between(5, i, -746, 710);
}
static double small_exponent(uint64_t i)
{
    return of_any_size(6, i, -60, 3);
}
static double positive(uint64_t i)
{
    return fabs(of_any_size(7, i, -1074, 1023));
}
static double near_one(uint64_t i)
{
    return 1 + of_any_size(8, i, -53, -1);
}
static double unit(uint64_t i)
{
    return between(9, i, 0.25, 4);
}
static double of_tanh(uint64_t i)
{
    return between(10, i, -23, 23);
}
static double small(uint64_t i)
{
    return of_any_size(11, i, -60, 5);
}
static double of_any(uint64_t i)
{
    return of_any_size(12, i, -1074, 1023);
}
static double middling(uint64_t i)
{
    return of_any_size(13, i, -20, 20);
}
static double power(uint64_t i)
{
    return of_any_size(14, i, -20, 10);
}
static double low_power(uint64_t i)
{
    return between(15, i, -5, 5);
}
static double high_power(uint64_t i)
{
    return of_any_size(16, i, 0, 40);
}
static double subnormal(uint64_t i)
{
    return of_any_size(17, i, -1074, -1000);
}

static const struct case_of_1 {
    const char *name;
    double (*one)(double);
    void (*row)(const double *, double *, size_t);
    sampler *samples[4];
} cases_of_1[] = {
    {"sin", tn_sin, tn_sin_row, {wide_angle, angle, small_angle, quarter_turn}},
    {"cos", tn_cos, tn_cos_row, {wide_angle, angle, small_angle, quarter_turn}},
    {"exp", tn_exp, tn_exp_row, {exponent, small_exponent, of_tanh, exponent}},
    {"log", tn_log, tn_log_row, {positive, near_one, unit, positive}},
    {"tanh", tn_tanh, tn_tanh_row, {of_tanh, small, small_angle, of_any}},
};

static const struct case_of_2 {
    const char *name;
    double (*one)(double, double);
    void (*row)(const double *, const double *, double *, size_t);
    sampler *samples[4][2];
} cases_of_2[] = {
    {"pow",
     tn_pow,
     tn_pow_row,
     {{positive, power}, {unit, low_power}, {near_one, high_power}, {positive, small_angle}}},
    {"atan2",
     tn_atan2,
     tn_atan2_row,
     {{of_any, of_any}, {middling, middling}, {small_angle, small_angle}, {subnormal, subnormal}}},
};

#define COUNT(ARRAY) (sizeof(ARRAY) / sizeof *(ARRAY))

/* ---- against MPFR */

#ifdef TARTAN_HAVE_MPFR
#include <mpfr.h>

enum { DIGITS = 220 };

static double ulps(double got, mpfr_t exact, mpfr_t difference)
{
    double rounded = mpfr_get_d(exact, MPFR_RNDN);
    if (got == rounded || (isnan(got) && isnan(rounded)))
        return 0.5;
    if (isinf(rounded) || isinf(got) || isnan(got))
        return INFINITY;
    int e;
    frexp(rounded, &e);
    mpfr_set_d(difference, got, MPFR_RNDN);
    mpfr_sub(difference, difference, exact, MPFR_RNDN);
    mpfr_mul_2si(difference, difference, e - 53 > -1074 ? 53 - e : 1074, MPFR_RNDN);
    return fabs(mpfr_get_d(difference, MPFR_RNDN));
}

static uint64_t points(void)
{
    const char *wanted = getenv("TARTAN_NUMERIC_POINTS");
    return wanted ? strtoull(wanted, NULL, 10) : 100000;
}

static void test_functions_within_one_ulp(void **state)
{
    static int (*const exact[])(mpfr_t, const mpfr_t, mpfr_rnd_t) = {mpfr_sin, mpfr_cos, mpfr_exp, mpfr_log, mpfr_tanh};
    (void)state;
    mpfr_t a, r, d;
    mpfr_inits2(DIGITS, a, r, d, (mpfr_ptr)NULL);
    for (size_t c = 0; c < COUNT(cases_of_1); c++)
        for (uint64_t i = 0; i < points(); i++) {
            double x = cases_of_1[c].samples[i % 4](i);
            mpfr_set_d(a, x, MPFR_RNDN);
            exact[c](r, a, MPFR_RNDN);
            double off = ulps(cases_of_1[c].one(x), r, d);
            if (off > 1)
                fail_msg("%s(%a): %g ulp", cases_of_1[c].name, x, off);
        }
    mpfr_clears(a, r, d, (mpfr_ptr)NULL);
}

static void test_functions_of_two_within_one_ulp(void **state)
{
    static int (*const exact[])(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t) = {mpfr_pow, mpfr_atan2};
    (void)state;
    mpfr_t a, b, r, d;
    mpfr_inits2(DIGITS, a, b, r, d, (mpfr_ptr)NULL);
    for (size_t c = 0; c < COUNT(cases_of_2); c++)
        for (uint64_t i = 0; i < points(); i++) {
            double x = cases_of_2[c].samples[i % 4][0](i), y = cases_of_2[c].samples[i % 4][1](i + (c << 40));
            mpfr_set_d(a, x, MPFR_RNDN);
            mpfr_set_d(b, y, MPFR_RNDN);
            exact[c](r, a, b, MPFR_RNDN);
            double off = ulps(cases_of_2[c].one(x, y), r, d);
            if (off > 1)
                fail_msg("%s(%a, %a): %g ulp", cases_of_2[c].name, x, y, off);
        }
    mpfr_clears(a, b, r, d, (mpfr_ptr)NULL);
}

/* The double nearest a multiple of pi/2 (Kahan). */
static void test_nearest_multiple_of_half_pi(void **state)
{
    (void)state;
    mpfr_t a, r, d;
    mpfr_init2(a, 2000);
    mpfr_inits2(DIGITS, r, d, (mpfr_ptr)NULL);
    mpfr_set_d(a, 6381956970095103.0 * 0x1p797, MPFR_RNDN);
    mpfr_cos(r, a, MPFR_RNDN);
    assert_true(ulps(tn_cos(6381956970095103.0 * 0x1p797), r, d) <= 1);
    mpfr_clears(a, r, d, (mpfr_ptr)NULL);
}
#endif

/* ---- rows */

enum { ROW = 256 };

static const double specials[] = {0.0,         -0.0,        1,
                                  -1,          0.5,         -0.5,
                                  2,           -2,          3,
                                  -3,          700,         -700,
                                  710,         -746,        0x1p20,
                                  -0x1p21,     0x1p500,     -0x1p500,
                                  1e308,       -1e308,      0x1p-1074,
                                  -0x1p-1074,  0x1p-1022,   0x1p-1040,
                                  1e-300,      -1e-300,     22,
                                  -23,         0x1p-30,     -0x1p-30,
                                  INFINITY,    -INFINITY,   NAN,
                                  0x1p60,      0x1p53,      -0x1p53,
                                  1 + 0x1p-52, 1 - 0x1p-53, 0x1.921fb54442d18p+1,
                                  1e22};

static void assert_bits(const char *name, double a, double b, double in_row, double alone)
{
    if (memcmp(&in_row, &alone, sizeof alone) != 0)
        fail_msg("%s(%a, %a) is %a in a row and %a by itself", name, a, b, in_row, alone);
}

static void check_rows_of_1(const double *x, size_t count)
{
    double out[ROW];
    for (size_t c = 0; c < COUNT(cases_of_1); c++) {
        cases_of_1[c].row(x, out, count);
        for (size_t i = 0; i < count; i++)
            assert_bits(cases_of_1[c].name, x[i], 0, out[i], cases_of_1[c].one(x[i]));
    }
}

static void check_rows_of_2(const double *a, const double *b, size_t count)
{
    double out[ROW];
    for (size_t c = 0; c < COUNT(cases_of_2); c++) {
        cases_of_2[c].row(a, b, out, count);
        for (size_t i = 0; i < count; i++)
            assert_bits(cases_of_2[c].name, a[i], b[i], out[i], cases_of_2[c].one(a[i], b[i]));
    }
}

/* Of any length: vectors end before the row does. */
static void test_rows_are_single_numbers(void **state)
{
    (void)state;
    double a[ROW], b[ROW];
    for (size_t s = 0; s < COUNT(specials); s++) {
        for (size_t i = 0; i < COUNT(specials); i++) {
            a[i] = specials[s];
            b[i] = specials[i];
        }
        check_rows_of_2(a, b, COUNT(specials));
    }
    check_rows_of_1(specials, COUNT(specials));
    for (uint64_t round = 0; round < 400; round++) {
        size_t count = ROW - (size_t)(round % 9);
        for (uint64_t i = 0; i < count; i++) {
            bool mixed = round % 4 == 0 && i % 16 == 0; /* numbers that are not for the vectors, among others */
            a[i] = mixed       ? specials[(round + i) % COUNT(specials)]
                   : round % 2 ? of_any_size(1, 256 * round + i, -30, 30)
                               : between(2, 256 * round + i, 0, 9);
            b[i] = round % 3 ? between(3, 256 * round + i, -9, 9) : of_any_size(4, 256 * round + i, -8, 8);
        }
        check_rows_of_1(a, count);
        check_rows_of_2(a, b, count);
    }
}

/* ---- special values */

static void assert_same(double got, double want)
{
    if (isnan(want))
        assert_true(isnan(got));
    else if (memcmp(&got, &want, sizeof got) != 0)
        fail_msg("%a is not %a", got, want);
}

static void test_special_values(void **state)
{
    (void)state;
    assert_same(tn_sin(-0.0), -0.0);
    assert_same(tn_sin(INFINITY), NAN);
    assert_same(tn_cos(0), 1);
    assert_same(tn_exp(0), 1);
    assert_same(tn_exp(1000), INFINITY);
    assert_same(tn_exp(-1000), 0);
    assert_same(tn_exp(-INFINITY), 0);
    assert_same(tn_log(1), 0);
    assert_same(tn_log(0), -INFINITY);
    assert_same(tn_log(-1), NAN);
    assert_same(tn_log(INFINITY), INFINITY);
    assert_same(tn_pow(0, 0), 1);
    assert_same(tn_pow(-0.0, -3), -INFINITY);
    assert_same(tn_pow(-0.0, 3), -0.0);
    assert_same(tn_pow(0, -2), INFINITY);
    assert_same(tn_pow(-2, 3), -8);
    assert_same(tn_pow(-2, 0.5), NAN);
    assert_same(tn_pow(2, INFINITY), INFINITY);
    assert_same(tn_pow(0.5, INFINITY), 0);
    assert_same(tn_pow(-1, INFINITY), 1);
    assert_same(tn_pow(-INFINITY, -1), -0.0);
    assert_same(tn_pow(1e300, 1e300), INFINITY);
    assert_same(tn_pow(1, NAN), 1);
    assert_same(tn_tanh(-0.0), -0.0);
    assert_same(tn_tanh(100), 1);
    assert_same(tn_tanh(-INFINITY), -1);
    assert_same(tn_tanh(NAN), NAN);
    assert_same(tn_exp(NAN), NAN);
    assert_same(tn_exp(0x1.62e42fefa39efp+9), 0x1.fffffffffff2ap+1023);
    assert_same(tn_log(NAN), NAN);
    assert_same(tn_cos(NAN), NAN);
    assert_same(tn_atan2(0, -1), 0x1.921fb54442d18p+1);
    assert_same(tn_atan2(-0.0, -0.0), -0x1.921fb54442d18p+1);
    assert_same(tn_atan2(-0.0, 0), -0.0);
    assert_same(tn_atan2(1, -0.0), 0x1.921fb54442d18p+0);
    assert_same(tn_atan2(-1, 0), -0x1.921fb54442d18p+0);
    assert_same(tn_atan2(1, 1), 0x1.921fb54442d18p-1);
    assert_same(tn_atan2(-INFINITY, -INFINITY), -0x1.2d97c7f3321d2p+1);
    assert_same(tn_atan2(1, INFINITY), 0);
    assert_same(tn_atan2(1, -INFINITY), 0x1.921fb54442d18p+1);
    assert_same(tn_atan2(INFINITY, 1), 0x1.921fb54442d18p+0);
    assert_same(tn_atan2(NAN, 1), NAN);
}

static void test_degrees_are_exact_where_they_can_be(void **state)
{
    (void)state;
    assert_same(tn_sin_degrees(90), 1);
    assert_same(tn_cos_degrees(90), 0);
    assert_same(tn_cos_degrees(60), 0.5);
    assert_same(tn_cos_degrees(-120), -0.5);
    assert_same(tn_sin_degrees(-30), -0.5);
    assert_same(tn_sin_degrees(720 + 150), 0.5);
    assert_true(fabs(tn_sin_degrees(60) - 0x1.bb67ae8584caap-1) <= 0x1p-53);
    assert_true(fabs(tn_cos_degrees(45) - 0x1.6a09e667f3bcdp-1) <= 0x1p-53);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#ifdef TARTAN_HAVE_MPFR
        cmocka_unit_test(test_functions_within_one_ulp),
        cmocka_unit_test(test_functions_of_two_within_one_ulp),
        cmocka_unit_test(test_nearest_multiple_of_half_pi),
#endif
        cmocka_unit_test(test_rows_are_single_numbers),
        cmocka_unit_test(test_special_values),
        cmocka_unit_test(test_degrees_are_exact_where_they_can_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
