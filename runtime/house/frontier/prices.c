/* What houses cost, in parts that add up: each tray by itself, between plain walls at its sides, and what stands in
 * each plane between two trays, which is the difference to that.
 *
 * Such parts know all that there is as long as nothing reaches over a whole tray: what a wall, a deck or a roof is at a
 * plane depends on the trays at both of its sides alone. Where that is not so, costs are not counted (E1685). */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"
#include "runtime/house/schedule/cost.h"

/* ---- which costs can be counted so */

enum {
    BY_NUMBER = 1u << TN_PER_EACH,
    BY_VOLUME = 1u << TN_PER_CUBIC_FOOT | 1u << TN_PER_CUBIC_METRE,
    BY_ANY = BY_NUMBER | 1u << TN_PER_SQUARE_FOOT | 1u << TN_PER_SQUARE_METRE | BY_VOLUME
};

/* Has a part a price of such a kind, in any section? */
static bool is_priced(const tn_house_form *form, uint32_t part, uint32_t by)
{
    for (uint32_t i = 0; i < form->record->material_count; i++) {
        const tn_material_record *material = &form->module->MATERIAL_records[form->record->material_first + i];
        for (uint32_t p = 0; p < material->part_count && by >> material->unit & 1; p++)
            if (form->module->HOUSE_ITEM_records[material->part_first + p].number == part)
                return true;
    }
    return false;
}

static bool are_items_priced(const tn_house_form *form)
{
    for (uint32_t part = TN_OF_COUNT + form->record->opening_count; part < tn_form_parts(form); part++)
        if (is_priced(form, part, BY_ANY))
            return true;
    return false;
}

/* The zones' roofs of the section. */
typedef struct tn_roofs {
    bool across;
    int64_t eaves; /* the widest */
} tn_roofs;

static tn_roofs roofs_of(const tn_strip *strip)
{
    tn_house section = {.form = strip->form};
    tn_roofs roofs = {0};
    memcpy(section.shapes, strip->shapes, strip->form->record->choice_count * sizeof *section.shapes);
    for (uint32_t z = 0; z < strip->form->zone_count; z++) {
        const tn_shape_record *shape = tn_house_shape(&section, strip->form->zones[z], TN_CHOICE_ROOF);
        roofs.across = roofs.across || (shape && shape->flags & TN_ROOF_ACROSS);
        roofs.eaves = shape && shape->eaves > roofs.eaves ? shape->eaves : roofs.eaves;
    }
    return roofs;
}

static tn_status refuse(const tn_strip *strip, const char *why, const char *help, tn_error *error)
{
    const tn_house_added *added = strip->added;
    uint32_t k = 0;
    while (mpq_sgn(added->of[k]->cost) == 0)
        k++;
    tn_fail(error, TN_LIMIT, E_COST_OF_ALL, "the costs that `%.60s` adds up cannot be counted: %s",
            tn_text(strip->form->module, added->of[k]->of.name), why);
    tn_error_help(error, "%s", help);
    return TN_LIMIT;
}

static tn_status check_widths(const tn_strip *strip, const tn_roofs *roofs, const bool *trays, tn_error *error)
{
    const tn_house_form *form = strip->form;
    int64_t wall = form->record->wall > form->record->partition ? form->record->wall : form->record->partition;
    int64_t reach = wall + (is_priced(form, TN_OF_ROOF, BY_ANY) ? 2 * roofs->eaves : 0);
    for (tn_tray t = 0; strip->trays_most > 1 && t < form->schema->tray_count; t++)
        if (trays[t] && tn_tray_value_record(form->schema, t, form->width)->length < reach)
            return refuse(strip, "a tray is narrower than the walls and eaves at its sides together",
                          "make the eaves or the walls of the form narrower, or leave out the narrow trays", error);
    return TN_OK;
}

/* Does an opening take the whole height of a storey? */
static bool is_full(const tn_house_form *form, const tn_opening_record *opening)
{
    for (uint32_t k = 0; opening->turn == TN_TURN_NONE && k < form->record->storey_count; k++)
        if (opening->sill == 0 && opening->high == tn_form_clear(form, k))
            return true;
    return false;
}

