/* Scoring rule files by what they grow: a sentence is a .hemls text; it is compiled, grown as a growth study says, and
 * measured against the study's fitness terms. */
#ifndef TARTAN_DRIVER_BREED_GROWER_H
#define TARTAN_DRIVER_BREED_GROWER_H

#include "driver/program/program_scorer.h"
#include "runtime/base/picture.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/geometry/guide/guide.h"
#include "runtime/geometry/mesh.h"

typedef struct tn_grower tn_grower;

#define TN_GROWER_EDGES 50000u /* edges of one growth, where the study has no limit of its own */

/* `study` is the path of a .study with the surroundings, the steps and the fitness terms; the rules that it names are
 * not grown. With `separately`, each term is an objective; else their sum is the one. Sentences are scored by up to
 * `threads` threads. It has goals, or it `may_want_nothing`. TN_INVALID (E1245) where it cannot be used. */
tn_status tn_grower_new(const char *study, bool separately, bool may_want_nothing, unsigned threads, tn_grower **grower,
                        tn_error *error);
void tn_grower_free(tn_grower *grower);

/* Who is told of the surfaces that are scored, with their measures. */
void tn_grower_tell(tn_grower *grower, tn_form_listener listener);

/* Is anything wanted of a surface? */
bool tn_grower_wants(const tn_grower *grower);

tn_evaluator tn_grower_evaluator(tn_grower *grower);

/* What objective `i` is, where each is one: a term, or the name of an expression. */
const char *tn_grower_objective(const void *grower, size_t i);

/* Grows sentences that could be scored, and draws them side by side in their order, each over its label (`labels` may
 * be NULL). */
tn_status tn_grower_draw(const void *grower, const char *const *sentences, const char *const *labels, size_t count,
                         const char *title, tn_picture *to, tn_error *error);

/* Adds what its scores depend on to the text (inputs.h): the study, its rules and meshes. */
tn_status tn_grower_inputs(const tn_grower *grower, char **inputs, tn_error *error);

/* A sentence's form as a mesh, z up, which the caller clears with the guides that are added to it. */
tn_status tn_grower_mesh(const void *grower, const char *sentence, tn_mesh *mesh, tn_guides *guides, tn_error *error);

/* What the study requires and a sentence's surface does not meet, a line each; "" where it meets all. The caller frees
 * it. */
tn_status tn_grower_unmet(const void *grower, const char *sentence, char **text, tn_error *error);

/* The first mesh that surfaces are to stay inside of, and which has no inside; or NULL. */
const char *tn_grower_open_mesh(const tn_grower *grower);

#endif
