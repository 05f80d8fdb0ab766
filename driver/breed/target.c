/* Counts how much of a field's inside is inside a mesh too. */
#include "driver/breed/target.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/boundary_file.h"
#include "runtime/mesh/openmesh.h"

struct tn_target {
    tn_boundary_mesh *mesh;
    pthread_mutex_t lock;
    tn_field_grid grid; /* that the samples are of */
    uint8_t *inside;    /* [sample]; NULL before the first field */
};

void tn_target_free(tn_target *t)
{
    if (!t)
        return;
    tn_boundary_mesh_free(t->mesh);
    pthread_mutex_destroy(&t->lock);
    free(t->inside);
    free(t);
}

tn_status tn_target_read(const char *path, tn_target **target, tn_error *error)
{
    tn_target *t = calloc(1, sizeof *t);
    tn_error why = {0};
    *target = NULL;
    if (!t)
        return tn_fail_memory(error);
    pthread_mutex_init(&t->lock, NULL);
    tn_status status = tn_boundary_mesh_find(&tn_openmesh_reader, "", "", path, "target", "study", &t->mesh, &why);
    if (status == TN_OK && !tn_boundary_mesh_is_solid(t->mesh))
        status = tn_fail(&why, TN_INVALID, E_FIELD_GOAL, "it has edges without two faces, and so no inside");
    if (status == TN_OK) {
        *target = t;
        return TN_OK;
    }
    tn_target_free(t);
    if (status == TN_MEMORY)
        return tn_fail_memory(error);
    tn_fail(error, status, E_FIELD_GOAL, "forms cannot be likened to %.200s: %.250s", path, why.message);
    tn_error_help(error, "name a closed mesh, as `tartan mesh` writes them");
    return status;
}

static size_t sample_count(const tn_field_grid *grid)
{
    return (size_t)grid->count[0] * grid->count[1] * grid->count[2];
}

/* Once: all fields of a run have one grid. */
static tn_status sample_target(tn_target *t, const tn_field_grid *grid, tn_error *error)
{
    uint8_t *inside = malloc(sample_count(grid));
    size_t at = 0;
    if (!inside)
        return tn_fail_memory(error);
    for (uint32_t z = 0; z < grid->count[2]; z++)
        for (uint32_t y = 0; y < grid->count[1]; y++)
            for (uint32_t x = 0; x < grid->count[0]; x++) {
                tn_vector place = {tn_field_sample(grid, 0, x), tn_field_sample(grid, 1, y),
                                   tn_field_sample(grid, 2, z)};
                inside[at++] = tn_boundary_mesh_distance(t->mesh, place, NULL) < 0;
            }
    t->grid = *grid;
    t->inside = inside;
    return TN_OK;
}

/* Counts the samples of a row along x: those in both, and those in either. */
static void count_row(const tn_target *t, tn_field_runner *runner, const uint32_t at[2], size_t *both, size_t *either)
{
    const tn_field_grid *grid = &t->grid;
    const uint8_t *inside = t->inside + ((size_t)at[1] * grid->count[1] + at[0]) * grid->count[0];
    double *const *rows = runner->rows.coordinates;
    for (uint32_t begin = 0; begin < grid->count[0]; begin += TN_ROW) {
        uint32_t size = grid->count[0] - begin < TN_ROW ? grid->count[0] - begin : TN_ROW;
        for (uint32_t i = 0; i < TN_ROW; i++) {
            rows[0][i] = tn_field_sample(grid, 0, begin + (i < size ? i : size - 1));
            rows[1][i] = tn_field_sample(grid, 1, at[0]);
            rows[2][i] = tn_field_sample(grid, 2, at[1]);
        }
        tn_field_prepare(runner);
        const double *values = tn_field_run(runner);
        for (uint32_t i = 0; i < size; i++) {
            bool in = values[i] < 0;
            *both += in && inside[begin + i];
            *either += in || inside[begin + i];
        }
    }
}

tn_status tn_target_likeness(tn_target *t, const tn_field *field, double *likeness, tn_error *error)
{
    tn_field_grid grid = tn_field_grid_of(field, 0);
    tn_field_runner runner = {0};
    size_t both = 0, either = 0;
    pthread_mutex_lock(&t->lock);
    tn_status status = t->inside ? TN_OK : sample_target(t, &grid, error);
    pthread_mutex_unlock(&t->lock);
    if (status == TN_OK)
        status = tn_field_runner_new(field, &field->samples, false, &runner, error);
    uint32_t at[2];
    for (at[1] = 0; status == TN_OK && at[1] < grid.count[2]; at[1]++)
        for (at[0] = 0; at[0] < grid.count[1]; at[0]++)
            count_row(t, &runner, at, &both, &either);
    tn_field_runner_clear(&runner);
    *likeness = status == TN_OK && either ? (double)both / (double)either : 0;
    return status;
}
