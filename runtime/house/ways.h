/* Ways through the cells of a house whose form asks for them (`way`): what a person meets in a cell, whether all of the
 * cell's ways in are joined, and where its flights of stairs stand (docs/houses.md).
 *
 * Each cell is judged by itself, from its faces, what stands in it, and what little of the cells beside it one has to
 * know: a tn_face_view. Cells that flights join are judged together: a stack.
 */
#ifndef TARTAN_HOUSE_WAYS_H
#define TARTAN_HOUSE_WAYS_H

#include "runtime/house/floor/floor.h"
#include "runtime/house/house.h"
#include "runtime/house/solids.h"

/* What is beyond a face, seen from one of its cells. Bare: a cell with free floor all over it, of a function that has
 * neither tiles nor flights. */
typedef enum tn_beyond { TN_BEYOND_OUTSIDE, TN_BEYOND_VOID, TN_BEYOND_FURNISHED, TN_BEYOND_BARE } tn_beyond;

struct tn_face_view {
    tn_beyond beyond;
    bool leaf;          /* what is in the face has a leaf, which opens into the cell */
    tn_rectangle floor; /* the cell beyond, if it is bare */
};

tn_face_view tn_face_seen(const tn_house *house, uint32_t face, uint32_t cell);

/* The cell that the leaf of a door opens into: the one that the door's line of faces names first; of two that can be
 * either, the first; from outside, inwards. TN_NO_CELL: what is in the face has no leaf that sweeps the floor. */
uint32_t tn_face_leaf(const tn_house *house, const tn_face *face);

static inline bool tn_form_asks_ways(const tn_house_form *form)
{
    return form->record->way > 0;
}

/* The side of the square that a person needs in the cell. */
int64_t tn_cell_way(const tn_house *house, uint32_t cell);

/* ---- ways.c: one cell */

/* The floor of a bare cell beyond an open side, with the strip between that side and the clear rectangle. */
typedef struct tn_open_side {
    size_t passage;
    tn_rectangle floor;
} tn_open_side;

/* What a person meets in a cell, but for what stands in it: posts and low roofs are obstacles. Owns its arrays. */
typedef struct tn_cell_floor {
    int64_t way;
    tn_rectangle clear;
    tn_passage *passages;
    uint32_t *passage_faces;
    size_t passage_count;
    tn_rectangle *leaves;
    uint32_t *leaf_faces;
    size_t leaf_count;
    tn_open_side *open_sides;
    size_t open_count;
    tn_rectangles obstacles;
} tn_cell_floor;

/* Clear it in any case. TN_MEMORY. */
tn_status tn_cell_floor_find(const tn_house *house, uint32_t cell, tn_cell_floor *floor, tn_error *error);
void tn_cell_floor_clear(tn_cell_floor *floor);

/* The same as a floor, which borrows it. */
tn_floor tn_cell_floor_of(const tn_cell_floor *floor);

/* Why a cell does not fit. kind, side: what is in the face of the passage or leaf, and at which side of the cell.
 * flight: no place is left for the flight `kind`. */
typedef struct tn_way_fault {
    tn_floor_fault fault;
    bool flight;
    uint32_t kind;
    tn_house_side side;
    size_t keep;
} tn_way_fault;

/* What an answer about the cell's floor says of it. */
tn_way_fault tn_way_fault_of(const tn_house *house, uint32_t cell, const tn_cell_floor *floor,
                             const tn_floor_answer *answer);

/* Is a cell without tiles, or a stack, as it has to be? A stack is judged at its lowest cell; those above are fine. */
tn_status tn_cell_ways(const tn_house *house, uint32_t cell, tn_way_fault *fault, tn_error *error);

/* The end of a sentence: "no way leads to the `door` at the left". */
void tn_way_fault_text(const tn_house_form *form, const tn_way_fault *fault, char *text, size_t size);

/* How far one comes in a cell that does not fit (floor.h), for drawings; items: what stands in it. Clear it in any
 * case. */
