/* Joint distributions: the values of the plans so far, state by state, one tray after another. */
#include "runtime/plan/measure/crosstab.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/integers.h"
#include "runtime/plan/library/library_data.h"

typedef struct machine {
    tn_bundle *bundle;
    uint32_t measures, sums;
    tn_crowd here, next, ended; /* of one length by states; those that end by whether there are values */
    tn_key key;
    size_t most;
} machine;

/* ---- from one length to the next */

static tn_status too_many(const machine *m, tn_error *error)
{
    const tn_library *library = tn_bundle_library(m->bundle);
    tn_fail(error, TN_LIMIT, E_TOO_MANY_VALUES,
            "the plans of library %s come to more than %zu different values tray by tray",
            tn_text(library->schema->module, library->record->name), m->most);
    tn_error_help(error, "ask measures of fewer different values, or a library of shorter plans");
    return TN_LIMIT;
}

/* Adds the plans at a place of `here` to those of the edge's target. */
static tn_status follow(machine *m, size_t place, const tn_bundle_edge *edge, tn_error *error)
{
    size_t size;
    const uint32_t *key = tn_interned(&m->here.keys, (uint32_t)place, &size);
    const int64_t *gains = tn_bundle_gains(m->bundle, edge);
    m->key.size = 0;
    bool good = tn_key_push(&m->key, edge->target);
    for (uint32_t s = 0; s < m->sums && good; s++)
        good = tn_key_push_sum(&m->key, tn_key_sum(key + 1, s) + gains[s]);
    mpz_ptr plans = good ? tn_crowd_at(&m->next, &m->key) : NULL;
    if (!plans)
        return tn_fail_memory(error);
    mpz_addmul_ui(plans, m->here.plans[place], edge->trays);
    return m->next.count > m->most ? too_many(m, error) : TN_OK;
}

static tn_status follow_all(machine *m, tn_error *error)
{
    for (size_t i = 0; i < m->here.count; i++) {
        size_t size, count;
        const tn_bundle_edge *edges;
        tn_status status =
            tn_bundle_edges(m->bundle, tn_interned(&m->here.keys, (uint32_t)i, &size)[0], &edges, &count, error);
        for (size_t e = 0; status == TN_OK && e < count; e++)
            status = follow(m, i, &edges[e], error);
        if (status == TN_OK && i % 256 == 0)
            status = tn_watch_check(tn_bundle_library(m->bundle)->schema->module->watch, error);
        if (status != TN_OK)
            return status;
    }
    tn_crowd spent = m->here;
    m->here = m->next;
    tn_crowd_forget(&spent);
    m->next = spent;
    return TN_OK;
}

/* The values of a plan that ends there: for each measure whether it has one, and its sums, 0 without one. */
static bool ended_key(machine *m, const uint32_t *key)
{
    uint32_t state = key[0];
    m->key.size = 0;
    for (uint32_t k = 0; k < m->measures; k++) {
        bool valued = tn_bundle_valued(m->bundle, state, k);
        if (!tn_key_push(&m->key, valued))
            return false;
        for (uint32_t s = tn_bundle_first(m->bundle, k); s < tn_bundle_first(m->bundle, k + 1); s++) {
            int64_t sum = tn_key_sum(key + 1, s) + tn_bundle_rest(m->bundle, state, s);
            if (!tn_key_push_sum(&m->key, valued ? sum : 0))
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
        if (!tn_bundle_ends(m->bundle, key[0]))
            continue;
        mpz_ptr plans = ended_key(m, key) ? tn_crowd_at(&m->ended, &m->key) : NULL;
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
    bool good = tn_key_push(&m->key, 0);
    for (uint32_t s = 0; s < m->sums && good; s++)
        good = tn_key_push_sum(&m->key, tn_bundle_start(m->bundle, s));
    mpz_ptr plans = good ? tn_crowd_at(&m->here, &m->key) : NULL;
    if (!plans)
        return tn_fail_memory(error);
    mpz_set_ui(plans, 1);
    return TN_OK;
}

static tn_status walk(machine *m, tn_error *error)
{
    const tn_library *library = tn_bundle_library(m->bundle);
    tn_status status = begin(m, error);
    for (uint32_t n = 0; status == TN_OK && n <= library->max; n++) {
        if (n >= library->min)
            status = end_all(m, error);
        if (status == TN_OK && n < library->max)
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
    int64_t sums[TN_BUNDLE_SUMS_MAX];
    for (uint32_t k = 0; k < m->measures; k++) {
        row->valued[k] = key[at++];
        for (uint32_t s = tn_bundle_first(m->bundle, k); s < tn_bundle_first(m->bundle, k + 1); s++, at += 2)
            sums[s] = tn_key_sum(key + at, 0);
        if (row->valued[k])
            tn_bundle_value(m->bundle, k, sums, row->values[k]);
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

static void machine_clear(machine *m)
{
    tn_bundle_free(m->bundle);
    tn_crowd_clear(&m->here);
    tn_crowd_clear(&m->next);
    tn_crowd_clear(&m->ended);
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

tn_status tn_crosstab_make(tn_crosstab *table, const tn_library *library, const tn_bundle_measure *measures,
                           uint32_t count, size_t most, tn_error *error)
{
    *table = (tn_crosstab){.measures = count};
    if (count == 0)
        return count_plans(table, library, error);
    if (tn_library_min(library) > tn_library_max(library))
        return TN_OK;
    machine m = {.measures = count, .most = most ? most : TN_CROSSTAB_VALUES_MAX};
    tn_status status = tn_bundle_new(library, measures, count, &m.bundle, error);
    if (status == TN_OK) {
        m.sums = tn_bundle_sums(m.bundle);
        status = walk(&m, error);
    }
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
