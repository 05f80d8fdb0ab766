/* Genomes as text: codons are unsigned 64-bit numbers in decimal, separated by blanks, a genome a line. */
#ifndef TARTAN_GENOME_MAPPING_GENOME_H
#define TARTAN_GENOME_MAPPING_GENOME_H

#include "runtime/base/error.h"
#include "runtime/genome/mapping/mapper.h"

typedef struct tn_genome {
    uint64_t *codons; /* owned; free with tn_genome_clear */
    size_t count, capacity;
} tn_genome;

void tn_genome_clear(tn_genome *genome);

/* Makes room for `count` codons in all. */
bool tn_genome_reserve(tn_genome *genome, size_t count);

#define TN_GENOME_CODONS_MAX (1u << 24)

/* Reads one line (no newline in it) into a genome, which it empties first. TN_INVALID (E1220, E1221) with the column;
 * the line is the caller's to set. TN_LIMIT past TN_GENOME_CODONS_MAX. Commas may stand beside blanks. */
tn_status tn_genome_read(const char *line, size_t length, tn_genome *genome, tn_error *error);

/* The codons as text, which the caller frees; NULL: out of memory. */
char *tn_genome_text(const tn_genome *genome);

/* The subtrees of a derivation as stretches of its genome: reading depth-first, leftmost, a subtree's codons lie side
 * by side, so that a subtree can be changed for another of the same rule by changing one stretch for another. */

typedef struct tn_span_of {
    uint32_t rule;
    uint32_t depth;      /* of its root */
    uint32_t event;      /* that expands it */
    uint64_t begin, end; /* codons, counting past the genome's end where it wraps */
} tn_span_of;

typedef struct tn_spans {
    tn_span_of *items; /* in order of their begin; owned */
    size_t count, capacity;
    uint32_t *open; /* scratch */
    size_t open_capacity;
} tn_spans;

/* The subtrees of a recorded mapping that has a phenotype; those of repair are left out. false if out of memory. */
bool tn_spans_find(const tn_mapping *mapping, tn_spans *spans);
void tn_spans_clear(tn_spans *spans);

/* Puts the codons that a mapping read, wraps written out, and the unread rest into `straight`. */
bool tn_genome_straighten(const uint64_t *codons, size_t count, const tn_mapping *mapping, tn_genome *straight);

/* The same of a position-independent mapping that is valid: the genome that replaces the leftmost non-terminal each
 * time and derives the same, so that a subtree's codons lie side by side. The events are made those of that genome. */
bool tn_events_straighten(tn_event *events, size_t count, const uint64_t *codons, size_t codon_count, uint64_t used,
                          tn_genome *straight);

/* Can a codon make its rule choose the production, at that depth? */
bool tn_can_choose(const tn_grammar *grammar, uint32_t production, uint32_t depth, uint32_t max_depth);

/* A codon, near to `codon`, that makes `rule` at `depth` choose `production`; false if it cannot there, since from
 * max_depth on only productions without non-terminals are chosen (genr8). */
bool tn_choice_codon(const tn_grammar *grammar, uint32_t production, uint32_t depth, uint32_t max_depth,
                     uint64_t *codon);

#endif
