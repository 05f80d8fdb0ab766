/* The cells of space that are filled: bits in chunks of 64 x 32 x 32, found through a hash table.
 *
 * A row of 64 cells along x is one word, so that a box is looked at or filled a word at a time. The chunk used last is
 * remembered: what is placed lies near what was placed before. Coordinates are cells, from -2^28 to 2^28. */
#ifndef TARTAN_PLACE_CELLS_H
#define TARTAN_PLACE_CELLS_H

#include "runtime/place/model/frame.h"

enum {
    TN_CHUNK_SHIFT_X = 6,
    TN_CHUNK_SHIFT_YZ = 5,
    TN_CHUNK_WIDTH = 1 << TN_CHUNK_SHIFT_X, /* cells of a chunk along x */
    TN_CHUNK_ROWS = 1 << TN_CHUNK_SHIFT_YZ, /* along y, and along z */
    TN_CHUNKS_NEAR = 4,
};

/* The chunk that a cell is in, along an axis (0 x, 1 y, 2 z), its place in it, and the first cell of a chunk. The
 * origin is in the middle of a chunk: models lie about it. */
static inline int tn_cell_chunk_shift(int axis)
{
    return axis == 0 ? TN_CHUNK_SHIFT_X : TN_CHUNK_SHIFT_YZ;
}

static inline int32_t tn_cell_chunk_of(int32_t cell, int axis)
{
    return (cell + (1 << tn_cell_chunk_shift(axis)) / 2) >> tn_cell_chunk_shift(axis);
}

static inline int32_t tn_cell_chunk_place(int32_t cell, int axis)
{
    return (cell + (1 << tn_cell_chunk_shift(axis)) / 2) & ((1 << tn_cell_chunk_shift(axis)) - 1);
}

static inline int32_t tn_cell_chunk_start(int32_t chunk, int axis)
{
    return chunk * (1 << tn_cell_chunk_shift(axis)) - (1 << tn_cell_chunk_shift(axis)) / 2;
}

typedef struct tn_cells tn_cells;

/* watch: who waits for the filling, borrowed, or NULL. NULL if out of memory. */
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

typedef struct tn_cell_chunk {
    int32_t at[3];                              /* in chunks */
    uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS]; /* [y][z]: bits along x */
} tn_cell_chunk;

/* Open, so that looking at a box takes no call; only cells.c changes them. */
struct tn_cells {
    tn_cell_chunk **slots; /* open addressing; at most half full */
    size_t slot_count, chunk_count;
    tn_cell_chunk *near[TN_CHUNKS_NEAR][TN_CHUNKS_NEAR]
                       [TN_CHUNKS_NEAR]; /* the chunk used last of those whose coordinates leave these remainders */
    uint64_t filled;
    tn_watch *watch;
    const tn_cell_space *space; /* or NULL */
    tn_status status;           /* of looking at the space */
    tn_error error;
};

/* From here on boxes that are not inside of the space are not free. Before anything is filled; borrowed. */
void tn_cells_bound(tn_cells *cells, const tn_cell_space *space);

/* Where looking at a chunk of the space failed, boxes are not free, and this says why. */
tn_status tn_cells_status(const tn_cells *cells, tn_error *error);

/* How many cells are filled. */
uint64_t tn_cells_count(const tn_cells *cells);

/* A filled cell of the box, the lowest by x, then y, then z; false if there is none. */
bool tn_cells_first(tn_cells *cells, const tn_cell_box *box, int32_t cell[3]);

/* Fills the box; cells that are filled stay so. TN_STOPPED if the watch says so. */
tn_status tn_cells_fill(tn_cells *cells, const tn_cell_box *box, tn_error *error);

/* Makes the box free again, which was free before it was filled. */
void tn_cells_empty(tn_cells *cells, const tn_cell_box *box);

static inline bool tn_cell_chunk_is_at(const tn_cell_chunk *chunk, const int32_t at[3])
{
    return ((chunk->at[0] ^ at[0]) | (chunk->at[1] ^ at[1]) | (chunk->at[2] ^ at[2])) == 0;
}

