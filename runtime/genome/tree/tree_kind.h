/* Trees of fields as a kind of genome (runtime/genome/breeding/kind.h): its sentence is a .field file. */
#ifndef TARTAN_GENOME_TREE_TREE_KIND_H
#define TARTAN_GENOME_TREE_TREE_KIND_H

#include <stdio.h>

#include "runtime/genome/breeding/kind.h"
#include "runtime/genome/tree/gene_tree.h"

/* Crossing and mutating trees (Evolutionary surfaces, 2.2). What the paper leaves open is settled in docs/evolution.md.
 */

typedef enum tn_tree_mutation {
    TN_TREE_SWAP_NODES,    /* two nodes that hold no call exchange their labels */
    TN_TREE_SWAP_SUBTREES, /* two subtrees, neither within the other, change places */
    TN_TREE_DESTROY,       /* a subtree becomes a coordinate, or a number or constant of the tree */
    TN_TREE_NUDGE,         /* a number is multiplied by 1 + 0.2 of a normal draw */
    TN_TREE_MUTATION_COUNT
} tn_tree_mutation;

typedef struct tn_tree_variation {
    tn_pick_order order;
    double maxprob;
    double mutation_rate;                  /* of a child */
    double shares[TN_TREE_MUTATION_COUNT]; /* of the kinds of mutation, in any sum */
    uint32_t max_nodes;                    /* of a child */
} tn_tree_variation;

/* Exchanges a subtree of each parent for one of the same class. weights: by which maxprob is multiplied for each
 * parent. *crossed[i] is false if child i is a copy of its parent: where nothing can be exchanged, and where all
 * attempts gave a child that is too large. */
tn_status tn_tree_cross(const tn_tree_variation *how, tn_chance *chance, const tn_gene_tree parents[2],
                        const double weights[2], tn_gene_tree children[2], bool crossed[2], tn_error *error);

/* Changes a tree, or not. `spare` is scratch memory, cleared by the caller. */
tn_status tn_tree_mutate(const tn_tree_variation *how, tn_chance *chance, tn_gene_tree *tree, tn_gene_tree *spare,
                         bool *mutated, tn_error *error);

/* A named constant: a terminal whose value goes with it. */
typedef struct tn_gene_constant {
    const char *name;
    double value;
} tn_gene_constant;

/* What trees are bred with: all of it the caller's, and there as long as the kind. */
typedef struct tn_tree_breeding {
    tn_tree_variation how;
    const tn_genome *parents; /* the first generation begins with them; the rest are their children */
    const double *weights;    /* by which maxprob is multiplied when they are crossed in the first generation */
    size_t parent_count;
    const tn_gene_constant *constants;
    uint32_t constant_count;
    const char *footer; /* of every sentence: its box, grid and unit */
} tn_tree_breeding;

tn_genome_kind tn_tree_kind(tn_tree_breeding *breeding);

/* Writes a tree as an expression, with the fewest parentheses and the shortest numbers that read back as the same tree.
 * Lines end where a sum goes on behind their 80th column; `column` is where the first begins. */
void tn_gene_tree_print(FILE *out, const tn_gene_tree *tree, const tn_gene_constant *constants, size_t column);

#endif
