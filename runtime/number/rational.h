/* Exact rational numbers as texts: what sums of the plan language are made of. GMP's mpq_t holds them. */
#ifndef TARTAN_NUMBER_RATIONAL_H
#define TARTAN_NUMBER_RATIONAL_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

/* The longest numerator or denominator, in bits: more than any sum of lengths needs, and little enough to be quick. */
#define TN_RATIONAL_BITS 4096u

/* Reads "12", "12.50": digits, with a point among them at most. false if it is none, or has too many digits. */
bool tn_decimal_read(const char *text, size_t size, mpq_t number);

/* Reads "-p/q" or "-p" as modules hold it: in lowest terms, q above 1. false if it is none, or too long. */
bool tn_rational_read(const char *text, mpq_t number);

/* Is the number short enough to go on with? */
bool tn_rational_fits(const mpq_t number);

/* number to the power of an exponent of either sign; the number is not 0. */
void tn_rational_power(mpq_t result, const mpq_t number, int exponent);

#endif
