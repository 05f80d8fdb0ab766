/* The parts of a model, for answers: listed by their kinds, and drawn. */
#ifndef TARTAN_ASK_PLACE_PARTS_H
#define TARTAN_ASK_PLACE_PARTS_H

#include "ask/session/made.h"
#include "driver/place/shape.h"

/* The parts by name and colour, in the order of the first of each, as messages `placed_kind` in an empty list. */
tn_status tn_parts_by_kind(const tn_module *module, const tn_placed_model *model, tn_list *kinds, tn_error *error);

/* What a picture of a model shows. */
typedef struct tn_parts_picture {
    const tn_module *module;
    const tn_placed_model *model;
    const tn_placed_measures *measures;
    const bool *marked;           /* [part] those in red, or NULL */
    const tn_placed_steps *steps; /* a sheet of these; or NULL */
} tn_parts_picture;

/* Draws it to the stream: as SVG, PNG or PDF. */
tn_status tn_parts_draw(const tn_parts_picture *picture, tn_file_format format, FILE *out, tn_error *error);

/* Writes its closed surface, in millimetres and in the parts' colours. */
tn_status tn_parts_write_mesh(tn_opened *opened, const tn_placed_model *model, tn_file_format format, FILE *out,
                              tn_error *error);

#endif
