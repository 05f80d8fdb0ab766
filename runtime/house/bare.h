/* Why a plan has no house: the cells that no function may take, and those in which no function has a tile that stands
 * or, if the form asks for ways, in which nobody can go about, whatever is in the walls around them.
 *
 * Each cell is looked at by itself: the cells beside it may have any function that they may have, and walls elsewhere
 * are left out; nothing is asked of functions with flights of stairs. So a cell that is found keeps all houses off the
 * plan, and there can be no house where none is found.
 */
#ifndef TARTAN_HOUSE_BARE_H
#define TARTAN_HOUSE_BARE_H

#include "runtime/house/ways.h"

/* house: the plan in the first of the sections in which the fewest cells are bare. Owns its arrays. */
typedef struct tn_bare_cells {
    tn_house house;
    uint32_t *cells;
    size_t count; /* 0: in some section no cell is */
} tn_bare_cells;

/* TN_LIMIT (E1617) where that takes too many steps. Clear *bare in any case. */
tn_status tn_bare_find(const tn_house_form *form, const tn_tray *trays, size_t length, tn_bare_cells *bare,
                       tn_error *error);
void tn_bare_clear(tn_bare_cells *bare);

/* What keeps a tile out of a bare cell with a function: of all that may be in the walls around it, that with which it
 * comes furthest. */
tn_status tn_bare_why(tn_bare_cells *bare, uint32_t cell, uint32_t function, uint32_t tile, tn_tile_failure *failure,
                      tn_error *error);

/* What is wrong with the ways through a bare cell with a function that has no tiles: of all that may be in its walls,
 * that with which most is right. */
tn_status tn_bare_fault(tn_bare_cells *bare, uint32_t cell, uint32_t function, tn_way_fault *fault, tn_error *error);

#endif
