/* Sums of the tiles of a tray: how many arrangements cost how much. Where tiles have no prices that is one number. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

/* ---- sums at hand: of the tiles so far */

static int compare_sums(const void *a, const void *b)
{
    const tn_strip_sum *p = a, *q = b;
    return (p->cost > q->cost) - (p->cost < q->cost);
}

/* Sums of the same cost become one. False: there are more than 2^64 arrangements. */
static bool join_sums(tn_strip_sum *sums, size_t *count)
{
    size_t kept = 0;
    bool ok = true;
    qsort(sums, *count, sizeof *sums, compare_sums);
    for (size_t i = 0; ok && i < *count; i++) {
        if (kept > 0 && sums[kept - 1].cost == sums[i].cost)
            ok = !__builtin_add_overflow(sums[kept - 1].times, sums[i].times, &sums[kept - 1].times);
        else
            sums[kept++] = sums[i];
    }
    *count = kept;
    return ok;
}

/* Adds each tile of a list to each of the sums. */
static tn_status add_list(tn_strip *strip, uint32_t list, tn_error *error)
{
    tn_strip_sums *s = &strip->sums;
    const tn_int128 *steps = strip->prices.steps;
    size_t words, count = 0;
    const uint32_t *added = tn_interned(&strip->prices.lists, list, &words);
    bool ok = true;
    if (!tn_array_reserve(&s->more, &s->more_room, 0, s->count * (words / 2) + 1, sizeof *s->more))
        return tn_fail_memory(error);
    for (size_t i = 0; i < s->count; i++)
        for (size_t w = 0; ok && w < words; w += 2) {
            tn_strip_sum sum = {s->items[i].cost + (steps ? steps[added[w]] : 0), 0};
            ok = !__builtin_mul_overflow(s->items[i].times, (uint64_t)added[w + 1], &sum.times);
            s->more[count++] = sum;
        }
    if (count > 0)
        ok = ok && join_sums(s->more, &count);
    tn_strip_sum *items = s->items;
    size_t room = s->room;
    s->items = s->more;
    s->room = s->more_room;
    s->more = items;
    s->more_room = room;
    s->count = count;
    return ok ? TN_OK : tn_strip_limit(strip, NULL, "a tray has more than 2^64 arrangements of tiles", error);
}

/* Adds the tiles of a cell: `fit` as of tn_strip_fit. */
static tn_status add_tiles(tn_strip *strip, uint32_t fit, tn_error *error)
{
    tn_strip_sums *s = &strip->sums;
    if (strip->prices.items)
        return add_list(strip, fit, error);
    s->count = fit > 0;
    if (__builtin_mul_overflow(s->items[0].times, (uint64_t)fit, &s->items[0].times))
        return tn_strip_limit(strip, NULL, "a tray has more than 2^64 arrangements of tiles", error);
    return TN_OK;
}

static tn_status begin(tn_strip *strip, tn_error *error)
{
    tn_strip_sums *s = &strip->sums;
    if (!tn_array_reserve(&s->items, &s->room, 0, 1, sizeof *s->items))
        return tn_fail_memory(error);
    s->items[0] = (tn_strip_sum){0, 1};
    s->count = 1;
    return TN_OK;
}

/* The tiles of the left slice: no sum where one of its cells has none. */
static tn_status multiply(tn_strip *strip, uint32_t waiting, uint32_t sides, tn_error *error)
{
    size_t count, cells;
    const uint32_t *wait = tn_interned(&strip->waiting, waiting, &count);
    const uint32_t *fits = tn_interned(&strip->fit_lists, sides, &cells);
    tn_status status = begin(strip, error);
    for (size_t i = 0; status == TN_OK && strip->sums.count > 0 && i < count; i += WAIT_WORDS) {
        uint32_t fit = 0;
        const tn_strip_one *one = &strip->merged.one[wait[i + WAIT_CLASS]];
        status = tn_strip_fit(strip, one->base, one->left, fits[wait[i + WAIT_CELL]] - 1, &fit, error);
        if (status == TN_OK)
            status = add_tiles(strip, strip->prices.items ? fit : fit / one->factor, error);
    }
    return status;
}

