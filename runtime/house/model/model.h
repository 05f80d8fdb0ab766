/* A house as blocks, which can be cut by planes across the axes and become one mesh.
 *
 * A block stands upright over a convex polygon of three or four corners, between a bottom and a top that may slope: a
 * wall, a deck, or a piece of a roof.
 * Blocks do not overlap; where two meet other than in a plane across an axis, they have the whole face in common.
 * Coordinates are nanometres as doubles: whole numbers, but for roofs and where these are cut. A tn_blocks owns its
 * arrays; free them with tn_blocks_clear.
 */
#ifndef TARTAN_HOUSE_MODEL_H
#define TARTAN_HOUSE_MODEL_H

#include "runtime/geometry/mesh.h"
#include "runtime/house/solids.h"

#define TN_BLOCK_CORNERS 4u

/* Counter-clockwise seen from above. */
typedef struct tn_block_corner {
    double x, y, low, high;
} tn_block_corner;

/* of, item: as in tn_solid or tn_prism. group: of its faces in a mesh; at first its kind. slab: how thick the
 * slab above a wall is that lies on it; 0 if none does. */
typedef struct tn_house_block {
    tn_solid_kind kind;
    uint32_t of, item, group, count;
    double slab;
    tn_block_corner corners[TN_BLOCK_CORNERS];
    double low[3], high[3]; /* its bounds */
} tn_house_block;

/* A polygon in the plane of a cut. Coordinates are the two other axes. */
typedef struct tn_cut_face {
    tn_solid_kind kind;
    uint32_t of, item;
    double at[4][2];
} tn_cut_face;

typedef struct tn_blocks {
    tn_house_block *items;
    size_t count, room;
    tn_cut_face *cuts; /* what the last cut left open */
    size_t cut_count, cut_room;
} tn_blocks;

void tn_blocks_clear(tn_blocks *blocks);

/* The blocks of a house, with the leaves of its doors and the panes of its windows (tn_house_leaves). */
tn_status tn_blocks_of(const tn_house *house, const tn_solids *solids, tn_blocks *blocks, tn_error *error);

/* Blocks of prisms alone, which are not cut so that they fit together. */
tn_status tn_blocks_of_prisms(const tn_solids *solids, tn_blocks *blocks, tn_error *error);

/* Keeps what lies below (or, `above`, beyond) the plane across an axis, in blocks->items; blocks->cuts are the faces in
 * the plane of what was cut through. */
tn_status tn_blocks_cut(tn_blocks *blocks, int axis, double at, bool above, tn_error *error);

/* Makes two of each block of a kind that a plane across x or y cuts. TN_MEMORY. */
tn_status tn_blocks_split(tn_blocks *blocks, tn_solid_kind kind, int axis, double at, tn_error *error);

/* The boundary of the union, closed and two-manifold, in triangles; nanometres, z up, with the groups of the blocks, of
 * which there are `groups`. It has no names for them. */
tn_status tn_blocks_mesh(const tn_blocks *blocks, uint32_t groups, tn_mesh *mesh, tn_error *error);

/* How high above the lowest floor a plan of the storey is cut: 4' above its own, or in the middle of a lower one. */
int64_t tn_plan_level(const tn_house_form *form, uint32_t storey);

/* ---- leaves.c */

/* The hole that an opening of this height leaves in a face: across the wall it is as thick as the wall. False where
 * the face has no opening. */
bool tn_house_hole(const tn_house *house, const tn_face *face, tn_box *hole);

/* Has a face an opening with a leaf or a pane? */
bool tn_house_is_filled(const tn_house *house, const tn_face *face);

/* The leaf or the pane in a face; false if there is none. */
bool tn_house_filling(const tn_house *house, const tn_face *face, tn_solid *filling);

/* Adds leaves and panes to the solids; `of` is their face. */
tn_status tn_house_leaves(const tn_house *house, tn_solids *solids, tn_error *error);

#endif
