/* Scoring fields: a sentence is a .field text; its surface is meshed, and the mesh is held to the goals of a study. */
#ifndef TARTAN_DRIVER_BREED_FIELD_SCORER_H
#define TARTAN_DRIVER_BREED_FIELD_SCORER_H

#include "driver/program/program_scorer.h"
#include "runtime/base/picture.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/settings.h"
#include "runtime/geometry/guide/guide.h"
#include "runtime/geometry/mesh.h"

typedef struct tn_field_scorer tn_field_scorer;

#define TN_BRED_TRIANGLES 2000000u /* of a surface that is bred */

/* The goals are the lines `fitness` and `likeness` of a study at `path`; without any, what has a surface scores 0. With
 * `separately`, each is an objective. Adds the meshes that it reads to the inputs (inputs.h). TN_INVALID (E1248) where
 * one is wrong: *blamed is then its number among study->each. */
tn_status tn_field_scorer_new(const tn_evolution_study *study, const char *path, bool separately,
                              tn_field_scorer **scorer, char **inputs, uint32_t *blamed, tn_error *error);
void tn_field_scorer_free(tn_field_scorer *scorer);

/* Who is told of the surfaces that are scored, with their measures. From here on what has a surface is meshed, whether
 * there are goals or not. */
void tn_field_scorer_tell(tn_field_scorer *scorer, tn_form_listener listener);

/* From here on pictures show surfaces that end at the box, instead of being closed there. */
void tn_field_scorer_draw_open(tn_field_scorer *scorer);

/* Is anything wanted of a surface? */
bool tn_field_scorer_wants(const tn_field_scorer *scorer);

tn_evaluator tn_field_scorer_evaluator(tn_field_scorer *scorer);

/* What objective `i` is, where each goal is one. */
const char *tn_field_scorer_objective(const void *scorer, size_t i);

/* Draws sentences that could be scored side by side, as tn_grower_draw does, but in pixels. */
tn_status tn_field_scorer_draw(const void *scorer, const char *const *sentences, const char *const *labels,
                               size_t count, const char *title, tn_picture *to, tn_error *error);

/* A sentence's form as a mesh, z up, which the caller clears with the guides that are added to it. */
tn_status tn_field_scorer_mesh(const void *scorer, const char *sentence, tn_mesh *mesh, tn_guides *guides,
                               tn_error *error);

#endif
