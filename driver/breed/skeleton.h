/* What designs of boxes are bred around: the rigid boxes of a design, its mirrors and flags, and what its free boxes
 * are as genes. Kept with the run as text, so that a run can be made again without the design's file:
 *
 *   # flags 5
 *   # depth 0
 *   # head   symmetry x, z;
 *   # foot   require parts = 1;
 *   4607182418800017408 ...       the free boxes, if there are any
 */
#ifndef TARTAN_DRIVER_BREED_SKELETON_H
#define TARTAN_DRIVER_BREED_SKELETON_H

#include "runtime/genome/boxes/box_kind.h"
#include "runtime/genome/settings.h"

/* Reads the design that a study at `path` names, and adds its file to the inputs (inputs.h). The caller frees *text.
 * TN_INVALID (E1246) where it cannot be bred from. */
tn_status tn_skeleton_read(const tn_evolution_study *study, const char *path, char **text, char **inputs,
                           tn_error *error);

typedef struct tn_skeleton tn_skeleton;

/* The skeleton in such a text, with the ranges that the study says. *blamed: the setting that is wrong, where one is.
 */
tn_status tn_skeleton_of(const char *text, const tn_evolution_study *study, tn_skeleton **skeleton, tn_setting *blamed,
                         tn_error *error);
void tn_skeleton_free(tn_skeleton *skeleton);

tn_box_breeding *tn_skeleton_breeding(tn_skeleton *skeleton);

/* The free boxes of the design as a genome: 1 or 0. */
const tn_genome *tn_skeleton_seed(const tn_skeleton *skeleton, size_t *count);

#endif
