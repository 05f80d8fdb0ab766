/* Which edges of a mesh of triangles are seen as lines: where it bends, and where one group meets another. */
#ifndef TARTAN_GEOMETRY_CREASE_H
#define TARTAN_GEOMETRY_CREASE_H

#include "runtime/geometry/mesh.h"

/* [3 * face_count]: is the edge from this corner to the next of its triangle one? Edges that have no second triangle
 * are, too. The caller frees it. */
tn_status tn_mesh_creases(const tn_mesh *mesh, bool **creases, tn_error *error);

#endif
