/* Counts the houses with the functions at hand. Faces that clauses can depend on are turned together; those that only
 * matter to the tiles of one cell are summed up cell by cell, and the cells multiplied. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/variant/furnish.h"
#include "runtime/house/variant/parts.h"

/* Posts stand at both ends of an open side, also in the cells beside: their tiles can depend on it. */
static bool may_be_open(const tn_house_variants *v, const tn_wheel *w)
{
    bool open = false;
    for (uint32_t k = 0; k < w->count; k++)
        open = open || v->faces.choices[w->first + k] == TN_FACE_OPEN;
    return open;
}

/* Of the wheels that are set there is only the choice at hand. What is outside of a cell comes after what is outside of
 * the cells before it: faces are in that order. */
static tn_status split_faces(tn_house_variants *v, tn_error *error)
{
    tn_status status = TN_OK;
    tn_wheels_clear(&v->shared);
    tn_wheels_clear(&v->own);
    for (size_t i = 0; status == TN_OK && i < v->faces.count; i++) {
        const tn_wheel *w = &v->faces.items[i];
        bool relevant = v->asks_costs || may_be_open(v, w) ||
                        tn_face_relevant(&v->house, &v->questions, &v->house.faces[w->of]),
             set = i < v->faces_set;
        status = tn_wheels_add(relevant ? &v->shared : &v->own, w->of, v->faces.choices + w->first + (set ? w->at : 0),
                               set ? 1 : w->count, error);
    }
    return status;
}

static void set_kinds(tn_house_variants *v, const tn_wheels *wheels, size_t first, size_t end)
{
    for (size_t i = first; i < end; i++)
        v->house.faces[wheels->items[i].of].kind = tn_wheel_chosen(wheels, i);
}

/* The houses that differ in one cell only: in the tiles that fit it, and in what is in its own faces. */
typedef struct tn_cell_count {
    uint64_t houses, faced; /* tiles of all kinds of its faces; kinds that leave a tile */
} tn_cell_count;

/* A cell without tiles takes whatever is in its faces. */
static tn_cell_count take_any(const tn_wheels *wheels, size_t first, size_t end)
{
    tn_cell_count count = {1, 1};
    for (size_t i = first; i < end; i++)
        count.houses *= wheels->items[i].count;
    count.faced = count.houses;
    return count;
}

static tn_status count_cell(tn_house_variants *v, uint32_t cell, size_t first, size_t end, tn_cell_count *count,
                            tn_error *error)
{
    if (!tn_fits_wanted(&v->fits, &v->house.cells[cell])) {
        *count = take_any(&v->own, first, end);
        return tn_variants_spend(v, 1, error);
    }
    tn_status status;
    *count = (tn_cell_count){0};
    do {
        size_t tiles = 0;
        set_kinds(v, &v->own, first, end);
        status = tn_variants_spend(v, 1, error);
        if (status == TN_OK)
            status = tn_fits_count(&v->fits, &v->house, cell, &tiles, error);
        count->houses += tiles;
        count->faced += tiles > 0;
    } while (status == TN_OK && tn_wheels_turn(&v->own, first, end));
    return status;
}

static tn_status count_cells(tn_house_variants *v, mpz_t houses, mpz_t faced, tn_error *error)
{
    tn_status status = TN_OK;
    size_t first = 0;
    mpz_set_ui(houses, 1);
    mpz_set_ui(faced, 1);
    for (uint32_t i = 0; status == TN_OK && i < v->house.cell_count && mpz_sgn(houses) > 0; i++) {
        tn_cell_count count;
        size_t end = first;
        while (end < v->own.count && v->house.faces[v->own.items[end].of].first == i)
            end++;
        status = count_cell(v, i, first, end, &count, error);
        mpz_mul_ui(houses, houses, count.houses);
        mpz_mul_ui(faced, faced, count.faced);
        first = end;
    }
    return status;
}

/* All faces are known: the combinations of tiles with which clauses keep the house. */
static tn_status count_kept(tn_house_variants *v, mpz_t houses, mpz_t faced, tn_error *error)
{
    bool fit = false;
    mpz_set_ui(houses, 0);
    tn_status status = tn_variants_count_tiles(v, &fit, error);
    if (status == TN_OK && fit)
        status = tn_furnish(v, error);
    if (status == TN_OK && fit)
        tn_furnished_count(v, houses);
    mpz_set_ui(faced, mpz_sgn(houses) > 0);
    return status;
}

