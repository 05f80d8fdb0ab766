/* Pictures of houses: one drawing, or a sheet of them, to scale. */
#ifndef TARTAN_HOUSE_DRAW_H
#define TARTAN_HOUSE_DRAW_H

#include "runtime/base/picture.h"
#include "runtime/house/model/aspect.h"

typedef struct tn_house_drawing {
    const tn_aspect *aspects; /* in the order in which they stand on the sheet */
    size_t count;
    const char *title;        /* NULL: none */
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

/* Draws many houses on one page, in space, small, all to one scale. Errors as tn_house_draw. */
tn_status tn_house_gallery_draw(const tn_house_gallery *gallery, tn_picture *to, tn_error *error);

#endif
