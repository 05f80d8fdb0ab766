/* Boxes of designs that are bred: what a list of genes means, as `genes (...)` of the language does. */
#ifndef TARTAN_SOLID_GENES_H
#define TARTAN_SOLID_GENES_H

#include "runtime/geometry/union/box_genes.h"
#include "runtime/solid/design.h"

/* The box of nine genes in steps, in a design of these flags (TN_SOLID_FLAT, with its depth; TN_SOLID_NOCLIP). */
void tn_box_of_genes(const double genes[TN_BOX_GENES], uint32_t flags, double depth, tn_solid_box *box);

#endif
