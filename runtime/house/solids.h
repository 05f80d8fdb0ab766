/* The solids of a house: boxes, and prisms of roofs. Disjoint, without gaps, exact (docs/houses.md).
 *
 * A tn_solids owns its arrays; free them with tn_solids_clear. Coordinates are nanometres, those of prisms exact
 * fractions.
 */
#ifndef TARTAN_HOUSE_SOLIDS_H
#define TARTAN_HOUSE_SOLIDS_H

#include "runtime/base/length.h"
#include "runtime/house/slopes.h"

typedef enum tn_solid_kind {
    TN_SOLID_OUTSIDE,
    TN_SOLID_PARTY,
    TN_SOLID_PARTITION,
    TN_SOLID_POST,
    TN_SOLID_DECK,
    TN_SOLID_ROOFDECK,
    TN_SOLID_ITEM,
    TN_SOLID_ROOF,  /* the slab of a roof */
    TN_SOLID_PANE,   /* of windows: runtime/house/model/model.h adds them and leaves */
    TN_SOLID_LEAF,   /* of doors */
    TN_SOLID_FLIGHT, /* a step or landing */
    TN_SOLID_GUARD,
    TN_SOLID_GABLE, /* wall below the slab of a roof, above the storey */
    TN_SOLID_BEAM,
    TN_SOLID_COUNT
} tn_solid_kind;

const char *tn_solid_kind_text(tn_solid_kind kind);

/* of: the face of a wall, flight or guard (at a hole, of the flight), the cell of a roof deck or an item, the storey of a
 * deck, post or beam. item: a TILE_BOX record; of a beam, its number in the form; of a post, the face of the wall as which it is cut into layers, or TN_NO_FACE. */
#define TN_NO_FACE UINT32_MAX
typedef struct tn_solid {
    tn_solid_kind kind;
    uint32_t of, item;
    tn_box at;
} tn_solid;

/* A corner of a prism in plan, and how far it is solid there: from `low` up to `high`, which may be the same. */
typedef struct tn_prism_corner {
    tn_fraction x, y, low, high;
} tn_prism_corner;

/* Upright over a convex polygon in plan, whose corners go counter-clockwise seen from above; below and above it ends in
 * planes. A roof slab is so thick upright all over; a wall below one is level below. Over one facet of a roof: `plane` is
 * its plane's number among those of the cell's roof, which rises `rise` for each unit along its slope. over: the
 * rectangle that the facet is cut from. item: of a wall, the face of the wall as which it is cut into layers, or
 * TN_NO_FACE. */
typedef struct tn_prism {
    tn_solid_kind kind;
    uint32_t of, item; /* of: a cell */
    size_t plane;
    tn_fraction rise;
    tn_rectangle over;
    size_t corner_first, corner_count;
} tn_prism;

typedef struct tn_solids {
    tn_solid *boxes;
    size_t box_count, box_room;
    tn_prism *prisms;
    size_t prism_count, prism_room;
    tn_prism_corner *corners;
    size_t corner_count, corner_room;
} tn_solids;

tn_status tn_house_solids(const tn_house *house, tn_solids *solids, tn_error *error);

/* The same without what stands in the rooms. */
tn_status tn_house_shell(const tn_house *house, tn_solids *solids, tn_error *error);
void tn_solids_clear(tn_solids *solids);

/* What fills an opening: a leaf 1 3/4" thick where one walks through, otherwise a pane of 1"; in the middle of its
 * wall. */
#define TN_LEAF_NM INT64_C(44450000)
#define TN_PANE_NM INT64_C(25400000)

/* ---- region.c: rectangles */

typedef struct tn_rectangles {
    tn_rectangle *items;
    size_t count, room;
} tn_rectangles;

tn_status tn_rectangles_add(tn_rectangles *list, tn_rectangle rectangle, tn_error *error);

/* Appends the union of some rectangles less others: cut at every x of their edges, stretches in y joined, neighbours
 * with the same whole list of stretches joined. */
tn_status tn_region_cut(const tn_rectangles *of, const tn_rectangles *less, tn_rectangles *cut, tn_error *error);

/* ---- layers.c: what walls, posts and decks consist of */

/* The layers of a solid: `first` and the next among those of its form, across an axis, from its low side or its high
 * one. count: 0 if it is of one piece. */
typedef struct tn_layering {
    const tn_house_form *form;
    uint32_t first, count;
    int axis;
    bool from_high;
} tn_layering;

/* What a wall in a face is, if one stands there. */
tn_solid_kind tn_face_wall(const tn_house *house, const tn_face *face);

tn_layering tn_solid_layering(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item);

/* How a wall is cut that stands in a face: also if it has no layers. */
tn_layering tn_face_layering(const tn_house *house, const tn_face *face);

/* How the wall below a roof is cut that stands above a face: as what stands there, and above a partition as an outside
 * wall, which is as thick. */
tn_layering tn_gable_layering(const tn_house *house, const tn_face *face);

/* What one of them takes of the solid's box. */
tn_box tn_layer_box(const tn_layering *layers, uint32_t layer, const tn_box *box);

