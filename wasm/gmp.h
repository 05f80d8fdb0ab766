/* What we use of GMP, by mini-gmp of its sources, whose limbs and `long` have 64 bits here: WebAssembly's `long` has 32, and what GMP takes as
 * `unsigned long` are numbers of 64 everywhere in Tartan. */
#ifndef TARTAN_WASM_GMP_H
#define TARTAN_WASM_GMP_H

#include <limits.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#pragma GCC system_header /* a keyword is another for a while */
#define MINI_GMP_LIMB_TYPE long
#define long long long
#include <mini-gmp.h>
#include <mini-mpq.h>
#undef long

#define GMP_NUMB_BITS 64

/* What mini-gmp lacks (gmp.c). */
void mpz_inits(mpz_t first, ...);
void mpz_clears(mpz_t first, ...);
void mpq_inits(mpq_t first, ...);
void mpq_clears(mpq_t first, ...);
double mpz_get_d_2exp(long *exponent, const mpz_t number);

#endif
