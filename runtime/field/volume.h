/* The volume inside a field, between two numbers that intervals prove. */
#ifndef TARTAN_FIELD_VOLUME_H
#define TARTAN_FIELD_VOLUME_H

#include "runtime/field/field.h"

typedef struct tn_field_volume {
    double low, high;
} tn_field_volume;

/* The box is halved along each axis until a block is proven to be inside or outside, or is as small as a cell of the
 * grid; what is still open counts for `high` alone. Sums are rounded outward. TN_OK or TN_MEMORY. */
tn_status tn_field_volume_bounds(const tn_field *field, const tn_field_grid *grid, tn_field_volume *volume,
                                 tn_error *error);

#endif
