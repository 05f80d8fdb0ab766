/* Turns codons into a sentence of a grammar. */
#include "runtime/genome/mapping/mapper_state.h"

#include <stdlib.h>

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
