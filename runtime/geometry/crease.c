/* Finds the edges at which a mesh of triangles bends, or one group meets another. */
#include "runtime/geometry/crease.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/twin.h"

/* Triangles whose normals have a product above this lie in one plane: they are not exactly so after rounding. */
#define FLAT (1 - 1e-9)

static bool bends(const tn_mesh *mesh, uint32_t face, uint32_t other)
{
    double n[3], m[3];
    if (mesh->face_group && mesh->face_group[face] != mesh->face_group[other])
        return true;
    tn_mesh_face_normal(mesh, mesh->corners + 3 * (size_t)face, 3, n);
    tn_mesh_face_normal(mesh, mesh->corners + 3 * (size_t)other, 3, m);
    double lengths = sqrt((n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]));
    return !(n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > FLAT * lengths);
}

tn_status tn_mesh_creases(const tn_mesh *mesh, bool **creases, tn_error *error)
{
    size_t count = 3 * mesh->face_count;
    uint32_t *twins = tn_mesh_twins(mesh);
    *creases = malloc(count + 1);
    if (!twins || !*creases) {
        free(twins);
        free(*creases);
        *creases = NULL;
        return tn_fail_memory(error);
    }
    for (uint32_t c = 0; c < count; c++)
        (*creases)[c] = twins[c] == TN_NO_TWIN || bends(mesh, c / 3, twins[c] / 3);
    free(twins);
    return TN_OK;
}
