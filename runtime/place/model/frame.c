/* What one step does to a frame, and which cells it is about (connection grammars: the published program's
 * operations). */
#include "runtime/place/model/frame.h"

#include <stdlib.h>

/* Axes aside, in the order of turning. */
tn_axis tn_axis_turn(tn_axis axis, uint32_t heading)
{
    static const tn_axis order[4] = {TN_AXIS_RIGHT, TN_AXIS_BACK, TN_AXIS_LEFT, TN_AXIS_FRONT};
    for (uint32_t i = 0; i < 4; i++)
        if (order[i] == axis)
            return order[(i + heading) % 4];
    return axis;
}

bool tn_frame_step(tn_frame *frame, const tn_step *step)
{
    int32_t x, z;
    switch (step->kind) {
    case TN_STEP_MOVE:
        tn_heading_turn(frame->heading, step->a[0], step->a[2], &x, &z);
        frame->at[0] += x;
        frame->at[1] += step->a[1];
        frame->at[2] += z;
        for (int k = 0; k < 3; k++)
            if (abs(frame->at[k]) > TN_PLACE_FAR)
                return false;
        return true;
    case TN_STEP_TURN:
        frame->heading = (frame->heading + (uint32_t)step->a[0]) % 4;
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

/* Corners are turned with the heading; cells have their corner as their place, so the box is turned as it lies. */
static tn_cell_box box_between(const tn_frame *frame, const int32_t a[3], const int32_t b[3])
{
    int32_t x[2], z[2];
    const int32_t *at = frame->at;
    tn_heading_turn(frame->heading, a[0], a[2], &x[0], &z[0]);
    tn_heading_turn(frame->heading, b[0], b[2], &x[1], &z[1]);
    int lower_x = x[1] < x[0], lower_z = z[1] < z[0];
    return (tn_cell_box){{at[0] + x[lower_x], at[1] + a[1], at[2] + z[lower_z]},
                         {at[0] + x[!lower_x], at[1] + b[1], at[2] + z[!lower_z]}};
}

tn_cell_box tn_frame_box(const tn_frame *frame, const tn_step *step)
{
    if (step->kind == TN_STEP_BLOCK)
        return box_between(frame, step->a, step->b);
    return step->kind == TN_STEP_TOUCH ? box_about(frame, 2, 1, 2)
                                       : box_about(frame, step->a[0], step->a[1], step->a[2]);
}
