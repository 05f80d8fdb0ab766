/* The non-terminals of a sentential form, from left to right: any one is taken out by its place, and what replaces it
 * is put there. In blocks, so that a form of a million non-terminals is not moved for each. */
#ifndef TARTAN_GENOME_MAPPING_SENTENTIAL_H
#define TARTAN_GENOME_MAPPING_SENTENTIAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TN_SENTENTIAL_BLOCK 1024u

typedef struct tn_sentential_block {
    size_t count;
    uint32_t items[TN_SENTENTIAL_BLOCK];
} tn_sentential_block;

typedef struct tn_sentential {
    tn_sentential_block **blocks; /* owned: block_count in use, and behind them spare ones up to block_made */
    size_t block_count, block_made, block_capacity;
    size_t count;
    size_t block, place; /* where the next item is put */
} tn_sentential;

void tn_sentential_clear(tn_sentential *pending);

/* Empties it; its memory is used again. */
void tn_sentential_reset(tn_sentential *pending);

/* Takes out the item at `place`, which is below `count`. What is put next stands there. */
uint32_t tn_sentential_take(tn_sentential *pending, size_t place);

/* Puts an item behind what was put last. false where out of memory. */
bool tn_sentential_put(tn_sentential *pending, uint32_t item);

#endif
