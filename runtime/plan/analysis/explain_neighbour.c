/* Neighbours: where each part lies, or how many side by side could be found. And what is repeated: where each of its
 * stretches lies. */
#include <stdlib.h>

#include "runtime/plan/analysis/explain_data.h"

/* A neighbour's parts from left to right on the plan as it is: mirrored, they lie the other way round. */
typedef struct row_of_parts {
    tn_reader_of *who;
    const uint64_t **relation;
    uint32_t count;
} row_of_parts;

static void row_clear(row_of_parts *row)
{
    free(row->who);
    free(row->relation);
}

static tn_status row_make(tn_explaining *e, tn_reader_of neighbour, row_of_parts *row)
{
    const tn_part *part = tn_part_of(e, neighbour);
    *row = (row_of_parts){malloc((part->child_count + 1) * sizeof *row->who),
                          malloc((part->child_count + 1) * sizeof *row->relation), part->child_count};
    if (!row->who || !row->relation)
        return tn_fail_memory(e->error);
    uint32_t child = part->first;
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < row->count; k++) {
        uint32_t at = neighbour.mirrored ? row->count - 1 - k : k;
        row->who[at] = tn_child(neighbour, child);
        child = tn_part_of(e, row->who[at])->next;
        status = tn_explain_relation(e, row->who[at], &row->relation[at]);
    }
    return status;
}

static bool is_optional(const tn_explaining *e, const row_of_parts *row, uint32_t k)
{
    return tn_part_of(e, row->who[k])->optional;
}

/* The first end at or after `from` such that part k matches [i, end) and the parts after it can go on from there. */
static uint32_t next_cut(const tn_explaining *e, const row_of_parts *row, const uint8_t *fits, uint32_t k, uint32_t i,
                         uint32_t places)
{
    const uint64_t *bits = row->relation[k] + i * e->words;
    for (size_t end = tn_relation_row_next(bits, i + 1, e->words); end != TN_NO_BIT;
         end = tn_relation_row_next(bits, end + 1, e->words))
        if (fits[(size_t)(k + 1) * places + end])
            return (uint32_t)end;
    return UINT32_MAX;
}

/* fits[k][i]: can the parts first + k .. last - 1 fill [i, end)? */
static void fill(const tn_explaining *e, const row_of_parts *row, uint32_t first, uint32_t last, uint32_t end,
                 uint8_t *fits)
{
    uint32_t places = e->result->length + 1;
    fits[(size_t)last * places + end] = 1;
    for (uint32_t k = last; k-- > first;)
        for (uint32_t i = 0; i <= end; i++)
            fits[(size_t)k * places + i] = next_cut(e, row, fits, k, i, places) != UINT32_MAX ||
                                           (is_optional(e, row, k) && fits[(size_t)(k + 1) * places + i]);
}

tn_status tn_explain_neighbour(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch)
{
    row_of_parts row;
    tn_status status = row_make(e, who, &row);
    uint32_t places = e->result->length + 1, at = stretch.begin;
    uint8_t *fits = calloc(((size_t)row.count + 1) * places, 1);
    if (status == TN_OK && !fits)
        status = tn_fail_memory(e->error);
    if (status == TN_OK)
        fill(e, &row, 0, row.count, stretch.end, fits);
    for (uint32_t k = 0; status == TN_OK && k < row.count; k++) {
        uint32_t end = next_cut(e, &row, fits, k, at, places), made;
        if (end == UINT32_MAX) { /* left out */
            status = tn_explain_part(e, row.who[k], (tn_stretch){at, at}, TN_ASKED_AS_WRITTEN, node, &made);
            if (status == TN_OK) {
                e->result->nodes[made].absent = true;
                e->result->nodes[made].matched = true;
            }
            continue;
        }
        status = tn_explain_part(e, row.who[k], (tn_stretch){at, end}, TN_ASKED_AS_WRITTEN, node, &made);
        at = end;
    }
    free(fits);
    row_clear(&row);
    return status;
}

