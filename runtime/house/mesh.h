/* The solids of a house as polygons. */
#ifndef TARTAN_HOUSE_MESH_H
#define TARTAN_HOUSE_MESH_H

#include "runtime/geometry/mesh.h"
#include "runtime/house/solids.h"

/* Each box and each roof prism as a closed mesh of its own, in metres, z up; a group for each kind of part. The solids
 * are disjoint, so that volumes add up. Free it with tn_mesh_clear. TN_MEMORY. */
tn_status tn_house_mesh(const tn_solids *solids, tn_mesh *mesh, tn_error *error);

#endif
