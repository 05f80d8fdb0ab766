/* Lists guides. */
#include "runtime/geometry/guide/guide.h"

#include "runtime/base/array.h"

bool tn_guides_add(tn_guides *g, tn_guide guide, const tn_vector *points, size_t count)
{
    if (!tn_array_reserve(&g->points, &g->point_capacity, g->point_count, count, sizeof *g->points) ||
        !tn_array_reserve(&g->items, &g->capacity, g->count, 1, sizeof *g->items))
        return false;
    guide.first = (uint32_t)g->point_count;
    guide.count = (uint32_t)count;
    for (size_t i = 0; i < count; i++)
        tn_vector_put(g->points[g->point_count++], points[i]);
    g->items[g->count++] = guide;
    return true;
}

void tn_guides_clear(tn_guides *g)
{
    free(g->points);
    free(g->items);
    *g = (tn_guides){0};
}
