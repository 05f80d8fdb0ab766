/* Strings of codons as a kind of genome: a grammar maps them to sentences. */
#ifndef TARTAN_GENOME_BREEDING_CODON_KIND_H
#define TARTAN_GENOME_BREEDING_CODON_KIND_H

#include "runtime/genome/breeding/evolve.h"

/* Borrows the grammar and copies the settings. Free the kind in any case. */
tn_status tn_codon_kind_new(const tn_grammar *grammar, const tn_evolution_settings *settings, tn_genome_kind *kind,
                            tn_error *error);
void tn_codon_kind_free(tn_genome_kind *kind);

/* From here on children vary so. */
void tn_codon_kind_vary(tn_genome_kind *kind, const tn_vary_options *vary);

#endif
