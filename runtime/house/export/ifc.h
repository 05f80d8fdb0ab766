/* The parts of a building model as IFC4 writes them. Internal to runtime/house/export.
 *
 * A storey is written at a time: tn_ifc holds which, and where its floor is. What many parts have in common (types,
 * properties, materials) is a group: its definition is written when its first part is, the relation at the end.
 * What is called `key` says a part within its project, so that its identifier is the same in the next version of the
 * house: cells are known by tray, zone and storey, walls by their cells, openings by their walls.
 */
#ifndef TARTAN_HOUSE_IFC_H
#define TARTAN_HOUSE_IFC_H

#include "runtime/house/export/export.h"
#include "runtime/house/export/step.h"
#include "runtime/house/model/designations.h"
#include "runtime/house/model/swings.h"
#include "runtime/house/schedule/cost.h"

/* How groups are related to their definition. */
typedef enum tn_ifc_relation {
    TN_IFC_SET,      /* of properties or quantities */
    TN_IFC_TYPE,     /* of elements or spaces */
    TN_IFC_MATERIAL, /* or layers */
    TN_IFC_ZONE,
    TN_IFC_CLASS
} tn_ifc_relation;

typedef struct tn_ifc_group {
    tn_ifc_relation relation;
    uint64_t key;
    unsigned definition;
    tn_stepfile_id id; /* of the relation */
    tn_stepfile_list parts;
} tn_ifc_group;

/* A wall with what it takes of the junctions at its ends. part: 0 if none stands in the face. filling: the door or
 * window in its opening, or 0. volume: of what is left of it, in cubic metres. */
typedef struct tn_ifc_wall {
    unsigned part, filling;
    tn_box box;
    double volume;
} tn_ifc_wall;

/* Keys of faces hold those of two cells, with two names each. */
enum { TN_IFC_CELL_KEY = 2 * TN_NAME_MAX + 20, TN_IFC_FACE_KEY = 2 * TN_IFC_CELL_KEY + 10 };

typedef struct tn_ifc {
    tn_stepfile step;
    const tn_house *house;
    const tn_solids *solids;
    tn_designations names;
    tn_flights flights;
    tn_swings doors;                                           /* of the storey at hand */
    tn_ifc_wall *walls;                                        /* [face] */
    bool *joined;                                              /* [box of solids] a post that is part of a wall */
    unsigned *spaces;                                          /* [cell] the space of the room that begins there */
    unsigned floors[TN_STOREYS_MAX + 1], tops[TN_STOREYS_MAX]; /* [storey] the deck below it, and above its top cells */
    unsigned placement;                                        /* of the storey at hand */
    uint32_t storey;
    tn_ifc_group *groups;
    size_t group_count, group_room;
    unsigned *materials; /* [kind of solid, then material, then layer of the form] */
    unsigned layer_sets[TN_LAYERED_COUNT];
    unsigned classifications[TN_CLASSIFICATIONS_MAX]; /* of the form */
    unsigned *styles;                                 /* [kind of solid, then material] */
    unsigned char colours[TN_HOUSE_GROUPS_MAX][3];
    unsigned scrap; /* in place of a group's definition when there is no memory for it */
    bool failed;    /* out of memory */
} tn_ifc;

/* An element or a space: its entity, and what follows the attributes that all have, also in its type. long_name: of a
 * space. type_tail: NULL if types have nothing to say: what kind a part is of, either itself or its type says. */
typedef struct tn_ifc_part {
    const char *entity, *tail, *type_tail;
    const char *name, *type_name, *long_name;
    unsigned where, shape; /* shape: 0 if it has none of its own */
} tn_ifc_part;

/* ---- ifc_groups.c */

/* Writes an element or a space, whose identifier is that of its key, and gives it its type. */
unsigned tn_ifc_put(tn_ifc *ifc, const tn_ifc_part *part, const char *key);

/* Takes a part into a group, and returns where the group's definition is: 0 if it is still to be written. It has to be
 * written before another group is asked for. */
unsigned *tn_ifc_group_of(tn_ifc *ifc, tn_ifc_relation relation, const char *key, unsigned part);

/* A property's value as IFC writes it: IFCBOOLEAN(.T.). */
typedef struct tn_ifc_property {
    const char *name;
    char value[64];
} tn_ifc_property;

