/* The houses on one plan from a number on, and the number of a house: section by section, then the functions of
 * one tray after another, then its faces, counted as a whole library is; last its tiles, which are multiplied. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/rank/path.h"
#include "runtime/house/rule/furnish.h"

/* kinds: the states of each kind of section, found when one is first met. */
struct tn_plan_houses {
    tn_houses *houses;
    tn_furnisher *furnisher; /* borrowed of the houses */
    tn_plan_path *kinds;     /* [kinds] */
    tn_tray *trays;
    uint32_t length;
    tn_house_known known; /* of the cells of the house that is looked for */
};

tn_status tn_plan_houses_new(tn_houses *h, const tn_tray *trays, uint32_t length, tn_plan_houses **out, tn_error *error)
{
    tn_plan_houses *p = *out = calloc(1, sizeof *p);
    if (!p)
        return tn_fail_memory(error);
    *p = (tn_plan_houses){.houses = h, .length = length};
    p->kinds = calloc(h->kind_count + 1, sizeof *p->kinds);
    p->trays = malloc(((size_t)length + 1) * sizeof *p->trays);
    if (!p->kinds || !p->trays)
        return tn_fail_memory(error);
    if (length > 0)
        memcpy(p->trays, trays, length * sizeof *trays);
    tn_status status = tn_houses_furnisher(h, &p->furnisher, error);
    return status == TN_OK ? tn_house_known_begin(h->form, &p->known, error) : status;
}

void tn_plan_houses_free(tn_plan_houses *p)
{
    for (size_t i = 0; p && p->kinds && i < p->houses->kind_count; i++)
        tn_path_clear(&p->kinds[i]);
    if (p) {
        tn_house_known_clear(&p->known);
        free(p->kinds);
        free(p->trays);
    }
    free(p);
}

size_t tn_plan_houses_nodes(const tn_plan_houses *p)
{
    size_t nodes = 0;
    for (size_t i = 0; i < p->houses->kind_count; i++)
        for (uint32_t layer = 0; p->kinds[i].states && layer <= p->length * p->kinds[i].stages; layer++)
            nodes += p->kinds[i].kind.layers[layer].nodes.count;
    return nodes;
}

static tn_status path_of(tn_plan_houses *p, const tn_house *section, tn_plan_path **path, tn_error *error)
{
    const tn_houses_kind *kind = tn_houses_kind_of(p->houses, section);
    *path = &p->kinds[kind - p->houses->kinds];
    return (*path)->states ? TN_OK : tn_path_find(*path, p->houses, kind, p->trays, p->length, error);
}

tn_status tn_plan_houses_count(tn_plan_houses *p, mpz_t houses, tn_error *error)
{
    tn_house section = {.form = p->houses->form};
    tn_status status = TN_OK;
    mpz_set_ui(houses, 0);
    for (bool more = true; status == TN_OK && more; more = tn_form_next_section(section.form, section.shapes)) {
        tn_plan_path *path;
        if (!tn_house_section_stands(&section))
            continue;
        status = path_of(p, &section, &path, error);
        if (status == TN_OK)
            mpz_add(houses, houses, tn_path_layer(path, 0)->ahead[0]);
    }
    return status;
}

/* ---- a section */

static bool has_section(const tn_house *house, const tn_house *section)
{
    return house && memcmp(house->shapes, section->shapes, sizeof house->shapes) == 0;
}

/* Passes over the section, or chooses among its houses, which `house` becomes. */
static tn_status try_section(tn_plan_houses *p, tn_choosing *choosing, const tn_house *section, tn_house *house,
                             tn_error *error)
{
    tn_plan_path *path;
    if (choosing->typed && !tn_path_typed_section(choosing->typed, section))
        return TN_OK;
    tn_status status = path_of(p, section, &path, error);
    if (status != TN_OK ||
        tn_choosing_passes(choosing, tn_path_layer(path, 0)->ahead[0], has_section(choosing->wanted, section)))
        return status;
    status = tn_house_stand_again(p->houses->form, p->trays, p->length, section->shapes, house, error);
    if (status == TN_OK)
        status = tn_house_known_use(&p->known, house, error);
    if (status == TN_OK)
        status = tn_path_choose(path, choosing, house, error);
    house->known = NULL;
    choosing->stop = choosing->stop || choosing->wanted;
    return status;
}

