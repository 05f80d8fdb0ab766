/* Joint distributions: the values of the plans so far, state by state, one tray after another. */
#include "runtime/plan/measure/crosstab.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/weighed.h"

/* By a letter from a state: all trays that lead alike and add the same. */
typedef struct edge {
    uint32_t target;
    uint64_t trays;
    size_t gains; /* the first of `sums` numbers in the pool */
} edge;

typedef struct node {
    size_t first, count; /* of edges */
    bool found;
} node;

/* Plans of one length that have come to a state with some values: a key of the state and two words for each sum. */
typedef struct crowd {
    tn_interner keys;
    mpz_t *plans;
    size_t count, room;
} crowd;

typedef struct machine {
    const tn_library *library;
    uint32_t measures, sums;
    tn_weighed *weighed[TN_CROSSTAB_MEASURES_MAX];
    uint32_t first_sum[TN_CROSSTAB_MEASURES_MAX + 1];
    tn_interner letters; /* a letter of each measure's automaton */
    uint64_t *trays;     /* [letters] */
    size_t trays_room;
    tn_interner states; /* a state of each */
    node *nodes;
    size_t nodes_room;
    edge *edges;
    size_t edge_count, edges_room;
    int64_t *pool;
    size_t pool_count, pool_room;
    crowd here, next, ended;
    tn_key key;
    size_t most;
} machine;

/* ---- crowds */

static void crowd_forget(crowd *c)
{
    for (size_t i = 0; i < c->count; i++)
        mpz_clear(c->plans[i]);
    c->count = 0;
    tn_interner_clear(&c->keys);
}

static void crowd_clear(crowd *c)
{
    crowd_forget(c);
    free(c->plans);
    *c = (crowd){0};
}

/* The plans of a key, which is new or not; NULL: out of memory. */
static mpz_ptr crowd_at(crowd *c, const tn_key *key)
{
    uint32_t place = tn_intern(&c->keys, key->data, key->size);
    if (place == UINT32_MAX || !tn_array_reserve_from(&c->plans, &c->room, 64, c->count, 1, sizeof *c->plans))
        return NULL;
    if (place == c->count)
        mpz_init(c->plans[c->count++]);
    return c->plans[place];
}

static bool push_number(tn_key *key, int64_t number)
{
    return tn_key_push(key, (uint32_t)((uint64_t)number >> 32)) && tn_key_push(key, (uint32_t)number);
}

static int64_t number_at(const uint32_t *words, size_t number)
{
    return (int64_t)((uint64_t)words[2 * number] << 32 | words[2 * number + 1]);
}

/* ---- states and edges */

/* Groups the trays that are one letter in each automaton. */
static tn_status find_letters(machine *m, tn_error *error)
{
    const tn_schema *schema = tn_library_schema(m->library);
    for (tn_tray tray = 0; tray < schema->tray_count; tray++) {
        m->key.size = 0;
        for (uint32_t k = 0; k < m->measures; k++)
            if (!tn_key_push(&m->key, tn_weighed_letter(m->weighed[k], tray)))
                return tn_fail_memory(error);
        uint32_t known = m->letters.count, letter = tn_intern(&m->letters, m->key.data, m->key.size);
        if (letter == UINT32_MAX || !tn_array_reserve_from(&m->trays, &m->trays_room, 64, known, 1, sizeof *m->trays))
            return tn_fail_memory(error);
        if (letter == known)
            m->trays[letter] = 0;
        m->trays[letter]++;
    }
    return TN_OK;
}

/* The number of a state, which is new or not; UINT32_MAX: out of memory. */
static uint32_t state_number(machine *m, const tn_key *key)
{
    uint32_t known = m->states.count, state = tn_intern(&m->states, key->data, key->size);
    if (state == known) {
        if (!tn_array_reserve_from(&m->nodes, &m->nodes_room, 64, known, 1, sizeof *m->nodes))
            return UINT32_MAX;
        m->nodes[state] = (node){0};
    }
    return state;
}

