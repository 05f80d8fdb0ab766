/* An explanation under construction, for the files that implement explain.h. */
#ifndef TARTAN_PLAN_ANALYSIS_EXPLAIN_DATA_H
#define TARTAN_PLAN_ANALYSIS_EXPLAIN_DATA_H

#include "runtime/plan/analysis/explain.h"
#include "runtime/plan/match/relation.h"
#include "runtime/plan/match/vm.h"

typedef struct tn_explaining {
    tn_explanation *result;
    tn_plan_vm *vm;
    uint64_t ***relations; /* [tree][part * 2 + mirrored]: in places of the plan as it is, or NULL */
    uint64_t bytes;        /* of the relations */
    size_t words;          /* of a row */
    unsigned depth;
    tn_error *error;
} tn_explaining;

/* A part of a tree, read in a direction. */
typedef struct tn_reader_of {
    uint32_t tree, part;
    bool mirrored;
} tn_reader_of;

static inline const tn_part *tn_part_of(const tn_explaining *e, tn_reader_of who)
{
    return &e->result->trees[who.tree].parts[who.part];
}

static inline tn_reader_of tn_child(tn_reader_of who, uint32_t child)
{
    return (tn_reader_of){who.tree, child, who.mirrored};
}

/* The relation M of a part (H for parts judged as a region), found once. */
tn_status tn_explain_relation(tn_explaining *e, tn_reader_of who, const uint64_t **relation);

/* The tree of a function, read once. */
tn_status tn_explain_tree(tn_explaining *e, uint32_t function, uint32_t *tree);

static inline bool tn_in(const tn_explaining *e, const uint64_t *relation, tn_stretch s)
{
    return tn_relation_row_has(relation + s.begin * e->words, s.end);
}

tn_status tn_explain_stretch(tn_explaining *e, uint32_t node, tn_stretch stretch); /* adds one where it matched */
tn_status tn_explain_gap(tn_explaining *e, uint32_t node, tn_gap gap);

/* How a part is asked for. */
typedef enum tn_asked {
    TN_ASKED_AS_WRITTEN, /* somewhere in the region where the code says so, otherwise of the region as a whole */
    TN_ASKED_SOMEWHERE,
    TN_ASKED_SINGLES, /* the single trays that it matches */
    TN_ASKED_STARTS,  /* the places that it matches from */
} tn_asked;

/* Adds a node for a part, under `parent` (TN_NO_WHY: the root), with everything below it. *node: its index. */
tn_status tn_explain_part(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t parent,
                          uint32_t *node);

/* ---- explain_neighbour.c, explain_distance.c: the parts below a node of that kind */
tn_status tn_explain_neighbour(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch);
tn_status tn_explain_no_neighbour(tn_explaining *e, tn_reader_of who, uint32_t node);
tn_status tn_explain_repeat(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch);
tn_status tn_explain_distance(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch);

/* What a quantity, sum or occurrences counts in a stretch; TN_NO_NUMBER for other parts. */
tn_status tn_explain_number(tn_explaining *e, tn_reader_of who, tn_stretch region, int64_t *number);

#endif
