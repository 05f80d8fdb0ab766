/* Which triangles of a mesh share an edge. */
#ifndef TARTAN_GEOMETRY_TWIN_H
#define TARTAN_GEOMETRY_TWIN_H

#include "runtime/geometry/mesh.h"

#define TN_NO_TWIN UINT32_MAX

/* [3 * face_count] of a mesh of triangles: the edge from a corner to the next of its triangle is shared with the edge
 * from corner twin[c], or with none (TN_NO_TWIN). Where more than two triangles have an edge, they are paired in the
 * order of their corners. The caller frees it; NULL where memory runs out. */
uint32_t *tn_mesh_twins(const tn_mesh *mesh);

#endif
