/* Scoring rules of kits: a sentence is statements of a .kit file; they are put into a kit in the place of rules of the
 * same names, and what its model then becomes is held to the model's requirements and objective. */
#ifndef TARTAN_DRIVER_PLACE_PLACER_H
#define TARTAN_DRIVER_PLACE_PLACER_H

#include "runtime/base/picture.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/module/module.h"
#include "runtime/place/steps.h"

typedef struct tn_placer tn_placer;

#define TN_PLACER_PARTS 50000u     /* of one model */
#define TN_PLACER_VIOLATION 1000.0 /* what a requirement that is missed by 1 adds to a score */

/* `kit` is the path of a .kit with one model that requires something or has an objective, or `may_want_nothing`. With `separately`, the
 * model's objective and the length of the rules are two objectives, and requirements come first; else the score is the
 * objective (negated where it is to be large) and TN_PLACER_VIOLATION times how far the requirements are from holding.
 * TN_INVALID (E1360) where it cannot be used. */
tn_status tn_placer_new(const char *kit, bool separately, bool may_want_nothing, tn_placer **placer, tn_error *error);
void tn_placer_free(tn_placer *placer);

/* What somebody is told of a model that was scored. */
typedef struct tn_placed_facts {
    const tn_module *module;
    const tn_placed_model *model;
    const double *terms; /* [TN_PLACED_TERM_COUNT], named by tn_placed_terms */
} tn_placed_facts;

typedef tn_status tn_placer_hear(void *context, unsigned thread, const tn_placed_facts *facts, tn_error *error);
void tn_placer_tell(tn_placer *placer, tn_placer_hear *hear, void *context);

/* Is anything wanted of the model? */
bool tn_placer_wants(const tn_placer *placer);

tn_evaluator tn_placer_evaluator(tn_placer *placer);

/* What objective `i` is, where there are two. */
const char *tn_placer_objective(const void *placer, size_t i);

/* Places sentences that could be scored, and draws their models side by side, as tn_grower_draw does. */
tn_status tn_placer_draw(const void *placer, const char *const *sentences, const char *const *labels, size_t count,
                         const char *title, tn_picture *to, tn_error *error);

/* What the kit's model requires and that of a sentence does not meet, a line each; "" where it meets all. The caller
 * frees it. */
tn_status tn_placer_unmet(const void *placer, const char *sentence, char **text, tn_error *error);

/* The whole kit with the rules of a sentence, for a file that lies elsewhere. The caller frees it. */
tn_status tn_placer_text(const tn_placer *placer, const char *sentence, char **text, tn_error *error);

/* The module of the kit as it is; the placer's. */
const tn_module *tn_placer_kit(const tn_placer *placer);

#endif
