/* Numbers of any size as text. */
#ifndef TARTAN_DRIVER_OPEN_DIGITS_H
#define TARTAN_DRIVER_OPEN_DIGITS_H

#include <gmp.h>
#include <stdbool.h>

/* The number's decimal digits, for people in groups of three with commas. The caller frees the text; NULL where out of
 * memory. */
char *tn_digits(const mpz_t number, bool grouped);

/* How wide a column is that has a heading, and numbers in groups up to this one. */
int tn_digits_width(const mpz_t largest, const char *heading);

#endif
