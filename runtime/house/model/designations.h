/* What rooms, doors and windows are called in drawings and schedules: each room has a number, and each kind of opening
 * that is filled a tag. A tn_designations owns its arrays; free them with tn_designations_clear. */
#ifndef TARTAN_HOUSE_MODEL_DESIGNATIONS_H
#define TARTAN_HOUSE_MODEL_DESIGNATIONS_H

#include "runtime/house/house.h"

/* A room in a storey. largest: of its cells there. gross, net: its areas there between the planes of its walls and
 * between the walls, in square nanometres. */
typedef struct tn_numbered_room {
    uint32_t room, storey, largest; /* room: its lowest cell */
    double gross, net;
    char number[16], name[48];
} tn_numbered_room;

/* An opening (or TN_FACE kind) with a leaf or a pane, and how many there are: D1 and more are doors, W1 and more
 * windows, in the order in which the form declares them. */
typedef struct tn_tagged_opening {
    uint32_t kind;
    size_t count;
    char tag[16];
} tn_tagged_opening;

typedef struct tn_designations {
    uint32_t *rooms; /* [cells], as of tn_house_rooms */
    tn_numbered_room *numbered;
    size_t room_count;
    tn_tagged_opening *openings;
    size_t opening_count;
} tn_designations;

/* us: rooms are 101, 102, ... in the lowest storey, otherwise 0.01, 0.02, ... Clear it in any case. TN_MEMORY. */
tn_status tn_designations_find(const tn_house *house, bool us, tn_designations *names, tn_error *error);
void tn_designations_clear(tn_designations *names);

/* The tag of what is in a face; NULL if it has none. */
const char *tn_designation_of(const tn_designations *names, const tn_face *face);

#endif
