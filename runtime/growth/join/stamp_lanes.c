/* Writes several darts of the new map at once, by AVX-512. */
#include "runtime/growth/join/stamp_lanes.h"

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
