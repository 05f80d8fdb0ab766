/* The shells of bounds, which fill their cells at once: nothing is placed through them. */
#ifndef TARTAN_PLACE_BOUNDS_H
#define TARTAN_PLACE_BOUNDS_H

#include "runtime/place/cells.h"

/* The shell of a box about the frame; its heading does not count. */
tn_status tn_bound_box(tn_cells *cells, const tn_frame *frame, const tn_step *step, tn_error *error);

/* The shell of a ball about the origin. */
tn_status tn_bound_ball(tn_cells *cells, int32_t radius, tn_error *error);

#endif
