/* From a leaving over the plane into the slices behind it, in two stages: to thresholds, where the plane is known and
 * the slice is not, then to arrivals.
 *
 * Most thresholds lead nowhere, and those are not shown. So it is known what each leads to before it is gone on from;
 * that is kept as long as steps begin after the same number of trays. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

void tn_strip_entered_forget(tn_strip_entered *entered)
{
    tn_numbering_clear(&entered->keys);
    free(entered->spans);
    free(entered->arrivals);
    *entered = (tn_strip_entered){0};
}

/* ---- thresholds */

/* An outcome of the plane of the leaving's first state with what is seen from both sides. */
static tn_status find_outcome(tn_strip *strip, const tn_strip_leaving *by, uint64_t facing, uint32_t *outcome,
                              tn_error *error)
{
    size_t size;
    const tn_strip_list *plane;
    bool begins = by->state == TN_STRIP_NONE;
    uint32_t edge = begins ? TN_STRIP_NONE : tn_interned(&strip->states, by->state, &size)[STATE_EDGE];
    tn_status status = tn_strip_plane(strip, edge, tn_high(facing), &plane, error);
    for (size_t i = 0; status == TN_OK && i < plane->count; i++) {
        *outcome = plane->items[i].slice;
        if (strip->outcomes[*outcome].left == by->left && tn_strip_left_fits(strip, *outcome) == by->fits &&
            tn_strip_right_seen(strip, *outcome) == tn_low(facing))
            break;
    }
    return status;
}

static tn_status number_threshold(tn_strip *strip, uint32_t leaving, uint32_t facing, uint32_t *number, tn_error *error)
{
    tn_strip_stages *stages = &strip->stages;
    uint32_t before = stages->thresholds.count, behind = tn_high(stages->leavings.keys[leaving]);
    if (!tn_array_reserve(&stages->crossed_by, &stages->threshold_room, before, 1, sizeof *stages->crossed_by))
        return tn_fail_memory(error);
    *number = tn_number(&stages->thresholds, (uint64_t)behind << 32 | facing);
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (*number < before)
        return TN_OK;
    const tn_strip_leaving *by = &stages->left_by[leaving];
    stages->crossed_by[before].state = by->state;
    return find_outcome(strip, by, stages->facings.keys[facing], &stages->crossed_by[before].outcome, error);
}

/* ---- into the slices */

typedef struct tn_entering_by {
    tn_strip *strip;
    const uint32_t *state, *behind; /* words; state: or NULL */
    uint32_t trays, outcome, fits;
} tn_entering_by;

static tn_status number_arrival(const tn_entering_by *by, uint32_t group, const uint32_t *crossed, uint32_t read,
                                uint32_t *number, tn_error *error)
{
    tn_strip *strip = by->strip;
    tn_key *key = &strip->joined;
    key->size = 0;
    bool ok = tn_key_push(key, group);
    for (uint32_t w = 0; ok && w <= strip->questions.walk_count; w++)
        ok = tn_key_push(key, crossed[CROSSED_ROOMS + w]);
    ok = ok && tn_key_push(key, read) && tn_key_push(key, by->fits);
    *number = ok ? tn_intern(&strip->stages.arrivals, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status keep_arrival(tn_strip_entered *entered, uint32_t arrival, tn_error *error)
{
    if (!tn_array_reserve(&entered->arrivals, &entered->arrival_room, entered->arrival_count, 1,
                          sizeof *entered->arrivals))
        return tn_fail_memory(error);
    entered->arrivals[entered->arrival_count++] = arrival;
    return TN_OK;
}

/* between: what clauses have read of the group's slices by themselves. */
static tn_status enter_group(const tn_entering_by *by, uint32_t group, uint32_t between, tn_error *error)
{
    uint32_t crossed[CROSSED_WALKS + TN_STRIP_MEETINGS_MAX + TN_STRIP_QUESTIONS_MAX], read, arrival;
    tn_strip *strip = by->strip;
    tn_status status =
        tn_strip_cross_outcome(strip, by->state, strip->stages.slices[group], by->outcome, by->behind, crossed, error);
    if (status == TN_OK)
        status = tn_strip_read_plane(strip, by->trays, between, crossed[CROSSED_VALUES], &read, error);
    if (status != TN_OK || read == TN_STRIP_NONE)
        return status;
    status = number_arrival(by, group, crossed, read, &arrival, error);
    return status == TN_OK ? keep_arrival(&strip->stages.entered, arrival, error) : status;
}

/* groups: a list, those together of which clauses read the same. */
static tn_status enter(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t groups, tn_error *error)
{
    size_t size, count;
    const tn_strip_stages *stages = &strip->stages;
    uint64_t place = stages->thresholds.keys[threshold];
    const tn_strip_threshold *crossed = &stages->crossed_by[threshold];
    const uint32_t *behind = tn_interned(&stages->behinds, tn_high(place), &size);
    const uint32_t *list = tn_interned(&stages->lists, groups, &count);
    const tn_entering_by by = {
        .strip = strip,
        .state = crossed->state == TN_STRIP_NONE ? NULL : tn_interned(&strip->states, crossed->state, &size),
        .behind = behind,
        .trays = trays,
        .outcome = crossed->outcome,
        .fits = tn_interned(&stages->rights, tn_low(stages->facings.keys[tn_low(place)]), &size)[RIGHT_FITS]};
    uint32_t bases = TN_STRIP_NONE, between = TN_STRIP_NONE, last = tn_strip_waiting_word(strip) - 1;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t slice = stages->slices[list[i]];
        if (i == 0 || strip->slices[slice].bases != bases)
            status = tn_strip_read_slice(strip, trays, behind[last], slice, &between, error);
        bases = strip->slices[slice].bases;
        if (status == TN_OK && between != TN_STRIP_NONE)
            status = enter_group(&by, list[i], between, error);
    }
    return status;
}

static tn_status enter_once(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t groups, tn_strip_span *span,
                            tn_error *error)
{
    tn_strip_entered *entered = &strip->stages.entered;
    uint32_t before = entered->keys.count;
    if (!tn_array_reserve(&entered->spans, &entered->span_room, before, 1, sizeof *entered->spans))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&entered->keys, (uint64_t)threshold << 32 | groups);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before) {
        size_t first = entered->arrival_count;
        status = enter(strip, trays, threshold, groups, error);
        entered->spans[at] = (tn_strip_span){first, entered->arrival_count - first};
    }
    *span = entered->spans[at];
    return status;
}

