/* Gives numbers to keys, in the order in which they are first met. */
#include "runtime/automata/numbering.h"

#include <stdlib.h>
#include <string.h>

#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"

/* Tables hold at most this many keys: their slots are at most half full and counted in 32 bits. */
#define MAX_KEYS (UINT32_C(1) << 30)

/* Where to look for a key first. Keys that follow one another share a block of slots, and so a line of the cache, as
 * they are often asked for one after another. */
static uint32_t slot_of(uint64_t key, uint32_t mask)
{
    enum { BLOCK_BITS = 4 };
    return ((uint32_t)tn_mix64(key >> BLOCK_BITS) << BLOCK_BITS | (uint32_t)(key & ((1u << BLOCK_BITS) - 1))) & mask;
}

static bool numbering_grow(tn_numbering *numbering)
{
    if (numbering->count >= MAX_KEYS)
        return false;
    uint32_t capacity = numbering->capacity ? numbering->capacity * 2 : 64;
    if (!tn_array_resize(&numbering->keys, capacity / 2, sizeof *numbering->keys))
        return false;
    uint32_t *slots = calloc(capacity, sizeof *slots);
    if (!slots)
        return false;
    for (uint32_t i = 0; i < numbering->count; i++) {
        uint32_t at = slot_of(numbering->keys[i], capacity - 1);
        while (slots[at])
            at = (at + 1) & (capacity - 1);
        slots[at] = i + 1;
    }
    free(numbering->slots);
    numbering->slots = slots;
    numbering->capacity = capacity;
    return true;
}

uint32_t tn_number(tn_numbering *numbering, uint64_t key)
{
    if (numbering->count >= numbering->capacity / 2 && !numbering_grow(numbering))
        return UINT32_MAX;
    uint32_t mask = numbering->capacity - 1;
    uint32_t at = slot_of(key, mask);
    for (; numbering->slots[at]; at = (at + 1) & mask)
        if (numbering->keys[numbering->slots[at] - 1] == key)
            return numbering->slots[at] - 1;
    numbering->keys[numbering->count] = key;
    numbering->slots[at] = ++numbering->count;
    return numbering->count - 1;
}

uint32_t tn_number_find(const tn_numbering *numbering, uint64_t key)
{
    uint32_t mask = numbering->capacity - 1;
    if (numbering->capacity == 0)
        return UINT32_MAX;
    for (uint32_t at = slot_of(key, mask); numbering->slots[at]; at = (at + 1) & mask)
        if (numbering->keys[numbering->slots[at] - 1] == key)
            return numbering->slots[at] - 1;
    return UINT32_MAX;
}

uint32_t tn_number_new(tn_numbering *numbering, uint64_t key)
{
    if (numbering->count >= numbering->capacity / 2) {
        if (numbering->count >= MAX_KEYS)
            return UINT32_MAX;
        uint32_t capacity = numbering->capacity ? numbering->capacity * 2 : 64;
        if (!tn_array_resize(&numbering->keys, capacity / 2, sizeof *numbering->keys))
            return UINT32_MAX;
        numbering->capacity = capacity;
    }
    numbering->keys[numbering->count] = key;
    return numbering->count++;
}

void tn_numbering_clear(tn_numbering *numbering)
{
    free(numbering->keys);
    free(numbering->slots);
    *numbering = (tn_numbering){0};
}

bool tn_key_push(tn_key *key, uint32_t word)
{
    if (!tn_array_reserve_from(&key->data, &key->capacity, 32, key->size, 1, sizeof *key->data))
        return false;
    key->data[key->size++] = word;
    return true;
}

bool tn_key_copy(tn_key *key, const uint32_t *data, size_t size)
{
    key->size = 0;
    if (size == 0)
        return true;
    if (!tn_array_reserve_from(&key->data, &key->capacity, 32, 0, size, sizeof *key->data))
        return false;
    memcpy(key->data, data, size * sizeof *data);
    key->size = size;
    return true;
}

static uint32_t hash_words(const uint32_t *data, size_t size)
{
    return (uint32_t)XXH3_64bits(data, size * sizeof *data);
}

static bool interner_grow(tn_interner *interner)
{
    if (interner->count >= MAX_KEYS)
        return false;
    uint32_t capacity = interner->capacity ? interner->capacity * 2 : 64;
    if (!tn_array_resize(&interner->first, capacity / 2 + 1, sizeof *interner->first) ||
        !tn_array_resize(&interner->hashes, capacity / 2, sizeof *interner->hashes))
        return false;
    if (interner->count == 0)
        interner->first[0] = 0;
    uint32_t *slots = calloc(capacity, sizeof *slots);
    if (!slots)
        return false;
    for (uint32_t i = 0; i < interner->count; i++) {
        uint32_t at = interner->hashes[i] & (capacity - 1);
        while (slots[at])
            at = (at + 1) & (capacity - 1);
        slots[at] = i + 1;
    }
    free(interner->slots);
    interner->slots = slots;
    interner->capacity = capacity;
    return true;
}

static bool interner_append(tn_interner *interner, const uint32_t *data, size_t size)
{
    if (!tn_array_reserve_from(&interner->words, &interner->words_capacity, 256, interner->words_used, size,
                               sizeof *interner->words))
        return false;
    if (size > 0)
        memcpy(interner->words + interner->words_used, data, size * sizeof *data);
    interner->words_used += size;
    interner->first[interner->count + 1] = interner->words_used;
    return true;
}

uint32_t tn_intern(tn_interner *interner, const uint32_t *data, size_t size)
{
    if (interner->count >= interner->capacity / 2 && !interner_grow(interner))
        return UINT32_MAX;
    uint32_t mask = interner->capacity - 1;
    uint32_t hash = hash_words(data, size), at = hash & mask;
    for (; interner->slots[at]; at = (at + 1) & mask) {
        size_t other_size;
        uint32_t number = interner->slots[at] - 1;
        const uint32_t *other = tn_interned(interner, number, &other_size);
        if (interner->hashes[number] == hash && other_size == size &&
            (size == 0 || memcmp(other, data, size * sizeof *data) == 0))
            return number;
    }
    if (!interner_append(interner, data, size))
        return UINT32_MAX;
    interner->hashes[interner->count] = hash;
    interner->slots[at] = ++interner->count;
    return interner->count - 1;
}

void tn_interner_clear(tn_interner *interner)
{
    free(interner->words);
    free(interner->first);
    free(interner->hashes);
    free(interner->slots);
    *interner = (tn_interner){0};
}
