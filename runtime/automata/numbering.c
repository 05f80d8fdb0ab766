/* Gives numbers to keys, in the order in which they are first met. */
#include "runtime/automata/numbering.h"

#include <stdlib.h>
#include <string.h>

#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"

#define MAX_KEYS (UINT32_C(1) << 30)

/* Keys that follow one another share a block of slots, and so a line of the cache, as they are often asked for one
 * after another. */
static uint64_t hash_of(uint64_t key)
{
    enum { BLOCK_BITS = 3 };
    return tn_mix64(key >> BLOCK_BITS) << BLOCK_BITS | (key & ((1u << BLOCK_BITS) - 1));
}

typedef struct wanted_key {
    const uint64_t *keys;
    uint64_t key;
} wanted_key;

static bool is_key(const void *context, uint32_t number)
{
    const wanted_key *w = context;
    return w->keys[number] == w->key;
}

uint32_t tn_number(tn_numbering *numbering, uint64_t key)
{
    if (numbering->count >= MAX_KEYS ||
        !tn_array_reserve(&numbering->keys, &numbering->capacity, numbering->count, 1, sizeof *numbering->keys))
        return UINT32_MAX;
    wanted_key wanted = {numbering->keys, key};
    uint32_t number = numbering->count;
    if (tn_hash_enter(&numbering->table, hash_of(key), is_key, &wanted, &number, NULL) != TN_OK)
        return UINT32_MAX;
    if (number == numbering->count)
        numbering->keys[numbering->count++] = key;
    return number;
}

uint32_t tn_number_find(const tn_numbering *numbering, uint64_t key)
{
    wanted_key wanted = {numbering->keys, key};
    return tn_hash_find(&numbering->table, hash_of(key), is_key, &wanted);
}

uint32_t tn_number_new(tn_numbering *numbering, uint64_t key)
{
    if (numbering->count >= MAX_KEYS ||
        !tn_array_reserve(&numbering->keys, &numbering->capacity, numbering->count, 1, sizeof *numbering->keys))
        return UINT32_MAX;
    numbering->keys[numbering->count] = key;
    return numbering->count++;
}

void tn_numbering_clear(tn_numbering *numbering)
{
    free(numbering->keys);
    tn_hash_clear(&numbering->table);
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

typedef struct wanted_words {
    const tn_interner *interner;
    const uint32_t *data;
    size_t size;
} wanted_words;

static bool is_words(const void *context, uint32_t number)
{
    const wanted_words *w = context;
    size_t size;
    const uint32_t *words = tn_interned(w->interner, number, &size);
    return size == w->size && (size == 0 || memcmp(words, w->data, size * sizeof *words) == 0);
}

/* Room for one key more, of so many words. */
static bool make_room(tn_interner *interner, size_t size)
{
    if (interner->count >= MAX_KEYS ||
        !tn_array_reserve(&interner->first, &interner->capacity, interner->count, 2, sizeof *interner->first) ||
        !tn_array_reserve_from(&interner->words, &interner->words_capacity, 256, interner->words_used, size,
                               sizeof *interner->words))
        return false;
    if (interner->count == 0)
        interner->first[0] = 0;
    return true;
}

uint32_t tn_intern(tn_interner *interner, const uint32_t *data, size_t size)
{
    wanted_words wanted = {interner, data, size};
    uint32_t number = interner->count;
    if (!make_room(interner, size) || tn_hash_enter(&interner->table, XXH3_64bits(data, size * sizeof *data), is_words,
                                                    &wanted, &number, NULL) != TN_OK)
        return UINT32_MAX;
    if (number < interner->count)
        return number;
    if (size > 0)
        memcpy(interner->words + interner->words_used, data, size * sizeof *data);
    interner->words_used += size;
    interner->first[++interner->count] = interner->words_used;
    return number;
}

uint32_t tn_interner_find(const tn_interner *interner, const uint32_t *data, size_t size)
{
    wanted_words wanted = {interner, data, size};
    return tn_hash_find(&interner->table, XXH3_64bits(data, size * sizeof *data), is_words, &wanted);
}

void tn_interner_clear(tn_interner *interner)
{
    free(interner->words);
    free(interner->first);
    tn_hash_clear(&interner->table);
    *interner = (tn_interner){0};
}
