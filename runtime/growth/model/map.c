/* Keeps the half-edge map of a surface. */
#include "runtime/growth/model/map.h"

#include <stdlib.h>

tn_status tn_map_twins(const tn_map *map, uint32_t **darts, uint32_t **faces, tn_error *error)
{
    size_t sides = 2 * (size_t)map->edge_count;
    uint32_t *dart = darts ? malloc(sides * sizeof *dart) : NULL;
    uint32_t *face = faces ? malloc(sides * sizeof *face) : NULL;
    if ((darts && !dart) || (faces && !face)) {
        free(dart);
        free(face);
        return tn_fail_memory(error);
    }
    for (uint32_t f = 0; f < map->face_count; f++) {
        for (uint32_t d = map->face_first[f]; d < map->face_first[f + 1]; d++) {
            if (dart)
                dart[map->side[d]] = d;
            if (face)
                face[map->side[d]] = f;
        }
    }
    if (darts)
        *darts = dart;
    if (faces)
        *faces = face;
    return TN_OK;
}
