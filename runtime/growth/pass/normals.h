/* Unit normals of faces, many at once (internal to the growth engine). */
#ifndef TARTAN_GROWTH_PASS_NORMALS_H
#define TARTAN_GROWTH_PASS_NORMALS_H

#include "runtime/growth/model/map.h"
#include "runtime/growth/pass/rows.h"

/* Faces of one size that wait until they are many. */
typedef struct tn_normals {
    const tn_map *map;
    double *normals;                       /* [face][3] where they go */
    uint32_t faces[TN_ROW], darts[TN_ROW]; /* each one's first dart */
    uint32_t count, size;
    tn_row first[3], before[3], point[3], sum[3], span;
} tn_normals;

/* Normals of this map's faces go to normals[3 * face]. */
void tn_normals_start(tn_normals *normals, const tn_map *map, double *result);

/* The normal of an interior face, now or later; */
void tn_normals_add(tn_normals *normals, uint32_t face);

/* and of all that wait. */
void tn_normals_finish(tn_normals *normals);

#endif