static tn_status check_openings(const tn_strip *strip, tn_error *error)
{
    const tn_house_form *form = strip->form;
    bool walls = is_priced(form, TN_OF_WALL, BY_NUMBER) || is_priced(form, TN_OF_PARTY, BY_NUMBER) ||
                 is_priced(form, TN_OF_PARTITION, BY_NUMBER);
    for (uint32_t i = 0; i < form->record->opening_count; i++) {
        const tn_opening_record *opening = &form->module->OPENING_records[form->record->opening_first + i];
        if (walls && is_full(form, opening))
            return refuse(strip, "an opening can leave nothing of a wall, and walls have a price each",
                          "give the price of walls per area, or per volume", error);
        if (opening->turn != TN_TURN_NONE && is_priced(form, TN_OF_DECK, BY_NUMBER))
            return refuse(strip, "flights cut decks in pieces, and these have a price each",
                          "give the price of decks per area, or per volume", error);
        if (opening->turn == TN_TURN_QUARTER && is_priced(form, TN_OF_COUNT + i, BY_VOLUME))
            return refuse(strip, "a flight that turns a quarter has a price per volume",
                          "give its price per area, or for each", error);
    }
    return TN_OK;
}

tn_status tn_strip_prices_begin(tn_strip *strip, tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    for (uint32_t k = 0; k < strip->added->count; k++)
        p->asked = p->asked || mpq_sgn(strip->added->of[k]->cost) != 0;
    if (!p->asked)
        return TN_OK;
    p->items = are_items_priced(strip->form);
    p->across = roofs_of(strip).across && is_priced(strip->form, TN_OF_ROOF, BY_ANY);
    const uint32_t none = 0; /* the first list is that of a cell in which nothing fits */
    return tn_intern(&p->lists, &none, 0) == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_strip_prices_check(const tn_strip *strip, const bool *trays, tn_error *error)
{
    tn_roofs roofs = roofs_of(strip);
    if (strip->prices.across && roofs.eaves > 0)
        return refuse(strip, "a section has eaves, and a roof that goes `across`",
                      "keep sections that have only one of both: `prune section(...)`", error);
    tn_status status = check_widths(strip, &roofs, trays, error);
    return status == TN_OK ? check_openings(strip, error) : status;
}

void tn_strip_prices_clear(tn_strip_prices *p)
{
    for (uint32_t i = 0; i < p->numbers.count; i++)
        mpq_clear(p->exact[i]);
    tn_interner_clear(&p->numbers);
    tn_interner_clear(&p->alone.keys);
    tn_interner_clear(&p->planes.keys);
    tn_interner_clear(&p->shapes);
    tn_interner_clear(&p->lists);
    free(p->exact);
    free(p->steps);
    free(p->alone.costs);
    free(p->planes.costs);
    free(p->key.data);
}

/* ---- exact costs, numbered */

static bool push_integer(tn_key *key, const mpz_t number)
{
    size_t words = (mpz_sizeinbase(number, 2) + 31) / 32, written = 0;
    bool ok = tn_key_push(key, (uint32_t)(mpz_sgn(number) + 1)) && tn_key_push(key, (uint32_t)words);
    size_t first = key->size;
    for (size_t i = 0; ok && i < words; i++)
        ok = tn_key_push(key, 0);
    if (ok)
        mpz_export(key->data + first, &written, -1, sizeof *key->data, 0, 0, number);
    return ok;
}

tn_status tn_strip_cost_number(tn_strip *strip, const mpq_t cost, uint32_t *number, tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    uint32_t before = p->numbers.count;
    p->key.size = 0;
    bool ok = push_integer(&p->key, mpq_numref(cost)) && push_integer(&p->key, mpq_denref(cost)) &&
              tn_array_reserve(&p->exact, &p->room, before, 1, sizeof *p->exact);
    *number = ok ? tn_intern(&p->numbers, p->key.data, p->key.size) : UINT32_MAX;
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (*number < before)
        return TN_OK;
    mpq_init(p->exact[before]);
    mpq_set(p->exact[before], cost);
    return TN_OK;
}

void tn_strip_cost_unit(const tn_strip *strip, mpq_t unit)
{
    mpq_t cost;
    mpq_init(cost);
    for (uint32_t i = 0; i < strip->prices.numbers.count; i++) {
        mpq_abs(cost, strip->prices.exact[i]);
        tn_common_unit(unit, cost);
    }
    mpq_clear(cost);
}

tn_status tn_strip_settle(tn_strip *strip, const tn_strip_units *units, tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    p->steps = calloc((size_t)p->numbers.count + 1, sizeof *p->steps);
    strip->units = units;
    if (!p->steps)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < p->numbers.count; i++)
        if (!tn_steps_of(p->exact[i], units->cost, &p->steps[i]))
            return tn_too_fine(error);
    return TN_OK;
}

/* ---- trays */

/* The number of the house's cost without what stands in its rooms, less what trays to the left and right of a plane
 * cost by themselves (NULL: nothing is taken off), by the key at hand: it is found once. */
