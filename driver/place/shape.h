/* What placed models look like: pictures with studs, and closed meshes. Parts are the boxes that their kit says.
 *
 * A length in pictures and meshes is a millimetre (an LDU is 0.4), z up. */
#ifndef TARTAN_DRIVER_PLACE_SHAPE_H
#define TARTAN_DRIVER_PLACE_SHAPE_H

#include "runtime/place/steps.h"
#include "runtime/scene/view.h"

/* Draws a model in the colours of LDraw; connectors that point up and join nothing are studs. marked: [part] those to
 * be shown in red while all others are pale, or NULL. E1318 where the kit has none of its parts. */
tn_status tn_placed_draw(const tn_module *module, const tn_placed_model *model, const tn_placed_measures *measures,
                         const bool *marked, const char *title, tn_picture *to, tn_error *error);

/* Models side by side, each of its own kit and over its label (labels: or NULL). As above. */
typedef struct tn_placed_shape {
    const tn_module *module;
    const tn_placed_model *model;
} tn_placed_shape;

tn_status tn_placed_draw_many(const tn_placed_shape *shapes, const char *const *labels, size_t count, const char *title,
                              tn_picture *to, tn_error *error);

/* A sheet with a picture for each step, of all that stands then. The measures are those of the model as it was divided.
 * TN_LIMIT (E1336) for more than 200 steps. */
tn_status tn_placed_draw_steps(const tn_module *module, const tn_placed_model *model,
                               const tn_placed_measures *measures, const tn_placed_steps *steps, tn_picture *to,
                               tn_error *error);

/* Draws part number `part` of a kit alone, seen from above and from below. A stud stands at each of its connectors, in
 * the direction in which that points and in the colour of its kind (tn_group_colour). E1318 for a part that fills
 * nothing. */
tn_status tn_kit_part_draw(const tn_module *module, uint32_t part, tn_picture *to, tn_error *error);

/* The closed surface of a model, a group for each colour; *palette: the groups' colours, which the caller frees. The
 * model's parts do not overlap. */
tn_status tn_placed_mesh(const tn_module *module, const tn_placed_model *model, tn_mesh *mesh,
                         unsigned char (**palette)[3], tn_error *error);

#endif
