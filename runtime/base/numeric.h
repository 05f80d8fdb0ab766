/* The numeric core: elementary functions that give the same bits on every machine.
 *
 * The C library picks its variants by processor, so that its results differ in the last place between machines. These
 * are made of additions, multiplications, divisions and square roots, which IEEE 754 fixes, and are within 1 ulp of the
 * exact value. Special values are those of C's Annex F.
 *
 * Everything that may reach a result - in the compiler as in the engines - uses these and none of the C library's.
 */
#ifndef TARTAN_BASE_NUMERIC_H
#define TARTAN_BASE_NUMERIC_H

double tn_sin(double x); /* radians, any magnitude */
double tn_cos(double x);
double tn_exp(double x);
double tn_log(double x);
double tn_pow(double x, double y);
double tn_tanh(double x);
double tn_atan2(double y, double x); /* the angle of the point x, y, from -pi to pi */

/* Sine and cosine of an angle in degrees; exact at multiples of 90, and of 30 where the value is a half. */
double tn_sin_degrees(double degrees);
double tn_cos_degrees(double degrees);

#endif