static tn_status keyed_cost(tn_strip *strip, tn_strip_keyed *known, const tn_house *house, const tn_strip_edge *left,
                            const tn_strip_edge *right, uint32_t *number, tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    uint32_t before = known->keys.count;
    bool ok = tn_array_reserve(&known->costs, &known->room, before, 1, sizeof *known->costs);
    uint32_t at = ok ? tn_intern(&known->keys, p->key.data, p->key.size) : UINT32_MAX;
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before) {
        mpq_t cost;
        mpq_init(cost);
        status = tn_house_exact_cost(house, tn_house_shell, cost, error);
        if (left)
            mpq_sub(cost, cost, p->exact[left->cost]);
        if (right)
            mpq_sub(cost, cost, p->exact[right->cost]);
        if (status == TN_OK)
            status = tn_strip_cost_number(strip, cost, &known->costs[at], error);
        mpq_clear(cost);
    }
    *number = known->costs[at];
    return status;
}

tn_status tn_strip_tray_cost(tn_strip *strip, const tn_house *house, uint32_t *number, tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    p->key.size = 0;
    bool ok = tn_key_push(&p->key, house->trays[0]);
    for (size_t i = 0; ok && i < house->face_count; i++)
        if (tn_face_is_inner(&house->faces[i]))
            ok = tn_key_push(&p->key, house->faces[i].kind);
    return ok ? keyed_cost(strip, &p->alone, house, NULL, NULL, number, error) : tn_fail_memory(error);
}

/* Is there no floor above the face? */
static bool is_hole(const tn_face *face)
{
    return face->relation == TN_FACE_UNDER && (face->kind == TN_FACE_STAIR || face->kind == TN_FACE_OPEN);
}

bool tn_strip_push_shape(const tn_strip *strip, const tn_house *house, tn_key *key)
{
    int64_t width = tn_tray_value_record(strip->form->schema, house->trays[0], strip->form->width)->length;
    bool ok = tn_push_long(key, strip->prices.across ? (uint64_t)width : 0);
    for (size_t i = 0; ok && i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        ok = tn_push_long(key, (uint64_t)cell->at.y0) && tn_push_long(key, (uint64_t)cell->at.y1) &&
             tn_key_push(key, cell->storey << 1 | cell->open) && tn_key_push(key, cell->zone);
    }
    for (size_t i = 0; ok && i < house->face_count; i++)
        if (house->faces[i].relation == TN_FACE_UNDER)
            ok = tn_key_push(key, is_hole(&house->faces[i]));
    return ok;
}

/* ---- planes */

tn_status tn_strip_plane_cost(tn_strip *strip, const tn_strip_border *border, const tn_house *house, uint32_t *number,
                              tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    p->key.size = 0;
    bool ok = tn_key_push(&p->key, border->left ? border->left->shape : TN_STRIP_NONE) &&
              tn_key_push(&p->key, border->right ? border->right->shape : TN_STRIP_NONE);
    for (size_t i = 0; ok && i < border->count; i++)
        ok = tn_key_push(&p->key, house->faces[border->faces[i]].kind);
    return ok ? keyed_cost(strip, &p->planes, house, border->left, border->right, number, error)
              : tn_fail_memory(error);
}

/* ---- tiles */

/* {cost, how many} of each cost, from the cost of each. */
static bool push_list(tn_key *key, uint32_t *costs, size_t count)
{
    bool ok = true;
    key->size = 0;
    if (count > 0)
        qsort(costs, count, sizeof *costs, tn_words_compare);
    for (size_t i = 0, end; ok && i < count; i = end) {
        for (end = i; end < count && costs[end] == costs[i];)
            end++;
        ok = tn_key_push(key, costs[i]) && tn_key_push(key, (uint32_t)(end - i));
    }
    return ok;
}

tn_status tn_strip_list_tiles(tn_strip *strip, const tn_house *house, const tn_variants *variants, uint32_t *list,
                              tn_error *error)
{
    tn_strip_prices *p = &strip->prices;
    uint32_t *costs = malloc((variants->count + 1) * sizeof *costs);
    mpq_t cost;
    mpq_init(cost);
    tn_status status = costs ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < variants->count; i++) {
        const tn_tile_variant *variant = &variants->variants[i];
        tn_house_items_cost(house, variants->items + variant->item_first, variant->item_count, cost);
        status = tn_strip_cost_number(strip, cost, &costs[i], error);
    }
    if (status == TN_OK) {
        bool ok = push_list(&p->key, costs, variants->count);
        *list = ok ? tn_intern(&p->lists, p->key.data, p->key.size) : UINT32_MAX;
        status = *list != UINT32_MAX ? TN_OK : tn_fail_memory(error);
    }
    mpq_clear(cost);
    free(costs);
    return status;
}
