/* Goes through combinations of tiles, also if clauses ask what these cost, or how one walks around them. */
#include "runtime/house/rule/furnish.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"

#include "runtime/house/form/form.h"
#include "runtime/house/measure/measure.h"
#include "runtime/house/rule/asked.h"
#include "runtime/house/rule/stages.h"
#include "runtime/house/rule/tile_groups.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/walk/walk.h"

/* How many tiles fit in a cell, kept for cells of one function and storey that are equally large and have the same in
 * and near their faces: plans of a library have few kinds of these. */
typedef struct tn_fits {
    bool *wanted; /* [functions] a tile is for it */
    tn_interner cells;
    tn_key key;
    size_t *counts; /* [cells] */
    size_t room;
} tn_fits;

enum { FITS_MAX = 1 << 16 }; /* kinds of cells: with more the counts are forgotten */

/* What the tiles from a cell on can cost together, in steps, ascending; times: combinations that cost so much. */
typedef struct tn_tile_sums {
    tn_int128 *steps;
    mpz_t *times;
    size_t count;
} tn_tile_sums;

/* What the tiles of the house at hand cost. kept: of each sum of all tiles, is the house one with it? */
typedef struct tn_tile_costs {
    size_t cells;
    size_t *tiles;      /* [cells] how many have a cost; 0: it wants none */
    mpq_t **exact;      /* [cell][tile] costs */
    tn_int128 **steps;  /* the same in steps */
    tn_tile_sums *sums; /* [cells + 1] */
    bool *kept;
    mpq_t unit, shell, price;
} tn_tile_costs;

struct tn_furnisher {
    const tn_house_form *form;
    const tn_house_library_record *library;
    tn_clause_stage *stages; /* of each clause */
    bool prices, walks;      /* a clause asks for costs, or for walks */
    tn_house_rules *rules;   /* NULL unless one does */
    tn_house *house;
    tn_fits fits;
    size_t *tiles; /* how many fit in each cell; 1 if it wants none */
    size_t tile_room;
    tn_tile_costs *costs; /* NULL: what they cost does not count */
    tn_tile_groups groups; /* of no cells: how one walks around them does not count */
    tn_walk_floors floors;
};

/* ==== tiles that fit in a cell */

static void mark_purposes(const tn_house_form *form, const tn_tile_record *tile, bool *wanted)
{
    for (uint32_t i = 0; i < tile->purpose_count; i++)
        wanted[form->module->HOUSE_ITEM_records[tile->purpose_first + i].number] = true;
}

static tn_status begin_fits(const tn_house_form *form, tn_fits *fits, tn_error *error)
{
    fits->wanted = calloc((size_t)tn_form_functions(form) + 1, sizeof *fits->wanted);
    if (!fits->wanted)
        return tn_fail_memory(error);
    for (uint32_t t = 0; t < form->record->tile_count; t++)
        mark_purposes(form, &form->module->TILE_records[form->record->tile_first + t], fits->wanted);
    return TN_OK;
}

static void clear_fits(tn_fits *fits)
{
    free(fits->wanted);
    free(fits->counts);
    free(fits->key.data);
    tn_interner_clear(&fits->cells);
}

/* Cells that flights join are looked at together, at the lowest, if the form asks for ways. */
static bool is_wanted(const tn_fits *fits, const tn_house *house, uint32_t index)
{
    const tn_cell *cell = &house->cells[index];
    bool ways = tn_form_asks_ways(house->form);
    return !cell->open && cell->function != TN_NO_FUNCTION && (ways || fits->wanted[cell->function]) &&
           !(ways && tn_flight_below(house, index));
}

/* ---- what the tiles of a cell depend on */

enum { CELL_WORDS = 2 + 2 * 2, FACE_WORDS = 1 + 4 * 2 + 1 + 4 * 2 };

static uint32_t *add_long(uint32_t *word, int64_t value)
{
    *word++ = (uint32_t)value;
    *word++ = (uint32_t)((uint64_t)value >> 32);
    return word;
}

