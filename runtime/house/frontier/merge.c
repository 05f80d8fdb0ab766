/* Merges what nothing that follows can tell apart: edges that meet every neighbour alike, and cells for whose tiles it
 * makes no difference what stands at their left.
 *
 * Which neighbours there are is scouted first, tiles left aside (tn_strip.scouting): few states, which make every plane
 * that the library's houses can have. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

static int compare_words(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* ---- edges */

/* A plane, for sorting: by its left edge, then its right one. */
typedef struct tn_plane_place {
    uint64_t edges; /* left << 32 | right */
    uint32_t plane;
} tn_plane_place;

static int compare_places(const void *a, const void *b)
{
    const tn_plane_place *p = a, *q = b;
    return (p->edges > q->edges) - (p->edges < q->edges);
}

/* Equal lists of outcomes have one number. */
static bool number_outcomes(tn_strip *strip, tn_interner *lists, const tn_strip_list *list, uint32_t *number)
{
    tn_key *key = &strip->key;
    bool ok = true;
    key->size = 0;
    for (size_t i = 0; ok && i < list->count; i++)
        ok = tn_key_push(key, list->items[i].slice) && tn_push_long(key, list->items[i].times);
    *number = ok ? tn_intern(lists, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX;
}

/* What is asked of an edge's cells later, when it is the left one. */
static bool push_asked(tn_strip *strip, const tn_strip_edge *edge)
{
    bool ok = tn_key_push(&strip->joined, edge->asked);
    for (uint32_t i = 0; ok && i < edge->count; i++)
        ok = tn_key_push(&strip->joined, edge->cells[i].tiled);
    return ok;
}

/* places: all planes in order; *at: the first of the edge, then the first of another. */
static bool push_neighbours(tn_strip *strip, tn_interner *lists, uint32_t edge, const tn_plane_place *places,
                            size_t count, size_t *at)
{
    bool ok = true;
    for (; ok && *at < count && places[*at].edges >> 32 == edge; ++*at) {
        uint32_t list;
        ok = number_outcomes(strip, lists, &strip->planes[places[*at].plane], &list) &&
             tn_key_push(&strip->joined, tn_low(places[*at].edges)) && tn_key_push(&strip->joined, list);
    }
    return ok;
}

static bool merge_edges(tn_strip *strip)
{
    uint32_t edges = strip->edge_keys.count, planes = strip->plane_keys.count;
    tn_plane_place *places = malloc(((size_t)planes + 1) * sizeof *places);
    uint32_t *first = malloc(((size_t)edges + 1) * sizeof *first); /* of each class */
    strip->merged.edges = malloc(((size_t)edges + 1) * sizeof *strip->merged.edges);
    tn_interner classes = {0}, lists = {0};
    size_t at = 0;
    bool ok = places && first && strip->merged.edges;
    for (uint32_t i = 0; ok && i < planes; i++)
        places[i] = (tn_plane_place){strip->plane_keys.keys[i], i};
    if (ok)
        qsort(places, planes, sizeof *places, compare_places);
    for (uint32_t e = 0; ok && e < edges; e++) {
        uint32_t before = classes.count;
        strip->joined.size = 0;
        ok = push_asked(strip, &strip->edges[e]) && push_neighbours(strip, &lists, e, places, planes, &at);
        uint32_t class = ok ? tn_intern(&classes, strip->joined.data, strip->joined.size) : UINT32_MAX;
        ok = class != UINT32_MAX;
        if (ok && class == before)
            first[class] = e;
        if (ok)
            strip->merged.edges[e] = first[class];
    }
    tn_interner_clear(&classes);
    tn_interner_clear(&lists);
    free(places);
    free(first);
    return ok;
}

/* ---- what can stand at the right of a cell */

/* The number of a cell of an edge among the cells of all edges. */
static uint32_t *number_cells(const tn_strip *strip)
{
    uint32_t *first = malloc(((size_t)strip->edge_keys.count + 1) * sizeof *first), count = 0;
    for (uint32_t e = 0; first && e < strip->edge_keys.count; e++) {
        first[e] = count;
        count += strip->edges[e].count;
    }
    return first;
}

/* seen: {cell of an edge, what stands at its right}. */
static bool see_plane(const tn_strip *strip, uint32_t plane, const uint32_t *cells, tn_numbering *seen)
{
    uint32_t left = tn_high(strip->plane_keys.keys[plane]);
    const tn_strip_list *list = &strip->planes[plane];
    bool ok = true;
    for (size_t k = 0; ok && left != TN_STRIP_NONE && k < list->count; k++) {
        size_t size;
        const uint32_t *outcome = tn_interned(&strip->outcome_keys, list->items[k].slice, &size);
        const uint32_t *sides = outcome + 3 + (size_t)STEP_WORDS * outcome[2];
        for (uint32_t i = 0; ok && i < strip->edges[left].count; i++)
            if (strip->edges[left].cells[i].tiled)
                ok = tn_number(seen, (uint64_t)(cells[left] + i) << 32 | (sides[SIDE_WORDS * i + SIDE_FIT] - 1)) !=
                     UINT32_MAX;
    }
    return ok;
}

/* found: {base, what stands at its right}, of all slices whose cells are those. cell_bases: {cell of an edge, base}. */
static bool see_slices(const tn_strip *strip, const uint32_t *cells, tn_numbering *cell_bases)
{
    bool ok = true;
    for (uint32_t s = 0; ok && s < strip->slice_keys.count; s++) {
        size_t size;
        const uint32_t *slice = tn_interned(&strip->slice_keys, s, &size);
        const tn_strip_edge *edge = &strip->edges[slice[SLICE_EXIT]];
        for (uint32_t i = 0; ok && i < edge->count; i++)
            if (edge->cells[i].tiled)
                ok = tn_number(cell_bases, (uint64_t)(cells[slice[SLICE_EXIT]] + i) << 32 |
                                               slice[SLICE_CELLS + CELL_WORDS * i + CELL_TILE]) != UINT32_MAX;
    }
    return ok;
}

/* Joins {cell, base} and {cell, side} to {base, side}; both are sorted here. */
static bool join(tn_numbering *cell_bases, tn_numbering *seen, tn_numbering *found)
{
    bool ok = true;
    size_t at = 0;
    if (cell_bases->count > 0)
        qsort(cell_bases->keys, cell_bases->count, sizeof *cell_bases->keys, compare_words);
    if (seen->count > 0)
        qsort(seen->keys, seen->count, sizeof *seen->keys, compare_words);
    for (uint32_t i = 0; ok && i < cell_bases->count; i++) {
        uint32_t cell = tn_high(cell_bases->keys[i]);
        while (at < seen->count && tn_high(seen->keys[at]) < cell)
            at++;
        for (size_t k = at; ok && k < seen->count && tn_high(seen->keys[k]) == cell; k++)
            ok = tn_number(found, cell_bases->keys[i] << 32 | tn_low(seen->keys[k])) != UINT32_MAX;
    }
    return ok;
}

/* found, sorted, as a list for each base. */
static bool list_sides(tn_strip *strip, tn_numbering *found)
{
    tn_strip_merged *m = &strip->merged;
    m->first = calloc((size_t)strip->bases.count + 2, sizeof *m->first);
    m->sides = malloc(((size_t)found->count + 1) * sizeof *m->sides);
    if (!m->first || !m->sides)
        return false;
    if (found->count > 0)
        qsort(found->keys, found->count, sizeof *found->keys, compare_words);
    for (uint32_t i = 0; i < found->count; i++) {
        m->first[tn_high(found->keys[i]) + 1]++;
        m->sides[i] = tn_low(found->keys[i]);
    }
    for (uint32_t b = 0; b < strip->bases.count; b++)
        m->first[b + 1] += m->first[b];
    return true;
}

static bool find_sides(tn_strip *strip)
{
    tn_numbering seen = {0}, cell_bases = {0}, found = {0};
    uint32_t *cells = number_cells(strip);
    bool ok = cells && see_slices(strip, cells, &cell_bases);
    for (uint32_t p = 0; ok && p < strip->plane_keys.count; p++)
        ok = see_plane(strip, p, cells, &seen);
    ok = ok && join(&cell_bases, &seen, &found) && list_sides(strip, &found);
    free(cells);
    tn_numbering_clear(&seen);
    tn_numbering_clear(&cell_bases);
    tn_numbering_clear(&found);
    return ok;
}

void tn_strip_forget_states(tn_strip *strip)
{
    tn_interner_clear(&strip->states);
    tn_strip_stages_forget(&strip->stages);
    tn_strip_ways_forget(strip);
    free(strip->ends);
    strip->ends = NULL;
    strip->end_room = 0;
}

tn_status tn_strip_merge(tn_strip *strip, tn_error *error)
{
    strip->scouting = false;
    tn_strip_forget_states(strip);
    return merge_edges(strip) && find_sides(strip) ? TN_OK : tn_fail_memory(error);
}

void tn_strip_merged_clear(tn_strip_merged *merged)
{
    free(merged->edges);
    free(merged->first);
    free(merged->sides);
    free(merged->waits);
    free(merged->one);
    tn_numbering_clear(&merged->pairs);
    tn_interner_clear(&merged->tiles);
}

/* ---- tiles that wait for the right side of their cell */

static uint32_t common_divisor(uint32_t a, uint32_t b)
{
    while (b != 0) {
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* strip->key := {what stands at the right, how many tiles fit}, for each side that can. */
static tn_status list_tiles(tn_strip *strip, uint32_t base, uint32_t left, tn_error *error)
{
    const tn_strip_merged *m = &strip->merged;
    tn_key *key = &strip->key;
    tn_status status = TN_OK;
    key->size = 0;
    for (size_t i = m->first[base]; status == TN_OK && i < m->first[base + 1]; i++) {
        uint32_t tiles = 0;
        status = tn_strip_fit(strip, base, left, m->sides[i], &tiles, error);
        if (status == TN_OK && (!tn_key_push(key, m->sides[i]) || !tn_key_push(key, tiles)))
            status = tn_fail_memory(error);
    }
    return status;
}

/* Takes from the list at hand what all of its numbers are multiples of: 0 where no tile ever fits. A list of ones
 * becomes empty: nothing waits. Where tiles have prices, numbers are of lists of costs, and stay as they are. */
static uint32_t take_factor(const tn_strip *strip, tn_key *key)
{
    uint32_t factor = 0;
    bool ones = true;
    for (size_t i = 1; i < key->size; i += 2)
        factor = common_divisor(factor, key->data[i]);
    if (strip->prices.items)
        return factor > 0;
    for (size_t i = 1; factor > 0 && i < key->size; i += 2) {
        key->data[i] /= factor;
        ones = ones && key->data[i] == 1;
    }
    key->size = ones ? 0 : key->size;
    return factor;
}

/* Equal lists are one class. */
static tn_status classify(tn_strip *strip, uint32_t base, uint32_t left, tn_strip_wait *wait, tn_error *error)
{
    tn_strip_merged *m = &strip->merged;
    tn_status status = list_tiles(strip, base, left, error);
    if (status != TN_OK)
        return status;
    uint32_t before = m->tiles.count, factor = take_factor(strip, &strip->key);
    *wait = (tn_strip_wait){.class = TN_STRIP_NONE};
    if (factor == 0)
        return TN_OK;
    bool ever = strip->key.size > 0;
    uint32_t class = tn_intern(&m->tiles, strip->key.data, strip->key.size);
    if (class == UINT32_MAX || !tn_array_reserve(&m->one, &m->one_room, before, 1, sizeof *m->one))
        return tn_fail_memory(error);
    if (class == before)
        m->one[class] = (tn_strip_one){base, left, factor};
    *wait = (tn_strip_wait){class, factor, ever};
    return TN_OK;
}

tn_status tn_strip_waits(tn_strip *strip, uint32_t base, uint32_t left, tn_strip_wait *wait, tn_error *error)
{
    tn_strip_merged *m = &strip->merged;
    uint32_t before = m->pairs.count;
    if (!tn_array_reserve(&m->waits, &m->wait_room, before, 1, sizeof *m->waits))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&m->pairs, (uint64_t)base << 32 | left);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = at == before ? classify(strip, base, left, &m->waits[at], error) : TN_OK;
    *wait = status == TN_OK ? m->waits[at] : (tn_strip_wait){.class = TN_STRIP_NONE};
    return status;
}
