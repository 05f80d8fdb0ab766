/* A surface of a module, ready to be evaluated: f at a place, below 0 inside (docs/field-language.md).
 *
 * It borrows the module and the meshes; free it with tn_field_clear. Immutable once read, and may be shared between
 * threads.
 */
#ifndef TARTAN_FIELD_FIELD_H
#define TARTAN_FIELD_FIELD_H

#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/mesh.h"
#include "runtime/module/module.h"
#include "runtime/number/tape.h"

/* The box, and its samples along each axis. */
typedef struct tn_field_grid {
    double low[3], high[3];
    uint32_t count[3];
} tn_field_grid;

typedef struct tn_field {
    const tn_module *module;
    const tn_surface_record *record;
    uint32_t code; /* its offset */
    uint32_t kept; /* numbers that the code keeps */
    tn_distances distances;
    tn_tape samples;  /* stages: what depends on y and z, then all */
    tn_tape along[3]; /* stages: what does not depend on this axis, then all */
} tn_field;

/* The surface of this index. meshes: one for each DISTANCE_MESH record. TN_OK or TN_MEMORY. */
tn_status tn_field_read(const tn_module *module, uint32_t surface, tn_boundary_mesh *const *meshes, tn_field *field,
                        tn_error *error);
void tn_field_clear(tn_field *field);

/* The grid of the surface's box, with `samples` (0: what the file says) on its longest side. */
tn_field_grid tn_field_grid_of(const tn_field *field, uint32_t samples);

/* The place of sample i of an axis. */
static inline double tn_field_sample(const tn_field_grid *grid, int axis, uint32_t i)
{
    double last = grid->count[axis] - 1;
    return (grid->low[axis] * (last - i) + grid->high[axis] * i) / last;
}

/* One thread's way of evaluating a field at rows of places: by a tape, or by the plain interpreter. */
typedef struct tn_field_runner {
    const tn_field *field;
    const tn_tape *tape;
    tn_tape_rows rows;
    bool interpret;
    double *kept, *values; /* owned; of the interpreter */
} tn_field_runner;

tn_status tn_field_runner_new(const tn_field *field, const tn_tape *tape, bool interpret, tn_field_runner *runner,
                              tn_error *error);
void tn_field_runner_clear(tn_field_runner *runner);

/* Does what depends on no coordinate that will change; then as often as wanted the rest. runner->rows.coordinates hold
 * the places. */
void tn_field_prepare(tn_field_runner *runner);
const double *tn_field_run(tn_field_runner *runner);

/* The meshes that a module's fields measure distances from. */

typedef struct tn_field_meshes {
    tn_boundary_mesh **items; /* owned: one for each DISTANCE_MESH record */
    size_t count;
} tn_field_meshes;

/* Reads them all; opened: the path of the file or module, beside which they lie. TN_INVALID or TN_IO (E1412) if one
 * is missing or broken. Clear the meshes in any case. */
tn_status tn_field_meshes_read(const tn_module *module, const tn_mesh_reader *reader, const char *opened,
                               tn_field_meshes *meshes, tn_error *error);
void tn_field_meshes_clear(tn_field_meshes *meshes);

/* Normals of a field's mesh, by differentiation. */

/* The unit gradient at each vertex, [vertex_count][3]. Where the vertex is not on the surface (where the box closes the
 * form, and at jumps), or the gradient has no value or is below 1e-9 of the median, the mean of the faces' normals.
 * spacing: of the grid. The caller frees them. TN_MEMORY. */
tn_status tn_field_normals(const tn_field *field, const tn_mesh *mesh, double spacing, double **normals,
                           tn_error *error);

/* The gradient at a vertex, and its size: 0 if it says nothing about the surface. registers: room for four times
 * field->samples.register_count. */
double tn_field_slope(const tn_field *field, const double *vertex, double spacing, double *registers,
                      double gradient[3]);

/* The volume inside a field, between two numbers that intervals prove. */

typedef struct tn_field_volume {
    double low, high;
} tn_field_volume;

/* The box is halved along each axis until a block is proven to be inside or outside, or is as small as a cell of the
 * grid; what is still open counts for `high` alone. Sums are rounded outward. TN_OK or TN_MEMORY. */
tn_status tn_field_volume_bounds(const tn_field *field, const tn_field_grid *grid, tn_field_volume *volume,
                                 tn_error *error);

#endif
