#include "runtime/map/normals.h"
#include "runtime/map/pass.h"
#include "runtime/map/share.h"

#define AHEAD 48u /* darts */
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
}

static void survey_chunk(void *context, uint32_t chunk)
{
    tn_pass *pass = context;
    uint32_t faces = pass->old->face_count, begin = chunk * TN_CHUNK_FACES;
    uint32_t end = faces - begin < TN_CHUNK_FACES ? faces : begin + TN_CHUNK_FACES;
    tn_normals normals;
    tn_normals_start(&normals, pass->old, pass->normal);
    if (chunk == 0)
        tn_vector_put(pass->normal + 3 * TN_OUTER_FACE, (tn_vector){0, 0, 0});
    for (uint32_t f = begin; f < end; f++) {
        survey_face(pass, f);
        if (f != TN_OUTER_FACE)
            tn_normals_add(&normals, f);
    }
    tn_normals_finish(&normals);
}

bool tn_pass_reserve_aims(tn_pass *pass, size_t count)
{
    tn_workspace *space = &pass->growth->space;
    size_t sides = (2 * (size_t)pass->old->edge_count + 7) & ~(size_t)7; /* so that no aim is in two cache lines */
    tn_pages *pages = &space->darts[!space->current];
    if (!tn_pages_reserve(pages, sides * sizeof *pass->sides + count * sizeof *pass->aims))
        return false;
    pass->sides = pages->data;
    pass->aims = (tn_aim *)(pass->sides + sides);
    return true;
}

tn_status tn_pass_survey(tn_pass *pass, tn_error *error)
{
    const tn_map *map = pass->old;
    size_t normals = 3 * (size_t)map->face_count, darts = pass->walks_vertices ? 2 * (size_t)map->edge_count : 0;
    tn_pages *space = &pass->growth->space.survey;
    if (!tn_pass_reserve_aims(pass, 0) ||
        !tn_pages_reserve(space, normals * sizeof *pass->normal + darts * sizeof *pass->dart))
        return tn_fail_memory(error);
    pass->normal = space->data;
    if (pass->walks_vertices)
        pass->dart = (uint32_t *)(pass->normal + normals);
    tn_share(pass->threads, (map->face_count + TN_CHUNK_FACES - 1) / TN_CHUNK_FACES, TN_SHARE_EVENLY, survey_chunk,
             pass);
    return TN_OK;
}
