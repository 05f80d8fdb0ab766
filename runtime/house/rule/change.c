/* Tries each other value of each choice of a house, and keeps the rest as it is. */
#include "runtime/house/rule/change.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/house/house.h"

/* Which tile a cell has. */
typedef struct tn_own_tile {
    uint32_t tile;
    tn_house_side side;
    bool mirrored, any;
} tn_own_tile;

typedef struct tn_changing {
    const tn_house *house;
    tn_own_tile *tiles; /* [cell]; owned */
    tn_house_rules *rules;
    const tn_house_library_record *library;
    tn_change_seen *seen;
    void *context;
} tn_changing;

static tn_status read_tiles(tn_changing *c, tn_error *error)
{
    tn_status status = TN_OK;
    c->tiles = calloc(c->house->cell_count + 1, sizeof *c->tiles);
    if (!c->tiles)
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < c->house->cell_count; i++) {
        tn_variants v;
        status = tn_tile_variants(c->house, i, &v, error);
        if (status == TN_OK && c->house->cells[i].variant < v.count) {
            const tn_tile_variant *own = &v.variants[c->house->cells[i].variant];
            c->tiles[i] = (tn_own_tile){own->tile, own->side, own->mirrored, true};
        }
        tn_variants_clear(&v);
    }
    return status;
}

/* ---- carrying choices over to a house that stands anew */

static uint32_t same_cell(const tn_house *in, const tn_cell *cell)
{
    for (uint32_t i = in->tray_first[cell->tray]; i < in->tray_first[cell->tray + 1]; i++)
        if (in->cells[i].zone == cell->zone && in->cells[i].storey == cell->storey)
            return i;
    return TN_NO_CELL;
}

static bool carry_functions(const tn_changing *c, const tn_house_change *change, tn_house *to)
{
    for (uint32_t i = 0; i < to->cell_count; i++) {
        tn_cell *cell = &to->cells[i];
        uint32_t old = same_cell(c->house, cell), wanted = old == TN_NO_CELL ? 0 : c->house->cells[old].function;
        if (cell->open)
            continue;
        if (change->kind == TN_CHANGE_FUNCTION && change->of == i)
            wanted = (uint32_t)change->to;
        if (wanted == TN_NO_FUNCTION || !tn_cell_may(to, cell, wanted))
            for (wanted = 0; wanted < tn_form_functions(to->form) && !tn_cell_may(to, cell, wanted);)
                wanted++;
        if (wanted == tn_form_functions(to->form))
            return false;
        cell->function = wanted;
    }
    return true;
}

/* What was in the face; TN_FACE_KINDS_MAX where there was none like it. */
static uint32_t old_kind(const tn_changing *c, const tn_house *to, const tn_face *face)
{
    uint32_t first = same_cell(c->house, &to->cells[face->first]);
    for (size_t i = 0; first != TN_NO_CELL && i < c->house->face_count; i++) {
        const tn_face *old = &c->house->faces[i];
        if (old->first == first && old->relation == face->relation && old->side == face->side &&
            memcmp(&old->at, &face->at, sizeof face->at) == 0)
            return old->kind;
    }
    return TN_FACE_KINDS_MAX;
}

static void carry_faces(const tn_changing *c, const tn_house_change *change, tn_house *to)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    for (uint32_t i = 0; i < to->face_count; i++) {
        size_t count = tn_face_options(to, &to->faces[i], kinds);
        uint32_t wanted =
            change->kind == TN_CHANGE_FACE && change->of == i ? (uint32_t)change->to : old_kind(c, to, &to->faces[i]);
        to->faces[i].kind = kinds[0];
        for (size_t k = 0; k < count; k++)
            if (kinds[k] == wanted)
                to->faces[i].kind = wanted;
    }
}

static size_t find_tile(const tn_variants *v, const tn_own_tile *own)
{
    for (size_t k = 0; own->any && k < v->count; k++)
        if (v->variants[k].tile == own->tile && v->variants[k].side == own->side &&
            v->variants[k].mirrored == own->mirrored)
            return k;
    return 0;
}

