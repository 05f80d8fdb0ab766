/* Reads a surface of a module with its meshes, evaluates it at rows of places, and finds normals and the volume inside.
 */
#include "runtime/field/field.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/module/engine.h"
#include "runtime/module/verify.h"

/* ==== reads a surface of a module, and evaluates it at rows of places */

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

/* ==== reads the meshes that fields measure distances from */

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

/* ==== finds the normals of a field's mesh by differentiation */

#define LEAST 1e-9      /* of the median: there the gradient is rounding (docs/field-language.md) */
#define ON_SURFACE 0.01 /* of the spacing: how far from the surface a vertex may be */

static int compare(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* sizes: of the gradients; those that are no number count as 0. They are sorted. */
static double median_of(double *sizes, size_t count)
{
    qsort(sizes, count, sizeof *sizes, compare);
    return count ? sizes[count / 2] : 0;
}

double tn_field_slope(const tn_field *field, const double *vertex, double spacing, double *registers,
                      double gradient[3])
{
    double value = tn_tape_gradient(&field->samples, vertex, &field->distances, registers, gradient);
    double size = sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
    return size > 0 && size < INFINITY && fabs(value) <= ON_SURFACE * spacing * size ? size : 0;
}

tn_status tn_field_normals(const tn_field *field, const tn_mesh *mesh, double spacing, double **normals,
                           tn_error *error)
{
    size_t count = mesh->vertex_count;
    tn_status status = tn_mesh_normals(mesh, normals, error);
    if (status != TN_OK)
        return status;
    double *registers = calloc(4 * (size_t)field->samples.register_count, sizeof *registers);
    double *sizes = malloc((count + 1) * sizeof *sizes), *sorted = malloc((count + 1) * sizeof *sorted);
    double(*gradients)[3] = malloc((count + 1) * sizeof *gradients);
    bool room = registers && sizes && sorted && gradients;
    for (size_t v = 0; room && v < count; v++)
        sizes[v] = sorted[v] = tn_field_slope(field, mesh->positions + 3 * v, spacing, registers, gradients[v]);
    double least = room ? LEAST * median_of(sorted, count) : 0;
    for (size_t v = 0; room && v < count; v++)
        for (int axis = 0; axis < 3 && sizes[v] > least; axis++)
            (*normals)[3 * v + (size_t)axis] = gradients[v][axis] / sizes[v];
    free(registers);
    free(sizes);
    free(sorted);
    free(gradients);
    if (room)
        return TN_OK;
    free(*normals);
    *normals = NULL;
    return tn_fail_memory(error);
}

/* ==== bounds the volume inside a field by halving its box */

#define LEVELS_MAX 10u

typedef struct halving {
    const tn_field *field;
    const tn_field_grid *grid;
    tn_interval *registers;
    unsigned levels;
    tn_field_volume sum;
} halving;

/* One of 2^levels + 1 places along an axis: blocks that meet have the same. */
static double place(const halving *h, int axis, uint32_t at)
{
    double parts = (double)(1u << h->levels);
    return (h->grid->low[axis] * (parts - at) + h->grid->high[axis] * at) / parts;
}

static double down(double x)
{
    return nextafter(x, -INFINITY);
}

static double up(double x)
{
    return nextafter(x, INFINITY);
}

static void add(halving *h, const double low[3], const double high[3], bool proven)
{
    double least = 1, most = 1;
    for (int k = 0; k < 3; k++) {
        least = down(least * fmax(down(high[k] - low[k]), 0));
        most = up(most * up(high[k] - low[k]));
    }
    if (proven)
        h->sum.low = down(h->sum.low + fmax(least, 0));
    h->sum.high = up(h->sum.high + most);
}

/* A block of `size` finest parts a side. */
static void halve(halving *h, const uint32_t at[3], uint32_t size)
{
    double low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = place(h, k, at[k]);
        high[k] = place(h, k, at[k] + size);
    }
    tn_interval f = tn_tape_bounds(&h->field->samples, low, high, &h->field->distances, h->registers);
    if (tn_interval_is_none(f) || f.low >= 0)
        return; /* what has no value is outside */
    bool inside = f.high < 0 && !f.fails;
    if (inside || size == 1) {
        add(h, low, high, inside);
        return;
    }
    for (uint32_t part = 0; part < 8; part++) {
        uint32_t half = size / 2;
        halve(h,
              (uint32_t[]){at[0] + (part & 1 ? half : 0), at[1] + (part & 2 ? half : 0), at[2] + (part & 4 ? half : 0)},
              half);
    }
}

tn_status tn_field_volume_bounds(const tn_field *field, const tn_field_grid *grid, tn_field_volume *volume,
                                 tn_error *error)
{
    halving h = {.field = field, .grid = grid};
    uint32_t most = 0;
    for (int k = 0; k < 3; k++)
        most = grid->count[k] > most ? grid->count[k] : most;
    while (h.levels < LEVELS_MAX && (1u << h.levels) < most - 1)
        h.levels++;
    h.registers = calloc(field->samples.register_count + 1u, sizeof *h.registers);
    if (!h.registers)
        return tn_fail_memory(error);
    halve(&h, (uint32_t[]){0, 0, 0}, 1u << h.levels);
    free(h.registers);
    *volume = (tn_field_volume){fmax(h.sum.low, 0), h.sum.high};
    return TN_OK;
}

/* ==== says what of a module belongs to fields, and verifies it */

static const tn_section sections[] = {TN_SECTION_SURFACE, TN_SECTION_DISTANCE_MESH, TN_SECTION_STRINGS};

static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->SURFACE_count; i++) {
        const tn_surface_record *r = &module->SURFACE_records[i];
        if (module->FUNCTION_records[r->function].kind != TN_FUNCTION_FIELD)
            return tn_refuse(checker, "the function of surface %zu is not a field", i);
        if (!(r->low_x < r->high_x && r->low_y < r->high_y && r->low_z < r->high_z))
            return tn_refuse(checker, "the box of surface %zu has no inside", i);
    }
    return TN_OK;
}

extern const tn_engine tn_engine_field;
const tn_engine tn_engine_field = {.name = "field", .sections = sections, .verify = verify};