/* What is in the face, and whether it is one of the cell's: others matter by the posts at their ends. */
static uint32_t *add_face(uint32_t *word, const tn_house *house, const tn_face *face, uint32_t index)
{
    enum { FIRST = 1, SECOND, OUTER = 4, SIDE = 8, KIND = 64 };
    const tn_cell *cell = &house->cells[index];
    uint32_t of = face->first == index ? FIRST : face->second == index ? SECOND : 0;
    uint32_t outer = tn_face_is_outer(house, face) ? OUTER : 0;
    *word++ = face->kind * KIND + (uint32_t)face->side * SIDE + outer + of;
    word = add_long(word, face->at.x0 - cell->at.x0);
    word = add_long(word, face->at.x1 - cell->at.x0);
    word = add_long(word, face->at.y0 - cell->at.y0);
    return add_long(word, face->at.y1 - cell->at.y0);
}

static bool is_near(const tn_face *face, const tn_cell *cell)
{
    return face->storey == cell->storey && face->relation != TN_FACE_UNDER && face->at.x0 <= cell->at.x1 &&
           face->at.x1 >= cell->at.x0 && face->at.y0 <= cell->at.y1 && face->at.y1 >= cell->at.y0;
}

/* What is beyond a face of the cell, if the form asks for ways; of a bare cell, where its floor is. */
static uint32_t *add_view(uint32_t *word, const tn_house *house, uint32_t face, uint32_t index)
{
    const tn_cell *cell = &house->cells[index];
    if (house->faces[face].first != index && house->faces[face].second != index)
        return word;
    tn_face_view view = tn_face_seen(house, face, index);
    *word++ = (uint32_t)view.beyond * 2 + view.leaf;
    if (view.beyond != TN_BEYOND_BARE || house->faces[face].kind != TN_FACE_OPEN)
        return word;
    word = add_long(word, view.floor.x0 - cell->at.x0);
    word = add_long(word, view.floor.x1 - cell->at.x0);
    word = add_long(word, view.floor.y0 - cell->at.y0);
    return add_long(word, view.floor.y1 - cell->at.y0);
}

/* Of one cell, behind what is there. */
static uint32_t *add_cell(uint32_t *word, const tn_house *house, uint32_t index)
{
    const tn_cell *cell = &house->cells[index];
    *word++ = cell->function;
    *word++ = cell->storey;
    word = add_long(word, cell->at.x1 - cell->at.x0);
    word = add_long(word, cell->at.y1 - cell->at.y0);
    for (uint32_t i = 0; i < house->face_count; i++) {
        if (!is_near(&house->faces[i], cell))
            continue;
        word = add_face(word, house, &house->faces[i], index);
        if (tn_form_asks_ways(house->form))
            word = add_view(word, house, i, index);
    }
    return word;
}

/* A roof right above a cell may be in the way of people. */
static uint32_t roof_over(const tn_house *house, uint32_t index)
{
    const tn_shape_record *shape = tn_house_shape(house, house->cells[index].zone, TN_CHOICE_ROOF);
    return shape && tn_cell_is_top(house, index) ? (uint32_t)(shape - house->form->module->SHAPE_records) : UINT32_MAX;
}

/* The flight above a cell says which other cell goes with it. */
static bool make_key(tn_key *key, const tn_house *house, uint32_t index)
{
    const tn_face *flight = NULL;
    key->size = 0;
    do {
        if (!tn_array_reserve(&key->data, &key->capacity, key->size, CELL_WORDS + 2 + house->face_count * FACE_WORDS,
                              sizeof *key->data))
            return false;
        uint32_t *word = add_cell(key->data + key->size, house, index);
        if (tn_form_asks_ways(house->form)) {
            flight = tn_flight_above(house, index);
            *word++ = roof_over(house, index);
            *word++ = flight ? flight->kind : 0;
        }
        key->size = (size_t)(word - key->data);
        index++;
    } while (flight);
    return true;
}

static tn_status find_count(const tn_house *house, uint32_t cell, size_t *count, tn_error *error)
{
    return tn_cell_fillings(house, cell, count, error);
}

