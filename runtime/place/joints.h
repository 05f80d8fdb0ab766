/* Which parts of a placed model join: connectors that lie at one place, point at each other, and are of kinds that
 * join.
 *
 * What a tn_placed_joints has is its own; the kit's module has to outlive it. */
#ifndef TARTAN_PLACE_JOINTS_H
#define TARTAN_PLACE_JOINTS_H

#include "runtime/place/grow.h"

typedef struct tn_placed_joint {
    uint32_t a, b; /* parts, a < b */
} tn_placed_joint;

typedef struct tn_placed_joints {
    const tn_kit_part_record **kinds; /* [part]: NULL if the kit does not have it */
    size_t count;                     /* parts */
    size_t unknown;
    tn_placed_joint *links; /* pairs of parts that join, once each, ascending */
    size_t link_count;
    size_t joint_count, open_count; /* pairs of connectors, and connectors that join nothing */
    uint32_t *component;            /* [part]: the lowest part that it hangs together with */
    uint32_t component_count;
    bool *cut; /* [part]: without it more pieces would be there */
    uint32_t cut_count;
} tn_placed_joints;

/* TN_OK, TN_MEMORY or TN_STOPPED. Parts that the kit lacks join nothing. */
tn_status tn_placed_joints_find(const tn_module *module, const tn_placed_model *model, tn_watch *watch,
                                tn_placed_joints *joints, tn_error *error);
void tn_placed_joints_clear(tn_placed_joints *joints);

/* The part of a kit by its name; NULL if it has none. */
const tn_kit_part_record *tn_kit_part_named(const tn_module *module, const char *name);

/* The part that an LDraw file means, in which names are the same in capitals or not; NULL if the kit has none. */
const tn_kit_part_record *tn_kit_part_meant(const tn_module *module, const char *name);

/* Do connectors of two types join that are turned about their axis so that what is beside it (tn_axis_beside) points
 * there? */
bool tn_connectors_turn(const tn_module *module, uint32_t a, uint32_t b, tn_axis beside_a, tn_axis beside_b);

/* How many of the four turns about its axis a connector of a type does not tell apart, whatever it joins. */
uint32_t tn_connector_turns(const tn_module *module, uint32_t type);

/* A box of a part at a frame. */
tn_cell_box tn_part_box_at(const tn_part_box_record *box, const tn_frame *frame);

#endif
