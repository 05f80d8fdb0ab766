/* What a frontier keeps for ranks, which ask for the same again and again (slice.c, step.c). */
#ifndef TARTAN_HOUSE_FRONTIER_KEPT_H
#define TARTAN_HOUSE_FRONTIER_KEPT_H

#include "runtime/plan/automata/numbering.h"

/* Slices of a tray or outcomes of an interface, one for each choice, in the order of the choices. Kinds are what is in
 * it, ascending, each once; items are places in these. */
typedef struct tn_frontier_sequence {
    uint32_t *kinds, *items;
    size_t kind_count, count;
} tn_frontier_sequence;

/* Sequences by {tray, functions of its cells}, or {left edge, right edge, functions of both}. */
typedef struct tn_frontier_orders {
    tn_interner keys;
    tn_frontier_sequence *of; /* [keys]; without kinds: not known */
    size_t room, items;       /* items: of all */
} tn_frontier_orders;

/* A way that a step goes on: over an outcome of the interface, of which there are so many choices, to the state
 * `after`, with so many arrangements of tiles for each. */
typedef struct tn_frontier_way {
    uint32_t outcome, after;
    uint64_t choices, tiles;
} tn_frontier_way;

typedef struct tn_frontier_ways_of_step {
    size_t first, count; /* of the items; by outcome */
} tn_frontier_ways_of_step;

/* Those of the steps after so many trays. */
typedef struct tn_frontier_ways_after {
    tn_numbering keys;            /* state << 32 | slice */
    tn_frontier_ways_of_step *of; /* [keys] */
    size_t room;
} tn_frontier_ways_after;

typedef struct tn_frontier_ways {
    bool wanted;                   /* ranks have begun: counting goes each step once */
    tn_frontier_ways_after *after; /* [trays_most + 1] */
    tn_frontier_way *items;
    size_t first, count, room, steps; /* first: of the step that is being kept; steps: of all */
} tn_frontier_ways;

#endif
