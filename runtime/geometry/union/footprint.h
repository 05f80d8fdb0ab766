/* What a solid stands on: the convex hull of points in the plane. */
#ifndef TARTAN_GEOMETRY_UNION_FOOTPRINT_H
#define TARTAN_GEOMETRY_UNION_FOOTPRINT_H

#include <stdbool.h>
#include <stddef.h>

/* Leaves of the points the corners of their hull, counter-clockwise: one or two where they have no area. False where
 * out of memory. */
bool tn_hull(double (*points)[2], size_t *count);

double tn_hull_area(const double (*hull)[2], size_t count);

/* How far a point lies inside the hull; below 0: how far outside. */
double tn_hull_depth(const double (*hull)[2], size_t count, const double point[2]);

#endif
