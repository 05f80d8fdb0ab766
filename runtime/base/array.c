/* Makes arrays larger: by doubling, with sizes that are checked for overflow. */
#include "runtime/base/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

size_t tn_array_larger(size_t capacity, size_t needed, size_t first)
{
    size_t larger = capacity <= SIZE_MAX / 2 ? 2 * capacity : SIZE_MAX;
    if (larger < first)
        larger = first;
    return larger < needed ? needed : larger;
}

void *tn_array_new(uint64_t count, size_t size)
{
    void *items = NULL;
    return tn_array_resize(&items, tn_as_size(count), size) ? items : NULL;
}

bool tn_array_resize(void *items, size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes >= TN_SIZE_MOST)
        return false;
    void *memory;
    memcpy(&memory, items, sizeof memory); /* a pointer to another type must not be read as a `void *` */
    memory = realloc(memory, bytes ? bytes : 1);
    if (!memory)
        return false;
    memcpy(items, &memory, sizeof memory);
    return true;
}

bool tn_array_grow(void *items, size_t *capacity, size_t first, size_t used, size_t more, size_t size)
{
    if (more > SIZE_MAX - used)
        return false;
    size_t larger = tn_array_larger(*capacity, used + more, first);
    if (!tn_array_resize(items, larger, size))
        return false;
    *capacity = larger;
    return true;
}
