/* Arrays that grow by doubling (internal to the growth engine). */
#ifndef TARTAN_GROWTH_PASS_ROOM_H
#define TARTAN_GROWTH_PASS_ROOM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

/* Makes room for `need` elements of `size` bytes; what was there stays. False: out of memory, and nothing changed. */
static inline bool tn_make_room(void **array, size_t *room, size_t need, size_t size)
{
    if (need <= *room)
        return true;
    size_t larger = 2 * need + 64;
    void *grown = realloc(*array, larger * size);
    if (!grown)
        return false;
    *array = grown;
    *room = larger;
    return true;
}

#endif
