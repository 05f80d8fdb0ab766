/* Keeps the pairs of vertices that are linked. */
#include "runtime/growth/join/pair_set.h"

#include <stdlib.h>

void tn_pair_set_clear(tn_pair_set *set)
{
    free(set->slots);
    *set = (tn_pair_set){0};
}

static uint64_t key_of(uint32_t u, uint32_t v)
{
    return u < v ? (uint64_t)u << 32 | v : (uint64_t)v << 32 | u;
}

static size_t slot_of(const tn_pair_set *set, uint64_t key)
{
    size_t i = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & (set->capacity - 1);
    while (set->slots[i] != 0 && set->slots[i] != key)
        i = (i + 1) & (set->capacity - 1);
    return i;
}

bool tn_pair_set_has(const tn_pair_set *set, uint32_t u, uint32_t v)
{
    uint64_t key = key_of(u, v);
    return set->capacity && set->slots[slot_of(set, key)] == key;
}

static bool grow(tn_pair_set *set)
{
    tn_pair_set larger = {.count = set->count, .capacity = set->capacity ? 2 * set->capacity : 64};
    larger.slots = calloc(larger.capacity, sizeof *larger.slots);
    if (!larger.slots)
        return false;
    for (size_t i = 0; i < set->capacity; i++)
        if (set->slots[i])
            larger.slots[slot_of(&larger, set->slots[i])] = set->slots[i];
    free(set->slots);
    *set = larger;
    return true;
}

bool tn_pair_set_add(tn_pair_set *set, uint32_t u, uint32_t v)
{
    if (2 * set->count >= set->capacity && !grow(set))
        return false;
    uint64_t key = key_of(u, v);
    size_t slot = slot_of(set, key);
    set->count += set->slots[slot] == 0;
    set->slots[slot] = key;
    return true;
}
