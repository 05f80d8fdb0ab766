/* What is measured of a placed model: the terms of a kit's conditions (runtime/place/model/terms.h), and which parts
 * they are about. docs/kit-language.md defines them. */
#ifndef TARTAN_PLACE_MEASURE_H
#define TARTAN_PLACE_MEASURE_H

#include "runtime/place/joints.h"
#include "runtime/place/model/terms.h"

typedef struct tn_placed_measures {
    double terms[TN_PLACED_TERM_COUNT];
    tn_placed_joints joints;
    bool *floating, *overlaps; /* [part], owned */
} tn_placed_measures;

/* space: of the kit's model that was placed; NULL where nothing is known of one, and `fill` is 0 then. Clear it in any
 * case. */
tn_status tn_placed_measure(const tn_module *module, const tn_kit_model_record *space, const tn_placed_model *model,
                            tn_watch *watch, tn_placed_measures *measured, tn_error *error);
/* The same where the space is known to have so many cells. */
tn_status tn_placed_measure_inside(const tn_module *module, uint64_t inside, const tn_placed_model *model,
                                   tn_watch *watch, tn_placed_measures *measured, tn_error *error);

/* The terms that sums over the kit's parts tell: mass, price and counts. used: [part of the kit]. */
void tn_placed_sums(const tn_module *module, const uint64_t *used, double terms[TN_PLACED_TERM_COUNT]);
void tn_placed_measures_clear(tn_placed_measures *measured);

#endif
