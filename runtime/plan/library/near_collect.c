/* From the shortest paths of a search for near plans to the plans, in rank order. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/near_data.h"

#define LENGTHS_AT_ONCE 64u

/* A plan being written: after each tray, what it costs to have read so much of the given one (the row of the usual
 * table of edit distances). */
typedef struct writing {
    tn_tray *trays;   /* [max] */
    uint32_t *states; /* [max + 1][parts] */
    uint32_t *rows;   /* [max + 1][length + 1] */
} writing;

static const tn_near_node *node_at(const tn_near_search *s, uint32_t tuple, uint32_t read, uint32_t written)
{
    size_t cell = tn_near_cell(&s->band, read, written);
    if (cell == SIZE_MAX)
        return NULL;
    uint32_t number = tn_number_find(&s->numbers, tn_near_key(s, tuple, cell));
    return number != UINT32_MAX ? &s->nodes[number] : NULL;
}

/* Where a node's cell is. */
static uint32_t written_of(const tn_near_search *s, const tn_near_node *node, uint32_t *read)
{
    uint32_t row = 2 * s->band.width + 1;
    *read = node->cell / row;
    return *read + node->cell % row - s->band.width;
}

static bool accepts(const tn_near_search *s, const uint32_t *states)
{
    bool good = true;
    for (size_t k = 0; good && k < s->finder->part_count; k++)
        good = s->finder->parts[k].live->accept[states[k]];
    return good;
}

/* Which lengths, of 64 from `lowest` on, each node leads to on a shortest path. Edges were added in the order of the
 * nodes that they go out of, so that backwards each node is known before those that lead to it. */
static void mark(tn_near_search *s, uint32_t lowest)
{
    s->lowest = lowest;
    for (uint32_t n = 0; n < s->numbers.count; n++) {
        tn_near_node *node = &s->nodes[n];
        uint32_t read, written = written_of(s, node, &read);
        size_t size;
        bool ends = read == s->band.length && written >= s->band.min && node->cost == s->best && written >= lowest &&
                    written - lowest < LENGTHS_AT_ONCE && accepts(s, tn_interned(&s->tuples, node->tuple, &size));
        node->lengths = ends ? UINT64_C(1) << (written - lowest) : 0;
    }
    for (size_t e = s->edge_count; e-- > 0;) {
        const tn_near_edge *edge = &s->edges[e];
        if (s->nodes[edge->from].cost + edge->cost == s->nodes[edge->to].cost)
            s->nodes[edge->from].lengths |= s->nodes[edge->to].lengths;
    }
}

static void next_row(const tn_near_search *s, const uint32_t *row, tn_tray tray, uint32_t *next)
{
    uint32_t fields = s->band.fields;
    next[0] = row[0] + fields;
    for (uint32_t p = 1; p <= s->band.length; p++) {
        uint32_t change = row[p - 1] + tn_tray_distance(s->finder->schema, s->trays[p - 1], tray);
        uint32_t add = row[p] + fields, leave = next[p - 1] + fields;
        next[p] = change < add ? change : add;
        next[p] = next[p] < leave ? next[p] : leave;
    }
}

/* Does some place of the plan, read so far at the cost in the row, lead on to a plan of this length? *failed: out of
 * memory. */
static bool row_leads(tn_near_search *s, const uint32_t *states, uint32_t written, const uint32_t *row, uint32_t length,
                      bool *failed)
{
    uint32_t tuple = UINT32_MAX;
    for (uint32_t p = 0; p <= s->band.length; p++) {
        if (row[p] > s->best)
            continue;
        if (tuple == UINT32_MAX)
            tuple = tn_intern(&s->tuples, states, s->finder->part_count);
        *failed = tuple == UINT32_MAX;
        const tn_near_node *node = *failed ? NULL : node_at(s, tuple, p, written);
        if (node && node->cost == row[p] && (node->lengths >> (length - s->lowest) & 1))
            return true;
    }
    return false;
}

