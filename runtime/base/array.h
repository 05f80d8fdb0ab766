/* Arrays that grow by doubling. */
#ifndef TARTAN_BASE_ARRAY_H
#define TARTAN_BASE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Room for `more` items of `size` bytes behind the first `used`. `items` points to the array's pointer, of any type.
 * False: out of memory, and nothing changed. */
static inline bool tn_array_reserve(void *items, size_t *capacity, size_t used, size_t more, size_t size)
{
    if (used + more <= *capacity)
        return true;
    size_t wanted = *capacity ? *capacity * 2 : 64;
    while (wanted < used + more)
        wanted *= 2;
    void *memory;
    memcpy(&memory, items, sizeof memory);
    memory = realloc(memory, wanted * size);
    if (!memory)
        return false;
    memcpy(items, &memory, sizeof memory);
    *capacity = wanted;
    return true;
}

#endif
