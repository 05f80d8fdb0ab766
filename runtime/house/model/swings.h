/* How the doors of a house hang and swing: into the room that comes first, unless only the other is free, and hung
 * where they meet no furniture, no stair and no other door, if that can be; or slide. Plans draw them so, building
 * models say so.
 *
 * Coordinates are nanometres of the house. A tn_taken and a tn_swings own their arrays; free them with their _clear.
 */
#ifndef TARTAN_HOUSE_SWINGS_H
#define TARTAN_HOUSE_SWINGS_H

#include "runtime/house/solids.h"

/* What of a storey's floor is taken in plan: by furniture and steps, by stairs as large as their cells, and by doors
 * that swing. */
typedef struct tn_taken {
    tn_rectangles items, stairs, swings;
} tn_taken;

/* All but doors. Clear it in any case. TN_MEMORY. */
tn_status tn_taken_find(const tn_house *house, uint32_t storey, tn_taken *taken, tn_error *error);
void tn_taken_clear(tn_taken *taken);

/* A leaf that hangs at `hinge` and closes towards `shut`, both along a wall; it swings to `side` (1 or -1) of the place
 * `face` across it, which is the wall's side in the room. in_y: the wall runs along y. */
typedef struct tn_door_leaf {
    double hinge, shut, face, side;
    bool in_y;
} tn_door_leaf;

/* A door: one leaf or, hung at both ends, two. sliding: they slide along the wall, and sweep nothing. */
typedef struct tn_swing {
    uint32_t of; /* the face that it is in */
    bool sliding;
    tn_door_leaf leaves[2];
    int count;
} tn_swing;

typedef struct tn_swings {
    tn_swing *items;
    size_t count, room;
} tn_swings;

/* Adds the doors of a storey, by their faces; and where they swing to what is taken there. TN_MEMORY. */
tn_status tn_swings_find(const tn_house *house, uint32_t storey, tn_taken *taken, tn_swings *swings, tn_error *error);
void tn_swings_clear(tn_swings *swings);

#endif
