/* The parents that fields are bred from: read from .field files, made into trees, and kept with the run as text, so
 * that a run can be made again without the files.
 *
 * The text is that of a file of first genomes: a genome a line, with lines of comments that say the rest:
 *
 *   # constant radius 2.5
 *   # footer box (-7, -7, -7)..(7, 7, 7)
 *   # weight 0.4
 *   9 7 1 0 ...
 */
#ifndef TARTAN_DRIVER_BREED_FIELD_PARENTS_H
#define TARTAN_DRIVER_BREED_FIELD_PARENTS_H

#include "runtime/genome/settings.h"
#include "runtime/genome/tree/tree_kind.h"

/* Reads the parents that a study at `path` names, and adds their files to the inputs (inputs.h). The caller frees
 * *text. TN_INVALID (E1247) where one cannot be bred from; *blamed is then its number among study->each. */
tn_status tn_field_parents_read(const tn_evolution_study *study, const char *path, char **text, char **inputs,
                                uint32_t *blamed, tn_error *error);

typedef struct tn_field_parents tn_field_parents;

/* The parents in such a text. Free them in any case; NULL is fine. TN_INVALID where it is no such text. */
tn_status tn_field_parents_of(const char *text, tn_field_parents **parents, tn_error *error);
void tn_field_parents_free(tn_field_parents *parents);

/* What their children are bred with; its `how` is the caller's to set. */
tn_tree_breeding *tn_field_parents_breeding(tn_field_parents *parents);

#endif
