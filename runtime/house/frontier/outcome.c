/* Puts together what comes of a plane from what comes of its parts. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/plane.h"

/* ---- what is kept of an outcome */

/* Numbers what of the sides of some cells matters to their tiles. */
static uint32_t number_fits(tn_plane_house *c, const uint32_t *sides, uint32_t first, uint32_t end)
{
    tn_strip *s = c->strip;
    bool ok = true;
    s->key.size = 0;
    for (uint32_t i = first; ok && i < end; i++)
        ok = tn_key_push(&s->key, sides[(size_t)SIDE_WORDS * i + SIDE_FIT]);
    return ok ? tn_intern(&s->fit_lists, s->key.data, s->key.size) : UINT32_MAX;
}

/* Numbers what rooms and walks meet: the key from the steps on, without what matters to tiles. */
static uint32_t number_through(tn_plane_house *c, const uint32_t *steps, const uint32_t *sides)
{
    tn_strip *s = c->strip;
    const uint32_t *end = sides + (size_t)SIDE_WORDS * c->house.cell_count;
    bool ok = true;
    s->key.size = 0;
    for (const uint32_t *word = steps; ok && word <= end; word++) {
        bool fit = word >= sides && word < end && (size_t)(word - sides) % SIDE_WORDS == SIDE_FIT;
        ok = tn_key_push(&s->key, fit ? 0 : *word);
    }
    return ok ? tn_intern(&s->throughs, s->key.data, s->key.size) : UINT32_MAX;
}

/* The parts of a new outcome, whose key is `joined`. */
static bool keep_outcome(tn_plane_house *c, uint32_t outcome)
{
    tn_strip *s = c->strip;
    const uint32_t *steps = s->joined.data + 2, *sides = steps + 1 + (size_t)STEP_WORDS * *steps;
    tn_strip_outcome *parts = &s->outcomes[outcome];
    parts->left_fits = number_fits(c, sides, 0, c->left_cells);
    parts->right_fits = number_fits(c, sides, c->left_cells, (uint32_t)c->house.cell_count);
    parts->through = number_through(c, steps, sides);
    parts->cost = s->prices.asked ? sides[(size_t)SIDE_WORDS * c->house.cell_count + 1] : 0;
    return parts->left_fits != UINT32_MAX && parts->right_fits != UINT32_MAX && parts->through != UINT32_MAX &&
           tn_strip_split_outcome(s, s->joined.data, c->left_cells, (uint32_t)c->house.cell_count - c->left_cells,
                                  parts);
}

/* ---- outcomes from parts */

static int compare_steps(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return p[STEP_FROM] != q[STEP_FROM] ? (p[STEP_FROM] > q[STEP_FROM]) - (p[STEP_FROM] < q[STEP_FROM])
                                        : (p[STEP_TO] > q[STEP_TO]) - (p[STEP_TO] < q[STEP_TO]);
}

/* parts: of `parts`, `count` of them. Appends their meetings, then their steps in order. */
static bool push_steps(const tn_strip *s, const uint32_t *parts, size_t count, tn_key *key)
{
    bool ok = tn_push_long(key, 0) && tn_key_push(key, 0);
    for (size_t p = 0; ok && p < count; p++) {
        size_t size;
        const uint32_t *words = tn_interned(&s->parts, parts[p], &size);
        key->data[0] |= words[PART_MEETINGS];
        key->data[1] |= words[PART_MEETINGS + 1];
        key->data[2] += words[PART_STEPS];
        for (size_t w = 0; ok && w < (size_t)STEP_WORDS * words[PART_STEPS]; w++)
            ok = tn_key_push(key, words[PART_STEPS + 1 + w]);
    }
    if (ok)
        qsort(key->data + 3, key->data[2], STEP_WORDS * sizeof *key->data, compare_steps);
    return ok;
}

/* Appends SIDE_WORDS of each cell, in the order of cells. *cost: the last word of a part. */
static bool push_sides(const tn_plane_house *c, const uint32_t *parts, size_t count, tn_key *key, uint32_t *cost)
{
    const tn_strip *s = c->strip;
    size_t first = key->size, cells = c->house.cell_count;
    bool ok = true;
    for (size_t w = 0; ok && w < SIDE_WORDS * cells; w++)
        ok = tn_key_push(key, 0);
    for (size_t p = 0; ok && p < count; p++) {
        size_t size;
        const uint32_t *words = tn_interned(&s->parts, parts[p], &size), *end = words + size - s->prices.asked;
        *cost = words[size - 1];
        for (words += PART_STEPS + 1 + (size_t)STEP_WORDS * words[PART_STEPS]; words < end; words += 1 + SIDE_WORDS)
            memcpy(key->data + first + (size_t)SIDE_WORDS * *words, words + 1, SIDE_WORDS * sizeof *words);
    }
    return ok;
}

tn_status tn_plane_find_outcome(tn_plane_house *c, const uint32_t *parts, size_t count, uint32_t *outcome,
                                tn_error *error)
{
    tn_strip *s = c->strip;
    tn_key *key = &s->joined;
    uint32_t before = s->outcome_keys.count, cost = 0;
    key->size = 0;
    if (!push_steps(s, parts, count, key) || !push_sides(c, parts, count, key, &cost) ||
        !tn_key_push(key, c->left_cells) || (s->prices.asked && !tn_key_push(key, cost)) ||
        !tn_array_reserve(&s->outcomes, &s->outcome_room, before, 1, sizeof *s->outcomes))
        return tn_fail_memory(error);
    *outcome = tn_intern(&s->outcome_keys, key->data, key->size);
    bool ok = *outcome != UINT32_MAX && (*outcome < before || keep_outcome(c, *outcome));
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_plane_know_outcome(tn_plane_house *c, const tn_key *parts, uint32_t *outcome, tn_error *error)
{
    tn_strip *s = c->strip;
    uint32_t before = s->combined.count;
    if (!tn_array_reserve(&s->of_combined, &s->combined_room, before, 1, sizeof *s->of_combined))
        return tn_fail_memory(error);
    uint32_t at = tn_intern(&s->combined, parts->data, parts->size);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before)
        status = tn_plane_find_outcome(c, parts->data, c->part_count, &s->of_combined[at], error);
    *outcome = status == TN_OK ? s->of_combined[at] : 0;
    return status;
}
