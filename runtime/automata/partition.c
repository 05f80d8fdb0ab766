/* Refines a partition of states, for minimising. */
#include "runtime/automata/partition.h"

#include <stdlib.h>

bool tn_partition_make(tn_partition *partition, uint32_t n)
{
    *partition = (tn_partition){.blocks = 1};
    partition->memory = malloc(((size_t)n * 8 + 8) * sizeof *partition->memory);
    partition->is_waiting = calloc((size_t)n + 1, 1);
    if (!partition->memory || !partition->is_waiting)
        return false;
    uint32_t *at = partition->memory;
    uint32_t **arrays[] = {&partition->elements, &partition->place,  &partition->block,   &partition->first,
                           &partition->end,      &partition->marked, &partition->touched, &partition->waiting};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++, at += n + 1)
        *arrays[i] = at;
    partition->first[0] = 0;
    partition->end[0] = n;
    partition->marked[0] = 0;
    for (uint32_t i = 0; i < n; i++) {
        partition->elements[i] = partition->place[i] = i;
        partition->block[i] = 0;
    }
    return true;
}

void tn_partition_clear(tn_partition *partition)
{
    free(partition->memory);
    free(partition->is_waiting);
    *partition = (tn_partition){0};
}

void tn_partition_mark(tn_partition *partition, uint32_t element)
{
    uint32_t b = partition->block[element];
    uint32_t at = partition->place[element];
    uint32_t to = partition->first[b] + partition->marked[b];
    if (at < to)
        return; /* marked already */
    uint32_t other = partition->elements[to];
    partition->elements[to] = element;
    partition->place[element] = to;
    partition->elements[at] = other;
    partition->place[other] = at;
    if (partition->marked[b]++ == 0)
        partition->touched[partition->touched_count++] = b;
}

/* The marked part of block b as a block, or TN_NO_STATE where it is all of it. */
static uint32_t split_block(tn_partition *partition, uint32_t b)
{
    uint32_t middle = partition->first[b] + partition->marked[b];
    partition->marked[b] = 0;
    if (middle == partition->end[b])
        return TN_NO_STATE;
    uint32_t made = partition->blocks++;
    partition->first[made] = partition->first[b];
    partition->end[made] = middle;
    partition->marked[made] = 0;
    partition->first[b] = middle;
    for (uint32_t i = partition->first[made]; i < middle; i++)
        partition->block[partition->elements[i]] = made;
    return made;
}

void tn_partition_wait(tn_partition *partition, uint32_t b)
{
    if (partition->is_waiting[b])
        return;
    partition->is_waiting[b] = 1;
    partition->waiting[partition->waiting_count++] = b;
}

void tn_partition_split(tn_partition *partition)
{
    for (uint32_t i = 0; i < partition->touched_count; i++) {
        uint32_t b = partition->touched[i];
        uint32_t made = split_block(partition, b);
        if (made == TN_NO_STATE)
            continue;
        uint32_t size_b = partition->end[b] - partition->first[b];
        uint32_t size_made = partition->end[made] - partition->first[made];
        tn_partition_wait(partition, partition->is_waiting[b] || size_made <= size_b ? made : b);
    }
    partition->touched_count = 0;
}
