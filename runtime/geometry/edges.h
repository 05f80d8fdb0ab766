/* Which edges of a mesh of triangles are seen as lines: where it bends, and where one group meets another. */
#ifndef TARTAN_GEOMETRY_EDGES_H
#define TARTAN_GEOMETRY_EDGES_H

#include "runtime/geometry/mesh.h"

/* [3 * face_count]: is the edge from this corner to the next of its triangle one? Edges that have no second triangle
 * are, too. The caller frees it. */
tn_status tn_mesh_creases(const tn_mesh *mesh, bool **creases, tn_error *error);

/* Which triangles of a mesh share an edge. */

#define TN_NO_TWIN UINT32_MAX

/* [3 * face_count] of a mesh of triangles: the edge from a corner to the next of its triangle is shared with the edge
 * from corner twin[c], or with none (TN_NO_TWIN). Where more than two triangles have an edge, they are paired in the
 * order of their corners. The caller frees it; NULL if memory runs out. */
uint32_t *tn_mesh_twins(const tn_mesh *mesh);

#endif
