/* What a sum asks of the whole plan, as automata.
 *
 * The longest gap is the shortest that gaps can be, and for each length that it passes what the next one is more: an
 * automaton for each length accepts the plans with a longer gap. So the states are those that tell gaps apart, no more.
 */
#include "runtime/plan/measure/weighed_whole.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

static tn_status add(tn_weighed_whole *whole, tn_dfa *dfa, int64_t each, bool needed, tn_error *error)
{
    if (!tn_array_reserve(&whole->items, &whole->room, whole->count, 1, sizeof *whole->items)) {
        tn_dfa_free(dfa);
        return tn_fail_memory(error);
    }
    whole->items[whole->count++] = (tn_weighed_asked){.dfa = dfa, .each = each, .needed = needed};
    return TN_OK;
}

/* ---- gaps */

/* A gap's term made ready. Lengths are in parts: what all trays' lengths are whole times of. */
typedef struct gaps {
    const tn_marked *marked;
    const tn_sum_term *term;
    tn_dfa *source, *destination;
    uint64_t *counts; /* [classes]: parts of a tray */
    int64_t part;     /* steps */
    uint64_t *length; /* [count]: that gaps can have, ascending */
    size_t count;
} gaps;

static uint64_t divisor(uint64_t a, uint64_t b)
{
    while (b > 0) {
        uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* The parts of each class's trays. */
static tn_status find_counts(gaps *g, const tn_classes *classes, tn_error *error)
{
    uint64_t common = 0;
    bool negative = false;
    g->counts = calloc((size_t)classes->count + 1, sizeof *g->counts);
    if (!g->counts)
        return tn_fail_memory(error);
    for (uint32_t c = 0; c < classes->count; c++) {
        int64_t steps = g->term->weight ? g->term->weight[classes->representative[c]] : g->term->each;
        negative |= steps < 0;
        g->counts[c] = (uint64_t)llabs(steps);
        common = divisor(common, g->counts[c]);
    }
    common = common ? common : 1;
    for (uint32_t c = 0; c < classes->count; c++)
        g->counts[c] /= common;
    g->part = negative ? -(int64_t)common : (int64_t)common;
    return TN_OK;
}

static tn_status too_many(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "gaps can have more than %u different lengths", TN_GAPS_MAX);
    tn_error_help(error, "give fewer trays with --trays, or measure gaps in trays or by a field of rounder lengths");
    return TN_LIMIT;
}

static int compare_lengths(const void *left, const void *right)
{
    uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/* Keeps different lengths only, ascending. */
static size_t unite(uint64_t *length, size_t count)
{
    size_t kept = 0;
    qsort(length, count, sizeof *length, compare_lengths);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || length[kept - 1] != length[i])
            length[kept++] = length[i];
    return kept;
}

/* The lengths that up to so many trays can have together. */
static tn_status find_lengths(gaps *g, uint32_t classes, uint32_t trays, tn_error *error)
{
    uint64_t *one = malloc(((size_t)classes + 1) * sizeof *one), *more = NULL;
    g->length = calloc(TN_GAPS_MAX + 1, sizeof *g->length);
    if (one) {
        memcpy(one, g->counts, classes * sizeof *one);
        classes = (uint32_t)unite(one, classes);
        more = malloc((size_t)TN_GAPS_MAX * (classes + 1) * sizeof *more);
    }
    tn_status status = more && g->length ? TN_OK : tn_fail_memory(error);
    g->count = 1; /* nothing between */
    for (uint32_t n = 0; status == TN_OK && n < trays; n++) {
        size_t size = g->count;
        memcpy(more, g->length, size * sizeof *more);
        for (size_t i = 0; i < g->count; i++)
            for (uint32_t c = 0; c < classes; c++)
                more[size++] = g->length[i] + one[c];
        size = unite(more, size);
        if (size > TN_GAPS_MAX)
            status = too_many(error);
        else if (size == g->count)
            break;
        else
            memcpy(g->length, more, (g->count = size) * sizeof *more);
    }
    free(one);
    free(more);
    return status;
}

/* The stretches that are longer than so many parts, or at most as long. */
static tn_status between(const gaps *g, uint64_t length, bool longer, tn_dfa **out, tn_error *error)
{
    uint8_t *holds = tn_array_new(length + 2, 1);
    if (!holds)
        return tn_fail_memory(error);
    memset(holds, !longer, (size_t)length + 1);
    holds[length + 1] = longer;
    const tn_periodic_set set = {.threshold = length + 1, .period = 1, .holds = holds};
    tn_status status = tn_marked_count(g->marked, g->marked->single, TN_TALLY_SINGLES, &set, g->counts, out, error);
    free(holds);
    return status;
}

/* The plans with a stretch that is so far from every destination. Longest: every one of them is farther. Shortest: some
 * is at most as far. gap NULL: whatever lies between; then, of the longest, stretches without any destination. */
static tn_status with_gap(const gaps *g, const tn_dfa *gap, bool every, tn_dfa **out, tn_error *error)
{
    tn_dfa *stretches = NULL, *none = NULL;
    tn_status status = TN_OK;
    if (!gap)
        status = every ? tn_marked_not(g->marked, g->marked->all, &none, error) : TN_OK;
    if (status == TN_OK)
        status = (every ? tn_marked_far : tn_marked_near)(g->marked, g->source, g->destination,
                                                          gap    ? gap
                                                          : none ? none
                                                                 : g->marked->all,
                                                          &stretches, error);
    if (status == TN_OK)
        status = tn_marked_anywhere(g->marked, stretches, out, error);
    tn_dfa_free(none);
    tn_dfa_free(stretches);
    return status;
}

static tn_status add_opposite(tn_weighed_whole *whole, tn_dfa *dfa, int64_t each, bool needed, tn_error *error)
{
    tn_dfa *opposite = NULL;
    tn_status status = tn_dfa_complement(dfa, &opposite, error);
    tn_dfa_free(dfa);
    return status == TN_OK ? add(whole, opposite, each, needed, error) : status;
}

/* There is a gap, and none of the longest leads nowhere. */
static tn_status add_needed(tn_weighed_whole *whole, const gaps *g, bool longest, tn_error *error)
{
    tn_dfa *dfa = NULL;
    tn_status status = with_gap(g, NULL, false, &dfa, error);
    if (status == TN_OK)
        status = add(whole, dfa, 0, true, error);
    if (status != TN_OK || !longest)
        return status;
    status = with_gap(g, NULL, true, &dfa, error);
    return status == TN_OK ? add_opposite(whole, dfa, 0, true, error) : status;
}

/* For each length but the greatest: what the next one is more, of plans whose gap is longer. */
static tn_status add_lengths(tn_weighed_whole *whole, const gaps *g, bool longest, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i + 1 < g->count; i++) {
        int64_t each = (int64_t)(g->length[i + 1] - g->length[i]) * g->part;
        tn_dfa *gap = NULL, *dfa = NULL;
        status = between(g, g->length[i], longest, &gap, error);
        if (status == TN_OK)
            status = with_gap(g, gap, longest, &dfa, error);
        tn_dfa_free(gap);
        if (status == TN_OK)
            status = (longest ? add : add_opposite)(whole, dfa, each, false, error);
    }
    return status;
}