/* Puts the state that a letter leads to into the key, and what it adds into the pool. *lives: a kept plan follows. */
static tn_status step(machine *m, uint32_t from, uint32_t letter, bool *lives, tn_error *error)
{
    size_t size, sum = m->pool_count;
    if (!tn_array_reserve_from(&m->pool, &m->pool_room, 256, m->pool_count, m->sums, sizeof *m->pool))
        return tn_fail_memory(error);
    m->key.size = 0;
    *lives = true;
    for (uint32_t k = 0; k < m->measures && *lives; k++) {
        uint32_t target, state = tn_interned(&m->states, from, &size)[k];
        int64_t gain[TN_WEIGHED_MAX];
        tn_status status =
            tn_weighed_step(m->weighed[k], state, tn_interned(&m->letters, letter, &size)[k], &target, gain, error);
        if (status != TN_OK)
            return status;
        *lives = target != UINT32_MAX;
        for (uint32_t s = m->first_sum[k]; s < m->first_sum[k + 1]; s++)
            m->pool[sum++] = gain[s - m->first_sum[k]];
        if (!tn_key_push(&m->key, target))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

/* Adds trays to the edge that leads there and adds what is last in the pool; the pool keeps that if the edge is new. */
static tn_status add_edge(machine *m, size_t first, uint32_t target, uint64_t trays, tn_error *error)
{
    for (size_t e = first; e < m->edge_count; e++)
        if (m->edges[e].target == target &&
            memcmp(m->pool + m->edges[e].gains, m->pool + m->pool_count, m->sums * sizeof *m->pool) == 0) {
            m->edges[e].trays += trays;
            return TN_OK;
        }
    if (!tn_array_reserve_from(&m->edges, &m->edges_room, 64, m->edge_count, 1, sizeof *m->edges))
        return tn_fail_memory(error);
    m->edges[m->edge_count++] = (edge){target, trays, m->pool_count};
    m->pool_count += m->sums;
    return TN_OK;
}

static tn_status find_edges(machine *m, uint32_t state, tn_error *error)
{
    size_t first = m->edge_count;
    for (uint32_t letter = 0; letter < m->letters.count; letter++) {
        bool lives = false;
        tn_status status = step(m, state, letter, &lives, error);
        if (status != TN_OK)
            return status;
        uint32_t target = lives ? state_number(m, &m->key) : 0;
        if (target == UINT32_MAX)
            return tn_fail_memory(error);
        status = lives ? add_edge(m, first, target, m->trays[letter], error) : TN_OK;
        if (status != TN_OK)
            return status;
    }
    m->nodes[state] = (node){first, m->edge_count - first, true};
    return TN_OK;
}

/* ---- from one length to the next */

static tn_status too_many(const machine *m, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_VALUES,
            "the plans of library %s come to more than %zu different values tray by tray",
            tn_text(m->library->schema->module, m->library->record->name), m->most);
    tn_error_help(error, "ask measures of fewer different values, or a library of shorter plans");
    return TN_LIMIT;
}

/* Adds the plans at a place of `here` to those of the edge's target. */
static tn_status follow(machine *m, size_t place, const edge *e, tn_error *error)
{
    size_t size;
    const uint32_t *key = tn_interned(&m->here.keys, (uint32_t)place, &size);
    m->key.size = 0;
    bool good = tn_key_push(&m->key, e->target);
    for (uint32_t s = 0; s < m->sums && good; s++)
        good = push_number(&m->key, number_at(key + 1, s) + m->pool[e->gains + s]);
    mpz_ptr plans = good ? crowd_at(&m->next, &m->key) : NULL;
    if (!plans)
        return tn_fail_memory(error);
    mpz_addmul_ui(plans, m->here.plans[place], e->trays);
    return m->next.count > m->most ? too_many(m, error) : TN_OK;
}

static tn_status follow_all(machine *m, tn_error *error)
{
    for (size_t i = 0; i < m->here.count; i++) {
        size_t size;
        uint32_t state = tn_interned(&m->here.keys, (uint32_t)i, &size)[0];
        tn_status status = m->nodes[state].found ? TN_OK : find_edges(m, state, error);
        for (size_t e = 0; status == TN_OK && e < m->nodes[state].count; e++)
            status = follow(m, i, &m->edges[m->nodes[state].first + e], error);
        if (status == TN_OK && i % 256 == 0)
            status = tn_watch_check(m->library->schema->module->watch, error);
        if (status != TN_OK)
            return status;
    }
    crowd spent = m->here;
    m->here = m->next;
    crowd_forget(&spent);
    m->next = spent;
    return TN_OK;
}

/* The values of a plan that ends there: for each measure whether it has one, and its sums, 0 without one. */
static bool ended_key(machine *m, const uint32_t *key)
{
    size_t size;
    const uint32_t *states = tn_interned(&m->states, key[0], &size);
    m->key.size = 0;
    for (uint32_t k = 0; k < m->measures; k++) {
        bool valued = tn_weighed_valued(m->weighed[k], states[k]);
        if (!tn_key_push(&m->key, valued))
            return false;
        for (uint32_t s = m->first_sum[k]; s < m->first_sum[k + 1]; s++) {
            int64_t rest = tn_weighed_rest(m->weighed[k], states[k], s - m->first_sum[k]);
            if (!push_number(&m->key, valued ? number_at(key + 1, s) + rest : 0))
                return false;
        }
    }
    return true;
}

static tn_status end_all(machine *m, tn_error *error)
{
    for (size_t i = 0; i < m->here.count; i++) {
        size_t size;
        const uint32_t *key = tn_interned(&m->here.keys, (uint32_t)i, &size);
        if (!tn_weighed_alive(m->weighed[0], 0, tn_interned(&m->states, key[0], &size)[0]))
            continue;
        mpz_ptr plans = ended_key(m, key) ? crowd_at(&m->ended, &m->key) : NULL;
        if (!plans)
            return tn_fail_memory(error);
        mpz_add(plans, plans, m->here.plans[i]);
        if (m->ended.count > m->most)
            return too_many(m, error);
    }
    return TN_OK;
}

static tn_status begin(machine *m, tn_error *error)
{
    m->key.size = 0;
    bool good = true;
    for (uint32_t k = 0; k < m->measures; k++)
        good = good && tn_key_push(&m->key, 0);
    uint32_t state = good ? state_number(m, &m->key) : UINT32_MAX;
    m->key.size = 0;
    good = state != UINT32_MAX && tn_key_push(&m->key, state);
    for (uint32_t k = 0; k < m->measures; k++)
        for (uint32_t s = m->first_sum[k]; s < m->first_sum[k + 1]; s++)
            good = good && push_number(&m->key, tn_weighed_start(m->weighed[k], s - m->first_sum[k]));
    mpz_ptr plans = good ? crowd_at(&m->here, &m->key) : NULL;
    if (!plans)
        return tn_fail_memory(error);
    mpz_set_ui(plans, 1);
    return TN_OK;
}

static tn_status walk(machine *m, tn_error *error)
{
    tn_status status = begin(m, error);
    for (uint32_t n = 0; status == TN_OK && n <= m->library->max; n++) {
        if (n >= m->library->min)
            status = end_all(m, error);
        if (status == TN_OK && n < m->library->max)
            status = follow_all(m, error);
    }
    return status;
}

/* ---- rows of values */

static int compare_rows(const void *left, const void *right)
{
    const tn_crosstab_row *a = left, *b = right;
    for (uint32_t k = 0; k < a->measures; k++) {
        if (a->valued[k] != b->valued[k])
            return a->valued[k] ? -1 : 1;
        int order = a->valued[k] ? mpq_cmp(a->values[k], b->values[k]) : 0;
        if (order)
            return order;
    }
    return 0;
}

static void read_row(const machine *m, size_t place, tn_crosstab_row *row)
{
    size_t size, at = 0;
    const uint32_t *key = tn_interned(&m->ended.keys, (uint32_t)place, &size);
    for (uint32_t k = 0; k < m->measures; k++) {
        int64_t sums[TN_WEIGHED_MAX] = {0};
        row->valued[k] = key[at++];
        for (uint32_t s = 0; s < m->first_sum[k + 1] - m->first_sum[k]; s++, at += 2)
            sums[s] = number_at(key + at, 0);
        if (row->valued[k])
            tn_weighed_value(m->weighed[k], 0, sums, row->values[k]);
    }
    mpz_set(row->plans, m->ended.plans[place]);
}

/* Quotients of different sums can be one value: such rows become one. */
static void merge_rows(tn_crosstab *table)
{
    size_t kept = 0;
    for (size_t i = 0; i < table->count; i++) {
        if (kept > 0 && compare_rows(&table->rows[kept - 1], &table->rows[i]) == 0) {
            mpz_add(table->rows[kept - 1].plans, table->rows[kept - 1].plans, table->rows[i].plans);
            mpz_clear(table->rows[i].plans);
        } else {
            table->rows[kept++] = table->rows[i];
        }
    }
    table->count = kept;
}

static tn_status make_room(tn_crosstab *table, size_t count, tn_error *error)
{
    size_t numbers = tn_size_of(count, table->measures);
    table->rows = calloc(count + 1, sizeof *table->rows);
    table->values = calloc(numbers + 1, sizeof *table->values);
    table->valued = calloc(numbers + 1, sizeof *table->valued);
    if (!table->rows || !table->values || !table->valued)
        return tn_fail_memory(error);
    for (; table->numbers < numbers; table->numbers++)
        mpq_init(table->values[table->numbers]);
    for (; table->count < count; table->count++) {
        size_t first = table->count * table->measures;
        table->rows[table->count] =
            (tn_crosstab_row){table->values + first, table->valued + first, {{0}}, table->measures};
        mpz_init(table->rows[table->count].plans);
    }
    return TN_OK;
}

static tn_status find_rows(tn_crosstab *table, const machine *m, tn_error *error)
{
    tn_status status = make_room(table, m->ended.count, error);
    for (size_t i = 0; status == TN_OK && i < table->count; i++)
        read_row(m, i, &table->rows[i]);
    if (status != TN_OK || table->count == 0)
        return status;
    qsort(table->rows, table->count, sizeof *table->rows, compare_rows);
    merge_rows(table);
    return TN_OK;
}

/* ---- all of it */

static tn_status weigh(machine *m, const uint32_t *measures, tn_error *error)
{
    for (uint32_t k = 0; k < m->measures; k++) {
        tn_status status = tn_weighed_new(m->library, &measures[k], 1, &m->weighed[k], error);
        if (status != TN_OK)
            return status;
        m->sums += tn_weighed_count(m->weighed[k]);
        m->first_sum[k + 1] = m->sums;
    }
    return TN_OK;
}

static void machine_clear(machine *m)
{
    for (uint32_t k = 0; k < m->measures; k++)
        tn_weighed_free(m->weighed[k]);
    tn_interner_clear(&m->letters);
    tn_interner_clear(&m->states);
    crowd_clear(&m->here);
    crowd_clear(&m->next);
    crowd_clear(&m->ended);
    free(m->trays);
    free(m->nodes);
    free(m->edges);
    free(m->pool);
    free(m->key.data);
}

/* By no measure all plans are one row. */
static tn_status count_plans(tn_crosstab *table, const tn_library *library, tn_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    tn_status status = make_room(table, mpz_sgn(kept) > 0, error);
    if (status == TN_OK && table->count > 0)
        mpz_set(table->rows[0].plans, kept);
    mpz_clear(kept);
    return status;
}

tn_status tn_crosstab_make(tn_crosstab *table, const tn_library *library, const uint32_t *measures, uint32_t count,
                           size_t most, tn_error *error)
{
    *table = (tn_crosstab){.measures = count};
    if (count == 0)
        return count_plans(table, library, error);
    if (count > TN_CROSSTAB_MEASURES_MAX)
        return tn_fail(error, TN_LIMIT, E_TOO_MANY, "%u measures are asked for together, more than the limit of %u",
                       (unsigned)count, TN_CROSSTAB_MEASURES_MAX);
    if (tn_library_min(library) > tn_library_max(library))
        return TN_OK;
    machine m = {.library = library, .measures = count, .most = most ? most : TN_CROSSTAB_VALUES_MAX};
    tn_status status = weigh(&m, measures, error);
    if (status == TN_OK)
        status = find_letters(&m, error);
    if (status == TN_OK)
        status = walk(&m, error);
    if (status == TN_OK)
        status = find_rows(table, &m, error);
    machine_clear(&m);
    return status;
}

void tn_crosstab_clear(tn_crosstab *table)
{
    for (size_t i = 0; i < table->count; i++)
        mpz_clear(table->rows[i].plans);
    for (size_t i = 0; i < table->numbers; i++)
        mpq_clear(table->values[i]);
    free(table->rows);
    free(table->values);
    free(table->valued);
    *table = (tn_crosstab){0};
}
