/* What the parts of mapping share: the mapper's scratch memory, how a genome is read, and how steps are recorded. Of no
 * use elsewhere.
 *
 * - mapper.c: one mapping from begin to end;
 * - expand.c: the machine for both dialects, with and without recording; the same for what is derived most (the ge
 *   dialect, nothing recorded); position-independent mapping, where codons say which non-terminal comes next; and rules
 *   for edge types that have none.
 */
#ifndef TARTAN_GENOME_MAPPING_MAPPER_STATE_H
#define TARTAN_GENOME_MAPPING_MAPPER_STATE_H

#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/mapping/mapper.h"

#define TN_NO_EDGE_ID UINT32_MAX
#define TN_COPY 16u      /* short terminals are copied by this many bytes at once */
#define TN_EDGE_TEXT 16u /* "Edge" and ten digits, at most */

/* What to go back to: a production after one of its non-terminals, or a loop. */
typedef struct tn_mapping_frame {
    const uint32_t *ip; /* next word; of a loop: its first */
    uint32_t depth;
    uint32_t rule; /* that ends when this frame is popped (recording), of a loop: rounds so far */
    uint32_t ids[TN_EDGE_LETTERS];
    uint32_t mark; /* tn_rule_mark of the rule that ends when this frame is popped */
} tn_mapping_frame;

/* Position-independent mapping: a non-terminal of the derivation. Its children stand side by side, in order. */
typedef struct tn_mapping_node {
    uint32_t rule, production, first_child, depth;
    uint32_t open;          /* how many non-terminals it was one of when it was replaced */
    uint64_t read;          /* codons before its pair; UINT64_MAX while it is not replaced */
    uint64_t place, choice; /* its pair */
} tn_mapping_node;

typedef struct tn_mapping_text {
    char *data;
    size_t size, capacity;
} tn_mapping_text;

struct tn_mapper {
    const tn_grammar *grammar;
    tn_mapping_frame *frames;
    size_t frame_capacity;
    tn_mapping_text text, added, repaired;
    tn_mapping_text rule; /* that repair writes */
    tn_event *events;
    size_t event_count, event_capacity;
    /* genr8: edge types by number: does it occur, is there a rule for it */
    uint8_t *seen, *ruled;
    size_t id_capacity;
    uint32_t *repaired_ids;
    size_t repaired_count, repaired_capacity;
    uint32_t *waiting; /* while repairing, a heap: types that occur without a rule, the lowest first */
    size_t waiting_count, waiting_capacity;
    /* the predecessor being written: its edges, and which context signs it has */
    uint32_t *predecessor;
    size_t predecessor_count, predecessor_capacity;
    bool in_predecessor, has_less, has_greater;
    size_t rule_end; /* where in the text the last rewrite rule ends */
    /* position-independent mapping: the derivation, and its non-terminals that are not replaced yet */
    tn_mapping_node *nodes_of;
    size_t node_count, node_capacity;
    tn_sentential pending;
    /* the genome, and how it is read */
    const uint64_t *codons;
    size_t count, position;
    uint64_t used, readable, steps_left;
    uint64_t nodes;
    uint32_t depth, max_depth, max_id;
    bool frozen; /* while repairing: no new edge types */
};

typedef enum tn_expansion {
    TN_EXPANDED,
    TN_EXPAND_NO_CODON,
    TN_EXPAND_TOO_DEEP,
    TN_EXPAND_TOO_LONG,
    TN_EXPAND_NO_MEMORY
} tn_expansion;

static inline bool tn_text_append(tn_mapping_text *text, const char *data, size_t size)
{
    if (!tn_array_reserve(&text->data, &text->capacity, text->size, size + 1, 1))
        return false;
    memcpy(text->data + text->size, data, size);
    text->size += size;
    text->data[text->size] = '\0';
    return true;
}

/* Keeps one step of the derivation. */
static inline bool tn_mapper_record(tn_mapper *m, tn_event event)
{
    if (!tn_array_reserve(&m->events, &m->event_capacity, m->event_count, 1, sizeof *m->events))
        return false;
    m->events[m->event_count++] = event;
    return true;
}

static inline bool tn_mapper_read(tn_mapper *m, uint64_t *codon)
{
    if (m->used >= m->readable)
        return false;
    if (m->position == m->count)
        m->position = 0;
    *codon = m->codons[m->position++];
    m->used++;
    return true;
}

/* A long text counts as further steps, so that steps bound memory as they bound time. False: there were not enough. */
static inline bool tn_pay_for_text(uint64_t *steps, size_t length)
{
    uint64_t price = length / TN_MAPPING_STEP_BYTES;
    if (price > *steps)
        return false;
    *steps -= price;
    return true;
}

/* Expands a rule at that depth to the end of the text. */
tn_expansion tn_mapper_expand(tn_mapper *mapper, uint32_t rule, uint32_t depth, bool recorded);

/* The whole of a position-independent mapping. Where it is not valid and recorded, the events are those of what was
 * derived. */
tn_expansion tn_mapper_expand_places(tn_mapper *mapper, bool recorded);

/* Gives every edge type that occurs a rule: the sentence with them is in mapper->repaired (5.1). */
tn_expansion tn_mapper_repair(tn_mapper *mapper, const tn_mapping_options *options);

#endif
