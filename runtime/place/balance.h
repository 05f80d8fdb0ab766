/* How well a placed model stands. */
#ifndef TARTAN_PLACE_BALANCE_H
#define TARTAN_PLACE_BALANCE_H

#include "runtime/place/joints.h"

/* How far the centre of mass is from the edge of the support polygon, in LDU: the convex hull of what lies at the
 * height `ground` (a cell's lower face). Below 0: outside, so that the model falls over. Parts weigh what the kit says;
 * where all of them weigh nothing, they weigh their cells. 0 for a model without known parts. */
tn_status tn_balance(const tn_module *module, const tn_placed_model *model, const tn_placed_joints *joints,
                     int32_t ground, double *balance, tn_error *error);

#endif
