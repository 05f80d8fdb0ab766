/* Joins automata of measures: a state's key is the state of each. */
#include "runtime/plan/measure/bundle.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/measure/weighed.h"

typedef struct node {
    size_t first, count; /* of edges */
    bool found;
} node;

struct tn_bundle {
    const tn_library *library;
    uint32_t measures, parts, sums;
    tn_weighed *weighed[TN_BUNDLE_MEASURES_MAX]; /* [parts]: one a measure; of no measure the library alone */
    uint32_t first_sum[TN_BUNDLE_MEASURES_MAX + 1];
    tn_interner letters; /* a letter of each part's automaton */
    uint32_t *letter_of; /* [trays] */
    uint64_t *trays;     /* [letters] */
    size_t trays_room;
    tn_interner states; /* a state of each part */
    node *nodes;
    size_t nodes_room;
    tn_bundle_edge *edges;
    size_t edge_count, edges_room;
    int64_t *pool;
    size_t pool_count, pool_room;
    tn_key key;
};

tn_bundle_measure tn_bundle_measure_of(const tn_module *module, const tn_library_record *library, uint32_t measure)
{
    return (tn_bundle_measure){.name = tn_named_measure(module, measure),
                               .sum = tn_named_measure_sum(module, library, measure),
                               .over = tn_named_measure_over(module, measure)};
}

/* ---- making */

static tn_status weigh(tn_bundle *b, const tn_bundle_measure *measures, tn_error *error)
{
    tn_status status = TN_OK;
    b->parts = b->measures ? b->measures : 1;
    if (b->measures == 0)
        return tn_weighed_of_sums(b->library, NULL, NULL, 0, &b->weighed[0], error);
    for (uint32_t k = 0; status == TN_OK && k < b->measures; k++) {
        const uint32_t sums[2] = {measures[k].sum, measures[k].over};
        const char *const names[2] = {measures[k].name, measures[k].name};
        uint32_t count = measures[k].over == TN_NO_RECORD ? 1 : 2;
        status = tn_weighed_of_sums(b->library, sums, names, count, &b->weighed[k], error);
        b->sums += count;
        b->first_sum[k + 1] = b->sums;
    }
    return status;
}

/* Groups the trays that are one letter in each automaton. */
static tn_status find_letters(tn_bundle *b, tn_error *error)
{
    const tn_schema *schema = tn_library_schema(b->library);
    tn_status status = tn_schema_listed(schema, "measuring plans by several measures goes", error);
    if (status != TN_OK)
        return status;
    b->letter_of = calloc((size_t)schema->tray_count + 1, sizeof *b->letter_of);
    if (!b->letter_of)
        return tn_fail_memory(error);
    for (tn_tray tray = 0; tray < schema->tray_count; tray++) {
        b->key.size = 0;
        for (uint32_t k = 0; k < b->parts; k++)
            if (!tn_key_push(&b->key, tn_weighed_letter(b->weighed[k], tray)))
                return tn_fail_memory(error);
        uint32_t known = b->letters.count, letter = tn_intern(&b->letters, b->key.data, b->key.size);
        if (letter == UINT32_MAX || !tn_array_reserve_from(&b->trays, &b->trays_room, 64, known, 1, sizeof *b->trays))
            return tn_fail_memory(error);
        if (letter == known)
            b->trays[letter] = 0;
        b->trays[letter]++;
        b->letter_of[tray] = letter;
    }
    return TN_OK;
}

/* The number of the state that the key says, which is new or not; UINT32_MAX: out of memory. */
static uint32_t state_number(tn_bundle *b)
{
    uint32_t known = b->states.count, state = tn_intern(&b->states, b->key.data, b->key.size);
    if (state == known) {
        if (!tn_array_reserve_from(&b->nodes, &b->nodes_room, 64, known, 1, sizeof *b->nodes))
            return UINT32_MAX;
        b->nodes[state] = (node){0};
    }
    return state;
}

static tn_status make_start(tn_bundle *b, tn_error *error)
{
    b->key.size = 0;
    bool good = true;
    for (uint32_t k = 0; k < b->parts; k++)
        good = good && tn_key_push(&b->key, 0);
    return good && state_number(b) == 0 ? TN_OK : tn_fail_memory(error);
}