static inline tn_cell_chunk **tn_cells_near(tn_cells *cells, const int32_t at[3])
{
    return &cells->near[at[0] & (TN_CHUNKS_NEAR - 1)][at[1] & (TN_CHUNKS_NEAR - 1)][at[2] & (TN_CHUNKS_NEAR - 1)];
}

/* The first row of a part, how many there are along y and z, and the bits of each. */
typedef struct tn_cell_rows {
    uint64_t *first;
    uint64_t bits;
    int high, deep;
} tn_cell_rows;

static inline tn_cell_rows tn_cell_rows_of(tn_cell_chunk *chunk, const int32_t low[3], const int32_t last[3])
{
    uint64_t from = UINT64_MAX << tn_cell_chunk_place(low[0], 0);
    return (tn_cell_rows){.first = &chunk->row[tn_cell_chunk_place(low[1], 1)][tn_cell_chunk_place(low[2], 2)],
                          .bits = from & UINT64_MAX >> (TN_CHUNK_WIDTH - 1 - tn_cell_chunk_place(last[0], 0)),
                          .high = last[1] - low[1] + 1,
                          .deep = last[2] - low[2] + 1};
}

static inline bool tn_cell_rows_any(const tn_cell_rows *rows)
{
    const uint64_t *row = rows->first;
    for (int y = 0; y < rows->high; y++, row += TN_CHUNK_ROWS)
        for (int z = 0; z < rows->deep; z++)
            if (row[z] & rows->bits)
                return true;
    return false;
}

/* The same as tn_cells_any, for any box. */
bool tn_cells_any_far(tn_cells *cells, const tn_cell_box *box);

/* Is any cell of the box filled? Most boxes are those of a lookahead, and lie in one chunk that was used lately. */
static inline bool tn_cells_any(tn_cells *cells, const tn_cell_box *box)
{
    const int32_t *low = box->low, last[3] = {box->high[0] - 1, box->high[1] - 1, box->high[2] - 1};
    const int32_t at[3] = {tn_cell_chunk_of(low[0], 0), tn_cell_chunk_of(low[1], 1), tn_cell_chunk_of(low[2], 2)};
    bool empty = low[0] > last[0] || low[1] > last[1] || low[2] > last[2];
    bool one = tn_cell_chunk_of(last[0], 0) == at[0] && tn_cell_chunk_of(last[1], 1) == at[1] &&
               tn_cell_chunk_of(last[2], 2) == at[2];
    tn_cell_chunk *chunk = *tn_cells_near(cells, at);
    if (empty || !one || !chunk || !tn_cell_chunk_is_at(chunk, at))
        return tn_cells_any_far(cells, box);
    const tn_cell_rows rows = tn_cell_rows_of(chunk, low, last);
    return tn_cell_rows_any(&rows);
}

/* Is this cell filled? */
static inline bool tn_cells_has(tn_cells *cells, const int32_t cell[3])
{
    const tn_cell_box one = {{cell[0], cell[1], cell[2]}, {cell[0] + 1, cell[1] + 1, cell[2] + 1}};
    const int32_t at[3] = {tn_cell_chunk_of(cell[0], 0), tn_cell_chunk_of(cell[1], 1), tn_cell_chunk_of(cell[2], 2)};
    const tn_cell_chunk *chunk = *tn_cells_near(cells, at);
    if (!chunk || !tn_cell_chunk_is_at(chunk, at))
        return tn_cells_any_far(cells, &one);
    return chunk->row[tn_cell_chunk_place(cell[1], 1)][tn_cell_chunk_place(cell[2], 2)] >>
               tn_cell_chunk_place(cell[0], 0) &
           1;
}

/* The shells of bounds, which fill their cells at once: nothing is placed through them. */

/* The shell of a box about the frame; its heading does not count. */
tn_status tn_bound_box(tn_cells *cells, const tn_frame *frame, const tn_step *step, tn_error *error);

/* The shell of a ball about the origin. */
tn_status tn_bound_ball(tn_cells *cells, int32_t radius, tn_error *error);

#endif
