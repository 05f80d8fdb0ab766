/* Goes through combinations of tiles, also where clauses ask what these cost. */
#include "runtime/house/variant/furnish.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/measure/measure.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/variant/parts.h"

/* What the tiles from a cell on can cost together, in steps, ascending; times: combinations that cost so much. */
typedef struct tn_tile_sums {
    tn_int128 *steps;
    mpz_t *times;
    size_t count;
} tn_tile_sums;

/* kept: of each sum of all tiles, do the clauses keep the house with it? */
struct tn_combinations {
    size_t cells;
    size_t *tiles;      /* [cells] how many have a cost; 0: it wants none */
    mpq_t **exact;      /* [cell][tile] costs */
    tn_int128 **cost;   /* the same in steps */
    tn_tile_sums *sums; /* [cells + 1] */
    bool *kept;
    mpq_t unit, shell;
};

/* ---- memory */

static void clear_cell(struct tn_combinations *f, size_t cell)
{
    for (size_t t = 0; t < f->tiles[cell]; t++)
        mpq_clear(f->exact[cell][t]);
    free(f->exact[cell]);
    free(f->cost[cell]);
}

void tn_furnished_clear(tn_house_variants *v)
{
    struct tn_combinations *f = v->combinations;
    if (!f)
        return;
    for (size_t i = 0; f->tiles && f->exact && f->cost && i < f->cells; i++)
        clear_cell(f, i);
    for (size_t i = 0; f->sums && i <= f->cells; i++) {
        free(f->sums[i].steps);
        tn_integers_free(f->sums[i].times, f->sums[i].count);
    }
    free(f->tiles);
    free(f->exact);
    free(f->cost);
    free(f->sums);
    free(f->kept);
    mpq_clears(f->unit, f->shell, NULL);
    free(f);
    v->combinations = NULL;
}

static tn_status begin(tn_house_variants *v, tn_error *error)
{
    tn_furnished_clear(v);
    struct tn_combinations *f = v->combinations = calloc(1, sizeof *f);
    if (!f)
        return tn_fail_memory(error);
    mpq_inits(f->unit, f->shell, NULL);
    f->cells = v->house.cell_count;
    f->tiles = calloc(f->cells + 1, sizeof *f->tiles);
    f->exact = calloc(f->cells + 1, sizeof *f->exact);
    f->cost = calloc(f->cells + 1, sizeof *f->cost);
    f->sums = calloc(f->cells + 1, sizeof *f->sums);
    return f->tiles && f->exact && f->cost && f->sums ? TN_OK : tn_fail_memory(error);
}

/* ---- what each tile costs */

static tn_status price_cell(tn_house_variants *v, uint32_t cell, tn_error *error)
{
    struct tn_combinations *f = v->combinations;
    tn_variants tiles;
    tn_status status = tn_tile_variants(&v->house, cell, &tiles, error);
    if (status == TN_OK && tiles.wanted) {
        f->exact[cell] = malloc((tiles.count + 1) * sizeof *f->exact[cell]);
        f->cost[cell] = calloc(tiles.count + 1, sizeof *f->cost[cell]);
        status = f->exact[cell] && f->cost[cell] ? TN_OK : tn_fail_memory(error);
    }
    for (size_t t = 0; status == TN_OK && tiles.wanted && t < tiles.count; t++) {
        const tn_tile_variant *tile = &tiles.variants[t];
        mpq_init(f->exact[cell][t]);
        f->tiles[cell]++;
        tn_house_items_cost(&v->house, tiles.items + tile->item_first, tile->item_count, f->exact[cell][t]);
        tn_common_unit(f->unit, f->exact[cell][t]);
    }
    tn_variants_clear(&tiles);
    return status;
}

static tn_status price_cells(tn_house_variants *v, tn_error *error)
{
    struct tn_combinations *f = v->combinations;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < f->cells; i++)
        status = price_cell(v, i, error);
    if (mpq_sgn(f->unit) == 0)
        mpq_set_ui(f->unit, 1, 1);
    for (size_t i = 0; status == TN_OK && i < f->cells; i++)
        for (size_t t = 0; t < f->tiles[i]; t++)
            if (!tn_steps_of(f->exact[i][t], f->unit, &f->cost[i][t]))
                return tn_too_fine(error);
    return status;
}

static tn_int128 cost_of(const struct tn_combinations *f, size_t cell, size_t tile)
{
    return f->tiles[cell] > 0 ? f->cost[cell][tile] : 0;
}

/* ---- sums */