tn_status tn_bundle_new(const tn_library *library, const tn_bundle_measure *measures, uint32_t count, tn_bundle **out,
                        tn_error *error)
{
    *out = NULL;
    if (count > TN_BUNDLE_MEASURES_MAX)
        return tn_fail(error, TN_LIMIT, E_TOO_MANY, "%u measures are asked for together, more than the limit of %u",
                       (unsigned)count, TN_BUNDLE_MEASURES_MAX);
    tn_bundle *b = calloc(1, sizeof *b);
    if (!b)
        return tn_fail_memory(error);
    b->library = library;
    b->measures = count;
    tn_status status = weigh(b, measures, error);
    if (status == TN_OK)
        status = find_letters(b, error);
    if (status == TN_OK)
        status = make_start(b, error);
    if (status == TN_OK)
        *out = b;
    else
        tn_bundle_free(b);
    return status;
}

void tn_bundle_free(tn_bundle *b)
{
    if (!b)
        return;
    for (uint32_t k = 0; k < b->parts; k++)
        tn_weighed_free(b->weighed[k]);
    tn_interner_clear(&b->letters);
    tn_interner_clear(&b->states);
    free(b->letter_of);
    free(b->trays);
    free(b->nodes);
    free(b->edges);
    free(b->pool);
    free(b->key.data);
    free(b);
}

/* ---- states and edges */

const tn_library *tn_bundle_library(const tn_bundle *b)
{
    return b->library;
}

uint32_t tn_bundle_sums(const tn_bundle *b)
{
    return b->sums;
}

uint32_t tn_bundle_states(const tn_bundle *b)
{
    return b->states.count;
}

/* The measure that a sum belongs to. */
static uint32_t measure_of(const tn_bundle *b, uint32_t sum)
{
    uint32_t measure = 0;
    while (b->first_sum[measure + 1] <= sum)
        measure++;
    return measure;
}

int64_t tn_bundle_start(const tn_bundle *b, uint32_t sum)
{
    uint32_t k = measure_of(b, sum);
    return tn_weighed_start(b->weighed[k], sum - b->first_sum[k]);
}

uint32_t tn_bundle_letter(const tn_bundle *b, tn_tray tray)
{
    return b->letter_of[tray];
}

uint32_t tn_bundle_letters(const tn_bundle *b)
{
    return b->letters.count;
}

