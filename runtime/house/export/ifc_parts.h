/* The parts of a building model. Internal to runtime/house/export. */
#ifndef TARTAN_HOUSE_IFC_PARTS_H
#define TARTAN_HOUSE_IFC_PARTS_H

#include "runtime/house/export/step.h"
#include "runtime/house/model/swings.h"

typedef struct tn_ifc {
    tn_stepfile step;
    const tn_house *house;
    const tn_solids *solids;
    uint32_t *rooms;    /* [cell] its room; owned */
    unsigned *walls;    /* [face] the wall that stands in it; owned */
    unsigned *spaces;   /* [cell] the space of the room that begins there; owned */
    unsigned placement; /* of the storey at hand */
    uint32_t storey;
    tn_swings doors; /* of the storey at hand; owned */
    tn_stepfile_list
        *made;   /* parts of each kind that the form has no material for, then those of each material; owned */
    bool failed; /* out of memory */
} tn_ifc;

void tn_ifc_clear(tn_ifc *ifc);

/* Adds the rooms of the storey to the model, and to the list. */
void tn_ifc_spaces(tn_ifc *ifc, tn_stepfile_list *list);

/* Adds walls with doors and windows, posts, decks, roofs, stairs, furniture. */
void tn_ifc_elements(tn_ifc *ifc, tn_stepfile_list *list);

/* Says what the parts are made of, and which walls bound which rooms. */
void tn_ifc_materials(tn_ifc *ifc);

#endif
