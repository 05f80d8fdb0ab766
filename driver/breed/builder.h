/* Scoring designs of boxes: a sentence is a .solid text; its design is built and held to the goals of another. */
#ifndef TARTAN_DRIVER_BREED_BUILDER_H
#define TARTAN_DRIVER_BREED_BUILDER_H

#include "driver/program/program_scorer.h"
#include "runtime/base/picture.h"
#include "runtime/genome/boxes/box_kind.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/settings.h"
#include "runtime/geometry/guide/guide.h"
#include "runtime/geometry/mesh.h"

typedef struct tn_design_scorer tn_design_scorer;

#define TN_BRED_BOXES 2000u /* of a design that is bred, images counted */

/* `goals` is the path of a .solid with one design, whose `fitness` lines are the goals; its requirements count too, by
 * how far they are from holding. Its boxes are not built. With `separately`, each goal is an objective; else their sum
 * is the one. TN_INVALID (E1246) where it cannot be used. */
tn_status tn_design_scorer_new(const char *goals, bool separately, bool may_want_nothing, tn_design_scorer **scorer,
                               tn_error *error);
void tn_design_scorer_free(tn_design_scorer *scorer);

/* Adds the `fitness` lines of a study to the goals. With them, the design need have none of its own; where there are
 * none at all, what can be built scores how far its requirements are from holding. TN_INVALID (E1248) where one is
 * wrong: *blamed is its number among study->each. */
tn_status tn_design_scorer_add(tn_design_scorer *scorer, const tn_evolution_study *study, uint32_t *blamed,
                               tn_error *error);

/* From here on genomes are lists of boxes around the rigid boxes of the design, and are built without compiling their
 * sentences. The breeding is borrowed. */
tn_status tn_design_scorer_take_genes(tn_design_scorer *scorer, const tn_box_breeding *breeding, tn_error *error);

/* Who is told of the designs that are scored, with the measures that goals speak of. */
void tn_design_scorer_tell(tn_design_scorer *scorer, tn_form_listener listener);

/* Is anything wanted of a design? */
bool tn_design_scorer_wants(const tn_design_scorer *scorer);

tn_evaluator tn_design_scorer_evaluator(tn_design_scorer *scorer);

/* What objective `i` is, where each goal is one. */
const char *tn_design_scorer_objective(const void *scorer, size_t i);

/* Draws sentences that could be scored side by side, as tn_grower_draw does. */
tn_status tn_design_scorer_draw(const void *scorer, const char *const *sentences, const char *const *labels,
                                size_t count, const char *title, tn_picture *to, tn_error *error);

/* Adds what its scores depend on to the text (inputs.h). */
tn_status tn_design_scorer_inputs(const tn_design_scorer *scorer, char **inputs, tn_error *error);

/* A sentence's form as a mesh, z up, which the caller clears with the guides that are added to it. */
tn_status tn_design_scorer_mesh(const void *scorer, const char *sentence, tn_mesh *mesh, tn_guides *guides,
                                tn_error *error);

/* What is required and a sentence's design does not meet, as tn_grower_unmet says it. */
tn_status tn_design_scorer_unmet(const void *scorer, const char *sentence, char **text, tn_error *error);

#endif
