/* Opens a file once more, from the texts that were opened before, with something changed in its syntax trees: what it
 * would mean if it were written otherwise. Nothing is read from a disk.
 */
#ifndef TARTAN_DRIVER_OPEN_AGAIN_H
#define TARTAN_DRIVER_OPEN_AGAIN_H

#include "driver/open/open.h"

/* Called for the tree of each text, those that others use first; main: it is the file itself. What is added to a tree
 * lives in the arena. */
typedef void tn_change_tree(void *context, tn_arena *arena, void *tree, bool main);

/* Of a .plan file that was compiled. Close it in any case, and before the other one. */
tn_status tn_open_again(const tn_opened *opened, tn_change_tree *change, void *context, tn_opened *again);

#endif
