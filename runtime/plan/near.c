#include "runtime/plan/near.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/library_data.h"
#include "runtime/plan/numbering.h"

#define FAR UINT32_MAX

/* A node: so many trays of the plan read, so many written, and the library's automaton in this state. Every step goes
 * on in the one, the other, or both. */
typedef struct node {
    uint32_t state, read, written;
    uint32_t cost; /* from the start */
    bool settled;
    bool leads; /* on a shortest path to a plan of the length at hand */
} node;

typedef struct bucket {
    uint32_t *nodes;
    size_t count, capacity;
} bucket;

typedef struct search {
    const tn_library *library;
    const tn_schema *schema;
    const tn_tray *trays;
    uint32_t length, fields, columns;
    uint32_t *change; /* [length][columns]: fewest fields to change for a tray of that column */
    tn_numbering numbers;
    node *nodes;
    size_t capacity;
    bucket *buckets; /* by cost so far and the least that is still to come */
    size_t bucket_count;
    uint32_t best; /* the shortest path, or FAR */
    tn_error *error;
} search;

uint32_t tn_tray_distance(const tn_schema *schema, tn_tray a, tn_tray b)
{
    uint32_t distance = 0;
    for (uint32_t f = 0; f < schema->field_count; f++)
        distance += tn_tray_value(schema, a, f) != tn_tray_value(schema, b, f);
    return distance;
}

static tn_status make_changes(search *s)
{
    s->change = malloc(((size_t)s->length * s->columns + 1) * sizeof *s->change);
    if (!s->change)
        return tn_fail_memory(s->error);
    memset(s->change, 0xff, (size_t)s->length * s->columns * sizeof *s->change);
    for (uint32_t i = 0; i < s->length; i++) {
        uint32_t *row = s->change + (size_t)i * s->columns;
        uint32_t same = 0;
        while (s->trays[same] != s->trays[i])
            same++;
        if (same < i) {
            memcpy(row, s->change + (size_t)same * s->columns, s->columns * sizeof *row);
            continue;
        }
        for (tn_tray t = 0; t < s->schema->tray_count; t++) {
            uint32_t *least = &row[s->library->tray_column[t]];
            uint32_t distance = tn_tray_distance(s->schema, s->trays[i], t);
            *least = distance < *least ? distance : *least;
        }
    }
    return TN_OK;
}

/* The least that trays added or removed will cost: exact as far as lengths go, so never too much. */
static uint32_t to_come(const search *s, uint32_t read, uint32_t written)
{
    uint32_t left = s->length - read, min = s->library->min, max = s->library->max;
    uint32_t low = written < min ? min - written : 0, high = max - written;
    uint32_t trays = left < low ? low - left : left > high ? left - high : 0;
    return trays * s->fields;
}

/* Can a plan still be finished from here? */
static bool is_alive(const search *s, uint32_t state, uint32_t written)
{
    uint32_t min = s->library->min, low = written < min ? min - written : 0;
    for (uint32_t left = low; left + written <= s->library->max; left++)
        if (tn_library_alive(s->library, left, state))
            return true;
    return false;
}

static tn_status put(search *s, size_t cost, uint32_t number)
{
    if (cost >= s->bucket_count) {
        size_t count = cost * 2 + 16;
        bucket *larger = realloc(s->buckets, count * sizeof *larger);
        if (!larger)
            return tn_fail_memory(s->error);
        memset(larger + s->bucket_count, 0, (count - s->bucket_count) * sizeof *larger);
        s->buckets = larger;
        s->bucket_count = count;
    }
    bucket *b = &s->buckets[cost];
    if (b->count == b->capacity) {
        size_t capacity = b->capacity * 2 + 16;
        uint32_t *larger = realloc(b->nodes, capacity * sizeof *larger);
        if (!larger)
            return tn_fail_memory(s->error);
        b->nodes = larger;
        b->capacity = capacity;
    }
    b->nodes[b->count++] = number;
    return TN_OK;
}

static uint64_t key_of(const search *s, uint32_t state, uint32_t read, uint32_t written)
{
    return ((uint64_t)state * ((uint64_t)s->length + 1) + read) * ((uint64_t)s->library->max + 1) + written;
}

static tn_status reach(search *s, uint32_t state, uint32_t read, uint32_t written, uint32_t cost)
{
    uint32_t before = s->numbers.count;
    uint32_t number = tn_number(&s->numbers, key_of(s, state, read, written));
    if (number == UINT32_MAX)
        return tn_fail_memory(s->error);
    if (number == before) {
        if (number >= TN_NEAR_NODES_MAX)
            return tn_fail(s->error, TN_LIMIT, 808,
                           "the search for the nearest kept plan visits more than the limit of %u places",
                           TN_NEAR_NODES_MAX);
        if (number >= s->capacity) {
            size_t capacity = s->capacity * 2 + 256;
            node *larger = realloc(s->nodes, capacity * sizeof *larger);
            if (!larger)
                return tn_fail_memory(s->error);
            s->nodes = larger;
            s->capacity = capacity;
        }
        s->nodes[number] = (node){
            .state = state, .read = read, .written = written, .cost = FAR, .settled = !is_alive(s, state, written)};
    }
    node *n = &s->nodes[number];
    if (n->settled || cost >= n->cost)
        return TN_OK;
    n->cost = cost;
    return put(s, (size_t)cost + to_come(s, read, written), number);
}

