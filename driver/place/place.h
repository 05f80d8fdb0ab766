/* Places the model of an opened connection grammar; what goes wrong is told at its place in the grammar, with what is
 * in the way. */
#ifndef TARTAN_DRIVER_PLACE_PLACE_H
#define TARTAN_DRIVER_PLACE_PLACE_H

#include "driver/open/open.h"
#include "runtime/place/grow.h"

/* As tn_place_derive, or as tn_place_search for a model of a kit that needs it; diagnostics are added to those of
 * `opened`. A run that fails for want of room is made a second time, to see what took it. Placing nothing is TN_INVALID
 * too. */
tn_status tn_place_model(tn_opened *opened, const tn_place_rules *rules, const tn_place_options *options,
                         tn_placed_model *model);

/* The span of a step, or of an alternative. */
tn_span tn_place_step_span(const tn_place_rules *rules, uint32_t step);
tn_span tn_place_alternative_span(const tn_place_rules *rules, uint32_t alternative);

#endif