/* The faces of the house are all known. */
static tn_status fits_count(tn_fits *fits, const tn_house *house, uint32_t cell, size_t *count, tn_error *error)
{
    if (fits->cells.count == FITS_MAX)
        tn_interner_clear(&fits->cells);
    uint32_t before = fits->cells.count;
    if (!tn_array_reserve(&fits->counts, &fits->room, before, 1, sizeof *fits->counts) ||
        !make_key(&fits->key, house, cell))
        return tn_fail_memory(error);
    uint32_t number = tn_intern(&fits->cells, fits->key.data, fits->key.size);
    if (number == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = number == before ? find_count(house, cell, &fits->counts[number], error) : TN_OK;
    if (status != TN_OK)
        tn_interner_clear(&fits->cells); /* the last one has no count */
    else
        *count = fits->counts[number];
    return status;
}

/* How many tiles fit in each cell. *fit: does one in each? */
static tn_status count_tiles(tn_furnisher *f, bool *fit, tn_error *error)
{
    tn_status status = TN_OK;
    *fit = true;
    if (!tn_array_reserve(&f->tiles, &f->tile_room, 0, f->house->cell_count + 1, sizeof *f->tiles))
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && *fit && i < f->house->cell_count; i++) {
        f->tiles[i] = 1;
        if (is_wanted(&f->fits, f->house, i))
            status = fits_count(&f->fits, f->house, i, &f->tiles[i], error);
        *fit = f->tiles[i] > 0;
    }
    return status;
}

/* ==== what they cost */

static void clear_cell(tn_tile_costs *c, size_t cell)
{
    for (size_t t = 0; t < c->tiles[cell]; t++)
        mpq_clear(c->exact[cell][t]);
    free(c->exact[cell]);
    free(c->steps[cell]);
}

static void clear_costs(tn_furnisher *f)
{
    tn_tile_costs *c = f->costs;
    if (!c)
        return;
    for (size_t i = 0; c->tiles && c->exact && c->steps && i < c->cells; i++)
        clear_cell(c, i);
    for (size_t i = 0; c->sums && i <= c->cells; i++) {
        free(c->sums[i].steps);
        tn_integers_free(c->sums[i].times, c->sums[i].count);
    }
    free(c->tiles);
    free(c->exact);
    free(c->steps);
    free(c->sums);
    free(c->kept);
    mpq_clears(c->unit, c->shell, c->price, NULL);
    free(c);
    f->costs = NULL;
}

static tn_status begin(tn_furnisher *f, tn_error *error)
{
    tn_tile_costs *c = f->costs = calloc(1, sizeof *c);
    if (!c)
        return tn_fail_memory(error);
    mpq_inits(c->unit, c->shell, c->price, NULL);
    c->cells = f->house->cell_count;
    c->tiles = calloc(c->cells + 1, sizeof *c->tiles);
    c->exact = calloc(c->cells + 1, sizeof *c->exact);
    c->steps = calloc(c->cells + 1, sizeof *c->steps);
    c->sums = calloc(c->cells + 1, sizeof *c->sums);
    return c->tiles && c->exact && c->steps && c->sums ? TN_OK : tn_fail_memory(error);
}

/* ---- what each tile costs */

static tn_status price_cell(tn_furnisher *f, uint32_t cell, tn_error *error)
{
    tn_tile_costs *c = f->costs;
    tn_variants tiles;
    tn_status status = tn_tile_variants(f->house, cell, &tiles, error);
    if (status == TN_OK && tiles.wanted) {
        c->exact[cell] = malloc((tiles.count + 1) * sizeof *c->exact[cell]);
        c->steps[cell] = calloc(tiles.count + 1, sizeof *c->steps[cell]);
        status = c->exact[cell] && c->steps[cell] ? TN_OK : tn_fail_memory(error);
    }
    for (size_t t = 0; status == TN_OK && tiles.wanted && t < tiles.count; t++) {
        const tn_tile_variant *tile = &tiles.variants[t];
        mpq_init(c->exact[cell][t]);
        c->tiles[cell]++;
        tn_house_items_cost(f->house, tiles.items + tile->item_first, tile->item_count, c->exact[cell][t]);
        tn_common_unit(c->unit, c->exact[cell][t]);
    }
    tn_variants_clear(&tiles);
    return status;
}

