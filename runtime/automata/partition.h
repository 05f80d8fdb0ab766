/* A refinable partition of the elements 0..n-1 into blocks (Valmari and Lehtinen 2008): each block is a run of
 * `elements`, its marked elements first. Shared by the two minimisers; memory is the owner's. */
#ifndef TARTAN_AUTOMATA_PARTITION_H
#define TARTAN_AUTOMATA_PARTITION_H

#include "runtime/automata/dfa.h"

typedef struct tn_partition {
    uint32_t *elements, *place, *block; /* [n]: block by block; where an element is; its block */
    uint32_t *first, *end, *marked;     /* [blocks] */
    uint32_t blocks;
    uint32_t *touched; /* blocks with marked elements */
    uint32_t touched_count;
    uint32_t *waiting; /* blocks still to split by */
    uint8_t *is_waiting;
    uint32_t waiting_count;
    uint32_t *memory;
} tn_partition;

/* One block of all n elements, nothing waiting. false where out of memory; clear it also then. */
bool tn_partition_make(tn_partition *partition, uint32_t n);
void tn_partition_clear(tn_partition *partition);

void tn_partition_mark(tn_partition *partition, uint32_t element);

/* Makes the marked part of each block a block of its own (unless that is all of it). Of the two, the smaller waits, or,
 * where the block waited already, both do. */
void tn_partition_split(tn_partition *partition);

void tn_partition_wait(tn_partition *partition, uint32_t block);

#endif