static bool is_goal(const search *s, const node *n)
{
    return n->read == s->length && n->written >= s->library->min && s->library->kept->accept[n->state];
}

/* Goes on from a node in every way. */
static tn_status expand(search *s, node from)
{
    tn_status status = TN_OK;
    bool reads = from.read < s->length;
    if (reads)
        status = reach(s, from.state, from.read + 1, from.written, from.cost + s->fields);
    if (from.written == s->library->max)
        return status;
    const uint32_t *row = s->library->kept->delta + (size_t)from.state * s->columns;
    const uint32_t *change = s->change + (size_t)from.read * s->columns;
    for (uint32_t c = 0; status == TN_OK && c < s->columns; c++) {
        if (reads && change[c] != FAR)
            status = reach(s, row[c], from.read + 1, from.written + 1, from.cost + change[c]);
        if (status == TN_OK)
            status = reach(s, row[c], from.read, from.written + 1, from.cost + s->fields);
    }
    return status;
}

/* Settles every node that a shortest path may go through. */
static tn_status settle(search *s)
{
    tn_status status = TN_OK;
    if (s->library->min <= s->library->max)
        status = reach(s, 0, 0, 0, 0);
    for (size_t cost = 0; status == TN_OK && cost < s->bucket_count && cost <= s->best; cost++) {
        for (size_t i = 0; status == TN_OK && i < s->buckets[cost].count; i++) {
            node *n = &s->nodes[s->buckets[cost].nodes[i]];
            if (n->settled)
                continue;
            n->settled = true;
            if (is_goal(s, n))
                s->best = n->cost;
            status = expand(s, *n);
        }
    }
    return status;
}

/* ---- from the shortest paths to plans, in rank order */

static const node *node_at(const search *s, uint32_t state, uint32_t read, uint32_t written)
{
    uint32_t number = tn_number_find(&s->numbers, key_of(s, state, read, written));
    return number != UINT32_MAX ? &s->nodes[number] : NULL;
}

static bool leads_on(const search *s, uint32_t state, uint32_t read, uint32_t written, uint32_t cost)
{
    const node *n = node_at(s, state, read, written);
    return n && n->leads && n->cost == cost;
}

static bool leads(const search *s, const node *n, uint32_t length)
{
    if (!n->settled || n->cost > s->best || n->written > length)
        return false;
    bool reads = n->read < s->length;
    if (is_goal(s, n) && n->written == length && n->cost == s->best)
        return true;
    if (reads && leads_on(s, n->state, n->read + 1, n->written, n->cost + s->fields))
        return true;
    if (n->written == length)
        return false;
    const uint32_t *row = s->library->kept->delta + (size_t)n->state * s->columns;
    const uint32_t *change = s->change + (size_t)n->read * s->columns;
    for (uint32_t c = 0; c < s->columns; c++) {
        if (reads && change[c] != FAR && leads_on(s, row[c], n->read + 1, n->written + 1, n->cost + change[c]))
            return true;
        if (leads_on(s, row[c], n->read, n->written + 1, n->cost + s->fields))
            return true;
    }
    return false;
}

/* Marks what leads to plans of one length; `order` has the nodes by how far they have gone, the farthest first. */
static void mark(search *s, const uint32_t *order, uint32_t count, uint32_t length)
{
    for (uint32_t i = 0; i < count; i++)
        s->nodes[i].leads = false;
    for (uint32_t i = 0; i < count; i++)
        s->nodes[order[i]].leads = leads(s, &s->nodes[order[i]], length);
}

/* Orders the nodes by counting. */
static tn_status order_nodes(const search *s, uint32_t **out)
{
    size_t steps = (size_t)s->length + s->library->max + 1;
    uint32_t count = s->numbers.count;
    size_t *first = calloc(steps + 2, sizeof *first);
    *out = malloc(((size_t)count + 1) * sizeof **out);
    if (!first || !*out) {
        free(first);
        return tn_fail_memory(s->error);
    }
    for (uint32_t i = 0; i < count; i++)
        first[steps - s->nodes[i].read - s->nodes[i].written + 1]++;
    for (size_t k = 1; k <= steps + 1; k++)
        first[k] += first[k - 1];
    for (uint32_t i = 0; i < count; i++)
        (*out)[first[steps - s->nodes[i].read - s->nodes[i].written]++] = i;
    free(first);
    return TN_OK;
}

/* A plan being written: after each tray, what it costs to have read so much of the given one (the row of the usual
 * table of edit distances). */