static tn_status price_cells(tn_furnisher *f, tn_error *error)
{
    tn_tile_costs *c = f->costs;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < c->cells; i++)
        status = price_cell(f, i, error);
    if (mpq_sgn(c->unit) == 0)
        mpq_set_ui(c->unit, 1, 1);
    for (size_t i = 0; status == TN_OK && i < c->cells; i++)
        for (size_t t = 0; t < c->tiles[i]; t++)
            if (!tn_steps_of(c->exact[i][t], c->unit, &c->steps[i][t]))
                return tn_too_fine(error);
    return status;
}

static tn_int128 cost_of(const tn_tile_costs *c, size_t cell, size_t tile)
{
    return c->tiles[cell] > 0 ? c->steps[cell][tile] : 0;
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

static tn_status add_up(const tn_furnisher *f, size_t cell, tn_error *error)
{
    tn_tile_costs *c = f->costs;
    const tn_tile_sums *behind = &c->sums[cell + 1];
    size_t count = 0;
    tn_part_sum *parts = tn_array_new(tn_size_of(f->tiles[cell], behind->count) + 1, sizeof *parts);
    if (!parts)
        return tn_fail_memory(error);
    for (size_t t = 0; t < f->tiles[cell]; t++)
        for (size_t i = 0; i < behind->count; i++)
            parts[count++] = (tn_part_sum){cost_of(c, cell, t) + behind->steps[i], i};
    qsort(parts, count, sizeof *parts, compare_parts);
    tn_status status = join(parts, count, behind, &c->sums[cell], error);
    free(parts);
    return status;
}

static tn_status add_all(const tn_furnisher *f, tn_error *error)
{
    const tn_tile_costs *c = f->costs;
    tn_tile_sums *last = &c->sums[c->cells];
    last->steps = calloc(1, sizeof *last->steps);
    last->times = tn_integers_new(1);
    if (!last->steps || !last->times)
        return tn_fail_memory(error);
    last->count = 1;
    mpz_set_ui(last->times[0], 1);
    tn_status status = TN_OK;
    for (size_t i = c->cells; status == TN_OK && i-- > 0;)
        status = add_up(f, i, error);
    return status;
}

/* ---- which sums are kept */

/* steps: what the tiles cost together. */
static tn_status ask_clauses(tn_furnisher *f, tn_int128 steps, bool *kept, tn_error *error)
{
    tn_tile_costs *c = f->costs;
    tn_status status = tn_house_rules_start(f->rules, f->house, error); /* forgets the answers at another price */
    if (c) {
        tn_steps_number(steps, c->unit, c->price);
        mpq_add(c->price, c->price, c->shell);
    }
    if (status == TN_OK && c)
        tn_house_rules_price(f->rules, c->price);
    for (uint32_t i = 0; status == TN_OK && *kept && i < f->library->clause_count; i++) {
        bool drops = false;
        if (f->stages[i] != TN_STAGE_TILES)
            continue;
        status = tn_house_rules_drop(f->rules, f->library, i, &drops, error);
        *kept = !drops;
    }
    return status;
}

/* cost: or NULL. */
static tn_status choose_sums(tn_furnisher *f, mpq_srcptr cost, tn_error *error)
{
    tn_tile_costs *c = f->costs;
    tn_int128 wanted = 0;
    bool possible = !cost || tn_steps_of(cost, c->unit, &wanted);
    tn_status status = TN_OK;
    c->kept = calloc(c->sums[0].count + 1, sizeof *c->kept);
    if (!c->kept)
        return tn_fail_memory(error);
    if (f->prices && possible)
        status = tn_house_exact_cost(f->house, tn_house_shell, c->shell, error);
    for (size_t i = 0; status == TN_OK && possible && i < c->sums[0].count; i++) {
        c->kept[i] = !cost || c->sums[0].steps[i] == wanted;
        if (f->prices && c->kept[i])
            status = ask_clauses(f, c->sums[0].steps[i], &c->kept[i], error);
    }
    return status;
}

static tn_status add_costs(tn_furnisher *f, mpq_srcptr cost, tn_error *error)
{
    tn_status status = begin(f, error);
    if (status == TN_OK)
        status = price_cells(f, error);
    if (status == TN_OK)
        status = add_all(f, error);
    return status == TN_OK ? choose_sums(f, cost, error) : status;
}

/* ==== how one walks around them */

/* A tile's number among those of a cell: by what walks tell of it, and what it costs. */
static tn_status number_tiles(tn_furnisher *f, uint32_t cell, const tn_variants *tiles, uint64_t *numbers,
                              tn_error *error)
{
    uint32_t *walks = tn_array_new((uint64_t)tiles->count + 1, sizeof *walks);
    tn_status status =
        walks ? tn_walk_tiles(f->house, cell, tiles, &f->floors, walks, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < tiles->count; i++) {
        size_t same = 0;
        while (f->costs && cost_of(f->costs, cell, same) != cost_of(f->costs, cell, i))
            same++;
        numbers[i] = (uint64_t)same << 32 | walks[i];
    }
    free(walks);
    return status;
}

static tn_status group_cell(tn_furnisher *f, uint32_t cell, tn_error *error)
{
    tn_variants tiles;
    uint64_t *numbers = tn_array_new((uint64_t)f->tiles[cell] + 1, sizeof *numbers);
    tn_status status = tn_tile_variants(f->house, cell, &tiles, error);
    if (status == TN_OK && !numbers)
        status = tn_fail_memory(error);
    if (status == TN_OK && tiles.wanted)
        status = number_tiles(f, cell, &tiles, numbers, error);
    else if (status == TN_OK)
        numbers[0] = 0;
    if (status == TN_OK)
        status = tn_tile_groups_add(&f->groups, cell, numbers, f->tiles[cell], error);
    tn_variants_clear(&tiles);
    free(numbers);
    return status;
}

/* A combination of the groups. wanted: what all tiles have to cost, or NULL. */
typedef struct tn_asking_tiles {
    tn_furnisher *furnisher;
    const tn_int128 *wanted;
} tn_asking_tiles;

static tn_status ask_tiles(void *context, const size_t *tiles, bool *kept, tn_error *error)
{
    const tn_asking_tiles *asking = context;
    tn_furnisher *f = asking->furnisher;
    tn_int128 steps = 0;
    for (size_t i = 0; i < f->house->cell_count; i++) {
        f->house->cells[i].variant = tiles[i];
        steps += f->costs ? cost_of(f->costs, i, tiles[i]) : 0;
    }
    *kept = !asking->wanted || steps == *asking->wanted;
    tn_status status = *kept ? ask_clauses(f, steps, kept, error) : TN_OK;
    for (size_t i = 0; i < f->house->cell_count; i++)
        f->house->cells[i].variant = 0;
    return status;
}

/* cost: or NULL. */
static tn_status add_groups(tn_furnisher *f, mpq_srcptr cost, tn_error *error)
{
    tn_int128 wanted = 0;
    tn_asking_tiles asking = {f, cost ? &wanted : NULL};
    tn_status status = tn_tile_groups_begin(&f->groups, f->house->cell_count, error);
    if (status == TN_OK && (f->prices || cost))
        status = begin(f, error);
    if (status == TN_OK && f->costs)
        status = price_cells(f, error);
    if (status == TN_OK && f->prices)
        status = tn_house_exact_cost(f->house, tn_house_shell, f->costs->shell, error);
    for (uint32_t i = 0; status == TN_OK && i < f->house->cell_count; i++)
        status = group_cell(f, i, error);
    if (status == TN_OK && cost && !tn_steps_of(cost, f->costs->unit, &wanted))
        wanted = -1; /* none costs so much */
    return status == TN_OK ? tn_tile_groups_ask(&f->groups, ask_tiles, &asking, error) : status;
}

/* ==== combinations: by a state, which is what the tiles of the cells so far cost, or their groups */

static bool is_counted(const tn_furnisher *f)
{
    return f->costs || f->groups.cells > 0;
}

static tn_int128 next_state(const tn_furnisher *f, size_t cell, tn_int128 state, size_t tile)
{
    return f->groups.cells > 0 ? (tn_int128)tn_tile_groups_next(&f->groups, cell, (size_t)state, tile)
                               : state + cost_of(f->costs, cell, tile);
}

static bool is_kept(const tn_tile_costs *c, tn_int128 steps)
{
    size_t low = 0, high = c->sums[0].count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (c->sums[0].steps[middle] < steps)
            low = middle + 1;
        else
            high = middle;
    }
    return low < c->sums[0].count && c->sums[0].steps[low] == steps && c->kept[low];
}

