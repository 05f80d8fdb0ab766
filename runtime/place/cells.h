/* The cells of space that are filled: bits in chunks of 64 x 16 x 16, found through a hash table.
 *
 * A row of 64 cells along x is one word, so that a box is looked at or filled a word at a time. The chunk used last is
 * remembered: what is placed lies near what was placed before. Coordinates are cells, from -2^28 to 2^28. */
#ifndef TARTAN_PLACE_CELLS_H
#define TARTAN_PLACE_CELLS_H

#include "runtime/place/model/frame.h"

enum { TN_CHUNK_WIDTH = 64, TN_CHUNK_ROWS = 16 }; /* cells of a chunk along x, and along y and z */

typedef struct tn_cells tn_cells;

/* watch: who waits for the filling, borrowed, or NULL. NULL where out of memory. */
tn_cells *tn_cells_new(tn_watch *watch);
void tn_cells_free(tn_cells *cells);

/* What nothing may fill, a chunk at a time: `box` holds all that is free, and `outside` sets the bits of cells of the
 * chunk at `at` (in chunks) that are not. TN_OK or why not. */
typedef struct tn_cell_space {
    tn_cell_box box;
    tn_status (*outside)(void *context, const int32_t at[3], uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS],
                         tn_error *error);
    void *context;
} tn_cell_space;

/* From here on boxes that are not inside of the space are not free. Before anything is filled; borrowed. */
void tn_cells_bound(tn_cells *cells, const tn_cell_space *space);

/* Where looking at a chunk of the space failed, boxes are not free, and this says why. */
tn_status tn_cells_status(const tn_cells *cells, tn_error *error);

/* How many cells are filled. */
uint64_t tn_cells_count(const tn_cells *cells);

/* Is any cell of the box filled? */
bool tn_cells_any(tn_cells *cells, const tn_cell_box *box);

/* A filled cell of the box, the lowest by x, then y, then z; false where there is none. */
bool tn_cells_first(tn_cells *cells, const tn_cell_box *box, int32_t cell[3]);

/* Fills the box; cells that are filled stay so. TN_STOPPED where the watch says so. */
tn_status tn_cells_fill(tn_cells *cells, const tn_cell_box *box, tn_error *error);

/* Makes the box free again, which was free before it was filled. */
void tn_cells_empty(tn_cells *cells, const tn_cell_box *box);

#endif
