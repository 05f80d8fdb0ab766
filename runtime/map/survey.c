#include "runtime/map/pass.h"
#include "runtime/map/share.h"

#define AHEAD 48u  /* darts */
#define FLAT 1e-12 /* of the squares of a face's extent */

/* Newell's normal of a loop, unit. Points are taken relative to the first, so that a face far from the origin keeps its
 * precision. */
static tn_vector face_normal(const tn_map *map, uint32_t face)
{
    const uint32_t *origin = map->origin + map->face_first[face];
    uint32_t size = tn_face_size(map, face);
    tn_vector first = tn_vector_at(map->positions + 3 * (size_t)origin[0]), n = {0, 0, 0};
    tn_vector before = {0, 0, 0};
    double span = 0;
    for (uint32_t i = 1; i < size; i++) {
        tn_vector p = tn_sub(tn_vector_at(map->positions + 3 * (size_t)origin[i]), first);
        n = tn_add(n, tn_cross(before, p));
        span += tn_dot(p, p);
        before = p;
    }
    /* A face that is flat to rounding has no normal, rather than one that rounding chose. */
    return tn_dot(n, n) > FLAT * FLAT * span * span ? tn_normalised(n) : (tn_vector){0, 0, 0};
}

/* What some darts further on will need lies all over memory: asked for now, it is there in time. */
static inline __attribute__((always_inline)) void prefetch(const tn_pass *pass, uint32_t dart)
{
    __builtin_prefetch(pass->old->positions + 3 * (size_t)pass->old->origin[dart]);
    __builtin_prefetch(pass->sides + pass->old->side[dart], 1);
}

static void survey_face(tn_pass *pass, uint32_t face)
{
    const tn_map *map = pass->old;
    uint32_t darts = 2 * map->edge_count;
    for (uint32_t d = map->face_first[face]; d < map->face_first[face + 1]; d++) {
        uint32_t side = map->side[d];
        if (d + AHEAD < darts)
            prefetch(pass, d + AHEAD);
        pass->sides[side] = (tn_edge_side){map->origin[d], face};
        if (pass->dart)
            pass->dart[side] = d;
    }
    tn_vector n = {0, 0, 0};
    if (face != TN_OUTER_FACE)
        n = face_normal(map, face);
    tn_vector_put(pass->normal + 3 * (size_t)face, n);
}

static void survey_chunk(void *context, uint32_t chunk)
{
    tn_pass *pass = context;
    uint32_t faces = pass->old->face_count, begin = chunk * TN_CHUNK_FACES;
    uint32_t end = faces - begin < TN_CHUNK_FACES ? faces : begin + TN_CHUNK_FACES;
    for (uint32_t f = begin; f < end; f++)
        survey_face(pass, f);
}

tn_status tn_pass_survey(tn_pass *pass, tn_error *error)
{
    const tn_map *map = pass->old;
    size_t sides = 2 * (size_t)map->edge_count, normals = 3 * (size_t)map->face_count;
    tn_pages *space = &pass->growth->space.survey;
    size_t darts = pass->walks_vertices ? sides * sizeof *pass->dart : 0;
    if (!tn_pages_reserve(space, normals * sizeof *pass->normal + sides * sizeof *pass->sides + darts))
        return tn_fail_memory(error);
    pass->normal = space->data;
    pass->sides = (tn_edge_side *)(pass->normal + normals);
    if (pass->walks_vertices)
        pass->dart = (uint32_t *)(pass->sides + sides);
    tn_share(pass->threads, (map->face_count + TN_CHUNK_FACES - 1) / TN_CHUNK_FACES, TN_SHARE_EVENLY, survey_chunk,
             pass);
    return TN_OK;
}
