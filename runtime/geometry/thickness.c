/* Measures walls by shooting inward from each triangle. */
#include "runtime/geometry/thickness.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/boundary_mesh.h"

#define SHARE 0.01 /* of the area, that may be thinner */

typedef struct wall {
    double thickness, area;
} wall;

static int thinner(const void *left, const void *right)
{
    const wall *a = left, *b = right;
    return a->thickness < b->thickness ? -1 : a->thickness > b->thickness;
}

static double diagonal(const tn_mesh *mesh)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, sum = 0;
    for (size_t v = 0; v < 3 * mesh->vertex_count; v++) {
        low[v % 3] = fmin(low[v % 3], mesh->positions[v]);
        high[v % 3] = fmax(high[v % 3], mesh->positions[v]);
    }
    for (int k = 0; k < 3; k++)
        sum += (high[k] - low[k]) * (high[k] - low[k]);
    return sqrt(sum);
}

/* From just behind the triangle's middle to the first triangle that is met from inside. */
static wall measure(const tn_mesh *mesh, const tn_boundary_mesh *boundary, uint32_t triangle, double reach)
{
    tn_vector a = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * triangle]),
              b = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * triangle + 1]),
              c = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * triangle + 2]);
    tn_vector normal = tn_cross(tn_sub(b, a), tn_sub(c, a));
    double length = tn_norm(normal);
    wall w = {INFINITY, length / 2};
    if (!(length > 0))
        return w;
    tn_vector middle = tn_scale(tn_add(tn_add(a, b), c), 1.0 / 3);
    tn_vector inward = tn_scale(normal, -reach / length);
    tn_vector start = tn_add(middle, tn_scale(inward, 1e-9));
    tn_mesh_hit hit;
    if (tn_boundary_mesh_hit(boundary, true, start, inward, TN_NO_TRIANGLE, &hit))
        w.thickness = (hit.t + 1e-9) * reach;
    return w;
}

static double hundredth_of(const wall *walls, size_t count)
{
    double total = 0, thinner_area = 0;
    for (size_t i = 0; i < count; i++)
        total += walls[i].area;
    for (size_t i = 0; i < count; i++) {
        thinner_area += walls[i].area;
        if (thinner_area >= SHARE * total)
            return walls[i].thickness;
    }
    return 0;
}

tn_status tn_mesh_thickness(const tn_mesh *mesh, tn_thickness *thickness, tn_error *error)
{
    tn_boundary_mesh *boundary = NULL;
    *thickness = (tn_thickness){0, 0};
    if (mesh->face_count == 0)
        return TN_OK;
    wall *walls = malloc(mesh->face_count * sizeof *walls);
    tn_status status = walls ? tn_boundary_mesh_new(mesh->positions, mesh->vertex_count, mesh->corners,
                                                    mesh->face_count, &boundary, error)
                             : tn_fail_memory(error);
    double reach = 2 * diagonal(mesh);
    for (size_t i = 0; i < mesh->face_count && status == TN_OK; i++)
        walls[i] = measure(mesh, boundary, (uint32_t)i, reach);
    if (status == TN_OK) {
        qsort(walls, mesh->face_count, sizeof *walls, thinner);
        *thickness = (tn_thickness){walls[0].thickness, hundredth_of(walls, mesh->face_count)};
    }
    tn_boundary_mesh_free(boundary);
    free(walls);
    return status;
}
