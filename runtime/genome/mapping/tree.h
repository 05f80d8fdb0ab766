/* A derivation shown: as a table codon by codon (Genr8 paper, 5.2), as a tree in text or JSON, or as a picture (Fig.
 * 7).
 *
 * All take the events of a mapping made with tn_mapping_options.record; also an invalid mapping's, as far as it went.
 */
#ifndef TARTAN_GENOME_MAPPING_TREE_H
#define TARTAN_GENOME_MAPPING_TREE_H

#include <stdio.h>

#include "runtime/genome/mapping/mapper.h"

#define TN_TREE_NONE UINT32_MAX

/* Events by where they hang: children of an expansion are what it wrote and expanded. */
typedef struct tn_tree_node {
    uint32_t event;
    uint32_t parent, first_child, next; /* nodes, or TN_TREE_NONE */
    uint32_t event_end;                 /* of an expansion: the event that ends it, or the number of events */
} tn_tree_node;

typedef struct tn_tree {
    tn_tree_node *nodes; /* in order of events; owned */
    size_t count;
} tn_tree;

/* Expansions, terminals, edges and repairs become nodes, and loops and options that ended or were not taken as well.
 * Free with tn_tree_clear. TN_LIMIT past 2^32 - 2 events. */
tn_status tn_tree_make(const tn_event *events, size_t count, tn_tree *tree, tn_error *error);
void tn_tree_clear(tn_tree *tree);

/* Calls for each node on the way down and, where `leave` is given, for each on the way up; without recursion, since a
 * derivation may be as deep as it is long. */
typedef void tn_tree_visit(void *context, uint32_t node, uint32_t depth);
void tn_tree_walk(const tn_tree *tree, tn_tree_visit *enter, tn_tree_visit *leave, void *context);

/* One line a codon, in the order in which they were read: its number, the codon, what read it, and what it chose. false
 * if writing failed. */
bool tn_trace_write(const tn_grammar *grammar, const tn_event *events, size_t count, FILE *out);

/* One node a line, indented. */
bool tn_tree_write_text(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, FILE *out);

/* {"symbol", "depth", "codon", "modulus", "choice", "children": [...]}, {"terminal"}, {"edge", "letter", ...}; codons,
 * which JSON readers may round, are decimal text. Roots are an array. */
bool tn_tree_write_json(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, FILE *out);

/* Writes a production as the grammar file has it. */
void tn_production_write(const tn_grammar *grammar, uint32_t production, FILE *out);

#endif
