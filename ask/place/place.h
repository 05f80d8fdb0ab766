/* What is asked of the question `place` before a file is open. */
#ifndef TARTAN_ASK_PLACE_PLACE_H
#define TARTAN_ASK_PLACE_PLACE_H

#include "ask/session/made.h"
#include "ask/session/session.h"
#include "driver/place/shape.h"

/* ---- the parts of a model, for answers */

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

/* TN_INVALID, and says it, if the request makes no sense whatever the file is. The question asks this, too. */
tn_status tn_place_check(tn_session *session, const tn_place_request *request);

#endif
