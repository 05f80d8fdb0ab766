/* The new map written: each face's loops from its cut, every dart once, in its place. */
#include <string.h>

#include "runtime/growth/join/decide.h"
#include "runtime/growth/join/stamp.h"

/* ---- writes several darts of the new map at once, by AVX-512 */

#if defined(__x86_64__)
#include <immintrin.h>

#define LANES 16u
#define FOUR 4u              /* darts, whose bases are one register */
#define EACH_SIDE 0x1111     /* the lanes of TN_BASE_SIDE, */
#define EACH_ORIGIN 0x8888   /* and of TN_BASE_ORIGIN */
#define TEMPLATE_BITS 0xffff /* in the record's fourth word, where TN_BASE_ORIGIN goes */

_Static_assert(sizeof(tn_record) == 4 * sizeof(uint32_t), "a record is one dart's bases");

bool tn_stamp_has_lanes(void)
{
    return __builtin_cpu_supports("avx512f");
}

__attribute__((target("avx512f"))) static inline __m512i read_records(const tn_pass *pass, const uint32_t *sides,
                                                                      uint32_t count)
{
    __m128i records[FOUR] = {0};
    for (uint32_t i = 0; i < FOUR; i++)
        if (i < count)
            records[i] = _mm_loadu_si128((const __m128i *)&pass->records[sides[i] / 2]);
    __m512i all = _mm512_castsi128_si512(records[0]);
    all = _mm512_inserti32x4(all, records[1], 1);
    all = _mm512_inserti32x4(all, records[2], 2);
    return _mm512_inserti32x4(all, records[3], 3);
}

/* As tn_dart_bases, for up to four darts. */
__attribute__((target("avx512f"))) static inline __m512i make_bases(const tn_pass *pass, uint32_t first, uint32_t count)
{
    const uint32_t *sides = pass->old->side + first, *origins = pass->old->origin + first;
    __mmask16 darts = (__mmask16)((1u << count) - 1);
    __m512i bases = read_records(pass, sides, count), template = _mm512_set1_epi32(TEMPLATE_BITS);
    __m512i ends = _mm512_maskz_expand_epi32(EACH_SIDE, _mm512_maskz_loadu_epi32(darts, sides));
    __mmask16 kept = _mm512_mask_cmpeq_epi32_mask(EACH_ORIGIN, _mm512_and_si512(bases, template), template);
    ends = _mm512_and_si512(ends, _mm512_set1_epi32(1));
    bases = _mm512_mask_add_epi32(bases, (__mmask16)(kept >> TN_BASE_ORIGIN), bases, ends);
    return _mm512_mask_expand_epi32(bases, EACH_ORIGIN, _mm512_maskz_loadu_epi32(darts, origins));
}

__attribute__((target("avx512f"))) static inline void look_up(const __m512i bases[2], const uint32_t *references,
                                                              uint32_t count, uint32_t *result)
{
    for (uint32_t i = 0; i < count; i += LANES) {
        __mmask16 lanes = count - i < LANES ? (__mmask16)((1u << (count - i)) - 1) : 0xffff;
        __m512i some = _mm512_maskz_loadu_epi32(lanes, references + i);
        __m512i base = _mm512_permutex2var_epi32(bases[0], _mm512_srli_epi32(some, 16), bases[1]);
        __m512i more = _mm512_and_si512(some, _mm512_set1_epi32(0xffff));
        _mm512_mask_storeu_epi32(result + i, lanes, _mm512_add_epi32(base, more));
    }
}

__attribute__((target("avx512f"))) void tn_stamp_lanes(const tn_pass *pass, uint32_t first, uint32_t size,
                                                       const uint32_t *origins, const uint32_t *sides, uint32_t count,
                                                       uint32_t *origin, uint32_t *side,
                                                       uint32_t bases[TN_LANES_DARTS * TN_BASES])
{
    __m512i table[2] = {make_bases(pass, first, size < FOUR ? size : FOUR), _mm512_setzero_si512()};
    if (size > FOUR)
        table[1] = make_bases(pass, first + FOUR, size - FOUR);
    look_up(table, origins, count, origin);
    look_up(table, sides, count, side);
    _mm512_store_si512(bases, table[0]);
    _mm512_store_si512(bases + LANES, table[1]);
}

#else

bool tn_stamp_has_lanes(void)
{
    return false;
}

void tn_stamp_lanes(const tn_pass *pass, uint32_t first, uint32_t size, const uint32_t *origins, const uint32_t *sides,
                    uint32_t count, uint32_t *origin, uint32_t *side, uint32_t bases[TN_LANES_DARTS * TN_BASES])
{
    (void)pass, (void)first, (void)size, (void)origins, (void)sides, (void)count, (void)origin, (void)side, (void)bases;
}

#endif

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
