/* Turns codons into a sentence of a grammar. */
#include "runtime/genome/mapping/mapper.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/mapping/mapper_state.h"

/* ---- keeps non-terminals in their order while they are replaced anywhere */

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

#define FIRST_IDS 2u /* edge types that there are to begin with: Edge0 and Edge1 (5.2) */

tn_mapping_options tn_mapping_options_of(const tn_grammar *grammar)
{
    return (tn_mapping_options){.wraps = grammar->wraps,
                                .max_depth = grammar->max_depth,
                                .repair = grammar->repair,
                                .position_independent = grammar->position_independent};
}

const char *tn_mapping_reason_text(tn_mapping_reason reason)
{
    static const char *const texts[TN_MAPPING_REASON_COUNT] = {
        "", "out of codons", "too deep", "too long", "out of codons while repairing", "too long while repairing"};
    return texts[reason];
}

tn_mapper *tn_mapper_new(const tn_grammar *grammar)
{
    tn_mapper *mapper = calloc(1, sizeof *mapper);
    if (mapper)
        mapper->grammar = grammar;
    return mapper;
}

void tn_mapper_free(tn_mapper *mapper)
{
    if (!mapper)
        return;
    free(mapper->frames);
    free(mapper->text.data);
    free(mapper->added.data);
    free(mapper->repaired.data);
    free(mapper->events);
    free(mapper->seen);
    free(mapper->ruled);
    free(mapper->rule.data);
    free(mapper->repaired_ids);
    free(mapper->waiting);
    free(mapper->predecessor);
    free(mapper->nodes_of);
    tn_sentential_clear(&mapper->pending);
    free(mapper);
}

static void start(tn_mapper *m, const uint64_t *codons, size_t count, const tn_mapping_options *options)
{
    m->codons = codons;
    m->count = count;
    m->position = 0;
    m->used = 0;
    if (__builtin_mul_overflow((uint64_t)count, (uint64_t)options->wraps + 1, &m->readable))
        m->readable = UINT64_MAX;
    m->steps_left = options->max_steps ? options->max_steps : TN_MAPPING_STEPS;
    m->max_depth = options->max_depth;
    m->nodes = m->grammar->dialect == TN_DIALECT_GE ? 1 : 0;
    m->depth = 1;
    size_t marked = m->max_id < m->id_capacity ? m->max_id : m->id_capacity; /* by the mapping before */
    if (marked) {
        memset(m->seen, 0, marked);
        memset(m->ruled, 0, marked);
    }
    m->max_id = FIRST_IDS;
    m->frozen = m->in_predecessor = false;
    m->text.size = 0;
    m->event_count = 0;
    m->rule_end = SIZE_MAX;
}

static tn_mapping_reason reason_for(tn_expansion result, bool repairing)
{
    switch (result) {
    case TN_EXPANDED:
    case TN_EXPAND_NO_MEMORY:
        return TN_MAPPING_VALID;
    case TN_EXPAND_NO_CODON:
        return repairing ? TN_MAPPING_REPAIR_OUT_OF_CODONS : TN_MAPPING_OUT_OF_CODONS;
    case TN_EXPAND_TOO_DEEP:
        return TN_MAPPING_TOO_DEEP;
    case TN_EXPAND_TOO_LONG:
        return repairing ? TN_MAPPING_REPAIR_TOO_LONG : TN_MAPPING_TOO_LONG;
    }
    return TN_MAPPING_VALID;
}

static void describe(const tn_mapper *m, tn_mapping *mapping)
{
    mapping->has_phenotype = true;
    mapping->phenotype_size = m->text.size;
    mapping->used = m->used;
    mapping->nodes = m->nodes;
    mapping->depth = m->depth;
    mapping->wraps = m->used ? (m->used - 1) / m->count : 0;
    mapping->max_id = m->max_id;
}

tn_status tn_mapper_derive(tn_mapper *m, const uint64_t *codons, size_t count, const tn_mapping_options *options,
                           tn_mapping *mapping, tn_error *error)
{
    bool genr8 = m->grammar->dialect == TN_DIALECT_GENR8, repairing = false;
    memset(mapping, 0, sizeof *mapping);
    start(m, codons, count, options);
    tn_expansion result = options->position_independent ? tn_mapper_expand_places(m, options->record)
                                                        : tn_mapper_expand(m, 0, 1, options->record);
    if (result == TN_EXPANDED && !tn_array_reserve(&m->text.data, &m->text.capacity, m->text.size, 1, 1))
        result = TN_EXPAND_NO_MEMORY;
    if (result == TN_EXPANDED) {
        m->text.data[m->text.size] = '\0';
        describe(m, mapping);
        repairing = genr8 && options->repair != TN_REPAIR_OFF && m->grammar->successor != TN_NO_RECORD;
        if (repairing)
            result = tn_mapper_repair(m, options);
    }
    if (result == TN_EXPAND_NO_MEMORY)
        return tn_fail_memory(error);
    mapping->reason = reason_for(result, repairing);
    mapping->valid = result == TN_EXPANDED;
    mapping->phenotype = mapping->has_phenotype ? m->text.data : "";
    if (repairing && mapping->valid) {
        mapping->repaired = true;
        mapping->repaired_phenotype = m->repaired.data;
        mapping->repaired_size = m->repaired.size;
        mapping->repaired_used = m->used;
        mapping->repaired_ids = m->repaired_ids;
        mapping->repaired_count = m->repaired_count;
    }
    mapping->events = m->events;
    mapping->event_count = m->event_count;
    return TN_OK;
}