/* Of all sections in their order. */
static tn_status choose_section(tn_plan_houses *p, tn_choosing *choosing, tn_house *house, tn_error *error)
{
    tn_house section = {.form = p->houses->form};
    tn_status status = TN_OK;
    *house = (tn_house){0};
    for (bool more = true; status == TN_OK && !choosing->stop && more;
         more = tn_form_next_section(section.form, section.shapes))
        if (tn_house_section_stands(&section))
            status = try_section(p, choosing, &section, house, error);
    return status;
}

/* ---- houses */

typedef struct tn_furnishing {
    tn_furnisher *furnisher;
    const tn_house *wanted;
    mpz_t count, before; /* of combinations of tiles */
    bool found;
    tn_house_each *each;
    void *context;
} tn_furnishing;

static tn_status furnish(tn_furnishing *f, tn_house *house, const mpz_t before, tn_error *error)
{
    tn_status status = tn_furnish(f->furnisher, house, NULL, f->count, error);
    if (status == TN_OK && mpz_cmp(before, f->count) >= 0)
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the houses with the same faces were counted wrong");
    if (status == TN_OK)
        tn_furnish_at(f->furnisher, before);
    return status;
}

static tn_status take_first(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error)
{
    tn_furnishing *f = context;
    *stop = f->found = true;
    return furnish(f, house, before, error);
}

static tn_status give_all(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error)
{
    tn_furnishing *f = context;
    tn_status status = furnish(f, house, before, error);
    bool more = status == TN_OK;
    while (more && !*stop) {
        status = f->each(f->context, house, stop, error);
        more = status == TN_OK && tn_furnish_next(f->furnisher);
    }
    return status;
}

static tn_status find_wanted(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error)
{
    tn_furnishing *f = context;
    (void)before;
    tn_status status = tn_furnish(f->furnisher, house, NULL, f->count, error);
    *stop = true;
    f->found = status == TN_OK && tn_furnish_has(f->furnisher, f->wanted);
    if (f->found)
        tn_furnish_before(f->furnisher, f->wanted, f->before);
    return status;
}

static void furnishing_begin(const tn_plan_houses *p, tn_furnishing *f)
{
    *f = (tn_furnishing){.furnisher = p->furnisher};
    mpz_inits(f->count, f->before, NULL);
}

static void furnishing_end(tn_furnishing *f)
{
    mpz_clears(f->count, f->before, NULL);
}

/* left: of the number, when all houses on the plan have been passed over. */
static tn_status too_few(const mpz_t variant, mpz_t left, tn_error *error)
{
    mpz_sub(left, variant, left);
    return tn_house_too_few(left, error);
}

tn_status tn_plan_houses_at(tn_plan_houses *p, const mpz_t variant, tn_house *house, tn_error *error)
{
    tn_furnishing f;
    mpz_t left;
    mpz_init_set(left, variant);
    furnishing_begin(p, &f);
    tn_choosing choosing = {.alike = TN_ALIKE_NOTHING, .number = left, .faced = take_first, .context = &f};
    tn_status status = choose_section(p, &choosing, house, error);
    if (status == TN_OK && !f.found)
        status = too_few(variant, left, error);
    furnishing_end(&f);
    mpz_clear(left);
    return status;
}

tn_status tn_plan_houses_each(tn_plan_houses *p, const mpz_t from, tn_house_each *each, void *context, tn_error *error)
{
    tn_furnishing f;
    tn_house house;
    mpz_t left;
    mpz_init_set(left, from);
    furnishing_begin(p, &f);
    f.each = each;
    f.context = context;
    tn_choosing choosing = {.alike = TN_ALIKE_NOTHING, .number = left, .faced = give_all, .context = &f};
    tn_status status = choose_section(p, &choosing, &house, error);
    tn_house_clear(&house);
    furnishing_end(&f);
    mpz_clear(left);
    return status;
}

tn_status tn_plan_houses_number(tn_plan_houses *p, const tn_house *house, mpz_t variant, tn_error *error)
{
    tn_furnishing f;
    tn_house faced;
    furnishing_begin(p, &f);
    f.wanted = house;
    mpz_set_ui(variant, 0);
    tn_choosing choosing = {
        .alike = TN_ALIKE_NOTHING, .number = variant, .wanted = house, .faced = find_wanted, .context = &f};
    tn_status status = choose_section(p, &choosing, &faced, error);
    if (status == TN_OK && !f.found)
        status = tn_house_not_kept(error);
    mpz_add(variant, variant, f.before);
    tn_house_clear(&faced);
    furnishing_end(&f);
    return status;
}

/* ---- what is typed */

/* Takes the first tile of each cell that is as is typed, unless clauses ask what all tiles cost together: then all
 * combinations are gone through. */
typedef struct tn_taking_typed {
    tn_furnishing furnishing;
    tn_path_typed *typed;
} tn_taking_typed;

