/* A mesh that bred fields shall be like. */
#ifndef TARTAN_DRIVER_BREED_TARGET_H
#define TARTAN_DRIVER_BREED_TARGET_H

#include "runtime/field/field.h"

typedef struct tn_target tn_target;

/* Reads a closed mesh. TN_INVALID (E1248) where it is not closed or cannot be read. */
tn_status tn_target_read(const char *path, tn_target **target, tn_error *error);
void tn_target_free(tn_target *target);

/* The volume that the field and the target share, as a share of the volume of both together: 1 where they are the
 * same. Both are counted at the samples of the field's grid. May be called by several threads, of fields with one grid.
 */
tn_status tn_target_likeness(tn_target *target, const tn_field *field, double *likeness, tn_error *error);

#endif