/* count := the kept combinations of the tiles from a cell on, by the state of those before it. */
static void count_from(const tn_furnisher *f, size_t cell, tn_int128 state, mpz_t count)
{
    const tn_tile_costs *c = f->costs;
    if (f->groups.cells > 0) {
        mpz_set(count, f->groups.ahead[cell][(size_t)state]);
        return;
    }
    mpz_set_ui(count, 0);
    for (size_t i = 0; i < c->sums[cell].count; i++)
        if (is_kept(c, state + c->sums[cell].steps[i]))
            mpz_add(count, count, c->sums[cell].times[i]);
}

static void count_all(const tn_furnisher *f, mpz_t count)
{
    if (is_counted(f)) {
        count_from(f, 0, 0, count);
        return;
    }
    mpz_set_ui(count, 1);
    for (size_t i = 0; i < f->house->cell_count; i++)
        mpz_mul_ui(count, count, f->tiles[i]);
}

/* Sets the tiles from a cell on to the combination that `left` kept ones come before, which is there. */
static void find_from(tn_furnisher *f, size_t cell, tn_int128 state, mpz_t left)
{
    mpz_t here;
    mpz_init(here);
    for (size_t i = cell; i < f->house->cell_count; i++) {
        size_t tile = 0;
        for (; tile + 1 < f->tiles[i]; tile++) {
            count_from(f, i + 1, next_state(f, i, state, tile), here);
            if (mpz_cmp(left, here) < 0)
                break;
            mpz_sub(left, left, here);
        }
        f->house->cells[i].variant = tile;
        state = next_state(f, i, state, tile);
    }
    mpz_clear(here);
}

