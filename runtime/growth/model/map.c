/* Keeps the half-edge map of a surface, and checks that it is whole. */
#include "runtime/growth/model/map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- keeps the half-edge map of a surface */

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

/* ---- checks that a map is whole: that its darts, edges and vertices agree */

#define BROKEN(...) tn_fail(error, TN_INTERNAL, 0, __VA_ARGS__)

typedef struct findings {
    uint32_t *dart;   /* [side] */
    uint32_t *mark;   /* [vertex] the last face that met it, plus one */
    uint32_t *parent; /* [vertex] for finding connected parts */
} findings;

static tn_status check_faces(const tn_map *map, findings *check, tn_error *error)
{
    memset(check->dart, 0xff, 2 * (size_t)map->edge_count * sizeof *check->dart);
    memset(check->mark, 0, map->vertex_count * sizeof *check->mark);
    size_t darts = 0;
    for (uint32_t f = 0; f < map->face_count; f++) {
        uint32_t first = map->face_first[f], size = tn_face_size(map, f);
        if (map->face_first[f + 1] < first || map->face_first[f + 1] > 2 * (size_t)map->edge_count)
            return BROKEN("face %u lies outside the darts", f);
        if (size < 3)
            return BROKEN("face %u has %u edges", f, size);
        darts += size;
        for (uint32_t d = first; d < first + size; d++) {
            if (map->origin[d] >= map->vertex_count || map->side[d] / 2 >= map->edge_count)
                return BROKEN("dart %u has no vertex or no edge", d);
            if (check->dart[map->side[d]] != UINT32_MAX)
                return BROKEN("side %u of edge %u is used twice", map->side[d] & 1, map->side[d] / 2);
            check->dart[map->side[d]] = d;
            if (check->mark[map->origin[d]] == f + 1)
                return BROKEN("face %u meets vertex %u twice", f, map->origin[d]);
            check->mark[map->origin[d]] = f + 1;
        }
    }
    if (darts != 2 * (size_t)map->edge_count)
        return BROKEN("%zu darts for %u edges", darts, map->edge_count);
    return TN_OK;
}

static uint32_t root(findings *check, uint32_t v)
{
    while (check->parent[v] != v) {
        check->parent[v] = check->parent[check->parent[v]];
        v = check->parent[v];
    }
    return v;
}

/* The far end of each dart is where its twin starts; all vertices hang together. */
static tn_status check_edges(const tn_map *map, findings *check, tn_error *error)
{
    uint32_t parts = map->vertex_count;
    for (uint32_t v = 0; v < map->vertex_count; v++) {
        if (check->mark[v] == 0)
            return BROKEN("vertex %u is on no face", v);
        check->parent[v] = v;
    }
    for (uint32_t f = 0; f < map->face_count; f++) {
        uint32_t first = map->face_first[f], size = tn_face_size(map, f);
        for (uint32_t i = 0; i < size; i++) {
            uint32_t d = first + i, to = map->origin[first + (i + 1) % size];
            uint32_t twin = check->dart[map->side[d] ^ 1];
            if (twin == UINT32_MAX)
                return BROKEN("edge %u has one side only", map->side[d] / 2);
            if (map->origin[twin] != to)
                return BROKEN("edge %u ends at vertex %u on one side and %u on the other", map->side[d] / 2, to,
                              map->origin[twin]);
            uint32_t a = root(check, map->origin[d]), b = root(check, to);
            parts -= a != b;
            check->parent[a] = b;
        }
    }
    if (parts != 1)
        return BROKEN("the map falls into %u parts", parts);
    return TN_OK;
}

tn_status tn_map_validate(const tn_map *map, tn_error *error)
{
    findings check = {malloc(2 * (size_t)map->edge_count * sizeof(uint32_t)),
                      malloc(map->vertex_count * sizeof(uint32_t)), malloc(map->vertex_count * sizeof(uint32_t))};
    tn_status status =
        check.dart && check.mark && check.parent ? check_faces(map, &check, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = check_edges(map, &check, error);
    free(check.dart);
    free(check.mark);
    free(check.parent);
    if (status != TN_OK)
        return status;
    if ((int64_t)map->vertex_count - map->edge_count + map->face_count != 2)
        return BROKEN("Euler's number is %lld, not 2",
                      (long long)map->vertex_count - map->edge_count + map->face_count);
    for (size_t i = 0; i < 3 * (size_t)map->vertex_count; i++)
        if (!isfinite(map->positions[i]))
            return BROKEN("vertex %zu is not at a finite place", i / 3);
    return TN_OK;
}
