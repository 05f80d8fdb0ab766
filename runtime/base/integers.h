/* Whole numbers of any size: arrays of them, how long they are, and their digits. */
#ifndef TARTAN_BASE_INTEGERS_H
#define TARTAN_BASE_INTEGERS_H

#include <gmp.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/buffer.h"

/* So many zeros; NULL if out of memory. tn_integers_free frees them. */
static inline mpz_t *tn_integers_new(size_t count)
{
    mpz_t *items = calloc(count + 1, sizeof *items);
    for (size_t i = 0; items && i < count; i++)
        mpz_init(items[i]);
    return items;
}

/* NULL is nothing to free. */
static inline void tn_integers_free(mpz_t *items, size_t count)
{
    for (size_t i = 0; items && i < count; i++)
        mpz_clear(items[i]);
    free(items);
}

/* For qsort, ascending. */
static inline int tn_integers_compare(const void *a, const void *b)
{
    mpz_srcptr x = a, y = b;
    return mpz_cmp(x, y);
}

/* How many decimal digits the number has, without its sign: 1 of 0. mpz_sizeinbase may say one too many. */
static inline size_t tn_decimal_digits(const mpz_t number)
{
    size_t size = mpz_sizeinbase(number, 10);
    mpz_t least;
    if (size == 1)
        return 1;
    mpz_init(least);
    mpz_ui_pow_ui(least, 10, size - 1);
    size -= mpz_cmpabs(number, least) < 0;
    mpz_clear(least);
    return size;
}

/* Appends the number's decimal digits. False if out of memory. */
static inline bool tn_buffer_integer(tn_buffer *buffer, const mpz_t number)
{
    if (!tn_buffer_reserve(buffer, mpz_sizeinbase(number, 10) + 1)) /* and the sign */
        return false;
    mpz_get_str(buffer->data + buffer->size, 10, number);
    buffer->size += strlen(buffer->data + buffer->size);
    return true;
}

#endif
