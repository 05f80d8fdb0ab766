/* The house of a number among those on one plan, and the number of a house: section by section, then the functions of
 * one tray after another, then its faces, counted as a whole library is; last its tiles, which are multiplied. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/rank/path.h"

/* kinds: the states of each kind of section, found when one is first met. */
struct tn_plan_houses {
    tn_houses *houses;
    tn_house_variants *variants;
    tn_plan_path *kinds; /* [kinds] */
    tn_tray *trays;
    uint32_t length;
    tn_house_known known; /* of the cells of the house that is looked for */
};

tn_status tn_plan_houses_new(tn_houses *h, tn_house_variants *variants, const tn_tray *trays, uint32_t length,
                             tn_plan_houses **out, tn_error *error)
{
    tn_plan_houses *p = *out = calloc(1, sizeof *p);
    if (!p)
        return tn_fail_memory(error);
    *p = (tn_plan_houses){.houses = h, .variants = variants, .length = length};
    p->kinds = calloc(h->kind_count + 1, sizeof *p->kinds);
    p->trays = malloc(((size_t)length + 1) * sizeof *p->trays);
    if (!p->kinds || !p->trays)
        return tn_fail_memory(error);
    if (length > 0)
        memcpy(p->trays, trays, length * sizeof *trays);
    return tn_house_known_begin(h->form, &p->known, error);
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

/* ---- a section */

static bool has_section(const tn_house *house, const tn_house *section)
{
    return house && memcmp(house->shapes, section->shapes, sizeof house->shapes) == 0;
}

/* Passes over the section, or fills in its house. *ended: the house is of this section; *found: is there one? */
static tn_status try_section(tn_plan_houses *p, const tn_choosing *choosing, const tn_house *section, tn_house *house,
                             bool *ended, bool *found, tn_error *error)
{
    tn_plan_path *path;
    tn_status status = path_of(p, section, &path, error);
    *ended = status == TN_OK &&
             !tn_choosing_passes(choosing, tn_path_layer(path, 0)->ahead[0], has_section(choosing->wanted, section));
    if (!*ended)
        return status;
    status = tn_house_stand(p->houses->form, p->trays, p->length, section->shapes, house, error);
    if (status == TN_OK)
        status = tn_house_known_use(&p->known, house, error);
    if (status == TN_OK)
        status = tn_path_choose(path, choosing, house, found, error);
    house->known = NULL;
    return status;
}

/* Of all sections in their order. */
static tn_status choose_section(tn_plan_houses *p, const tn_choosing *choosing, tn_house *house, bool *found,
                                tn_error *error)
{
    tn_house section = {.form = p->houses->form};
    tn_status status = TN_OK;
    bool ended = false;
    *found = false;
    for (bool more = true; status == TN_OK && !ended && more; more = tn_form_next_section(section.form, section.shapes))
        if (tn_house_section_stands(&section))
            status = try_section(p, choosing, &section, house, &ended, found, error);
    return status;
}

/* ---- houses */

/* left: of the number, when all houses on the plan have been passed over. */
static tn_status too_few(const mpz_t variant, mpz_t left, tn_error *error)
{
    mpz_sub(left, variant, left);
    return tn_house_variants_too_few(left, error);
}

tn_status tn_plan_houses_at(tn_plan_houses *p, const mpz_t variant, tn_house *house, tn_error *error)
{
    mpz_t left;
    mpz_init_set(left, variant);
    const tn_choosing choosing = {.number = left};
    tn_house faced = {0};
    bool found = false;
    *house = (tn_house){0};
    tn_status status = choose_section(p, &choosing, &faced, &found, error);
    if (status == TN_OK)
        status =
            found ? tn_house_variants_furnish(p->variants, &faced, left, house, error) : too_few(variant, left, error);
    tn_house_clear(&faced);
    mpz_clear(left);
    return status;
}

tn_status tn_plan_houses_number(tn_plan_houses *p, const tn_house *house, mpz_t variant, tn_error *error)
{
    const tn_choosing choosing = {.number = variant, .wanted = house};
    tn_house faced = {0};
    bool found = false;
    mpz_t tiles;
    mpz_init(tiles);
    mpz_set_ui(variant, 0);
    tn_status status = choose_section(p, &choosing, &faced, &found, error);
    if (status == TN_OK)
        status =
            found ? tn_house_variants_furnished(p->variants, house, tiles, error) : tn_house_variants_no_house(error);
    mpz_add(variant, variant, tiles);
    tn_house_clear(&faced);
    mpz_clear(tiles);
    return status;
}