/* ---- how many, without prices */

tn_status tn_strip_end_waiting(tn_strip *strip, uint32_t waiting, uint32_t left_fits, uint64_t *times, tn_error *error)
{
    uint32_t *result;
    bool met;
    tn_status status = tn_strip_known_at(&strip->tiles, waiting, left_fits, 2, &result, &met, error);
    if (status == TN_OK && !met) {
        status = multiply(strip, waiting, left_fits, error);
        uint64_t found = status == TN_OK && strip->sums.count > 0 ? strip->sums.items[0].times : 0;
        result[0] = tn_low(found);
        result[1] = tn_high(found);
    }
    *times = status == TN_OK ? tn_both(result) : 0;
    return status;
}

/* ---- sums that are kept: the same tiles come with many totals */

enum { KEPT_FIRST, KEPT_COUNT, KEPT_WORDS };
enum { KEPT_MAX = 1 << 21 }; /* sums: 64 MB */

static tn_status keep(tn_strip_sums *s, uint32_t result[KEPT_WORDS], tn_error *error)
{
    if (s->kept_count + s->count > KEPT_MAX)
        return TN_OK;
    if (!tn_array_reserve(&s->kept, &s->kept_room, s->kept_count, s->count, sizeof *s->kept))
        return tn_fail_memory(error);
    memcpy(s->kept + s->kept_count, s->items, s->count * sizeof *s->kept);
    result[KEPT_FIRST] = (uint32_t)s->kept_count;
    result[KEPT_COUNT] = (uint32_t)s->count;
    s->kept_count += s->count;
    return TN_OK;
}

static tn_status find_kept(tn_strip *strip, uint32_t waiting, uint32_t left_fits, tn_error *error)
{
    tn_strip_sums *s = &strip->sums;
    uint32_t *result;
    bool met;
    tn_status status = tn_strip_known_at(&s->places, waiting, left_fits, KEPT_WORDS, &result, &met, error);
    if (status == TN_OK && !met)
        result[KEPT_FIRST] = TN_STRIP_NONE; /* not kept, as long as nothing else is known */
    bool kept = status == TN_OK && result[KEPT_FIRST] != TN_STRIP_NONE;
    if (status == TN_OK && !kept)
        status = multiply(strip, waiting, left_fits, error);
    if (status == TN_OK && !met)
        status = keep(s, result, error);
    s->found = kept ? s->kept + result[KEPT_FIRST] : s->items;
    s->found_count = kept ? result[KEPT_COUNT] : s->count;
    return status;
}

tn_status tn_strip_sum_tiles(tn_strip *strip, uint32_t waiting, uint32_t left_fits, tn_error *error)
{
    tn_strip_sums *s = &strip->sums;
    if (strip->prices.items && strip->prices.steps)
        return find_kept(strip, waiting, left_fits, error);
    uint64_t times = 1;
    tn_status status = strip->prices.items ? multiply(strip, waiting, left_fits, error)
                                           : tn_strip_end_waiting(strip, waiting, left_fits, &times, error);
    if (status == TN_OK && !strip->prices.items)
        status = tn_strip_sum_one(strip, times, error);
    s->found = s->items;
    s->found_count = s->count;
    return status;
}

tn_status tn_strip_sum_one(tn_strip *strip, uint64_t times, tn_error *error)
{
    tn_strip_sums *s = &strip->sums;
    tn_status status = begin(strip, error);
    if (status != TN_OK)
        return status;
    s->items[0].times = times;
    s->count = s->found_count = times > 0;
    s->found = s->items;
    return TN_OK;
}

void tn_strip_sums_clear(tn_strip_sums *sums)
{
    free(sums->items);
    free(sums->more);
    free(sums->kept);
    tn_strip_known_clear(&sums->places);
}
