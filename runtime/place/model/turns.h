/* The 24 ways to turn a cube, as numbers: where an axis points when it is turned, and one turn after another.
 *
 * 0 to 3 are quarter turns about the vertical; 1 takes (x, z) to (-z, x). Turn 4 a + h is h of these first, then the
 * one that takes up to axis a and right to what lies beside that axis. Coordinates have their y downwards. */
#ifndef TARTAN_PLACE_MODEL_TURNS_H
#define TARTAN_PLACE_MODEL_TURNS_H

#include <stdbool.h>

#include "runtime/module/values.h"

enum { TN_UPRIGHT_TURNS = 4, TN_TURNS = 24 };

/* Where a connector that points along an axis points after a turn. */
tn_axis tn_axis_turn(tn_axis axis, uint32_t turn);

/* The direction by which one tells how far something is turned about an axis: right of those that stand, up of those
 * that lie. */
static inline tn_axis tn_axis_beside(tn_axis axis)
{
    return axis <= TN_AXIS_DOWN ? TN_AXIS_RIGHT : TN_AXIS_UP;
}

static inline tn_axis tn_axis_opposite(tn_axis axis)
{
    return axis ^ 1u; /* up and down, left and right, front and back follow one another */
}

/* The coordinate along an axis: 0 x, 1 y, 2 z. */
static inline int tn_axis_coordinate(tn_axis axis)
{
    return axis <= TN_AXIS_DOWN ? 1 : axis <= TN_AXIS_RIGHT ? 0 : 2;
}

/* Does the coordinate fall where the axis points? (y is downwards.) */
static inline bool tn_axis_falls(tn_axis axis)
{
    return axis == TN_AXIS_UP || axis == TN_AXIS_LEFT || axis == TN_AXIS_FRONT;
}

/* The turn that takes up to an axis, and right to what is beside that. */
static inline uint32_t tn_turn_to(tn_axis axis)
{
    return TN_UPRIGHT_TURNS * (uint32_t)axis;
}

/* The inner turn first, then the outer. */
uint32_t tn_turn_after(uint32_t outer, uint32_t inner);
uint32_t tn_turn_back(uint32_t turn);

/* Turns a place about the origin. */
void tn_turn_place(uint32_t turn, const int32_t from[3], int32_t to[3]);

/* Where one of two directions is turned to the other about an axis that both are beside, is the turn one of those that
 * do not count, where `alike` (1, 2 or 4) of the four quarter turns do not? */
static inline bool tn_turns_fit(tn_axis one, tn_axis other, uint32_t alike)
{
    return alike == 4 || one == other || (alike == 2 && one == tn_axis_opposite(other));
}

#endif
