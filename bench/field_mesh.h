/* What the benchmarks of fields share. */
#ifndef TARTAN_BENCH_FIELD_MESH_H
#define TARTAN_BENCH_FIELD_MESH_H

#include "bench/bench.h"
#include "runtime/field/contour.h"

static inline int compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static inline double median(double *times, int count)
{
    qsort(times, (size_t)count, sizeof *times, compare);
    return times[count / 2];
}

/* Seconds by the clock from a surface's code to its mesh, and the mesh's triangles. */
static inline double mesh_once(const tn_module *module, uint32_t surface, uint32_t samples, unsigned threads,
                               clockid_t clock, size_t *faces)
{
    double begun = seconds(clock);
    tn_field field;
    tn_contour contour;
    tn_error error;
    tn_status status = tn_field_read(module, surface, NULL, &field, &error);
    if (status == TN_OK) {
        tn_field_grid grid = tn_field_grid_of(&field, samples);
        status = tn_contour_new(&field, &grid, &(tn_contour_options){.threads = threads}, &contour, &error);
    }
    if (status != TN_OK)
        stop(error.message);
    double took = seconds(clock) - begun;
    *faces = contour.mesh.face_count;
    tn_contour_clear(&contour);
    tn_field_clear(&field);
    return took;
}

#endif
