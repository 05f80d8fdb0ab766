/* Meshes a field: signs of samples, vertices on edges, triangles of cells. */
#include "runtime/field/contour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/watch.h"
#include "runtime/field/contour_parts.h"

void tn_contour_clear(tn_contour *contour)
{
    tn_mesh_clear(&contour->mesh);
    *contour = (tn_contour){0};
}

static tn_status check_size(const tn_field_grid *grid, const tn_contour_options *options, tn_error *error)
{
    uint64_t most = options->samples ? options->samples : TN_SAMPLES_MAX;
    uint64_t samples = (uint64_t)grid->count[0] * grid->count[1] * grid->count[2];
    if (samples <= most)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_FIELD_SAMPLES, "the grid has %u x %u x %u = %llu samples; the limit is %llu",
            grid->count[0], grid->count[1], grid->count[2], (unsigned long long)samples, (unsigned long long)most);
    tn_error_help(error, "take a coarser --grid, or raise --max-samples");
    return TN_LIMIT;
}

tn_status tn_contouring_begin(tn_contouring *c, const double *z, tn_error *error)
{
    const uint32_t *n = c->grid->count;
    tn_status status = check_size(c->grid, c->options, error);
    if (status != TN_OK)
        return status;
    c->threads = c->options->threads ? c->options->threads : tn_crew_default();
    c->crew = tn_crew_new(c->threads, c->field->module->watch);
    c->words = (n[0] + 63) / 64;
    c->signs = calloc(tn_size_of((size_t)n[1] * n[2], c->words), sizeof *c->signs);
    c->first = calloc((size_t)n[1] * n[2], sizeof *c->first);
    c->layer_jumps = calloc(n[2], sizeof *c->layer_jumps);
    c->layer_moved = calloc(n[2], sizeof *c->layer_moved);
    for (int axis = 0; axis < 3; axis++) {
        c->places[axis] = malloc(n[axis] * sizeof *c->places[axis]);
        for (uint32_t i = 0; c->places[axis] && i < n[axis]; i++)
            c->places[axis][i] = axis == 2 && z ? z[i] : tn_field_sample(c->grid, axis, i);
    }
    bool room = c->crew && c->signs && c->first && c->layer_jumps && c->layer_moved && c->places[0] && c->places[1] &&
                c->places[2];
    return room ? TN_OK : tn_fail_memory(error);
}

void tn_contouring_free(tn_contouring *c)
{
    if (c->crew)
        tn_crew_free(c->crew);
    for (int axis = 0; axis < 3; axis++)
        free(c->places[axis]);
    free(c->signs);
    free(c->first);
    free(c->layer_jumps);
    free(c->layer_moved);
    free(c->jumping);
}

void tn_contouring_count(const tn_contouring *c)
{
    for (uint32_t z = 0; z < c->grid->count[2]; z++) {
        c->out->jumps += c->layer_jumps[z];
        c->out->moved += c->layer_moved[z];
    }
    for (uint64_t v = 0; c->out->jumps && v < c->vertex_count; v++)
        if (c->jumping[v / 64] >> (v % 64) & 1) {
            for (int axis = 0; axis < 3; axis++)
                c->out->jump[axis] = c->out->mesh.positions[3 * v + (uint64_t)axis];
            return;
        }
}

/* Leaves out the vertices that no triangle has any more; the others keep their order. */
static tn_status drop_unused(tn_mesh *mesh, tn_error *error)
{
    uint32_t *number = calloc(mesh->vertex_count + 1, sizeof *number), count = 0;
    if (!number)
        return tn_fail_memory(error);
    for (size_t i = 0; i < 3 * mesh->face_count; i++)
        number[mesh->corners[i]] = 1;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        if (!number[v])
            continue;
        memmove(mesh->positions + 3 * (size_t)count, mesh->positions + 3 * v, 3 * sizeof *mesh->positions);
        number[v] = count++;
    }
    for (size_t i = 0; i < 3 * mesh->face_count; i++)
        mesh->corners[i] = number[mesh->corners[i]];
    mesh->vertex_count = count;
    free(number);
    return TN_OK;
}

tn_status tn_contour_new(const tn_field *field, const tn_field_grid *grid, const tn_contour_options *options,
                         tn_contour *contour, tn_error *error)
{
    static tn_status (*const stages[])(tn_contouring *, tn_error *) = {tn_contour_signs, tn_contour_roots,
                                                                       tn_contour_cells, tn_contour_sharp_cells};
    *contour = (tn_contour){.mesh.watch = field->module->watch};
    for (int axis = 0; axis < 3; axis++)
        contour->spacing = fmax(contour->spacing, (grid->high[axis] - grid->low[axis]) / (grid->count[axis] - 1));
    tn_contouring c = {.field = field, .grid = grid, .options = options, .out = contour};
    tn_status status = tn_contouring_begin(&c, NULL, error);
    for (int i = 0; i < 3 && status == TN_OK; i += i == 0 && options->survey ? 2 : 1) {
        double begun = tn_seconds();
        status = stages[i == 2 && options->sharp ? 3 : i](&c, error);
        if (status == TN_OK && i == 0 && options->between)
            status = tn_contour_missed(&c, error);
        contour->seconds[i] = tn_seconds() - begun;
    }
    if (status == TN_OK)
        tn_contouring_count(&c);
    if (status == TN_OK && options->jumps_open)
        status = drop_unused(&contour->mesh, error);
    tn_contouring_free(&c);
    return status;
}
