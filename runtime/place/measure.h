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

/* space: of the kit's model that was placed; NULL if nothing is known of one, and `fill` is 0 then. Clear it in any
 * case. */
tn_status tn_placed_measure(const tn_module *module, const tn_kit_model_record *space, const tn_placed_model *model,
                            tn_watch *watch, tn_placed_measures *measured, tn_error *error);
/* The same where the space is known to have so many cells. */
tn_status tn_placed_measure_inside(const tn_module *module, uint64_t inside, const tn_placed_model *model,
                                   tn_watch *watch, tn_placed_measures *measured, tn_error *error);

/* The terms that sums over the kit's parts tell: mass, price and counts. used: [part of the kit]. */
void tn_placed_sums(const tn_module *module, const uint64_t *used, double terms[TN_PLACED_TERM_COUNT]);
void tn_placed_measures_clear(tn_placed_measures *measured);

/* What a kit's model requires of what was placed, and in which words it is said that this does not hold.
 *
 * Nothing here owns anything: conditions are records of a module, and what was measured is the caller's. */

/* Does a condition (a function of kind KIT) hold? */
bool tn_kit_condition_holds(const tn_module *module, uint32_t function, const tn_placed_measures *measured);

typedef struct tn_kit_tally {
    size_t passed, failed;
} tn_kit_tally;

/* The next condition of a model, from *i on, that does not hold, and *i behind it; NULL if there is none. Of its
 * requirements, and where `tests` of the expectations of its tests too; those that were looked at are added to the
 * tally. */
const tn_kit_condition_record *tn_kit_next_unmet(const tn_module *module, const tn_kit_model_record *model,
                                                 const tn_placed_measures *measured, bool tests, uint32_t *i,
                                                 tn_kit_tally *tally);

/* Fills `error` (TN_INVALID, E1316) for a condition that does not hold, with what was found of each term that it names.
 * model: of the module, whose condition it is; NULL: of a model that was drawn. placed: by us, so that placing
 * otherwise may help, which is said. */
tn_status tn_kit_fail_condition(const tn_module *module, const tn_kit_condition_record *condition,
                                const tn_kit_model_record *model, const tn_placed_measures *measured, bool placed,
                                tn_error *error);

/* Measures what was placed where its model requires anything; *required: is that so? Measuring takes as long as
 * placing. Clear *measured in any case. */
tn_status tn_kit_measure_required(const tn_place_rules *rules, const tn_placed_model *model, tn_watch *watch,
                                  bool *required, tn_placed_measures *measured, tn_error *error);

/* How many parts there are of a name and colour. */
typedef struct tn_part_count {
    const char *name;
    int32_t colour;
    uint64_t count;
} tn_part_count;

/* All of these, in the order of their first; *counts is the caller's to free. */
tn_status tn_place_count_parts(const tn_placed_model *model, tn_part_count **counts, size_t *kinds, tn_error *error);

#endif
