/* Keeps how many tiles fit in cells. */
#include "runtime/house/variant/fit.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

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