tn_ifc_property tn_ifc_truth(const char *name, bool value);

/* Gives a part a set of properties, with what its type is called as `Reference`. */
void tn_ifc_properties(tn_ifc *ifc, unsigned part, const char *set, const char *reference,
                       const tn_ifc_property *properties, size_t count);

/* kind: L of a length in nanometres, A of square and V of cubic metres. */
typedef struct tn_ifc_quantity {
    const char *name;
    char kind;
    double value;
} tn_ifc_quantity;

/* Gives a part a set of quantities: its own by its key, or (NULL) the one of all that have such. */
void tn_ifc_quantities(tn_ifc *ifc, unsigned part, const char *set, const char *key, const tn_ifc_quantity *quantities,
                       size_t count);

/* Solids that are written from now on look as what this one is made of. */
void tn_ifc_look_as(tn_ifc *ifc, const tn_solid *solid);

/* Gives a part its codes in the form's classifications. number: of a part as in CLASS. */
void tn_ifc_classify(tn_ifc *ifc, uint32_t number, unsigned part);

/* Says what a part is made of, and gives it its codes. */
void tn_ifc_make_of(tn_ifc *ifc, const tn_solid *solid, unsigned part);

/* What groups are related to. */
void tn_ifc_put_groups(tn_ifc *ifc);
void tn_ifc_clear_groups(tn_ifc *ifc);

/* ---- ifc_parts.c */

void tn_ifc_cell_key(const tn_ifc *ifc, uint32_t cell, char key[TN_IFC_CELL_KEY]);
void tn_ifc_face_key(const tn_ifc *ifc, uint32_t face, char key[TN_IFC_FACE_KEY]);

/* A thickness as the form writes lengths, behind a word: `outside 8"`. */
void tn_ifc_sized_name(const tn_ifc *ifc, const char *word, int64_t thick, char *text, size_t size);

/* The shape of solids (SweptSolid, Tessellation), and frees their list; 0: there are none. */
unsigned tn_ifc_shape(tn_ifc *ifc, const char *kind, tn_stepfile_list *solids);

/* The shape of a box at its placement, by its low and high corner there. */
unsigned tn_ifc_box(tn_ifc *ifc, const double low[3], const double high[3]);

/* Posts, beams, decks, guards that are no stair's, and furniture of the storey at hand. */
void tn_ifc_put_parts(tn_ifc *ifc, tn_stepfile_list *list);

/* Cubic metres of a box, or below a polygon. */
double tn_ifc_box_volume(const tn_box *box);
double tn_ifc_prism_volume(const tn_block_corner *corners, size_t count);

/* A guard, placed within the storey at hand or a stair. */
unsigned tn_ifc_put_guard(tn_ifc *ifc, const tn_solid *guard, unsigned within);

/* ---- ifc_decks.c: the deck below the storey at hand, or (top) what lies above its highest cells; 0: there is none */
unsigned tn_ifc_put_deck(tn_ifc *ifc, bool top, tn_stepfile_list *list);

/* ---- ifc_walls.c: the walls of the storey at hand, what is in them, and how they meet */
tn_status tn_ifc_put_walls(tn_ifc *ifc, tn_stepfile_list *list, tn_error *error);

/* ---- ifc_roofs.c */

/* The corners of a prism, above the floor of the storey at hand. Returns how many. */
size_t tn_ifc_corners(const tn_ifc *ifc, const tn_prism *prism, tn_block_corner corners[TN_FACET_CORNERS]);

/* The walls below roofs, over cells of the storey at hand. */
void tn_ifc_put_gables(tn_ifc *ifc, tn_stepfile_list *list);

/* The roof of the whole house, if the storey at hand is the highest that has some of it. */
void tn_ifc_put_roof(tn_ifc *ifc, tn_stepfile_list *list);

/* ---- ifc_stairs.c: the stairs that begin in the storey at hand */
void tn_ifc_put_stairs(tn_ifc *ifc, tn_stepfile_list *list);

/* ---- ifc_rooms.c */

void tn_ifc_put_spaces(tn_ifc *ifc, tn_stepfile_list *list);

/* What bounds them, when all storeys are written. */
void tn_ifc_put_boundaries(tn_ifc *ifc);

#endif
