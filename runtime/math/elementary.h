/* The numeric core: elementary functions that give the same bits on every machine.
 *
 * The C library picks its variants by processor, so that its results differ in the last place between machines. These
 * are made of additions, multiplications, divisions and square roots, which IEEE 754 fixes, and are within 1 ulp of the
 * exact value. Special values are those of C's Annex F. A row of numbers gives the bits of one number at a time, and
 * many times as fast, by whatever vectors the processor has.
 *
 * Everything that may reach a result - in the compiler as in the engines - uses these and none of the C library's.
 */
#ifndef TARTAN_MATH_ELEMENTARY_H
#define TARTAN_MATH_ELEMENTARY_H

#include <stddef.h>

/* Goes up when any function here gives other bits than before. What is stored and later computed again, bit for bit,
 * records it. */
#define TN_NUMERIC_VERSION 2

double tn_sin(double x); /* radians, any magnitude */
double tn_cos(double x);
double tn_exp(double x);
double tn_log(double x);
double tn_pow(double x, double y);
double tn_tanh(double x);
double tn_atan2(double y, double x); /* the angle of the point x, y, from -pi to pi */

/* The same of `count` numbers, into `out`, which is none of the operands. */
void tn_sin_row(const double *x, double *out, size_t count);
void tn_cos_row(const double *x, double *out, size_t count);
void tn_exp_row(const double *x, double *out, size_t count);
void tn_log_row(const double *x, double *out, size_t count);
void tn_pow_row(const double *x, const double *y, double *out, size_t count);
void tn_tanh_row(const double *x, double *out, size_t count);
void tn_atan2_row(const double *y, const double *x, double *out, size_t count);

/* Sine and cosine of an angle in degrees; exact at multiples of 90, and of 30 where the value is a half. */
double tn_sin_degrees(double degrees);
double tn_cos_degrees(double degrees);

#endif