/* The arrivals behind a threshold by the groups that its entry has there; none where it has none. */
static tn_status find_arrivals(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t entering,
                               tn_strip_span *span, tn_error *error)
{
    size_t words;
    const tn_strip_stages *stages = &strip->stages;
    const uint32_t *lists = tn_interned(&stages->lists, entering, &words);
    uint32_t entry = tn_high(stages->facings.keys[tn_low(stages->thresholds.keys[threshold])]);
    const uint32_t *own = words > 0 ? bsearch(&entry, lists, words / 2, 2 * sizeof *lists, tn_words_compare) : NULL;
    *span = (tn_strip_span){0};
    if (!own)
        return TN_OK;
    if (strip->stages.entered.trays != trays + 1)
        tn_strip_entered_forget(&strip->stages.entered);
    strip->stages.entered.trays = trays + 1;
    tn_status status = enter_once(strip, trays, threshold, own[1], span, error);
    if (status != TN_OK) /* its span is not known */
        tn_strip_entered_forget(&strip->stages.entered);
    return status;
}

/* ---- the two stages */

tn_status tn_strip_face(tn_strip *strip, uint32_t trays, uint32_t leaving, uint32_t entering, tn_strip_seen *seen,
                        void *context, tn_error *error)
{
    const tn_strip_stages *stages = &strip->stages;
    size_t size;
    const uint32_t *outlook = tn_interned(&stages->outlooks, tn_low(stages->leavings.keys[leaving]), &size);
    tn_status status = TN_OK;
    for (const uint32_t *end = outlook + size; status == TN_OK && outlook < end; outlook += OUTLOOK_WORDS) {
        uint32_t threshold;
        uint64_t times = tn_both(outlook + OUTLOOK_TIMES);
        tn_strip_span span = {0};
        status = number_threshold(strip, leaving, outlook[OUTLOOK_FACING], &threshold, error);
        if (status == TN_OK)
            status = find_arrivals(strip, trays, threshold, entering, &span, error);
        if (status == TN_OK && span.count > 0)
            status = seen(context, threshold, times, times, &(tn_house_gain){{0}}, error);
    }
    return status;
}

tn_status tn_strip_enter(tn_strip *strip, uint32_t trays, uint32_t threshold, uint32_t entering, tn_strip_seen *seen,
                         void *context, tn_error *error)
{
    tn_strip_span span;
    tn_status status = find_arrivals(strip, trays, threshold, entering, &span, error);
    for (size_t i = 0; status == TN_OK && i < span.count; i++)
        status = seen(context, strip->stages.entered.arrivals[span.first + i], 1, 1, &(tn_house_gain){{0}}, error);
    return status;
}
