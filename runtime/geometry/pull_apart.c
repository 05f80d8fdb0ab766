/* Moves vertices that share a place apart, for files that tell vertices by their places only. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/mesh.h"

typedef struct placed {
    double at[3];
    uint32_t vertex;
} placed;

static int by_place(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->at[k] != q->at[k])
            return p->at[k] < q->at[k] ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

static bool same_place(const placed *p, const placed *q)
{
    return p->at[0] == q->at[0] && p->at[1] == q->at[1] && p->at[2] == q->at[2];
}

static double diagonal_of(const tn_mesh *mesh)
{
    double square = 0;
    for (size_t k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t v = 0; v < mesh->vertex_count; v++) {
            low = fmin(low, mesh->positions[3 * v + k]);
            high = fmax(high, mesh->positions[3 * v + k]);
        }
        square += mesh->vertex_count ? (high - low) * (high - low) : 0;
    }
    return sqrt(square);
}

tn_status tn_mesh_pull_apart(tn_mesh *mesh, double share, size_t *moved, tn_error *error)
{
    size_t count = mesh->vertex_count;
    double *normals, by = share * diagonal_of(mesh);
    placed *all = malloc((count + 1) * sizeof *all);
    *moved = 0;
    if (!all)
        return tn_fail_memory(error);
    tn_status status = tn_mesh_normals(mesh, &normals, error);
    if (status != TN_OK) {
        free(all);
        return status;
    }
    for (size_t v = 0; v < count; v++) {
        memcpy(all[v].at, mesh->positions + 3 * v, sizeof all[v].at);
        all[v].vertex = (uint32_t)v;
    }
    qsort(all, count, sizeof *all, by_place);
    for (size_t i = 0; i < count; i++) {
        if (!(i > 0 && same_place(&all[i], &all[i - 1])) && !(i + 1 < count && same_place(&all[i], &all[i + 1])))
            continue;
        for (size_t k = 0; k < 3; k++)
            mesh->positions[3 * (size_t)all[i].vertex + k] -= by * normals[3 * (size_t)all[i].vertex + k];
        ++*moved;
    }
    free(normals);
    free(all);
    return TN_OK;
}
