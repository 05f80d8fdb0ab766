/* Lays eight plans side by side for matching. */
#include "runtime/plan/match/match_lanes.h"

#include <stdlib.h>
#include <string.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "runtime/base/array.h"

/* Room for eight plans, rounded up to chunks, and a chunk of padding after each. An even number of trays is walked: of
 * plans of 4 to 10 trays eight almost always make 10 then, and the loop's end is guessed right. */
static bool reserve(tn_lanes *lanes, size_t longest)
{
    lanes->longest = longest + longest % 2;
    lanes->stride = (longest > 0 ? (longest - 1) / TN_LANES_CHUNK + 2 : 2) * TN_LANES_CHUNK;
    return tn_array_reserve(&lanes->rows, &lanes->capacity, 0, lanes->stride * TN_LANES, sizeof *lanes->rows);
}

/* Plans of up to one chunk, where a whole chunk can be read of each: what is past a plan's end belongs to the plans
 * after it, and is padded over. No branch depends on a plan's length, and all sizes are constants. */
static void copy_chunks(tn_lanes *lanes, const tn_tray *trays, const size_t *starts, uint32_t padding)
{
    for (size_t k = 0; k < TN_LANES; k++) {
        uint32_t *rows = lanes->rows + k * 2 * TN_LANES_CHUNK;
        size_t length = starts[k + 1] - starts[k];
        memcpy(rows, trays + starts[k], TN_LANES_CHUNK * sizeof *rows);
        for (size_t i = 0; i < TN_LANES_CHUNK; i++)
            rows[length + i] = padding;
    }
}

#if defined(__x86_64__)
/* Plans of any length, by masked loads, which do not read past the plan: every lane has as many chunks. */
__attribute__((target("avx512f,bmi2"))) static void copy_masked(tn_lanes *lanes, const tn_tray *trays,
                                                                const size_t *starts, uint32_t padding)
{
    __m512i pad = _mm512_set1_epi32((int)padding);
    for (size_t k = 0; k < TN_LANES; k++) {
        uint32_t *rows = lanes->rows + k * lanes->stride;
        size_t length = starts[k + 1] - starts[k];
        for (size_t i = 0; i < lanes->stride - TN_LANES_CHUNK; i += TN_LANES_CHUNK) {
            size_t left = length > i ? length - i : 0;
            __mmask16 in_plan = (__mmask16)_bzhi_u32(0xffff, left < TN_LANES_CHUNK ? (unsigned)left : TN_LANES_CHUNK);
            __m512i chunk = _mm512_mask_loadu_epi32(pad, in_plan, trays + starts[k] + (left ? i : 0));
            _mm512_storeu_si512(rows + i, chunk);
        }
    }
}
#endif

/* Any plans. */
static void copy_plans(tn_lanes *lanes, const tn_row_map *map, const tn_tray *trays, const size_t *starts)
{
    for (size_t k = 0; k < TN_LANES; k++) {
        uint32_t *rows = lanes->rows + k * lanes->stride;
        const tn_tray *plan = trays + starts[k];
        size_t length = starts[k + 1] - starts[k];
        if (!map->classes && length > 0)
            memcpy(rows, plan, length * sizeof *rows);
        for (size_t i = 0; map->classes && i < length; i++)
            rows[i] = tn_class_of(map->classes, plan[i]);
        for (size_t i = length; i < lanes->longest; i++)
            rows[i] = map->rows;
    }
}

/* One plan: what a program does that asks plan by plan. */
static bool fill_one(tn_lanes *lanes, const tn_row_map *map, const tn_tray *trays, size_t length)
{
    if (!reserve(lanes, length))
        return false;
    for (size_t i = 0; i < length; i++)
        lanes->rows[i] = map->classes ? tn_class_of(map->classes, trays[i]) : trays[i];
    lanes->rows[length] = map->rows; /* where an odd number of trays is walked as an even one */
    return true;
}

bool tn_lanes_fill(tn_lanes *lanes, const tn_row_map *map, const tn_plan_array *plans, size_t first)
{
    size_t starts[TN_LANES + 1], last = plans->ends[plans->count - 1], longest = 0;
    starts[0] = first ? plans->ends[first - 1] : plans->begin;
    lanes->alone = plans->count - first == 1;
    if (lanes->alone)
        return fill_one(lanes, map, plans->trays + starts[0], last - starts[0]);
    for (size_t k = 0; k < TN_LANES; k++) {
        starts[k + 1] = first + k < plans->count ? plans->ends[first + k] : starts[k];
        size_t length = starts[k + 1] - starts[k];
        longest = length > longest ? length : longest;
    }
    if (!reserve(lanes, longest))
        return false;
#if defined(__x86_64__)
    if (lanes->masked && !map->classes) {
        copy_masked(lanes, plans->trays, starts, map->rows);
        return true;
    }
#endif
    if (longest <= TN_LANES_CHUNK && !map->classes && starts[TN_LANES] + TN_LANES_CHUNK <= last)
        copy_chunks(lanes, plans->trays, starts, map->rows);
    else
        copy_plans(lanes, map, plans->trays, starts);
    return true;
}