typedef struct writing {
    tn_tray *trays;   /* [max] */
    uint32_t *states; /* [max + 1] */
    uint32_t *rows;   /* [max + 1][length + 1] */
} writing;

static void next_row(const search *s, const uint32_t *row, tn_tray tray, uint32_t *next)
{
    next[0] = row[0] + s->fields;
    for (uint32_t p = 1; p <= s->length; p++) {
        uint32_t change = row[p - 1] + tn_tray_distance(s->schema, s->trays[p - 1], tray);
        uint32_t add = row[p] + s->fields, leave = next[p - 1] + s->fields;
        next[p] = change < add ? change : add;
        next[p] = next[p] < leave ? next[p] : leave;
    }
}

static bool row_leads(const search *s, uint32_t state, uint32_t written, const uint32_t *row)
{
    for (uint32_t p = 0; p <= s->length; p++)
        if (row[p] <= s->best && leads_on(s, state, p, written, row[p]))
            return true;
    return false;
}

static tn_status add_plan(const search *s, const writing *w, uint32_t length, tn_near *near)
{
    tn_near_plan *larger = realloc(near->plans, (near->count + 1) * sizeof *larger);
    tn_tray *copy = malloc(((size_t)length + 1) * sizeof *copy);
    near->plans = larger ? larger : near->plans;
    if (!larger || !copy) {
        free(copy);
        return tn_fail_memory(s->error);
    }
    if (length)
        memcpy(copy, w->trays, length * sizeof *copy);
    near->plans[near->count++] = (tn_near_plan){copy, length};
    return TN_OK;
}

/* Writes the plans of one length in order: each time the first tray, from the one at hand on, that still leads there.
 */
static tn_status write_plans(const search *s, writing *w, uint32_t length, size_t most, tn_near *near)
{
    size_t width = (size_t)s->length + 1;
    uint32_t at = 0;
    if (!row_leads(s, 0, 0, w->rows))
        return TN_OK;
    w->trays[0] = 0;
    for (;;) {
        if (at == length) {
            if (near->count == most) {
                near->more = true;
                return TN_OK;
            }
            tn_status status = add_plan(s, w, length, near);
            if (status != TN_OK || length == 0)
                return status;
            w->trays[--at]++;
        }
        uint32_t *row = w->rows + at * width;
        tn_tray *tray = &w->trays[at];
        for (; *tray < s->schema->tray_count; ++*tray) {
            w->states[at + 1] = tn_library_step(s->library, w->states[at], *tray);
            next_row(s, row, *tray, row + width);
            if (row_leads(s, w->states[at + 1], at + 1, row + width))
                break;
        }
        if (*tray < s->schema->tray_count) {
            if (++at < length)
                w->trays[at] = 0;
        } else if (at == 0) {
            return TN_OK;
        } else {
            w->trays[--at]++;
        }
    }
}

static tn_status collect(search *s, size_t most, tn_near *near)
{
    size_t rows = (size_t)s->library->max + 1, width = (size_t)s->length + 1;
    uint32_t *order = NULL, count = s->numbers.count;
    writing w = {malloc(rows * sizeof *w.trays), calloc(rows, sizeof *w.states), malloc(rows * width * sizeof *w.rows)};
    tn_status status = w.trays && w.states && w.rows ? order_nodes(s, &order) : tn_fail_memory(s->error);
    for (uint32_t p = 0; status == TN_OK && p <= s->length; p++)
        w.rows[p] = p * s->fields;
    for (uint32_t length = s->library->min; status == TN_OK && length <= s->library->max && !near->more; length++) {
        mark(s, order, count, length);
        status = write_plans(s, &w, length, most, near);
    }
    free(order);
    free(w.trays);
    free(w.states);
    free(w.rows);
    return status;
}

static void search_clear(search *s)
{
    for (size_t i = 0; i < s->bucket_count; i++)
        free(s->buckets[i].nodes);
    free(s->buckets);
    free(s->nodes);
    free(s->change);
    tn_numbering_clear(&s->numbers);
}

tn_status tn_library_near(const tn_library *library, const tn_tray *trays, size_t length, size_t most, tn_near *near,
                          tn_error *error)
{
    *near = (tn_near){0};
    search s = {.library = library,
                .schema = library->schema,
                .trays = trays,
                .length = (uint32_t)length,
                .fields = library->schema->field_count,
                .columns = library->kept->columns,
                .best = FAR,
                .error = error};
    tn_status status = make_changes(&s);
    if (status == TN_OK)
        status = settle(&s);
    if (status == TN_OK && s.best != FAR) {
        near->cost = s.best;
        status = collect(&s, most, near);
    }
    search_clear(&s);
    return status;
}

void tn_near_clear(tn_near *near)
{
    for (size_t i = 0; i < near->count; i++)
        free(near->plans[i].trays);
    free(near->plans);
    *near = (tn_near){0};
}
