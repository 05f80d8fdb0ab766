/* What is drawn on a house's plans, sections and elevations besides its solids: door swings, stairs, names, dimensions.
 *
 * Coordinates are nanometres in the plane of the drawing, u to the right and v upwards. A tn_marks owns its array; free
 * it with tn_marks_clear.
 */
#ifndef TARTAN_HOUSE_MARKS_H
#define TARTAN_HOUSE_MARKS_H

#include "runtime/house/house.h"

typedef enum tn_mark_layer {
    TN_MARK_DOOR,
    TN_MARK_STAIR,
    TN_MARK_VOID, /* dashed */
    TN_MARK_BEAM, /* overhead, dashed */
    TN_MARK_GROUND,
    TN_MARK_DIMENSION,
    TN_MARK_NAME,
    TN_MARK_TAG,     /* of doors and windows */
    TN_MARK_SECTION, /* where the house is cut */
    TN_MARK_FURNITURE,
    TN_MARK_WINDOW,
    TN_MARK_ROOF, /* how it falls */
    TN_MARK_LAYERS
} tn_mark_layer;

typedef enum tn_mark_kind {
    TN_MARK_LINE,   /* from (u0, v0) to (u1, v1) */
    TN_MARK_TEXT,   /* in the middle of (u0, v0), so high; upright: read from the right */
    TN_MARK_CIRCLE, /* about (u0, v0), through (u1, v1) */
    TN_MARK_SPAN,   /* a dimension from (u0, v0) to (u1, v1), its text so high; or below the line; or empty; its strokes heavy */
    TN_MARK_LEAF,   /* of a door, hinged at (u0, v0) and open to (u1, v1); shut to its left, or to its right */
    TN_MARK_PANE,   /* of a window, from (u0, v0) to (u1, v1), so thick (high) */
    TN_MARK_NORTH,  /* an arrow about (u0, v0), from above so many degrees (high) clockwise, and its letter: within (u1, v1) */
    TN_MARK_ITEM    /* a symbol, with its corner at (u0, v0) and the opposite one at (u1, v1) */
} tn_mark_kind;

/* A thing as it is drawn: its TILE_BOX record, its symbol, and how large it is along its back and away from it, in
 * nanometres. quarter: where its back is, 0 above, then at the right and so on; mirrored: from left to right.
 * free_sides: bits for its back, its front, its left and its right, at which a chair has room. */
typedef struct tn_marked_item {
    uint32_t box;
    tn_item_symbol symbol;
    double wide, deep;
    uint32_t quarter, free_sides;
    bool mirrored;
} tn_marked_item;

typedef struct tn_mark {
    tn_mark_kind kind;
    tn_mark_layer layer;
    double u0, v0, u1, v1;
    double high; /* of what is written; of north: its angle; of a pane: how thick; of the ground where it is cut: twice how deep the earth is shown */
    bool upright, below, right, heavy;
    tn_marked_item item;
    char text[48];
} tn_mark;

typedef struct tn_marks {
    tn_mark *items;
    size_t count, room;
    bool failed; /* out of memory */
} tn_marks;

void tn_marks_clear(tn_marks *marks);

/* A place where the house is cut: at x or at y. letter: by which the section is called. */
typedef struct tn_section_place {
    bool across_x;
    int64_t at;
    char letter;
} tn_section_place;

/* How the marks of a drawing are written. lettering: the size of what is written, whose capitals are 2.5 mm high on
 * paper. us: lengths in feet and inches (eighths: of a
 * form in metres, to the nearest 1/8"), areas in square feet, rooms numbered from 101, heavy strokes of dimensions;
 * otherwise in metres, or in millimetres, in square metres, and from 0.01. coarse: the scale is too small for
 * tags, and for dimensions of openings. undimensioned: a plan of the
 * roof has no dimensions. sections: what is shown in plans. north: where it is on plans, in degrees from
 * above, clockwise; or NULL. */
typedef struct tn_mark_style {
    double lettering;
    bool us, eighths, millimetres, coarse, bare, undimensioned;
    const double *north;
    const tn_section_place *sections;
    size_t section_count;
} tn_mark_style;

/* Writes a length as drawings have it: 5'-6 1/2" to the nearest 64th, 1.65 to the nearest millimetre, or 1650. A text
 * of 32 holds any. */
void tn_mark_length(const tn_mark_style *style, double nanometres, char text[32]);

/* About how wide a line of lettering is, in its height. */
double tn_mark_width(const char *text);

/* The same of an area, in square feet or square metres: 86 SF, 7.9 m and a raised 2. */
void tn_mark_area(bool us, double square_nanometres, char text[32]);

/* Dimensions between one place and the next in a chain: along u at v = at, or, upright, along v at u = at. The places
 * are sorted, and those that are the same are one. What has no room between its ends is written below the chain. */
void tn_marks_chain(tn_marks *marks, double *places, size_t count, double at, bool upright,
                    const tn_mark_style *style);
void tn_marks_line(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1);
void tn_marks_leaf(tn_marks *marks, double u0, double v0, double u1, double v1, bool right);
void tn_marks_pane(tn_marks *marks, double u0, double v0, double u1, double v1, double thick);
void tn_marks_text(tn_marks *marks, tn_mark_layer layer, double u, double v, double high, bool upright,
                   const char *text);

/* Where north is on a plan that reaches so far: beyond its upper right corner. style->north: there. */
void tn_marks_north(tn_marks *marks, const double high[2], const tn_mark_style *style);

void tn_marks_circle(tn_marks *marks, tn_mark_layer layer, double u, double v, double radius);

void tn_marks_item(tn_marks *marks, const tn_marked_item *item, double u0, double v0, double u1, double v1);

/* Turns all marks by half about the origin, but for what is written. */
void tn_marks_turn(tn_marks *marks);

/* Those of the plan of a storey, whose front is below: u is -x, v is -y. TN_MEMORY. */
tn_status tn_marks_plan(const tn_house *house, uint32_t storey, const tn_mark_style *style, tn_marks *marks,
                        tn_error *error);

struct tn_taken;

/* ---- marks_stairs.c: the stair in a cell; the flights that go up from a storey, and those that come up to it. TN_MEMORY.
 */
void tn_marks_stair(const tn_house *house, uint32_t cell, tn_marks *marks);
tn_status tn_marks_flights(const tn_house *house, uint32_t storey, const tn_mark_style *style, tn_marks *marks,
                           tn_error *error);

/* ---- marks_items.c: what stands in the rooms of a storey, as it is drawn; taken: turned as the plan is. TN_MEMORY. */
tn_status tn_marks_items(const tn_house *house, uint32_t storey, const struct tn_taken *taken, tn_marks *marks,
                         tn_error *error);

/* Those of the plan of the roof, which lies between low and high. TN_MEMORY. */
tn_status tn_marks_roof(const tn_house *house, const double low[2], const double high[2], const tn_mark_style *style,
                        tn_marks *marks, tn_error *error);

/* Those of what is seen from the side: the ground and the levels, left of what lies between low and high; at its right
 * the heights of rooms if it is cut. TN_MEMORY. */
tn_status tn_marks_levels(const tn_house *house, const double low[2], const double high[2], bool cut,
                          const tn_mark_style *style, tn_marks *marks, tn_error *error);

#endif