static tn_status ask_gap(tn_weighed_whole *whole, tn_lowering *lowering, const tn_sum_term *term, uint32_t max_trays,
                         tn_error *error)
{
    gaps g = {.marked = tn_lowering_marked(lowering), .term = term};
    const tn_classes *classes = tn_lowering_classes(lowering);
    bool longest = term->kind == TN_SUM_LONGEST_GAP;
    tn_status status = tn_lower_marked(lowering, term->part, &g.source, error);
    if (status == TN_OK)
        status = tn_lower_marked(lowering, term->other, &g.destination, error);
    if (status == TN_OK)
        status = find_counts(&g, classes, error);
    if (status == TN_OK)
        status = find_lengths(&g, classes->count, max_trays > 2 ? max_trays - 2 : 0, error);
    if (status == TN_OK)
        status = add_needed(whole, &g, longest, error);
    if (status == TN_OK)
        status = add_lengths(whole, &g, longest, error);
    tn_dfa_free(g.source);
    tn_dfa_free(g.destination);
    free(g.counts);
    free(g.length);
    return status;
}

tn_status tn_weighed_ask_whole(tn_weighed_whole *whole, tn_lowering *lowering, const tn_sum *sum, uint32_t i,
                               uint32_t max_trays, tn_error *error)
{
    const tn_sum_term *term = &sum->terms[i];
    if (tn_term_is_gap(term->kind))
        return ask_gap(whole, lowering, term, max_trays, error);
    tn_dfa *dfa = NULL;
    tn_status status = tn_lower(lowering, term->part, &dfa, error);
    bool needed = term->kind == TN_SUM_NEEDED;
    return status == TN_OK ? add(whole, dfa, needed ? 0 : term->each, needed, error) : status;
}

void tn_weighed_whole_clear(tn_weighed_whole *whole)
{
    for (size_t i = 0; i < whole->count; i++)
        tn_dfa_free(whole->items[i].dfa);
    free(whole->items);
    *whole = (tn_weighed_whole){0};
}