/* *fit: is there a tile for each cell that wants one? */
static tn_status carry_tiles(const tn_changing *c, const tn_house_change *change, tn_house *to, bool *fit,
                             tn_error *error)
{
    tn_status status = TN_OK;
    *fit = true;
    for (uint32_t i = 0; status == TN_OK && *fit && i < to->cell_count; i++) {
        tn_variants v;
        uint32_t old = same_cell(c->house, &to->cells[i]);
        status = tn_tile_variants(to, i, &v, error);
        *fit = v.count > 0;
        if (status == TN_OK && !v.wanted) {
            size_t fillings = 0;
            status = tn_cell_fillings(to, i, &fillings, error);
            *fit = fillings > 0;
        }
        if (old != TN_NO_CELL)
            to->cells[i].variant = find_tile(&v, &c->tiles[old]);
        if (change->kind == TN_CHANGE_TILE && change->of == i)
            to->cells[i].variant = change->to;
        tn_variants_clear(&v);
    }
    return status;
}

/* ---- one change */

static tn_status try_change(tn_changing *c, const tn_house_change *change, tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX];
    tn_house to;
    bool fit = false, kept = false;
    memcpy(shapes, c->house->shapes, sizeof shapes);
    if (change->kind == TN_CHANGE_SECTION)
        shapes[change->of] = (uint32_t)change->to;
    tn_status status = tn_house_stand(c->house->form, c->house->trays, c->house->length, shapes, &to, error);
    if (status == TN_OK && tn_house_section_stands(&to) && carry_functions(c, change, &to)) {
        carry_faces(c, change, &to);
        status = carry_tiles(c, change, &to, &fit, error);
    }
    if (status == TN_OK && fit && c->library)
        status = tn_house_rules_start(c->rules, &to, error);
    if (status == TN_OK && fit && c->library)
        status = tn_house_rules_keep(c->rules, c->library, &kept, error);
    kept = kept || (fit && !c->library);
    if (status == TN_OK && kept)
        status = c->seen(c->context, change, &to, error);
    tn_house_clear(&to);
    return status;
}

/* ---- all of them */

static tn_status change_sections(tn_changing *c, tn_error *error)
{
    const tn_house_form *form = c->house->form;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < form->record->choice_count; i++)
        for (uint32_t k = 0; status == TN_OK && k < tn_form_choice(form, i)->shape_count; k++)
            if (k != c->house->shapes[i])
                status = try_change(c, &(tn_house_change){TN_CHANGE_SECTION, i, c->house->shapes[i], k}, error);
    return status;
}

static tn_status change_function(tn_changing *c, uint32_t cell, tn_error *error)
{
    const tn_cell *of = &c->house->cells[cell];
    tn_status status = TN_OK;
    for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(c->house->form); f++)
        if (f != of->function && tn_cell_may(c->house, of, f))
            status = try_change(c, &(tn_house_change){TN_CHANGE_FUNCTION, cell, of->function, f}, error);
    return status;
}

static tn_status change_face(tn_changing *c, uint32_t face, tn_error *error)
{
    uint32_t kinds[TN_FACE_KINDS_MAX], own = c->house->faces[face].kind;
    size_t count = tn_face_options(c->house, &c->house->faces[face], kinds);
    tn_status status = TN_OK;
    for (size_t k = 0; status == TN_OK && k < count; k++)
        if (kinds[k] != own)
            status = try_change(c, &(tn_house_change){TN_CHANGE_FACE, face, own, kinds[k]}, error);
    return status;
}

static tn_status change_tile(tn_changing *c, uint32_t cell, tn_error *error)
{
    tn_variants v;
    size_t own = c->house->cells[cell].variant;
    tn_status status = tn_tile_variants(c->house, cell, &v, error);
    for (size_t k = 0; status == TN_OK && k < v.count; k++)
        if (k != own)
            status = try_change(c, &(tn_house_change){TN_CHANGE_TILE, cell, own, k}, error);
    tn_variants_clear(&v);
    return status;
}

tn_status tn_house_changes(const tn_house *house, tn_house_rules *rules, const tn_house_library_record *library,
                           uint32_t cell, tn_change_seen *seen, void *context, tn_error *error)
{
    tn_changing c = {.house = house, .rules = rules, .library = library, .seen = seen, .context = context};
    tn_status status = read_tiles(&c, error);
    if (status == TN_OK && cell == TN_NO_CELL)
        status = change_sections(&c, error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (cell == TN_NO_CELL || cell == i)
            status = change_function(&c, i, error);
    for (uint32_t i = 0; status == TN_OK && i < house->face_count; i++)
        if (cell == TN_NO_CELL || house->faces[i].first == cell || house->faces[i].second == cell)
            status = change_face(&c, i, error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (cell == TN_NO_CELL || cell == i)
            status = change_tile(&c, i, error);
    free(c.tiles);
    return status;
}
