/* What the parts of mapping share: the mapper's scratch memory, how a genome is read, and how steps are recorded. Of no
 * use elsewhere.
 *
 * mapper.c     one mapping from begin to end
 * expand.c     the machine for both dialects, with and without recording
 * expand_ge.c  the same for what is mapped most: the ge dialect, nothing recorded
 * repair.c     rules for edge types that have none
 */
#ifndef TARTAN_GENE_MAPPER_STATE_H
#define TARTAN_GENE_MAPPER_STATE_H

#include <stdlib.h>
#include <string.h>

#include "runtime/gene/mapper.h"

#define NO_ID UINT32_MAX
#define COPY 16u      /* short terminals are copied by this many bytes at once */
#define EDGE_TEXT 16u /* "Edge" and ten digits, at most */

/* What to go back to: a production after one of its non-terminals, or a loop. */
typedef struct frame {
    const uint32_t *ip; /* next word; of a loop: its first */
    uint32_t depth;
    uint32_t rule; /* that ends when this frame is popped (recording), of a loop: rounds so far */
    uint32_t ids[TN_EDGE_LETTERS];
    uint32_t mark; /* tn_rule_mark of the rule that ends when this frame is popped */
} frame;

typedef struct writing {
    char *data;
    size_t size, capacity;
} writing;

struct tn_mapper {
    const tn_grammar *grammar;
    frame *frames;
    size_t frame_capacity;
    writing text, added, repaired;
    tn_event *events;
    size_t event_count, event_capacity;
    /* genr8: edge types by number: does it occur, is there a rule for it */
    uint8_t *seen, *ruled;
    size_t id_capacity;
    uint32_t *repaired_ids;
    size_t repaired_count, repaired_capacity;
    /* the predecessor being written: its edges, and which context signs it has */
    uint32_t *predecessor;
    size_t predecessor_count, predecessor_capacity;
    bool in_predecessor, has_less, has_greater;
    size_t rule_end; /* where in the text the last rewrite rule ends */
    /* the genome, and how it is read */
    const uint64_t *codons;
    size_t count, position;
    uint64_t used, readable, steps_left;
    uint64_t nodes;
    uint32_t depth, max_depth, max_id;
    bool frozen; /* while repairing: no new edge types */
};

typedef enum outcome { RAN, NO_CODON, TOO_DEEP, TOO_LONG, NO_MEMORY } outcome;

/* Room for `more` items of `size` bytes after the first `used`, doubling. */
static inline bool reserve(void *items, size_t *capacity, size_t used, size_t more, size_t size)
{
    if (used + more <= *capacity)
        return true;
    size_t wanted = *capacity ? *capacity * 2 : 64;
    while (wanted < used + more)
        wanted *= 2;
    void *memory; /* `items` points to a pointer of any type */
    memcpy(&memory, items, sizeof memory);
    memory = realloc(memory, wanted * size);
    if (!memory)
        return false;
    memcpy(items, &memory, sizeof memory);
    *capacity = wanted;
    return true;
}

static inline bool append(writing *text, const char *data, size_t size)
{
    if (!reserve(&text->data, &text->capacity, text->size, size + 1, 1))
        return false;
    memcpy(text->data + text->size, data, size);
    text->size += size;
    text->data[text->size] = '\0';
    return true;
}

/* Keeps one step of the derivation. */
static inline bool record(tn_mapper *m, tn_event event)
{
    if (!reserve(&m->events, &m->event_capacity, m->event_count, 1, sizeof *m->events))
        return false;
    m->events[m->event_count++] = event;
    return true;
}

static inline bool read_codon(tn_mapper *m, uint64_t *codon)
{
    if (m->used >= m->readable)
        return false;
    if (m->position == m->count)
        m->position = 0;
    *codon = m->codons[m->position++];
    m->used++;
    return true;
}

/* Expands a rule at that depth to the end of the text. */
outcome tn_mapper_expand(tn_mapper *mapper, uint32_t rule, uint32_t depth, bool recorded);

/* What tn_mapper_expand(mapper, 0, 1, false) does of a ge grammar, faster. */
outcome tn_mapper_expand_ge(tn_mapper *mapper);

/* Gives every edge type that occurs a rule: the sentence with them is in mapper->repaired (5.1). */
outcome tn_mapper_repair(tn_mapper *mapper, const tn_map_options *options);

#endif
