/* Builds automata whose states are keys (runs of words), discovered breadth first from a start key. */
#ifndef TARTAN_AUTOMATA_EXPLORE_H
#define TARTAN_AUTOMATA_EXPLORE_H

#include "runtime/automata/dfa.h"
#include "runtime/automata/numbering.h"

typedef struct tn_construction {
    const char *what;    /* for errors: "the automaton of this ... passes" */
    const tn_join *join; /* the columns to explore */
    void *context;
    /* The key that a column leads to, in canonical form (`next` is empty to begin with); false where out of memory.
     * `size` words of `key` stay where they are during the call. */
    bool (*step)(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next);
    bool (*accepts)(void *context, const uint32_t *key, size_t size);
} tn_construction;

/* The minimal automaton of a construction. A key's size and a construction's own count of steps (`*effort`, which step
 * adds to, or NULL) both count as work. */
tn_status tn_explore(const tn_construction *construction, const tn_key *start, const uint64_t *effort,
                     tn_bounds *bounds, tn_dfa **out, tn_error *error);

#endif
