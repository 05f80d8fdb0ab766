/* The boundary of a union of cells that do not overlap, without booleans of solids. They share area on faces of their
 * boxes, so that each plane of faces is worked out by itself, with polygons in that plane; or on caps, but then they have
 * the whole cap in common. (Cells whose boxes do not overlap share no area on caps.)
 *
 * Coordinates are taken as whole numbers of a step, at most 2^52 of them from 0, so that a double holds each. Which
 * side of a line a point is on is decided exactly, where two lines cross is rounded once, to a step; so the boundary is
 * closed for every input, and no triangle is without area. Where cells touch along edges or at corners only, they come
 * apart: vertices are doubled, so that an edge has two triangles and a vertex one umbrella. Where that takes a vertex
 * between two that are a step apart, the whole is made again with longer steps, as it is where
 * rounding leaves an outline that crosses itself; if that does not help, crossings a few steps apart are merged.
 *
 * A tn_union owns its arrays; clear it in any case.
 */
#ifndef TARTAN_GEOMETRY_UNION_H
#define TARTAN_GEOMETRY_UNION_H

#include "runtime/geometry/mesh.h"
#include "runtime/geometry/union/cut_box.h"

typedef struct tn_union {
    tn_mesh mesh;   /* triangles; face_group is the cell that each is of, group_count their number; no names */
    size_t doubled; /* vertices that were doubled */
} tn_union;

/* E_SOLID_TOO_FINE where details are so small against the whole that triangles would have no area. */
tn_status tn_union_make(const tn_cut_box *cells, size_t count, tn_union *result, tn_error *error);

void tn_union_clear(tn_union *result);

/* Each cell closed by itself, with doubled vertices and faces between neighbours; groups are cells. */
tn_status tn_union_cells(const tn_cut_box *cells, size_t count, tn_mesh *mesh, tn_error *error);

#endif
