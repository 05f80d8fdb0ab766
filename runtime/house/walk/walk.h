/* Walks through a house whose form asks for ways: how long the shortest are, and how many ways out do without each
 * other (docs/houses.md).
 *
 * A walk goes from one passage to another: over the free floors of cells (floor/paths.h), through walls and open sides,
 * and by flights of stairs. One passes through the middle of a passage; an open side with a bare cell is passed at both
 * of its ends, too. What stands in rooms is in the way: the house has its tiles.
 */
#ifndef TARTAN_HOUSE_WALK_WALK_H
#define TARTAN_HOUSE_WALK_WALK_H

#include "runtime/automata/numbering.h"
#include "runtime/house/floor/paths.h"
#include "runtime/house/ways.h"

/* Lengths over floors that were found before, as floors of many houses are alike. Zero it to begin with. */
typedef struct tn_walk_floors {
    tn_interner floors;
    tn_key key;
    int64_t **lengths; /* [floors][ends][ends]; owned */
    size_t room;
    tn_interner alike; /* points of cells, with the lengths between them */
} tn_walk_floors;
void tn_walk_floors_clear(tn_walk_floors *floors);

/* Where a passage is passed, or the landing of a flight. */
typedef enum tn_walk_spot { TN_SPOT_MIDDLE, TN_SPOT_LOW, TN_SPOT_HIGH, TN_SPOT_LANDING } tn_walk_spot;

#define TN_NO_POINT UINT32_MAX

/* A place in a cell where walks come in or go out; over: the point on the other side of the face, so far away, or
 * TN_NO_POINT. */
typedef struct tn_walk_point {
    uint32_t cell, face;
    tn_walk_spot spot;
    tn_point at;
    uint32_t over;
    int64_t across;
} tn_walk_point;

/* Of a cell: what stands on its floor, and its points. */
typedef struct tn_walk_cell {
    tn_cell_floor floor;
    uint32_t first, count;
    const int64_t *lengths; /* [count][count], borrowed of tn_walk_floors */
    bool has_passage;
} tn_walk_cell;

/* The points of a house. first_of, second_of: is the face a passage of its first cell, or of its second? Borrows the
 * house, which may be gone when they are cleared; owns the rest. */
typedef struct tn_walks {
    const tn_house *house;
    tn_flights flights;
    tn_walk_cell *cells;
    size_t cell_count;
    tn_walk_point *points;
    uint32_t count;
    size_t room;
    bool *first_of, *second_of; /* [faces] */
} tn_walks;

/* floors: of houses of the same form, and good until the walks are cleared. TN_MEMORY. Clear it in any case. */
tn_status tn_walks_find(const tn_house *house, tn_walk_floors *floors, tn_walks *walks, tn_error *error);
void tn_walks_clear(tn_walks *walks);

/* A number for each of the tiles that fit in a cell: with those that have the same, all walks are as long. */
tn_status tn_walk_tiles(const tn_house *house, uint32_t cell, const tn_variants *tiles, tn_walk_floors *floors,
                        uint32_t *numbers, tn_error *error);

/* Which walks: to cells that are so, or outside; through cells that are so; by faces that are so. */
typedef struct tn_walk_asked {
    const bool *to;      /* [cells] NULL: outside, where cells in the open on the ground are, too */
    const bool *through; /* [cells] */
    const bool *by;      /* [faces] */
} tn_walk_asked;

/* From each point on, how long the shortest walk is (TN_NO_PATH: there is none) and the point that it goes to next.
 * Both [points]. TN_MEMORY. */
tn_status tn_walks_lengths(const tn_walks *walks, const tn_walk_asked *asked, int64_t *lengths, uint32_t *next,
                           tn_error *error);

/* The point of a cell's passages, at either side of these, from which the walk is shortest; of a cell without passages,
 * of its landings. TN_NO_POINT: no walk leads from the cell. */
uint32_t tn_walks_from(const tn_walks *walks, const tn_walk_asked *asked, const int64_t *lengths, uint32_t cell);

/* Is the cell where the walks lead to? Then none is needed. */
bool tn_walks_is_there(const tn_walks *walks, const tn_walk_asked *asked, uint32_t cell);

/* A line of a walk, on the floor of a storey. */
typedef struct tn_walk_line {
    uint32_t storey;
    tn_point from, to;
} tn_walk_line;

/* The lines of the walk from a point on. The caller frees *lines. TN_MEMORY. */
tn_status tn_walks_lines(const tn_walks *walks, const int64_t *lengths, const uint32_t *next, uint32_t from,
                         tn_walk_line **lines, size_t *count, tn_error *error);

/* How many walks lead outside from a cell of which no two share a passage or a flight. UINT32_MAX: it is outside, being
 * in the open on the ground. TN_MEMORY. */
tn_status tn_walks_exits(const tn_walks *walks, uint32_t cell, uint32_t *exits, tn_error *error);

#endif
