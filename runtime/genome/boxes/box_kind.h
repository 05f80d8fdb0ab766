/* Designs of boxes as a kind of genome (runtime/genome/breeding/kind.h): a list of boxes, nine genes each, as the bits
 * of doubles; their sentence is a .solid file (Bentley, 4.3.4; what that leaves open is settled in docs/evolution.md).
 *
 * Two children of a crossing have each box of their parents once. The boxes of the skeleton, which are never varied,
 * are in the text around the bred ones.
 */
#ifndef TARTAN_GENOME_BOXES_BOX_KIND_H
#define TARTAN_GENOME_BOXES_BOX_KIND_H

#include "runtime/genome/breeding/kind.h"
#include "runtime/geometry/union/cut_box.h"

/* What designs are bred with: all of it the caller's, and there as long as the kind. */
typedef struct tn_box_breeding {
    double low[TN_BOX_GENES], high[TN_BOX_GENES]; /* of each gene */
    uint32_t least, most;                         /* boxes of a genome; least is 1 or more */
    double mutation_rate;                         /* of each gene; below 0: one of a genome on the mean */
    double split, delete_;                        /* of a birth */
    uint32_t flags;                               /* of the design: TN_SOLID_FLAT and so on */
    double depth;                                 /* of a flat one */
    const char *head, *foot;                      /* lines of the design before its bred boxes, and behind them */
} tn_box_breeding;

tn_genome_kind tn_box_kind(tn_box_breeding *breeding);

/* Moves a gene into its range, by reflecting it at the ends, and to the steps of its kind. */
double tn_box_gene(const tn_box_breeding *breeding, uint32_t gene, double value);

/* Splits box `at` of a genome across an axis in two that take the same room: the halves stand in its place and at the
 * end of the list. False if out of memory. */
bool tn_box_split(tn_genome *genome, uint32_t at, int axis);

#endif