tn_status tn_bundle_step(tn_bundle *b, uint32_t state, uint32_t letter, uint32_t *target, int64_t *gains,
                         tn_error *error)
{
    size_t size;
    b->key.size = 0;
    *target = UINT32_MAX;
    for (uint32_t k = 0; k < b->parts; k++) {
        uint32_t to, from = tn_interned(&b->states, state, &size)[k];
        int64_t gain[TN_WEIGHED_MAX];
        tn_status status =
            tn_weighed_step(b->weighed[k], from, tn_interned(&b->letters, letter, &size)[k], &to, gain, error);
        if (status != TN_OK || to == UINT32_MAX)
            return status;
        for (uint32_t s = b->first_sum[k]; k < b->measures && s < b->first_sum[k + 1]; s++)
            gains[s] = gain[s - b->first_sum[k]];
        if (!tn_key_push(&b->key, to))
            return tn_fail_memory(error);
    }
    *target = state_number(b);
    return *target == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

/* Adds trays to the edge that leads there and adds what is last in the pool; the pool keeps that if the edge is new. */
static tn_status add_edge(tn_bundle *b, size_t first, uint32_t target, uint64_t trays, tn_error *error)
{
    for (size_t e = first; e < b->edge_count; e++)
        if (b->edges[e].target == target &&
            memcmp(b->pool + b->edges[e].gains, b->pool + b->pool_count, b->sums * sizeof *b->pool) == 0) {
            b->edges[e].trays += trays;
            return TN_OK;
        }
    if (!tn_array_reserve_from(&b->edges, &b->edges_room, 64, b->edge_count, 1, sizeof *b->edges))
        return tn_fail_memory(error);
    b->edges[b->edge_count++] = (tn_bundle_edge){target, trays, b->pool_count};
    b->pool_count += b->sums;
    return TN_OK;
}

static tn_status find_edges(tn_bundle *b, uint32_t state, tn_error *error)
{
    size_t first = b->edge_count;
    for (uint32_t letter = 0; letter < b->letters.count; letter++) {
        uint32_t target;
        if (!tn_array_reserve_from(&b->pool, &b->pool_room, 256, b->pool_count, (size_t)b->sums + 1, sizeof *b->pool))
            return tn_fail_memory(error);
        tn_status status = tn_bundle_step(b, state, letter, &target, b->pool + b->pool_count, error);
        if (status == TN_OK && target != UINT32_MAX)
            status = add_edge(b, first, target, b->trays[letter], error);
        if (status != TN_OK)
            return status;
    }
    b->nodes[state] = (node){first, b->edge_count - first, true};
    return TN_OK;
}

tn_status tn_bundle_edges(tn_bundle *b, uint32_t state, const tn_bundle_edge **edges, size_t *count, tn_error *error)
{
    tn_status status = b->nodes[state].found ? TN_OK : find_edges(b, state, error);
    *edges = b->edges ? b->edges + b->nodes[state].first : NULL;
    *count = status == TN_OK ? b->nodes[state].count : 0;
    return status;
}

const int64_t *tn_bundle_gains(const tn_bundle *b, const tn_bundle_edge *edge)
{
    return b->pool + edge->gains;
}

/* ---- where plans end */

/* The state of a part. */
static uint32_t part_state(const tn_bundle *b, uint32_t state, uint32_t part)
{
    size_t size;
    return tn_interned(&b->states, state, &size)[part];
}

bool tn_bundle_ends(const tn_bundle *b, uint32_t state)
{
    return tn_weighed_alive(b->weighed[0], 0, part_state(b, state, 0));
}

bool tn_bundle_valued(const tn_bundle *b, uint32_t state, uint32_t measure)
{
    return tn_weighed_valued(b->weighed[measure], part_state(b, state, measure));
}

int64_t tn_bundle_rest(const tn_bundle *b, uint32_t state, uint32_t sum)
{
    uint32_t k = measure_of(b, sum);
    return tn_weighed_rest(b->weighed[k], part_state(b, state, k), sum - b->first_sum[k]);
}

uint32_t tn_bundle_first(const tn_bundle *b, uint32_t measure)
{
    return b->first_sum[measure];
}

void tn_bundle_value(const tn_bundle *b, uint32_t measure, const int64_t *sums, mpq_t value)
{
    const tn_weighed *weighed = b->weighed[measure];
    const int64_t *own = sums + b->first_sum[measure];
    tn_weighed_value(weighed, 0, own, value);
    if (tn_weighed_count(weighed) == 1)
        return;
    mpq_t divisor;
    mpq_init(divisor);
    tn_weighed_value(weighed, 1, own, divisor);
    mpq_div(value, value, divisor);
    mpq_clear(divisor);
}

/* ---- plans counted by what they come to */

mpz_ptr tn_crowd_at(tn_crowd *c, const tn_key *key)
{
    uint32_t place = tn_intern(&c->keys, key->data, key->size);
    if (place == UINT32_MAX || !tn_array_reserve_from(&c->plans, &c->room, 64, c->count, 1, sizeof *c->plans))
        return NULL;
    if (place == c->count)
        mpz_init(c->plans[c->count++]);
    return c->plans[place];
}

mpz_srcptr tn_crowd_find(const tn_crowd *c, const tn_key *key)
{
    uint32_t place = tn_interner_find(&c->keys, key->data, key->size);
    return place == UINT32_MAX ? NULL : c->plans[place];
}

void tn_crowd_forget(tn_crowd *c)
{
    for (size_t i = 0; i < c->count; i++)
        mpz_clear(c->plans[i]);
    c->count = 0;
    tn_interner_clear(&c->keys);
}

void tn_crowd_clear(tn_crowd *c)
{
    tn_crowd_forget(c);
    free(c->plans);
    *c = (tn_crowd){0};
}

bool tn_key_push_sum(tn_key *key, int64_t sum)
{
    return tn_key_push(key, (uint32_t)((uint64_t)sum >> 32)) && tn_key_push(key, (uint32_t)sum);
}
