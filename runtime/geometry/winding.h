/* Which cells of a grid have their middle inside of a mesh: where its faces wind around, in either sense, and other
 * than 0 times in all. So solids that overlap, or whose faces look inwards, are what one expects of them. */
#ifndef TARTAN_GEOMETRY_WINDING_H
#define TARTAN_GEOMETRY_WINDING_H

#include "runtime/geometry/mesh.h"

/* The middle of cell (i, j, k) is at (low[0] + i + 0.5) * size[0], and so on. A size may be below 0: cells then count
 * against the axis. */
typedef struct tn_mesh_grid {
    double low[3], size[3];
    uint32_t count[3];
} tn_mesh_grid;

/* Sets bit (k * count[1] + j) * count[0] + i of `bits` for each such cell; the bits are 0 before. The mesh has
 * triangles only, and is closed (tn_mesh_opening); size[0] is above 0. TN_MEMORY, TN_STOPPED, or TN_LIMIT (no code)
 * if lines along the first axis meet more than 100,000,000 triangles. */
tn_status tn_mesh_fill_grid(const tn_mesh *mesh, const tn_mesh_grid *grid, uint64_t *bits, tn_error *error);

/* Edges that have not as many faces on one side as on the other: *count of them, and the ends of the first, in the
 * order of their vertices. 0: the mesh is closed. TN_MEMORY. */
tn_status tn_mesh_opening(const tn_mesh *mesh, size_t *count, double ends[2][3], tn_error *error);

#endif
