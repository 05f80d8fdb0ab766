/* What a placed model's parts are made of when they are drawn: their boxes; and slopes, each in place of the boxes that
 * are its steps. Where another part reaches into the box of a slope, or another slope does, its steps are drawn, so
 * that no two bodies share room.
 *
 * Lengths are millimetres (an LDU is 0.4), z up. */
#ifndef TARTAN_DRIVER_PLACE_BODIES_H
#define TARTAN_DRIVER_PLACE_BODIES_H

#include "runtime/geometry/union/cut_box.h"
#include "runtime/place/joints.h"

typedef struct tn_body {
    uint32_t part;   /* of the model */
    uint32_t record; /* of PART_SLOPE, or of PART_BOX */
    bool slope;
} tn_body;

typedef struct tn_bodies {
    tn_body *items; /* part after part; parts that the kit lacks have none */
    size_t count;
} tn_bodies;

/* The bodies of all parts; clear them in any case. TN_MEMORY. */
tn_status tn_bodies_list(const tn_module *module, const tn_placed_model *model, const tn_placed_joints *joints,
                         tn_bodies *bodies, tn_error *error);
void tn_bodies_clear(tn_bodies *bodies);

/* Says that nothing of a model has a shape (E1318). */
tn_status tn_no_bodies(tn_error *error);

/* One body as it lies. */
void tn_body_shape(const tn_module *module, const tn_placed_model *model, const tn_body *body, tn_cut_box *shape);

/* Does the surface go on flat beyond an edge of a body, over another body of the same part? (Such an edge is not to be
 * drawn.) edge: from that corner of the face to the next; shapes: those of the part's bodies. */
bool tn_body_goes_on(const tn_cut_box *shapes, size_t count, size_t body, const tn_cut_box_face *face, size_t edge);

#endif
