/* Holds choices to what is typed of a house line. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/rank/path.h"

void tn_path_typed_clear(tn_path_typed *t)
{
    free(t->face_value);
    free(t->tile_value);
    free(t->known_with);
    t->face_value = t->tile_value = t->known_with = NULL;
}

tn_status tn_typed_try(uint64_t *work, tn_error *error)
{
    if (*work > 0) {
        --*work;
        return TN_OK;
    }
    tn_status status = tn_fail(error, TN_LIMIT, E_VARIANTS,
                               "finding a house that has what is typed takes more than %u choices", TN_TYPED_WORK);
    tn_error_help(error, "type more of the first values that are left out");
    return status;
}

bool tn_path_typed_section(const tn_path_typed *t, const tn_house *section)
{
    const tn_house_form *form = section->form;
    const tn_module *module = form->module;
    bool allowed = tn_line_has_count(t->asked, TN_LINE_SECTION, form->record->choice_count);
    for (uint32_t i = 0; allowed && i < form->record->choice_count; i++) {
        uint32_t shape = tn_form_choice(form, i)->shape_first + section->shapes[i];
        allowed = tn_line_allows(t->asked, TN_LINE_SECTION, i, tn_text(module, module->SHAPE_records[shape].spelling));
    }
    return allowed;
}

bool tn_path_typed_functions(const tn_path_typed *t, const tn_house *house, uint32_t tray, const uint32_t *functions)
{
    uint32_t first = house->tray_first[tray], end = house->tray_first[tray + 1];
    bool allowed = tn_line_has_count(t->asked, TN_LINE_FUNCTIONS, house->cell_count);
    for (uint32_t i = first; allowed && i < end; i++) {
        const char *name = house->cells[i].open
                               ? "void"
                               : tn_text(house->form->module, tn_form_rule(house->form, functions[i - first])->name);
        allowed = tn_line_allows(t->asked, TN_LINE_FUNCTIONS, i, name);
    }
    return allowed;
}

/* ---- faces and tiles */

static size_t number_faces(const tn_path_typed *t, const tn_house *house)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    size_t count = 0;
    for (size_t i = 0; i < house->face_count; i++)
        t->face_value[i] = tn_face_options(house, &house->faces[i], kinds) > 1 ? count++ : SIZE_MAX;
    return count;
}

static bool has_tiles(const tn_house *house, uint32_t cell)
{
    const tn_form_record *form = house->form->record;
    for (uint32_t i = form->tile_first; i < form->tile_first + form->tile_count; i++)
        if (tn_tile_is_for(house, cell, i))
            return true;
    return false;
}

/* Posts stand where walls end, which other cells may have: all faces that touch a cell matter to its tiles. */
static bool touches(const tn_face *face, const tn_cell *cell)
{
    return face->storey == cell->storey && face->relation != TN_FACE_UNDER && face->at.x0 <= cell->at.x1 &&
           face->at.x1 >= cell->at.x0 && face->at.y0 <= cell->at.y1 && face->at.y1 >= cell->at.y0;
}

static size_t number_tiles(const tn_path_typed *t, const tn_house *house)
{
    size_t count = 0;
    for (uint32_t c = 0; c < house->cell_count; c++) {
        t->tile_value[c] = has_tiles(house, c) ? count++ : SIZE_MAX;
        t->known_with[c] = SIZE_MAX;
        for (size_t i = 0; t->tile_value[c] != SIZE_MAX && i < house->face_count; i++)
            if (touches(&house->faces[i], &house->cells[c]))
                t->known_with[c] = i;
    }
    return count;
}

tn_status tn_path_typed_begin(tn_path_typed *t, const tn_house *house, bool *fits, tn_error *error)
{
    tn_path_typed_clear(t);
    t->face_value = malloc((house->face_count + 1) * sizeof *t->face_value);
    t->tile_value = malloc((house->cell_count + 1) * sizeof *t->tile_value);
    t->known_with = malloc((house->cell_count + 1) * sizeof *t->known_with);
    if (!t->face_value || !t->tile_value || !t->known_with)
        return tn_fail_memory(error);
    *fits = tn_line_has_count(t->asked, TN_LINE_FACES, number_faces(t, house)) &&
            tn_line_has_count(t->asked, TN_LINE_TILES, number_tiles(t, house));
    return TN_OK;
}

/* Does a tile stand in the cell that is as is typed? */
static tn_status stands(const tn_path_typed *t, const tn_house *house, uint32_t cell, bool *stands, tn_error *error)
{
    tn_variants tiles;
    char text[TN_VARIANT_TEXT];
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    *stands = false;
    for (size_t i = 0; !*stands && i < tiles.count; i++) {
        tn_variant_text(house->form, &tiles.variants[i], text);
        *stands = tn_line_allows(t->asked, TN_LINE_TILES, t->tile_value[cell], text);
    }
    tn_variants_clear(&tiles);
    return status;
}

tn_status tn_path_typed_face(tn_path_typed *t, tn_house *house, size_t face, bool *fits, tn_error *error)
{
    const char *kind = tn_form_kind_text(house->form, house->faces[face].kind);
    tn_status status = tn_typed_try(t->work, error);
    *fits = t->face_value[face] == SIZE_MAX || tn_line_allows(t->asked, TN_LINE_FACES, t->face_value[face], kind);
    for (uint32_t c = 0; status == TN_OK && *fits && c < house->cell_count; c++)
        if (t->known_with[c] == face)
            status = stands(t, house, c, fits, error);
    return status;
}

/* ---- lines of houses */

/* Are the words of a part, up to `end`, as is asked? */
static bool fits_part(const tn_line_asked *asked, int part, const char *words, const char *end)
{
    char word[TN_VARIANT_TEXT];
    size_t count = 0;
    while ((words += strspn(words, " |")) < end) {
        size_t size = strcspn(words, " |;");
        if (size < sizeof word && !(size == 1 && *words == '-')) {
            memcpy(word, words, size);
            word[size] = '\0';
            if (!tn_line_allows(asked, part, count++, word))
                return false;
        }
        words += size;
    }
    return tn_line_has_count(asked, part, count);
}

bool tn_typed_line_fits(const tn_line_asked *asked, const char *line)
{
    const char *part = strchr(line, ';');
    bool fits = true;
    for (int p = TN_LINE_SECTION; fits && part && p < TN_LINE_PARTS; p++) {
        const char *end = part + 1 + strcspn(part + 1, ";");
        fits = fits_part(asked, p, part + 1, end);
        part = *end ? end : NULL;
    }
    return fits;
}
