/* Makes room in the hash table, and empties it. */
#include "runtime/base/hash_table.h"

#include <stdlib.h>
#include <string.h>

#define CAPACITY_FIRST 64u
#define COUNT_MAX (SIZE_MAX / 32 < UINT32_MAX / 2 ? SIZE_MAX / 32 : UINT32_MAX / 2) /* whose slots a size can count */

tn_status tn_hash_reserve(tn_hash_table *table, size_t count, tn_error *error)
{
    size_t capacity = table->capacity ? table->capacity : CAPACITY_FIRST;
    if (count > COUNT_MAX)
        return tn_fail_memory(error);
    while (capacity < 2 * count)
        capacity *= 2;
    if (capacity == table->capacity)
        return TN_OK;
    uint64_t *slots =
        table->make ? table->make(table->from, capacity * sizeof *slots) : calloc(capacity, sizeof *slots);
    if (!slots)
        return tn_fail_memory(error);
    for (size_t i = 0; i < table->capacity; i++) {
        if (!table->slots[i])
            continue;
        size_t at = table->slots[i] >> 32 & (capacity - 1);
        while (slots[at])
            at = (at + 1) & (capacity - 1);
        slots[at] = table->slots[i];
    }
    if (!table->make)
        free(table->slots);
    table->slots = slots;
    table->capacity = capacity;
    return TN_OK;
}

void tn_hash_clear(tn_hash_table *table)
{
    if (!table->make)
        free(table->slots);
    *table = (tn_hash_table){.make = table->make, .from = table->from};
}

void tn_hash_forget(tn_hash_table *table)
{
    if (table->count)
        memset(table->slots, 0, table->capacity * sizeof *table->slots);
    table->count = 0;
}
