/* Pairs the edges of triangles that have the same two vertices, by sorting. */
#include "runtime/geometry/twin.h"

#include <stdlib.h>

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

static void pair_sides(const side *sides, size_t count, uint32_t *twins)
{
    for (size_t i = 0; i + 1 < count; i++) {
        if (sides[i].low != sides[i + 1].low || sides[i].high != sides[i + 1].high)
            continue;
        twins[sides[i].corner] = sides[i + 1].corner;
        twins[sides[i + 1].corner] = sides[i].corner;
        i++;
    }
}

uint32_t *tn_mesh_twins(const tn_mesh *mesh)
{
    size_t count = 3 * mesh->face_count;
    side *sides = malloc((count + 1) * sizeof *sides);
    uint32_t *twins = malloc((count + 1) * sizeof *twins);
    if (!sides || !twins) {
        free(sides);
        free(twins);
        return NULL;
    }
    for (size_t c = 0; c < count; c++) {
        uint32_t a = mesh->corners[c], b = mesh->corners[c % 3 == 2 ? c - 2 : c + 1];
        sides[c] = (side){a < b ? a : b, a < b ? b : a, (uint32_t)c};
        twins[c] = TN_NO_TWIN;
    }
    qsort(sides, count, sizeof *sides, by_edge);
    pair_sides(sides, count, twins);
    free(sides);
    return twins;
}
