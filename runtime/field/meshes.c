/* Reads the meshes that fields measure distances from. */
#include "runtime/field/meshes.h"

#include <stdlib.h>

tn_status tn_field_meshes_read(const tn_module *module, const tn_mesh_reader *reader, const char *opened,
                               tn_field_meshes *meshes, tn_error *error)
{
    *meshes = (tn_field_meshes){.items = calloc(module->DISTANCE_MESH_count + 1, sizeof *meshes->items)};
    if (!meshes->items)
        return tn_fail_memory(error);
    for (size_t i = 0; i < module->DISTANCE_MESH_count; i++) {
        const tn_distance_mesh_record *record = &module->DISTANCE_MESH_records[i];
        const char *source = tn_text(module, module->SOURCE_records[record->file].path);
        tn_status status = tn_boundary_mesh_find(reader, opened, source, tn_text(module, record->path), "mesh", "field",
                                                 &meshes->items[i], error);
        if (status != TN_OK) {
            if (status != TN_MEMORY && error)
                error->code = E_FIELD_MESH;
            if (status == TN_INVALID)
                tn_error_help(error, "`distance` takes a mesh file: .obj, .ply, .stl, .off or .om");
            return status;
        }
        meshes->count++;
    }
    return TN_OK;
}

void tn_field_meshes_clear(tn_field_meshes *meshes)
{
    for (size_t i = 0; i < meshes->count; i++)
        tn_boundary_mesh_free(meshes->items[i]);
    free(meshes->items);
    *meshes = (tn_field_meshes){0};
}
