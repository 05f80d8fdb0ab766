/* Pictures of houses: one drawing, or a sheet of them, to scale. */
#ifndef TARTAN_HOUSE_DRAW_H
#define TARTAN_HOUSE_DRAW_H

#include "runtime/base/picture.h"
#include "runtime/house/model/aspect.h"

/* What an office says of a drawing; NULL or empty: nothing. north: where it is on plans, in degrees from above,
 * clockwise. */
typedef struct tn_drawing_says {
    const char *project, *date, *revision;
    const double *north;
} tn_drawing_says;

typedef struct tn_house_drawing {
    const tn_aspect *aspects; /* in the order in which they stand on the sheet */
    size_t count;
    const char *title; /* NULL: none */
    tn_drawing_says says;
    const char *const *notes; /* lines at the foot */
    size_t note_count;
    uint32_t scale; /* 1:scale; 0: the largest usual one at which everything fits */
} tn_house_drawing;

/* Draws a house. One drawing gets a page of its size, several a sheet of paper. Errors as tn_house_projection_take;
 * E0820 where nothing would fit. */
tn_status tn_house_draw(const tn_house *house, const tn_solids *solids, const tn_house_drawing *drawing, tn_picture *to,
                        tn_error *error);

/* A house of many, with two lines below it. */
typedef struct tn_pictured_house {
    const tn_house *house;
    const tn_solids *solids;
    const char *name, *said;
} tn_pictured_house;

typedef struct tn_house_gallery {
    const tn_pictured_house *houses;
    size_t count;
    size_t columns; /* 0: somewhat more than there are rows */
    tn_camera camera;
    const char *title;        /* NULL: none */
    const char *const *notes; /* lines at the foot */
    size_t note_count;
} tn_house_gallery;

/* What of a house is lit up on its plans, and how: red, for a part that is at fault; rose, for what belongs to one;
 * green, for what is as it should be; grey, for what would stand there; pale blue, for the ground that a person comes
 * to, and a blue square, for the person; a dark blue line, for a walk. at: in a storey; a wall is without width or
 * depth; a line of a walk goes from (x0, y0) to (x1, y1). */
typedef enum tn_lit_tone {
    TN_LIT_FAULT,
    TN_LIT_BESIDE,
    TN_LIT_GOOD,
    TN_LIT_THING,
    TN_LIT_GROUND,
    TN_LIT_PERSON,
    TN_LIT_WALK
} tn_lit_tone;

typedef struct tn_lit {
    uint32_t storey;
    tn_rectangle at;
    tn_lit_tone tone;
} tn_lit;

/* A reason: what is said of it, and what it lights up. */
typedef struct tn_lit_reason {
    const char *heading;
    bool good; /* it speaks for the house */
    const char *const *lines;
    size_t line_count;
    const tn_lit *lits;
    size_t lit_count;
} tn_lit_reason;

typedef struct tn_lit_house {
    const tn_house *house;
    const tn_solids *solids;
    const char *title, *said; /* what is said of the whole */
    const tn_lit_reason *reasons;
    size_t reason_count;
} tn_lit_house;

/* Draws why a house is as it is: below each reason the plans of the storeys in which it lights something up; below all
 * of them, where none does, the plans of all storeys. One page, as high as needed. Errors as tn_house_draw. */
tn_status tn_lit_house_draw(const tn_lit_house *what, tn_picture *to, tn_error *error);

/* Draws many houses on one page, in space, small, all to one scale. Errors as tn_house_draw. */
tn_status tn_house_gallery_draw(const tn_house_gallery *gallery, tn_picture *to, tn_error *error);

#endif
