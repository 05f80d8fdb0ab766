/* Goes through the tiles of a house with which it has a value: what is still wanted of them is divided among the cells,
 * one after another, as far as the rest can add up to it. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"
#include "runtime/house/schedule/cost.h"

/* ---- what the tiles have to cost */

/* Does a measure add up costs? */
static bool asks_costs(const tn_houses *h)
{
    bool asks = false;
    for (uint32_t k = 0; h->measures && k < h->measures->count; k++)
        asks = asks || h->units.costs[k] != 0;
    return asks;
}

/* A measure's value of the house without its tiles, in steps. */
static tn_status value_of(const tn_houses_wanted *wanted, uint32_t k, const mpq_t shell, tn_int128 *steps,
                          tn_error *error)
{
    const tn_houses *h = wanted->houses;
    mpq_t value, cost;
    mpq_inits(value, cost, NULL);
    tn_status status = tn_house_rules_measure(wanted->rules, h->measures->of[k]->of, value, cost, error);
    mpq_mul(cost, cost, shell);
    mpq_add(value, value, cost);
    if (status == TN_OK && !tn_steps_of(value, h->units.measures[k], steps))
        status = tn_too_fine(error);
    mpq_clears(value, cost, NULL);
    return status;
}

/* *fits: can the house have the values? *left: what its tiles cost then, in steps. */
static tn_status find_left(const tn_houses_wanted *wanted, const tn_house *house, bool *fits, tn_int128 *left,
                           tn_error *error)
{
    const tn_houses *h = wanted->houses;
    bool known = false;
    mpq_t shell;
    *fits = true;
    *left = 0;
    if (!wanted->rules)
        return TN_OK;
    mpq_init(shell);
    tn_status status = tn_house_rules_start(wanted->rules, house, error);
    if (status == TN_OK && asks_costs(h))
        status = tn_house_exact_cost(house, tn_house_shell, shell, error);
    for (uint32_t k = 0; status == TN_OK && *fits && k < h->measures->count; k++) {
        tn_int128 value = 0, all = wanted->values->by[k] * (h->measures->most[k] ? -1 : 1);
        status = value_of(wanted, k, shell, &value, error);
        tn_int128 each = h->units.costs[k], rest = all - value;
        tn_int128 tiles = each ? rest / each : 0;
        *fits = tiles * each == rest && (!known || each == 0 || tiles == *left);
        *left = each ? tiles : *left;
        known = known || each;
    }
    mpq_clear(shell);
    return status;
}

/* ---- tiles */

/* cost: [cells], steps of each tile that fits; NULL if all cost nothing. sums: [cells + 1] what the tiles from the
 * cell on can add up to, ascending. */
typedef struct tn_furnishing {
    tn_house *house;
    const size_t *tiles;
    tn_int128 **cost;
    struct tn_cost_sums {
        tn_int128 *items;
        size_t count;
    } * sums;
    tn_house_each *each;
    void *context;
    bool *stop;
} tn_furnishing;