tn_status tn_variants_count_set(tn_house_variants *v, tn_house_counts *counts, tn_error *error)
{
    bool kept = false, zoned = false;
    mpz_t houses, faced;
    mpz_inits(houses, faced, NULL);
    tn_status status = split_faces(v, error);
    do {
        set_kinds(v, &v->shared, 0, v->shared.count);
        if (status == TN_OK)
            status = tn_variants_keep(v, TN_STAGE_FACES, &kept, error);
        if (status != TN_OK || !kept)
            continue;
        status = (v->asks_costs ? count_kept : count_cells)(v, houses, faced, error);
        mpz_add(counts->houses, counts->houses, houses);
        counts->faced += mpz_sgn(houses) > 0 ? mpz_get_ui(faced) : 0;
        zoned |= mpz_sgn(houses) > 0;
    } while (status == TN_OK && tn_wheels_turn(&v->shared, 0, v->shared.count));
    counts->zoned += zoned;
    mpz_clears(houses, faced, NULL);
    return status;
}

tn_status tn_variants_count_faces(tn_house_variants *v, tn_house_counts *counts, tn_error *error)
{
    bool kept = false;
    tn_status status = tn_variants_keep(v, TN_STAGE_FUNCTIONS, &kept, error);
    if (status == TN_OK && kept)
        status = tn_variants_set_faces(v, error);
    return status == TN_OK && kept ? tn_variants_count_set(v, counts, error) : status;
}

/* ==== tiles that fit in a cell
 *
 * Keeps how many tiles fit in cells. */

static void mark_purposes(const tn_house_form *form, const tn_tile_record *tile, bool *wanted)
{
    for (uint32_t i = 0; i < tile->purpose_count; i++)
        wanted[form->module->HOUSE_ITEM_records[tile->purpose_first + i].number] = true;
}

tn_status tn_fits_begin(const tn_house_form *form, tn_fits *fits, tn_error *error)
{
    *fits = (tn_fits){.wanted = calloc((size_t)tn_form_functions(form) + 1, sizeof *fits->wanted)};
    if (!fits->wanted)
        return tn_fail_memory(error);
    for (uint32_t t = 0; t < form->record->tile_count; t++)
        mark_purposes(form, &form->module->TILE_records[form->record->tile_first + t], fits->wanted);
    return TN_OK;
}

void tn_fits_clear(tn_fits *fits)
{
    free(fits->wanted);
    free(fits->counts);
    free(fits->key.data);
    tn_interner_clear(&fits->cells);
    *fits = (tn_fits){0};
}

bool tn_fits_wanted(const tn_fits *fits, const tn_cell *cell)
{
    return !cell->open && cell->function != TN_NO_FUNCTION && fits->wanted[cell->function];
}

/* ---- what the tiles of a cell depend on */

enum { CELL_WORDS = 2 + 2 * 2, FACE_WORDS = 1 + 4 * 2 };

static uint32_t *add_long(uint32_t *word, int64_t value)
{
    *word++ = (uint32_t)value;
    *word++ = (uint32_t)((uint64_t)value >> 32);
    return word;
}

/* What is in the face, and whether it is one of the cell's: others matter by the posts at their ends. */
static uint32_t *add_face(uint32_t *word, const tn_face *face, const tn_cell *cell, uint32_t index)
{
    enum { FIRST = 1, SECOND, OUTSIDE = 4, SIDE = 8, KIND = 64 };
    uint32_t of = face->first == index ? FIRST : face->second == index ? SECOND : 0;
    uint32_t outside = face->relation == TN_FACE_OUTSIDE ? OUTSIDE : 0;
    *word++ = face->kind * KIND + (uint32_t)face->side * SIDE + outside + of;
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

static bool make_key(tn_key *key, const tn_house *house, uint32_t index)
{
    const tn_cell *cell = &house->cells[index];
    if (!tn_array_reserve(&key->data, &key->capacity, 0, CELL_WORDS + house->face_count * FACE_WORDS,
                          sizeof *key->data))
        return false;
    uint32_t *word = key->data;
    *word++ = cell->function;
    *word++ = cell->storey;
    word = add_long(word, cell->at.x1 - cell->at.x0);
    word = add_long(word, cell->at.y1 - cell->at.y0);
    for (size_t i = 0; i < house->face_count; i++)
        if (is_near(&house->faces[i], cell))
            word = add_face(word, &house->faces[i], cell, index);
    key->size = (size_t)(word - key->data);
    return true;
}

static tn_status find_count(const tn_house *house, uint32_t cell, size_t *count, tn_error *error)
{
    tn_variants tiles;
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    *count = tiles.count;
    tn_variants_clear(&tiles);
    return status;
}

tn_status tn_fits_count(tn_fits *fits, const tn_house *house, uint32_t cell, size_t *count, tn_error *error)
{
    if (fits->cells.count == TN_FITS_MAX)
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
