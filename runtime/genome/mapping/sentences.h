/* How many sentences a grammar has, where these are few. */
#ifndef TARTAN_GENOME_MAPPING_SENTENCES_H
#define TARTAN_GENOME_MAPPING_SENTENCES_H

#include "runtime/genome/mapping/mapper.h"

/* Maps all derivations in turn, as an odometer counts: the last codon that has another choice takes it, and those
 * behind it begin anew. *count: the different valid sentences; SIZE_MAX where there are more than `most` derivations,
 * or one that reads more codons than TN_SENTENCE_CODONS_MAX. Wraps are not looked at: genomes are as long as they are
 * read. TN_MEMORY, or TN_OK. */
tn_status tn_count_sentences(const tn_grammar *grammar, const tn_mapping_options *options, size_t most, size_t *count,
                             tn_error *error);

#define TN_SENTENCE_CODONS_MAX 4096u

#endif
