/* The numeric core against MPFR at 300 bits: at most 1 ulp everywhere; Annex F's special values. Without MPFR only the
 * special values and exact cases are tested. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/numeric.h"
#include "runtime/base/random.h"

#ifdef TARTAN_HAVE_MPFR
#include <mpfr.h>

typedef int mpfr_function(mpfr_t, const mpfr_t, mpfr_rnd_t);

static double ulps(double got, mpfr_t exact)
{
    double rounded = mpfr_get_d(exact, MPFR_RNDN);
    if (got == rounded)
        return 0.5;
    if (isinf(rounded) || isinf(got) || isnan(got))
        return INFINITY;
    int e;
    frexp(rounded, &e);
    mpfr_t d;
    mpfr_init2(d, 300);
    mpfr_set_d(d, got, MPFR_RNDN);
    mpfr_sub(d, d, exact, MPFR_RNDN);
    double off = fabs(ldexp(mpfr_get_d(d, MPFR_RNDN), e - 53 > -1074 ? 53 - e : 1074));
    mpfr_clear(d);
    return off;
}

static double worst_of(double (*ours)(double), mpfr_function *exact, double x)
{
    mpfr_t a, r;
    mpfr_init2(a, 300);
    mpfr_init2(r, 300);
    mpfr_set_d(a, x, MPFR_RNDN);
    exact(r, a, MPFR_RNDN);
    double off = ulps(ours(x), r);
    if (off > 1)
        print_error("at %a: %g ulp\n", x, off);
    mpfr_clear(a);
    mpfr_clear(r);
    return off;
}

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

#define SAMPLES 30000u

static void test_within_one_ulp(void **state)
{
    (void)state;
    double worst = 0;
    for (uint64_t i = 0; i < SAMPLES; i++) {
        worst = fmax(worst, worst_of(tn_sin, mpfr_sin, of_any_size(1, i, -30, 1023)));
        worst = fmax(worst, worst_of(tn_cos, mpfr_cos, of_any_size(2, i, -30, 1023)));
        worst = fmax(worst, worst_of(tn_sin, mpfr_sin, between(3, i, -10, 10)));
        worst = fmax(worst, worst_of(tn_cos, mpfr_cos, between(4, i, -10, 10)));
        worst = fmax(worst, worst_of(tn_exp, mpfr_exp, between(5, i, -745, 709.7)));
        worst = fmax(worst, worst_of(tn_exp, mpfr_exp, of_any_size(6, i, -40, 3)));
        worst = fmax(worst, worst_of(tn_log, mpfr_log, fabs(of_any_size(7, i, -1074, 1023))));
        worst = fmax(worst, worst_of(tn_log, mpfr_log, between(8, i, 0.5, 2)));
        worst = fmax(worst, worst_of(tn_tanh, mpfr_tanh, between(9, i, -23, 23)));
        worst = fmax(worst, worst_of(tn_tanh, mpfr_tanh, of_any_size(10, i, -40, 4)));
    }
    /* the double nearest a multiple of pi/2 (Kahan) */
    worst = fmax(worst, worst_of(tn_cos, mpfr_cos, 6381956970095103.0 * 0x1p797));
    assert_true(worst <= 1);
}

static void test_powers_within_one_ulp(void **state)
{
    (void)state;
    mpfr_t a, b, r;
    mpfr_init2(a, 300);
    mpfr_init2(b, 300);
    mpfr_init2(r, 300);
    for (uint64_t i = 0; i < 4 * SAMPLES; i++) {
        double x = i & 1 ? fabs(of_any_size(11, i, -1000, 1000)) : between(11, i, 0, 3);
        double y = i & 2 ? between(12, i, -5, 5) : of_any_size(12, i, -20, 10);
        mpfr_set_d(a, x, MPFR_RNDN);
        mpfr_set_d(b, y, MPFR_RNDN);
        mpfr_pow(r, a, b, MPFR_RNDN);
        double off = ulps(tn_pow(x, y), r);
        if (off > 1)
            fail_msg("pow(%a, %a): %g ulp", x, y, off);
    }
    mpfr_clear(a);
    mpfr_clear(b);
    mpfr_clear(r);
}
#endif

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
        cmocka_unit_test(test_within_one_ulp),
        cmocka_unit_test(test_powers_within_one_ulp),
#endif
        cmocka_unit_test(test_special_values),
        cmocka_unit_test(test_degrees_are_exact_where_they_can_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
