/* Sets of pairs of vertices (internal to the growth engine). A set that is all zero is empty. */
#ifndef TARTAN_GROWTH_JOIN_PAIR_SET_H
#define TARTAN_GROWTH_JOIN_PAIR_SET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tn_pair_set {
    uint64_t *slots; /* low vertex << 32 | high vertex; 0 is free (no pair has two equal vertices) */
    size_t count, capacity;
} tn_pair_set;

void tn_pair_set_clear(tn_pair_set *set);

/* The order of the two does not matter. */
bool tn_pair_set_has(const tn_pair_set *set, uint32_t u, uint32_t v);

/* Adds two different vertices. False: out of memory. */
bool tn_pair_set_add(tn_pair_set *set, uint32_t u, uint32_t v);

#endif
