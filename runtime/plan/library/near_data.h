/* What the files of near.h share. */
#ifndef TARTAN_PLAN_LIBRARY_NEAR_DATA_H
#define TARTAN_PLAN_LIBRARY_NEAR_DATA_H

#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"
#include "runtime/plan/library/near.h"
#include "runtime/plan/schema/classes.h"

#define TN_FAR UINT32_MAX

/* Some clauses of the library as one automaton, of the plans that all of them let in. */
typedef struct tn_near_part {
    tn_sparse *live;
    uint32_t *delta; /* [states][columns]; TN_NO_STATE: no way on */
    uint32_t *togo;  /* [cells][states], of the plan at hand: the least that is still to come; NULL: not known */
} tn_near_part;

struct tn_near_finder {
    const tn_schema *schema;
    const tn_library_record *record;
    tn_classes *classes;
    tn_dfa **clauses; /* [clause_count]: what each lets in, those with the fewest states first */
    size_t clause_count;
    size_t combine; /* edges */
    bool combined;  /* as far as it goes */
    uint32_t patience;
    tn_near_part *parts;
    size_t part_count;
    /* Joint columns: classes that no part tells apart, in order of their columns in the first part. */
    uint32_t joints;
    uint32_t *joint_of;    /* [classes] */
    uint32_t *joint_label; /* [joints][parts]: the column of each part */
    uint32_t *joint_first; /* [columns of the first part + 1] */
};

/* Combines the clauses into parts, each of at most finder->combine edges where it is of several (near_parts.c). */
tn_status tn_near_combine(tn_near_finder *finder, tn_error *error);

/* The plan at hand, and the band of it that is looked at: trays written less trays read are at most `width`, either
 * way. A cell is so many trays read and so many written. */
typedef struct tn_near_band {
    uint32_t length, width, min, max, fields;
} tn_near_band;

static inline size_t tn_near_cells(const tn_near_band *band)
{
    return ((size_t)band->length + 1) * (2 * (size_t)band->width + 1);
}

/* SIZE_MAX where it is outside the band. */
static inline size_t tn_near_cell(const tn_near_band *band, uint32_t read, uint32_t written)
{
    uint32_t off = written + band->width - read; /* may wrap: then it is large */
    if (read > band->length || written > band->max || off > 2 * band->width)
        return SIZE_MAX;
    return (size_t)read * (2 * (size_t)band->width + 1) + off;
}

/* The least that trays added or removed will cost: exact as far as lengths go, so never too much. */
uint32_t tn_near_to_come(const tn_near_band *band, uint32_t read, uint32_t written);

/* What each part alone costs to finish from each of its states and each cell; change: [length][joints], the fewest
 * fields to change for a tray of that joint column (near_parts.c). */
tn_status tn_near_lead(tn_near_finder *finder, const tn_near_band *band, const uint32_t *change, tn_error *error);

/* A node of the search: a tuple of states, one a part, in a cell. */
typedef struct tn_near_node {
    uint32_t tuple, cell;
    uint32_t cost;    /* from the start */
    uint32_t next;    /* of the same cell; or TN_FAR */
    uint64_t lengths; /* bit i: on a shortest path to a plan of the i-th length of the band */
} tn_near_node;

typedef struct tn_near_edge {
    uint32_t from, to, cost;
} tn_near_edge;

typedef struct tn_near_search {
    tn_near_finder *finder;
    const tn_tray *trays;
    tn_near_band band;
    uint32_t *change;  /* [length][joints] */
    uint32_t *by_cost; /* [length][joints]: joint columns of each column of the first part, cheapest change first */
    tn_interner tuples;
    tn_numbering numbers; /* of (tuple, cell) */
    tn_near_node *nodes;
    size_t node_capacity;
    tn_near_edge *edges;
    size_t edge_count, edge_capacity;
    uint32_t *first; /* [cells]: its last node */
    uint32_t limit;  /* nodes through which no path this short can go are left out */
    uint32_t beyond; /* the shortest that has been left out */
    uint32_t best;   /* the shortest path, or TN_FAR */
    uint32_t lowest; /* length: bit 0 of a node's lengths */
    tn_error *error;
} tn_near_search;

static inline uint64_t tn_near_key(const tn_near_search *s, uint32_t tuple, size_t cell)
{
    return (uint64_t)tuple * tn_near_cells(&s->band) + cell;
}

/* Writes the plans at the ends of shortest paths, in rank order (near_collect.c). */
tn_status tn_near_collect(tn_near_search *search, size_t most, tn_near *near);

#endif
