/* How much of a grown surface the sun reaches. */
#ifndef TARTAN_GROWTH_SUNLIT_H
#define TARTAN_GROWTH_SUNLIT_H

#include "runtime/growth/growth.h"

/* The share of the surface's area that light from far away in the direction `sun` falls on, from 0 to 1: what no other
 * part of the surface keeps it from. Either side of the surface takes light. Exact but for rounding: of each triangle
 * of the faces, what lies behind others is cut away. `sun` is not zero, and need not be of length 1. A triangle that
 * the light runs along has none. Quadratic where all of the surface lies behind itself. TN_OK, TN_MEMORY or TN_STOPPED.
 */
tn_status tn_sunlit_share(const tn_growth *growth, tn_vector sun, double *share, tn_error *error);

#endif