void tn_furnish_at(tn_furnisher *f, const mpz_t number)
{
    mpz_t left;
    mpz_init_set(left, number);
    if (is_counted(f))
        find_from(f, 0, 0, left);
    else
        for (size_t i = f->house->cell_count; i-- > 0;)
            f->house->cells[i].variant = (size_t)mpz_fdiv_q_ui(left, left, f->tiles[i]);
    mpz_clear(left);
}

/* Is there a kept combination with one of the cell's next tiles? Then the tiles are set to the first such. */
static bool turn(tn_furnisher *f, size_t cell, tn_int128 state)
{
    mpz_t count;
    bool found = false;
    mpz_init(count);
    for (size_t tile = f->house->cells[cell].variant + 1; !found && tile < f->tiles[cell]; tile++) {
        count_from(f, cell + 1, next_state(f, cell, state, tile), count);
        found = mpz_sgn(count) > 0;
        f->house->cells[cell].variant = tile;
    }
    mpz_set_ui(count, 0);
    if (found)
        find_from(f, cell + 1, next_state(f, cell, state, f->house->cells[cell].variant), count);
    mpz_clear(count);
    return found;
}

/* Of the tiles of a house before a cell. */
static tn_int128 state_before(const tn_furnisher *f, const tn_house *house, size_t cell)
{
    tn_int128 state = 0;
    for (size_t i = 0; i < cell; i++)
        state = next_state(f, i, state, house->cells[i].variant);
    return state;
}

static bool next_kept(tn_furnisher *f)
{
    for (size_t i = f->house->cell_count; i-- > 0;) {
        if (turn(f, i, state_before(f, f->house, i)))
            return true;
        f->house->cells[i].variant = 0;
    }
    return false;
}

/* The last cell's tile changes first. */
bool tn_furnish_next(tn_furnisher *f)
{
    if (is_counted(f))
        return next_kept(f);
    for (size_t i = f->house->cell_count; i-- > 0;) {
        if (++f->house->cells[i].variant < f->tiles[i])
            return true;
        f->house->cells[i].variant = 0;
    }
    return false;
}

