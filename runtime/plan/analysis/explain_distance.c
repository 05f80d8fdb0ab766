/* Distances, and what lies around: each source with the destinations nearest to it, and what lies between. */
#include "runtime/plan/analysis/explain_data.h"

#define GAPS_MAX 64u /* shown of one distance */

typedef struct looking {
    tn_explaining *e;
    tn_reader_of separator;
    const uint64_t *source, *destination, *between;
    uint32_t node;
    bool near;     /* is one destination whose gap fits enough? */
    bool overlaps; /* do destinations that share a tray with the source count? */
} looking;

/* What separates a source and a destination: nothing, at the source's start, where they overlap (M of `distance`). */
static tn_stretch between(tn_stretch source, tn_stretch destination)
{
    if (destination.end <= source.begin)
        return (tn_stretch){destination.end, source.begin};
    if (source.end <= destination.begin)
        return (tn_stretch){source.end, destination.begin};
    return (tn_stretch){source.begin, source.begin};
}

static tn_status add_gap(const looking *l, tn_stretch source, tn_stretch destination)
{
    tn_gap gap = {.source = source, .destination = destination, .between = between(source, destination)};
    if (l->e->result->nodes[l->node].gap_count >= GAPS_MAX)
        return TN_OK;
    gap.fits = tn_in(l->e, l->between, gap.between);
    tn_status status = tn_explain_number(l->e, l->separator, gap.between, &gap.number);
    return status == TN_OK ? tn_explain_gap(l->e, l->node, gap) : status;
}

static bool overlap(tn_stretch a, tn_stretch b)
{
    return a.begin < b.end && b.begin < a.end;
}

/* Of a source: the first destination whose gap decides; or, where none does, the nearest on either side. */
static tn_status look_from(const looking *l, tn_stretch source)
{
    uint32_t length = l->e->result->length;
    tn_stretch left = {0, 0}, right = {0, 0};
    for (uint32_t a = 0; a < length; a++) {
        const uint64_t *row = l->destination + a * l->e->words;
        for (size_t b = tn_relation_row_next(row, a + 1, l->e->words); b != TN_NO_BIT;
             b = tn_relation_row_next(row, b + 1, l->e->words)) {
            tn_stretch destination = {a, (uint32_t)b};
            if (!l->overlaps && overlap(source, destination))
                continue;
            if (tn_in(l->e, l->between, between(source, destination)) == l->near)
                return add_gap(l, source, destination);
            if (destination.end <= source.begin && (left.end == 0 || destination.end > left.end))
                left = destination;
            if (destination.begin >= source.end && right.end == 0)
                right = destination;
        }
    }
    tn_status status = left.end ? add_gap(l, source, left) : TN_OK;
    return status == TN_OK && right.end ? add_gap(l, source, right) : status;
}

tn_status tn_explain_distance(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch)
{
    const tn_part *part = tn_part_of(e, who);
    tn_reader_of source = tn_child(who, part->first);
    tn_reader_of destination = tn_child(who, tn_part_of(e, source)->next);
    looking l = {.e = e,
                 .separator = tn_child(who, tn_part_of(e, destination)->next),
                 .node = node,
                 .near = part->kind == TN_PART_NEAR,
                 .overlaps = part->kind == TN_PART_DISTANCE};
    tn_status status = tn_explain_relation(e, source, &l.source);
    if (status == TN_OK)
        status = tn_explain_relation(e, destination, &l.destination);
    if (status == TN_OK)
        status = tn_explain_relation(e, l.separator, &l.between);
    if (status != TN_OK)
        return status;
    bool matched = e->result->nodes[node].matched;
    uint32_t made;
    status = tn_explain_part(e, source, stretch, matched ? TN_ASKED_AS_WRITTEN : TN_ASKED_SOMEWHERE, node, &made);
    tn_stretch plan = {0, e->result->length};
    uint32_t targets;
    if (status == TN_OK)
        status = tn_explain_part(e, destination, plan, TN_ASKED_SOMEWHERE, node, &targets);
    if (status != TN_OK || matched)
        return status == TN_OK ? look_from(&l, stretch) : status;
    tn_why found = e->result->nodes[made];
    for (uint32_t i = 0; status == TN_OK && i < found.stretch_count; i++)
        status = look_from(&l, e->result->stretches[found.stretch_first + i]);
    return status;
}
