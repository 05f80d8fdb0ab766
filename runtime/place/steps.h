/* The steps in which a model is built: an order in which every part joins what stands, and can be put in from above.
 *
 * The steps own their array; clear them in any case. */
#ifndef TARTAN_PLACE_STEPS_H
#define TARTAN_PLACE_STEPS_H

#include "runtime/place/measure.h"

/* Step i ends before part ends[i]. hanging: parts that are above nothing of theirs yet: they join only what is over
 * them, or something that stands is in the way from above. loose: parts of other pieces that stand on nothing. */
typedef struct tn_placed_steps {
    size_t *ends;
    size_t count;
    size_t hanging, loose;
} tn_placed_steps;

/* Puts the parts of a measured model into the order of building, and divides it: a step for each layer, or for so many
 * parts. What was measured of the model is in the old order and of no use afterwards. TN_MEMORY, TN_STOPPED or TN_OK.
 */
tn_status tn_placed_steps_make(const tn_module *module, const tn_placed_measures *measured, bool layers, size_t parts,
                               tn_watch *watch, tn_placed_model *model, tn_placed_steps *steps, tn_error *error);
void tn_placed_steps_clear(tn_placed_steps *steps);

#endif
