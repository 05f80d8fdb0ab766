/* The space of a kit's model, as cells: those whose middle is inside.
 *
 * A space is made for one derivation and one thread; free it after the cells that it bounds. */
#ifndef TARTAN_PLACE_SPACE_H
#define TARTAN_PLACE_SPACE_H

#include "runtime/place/cells.h"

typedef struct tn_space tn_space;

/* TN_MEMORY or TN_OK. The rules are those of a kit's model; their module has to outlive the space. */
tn_status tn_space_new(const tn_place_rules *rules, tn_space **space, tn_error *error);
void tn_space_free(tn_space *space);

/* As cells see it. */
const tn_cell_space *tn_space_cells(const tn_space *space);

/* How many cells are inside. Asks `watch` (or NULL) whether to go on. */
tn_status tn_space_count(tn_space *space, tn_watch *watch, uint64_t *count, tn_error *error);

#endif
