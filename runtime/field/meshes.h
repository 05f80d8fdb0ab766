/* The meshes that a module's fields measure distances from. */
#ifndef TARTAN_FIELD_MESHES_H
#define TARTAN_FIELD_MESHES_H

#include "runtime/geometry/boundary_file.h"
#include "runtime/module/module.h"

typedef struct tn_field_meshes {
    tn_boundary_mesh **items; /* owned: one for each DISTANCE_MESH record */
    size_t count;
} tn_field_meshes;

/* Reads them all; opened: the path of the file or module, beside which they lie. TN_INVALID or TN_IO (E1412) where one
 * is missing or broken. Clear the meshes in any case. */
tn_status tn_field_meshes_read(const tn_module *module, const tn_mesh_reader *reader, const char *opened,
                               tn_field_meshes *meshes, tn_error *error);
void tn_field_meshes_clear(tn_field_meshes *meshes);

#endif
