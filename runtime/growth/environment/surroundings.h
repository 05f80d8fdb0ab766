/* What a surface grows in, as guides for a picture of it: forces at their places, gravity as an arrow, boundaries as
 * outlines, and the ground, which is the level of the lowest vertex. */
#ifndef TARTAN_GROWTH_ENVIRONMENT_SURROUNDINGS_H
#define TARTAN_GROWTH_ENVIRONMENT_SURROUNDINGS_H

#include "runtime/geometry/guide/guide.h"
#include "runtime/growth/environment/environment.h"

/* Adds them around a surface whose vertices lie between `low` and `high`. A force that is farther from it than it is
 * large is shown as an arrow that points there; of a plane, the part near the surface is shown. TN_MEMORY. */
tn_status tn_surroundings_guides(const tn_environment *environment, const double low[3], const double high[3],
                                 tn_guides *guides, tn_error *error);

#endif
