/* Arrays that grow: the one place that asks for more memory for them. The caller owns the array and frees it. `items`
 * points to the array's pointer, of any type, and `size` is an item's in bytes. */
#ifndef TARTAN_BASE_ARRAY_H
#define TARTAN_BASE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h> /* free, which is the caller's part */

enum { TN_ARRAY_FIRST = 64 }; /* items that an array begins with */

/* A number as a size. What a size cannot count (where it has 32 bits) becomes TN_SIZE_MOST, as much as no memory holds:
 * it is refused where it is asked for. A little more than that is a size, too. */
#define TN_SIZE_MOST (SIZE_MAX / 2)

static inline size_t tn_as_size(uint64_t number)
{
    return number < TN_SIZE_MOST ? (size_t)number : TN_SIZE_MOST;
}

/* a * b, likewise. */
static inline size_t tn_size_of(size_t a, size_t b)
{
    size_t product;
    return __builtin_mul_overflow(a, b, &product) || product > TN_SIZE_MOST ? TN_SIZE_MOST : product;
}

/* `count` items whose bytes the caller writes. NULL if out of memory, or where these are too many bytes to count. */
void *tn_array_new(uint64_t count, size_t size);

/* The next capacity of an array that needs `needed` items: twice as many, and at least `first`. */
size_t tn_array_larger(size_t capacity, size_t needed, size_t first);

/* Makes the array `count` items large, more or fewer. False: out of memory, or too many bytes to count; nothing
 * changed. For arrays that share a capacity, and for those that are as large as what they hold. */
bool tn_array_resize(void *items, size_t count, size_t size);

/* Resizes the array to its next capacity with room for `more` items behind the first `used`. */
bool tn_array_grow(void *items, size_t *capacity, size_t first, size_t used, size_t more, size_t size);

/* Room for `more` items behind the first `used`, in an array that begins with `first`. False: out of memory, and
 * nothing changed. */
static inline bool tn_array_reserve_from(void *items, size_t *capacity, size_t first, size_t used, size_t more,
                                         size_t size)
{
    return (used <= *capacity && more <= *capacity - used) || tn_array_grow(items, capacity, first, used, more, size);
}

/* The same, where the first size does not matter. */
static inline bool tn_array_reserve(void *items, size_t *capacity, size_t used, size_t more, size_t size)
{
    return tn_array_reserve_from(items, capacity, TN_ARRAY_FIRST, used, more, size);
}

#endif
