/* Looks for the shortest word that some automata accept and others do not: the one question behind every finding of the
 * analysis (inclusion, disjointness, redundancy, emptiness).
 *
 * The product of the automata is explored breadth first, as far as it takes to answer, and never built: no union and no
 * complement is made. A tuple of states from which one of the automata can no longer answer as wanted is dropped at
 * once.
 */
#ifndef TARTAN_AUTOMATA_SEARCH_H
#define TARTAN_AUTOMATA_SEARCH_H

#include "runtime/automata/dfa.h"
#include "runtime/automata/numbering.h"

typedef struct tn_search_part {
    const tn_dfa *dfa; /* minimal; all of a search over the same letters */
    bool accepts;      /* what it is to say of the word */
} tn_search_part;

#define TN_SEARCH_WORK UINT64_C(400000000) /* under a second */

typedef struct tn_search {
    const tn_search_part *parts;
    size_t count;      /* at least 1 */
    uint32_t min, max; /* letters of the word; max UINT32_MAX: any number */
    const char *what;  /* for errors: "the automaton of this ... passes" */
    uint32_t max_states;
    uint64_t max_work; /* steps; 0: TN_SEARCH_WORK */
    tn_watch *watch;   /* as in tn_bounds */
} tn_search;

/* The shortest such word (of those, the first by letters), as letters in `word`, or *found = false. The caller frees
 * word->data. TN_LIMIT (E0802) past max_states tuples or max_work steps. */
tn_status tn_search_shortest(const tn_search *search, tn_key *word, bool *found, tn_error *error);

/* Does the automaton accept the word? */
bool tn_dfa_accepts(const tn_dfa *dfa, const uint32_t *word, size_t length);

#endif
