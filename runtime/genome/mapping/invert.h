/* Mapping backwards: a genome for a sentence, or why there is none.
 *
 * The sentence is parsed by Earley's method (1970), extended by the loops, options and edge variables of the genr8
 * dialect. Among the derivations of a sentence one that stays within the depth limit is found if there is any. Mapping
 * the genome gives the sentence again, before repair.
 */
#ifndef TARTAN_GENOME_MAPPING_INVERT_H
#define TARTAN_GENOME_MAPPING_INVERT_H

#include "runtime/base/watch.h"
#include "runtime/genome/mapping/genome.h"
#include "runtime/grammar/grammar.h"

typedef struct tn_invert_options {
    uint32_t max_depth;        /* as in tn_mapping_options */
    bool position_independent; /* likewise; the genome replaces the leftmost non-terminal each time */
    size_t max_items;          /* parser states, a bound on time and memory; 0: TN_INVERT_ITEMS */
    tn_watch *watch; /* or NULL: parsing is given up (TN_STOPPED) once this says so; it is told bytes or tokens */
} tn_invert_options;

#define TN_INVERT_ITEMS 2000000u

/* In the genr8 dialect the sentence's tokens are parted by white space of any kind. TN_INVALID (E1222) with the column
 * and what was expected there, TN_LIMIT (E1223), TN_MEMORY. */
tn_status tn_invert(const tn_grammar *grammar, const char *sentence, size_t size, const tn_invert_options *options,
                    tn_genome *genome, tn_error *error);

#endif