static int compare_costs(const void *a, const void *b)
{
    const tn_int128 *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

static tn_int128 cost_of(const tn_furnishing *f, size_t cell, size_t variant)
{
    return f->cost[cell] ? f->cost[cell][variant] : 0;
}

static bool can_add_up(const tn_furnishing *f, size_t cell, tn_int128 left)
{
    return bsearch(&left, f->sums[cell].items, f->sums[cell].count, sizeof left, compare_costs) != NULL;
}

static tn_status price_tiles(const tn_houses *h, tn_furnishing *f, uint32_t cell, tn_error *error)
{
    tn_variants variants;
    mpq_t cost;
    mpq_init(cost);
    tn_status status = tn_tile_variants(f->house, cell, &variants, error);
    if (status == TN_OK && variants.wanted) {
        f->cost[cell] = malloc((variants.count + 1) * sizeof *f->cost[cell]);
        status = f->cost[cell] ? TN_OK : tn_fail_memory(error);
    }
    for (size_t i = 0; status == TN_OK && variants.wanted && i < variants.count; i++) {
        const tn_tile_variant *variant = &variants.variants[i];
        tn_house_items_cost(f->house, variants.items + variant->item_first, variant->item_count, cost);
        if (!tn_steps_of(cost, h->units.cost, &f->cost[cell][i]))
            status = tn_too_fine(error);
    }
    mpq_clear(cost);
    tn_variants_clear(&variants);
    return status;
}

static tn_status add_up(tn_furnishing *f, size_t cell, tn_error *error)
{
    const struct tn_cost_sums *after = &f->sums[cell + 1];
    struct tn_cost_sums *sums = &f->sums[cell];
    size_t count = 0, ways = f->cost[cell] ? f->tiles[cell] : 1;
    sums->items = tn_array_new(tn_size_of(after->count, ways) + 1, sizeof *sums->items);
    if (!sums->items)
        return tn_fail_memory(error);
    for (size_t v = 0; v < ways; v++)
        for (size_t i = 0; i < after->count; i++)
            sums->items[count++] = after->items[i] + cost_of(f, cell, v);
    qsort(sums->items, count, sizeof *sums->items, compare_costs);
    for (size_t i = 0; i < count; i++)
        if (sums->count == 0 || sums->items[sums->count - 1] != sums->items[i])
            sums->items[sums->count++] = sums->items[i];
    return TN_OK;
}

static tn_status choose(tn_furnishing *f, size_t cell, tn_int128 left, tn_error *error)
{
    tn_status status = TN_OK;
    if (cell == f->house->cell_count)
        return f->each(f->context, f->house, f->stop, error);
    for (size_t v = 0; status == TN_OK && !*f->stop && v < f->tiles[cell]; v++) {
        tn_int128 rest = left - cost_of(f, cell, v);
        f->house->cells[cell].variant = v;
        if (can_add_up(f, cell + 1, rest))
            status = choose(f, cell + 1, rest, error);
    }
    f->house->cells[cell].variant = 0;
    return status;
}

static tn_status make_sums(const tn_houses *h, tn_furnishing *f, tn_error *error)
{
    size_t cells = f->house->cell_count;
    bool priced = asks_costs(h) && h->kinds[0].frontier->prices.items;
    f->cost = calloc(cells + 1, sizeof *f->cost);
    f->sums = calloc(cells + 1, sizeof *f->sums);
    if (f->sums)
        f->sums[cells].items = calloc(1, sizeof *f->sums->items);
    if (!f->cost || !f->sums || !f->sums[cells].items)
        return tn_fail_memory(error);
    f->sums[cells].count = 1;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && priced && i < cells; i++)
        status = price_tiles(h, f, i, error);
    for (size_t i = cells; status == TN_OK && i-- > 0;)
        status = add_up(f, i, error);
    return status;
}

tn_status tn_houses_furnish(const tn_houses_wanted *wanted, tn_house *house, const size_t *tiles, tn_house_each *each,
                            void *context, bool *stop, tn_error *error)
{
    tn_furnishing f = {.house = house, .tiles = tiles, .each = each, .context = context, .stop = stop};
    tn_int128 left;
    bool fits;
    for (size_t i = 0; i < house->cell_count; i++)
        house->cells[i].variant = 0;
    tn_status status = find_left(wanted, house, &fits, &left, error);
    if (status != TN_OK || !fits)
        return status;
    status = make_sums(wanted->houses, &f, error);
    if (status == TN_OK && can_add_up(&f, 0, left))
        status = choose(&f, 0, left, error);
    for (size_t i = 0; i < house->cell_count; i++) {
        if (f.cost)
            free(f.cost[i]);
        if (f.sums)
            free(f.sums[i].items);
    }
    if (f.sums)
        free(f.sums[house->cell_count].items);
    free(f.cost);
    free(f.sums);
    return status;
}