bool tn_furnish_has(const tn_furnisher *f, const tn_house *house)
{
    mpz_t count;
    if (!is_counted(f))
        return true;
    mpz_init(count);
    count_from(f, house->cell_count, state_before(f, house, house->cell_count), count);
    bool has = mpz_sgn(count) > 0;
    mpz_clear(count);
    return has;
}

static void count_before(const tn_furnisher *f, const tn_house *house, mpz_t count)
{
    mpz_t here;
    mpz_init(here);
    for (size_t i = 0; i < house->cell_count; i++)
        for (size_t tile = 0; tile < house->cells[i].variant; tile++) {
            count_from(f, i + 1, next_state(f, i, state_before(f, house, i), tile), here);
            mpz_add(count, count, here);
        }
    mpz_clear(here);
}

void tn_furnish_before(const tn_furnisher *f, const tn_house *house, mpz_t count)
{
    mpz_set_ui(count, 0);
    if (is_counted(f)) {
        count_before(f, house, count);
        return;
    }
    for (size_t i = 0; i < house->cell_count; i++) {
        mpz_mul_ui(count, count, f->tiles[i]);
        mpz_add_ui(count, count, house->cells[i].variant);
    }
}

tn_status tn_furnish(tn_furnisher *f, tn_house *house, mpq_srcptr cost, mpz_t count, tn_error *error)
{
    bool fit = false;
    f->house = house;
    clear_costs(f);
    tn_tile_groups_clear(&f->groups);
    for (size_t i = 0; i < house->cell_count; i++)
        house->cells[i].variant = 0;
    mpz_set_ui(count, 0);
    tn_status status = count_tiles(f, &fit, error);
    if (status == TN_OK && fit && f->walks)
        status = add_groups(f, cost, error);
    else if (status == TN_OK && fit && (f->prices || cost))
        status = add_costs(f, cost, error);
    if (status == TN_OK && fit)
        count_all(f, count);
    return status;
}

/* ==== making */

static bool is_cost(uint32_t kind)
{
    return kind == TN_HOUSE_COST;
}

/* *asks: does one of the clauses? */
static tn_status find_asking(const tn_furnisher *f, tn_term_asked *asked, bool *asks, tn_error *error)
{
    bool *clauses = calloc((size_t)f->library->clause_count + 1, sizeof *clauses);
    tn_status status =
        clauses ? tn_clauses_asking(f->form, f->library, asked, clauses, error) : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < f->library->clause_count; i++)
        *asks = *asks || clauses[i];
    free(clauses);
    return status;
}

tn_status tn_furnisher_new(const tn_house_form *form, const tn_house_library_record *library, tn_furnisher **out,
                           tn_error *error)
{
    tn_furnisher *f = *out = calloc(1, sizeof *f);
    if (!f)
        return tn_fail_memory(error);
    *f = (tn_furnisher){.form = form, .library = library};
    f->stages = calloc((size_t)library->clause_count + 1, sizeof *f->stages);
    tn_status status = f->stages ? tn_clause_stages(form, library, f->stages, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = find_asking(f, is_cost, &f->prices, error);
    if (status == TN_OK)
        status = find_asking(f, tn_house_term_of_floors, &f->walks, error);
    if (status == TN_OK)
        status = begin_fits(form, &f->fits, error);
    if (status == TN_OK && (f->prices || f->walks))
        status = tn_house_rules_new(form, 0, &f->rules, error);
    if (status != TN_OK) {
        tn_furnisher_free(f);
        *out = NULL;
    }
    return status;
}

void tn_furnisher_free(tn_furnisher *f)
{
    if (!f)
        return;
    clear_costs(f);
    tn_tile_groups_clear(&f->groups);
    tn_walk_floors_clear(&f->floors);
    clear_fits(&f->fits);
    tn_house_rules_free(f->rules);
    free(f->stages);
    free(f->tiles);
    free(f);
}

bool tn_furnisher_prices(const tn_furnisher *f)
{
    return f->prices;
}

bool tn_furnisher_walks(const tn_furnisher *f)
{
    return f->walks;
}

uint64_t tn_furnisher_asked(const tn_furnisher *f)
{
    return f->groups.asked;
}
