/* The one hash table: finds the items of a caller's array by what they are.
 *
 * It holds numbers of items, each with 32 bits of its hash: open addressing, linear probing, at most half full.
 * The items stay the caller's, who hashes them and says by a callback whether the item of a number is the one that is
 * looked for. The callback is asked only if 32 bits of the hashes agree, and no item is hashed twice.
 *
 * A table that is all zero is empty. It owns its slots: clear it in any case. But if `make` is set, the slots are made
 * by it (zeroed, of memory that somebody else frees as a whole), and nothing need be cleared.
 *
 * Finding is inline, so that a callback which the compiler knows costs no call. */
#ifndef TARTAN_BASE_HASH_TABLE_H
#define TARTAN_BASE_HASH_TABLE_H

#include "runtime/base/error.h"

#define TN_HASH_NONE UINT32_MAX

typedef struct tn_hash_table {
    uint64_t *slots; /* 32 bits of the hash, then the number + 1; 0: free */
    size_t capacity; /* a power of two, or 0 */
    size_t count;
    void *(*make)(void *from, size_t bytes); /* NULL: calloc and free */
    void *from;
} tn_hash_table;

/* Is the item of this number the one that is looked for? */
typedef bool tn_hash_same(const void *wanted, uint32_t number);

/* Room for so many items without growing. TN_MEMORY. */
tn_status tn_hash_reserve(tn_hash_table *table, size_t count, tn_error *error);

void tn_hash_clear(tn_hash_table *table);

/* Forgets all items and keeps the memory. */
void tn_hash_forget(tn_hash_table *table);

/* The slot of the item, or the free one in which it belongs. There are slots. */
static inline size_t tn_hash_slot(const tn_hash_table *table, uint64_t hash, tn_hash_same *is, const void *wanted)
{
    size_t mask = table->capacity - 1, at = (uint32_t)hash & mask;
    for (; table->slots[at]; at = (at + 1) & mask)
        if (table->slots[at] >> 32 == (uint32_t)hash && is(wanted, (uint32_t)table->slots[at] - 1))
            break;
    return at;
}

/* The number of the item; TN_HASH_NONE if it is not there. */
static inline uint32_t tn_hash_find(const tn_hash_table *table, uint64_t hash, tn_hash_same *is, const void *wanted)
{
    return table->count == 0 ? TN_HASH_NONE : (uint32_t)table->slots[tn_hash_slot(table, hash, is, wanted)] - 1;
}

/* Enters an item that is not there yet, with the number `*number`; of one that is there, `*number` becomes its number.
 * So if the number comes back as it was given, the item is new, and the caller puts it into its array. TN_MEMORY. */
static inline tn_status tn_hash_enter(tn_hash_table *table, uint64_t hash, tn_hash_same *is, const void *wanted,
                                      uint32_t *number, tn_error *error)
{
    if (2 * table->count >= table->capacity) {
        tn_status status = tn_hash_reserve(table, table->count + 1, error);
        if (status != TN_OK)
            return status;
    }
    size_t at = tn_hash_slot(table, hash, is, wanted);
    if (table->slots[at]) {
        *number = (uint32_t)table->slots[at] - 1;
        return TN_OK;
    }
    table->slots[at] = (uint64_t)(uint32_t)hash << 32 | (*number + 1);
    table->count++;
    return TN_OK;
}

#endif
