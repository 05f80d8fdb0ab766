/* Listing the buildings that count.h counts: each once, always in the same order, in memory that does not grow with
 * their number. */
#ifndef TARTAN_PLACE_COUNT_LIST_H
#define TARTAN_PLACE_COUNT_LIST_H

#include "runtime/place/count/count.h"

typedef enum tn_buildings_kind {
    TN_BUILDINGS_TURNED, /* those that differ by a turn about the vertical are one */
    TN_BUILDINGS_FIXED,  /* each turn of it is another */
    TN_BUILDINGS_INSIDE, /* where they stand, inside of the space of the rules' model */
} tn_buildings_kind;

/* A building: its parts from the lowest up, and in a layer from back to front and right to left. The first stands at
 * the origin, but for those inside of a space. Colours are those of models that name none. The model is borrowed for
 * the call. Anything but TN_OK ends the list. */
typedef tn_status tn_building_visit(void *context, const tn_placed_model *model, tn_error *error);

typedef struct tn_building_list {
    const tn_place_rules *rules; /* with a space for INSIDE alone */
    const bool *wanted;          /* as in tn_count_buildings */
    uint32_t parts;              /* 1 to TN_COUNT_PARTS_MAX */
    tn_buildings_kind kind;
    tn_building_visit *visit;
    void *context;
} tn_building_list;

/* TN_MEMORY, TN_STOPPED, TN_LIMIT (E1313), E1338 as in count.h, or what the visit says. */
tn_status tn_list_buildings(const tn_building_list *list, tn_watch *watch, tn_error *error);

#endif
