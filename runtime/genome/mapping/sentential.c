/* Keeps non-terminals in their order while they are replaced anywhere. */
#include "runtime/genome/mapping/sentential.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

void tn_sentential_clear(tn_sentential *p)
{
    for (size_t i = 0; i < p->block_made; i++)
        free(p->blocks[i]);
    free(p->blocks);
    *p = (tn_sentential){0};
}

void tn_sentential_reset(tn_sentential *p)
{
    p->block_count = p->count = p->block = p->place = 0;
}

/* A spare block comes into use, empty, as number `at`. */
static bool add_block(tn_sentential *p, size_t at)
{
    if (p->block_count == p->block_made) {
        if (!tn_array_reserve(&p->blocks, &p->block_capacity, p->block_made, 1, sizeof(tn_sentential_block *)))
            return false;
        p->blocks[p->block_made] = malloc(sizeof(tn_sentential_block));
        if (!p->blocks[p->block_made])
            return false;
        p->block_made++;
    }
    tn_sentential_block *block = p->blocks[p->block_count];
    memmove(&p->blocks[at + 1], &p->blocks[at], (p->block_count - at) * sizeof(tn_sentential_block *));
    p->blocks[at] = block;
    block->count = 0;
    p->block_count++;
    return true;
}

uint32_t tn_sentential_take(tn_sentential *p, size_t place)
{
    size_t b = 0;
    while (place >= p->blocks[b]->count)
        place -= p->blocks[b++]->count;
    tn_sentential_block *block = p->blocks[b];
    uint32_t item = block->items[place];
    memmove(&block->items[place], &block->items[place + 1], (--block->count - place) * sizeof item);
    p->count--;
    p->block = b;
    p->place = place;
    return item;
}

/* The later half of a full block goes to one of its own behind it. */
static bool split(tn_sentential *p)
{
    const size_t half = TN_SENTENTIAL_BLOCK / 2;
    if (!add_block(p, p->block + 1))
        return false;
    tn_sentential_block *from = p->blocks[p->block], *to = p->blocks[p->block + 1];
    to->count = from->count - half;
    memcpy(to->items, &from->items[half], to->count * sizeof *to->items);
    from->count = half;
    if (p->place > half) {
        p->place -= half;
        p->block++;
    }
    return true;
}

bool tn_sentential_put(tn_sentential *p, uint32_t item)
{
    bool well = p->block_count == 0                                 ? add_block(p, 0)
                : p->blocks[p->block]->count == TN_SENTENTIAL_BLOCK ? split(p)
                                                                    : true;
    if (!well)
        return false;
    tn_sentential_block *block = p->blocks[p->block];
    memmove(&block->items[p->place + 1], &block->items[p->place], (block->count++ - p->place) * sizeof item);
    block->items[p->place++] = item;
    p->count++;
    return true;
}
