/* Conditions that a command line gives: --require of `tartan inspect`, --fitness of `tartan place`. */
#ifndef TARTAN_DRIVER_PLACE_ASKED_H
#define TARTAN_DRIVER_PLACE_ASKED_H

#include "driver/place/kit.h"

/* Compiles conditions, as a kit has them, about parts of these names; `option` is what messages call the text. Close
 * *asked in any case; its diagnostics say what is wrong (TN_INVALID). */
tn_status tn_kit_ask(const char *option, const char *text, const char *const *parts, size_t part_count,
                     tn_opened *asked);

/* What is wrong with the conditions takes the place of what there was to say of `opened`; their text is added to its
 * sources. */
void tn_kit_ask_failed(tn_opened *opened, tn_opened *asked);

/* Holds a model to the conditions: adds those that do not hold (E1316) to the diagnostics of `opened`. */
tn_status tn_kit_hold(tn_opened *opened, tn_opened *asked, const tn_placed_model *model,
                      const tn_placed_measures *measured);

/* A fitness of alternatives of a connection grammar (tn_place_options.value): an expression of `elements` and
 * count(PART). Tallies what the model has, so that each part is looked at once. */
typedef struct tn_place_fitness {
    tn_opened asked;
    double terms[TN_PLACED_TERM_COUNT];
    size_t seen; /* parts of the model that were tallied */
} tn_place_fitness;

/* Compiles it; E1337 for other terms. Clear it in any case; its diagnostics are those of `asked`. */
tn_status tn_place_fitness_make(const tn_place_rules *rules, const char *text, tn_place_fitness *fitness);
void tn_place_fitness_clear(tn_place_fitness *fitness);
double tn_place_fitness_value(tn_place_fitness *fitness, const tn_placed_model *model, const char *const *ahead,
                              size_t ahead_count);

#endif
