/* Genomes as text: codons are unsigned 64-bit numbers in decimal, separated by blanks, a genome a line. */
#ifndef TARTAN_GENOME_MAPPING_GENOME_H
#define TARTAN_GENOME_MAPPING_GENOME_H

#include "runtime/base/error.h"

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

#endif
