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
    TN_MARK_GROUND,
    TN_MARK_DIMENSION,
    TN_MARK_NAME,
    TN_MARK_LAYERS
} tn_mark_layer;

typedef enum tn_mark_kind {
    TN_MARK_LINE, /* from (u0, v0) to (u1, v1) */
    TN_MARK_ARC,  /* a quarter about (u0, v0), counter-clockwise from (u1, v1) */
    TN_MARK_TEXT, /* in the middle of (u0, v0), so high; upright: read from the right */
} tn_mark_kind;

typedef struct tn_mark {
    tn_mark_kind kind;
    tn_mark_layer layer;
    double u0, v0, u1, v1;
    double high;
    bool upright;
    char text[48];
} tn_mark;

typedef struct tn_marks {
    tn_mark *items;
    size_t count, room;
    bool failed; /* out of memory */
} tn_marks;

void tn_marks_clear(tn_marks *marks);

/* About how wide a line of lettering is, in its height. */
double tn_mark_width(const char *text);

/* A dimension between two places at `at` across: along u at that v, or, upright, along v at that u. */
void tn_marks_dimension(tn_marks *marks, const tn_house *house, double from, double to, double at, bool upright,
                        double lettering);
void tn_marks_line(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1);
void tn_marks_arc(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1); /* a quarter */
void tn_marks_text(tn_marks *marks, tn_mark_layer layer, double u, double v, double high, bool upright,
                   const char *text);

/* Those of the plan of a storey, with lettering so high. TN_MEMORY. */
tn_status tn_marks_plan(const tn_house *house, uint32_t storey, double lettering, tn_marks *marks, tn_error *error);

/* Those of what is seen from the side: the ground and the levels, left of what lies between low and high. TN_MEMORY. */
tn_status tn_marks_levels(const tn_house *house, const double low[2], const double high[2], double lettering,
                          tn_marks *marks, tn_error *error);

#endif
