/* Finds the edges at which a mesh of triangles bends, or one group meets another. */
#include "runtime/geometry/crease.h"

#include <math.h>
#include <stdlib.h>

/* Triangles whose normals have a product above this lie in one plane: they are not exactly so after rounding. */
#define FLAT (1 - 1e-9)

typedef struct side {
    uint32_t low, high; /* vertices */
    uint32_t corner;
} side;

static int by_edge(const void *a, const void *b)
{
    const side *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->corner < y->corner ? -1 : x->corner > y->corner;
}

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
    side *sides = malloc((count + 1) * sizeof *sides);
    *creases = malloc(count + 1);
    if (!sides || !*creases) {
        free(sides);
        free(*creases);
        *creases = NULL;
        return tn_fail_memory(error);
    }
    for (size_t c = 0; c < count; c++) {
        uint32_t a = mesh->corners[c], b = mesh->corners[c % 3 == 2 ? c - 2 : c + 1];
        sides[c] = (side){a < b ? a : b, a < b ? b : a, (uint32_t)c};
        (*creases)[c] = true;
    }
    qsort(sides, count, sizeof *sides, by_edge);
    for (size_t i = 0; i + 1 < count; i++) {
        const side *one = &sides[i], *other = &sides[i + 1];
        if (one->low != other->low || one->high != other->high)
            continue;
        bool bent = bends(mesh, one->corner / 3, other->corner / 3);
        (*creases)[one->corner] = (*creases)[other->corner] = bent;
        i++;
    }
    free(sides);
    return TN_OK;
}
