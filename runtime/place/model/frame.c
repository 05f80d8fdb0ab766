/* What one step does to a frame, and which cells it is about (connection grammars: the published program's
 * operations). */
#include "runtime/place/model/frame.h"

#include <stdlib.h>

bool tn_frame_step(tn_frame *frame, const tn_step *step)
{
    int32_t by[3];
    bool near = true;
    switch (step->kind) {
    case TN_STEP_MOVE:
        tn_turn_place(frame->heading, step->a, by);
        for (int k = 0; k < 3; k++) {
            frame->at[k] += by[k];
            near &= abs(frame->at[k]) <= TN_PLACE_FAR;
        }
        return near;
    case TN_STEP_TURN:
        frame->heading = tn_turn_after(frame->heading, (uint32_t)step->a[0]);
        return true;
    case TN_STEP_COLOUR:
        frame->colour = step->a[0];
        return true;
    default:
        return true;
    }
}

/* A box of cells about the frame: halves are rounded down, so that an odd size loses a cell. */
static tn_cell_box box_about(const tn_frame *frame, int32_t width, int32_t height, int32_t depth)
{
    int32_t x = abs(frame->heading & 1 ? depth : width) / 2, z = abs(frame->heading & 1 ? width : depth) / 2;
    const int32_t *at = frame->at;
    return (tn_cell_box){{at[0] - x, at[1], at[2] - z}, {at[0] + x, at[1] + height, at[2] + z}};
}

/* Corners are turned; cells have their corner as their place, so the box is turned as it lies. */
tn_cell_box tn_cell_box_turn(const tn_cell_box *box, uint32_t turn)
{
    tn_cell_box turned;
    int32_t a[3], b[3];
    tn_turn_place(turn, box->low, a);
    tn_turn_place(turn, box->high, b);
    for (int k = 0; k < 3; k++) {
        turned.low[k] = a[k] < b[k] ? a[k] : b[k];
        turned.high[k] = a[k] < b[k] ? b[k] : a[k];
    }
    return turned;
}

static tn_cell_box box_between(const tn_frame *frame, const tn_step *step)
{
    const tn_cell_box plain = {{step->a[0], step->a[1], step->a[2]}, {step->b[0], step->b[1], step->b[2]}};
    tn_cell_box box = tn_cell_box_turn(&plain, frame->heading);
    for (int k = 0; k < 3; k++) {
        box.low[k] += frame->at[k];
        box.high[k] += frame->at[k];
    }
    return box;
}

tn_cell_box tn_frame_box(const tn_frame *frame, const tn_step *step)
{
    if (step->kind == TN_STEP_BLOCK)
        return box_between(frame, step);
    return step->kind == TN_STEP_TOUCH ? box_about(frame, 2, 1, 2)
                                       : box_about(frame, step->a[0], step->a[1], step->a[2]);
}
