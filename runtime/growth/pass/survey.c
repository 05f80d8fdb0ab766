/* Surveys a map before a pass: each edge side's vertex and face, each face's normal. */
#include "runtime/growth/pass/normals.h"
#include "runtime/growth/pass/pass.h"

#define AHEAD 80u /* darts */
/* What the darts that are AHEAD of first .. end will need lies all over memory: asked for now, it is there in time.
 * Always inlined: a call that only asks is taken for one without effect. */
static inline __attribute__((always_inline)) void ask_ahead(const tn_map *map, const tn_edge_side *sides,
                                                            uint32_t first, uint32_t end)
{
    if (2 * map->edge_count - end < AHEAD)
        return;
    for (size_t d = (size_t)first + AHEAD; d < (size_t)end + AHEAD; d++) {
        __builtin_prefetch(map->positions + 3 * (size_t)map->origin[d]);
        __builtin_prefetch(sides + map->side[d], 1);
    }
}

/* Where the faces begin .. end - 1 have their darts. `sides` and `darts` are nobody else's, so that nothing has to be
 * read twice. */
static void note_sides(const tn_map *map, uint32_t begin, uint32_t end, tn_edge_side *restrict sides,
                       uint32_t *restrict darts)
{
    const uint32_t *first = map->face_first, *origin = map->origin, *side = map->side;
    for (uint32_t f = begin; f < end; f++) {
        ask_ahead(map, sides, first[f], first[f + 1]);
        for (uint32_t d = first[f]; d < first[f + 1]; d++)
            sides[side[d]] = (tn_edge_side){origin[d], f};
        for (uint32_t d = first[f]; darts && d < first[f + 1]; d++)
            darts[side[d]] = d;
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
    for (uint32_t some = begin; some < end; some += TN_ROW) {
        uint32_t last = end - some < TN_ROW ? end : some + TN_ROW;
        note_sides(pass->old, some, last, pass->sides, pass->dart);
        for (uint32_t f = some == TN_OUTER_FACE ? 1 : some; f < last; f++)
            tn_normals_add(&normals, f);
    }
    tn_normals_finish(&normals);
}

bool tn_pass_reserve_aims(tn_pass *pass, uint64_t count)
{
    tn_growth_workspace *space = &pass->growth->space;
    uint64_t sides =
        (2 * (uint64_t)pass->old->edge_count + 7) & ~(uint64_t)7; /* so that no aim is in two cache lines */
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
    uint64_t normals = 3 * (uint64_t)map->face_count, darts = pass->walks_vertices ? 2 * (uint64_t)map->edge_count : 0;
    tn_pages *space = &pass->growth->space.survey;
    if (!tn_pass_reserve_aims(pass, 0) ||
        !tn_pages_reserve(space, normals * sizeof *pass->normal + darts * sizeof *pass->dart))
        return tn_fail_memory(error);
    pass->normal = space->data;
    if (pass->walks_vertices)
        pass->dart = (uint32_t *)(pass->normal + normals);
    uint32_t chunks = (map->face_count + TN_CHUNK_FACES - 1) / TN_CHUNK_FACES;
    return tn_crew_share(tn_pass_crew(pass), chunks, survey_chunk, pass, error);
}
