/* The shortest word of an automaton without its dead state, within lengths. */
#ifndef TARTAN_AUTOMATA_SHORTEST_H
#define TARTAN_AUTOMATA_SHORTEST_H

#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"

/* Of the shortest words of min..max letters that it accepts the first by letters, or *found = false. The caller frees
 * word->data. */
tn_status tn_sparse_shortest(const tn_sparse *sparse, uint32_t min, uint32_t max, tn_key *word, bool *found,
                             tn_error *error);

#endif
