/* The new map written: each face's loops from its cut, every dart once, in its place. */
#include <string.h>

#include "runtime/growth/join/decide.h"
#include "runtime/growth/join/stamp_lanes.h"

/* Where the next of each goes. */
typedef struct place {
    uint32_t dart, face;
} place;

/* An edge's pieces in place of it. */
static void stamp_plain(const tn_pass *pass, uint32_t face, uint32_t *at)
{
    const tn_map *old = pass->old, *new = pass->new;
    for (uint32_t d = old->face_first[face]; d < old->face_first[face + 1]; d++) {
        uint32_t bases[TN_BASES], side = old->side[d];
        const tn_record *record = &pass->records[side / 2];
        tn_dart_bases(pass, d, bases);
        uint32_t vertex = bases[TN_BASE_ORIGIN];
        if (tn_is_kept(record)) {
            new->origin[*at] = vertex;
            new->side[(*at)++] = bases[TN_BASE_SIDE];
            continue;
        }
        const tn_template *template = pass->growth->shapes[record->template].template;
        uint32_t pieces = template->segment_count, against = side & 1;
        for (uint32_t i = 0; i < pieces; i++) {
            uint32_t piece = against ? pieces - 1 - i : i;
            new->origin[*at] = vertex;
            new->side[(*at)++] = bases[TN_BASE_SIDE] + 2 * piece + (template->segments[piece].reversed != against);
            vertex = bases[TN_BASE_VERTEX] + (against ? piece - 1 : piece);
        }
    }
}

static void stamp_references(const tn_pass *pass, uint32_t face, const tn_cuts *cuts, const tn_cut *cut, uint32_t dart)
{
    _Alignas(64) uint32_t bases[TN_PATTERN_DARTS * TN_BASES];
    uint32_t first = pass->old->face_first[face], size = tn_face_size(pass->old, face);
    const uint32_t *restrict origins = cuts->origins + cut->dart_first, *restrict sides = cuts->sides + cut->dart_first;
    uint32_t *restrict origin = pass->new->origin + dart, *restrict side = pass->new->side + dart;
    if (pass->has_lanes && size <= TN_LANES_DARTS) {
        tn_stamp_lanes(pass, first, size, origins, sides, cut->dart_count, origin, side, bases);
    } else {
        for (uint32_t i = 0; i < size; i++)
            tn_dart_bases(pass, first + i, bases + i * TN_BASES);
        for (size_t i = 0, count = cut->dart_count; i < count; i++) {
            origin[i] = tn_referred(bases, origins[i]);
            side[i] = tn_referred(bases, sides[i]);
        }
    }
    const tn_cut_join *join = cuts->joins + cut->join_first, *end = join + cut->join_count;
    for (; join < end; join++)
        tn_write_joint(pass, join, tn_referred(bases, join->one), tn_referred(bases, join->other), side);
}

static void stamp_single(const tn_pass *pass, const tn_cuts *cuts, const tn_cut *cut, uint32_t dart)
{
    uint32_t *side = pass->new->side + dart;
    memcpy(pass->new->origin + dart, cuts->origins + cut->dart_first, cut->dart_count * sizeof *side);
    memcpy(side, cuts->sides + cut->dart_first, cut->dart_count * sizeof *side);
    const tn_cut_join *joins = cuts->joins + cut->join_first;
    for (uint32_t i = 0; i < cut->join_count; i++)
        tn_write_joint(pass, &joins[i], joins[i].one, joins[i].other, side);
}

static void stamp_faces(const tn_pass *pass, uint32_t face, const tn_cut_loop *loops, uint32_t count, place at)
{
    tn_map *new = pass->new;
    for (uint32_t i = 0; i < count; i++)
        new->face_first[at.face + i] = at.dart + (i ? loops[i - 1].end : 0);
    if (!new->face_rank)
        return;
    uint32_t rank = pass->old->face_rank[face];
    for (uint32_t i = 0; i < count; i++)
        new->face_rank[at.face + i] = loops[i].region ? pass->made[rank] + loops[i].region - 1 : rank;
}

static void stamp_face(const tn_pass *pass, const tn_face_chunk *chunk, uint32_t face, place *at)
{
    static const tn_cut_loop whole = {0};
    uint32_t index = pass->cut_of[face];
    if (index == TN_CUT_PLAIN) {
        stamp_faces(pass, face, &whole, 1, *at);
        stamp_plain(pass, face, &at->dart);
        at->face++;
        return;
    }
    bool of_pattern = index & TN_CUT_OF_PATTERN;
    const tn_cuts *cuts = tn_cuts_of(pass, chunk, &index);
    const tn_cut *cut = &cuts->items[index];
    stamp_faces(pass, face, cuts->loops + cut->loop_first, cut->loop_count, *at);
    if (of_pattern)
        stamp_references(pass, face, cuts, cut, at->dart);
    else
        stamp_single(pass, cuts, cut, at->dart);
    at->face += cut->loop_count;
    at->dart += cut->dart_count;
}

static void stamp_chunk(void *context, uint32_t number)
{
    const tn_pass *pass = context;
    const tn_face_chunk *chunk = &pass->chunks[number];
    uint32_t faces = pass->old->face_count, begin = number * TN_CHUNK_FACES;
    uint32_t end = faces - begin < TN_CHUNK_FACES ? faces : begin + TN_CHUNK_FACES;
    place at = {(uint32_t)chunk->darts, (uint32_t)chunk->faces};
    for (uint32_t f = begin; f < end; f++) {
        if (f % TN_TOGETHER == 0)
            tn_ask_ahead(pass, f, pass->joints, sizeof *pass->joints, 0);
        stamp_face(pass, chunk, f, &at);
    }
}

tn_status tn_pass_stamp(tn_pass *pass, tn_error *error)
{
    pass->has_lanes = tn_stamp_has_lanes();
    return tn_crew_share(tn_pass_crew(pass), pass->chunk_count, stamp_chunk, pass, error);
}
