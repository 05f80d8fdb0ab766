/* The C interface to lists of houses: those drawn at random, and what else a house could be. */
#include "api/house/houses.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/rule/change.h"

tartan_houses *tn_api_houses_new(tartan_house_library *library)
{
    tartan_houses *made = calloc(1, sizeof *made);
    if (made)
        made->library = library;
    return made;
}

tn_status tn_api_houses_add(tartan_houses *houses, const tn_house *house, tn_api_listed **added, tn_error *error)
{
    if (!tn_array_reserve(&houses->items, &houses->room, houses->count, 1, sizeof *houses->items))
        return tn_fail_memory(error);
    tn_api_listed *item = &houses->items[houses->count];
    *item = (tn_api_listed){.house = {.library = houses->library}};
    tn_status status = tn_house_copy(house, &item->house.house, error);
    houses->count += status == TN_OK;
    *added = item;
    return status;
}

/* Texts of changes are in the list, which does not move any more. */
static void point_at_words(tartan_houses *houses)
{
    for (size_t i = 0; houses->changed && i < houses->count; i++) {
        tn_api_listed *item = &houses->items[i];
        item->change.where = item->words.where;
        item->change.from = item->words.from;
        item->change.to = item->words.to;
    }
}

tartan_status tn_api_houses_give(tartan_houses *made, tartan_status status, tartan_houses **houses)
{
    if (status == TARTAN_OK) {
        point_at_words(made);
        *houses = made;
    } else {
        tartan_houses_free(made);
    }
    return status;
}

void tartan_houses_free(tartan_houses *houses)
{
    if (!houses)
        return;
    for (size_t i = 0; i < houses->count; i++) {
        tn_house_clear(&houses->items[i].house.house);
        for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
            free(houses->items[i].values[k]);
    }
    free(houses->items);
    free(houses);
}

size_t tartan_houses_count(const tartan_houses *houses)
{
    return houses->count;
}

const tartan_house *tartan_houses_house(const tartan_houses *houses, size_t i)
{
    return i < houses->count ? &houses->items[i].house : NULL;
}

const char *tartan_houses_value(const tartan_houses *houses, size_t i, size_t wish)
{
    return i < houses->count && wish < houses->wishes ? houses->items[i].values[wish] : NULL;
}

const tartan_house_change *tartan_houses_change(const tartan_houses *houses, size_t i)
{
    return houses->changed && i < houses->count ? &houses->items[i].change : NULL;
}

/* ---- drawn at random */

static tn_status add_drawn(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    tn_api_listed *added;
    (void)rank, (void)variant;
    return tn_api_houses_add(context, house, &added, error);
}

tartan_status tartan_house_sample(tartan_house_library *library, const tartan_on_plan *plan, uint64_t seed,
                                  size_t count, const tartan_watch *watch, tartan_houses **houses, tartan_error *error)
{
    tn_error found;
    const tn_plan *of;
    if (!houses)
        return tn_api_missing(error, "room for the houses");
    if (count > TARTAN_HOUSES_MAX)
        return tn_api_refuse(error, TARTAN_LIMIT, "a list has at most %d houses", TARTAN_HOUSES_MAX);
    tartan_status status = tn_api_houses_begin(library, watch, error);
    if (status != TARTAN_OK)
        return status;
    tartan_houses *made = tn_api_houses_new(library);
    tn_status drawn = made ? tn_api_houses_on(library, plan, &of, &found) : tn_fail_memory(&found);
    if (drawn == TN_OK)
        drawn = tn_numbered_sample(&library->numbered, of, count, seed, false, add_drawn, made, &found);
    return tn_api_houses_give(made, tn_api_houses_end(library, drawn, &found, error), houses);
}

/* ---- variants */

_Static_assert((int)TARTAN_CHANGE_SECTION == (int)TN_CHANGE_SECTION && (int)TARTAN_CHANGE_TILE == (int)TN_CHANGE_TILE,
               "kinds of changes are the same numbers");

/* The house that is varied, and where its variants go. */
typedef struct varying {
    const tn_house *house;
    tartan_houses *made;
} varying;

static tn_status add_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    varying *v = context;
    tn_api_listed *added;
    tn_status status = tn_api_houses_add(v->made, changed, &added, error);
    if (status != TN_OK)
        return status;
    added->change.kind = (tartan_change_kind)change->kind;
    tn_change_text(v->house, change, &added->words);
    return TN_OK;
}

/* TRAY.ZONE.STOREY, trays from 1; NULL: TN_NO_CELL. */
static tn_status find_cell(const tn_house *house, const char *text, uint32_t *cell, tn_error *error)
{
    char named[96];
    *cell = TN_NO_CELL;
    for (uint32_t i = 0; text && i < house->cell_count; i++) {
        tn_cell_text(house, i, named, sizeof named);
        if (strcmp(named, text) == 0)
            *cell = i;
    }
    if (!text || *cell != TN_NO_CELL)
        return TN_OK;
    tn_status status = tn_fail(error, TN_INVALID, TN_CODE_NONE, "the house has no cell `%.60s`", text);
    tn_error_help(error, "a cell is TRAY.ZONE.STOREY, such as 1.body.ground; trays count from 1");
    return status;
}

static tn_status vary(const tartan_house *house, const char *at, tartan_houses *made, tn_error *error)
{
    tn_numbered *n = &house->library->numbered;
    tn_house_rules *rules = NULL;
    uint32_t cell;
    varying v = {.house = &house->house, .made = made};
    mpz_t plan, variant;
    mpz_inits(plan, variant, NULL);
    tn_status status = find_cell(v.house, at, &cell, error);
    if (status == TN_OK) /* does the library keep it? */
        status = tn_numbered_name(n, v.house, plan, variant, error);
    if (status == TN_OK)
        status = tn_house_rules_new(&n->form, 0, &rules, error);
    if (status == TN_OK)
        status = tn_house_changes(v.house, rules, n->record, cell, add_change, &v, error);
    tn_house_rules_free(rules);
    mpz_clears(plan, variant, NULL);
    return status;
}

tartan_status tartan_house_variants(const tartan_house *house, const char *cell, const tartan_watch *watch,
                                    tartan_houses **houses, tartan_error *error)
{
    tn_error found;
    if (!house || !houses)
        return tn_api_missing(error, house ? "room for the houses" : "house");
    tartan_status status = tn_api_houses_begin(house->library, watch, error);
    if (status != TARTAN_OK)
        return status;
    tartan_houses *made = tn_api_houses_new(house->library);
    tn_status varied = made ? vary(house, cell, made, &found) : tn_fail_memory(&found);
    if (made)
        made->changed = true;
    return tn_api_houses_give(made, tn_api_houses_end(house->library, varied, &found, error), houses);
}
