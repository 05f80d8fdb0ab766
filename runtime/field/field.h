/* A surface of a module, ready to be evaluated: f at a place, below 0 inside (docs/field-language.md).
 *
 * It borrows the module and the meshes; free it with tn_field_clear. Immutable once read, and may be shared between
 * threads.
 */
#ifndef TARTAN_FIELD_FIELD_H
#define TARTAN_FIELD_FIELD_H

#include "runtime/geometry/boundary_mesh.h"
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

#endif
