/* The non-terminals of a sentential form, from left to right: any one is taken out by its place, and what replaces it is
 * put there. In blocks, so that a form of a million non-terminals is not moved for each. */
#ifndef TARTAN_GENOME_MAPPING_PENDING_H
#define TARTAN_GENOME_MAPPING_PENDING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TN_PENDING_BLOCK 1024u

typedef struct tn_pending_block {
    size_t count;
    uint32_t items[TN_PENDING_BLOCK];
} tn_pending_block;

typedef struct tn_pending {
    tn_pending_block **blocks; /* owned: block_count in use, and behind them spare ones up to block_made */
    size_t block_count, block_made, block_capacity;
    size_t count;
    size_t block, place; /* where the next item is put */
} tn_pending;

void tn_pending_clear(tn_pending *pending);

/* Empties it; its memory is used again. */
void tn_pending_reset(tn_pending *pending);

/* Takes out the item at `place`, which is below `count`. What is put next stands there. */
uint32_t tn_pending_take(tn_pending *pending, size_t place);

/* Puts an item behind what was put last. false where out of memory. */
bool tn_pending_put(tn_pending *pending, uint32_t item);

#endif
