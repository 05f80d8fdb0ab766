/* Mapping: a genome chooses, codon by codon, the sentence of a grammar (Genr8 paper, 5.1 and 5.2).
 *
 * Depth-first, leftmost, the start symbol at depth 1. A genome of n codons with W wraps is read as if written W + 1
 * times. Position-independent mapping reads two codons at a time, of which the first says which non-terminal is
 * replaced next. The mapping is total: any codons, also none, give a sentence or a reason why there is none.
 *
 * A tn_mapper holds the scratch memory of one thread; make one for each. What a tn_mapping points to lives in the
 * mapper and is valid until its next use.
 */
#ifndef TARTAN_GENOME_MAPPING_MAPPER_H
#define TARTAN_GENOME_MAPPING_MAPPER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/grammar/grammar.h"

typedef struct tn_mapping_options {
    uint32_t wraps;     /* further readings of the genome */
    uint32_t max_depth; /* 0: no limit. ge: a deeper sentence is invalid; genr8: from there on only productions without
                           non-terminals are chosen */
    uint64_t max_steps; /* symbols and codons handled, a bound on time and memory; 0: TN_MAPPING_STEPS */
    tn_repair repair;   /* genr8 only */
    bool position_independent; /* where tn_grammar_takes_places says so only */
    bool record;               /* keep the derivation (tn_mapping.events) */
} tn_mapping_options;

#define TN_MAPPING_STEPS 1000000u
#define TN_MAPPING_STEP_BYTES 16u /* as many bytes of a terminal count as a step more */

/* What the grammar's own directives ask for. */
tn_mapping_options tn_mapping_options_of(const tn_grammar *grammar);

typedef enum tn_mapping_reason {
    TN_MAPPING_VALID,
    TN_MAPPING_OUT_OF_CODONS,
    TN_MAPPING_TOO_DEEP,
    TN_MAPPING_TOO_LONG,             /* max_steps */
    TN_MAPPING_REPAIR_OUT_OF_CODONS, /* the sentence itself is there */
    TN_MAPPING_REPAIR_TOO_LONG,
    TN_MAPPING_REASON_COUNT
} tn_mapping_reason;

/* In words, as "out of codons"; "" for TN_MAPPING_VALID. */
const char *tn_mapping_reason_text(tn_mapping_reason reason);

typedef enum tn_event_kind {
    TN_EVENT_EXPAND, /* a rule by a production, up to its TN_EVENT_END */
    TN_EVENT_END,
    TN_EVENT_TERMINAL,
    TN_EVENT_EDGE,   /* value: its number */
    TN_EVENT_AGAIN,  /* value > modulus - 2: a loop goes on, its body follows */
    TN_EVENT_STOP,   /* a loop ends */
    TN_EVENT_TAKE,   /* an option is taken, its body follows */
    TN_EVENT_SKIP,   /* or not */
    TN_EVENT_REPAIR, /* value: the edge type that gets a rule, whose successor follows */
    TN_EVENT_PLACE,  /* value: which of the modulus non-terminals is replaced, by the EXPAND that follows */
} tn_event_kind;

#define TN_NO_READ UINT64_MAX

/* One step of a derivation, in the order of the text. */
typedef struct tn_event {
    uint8_t kind;   /* tn_event_kind */
    char letter;    /* EDGE: 'X', 'Y' or 'Z' for a variable, else 0 */
    uint32_t depth; /* of the non-terminal; of the production that the step belongs to elsewhere */
    uint32_t
        symbol; /* EXPAND, END: rule; TERMINAL: terminal; EDGE: 1 for a new edge type; AGAIN, STOP: rounds so far */
    uint32_t production; /* EXPAND */
    uint64_t read;       /* how many codons were read before this step's own; TN_NO_READ if it reads none */
    uint64_t codon;
    uint64_t modulus, value; /* value = codon mod modulus */
    size_t text_begin;       /* in the sentence written so far */
} tn_event;

typedef struct tn_mapping {
    bool valid;
    tn_mapping_reason reason;
    bool has_phenotype;    /* also where only the repair failed */
    const char *phenotype; /* zero-ended */
    size_t phenotype_size;
    /* of the phenotype, before repair */
    uint64_t used; /* codons, counting past the end when wrapping */
    uint64_t nodes;
    uint32_t depth;
    uint64_t wraps; /* (used - 1) / n */
    /* genr8 */
    uint32_t max_id; /* how many edge types there are */
    bool repaired;   /* repair was asked for and done, even if there was nothing to add */
    const char *repaired_phenotype;
    size_t repaired_size;
    uint64_t repaired_used;
    const uint32_t *repaired_ids; /* edge types that got a rule, in that order */
    size_t repaired_count;
    /* where record was asked for; also of an invalid mapping, as far as it went */
    const tn_event *events;
    size_t event_count;
} tn_mapping;

typedef struct tn_mapper tn_mapper;

/* Borrows the grammar. NULL if out of memory. */
tn_mapper *tn_mapper_new(const tn_grammar *grammar);
void tn_mapper_free(tn_mapper *mapper);

/* Derives the genome's sentence. TN_OK also where the result is not valid; TN_MEMORY if memory ran out. */
tn_status tn_mapper_derive(tn_mapper *mapper, const uint64_t *codons, size_t count, const tn_mapping_options *options,
                           tn_mapping *mapping, tn_error *error);

/* What a valid mapping is for: the repaired sentence where there is one, else the phenotype. */
static inline const char *tn_mapping_sentence(const tn_mapping *mapping, size_t *size)
{
    *size = mapping->repaired ? mapping->repaired_size : mapping->phenotype_size;
    return mapping->repaired ? mapping->repaired_phenotype : mapping->phenotype;
}

/* The non-terminals of a sentential form, from left to right: any one is taken out by its place, and what replaces it
 * is put there. In blocks, so that a form of a million non-terminals is not moved for each. */

#define TN_SENTENTIAL_BLOCK 1024u

typedef struct tn_sentential_block {
    size_t count;
    uint32_t items[TN_SENTENTIAL_BLOCK];
} tn_sentential_block;

typedef struct tn_sentential {
    tn_sentential_block **blocks; /* owned: block_count in use, and behind them spare ones up to block_made */
    size_t block_count, block_made, block_capacity;
    size_t count;
    size_t block, place; /* where the next item is put */
} tn_sentential;

void tn_sentential_clear(tn_sentential *pending);

/* Empties it; its memory is used again. */
void tn_sentential_reset(tn_sentential *pending);

/* Takes out the item at `place`, which is below `count`. What is put next stands there. */
uint32_t tn_sentential_take(tn_sentential *pending, size_t place);

/* Puts an item behind what was put last. false if out of memory. */
bool tn_sentential_put(tn_sentential *pending, uint32_t item);

#endif