typedef struct tn_part_sum {
    tn_int128 steps;
    size_t of; /* of the sums behind */
} tn_part_sum;

static int compare_parts(const void *a, const void *b)
{
    const tn_part_sum *p = a, *q = b;
    return (p->steps > q->steps) - (p->steps < q->steps);
}

/* Joins equal sums. */
static tn_status join(const tn_part_sum *parts, size_t count, const tn_tile_sums *behind, tn_tile_sums *sums,
                      tn_error *error)
{
    sums->steps = malloc((count + 1) * sizeof *sums->steps);
    sums->times = malloc((count + 1) * sizeof *sums->times);
    if (!sums->steps || !sums->times)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        if (sums->count == 0 || sums->steps[sums->count - 1] != parts[i].steps) {
            sums->steps[sums->count] = parts[i].steps;
            mpz_init(sums->times[sums->count++]);
        }
        mpz_add(sums->times[sums->count - 1], sums->times[sums->count - 1], behind->times[parts[i].of]);
    }
    return TN_OK;
}

static tn_status add_up(const tn_house_variants *v, size_t cell, tn_error *error)
{
    struct tn_combinations *f = v->combinations;
    const tn_tile_sums *behind = &f->sums[cell + 1];
    size_t count = 0;
    tn_part_sum *parts = tn_array_new(tn_size_of(v->tiles[cell], behind->count) + 1, sizeof *parts);
    if (!parts)
        return tn_fail_memory(error);
    for (size_t t = 0; t < v->tiles[cell]; t++)
        for (size_t i = 0; i < behind->count; i++)
            parts[count++] = (tn_part_sum){cost_of(f, cell, t) + behind->steps[i], i};
    qsort(parts, count, sizeof *parts, compare_parts);
    tn_status status = join(parts, count, behind, &f->sums[cell], error);
    free(parts);
    return status;
}

static tn_status add_all(const tn_house_variants *v, tn_error *error)
{
    const struct tn_combinations *f = v->combinations;
    tn_tile_sums *last = &f->sums[f->cells];
    last->steps = calloc(1, sizeof *last->steps);
    last->times = tn_integers_new(1);
    if (!last->steps || !last->times)
        return tn_fail_memory(error);
    last->count = 1;
    mpz_set_ui(last->times[0], 1);
    tn_status status = TN_OK;
    for (size_t i = f->cells; status == TN_OK && i-- > 0;)
        status = add_up(v, i, error);
    return status;
}

/* ---- clauses */

static tn_status ask_clauses(tn_house_variants *v, tn_error *error)
{
    struct tn_combinations *f = v->combinations;
    tn_status status = tn_house_exact_cost(&v->house, tn_house_shell, f->shell, error);
    f->kept = malloc((f->sums[0].count + 1) * sizeof *f->kept);
    if (!f->kept)
        return tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < f->sums[0].count; i++) {
        tn_steps_number(f->sums[0].steps[i], f->unit, v->price);
        mpq_add(v->price, v->price, f->shell);
        status = tn_variants_keep(v, TN_STAGE_TILES, &f->kept[i], error);
    }
    return status;
}

tn_status tn_furnish(tn_house_variants *v, tn_error *error)
{
    enum { PRICING_STEPS = 100 }; /* what a house costs takes as long as so many other steps */
    if (!v->asks_costs)
        return TN_OK;
    tn_status status = tn_variants_spend(v, PRICING_STEPS, error);
    if (status == TN_OK)
        status = begin(v, error);
    if (status == TN_OK)
        status = price_cells(v, error);
    if (status == TN_OK)
        status = add_all(v, error);
    return status == TN_OK ? ask_clauses(v, error) : status;
}

/* ---- combinations */

static bool is_kept(const struct tn_combinations *f, tn_int128 steps)
{
    size_t low = 0, high = f->sums[0].count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (f->sums[0].steps[middle] < steps)
            low = middle + 1;
        else
            high = middle;
    }
    return low < f->sums[0].count && f->sums[0].steps[low] == steps && f->kept[low];
}

/* count := the kept combinations of the tiles from a cell on, where those before it cost so much. */
static void count_from(const struct tn_combinations *f, size_t cell, tn_int128 before, mpz_t count)
{
    mpz_set_ui(count, 0);
    for (size_t i = 0; i < f->sums[cell].count; i++)
        if (is_kept(f, before + f->sums[cell].steps[i]))
            mpz_add(count, count, f->sums[cell].times[i]);
}