static bool step(const tn_near_finder *finder, const uint32_t *states, tn_tray tray, uint32_t *next)
{
    uint32_t joint = finder->joint_of[finder->classes->of_tray[tray]];
    const uint32_t *labels = finder->joint_label + joint * finder->part_count;
    bool on = true;
    for (size_t k = 0; on && k < finder->part_count; k++) {
        const tn_near_part *part = &finder->parts[k];
        next[k] = part->delta[(size_t)states[k] * part->live->columns + labels[k]];
        on = next[k] != TN_NO_STATE;
    }
    return on;
}

static tn_status add_plan(const tn_near_search *s, const writing *w, uint32_t length, tn_near *near)
{
    tn_tray *copy = malloc(((size_t)length + 1) * sizeof *copy);
    if (!copy || !tn_array_resize(&near->plans, near->count + 1, sizeof *near->plans)) {
        free(copy);
        return tn_fail_memory(s->error);
    }
    if (length)
        memcpy(copy, w->trays, length * sizeof *copy);
    near->plans[near->count++] = (tn_near_plan){copy, length};
    return TN_OK;
}

/* Moves the tray at `at` on to the first, from the one there, that still leads to a plan of this length. */
static bool find_tray(tn_near_search *s, writing *w, uint32_t at, uint32_t length, bool *failed)
{
    size_t width = (size_t)s->band.length + 1, parts = s->finder->part_count;
    const uint32_t *row = w->rows + at * width, *states = w->states + at * parts;
    for (tn_tray *tray = &w->trays[at]; !*failed && *tray < s->finder->schema->tray_count; ++*tray) {
        uint32_t *next = w->states + (at + 1) * parts, *next_costs = w->rows + (at + 1) * width;
        if (!step(s->finder, states, *tray, next))
            continue;
        next_row(s, row, *tray, next_costs);
        if (row_leads(s, next, at + 1, next_costs, length, failed))
            return true;
    }
    return false;
}

static tn_status write_plans(tn_near_search *s, writing *w, uint32_t length, size_t most, tn_near *near)
{
    uint32_t at = 0;
    bool failed = false;
    tn_status status = TN_OK;
    if (!row_leads(s, w->states, 0, w->rows, length, &failed))
        return failed ? tn_fail_memory(s->error) : TN_OK;
    w->trays[0] = 0;
    while (status == TN_OK) {
        if (at == length) {
            near->more = near->count == most;
            if (near->more)
                return TN_OK;
            status = add_plan(s, w, length, near);
            if (length == 0)
                return status;
            w->trays[--at]++;
        }
        if (find_tray(s, w, at, length, &failed)) {
            if (++at < length)
                w->trays[at] = 0;
        } else if (at == 0 || failed) {
            return failed ? tn_fail_memory(s->error) : status;
        } else {
            w->trays[--at]++;
        }
    }
    return status;
}

tn_status tn_near_collect(tn_near_search *s, size_t most, tn_near *near)
{
    const tn_near_band *band = &s->band;
    uint32_t low = band->length > band->width ? band->length - band->width : 0, high = band->length + band->width;
    low = low > band->min ? low : band->min;
    high = high < band->max ? high : band->max;
    size_t rows = (size_t)high + 2, width = (size_t)band->length + 1;
    writing w = {malloc(rows * sizeof *w.trays), calloc(tn_size_of(rows, s->finder->part_count), sizeof *w.states),
                 tn_array_new(tn_size_of(rows, width), sizeof *w.rows)};
    tn_status status = w.trays && w.states && w.rows ? TN_OK : tn_fail_memory(s->error);
    for (uint32_t p = 0; status == TN_OK && p <= band->length; p++)
        w.rows[p] = p * band->fields;
    for (uint32_t length = low; status == TN_OK && length <= high && !near->more; length++) {
        if ((length - low) % LENGTHS_AT_ONCE == 0)
            mark(s, length);
        status = write_plans(s, &w, length, most, near);
    }
    free(w.trays);
    free(w.states);
    free(w.rows);
    return status;
}
