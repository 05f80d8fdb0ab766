/* The elementary functions of version 1 of the arithmetic; see runtime/math/elementary.h for what they compute. */
#ifndef TARTAN_BENCH_BEFORE_NUMERIC_H
#define TARTAN_BENCH_BEFORE_NUMERIC_H

double before_sin(double x);
double before_cos(double x);
double before_exp(double x);
double before_log(double x);
double before_pow(double x, double y);
double before_tanh(double x);
double before_atan2(double y, double x);

#endif