/* The cell gets the first such tile. */
static tn_status take_tile(const tn_path_typed *typed, tn_house *house, uint32_t cell, bool *found, tn_error *error)
{
    tn_variants tiles;
    char text[TN_VARIANT_TEXT];
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    *found = status == TN_OK && tiles.count == 0;
    for (size_t i = 0; !*found && i < tiles.count; i++) {
        tn_variant_text(house->form, &tiles.variants[i], text);
        *found = tn_line_allows(typed->asked, TN_LINE_TILES, typed->tile_value[cell], text);
        house->cells[cell].variant = i;
    }
    tn_variants_clear(&tiles);
    return status;
}

/* Has the cell the tile that is typed? */
static tn_status has_tile(const tn_path_typed *typed, const tn_house *house, uint32_t cell, bool *has, tn_error *error)
{
    tn_variants tiles;
    char text[TN_VARIANT_TEXT];
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    *has = status == TN_OK && tiles.count == 0;
    if (tiles.count > 0) {
        tn_variant_text(house->form, &tiles.variants[house->cells[cell].variant], text);
        *has = tn_line_allows(typed->asked, TN_LINE_TILES, typed->tile_value[cell], text);
    }
    tn_variants_clear(&tiles);
    return status;
}

static tn_status take_first_tiles(tn_taking_typed *t, tn_house *house, tn_error *error)
{
    tn_status status = TN_OK;
    t->furnishing.found = true;
    for (uint32_t i = 0; status == TN_OK && t->furnishing.found && i < house->cell_count; i++)
        status = take_tile(t->typed, house, i, &t->furnishing.found, error);
    return status;
}

static tn_status try_all_tiles(tn_taking_typed *t, tn_house *house, tn_error *error)
{
    tn_furnishing *f = &t->furnishing;
    mpz_t first;
    tn_status status = TN_OK;
    mpz_init(first);
    tn_furnish_at(f->furnisher, first);
    mpz_clear(first);
    do {
        status = tn_typed_try(t->typed->work, error);
        f->found = status == TN_OK;
        for (uint32_t i = 0; status == TN_OK && f->found && i < house->cell_count; i++)
            status = has_tile(t->typed, house, i, &f->found, error);
    } while (status == TN_OK && !f->found && tn_furnish_next(f->furnisher));
    return status;
}

static tn_status take_typed(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error)
{
    tn_taking_typed *t = context;
    tn_furnishing *f = &t->furnishing;
    (void)before;
    tn_status status = tn_furnish(f->furnisher, house, NULL, f->count, error);
    if (status == TN_OK && mpz_sgn(f->count) > 0)
        status = tn_furnisher_prices(f->furnisher) ? try_all_tiles(t, house, error) : take_first_tiles(t, house, error);
    *stop = f->found;
    return status;
}

tn_status tn_plan_houses_typed(tn_plan_houses *p, const tn_line_asked *asked, uint64_t *work, tn_house *house,
                               bool *found, tn_error *error)
{
    tn_path_typed typed = {.asked = asked, .work = work};
    tn_taking_typed taking = {.typed = &typed};
    mpz_t none;
    mpz_init(none);
    furnishing_begin(p, &taking.furnishing);
    tn_choosing choosing = {
        .alike = TN_ALIKE_NOTHING, .number = none, .typed = &typed, .faced = take_typed, .context = &taking};
    tn_status status = choose_section(p, &choosing, house, error);
    *found = status == TN_OK && taking.furnishing.found;
    furnishing_end(&taking.furnishing);
    tn_path_typed_clear(&typed);
    mpz_clear(none);
    return status;
}

/* ---- without tiles */

typedef struct tn_counting_faced {
    uint64_t most, count;
} tn_counting_faced;

static tn_status count_faced(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error)
{
    tn_counting_faced *c = context;
    (void)house;
    (void)before;
    (void)error;
    *stop = c->count++ == c->most;
    return TN_OK;
}

tn_status tn_plan_houses_faced(tn_plan_houses *p, uint64_t most, uint64_t *faced, bool *known, tn_error *error)
{
    tn_counting_faced c = {.most = most};
    tn_house house;
    mpz_t left;
    mpz_init(left);
    tn_choosing choosing = {.alike = TN_ALIKE_NOTHING, .number = left, .faced = count_faced, .context = &c};
    tn_status status = choose_section(p, &choosing, &house, error);
    tn_house_clear(&house);
    mpz_clear(left);
    *faced = c.count;
    *known = c.count <= most;
    return status;
}
