/* Arrays of whole numbers of any size. */
#ifndef TARTAN_BASE_INTEGERS_H
#define TARTAN_BASE_INTEGERS_H

#include <gmp.h>
#include <stdlib.h>

/* So many zeros; NULL where out of memory. tn_integers_free frees them. */
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

#endif
