/* The colours of models that are drawn, each once: faces are in groups by colour. */
#ifndef TARTAN_DRIVER_PLACE_GROUPS_H
#define TARTAN_DRIVER_PLACE_GROUPS_H

#include "runtime/place/grow.h"

typedef struct tn_colour_groups {
    int32_t *items; /* LDraw colours */
    size_t count, capacity;
} tn_colour_groups;

/* Adds the model's colours. *groups: [part] the number of its colour, which the caller frees in any case, as the
 * items. TN_MEMORY. */
tn_status tn_colour_groups_add(tn_colour_groups *list, const tn_placed_model *model, uint32_t **groups,
                               tn_error *error);

#endif
