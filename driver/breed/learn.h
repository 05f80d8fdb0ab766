/* Learning a pruning rule from examples: a sentence is a .plan text with a rule; it is compiled, lowered to its
 * automaton, and held against plans to be kept and plans to be dropped. */
#ifndef TARTAN_DRIVER_BREED_LEARN_H
#define TARTAN_DRIVER_BREED_LEARN_H

#include "driver/open/open.h"
#include "runtime/base/picture.h"
#include "runtime/genome/breeding/evolve.h"

typedef struct tn_learner tn_learner;

/* `schema` is what the plans are of, as `use` names it in a file beside the one at `user`. With `separately`, errors
 * and length are two objectives; else one, errors + length_weight * bytes. TN_INVALID (E1244) where there is no such
 * schema. */
tn_status tn_learner_new(const char *schema, const char *user, double length_weight, bool separately,
                         tn_learner **learner, tn_error *error);

/* Adds the plans of a file to the examples: those that the rule is to drop, or to keep. TN_INVALID (E1244) where it has
 * none, and as tn_plan_reader_next. */
tn_status tn_learner_read(tn_learner *learner, const char *path, bool drop, tn_error *error);
void tn_learner_free(tn_learner *learner);

/* Objective 0: plans judged wrongly (and the length's price); objective 1: bytes of the sentence. */
tn_evaluator tn_learner_evaluator(tn_learner *learner);

/* Draws the rule of a sentence that could be scored (runtime/plan/picture/draw_rule.h). */
tn_status tn_learner_draw(tn_learner *learner, const char *sentence, tn_picture *to, tn_error *error);

/* The module that declares the examples' schema; the learner's. */
const tn_module *tn_learner_schema(const tn_learner *learner);

#endif
