/* Derivation trees as pictures. */
#ifndef TARTAN_GENOME_PICTURE_TREE_DRAW_H
#define TARTAN_GENOME_PICTURE_TREE_DRAW_H

#include "runtime/base/picture.h"
#include "runtime/genome/mapping/tree.h"

/* Draws the derivation as Fig. 7 does: non-terminals inside, terminals at the leaves, at most TN_TREE_DRAWN nodes
 * (TN_LIMIT, E1228). Errors of writing as tn_canvas_open has them. */
tn_status tn_tree_draw(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, tn_picture *to,
                       tn_error *error);

#define TN_TREE_DRAWN 4000u

#endif
