/* Models of kits: choosing one, and holding what was placed to its conditions. Diagnostics are added to those of
 * `opened`. */
#ifndef TARTAN_DRIVER_PLACE_KIT_H
#define TARTAN_DRIVER_PLACE_KIT_H

#include <stdio.h>

#include "driver/open/open.h"
#include "runtime/place/grow.h"
#include "runtime/place/measure.h"

/* Places the model of an opened connection grammar; what goes wrong is told at its place in the grammar, with what is
 * in the way. */

/* As tn_place_derive, or as tn_place_search for a model of a kit that needs it; diagnostics are added to those of
 * `opened`. A run that fails for want of room is made a second time, to see what took it. Placing nothing is TN_INVALID
 * too. */
tn_status tn_place_model(tn_opened *opened, const tn_place_rules *rules, const tn_place_options *options,
                         tn_placed_model *model);

/* The span of a step, or of an alternative. */
tn_span tn_place_step_span(const tn_place_rules *rules, uint32_t step);
tn_span tn_place_alternative_span(const tn_place_rules *rules, uint32_t alternative);

/* The model of this name, or the kit's only one where that is NULL; what is wrong is reported (E1317). */
tn_status tn_kit_choose(tn_opened *opened, const char *name, uint32_t *model);

/* Reports the conditions of a model that do not hold (E1316), with what was found: its requirements, and where `tests`
 * the expectations of its tests too. placed: by us, so that placing otherwise may help. TN_INVALID where one does not
 * hold. */
tn_status tn_kit_conditions(tn_opened *opened, uint32_t model, const tn_placed_measures *measured, bool tests,
                            bool placed, tn_kit_tally *tally);

/* Reports a condition of a module that does not hold, as tn_kit_fail_condition says it. */
void tn_kit_report_unmet(tn_opened *opened, const tn_module *module, const tn_kit_condition_record *condition,
                         const tn_kit_model_record *model, const tn_placed_measures *measured, bool placed);

/* Places every model of a kit, seed 0, and holds each to its requirements and tests. */
tn_status tn_kit_tests_run(tn_opened *opened, tn_watch *watch, tn_kit_tally *tally);

#endif