void tn_furnished_count(const tn_house_variants *v, mpz_t count)
{
    if (v->asks_costs) {
        count_from(v->combinations, 0, 0, count);
        return;
    }
    mpz_set_ui(count, 1);
    for (size_t i = 0; i < v->house.cell_count; i++)
        mpz_mul_ui(count, count, v->tiles[i]);
}

/* Sets the tiles from a cell on to the combination that `left` kept ones come before, which is there. */
static void find_from(tn_house_variants *v, size_t cell, tn_int128 before, mpz_t left)
{
    const struct tn_combinations *f = v->combinations;
    mpz_t here;
    mpz_init(here);
    for (size_t i = cell; i < v->house.cell_count; i++) {
        size_t tile = 0;
        for (; tile + 1 < v->tiles[i]; tile++) {
            count_from(f, i + 1, before + cost_of(f, i, tile), here);
            if (mpz_cmp(left, here) < 0)
                break;
            mpz_sub(left, left, here);
        }
        v->house.cells[i].variant = tile;
        before += cost_of(f, i, tile);
    }
    mpz_clear(here);
}

void tn_furnished_find(tn_house_variants *v, const mpz_t number)
{
    mpz_t left;
    mpz_init_set(left, number);
    if (v->asks_costs)
        find_from(v, 0, 0, left);
    else
        for (size_t i = v->house.cell_count; i-- > 0;)
            v->house.cells[i].variant = (size_t)mpz_fdiv_q_ui(left, left, v->tiles[i]);
    mpz_clear(left);
}

/* Is there a kept combination with one of the cell's next tiles? Then the tiles are set to the first such. */
static bool turn(tn_house_variants *v, size_t cell, tn_int128 before)
{
    const struct tn_combinations *f = v->combinations;
    mpz_t count;
    bool found = false;
    mpz_init(count);
    for (size_t tile = v->house.cells[cell].variant + 1; !found && tile < v->tiles[cell]; tile++) {
        count_from(f, cell + 1, before + cost_of(f, cell, tile), count);
        found = mpz_sgn(count) > 0;
        v->house.cells[cell].variant = tile;
    }
    mpz_set_ui(count, 0);
    if (found)
        find_from(v, cell + 1, before + cost_of(f, cell, v->house.cells[cell].variant), count);
    mpz_clear(count);
    return found;
}

static bool next_kept(tn_house_variants *v)
{
    const struct tn_combinations *f = v->combinations;
    tn_int128 before = 0;
    for (size_t i = 0; i < v->house.cell_count; i++)
        before += cost_of(f, i, v->house.cells[i].variant);
    for (size_t i = v->house.cell_count; i-- > 0;) {
        before -= cost_of(f, i, v->house.cells[i].variant);
        if (turn(v, i, before))
            return true;
        v->house.cells[i].variant = 0;
    }
    return false;
}

/* The last cell's tile changes first. */
bool tn_furnished_next(tn_house_variants *v)
{
    if (v->asks_costs)
        return next_kept(v);
    for (size_t i = v->house.cell_count; i-- > 0;) {
        if (++v->house.cells[i].variant < v->tiles[i])
            return true;
        v->house.cells[i].variant = 0;
    }
    return false;
}

bool tn_house_variants_keep_tiles(const tn_house_variants *v, const tn_house *house)
{
    tn_int128 cost = 0;
    for (size_t i = 0; v->asks_costs && i < house->cell_count; i++)
        cost += cost_of(v->combinations, i, house->cells[i].variant);
    return !v->asks_costs || is_kept(v->combinations, cost);
}

static void count_before(const struct tn_combinations *f, const tn_house *house, mpz_t count)
{
    tn_int128 before = 0;
    mpz_t here;
    mpz_init(here);
    for (size_t i = 0; i < house->cell_count; i++) {
        for (size_t tile = 0; tile < house->cells[i].variant; tile++) {
            count_from(f, i + 1, before + cost_of(f, i, tile), here);
            mpz_add(count, count, here);
        }
        before += cost_of(f, i, house->cells[i].variant);
    }
    mpz_clear(here);
}

void tn_furnished_before(const tn_house_variants *v, const tn_house *house, mpz_t count)
{
    mpz_set_ui(count, 0);
    if (v->asks_costs) {
        count_before(v->combinations, house, count);
        return;
    }
    for (size_t i = 0; i < house->cell_count; i++) {
        mpz_mul_ui(count, count, v->tiles[i]);
        mpz_add_ui(count, count, house->cells[i].variant);
    }
}
