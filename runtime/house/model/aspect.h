/* Drawings of a house: plans, sections, elevations and an axonometric view, before they are put on paper.
 *
 * What is drawn is a mesh before a camera, the faces of what was cut, and marks. A tn_house_projection owns them; free
 * it with tn_house_projection_clear.
 */
#ifndef TARTAN_HOUSE_ASPECT_H
#define TARTAN_HOUSE_ASPECT_H

#include "runtime/geometry/render.h"
#include "runtime/house/model/lines.h"
#include "runtime/house/model/marks.h"
#include "runtime/house/model/model.h"

/* What parts are drawn as: the groups of a projection's mesh. */
typedef enum tn_material_group {
    TN_GROUP_WALL,
    TN_GROUP_FLOOR,
    TN_GROUP_ROOF,
    TN_GROUP_ITEM,
    TN_GROUP_PANE,
    TN_GROUP_LEAF,
    TN_GROUP_GUARD,
    TN_GROUP_FLIGHT,
    TN_GROUP_COUNT
} tn_material_group;

extern const uint32_t tn_solid_groups[TN_SOLID_COUNT];

typedef enum tn_aspect_kind {
    TN_ASPECT_PLAN,      /* cut 4' above the floor of a storey, or in the middle of a lower one; the front is below */
    TN_ASPECT_ROOF,      /* all of it from above, likewise */
    TN_ASPECT_SECTION_X, /* what lies left of x = at, seen from the right */
    TN_ASPECT_SECTION_Y, /* what lies behind y = at, seen from the front */
    TN_ASPECT_ELEVATION,
    TN_ASPECT_AXONOMETRIC
} tn_aspect_kind;

typedef struct tn_aspect {
    tn_aspect_kind kind;
    uint32_t storey;    /* of a plan */
    int64_t at;         /* of a section */
    tn_house_side side; /* of an elevation */
    tn_camera camera;   /* of the axonometric view */
    uint32_t storeys;   /* of the axonometric view: only so many, without the deck above; 0: all, and the roof */
    bool bare;          /* without what stands in the rooms */
} tn_aspect;

/* Houses are seen from the front. */
static inline tn_camera tn_house_sheet_camera(void)
{
    return (tn_camera){60, 30, 480};
}

/* A layer of what was cut, with the form's number of it. main: the thickest of those there, or the first of such.
 * least: how thick the thinnest is. line: where it meets the layer before it, if that was cut, too; not where slabs of
 * roofs are cut level. */
typedef struct tn_cut_layer {
    uint32_t layer, group;
    bool main, meets;
    double least;
    double at[4][2], line[2][2];
} tn_cut_layer;

typedef struct tn_house_projection {
    tn_aspect aspect;
    tn_camera camera;
    tn_mesh mesh;         /* nanometres; a group is a tn_material_group and TN_GROUP_COUNT times its tn_grouping */
    tn_drawn_line *lines; /* edges that are seen, in pieces */
    size_t line_count;
    tn_cut_face *cuts; /* u, v as the camera sees them */
    size_t cut_count;
    tn_cut_layer *layers; /* u, v likewise */
    size_t layer_count, layer_room;
    tn_drawn_line *joints; /* where a layer that was cut meets the one before it; their groups are numbers of layers */
    size_t joint_count;
    double low[2], high[2]; /* of all of it, without marks */
    tn_marks marks;
    char title[64];
} tn_house_projection;

/* Puts blocks of a kind into groups from 1 to `more`; into 0 if they are none of these. */
typedef struct tn_grouping {
    uint32_t (*group)(const tn_house *house, const tn_house_block *block);
    uint32_t more;
} tn_grouping;

/* Without marks. grouping: or NULL. E0904 for a section that misses the house, a plan of a storey that it does not
 * have. */
tn_status tn_house_projection_take(const tn_house *house, const tn_solids *solids, const tn_aspect *aspect,
                                   const tn_grouping *grouping, tn_house_projection *projection, tn_error *error);

struct tn_blocks;

/* ---- facade.c */

/* Cuts floors across where an outside wall ends and their edge goes on without one, as below a porch. TN_MEMORY. */
tn_status tn_house_part_floors(const tn_house *house, struct tn_blocks *blocks, tn_error *error);

/* Puts the edges of such floors that outside walls stand on, or end below, into the groups of these walls; not what lies
 * in the plane of a cut across an axis (or -1). */
void tn_house_face_floors(const tn_house *house, const tn_grouping *grouping, int axis, double at, tn_mesh *mesh);

/* ---- cut_layers.c: adds the layers that the plane across an axis cuts */
tn_status tn_cut_layers(const tn_house *house, const tn_solids *solids, int axis, double at,
                        tn_house_projection *projection, tn_error *error);

/* Makes the marks anew. */
tn_status tn_house_projection_mark(const tn_house *house, const tn_mark_style *style, tn_house_projection *projection,
                                   tn_error *error);

/* One of the layers that a joint is of. */
const tn_cut_layer *tn_joint_layer(const tn_house_projection *projection, const tn_drawn_line *joint);

/* What the drawing takes with its marks. */
void tn_house_projection_extent(const tn_house_projection *projection, double low[2], double high[2]);
void tn_house_projection_clear(tn_house_projection *projection);

#endif