/* Where it is of a wall below a roof that is cut as the wall of a face, with half a wall beyond the ends of that. */
tn_rectangle tn_gable_layer_at(const tn_house *house, uint32_t face, const tn_layering *layers, uint32_t layer);

/* Appends what a layer takes of a prism: nothing where that does not reach into it. */
tn_status tn_layer_prisms(const tn_house *house, const tn_solids *solids, const tn_prism *prism,
                          const tn_layering *layers, uint32_t layer, tn_solids *pieces, tn_error *error);

/* The face of the wall as which a post is cut: the thicker of those that end there; of equal ones the one along x; of
 * several the first. TN_NO_FACE: no wall is as thick as the post. */
uint32_t tn_post_wall(const tn_house *house, uint32_t storey, const tn_post *post);

/* ---- guards.c */

/* The storey that a guard stands in. */
uint32_t tn_guard_storey(const tn_house *house, uint32_t face);

/* Puts the guards of a house, if it has some: clear of posts, walls and flights. foot: [storey] the rectangles on which
 * walls stand. */
tn_status tn_house_guards(const tn_house *house, const tn_rectangles *foot, const tn_flights *flights,
                          tn_solids *solids, tn_error *error);

/* ---- roof.c: decks, foot: [storey] the rectangles of decks, and those on which walls stand */
tn_status tn_house_roofs(const tn_house *house, const tn_rectangles *decks, const tn_rectangles *foot,
                         tn_solids *solids, tn_error *error);

/* ---- lower.c */

/* Is it the highest cell of its stack? */
bool tn_cell_is_top(const tn_house *house, uint32_t cell);

/* The highest point of the lower roofs that stand against the outer side of an outside face, along an opening, or
 * (NULL) all of the face: above the lowest floor, in nanometres. false: none stands there. Eaves do not count, which
 * hang free.
 */
bool tn_face_roofed(const tn_house *house, const tn_face *face, const tn_opening_record *opening, tn_fraction *top);

/* ---- behind.c */

/* An opening (or TN_FACE_OPEN) that would be in a face, but for a lower roof. kind: of the face. sill, top: of that
 * roof; above the lowest floor, in nanometres. */
typedef struct tn_behind_roof {
    uint32_t kind;
    int64_t sill;
    tn_fraction top;
} tn_behind_roof;

/* Finds such an opening of the lines that are asked for a face: of kind `kind`, or the first where that is
 * TN_NO_RECORD. false: there is none. */
bool tn_face_behind_roof(const tn_house *house, const tn_face *face, uint32_t kind, tn_behind_roof *behind);

/* "its sill is 11' above the lowest floor, and the roof there reaches 12'6\"", in the unit of the schema's lengths; the
 * roof to the next 1/64" or millimetre above. A text of 200 holds any. */
void tn_behind_roof_text(const tn_house *house, const tn_behind_roof *behind, char *text, size_t size);

/* In what the schema's author writes lengths: as the first value of the field of lengths is spelt. */
tn_length_style tn_house_length_style(const tn_house *house);

/* ---- roof.c */

/* A wall below the slab of a roof: the level from which it goes up, and the face as whose wall it is cut into layers,
 * or TN_NO_FACE. */
typedef struct tn_gable {
    int64_t base;
    uint32_t face;
} tn_gable;

/* Puts the slab of a cell's roof over a rectangle, with the wall below it, if that is not NULL. */
tn_status tn_roof_put(const tn_house *house, uint32_t cell, tn_rectangle r, const tn_gable *wall, tn_solids *solids,
                      tn_error *error);

/* ---- eaves.c */

/* A highest cell of a stack, and what it covers. */
typedef struct tn_parcel {
    uint32_t cell;
    tn_rectangles own;
} tn_parcel;

/* Puts the eaves of a level's roofs: where nothing else is, and no lower roof reaches up to them. `taken`: what the
 * roofs of the level and the cells above cover; eaves are added to it. */
tn_status tn_roof_eaves(const tn_house *house, const tn_parcel *land, size_t count, tn_rectangles *taken,
                        tn_solids *solids, tn_error *error);

/* ---- under.c */

/* Is the highest cell of a stack open up to its roof? */
bool tn_cell_is_open_above(const tn_house *house, uint32_t cell);

/* Where walls stand below the slab of a cell's roof, of what that covers: above outside and party walls, and where the
 * roof ends or another begins; if the room is open to its roof, above all walls and posts (`foot`). Appends the
 * rectangles with walls, and those without. */
tn_status tn_roof_walls(const tn_house *house, const tn_parcel *land, const tn_rectangles *foot, tn_rectangles *walls,
                        tn_rectangles *empty, tn_error *error);

/* Appends which of such walls are cut into layers as the wall of a face of the cell: those within half a wall of that;
 * where two walls meet, the one along x; of two such, the first. Takes them out of `walls`. */
tn_status tn_roof_walls_at(const tn_house *house, uint32_t cell, uint32_t face, tn_rectangles *walls,
                           tn_rectangles *at, tn_error *error);

tn_status tn_solids_add(tn_solids *solids, tn_solid solid, tn_error *error);

/* What a cell covers: its rectangle, grown by half a wall. */
tn_rectangle tn_cell_grown(const tn_house *house, const tn_cell *cell);

#endif
