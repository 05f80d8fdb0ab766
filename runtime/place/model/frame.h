/* The head that walks while a model is placed: a frame, what a step does to it, and the cells that a step is about. */
#ifndef TARTAN_PLACE_MODEL_FRAME_H
#define TARTAN_PLACE_MODEL_FRAME_H

#include <stdbool.h>

#include "runtime/module/values.h"
#include "runtime/place/model/rules.h"

/* The 24 ways to turn a cube, as numbers: where an axis points when it is turned, and one turn after another.
 *
 * 0 to 3 are quarter turns about the vertical; 1 takes (x, z) to (-z, x). Turn 4 a + h is h of these first, then the
 * one that takes up to axis a and right to what lies beside that axis. Coordinates have their y downwards. */

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

/* A box of cells: low[k] <= coordinate < high[k]. Empty where a low is not below its high. */
typedef struct tn_cell_box {
    int32_t low[3], high[3];
} tn_cell_box;

static inline bool tn_cell_box_holds(const tn_cell_box *box, const int32_t cell[3])
{
    for (int k = 0; k < 3; k++)
        if (cell[k] < box->low[k] || cell[k] >= box->high[k])
            return false;
    return true;
}

/* Makes `all` hold the box too. */
static inline void tn_cell_box_widen(tn_cell_box *all, const tn_cell_box *box)
{
    for (int k = 0; k < 3; k++) {
        all->low[k] = box->low[k] < all->low[k] ? box->low[k] : all->low[k];
        all->high[k] = box->high[k] > all->high[k] ? box->high[k] : all->high[k];
    }
}

typedef struct tn_frame {
    int32_t at[3];
    uint32_t heading; /* a turn; in connection grammars, and where parts stay upright, 0 to 3 */
    int32_t colour;
} tn_frame;

/* A box about the origin, turned; how it lies for each of the upright turns is mostly worked out beforehand. */
tn_cell_box tn_cell_box_turn(const tn_cell_box *box, uint32_t turn);
static inline tn_cell_box tn_cell_box_of(const tn_cell_box upright[TN_UPRIGHT_TURNS], uint32_t turn)
{
    return turn < TN_UPRIGHT_TURNS ? upright[turn] : tn_cell_box_turn(&upright[0], turn);
}

/* A box that was worked out for each upright turn, at a frame. */
static inline tn_cell_box tn_cell_box_at(const tn_cell_box box[TN_UPRIGHT_TURNS], const tn_frame *frame)
{
    tn_cell_box moved = tn_cell_box_of(box, frame->heading);
    for (int k = 0; k < 3; k++) {
        moved.low[k] += frame->at[k];
        moved.high[k] += frame->at[k];
    }
    return moved;
}

/* Moves, turns or colours the frame. False if it would go farther than TN_PLACE_FAR. */
bool tn_frame_step(tn_frame *frame, const tn_step *step);

/* The cells of FILL, FILL_OVER, BLOCK and TOUCH at a frame. */
tn_cell_box tn_frame_box(const tn_frame *frame, const tn_step *step);

#endif
