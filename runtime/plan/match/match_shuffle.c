/* Matches many rules at once by byte shuffles. */
#include "runtime/plan/match/match_shuffle.h"

#include <stdlib.h>
#include <string.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "runtime/base/array.h"

#define TABLE_BYTES_MAX                                                                                                \
    (UINT64_C(1) << 26) /* of all vectors: past it the narrower tables of match_joint.h are better */

tn_simd tn_simd_choose(tn_simd wanted)
{
    tn_simd best = TN_SIMD_NONE;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        best = TN_SIMD_AVX2;
    if (best == TN_SIMD_AVX2 && __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512bw"))
        best = TN_SIMD_AVX512;
#endif
    return wanted == TN_SIMD_BEST || wanted > best ? best : wanted;
}

/* ---- packing */

/* What is being packed: the vector in hand, the last of `shuffles`, and how full its last block is. */
typedef struct packing {
    tn_shuffles *shuffles;
    const tn_row_map *map;
    uint32_t block_size, blocks_max;
    uint32_t states; /* of the last block */
    size_t first;    /* rule in lane 0 of the last block */
} packing;

static tn_status add_vector(packing *p, tn_error *error)
{
    tn_shuffles *shuffles = p->shuffles;
    if (!tn_array_resize(&shuffles->items, shuffles->count + 1, sizeof *shuffles->items))
        return tn_fail_memory(error);
    tn_shuffle *vector = &shuffles->items[shuffles->count++];
    memset(vector, 0, sizeof *vector);
    vector->table = aligned_alloc(64, ((size_t)p->map->rows * shuffles->width / 64 + 2) * 64);
    if (!vector->table)
        return tn_fail_memory(error);
    for (uint32_t row = 0; row <= p->map->rows; row++)
        for (uint32_t i = 0; i < shuffles->width; i++)
            vector->table[(size_t)row * shuffles->width + i] = (uint8_t)(i % p->block_size);
    return TN_OK;
}

/* A block for rules from `rule` on, in the vector in hand or in a new one. */
static tn_status add_block(packing *p, size_t rule, tn_error *error)
{
    tn_shuffles *shuffles = p->shuffles;
    if (shuffles->count == 0 || shuffles->items[shuffles->count - 1].block_count == p->blocks_max) {
        tn_status status = add_vector(p, error);
        if (status != TN_OK)
            return status;
    }
    tn_shuffle *vector = &shuffles->items[shuffles->count - 1];
    vector->blocks[vector->block_count++] = (tn_shuffle_block){.word = (uint32_t)(rule / 64), .bit = rule % 64};
    p->states = 0;
    p->first = rule;
    return TN_OK;
}

/* Is there room for the rule in the last block? A block's rules lie in one result word. */
static bool fits(const packing *p, const tn_dfa *dfa, size_t rule)
{
    return p->shuffles->count > 0 && p->states + dfa->states <= p->block_size && rule - p->first < p->block_size &&
           rule / 64 == p->first / 64;
}

static void add_rule(packing *p, const tn_dfa *dfa, size_t rule)
{
    uint32_t width = p->shuffles->width;
    tn_shuffle *vector = &p->shuffles->items[p->shuffles->count - 1];
    uint32_t base = (vector->block_count - 1) * p->block_size, lane = base + (uint32_t)(rule - p->first);
    for (uint32_t row = 0; row < p->map->rows; row++)
        for (uint32_t s = 0; s < dfa->states; s++)
            vector->table[(size_t)row * width + base + p->states + s] =
                (uint8_t)(p->states + tn_dfa_read(dfa, s, p->map->letter[row]));
    for (uint32_t s = 0; s < dfa->states; s++)
        vector->accept[base + p->states + s] = dfa->accept[s] ? 0x80 : 0;
    vector->start[lane] = (uint8_t)p->states;
    vector->blocks[vector->block_count - 1].used |= UINT64_C(1) << lane;
    p->states += dfa->states;
}

tn_status tn_shuffles_make(tn_shuffles *shuffles, tn_simd simd, const tn_row_map *map, tn_dfa *const *dfas,
                           size_t count, bool *taken, tn_error *error)
{
    *shuffles = (tn_shuffles){.simd = simd, .width = simd == TN_SIMD_AVX512 ? 64 : 32};
    packing p = {.shuffles = shuffles, .map = map};
    p.block_size = simd == TN_SIMD_AVX512 ? 64 : 16;
    p.blocks_max = shuffles->width / p.block_size;
    uint64_t vectors_max = TABLE_BYTES_MAX / ((uint64_t)(map->rows + 1) * shuffles->width);
    for (size_t i = 0; i < count && simd != TN_SIMD_NONE; i++) {
        if (!dfas[i] || dfas[i]->states > p.block_size)
            continue;
        if (!fits(&p, dfas[i], i)) {
            if (shuffles->count >= vectors_max)
                break;
            tn_status status = add_block(&p, i, error);
            if (status != TN_OK)
                return status;
        }
        add_rule(&p, dfas[i], i);
        taken[i] = true;
    }
    return TN_OK;
}

void tn_shuffles_clear(tn_shuffles *shuffles)
{
    for (size_t i = 0; i < shuffles->count; i++)
        free(shuffles->items[i].table);
    free(shuffles->items);
    *shuffles = (tn_shuffles){0};
}

/* ---- walking */

#if defined(__x86_64__)

/* Eight lanes hide the shuffle's latency of 3 cycles, so that a step of all rules takes one, the throughput of the
 * unit. The bits go straight to their word: put into an array first, they would be read back before they are there. */
__attribute__((target("avx512f,avx512bw,avx512vbmi"))) static void
walk_avx512(const tn_shuffle *vector, const tn_lanes *lanes, uint64_t *bits, size_t words)
{
    const tn_shuffle_block block = vector->blocks[0];
    const uint8_t *table = vector->table;
    size_t stride = lanes->stride;
#define START(k)                                                                                                       \
    __m512i state##k = _mm512_loadu_si512(vector->start);                                                              \
    const uint32_t *rows##k = lanes->rows + (k)*stride;
#define STEP(k) state##k = _mm512_permutexvar_epi8(state##k, _mm512_load_si512(table + (size_t)rows##k[i] * 64));
#define FINISH(k)                                                                                                      \
    bits[(k)*words + block.word] |= (_mm512_movepi8_mask(_mm512_permutexvar_epi8(state##k, accept)) & block.used)      \
                                    << block.bit;
    __m512i accept = _mm512_loadu_si512(vector->accept);
    TN_WALK_LANES(lanes, START, STEP, FINISH)
#undef START
#undef STEP
#undef FINISH
}

/* The same with two shuffles of 16 bytes side by side, which take one cycle and of which two may start in one. */
__attribute__((target("avx2"))) static void walk_avx2(const tn_shuffle *vector, const tn_lanes *lanes, uint64_t *bits,
                                                      size_t words)
{
    const tn_shuffle_block low = vector->blocks[0], high = vector->blocks[1];
    const uint8_t *table = vector->table;
    size_t stride = lanes->stride;
#define START(k)                                                                                                       \
    __m256i state##k = _mm256_loadu_si256((const __m256i *)vector->start);                                             \
    const uint32_t *rows##k = lanes->rows + (k)*stride;
#define STEP(k)                                                                                                        \
    state##k = _mm256_shuffle_epi8(_mm256_load_si256((const __m256i *)(table + (size_t)rows##k[i] * 32)), state##k);
#define FINISH(k)                                                                                                      \
    {                                                                                                                  \
        uint64_t found = (uint32_t)_mm256_movemask_epi8(_mm256_shuffle_epi8(accept, state##k));                        \
        bits[(k)*words + low.word] |= (found & low.used) << low.bit;                                                   \
        bits[(k)*words + high.word] |= (found & high.used) >> 16 << high.bit;                                          \
    }
    __m256i accept = _mm256_loadu_si256((const __m256i *)vector->accept);
    TN_WALK_LANES(lanes, START, STEP, FINISH)
#undef START
#undef STEP
#undef FINISH
}

void tn_shuffle_walk(const tn_shuffles *shuffles, size_t i, const tn_lanes *lanes, uint64_t *bits, size_t words)
{
    if (shuffles->simd == TN_SIMD_AVX512)
        walk_avx512(&shuffles->items[i], lanes, bits, words);
    else
        walk_avx2(&shuffles->items[i], lanes, bits, words);
}

#else

/* tn_simd_choose has chosen none, and so there is no vector. */
void tn_shuffle_walk(const tn_shuffles *shuffles, size_t i, const tn_lanes *lanes, uint64_t *bits, size_t words)
{
    (void)shuffles, (void)i, (void)lanes, (void)bits, (void)words;
}

#endif
