/* Reads a surface of a module, and evaluates it at rows of places. */
#include "runtime/field/field.h"

#include <math.h>
#include <stdlib.h>

static double measure(const void *meshes, uint32_t mesh, const double place[3], double gradient[3])
{
    tn_boundary_mesh *const *all = meshes;
    tn_vector x = {place[0], place[1], place[2]}, nearest;
    if (!(isfinite(x.x) && isfinite(x.y) && isfinite(x.z)))
        return NAN;
    double distance = tn_boundary_mesh_distance(all[mesh], x, &nearest);
    if (gradient) {
        gradient[0] = (x.x - nearest.x) / distance;
        gradient[1] = (x.y - nearest.y) / distance;
        gradient[2] = (x.z - nearest.z) / distance;
    }
    return distance;
}

tn_status tn_field_read(const tn_module *module, uint32_t surface, tn_boundary_mesh *const *meshes, tn_field *field,
                        tn_error *error)
{
    static const unsigned lines[] = {TN_NEEDS_Y | TN_NEEDS_Z, TN_NEEDS_ALL};
    *field = (tn_field){.module = module, .record = &module->SURFACE_records[surface]};
    field->distances = (tn_distances){measure, meshes};
    field->code = module->FUNCTION_records[field->record->function].code_begin;
    field->kept = tn_number_kept(module->code, field->code);
    tn_status status = tn_tape_new(module->code, field->code, lines, 2, &field->samples, error);
    for (unsigned axis = 0; axis < 3 && status == TN_OK; axis++) {
        unsigned needs[] = {TN_NEEDS_ALL & ~(1u << axis), TN_NEEDS_ALL};
        status = tn_tape_new(module->code, field->code, needs, 2, &field->along[axis], error);
    }
    return status;
}

void tn_field_clear(tn_field *field)
{
    tn_tape_clear(&field->samples);
    for (int axis = 0; axis < 3; axis++)
        tn_tape_clear(&field->along[axis]);
    *field = (tn_field){0};
}

tn_field_grid tn_field_grid_of(const tn_field *field, uint32_t samples)
{
    const tn_surface_record *r = field->record;
    tn_field_grid grid = {{r->low_x, r->low_y, r->low_z}, {r->high_x, r->high_y, r->high_z}, {0}};
    double longest = 0;
    samples = samples ? samples : r->grid;
    for (int axis = 0; axis < 3; axis++)
        longest = fmax(longest, grid.high[axis] - grid.low[axis]);
    for (int axis = 0; axis < 3; axis++) {
        double cells = round((grid.high[axis] - grid.low[axis]) / (longest / (samples - 1)));
        grid.count[axis] = cells < 2 ? 3 : (uint32_t)cells + 1; /* some between the faces, where all may be outside */
    }
    return grid;
}

/* ---- rows */

tn_status tn_field_runner_new(const tn_field *field, const tn_tape *tape, bool interpret, tn_field_runner *runner,
                              tn_error *error)
{
    *runner = (tn_field_runner){.field = field, .tape = tape, .interpret = interpret};
    tn_status status = tn_tape_rows_new(tape, &runner->rows, error);
    if (status != TN_OK || !interpret)
        return status;
    runner->kept = calloc(field->kept + 1, sizeof *runner->kept);
    runner->values = calloc(TN_ROW, sizeof *runner->values);
    return runner->kept && runner->values ? TN_OK : tn_fail_memory(error);
}

void tn_field_runner_clear(tn_field_runner *runner)
{
    tn_tape_rows_clear(&runner->rows);
    free(runner->kept);
    free(runner->values);
    *runner = (tn_field_runner){0};
}

void tn_field_prepare(tn_field_runner *runner)
{
    if (!runner->interpret)
        tn_tape_run(runner->tape, 0, &runner->field->distances, &runner->rows);
}

const double *tn_field_run(tn_field_runner *runner)
{
    const tn_field *field = runner->field;
    double *const *p = runner->rows.coordinates;
    if (!runner->interpret)
        return tn_tape_run(runner->tape, 1, &field->distances, &runner->rows);
    for (size_t i = 0; i < TN_ROW; i++)
        runner->values[i] = tn_number_run_at(field->module->code, field->code, (double[]){p[0][i], p[1][i], p[2][i]},
                                             &field->distances, runner->kept);
    return runner->values;
}