/* How many parts from `first` on fit side by side from place i, and where they can end. */
static uint32_t run_from(const tn_explaining *e, const row_of_parts *row, uint32_t first, uint32_t i, uint32_t limit,
                         uint8_t *now, uint8_t *next, uint32_t *end)
{
    uint32_t places = e->result->length + 1, length = 0;
    memset(now, 0, places);
    now[i] = 1;
    *end = i;
    for (uint32_t k = first; k < row->count; k++) {
        bool any = false;
        uint32_t reached = 0;
        memset(next, 0, places);
        for (uint32_t p = i; p <= limit; p++) {
            if (!now[p])
                continue;
            const uint64_t *bits = row->relation[k] + p * e->words;
            for (size_t to = tn_relation_row_next(bits, p + 1, e->words); to != TN_NO_BIT && to <= limit;
                 to = tn_relation_row_next(bits, to + 1, e->words)) {
                reached = any ? reached : (uint32_t)to;
                any = true;
                next[to] = 1;
            }
        }
        if (!any)
            break;
        memcpy(now, next, places);
        *end = reached;
        length++;
    }
    return length;
}

/* The longest run, the leftmost of several. */
static void find_run(tn_explaining *e, const row_of_parts *row, uint32_t node, bool mirrored, uint8_t *room)
{
    tn_why *why = &e->result->nodes[node];
    uint32_t places = e->result->length + 1;
    for (uint32_t first = 0; first < row->count; first++) {
        for (uint32_t i = why->region.begin; i < why->region.end; i++) {
            uint32_t end, length = run_from(e, row, first, i, why->region.end, room, room + places, &end);
            if (length <= why->run_count)
                continue;
            why->run_count = length;
            why->run_first = mirrored ? row->count - first - length : first;
            why->run = (tn_stretch){i, end};
        }
    }
}

tn_status tn_explain_no_neighbour(tn_explaining *e, tn_reader_of who, uint32_t node)
{
    row_of_parts row;
    tn_status status = row_make(e, who, &row);
    uint8_t *room = malloc(2 * ((size_t)e->result->length + 1));
    if (status == TN_OK && !room)
        status = tn_fail_memory(e->error);
    if (status == TN_OK)
        find_run(e, &row, node, who.mirrored, room);
    tn_stretch region = e->result->nodes[node].region;
    for (uint32_t k = 0; status == TN_OK && k < row.count; k++) {
        uint32_t made;
        status = tn_explain_part(e, row.who[k], region, TN_ASKED_SOMEWHERE, node, &made);
    }
    free(room);
    row_clear(&row);
    return status;
}

/* ---- what is repeated */

/* The first end behind `at` of a stretch of the relation from which `left` more lead on to the end (fits[n][i]: n of
 * them fill [i, end)). */
static uint32_t next_repeat(const tn_explaining *e, const uint64_t *relation, const uint8_t *fits, uint32_t left,
                            uint32_t at, uint32_t places)
{
    const uint64_t *bits = relation + at * e->words;
    size_t end = tn_relation_row_next(bits, at + 1, e->words);
    while (end != TN_NO_BIT && !fits[(size_t)left * places + end])
        end = end + 1 < places ? tn_relation_row_next(bits, end + 1, e->words) : TN_NO_BIT;
    return end == TN_NO_BIT ? UINT32_MAX : (uint32_t)end;
}

/* As few as fill it, from the left each as short as it can be. */
tn_status tn_explain_repeat(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch)
{
    const tn_part *part = tn_part_of(e, who);
    tn_reader_of each = tn_child(who, part->first);
    uint32_t least = part->least, places = e->result->length + 1, most = stretch.end - stretch.begin, count = 0;
    const uint64_t *relation;
    tn_status status = tn_explain_relation(e, each, &relation);
    uint8_t *fits = calloc((size_t)most + 1, places);
    if (status == TN_OK && !fits)
        status = tn_fail_memory(e->error);
    if (status == TN_OK)
        fits[stretch.end] = 1;
    while (status == TN_OK && count < most && !(count >= least && fits[(size_t)count * places + stretch.begin])) {
        for (uint32_t i = stretch.begin; i < stretch.end; i++)
            fits[((size_t)count + 1) * places + i] = next_repeat(e, relation, fits, count, i, places) != UINT32_MAX;
        count++;
    }
    for (uint32_t at = stretch.begin; status == TN_OK && count > 0;) {
        uint32_t end = next_repeat(e, relation, fits, --count, at, places), made;
        status = end == UINT32_MAX ? TN_OK
                                   : tn_explain_part(e, each, (tn_stretch){at, end}, TN_ASKED_AS_WRITTEN, node, &made);
        at = end;
    }
    free(fits);
    return status;
}
