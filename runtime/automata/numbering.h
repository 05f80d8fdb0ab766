/* Numbers keys in the order of their first appearance: keys of 64 bits (tn_numbering) and keys that are runs of 32-bit
 * words (tn_interner), as constructions of automata need for their states. Both own their memory; zero them to begin
 * with. */
#ifndef TARTAN_AUTOMATA_NUMBERING_H
#define TARTAN_AUTOMATA_NUMBERING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/base/hash_table.h"

typedef struct tn_numbering {
    uint64_t *keys; /* [count], in order */
    uint32_t count;
    size_t capacity;
    tn_hash_table table;
} tn_numbering;

/* The key's number, new or old; UINT32_MAX where out of memory. */
uint32_t tn_number(tn_numbering *numbering, uint64_t key);

/* The key's number, or UINT32_MAX where it has none. */
uint32_t tn_number_find(const tn_numbering *numbering, uint64_t key);

/* Gives a key that is known to be new the next number, without remembering it: for callers who keep a table of their
 * own instead. Not to be mixed with tn_number on one tn_numbering. */
uint32_t tn_number_new(tn_numbering *numbering, uint64_t key);
void tn_numbering_clear(tn_numbering *numbering);

/* Orders words ascending, for qsort and bsearch. */
static inline int tn_words_compare(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/* A key that grows. */
typedef struct tn_key {
    uint32_t *data;
    size_t size;
    size_t capacity;
} tn_key;

bool tn_key_push(tn_key *key, uint32_t word);
bool tn_key_copy(tn_key *key, const uint32_t *data, size_t size);

typedef struct tn_interner {
    uint32_t *words;
    size_t words_used, words_capacity;
    size_t *first; /* [count + 1]: key i is words [first[i], first[i + 1]) */
    uint32_t count;
    size_t capacity;
    tn_hash_table table;
} tn_interner;

uint32_t tn_intern(tn_interner *interner, const uint32_t *data, size_t size);

/* The key's number, or UINT32_MAX where it has none. */
uint32_t tn_interner_find(const tn_interner *interner, const uint32_t *data, size_t size);
void tn_interner_clear(tn_interner *interner);

static inline const uint32_t *tn_interned(const tn_interner *interner, uint32_t number, size_t *size)
{
    *size = interner->first[number + 1] - interner->first[number];
    return interner->words ? interner->words + interner->first[number] : NULL; /* no words: only the empty key */
}

#endif
