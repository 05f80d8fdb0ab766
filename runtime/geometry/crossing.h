/* Triangles of a mesh that cross each other. */
#ifndef TARTAN_GEOMETRY_CROSSING_H
#define TARTAN_GEOMETRY_CROSSING_H

#include "runtime/geometry/mesh.h"

/* How many pairs of triangles cross: a side of one runs through the inside of the other. Pairs that only touch, within
 * what rounding leaves open, do not; nor do those that share a side. Fast where no triangle is much larger than the
 * others. TN_OK, TN_STOPPED or TN_MEMORY. */
tn_status tn_mesh_crossings(const tn_mesh *mesh, uint64_t *count, tn_error *error);

#endif
