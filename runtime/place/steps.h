/* The steps in which a model is built: an order in which every part joins what stands, and can be put in from above.
 *
 * The steps own their array; clear them in any case. */
#ifndef TARTAN_PLACE_STEPS_H
#define TARTAN_PLACE_STEPS_H

#include "runtime/place/measure.h"

/* A step for each layer, or for so many parts. */
typedef struct tn_steps_wish {
    bool layers;
    size_t parts;
} tn_steps_wish;

/* Step i ends before part ends[i]. hanging: parts that are above nothing of theirs yet: they join only what is over
 * them, or something that stands is in the way from above. loose: parts of other pieces that stand on nothing. */
typedef struct tn_placed_steps {
    size_t *ends;
    size_t count;
    size_t hanging, loose;
} tn_placed_steps;

/* Which steps the model says that it is built in (NULL: of a connection grammar). False if it says none; layers,
 * then. */
bool tn_kit_model_steps(const tn_kit_model_record *model, tn_steps_wish *wish);

/* Puts the parts of a kit's model into the order of building, and divides it. What was measured of it before is in
 * another order, and of no use any more. TN_MEMORY, TN_STOPPED or TN_OK. */
tn_status tn_placed_steps_make(const tn_module *module, const tn_steps_wish *wish, tn_watch *watch,
                               tn_placed_model *model, tn_placed_steps *steps, tn_error *error);
void tn_placed_steps_clear(tn_placed_steps *steps);

#endif