typedef struct tn_way_stop {
    tn_floor_stop at;
    int64_t way;
    tn_rectangles items;
} tn_way_stop;
void tn_way_stop_clear(tn_way_stop *stop);

/* Of a cell without tiles and flights that tn_cell_ways finds a fault of. */
tn_status tn_cell_stop(const tn_house *house, uint32_t cell, tn_way_stop *stop, tn_error *error);

/* How near a flight that stands nowhere comes to a place: in the one that gets furthest, of those that get equally far
 * the one in which a person comes nearest to what is missed. kind: of the flight. cell: the one of its two that does
 * not fit then; head: that is the upper one. landing: its landing there has no room, which is what is missed. size: no
 * place has room for its steps, of which all are missed; short_by is how much longer or wider they are. items: its
 * steps, or the hole above them. */
typedef struct tn_flight_stop {
    uint32_t kind, cell;
    bool head, landing, size;
    tn_way_stop way;
} tn_flight_stop;

/* Of a stack that tn_cell_ways finds a fault of, from its lowest cell on. Clear stop->way in any case. */
tn_status tn_stack_stop(const tn_house *house, uint32_t lowest, tn_flight_stop *stop, tn_error *error);

/* "in the nearest one, the landing at its head has no room in 1.body.upper", in words; cell: the name of that. Empty if
 * the storey is no whole number of steps. */
void tn_flight_stop_text(const tn_house *house, const tn_flight_stop *stop, const char *cell, char *text, size_t size);

/* Of a tile that fails so that it shuts or cuts a way, closes a keep or meets a leaf; tiles.c. */
bool tn_tile_failure_stops(const tn_tile_failure *failure);
tn_status tn_tile_stop(const tn_house *house, uint32_t cell, uint32_t tile, const tn_tile_failure *failure,
                       tn_way_stop *stop, tn_error *error);

/* Lengths are shown to the next eighth of an inch, or millimetre. */
void tn_way_length_text(const tn_house *house, int64_t length, char text[64]);

/* "a person, 800mm wide, comes within 360mm of it", in words; empty of a leaf. */
void tn_way_stop_text(const tn_house *house, const tn_way_stop *stop, char *text, size_t size);

/* ---- wedges.c: steps around a corner, or around the middle of a spiral */

/* How one goes through a square of steps, of which u goes on and v goes to the right: in by its lower u and out by its
 * higher v; in by its lower v and back out by its lower u; or round, from the middle of its lower u back to that. */
typedef enum tn_winding { TN_WINDS_RIGHT, TN_WINDS_BACK, TN_WINDS_ROUND } tn_winding;

/* The corners of a wedge in plan, of `count` in a square (x: u; y: v); number: from 0. */
void tn_wedge_plan(tn_winding winding, const tn_rectangle *square, int64_t count, int64_t number, tn_wedge *wedge);

/* ---- stack.c: cells that flights of stairs join */

/* How a flight stands in the common part of two clear rectangles: it climbs away from a side, and its foot is so far
 * from that; mirrored or not, flush with the left or the right of the climb. */
typedef struct tn_flight_place {
    tn_house_side side;
    int64_t at;
    bool mirrored, right;
} tn_flight_place;

/* The flight in the floor above a cell, or under it; NULL: there is none. */
const tn_face *tn_flight_above(const tn_house *house, uint32_t cell);
const tn_face *tn_flight_below(const tn_house *house, uint32_t cell);

/* Does a landing reach over an open side, on the floors of both cells? */
bool tn_landing_reaches_over(const tn_cell_floor *floor, const tn_open_side *side, const tn_rectangle *landing);

/* Does the stack of a cell, its lowest, fit? Else *flight is the first flight that has no place. */
tn_status tn_stack_fits(const tn_house *house, uint32_t lowest, bool *fits, const tn_face **flight, tn_error *error);

/* Stands up the flight in a face: no treads if its stack does not fit. */
tn_status tn_stack_flight(const tn_house *house, const tn_face *face, tn_flight *flight, tn_error *error);

#endif
