/* Runs what the engine of fields does: small meshes of a module's surfaces, in both ways. */
#include <string.h>

#include "runtime/field/contour.h"
#include "tests/fuzz/engines.h"

enum { SURFACES = 4, GRID = 9, CODE = 20000 };

/* The interpreter at every sample, and rows with blocks skipped, give the same vertices. */
static void compare(const tn_field *field)
{
    tn_contour quick = {0}, plain = {0};
    tn_field_grid grid = tn_field_grid_of(field, GRID);
    tn_contour_options options = {.threads = 1}, slow = {.threads = 1, .interpret = true, .every_sample = true};
    bool both = tn_contour_new(field, &grid, &options, &quick, NULL) == TN_OK &&
                tn_contour_new(field, &grid, &slow, &plain, NULL) == TN_OK;
    if (both && (quick.mesh.vertex_count != plain.mesh.vertex_count ||
                 memcmp(quick.mesh.positions, plain.mesh.positions, 3 * sizeof(double) * quick.mesh.vertex_count) != 0))
        fuzz_broken("the two ways of meshing a field differ");
    tn_contour_clear(&quick);
    tn_contour_clear(&plain);
}

void fuzz_field(const tn_module *module)
{
    for (uint32_t i = 0; i < module->SURFACE_count && i < SURFACES; i++) {
        const tn_function_record *function = &module->FUNCTION_records[module->SURFACE_records[i].function];
        tn_field field;
        if (module->DISTANCE_MESH_count > 0 || function->code_end - function->code_begin > CODE)
            continue;
        if (tn_field_read(module, i, NULL, &field, NULL) == TN_OK)
            compare(&field);
        tn_field_clear(&field);
    }
}
