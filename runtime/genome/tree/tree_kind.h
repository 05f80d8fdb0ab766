/* Trees of fields as a kind of genome (runtime/genome/breeding/kind.h): its sentence is a .field file. */
#ifndef TARTAN_GENOME_TREE_TREE_KIND_H
#define TARTAN_GENOME_TREE_TREE_KIND_H

#include <stdio.h>

#include "runtime/genome/breeding/kind.h"
#include "runtime/genome/tree/vary_tree.h"

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
