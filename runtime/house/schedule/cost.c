/* Counts and measures the parts of a house, and multiplies by prices. */
#include "runtime/house/schedule/cost.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/house/model/model.h"

/* ---- parts */

static uint32_t first_box(const tn_house_form *form)
{
    return form->record->tile_count ? form->module->TILE_records[form->record->tile_first].box_first : 0;
}

uint32_t tn_form_parts(const tn_house_form *form)
{
    uint32_t boxes = 0;
    for (uint32_t i = 0; i < form->record->tile_count; i++)
        boxes += form->module->TILE_records[form->record->tile_first + i].box_count;
    return TN_OF_COUNT + form->record->opening_count + boxes;
}

/* The first box that has the name of this one and is no space to keep. */
static uint32_t named_first(const tn_house_form *form, uint32_t box)
{
    const tn_tile_box_record *boxes = form->module->TILE_BOX_records;
    const char *name = tn_text(form->module, boxes[box].name);
    uint32_t first = first_box(form);
    while (boxes[first].flags & TN_TILE_KEEP || strcmp(tn_text(form->module, boxes[first].name), name) != 0)
        first++;
    return first;
}

uint32_t tn_solid_made_part(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item)
{
    switch (kind) {
    case TN_SOLID_OUTSIDE:
        return TN_OF_WALL;
    case TN_SOLID_PARTY:
        return TN_OF_PARTY;
    case TN_SOLID_PARTITION:
        return TN_OF_PARTITION;
    case TN_SOLID_POST:
        return TN_OF_POST;
    case TN_SOLID_DECK:
    case TN_SOLID_ROOFDECK:
        return TN_OF_DECK;
    case TN_SOLID_PANE:
    case TN_SOLID_LEAF:
    case TN_SOLID_FLIGHT:
        return TN_OF_COUNT + house->faces[of].kind - TN_FACE_KIND_COUNT;
    case TN_SOLID_ITEM:
        return TN_OF_COUNT + house->form->record->opening_count + named_first(house->form, item) -
               first_box(house->form);
    default:
        return TN_OF_ROOF;
    }
}

const char *tn_form_part_text(const tn_house_form *form, uint32_t part)
{
    static const char *const words[TN_OF_COUNT] = {"wall", "party", "partition", "post", "deck", "roof"};
    const tn_module *module = form->module;
    if (part < TN_OF_COUNT)
        return words[part];
    part -= TN_OF_COUNT;
    if (part < form->record->opening_count)
        return tn_text(module, module->OPENING_records[form->record->opening_first + part].name);
    return tn_text(module, module->TILE_BOX_records[first_box(form) + part - form->record->opening_count].name);
}

uint32_t tn_part_material(const tn_house *house, uint32_t part)
{
    const tn_house_form *form = house->form;
    for (uint32_t i = 0; i < form->record->material_count; i++) {
        uint32_t index = form->record->material_first + i;
        const tn_material_record *material = &form->module->MATERIAL_records[index];
        for (uint32_t p = 0; p < material->part_count; p++)
            if (form->module->HOUSE_ITEM_records[material->part_first + p].number == part &&
                (material->where == TN_NO_RECORD || tn_house_decide(house, material->where, NULL)))
                return index;
    }
    return TN_NO_RECORD;
}

/* ---- quantities */

static void set_wide(mpz_t to, tn_int128 number)
{
    tn_int128 positive = number < 0 ? -number : number;
    mpz_set_ui(to, (unsigned long)(positive >> 64));
    mpz_mul_2exp(to, to, 64);
    mpz_add_ui(to, to, (unsigned long)(uint64_t)positive);
    if (number < 0)
        mpz_neg(to, to);
}

/* The face of a box that counts: in its plane for what lies, upright for what stands. */
static tn_int128 face_of(const tn_solid *s)
{
    tn_int128 x = s->at.x1 - s->at.x0, y = s->at.y1 - s->at.y0, z = s->at.z1 - s->at.z0;
    bool lies = s->kind == TN_SOLID_DECK || s->kind == TN_SOLID_ROOFDECK || s->kind == TN_SOLID_ITEM ||
                s->kind == TN_SOLID_FLIGHT;
    return lies ? x * y : (x > y ? x : y) * z;
}

/* A wall that runs along x is as wide as it is long there, however short it is. */
static tn_int128 face_of_wall(const tn_house *house, const tn_solid *s)
{
    const tn_rectangle *at = &house->faces[s->of].at;
    tn_int128 along = at->x0 == at->x1 ? s->at.y1 - s->at.y0 : s->at.x1 - s->at.x0;
    return along * (s->at.z1 - s->at.z0);
}

static bool is_wall(tn_solid_kind kind)
{
    return kind == TN_SOLID_OUTSIDE || kind == TN_SOLID_PARTY || kind == TN_SOLID_PARTITION;
}

/* `counts`: is it more than another piece of the same wall? */
static void add_box(const tn_house *house, const tn_solid *s, bool counts, tn_costs *costs)
{
    tn_cost_line *line = &costs->lines[tn_solid_made_part(house, s->kind, s->of, s->item)];
    bool face = is_wall(s->kind) || s->kind == TN_SOLID_PANE || s->kind == TN_SOLID_LEAF;
    mpz_t area;
    mpq_t volume;
    mpz_init(area);
    mpq_init(volume);
    set_wide(area, face ? face_of_wall(house, s) : face_of(s));
    mpz_add(line->area, line->area, area);
    set_wide(mpq_numref(volume), (tn_int128)(s->at.x1 - s->at.x0) * (s->at.y1 - s->at.y0));
    mpz_set_si(area, s->at.z1 - s->at.z0);
    mpz_mul(mpq_numref(volume), mpq_numref(volume), area);
    mpq_add(line->volume, line->volume, volume);
    line->count += counts;
    mpq_clear(volume);
    mpz_clear(area);
}

static void set_fraction(mpq_t to, tn_fraction fraction)
{
    set_wide(mpq_numref(to), fraction.top);
    set_wide(mpq_denref(to), fraction.bottom);
}

/* The stretch of a roof between two points of its line: an upright strip as wide as the prism, or a slab. */
static void add_slope(const tn_prism *prism, const tn_roof_point *points, tn_cost_line *line)
{
    mpq_t y, z, middle, wide;
    mpz_t root;
    mpq_inits(y, z, middle, wide, NULL);
    mpz_init(root);
    mpq_set_si(wide, prism->base, 1);
    set_fraction(y, points[0].z);
    set_fraction(z, points[1].z);
    mpq_add(middle, y, z);
    mpq_div_2exp(middle, middle, 1);
    mpq_sub(middle, middle, wide); /* how high in the middle */
    if (prism->slab)
        mpq_set_si(middle, prism->slab, 1);
    mpq_sub(z, z, y); /* how far it rises */
    set_fraction(y, points[0].y);
    set_fraction(wide, points[1].y);
    mpq_sub(y, wide, y); /* how deep */
    mpq_set_si(wide, prism->to - prism->from, 1);
    mpq_mul(middle, middle, y);
    mpq_mul(middle, middle, wide);
    mpq_add(line->volume, line->volume, middle);
    mpq_mul(y, y, y);
    mpq_mul(z, z, z);
    mpq_add(z, z, y);
    mpq_mul(z, z, wide);
    mpq_mul(z, z, wide);
    mpz_fdiv_q(root, mpq_numref(z), mpq_denref(z)); /* the floor of a root is that of the floor's root */
    mpz_sqrt(root, root);
    mpz_add(line->area, line->area, root);
    mpq_clears(y, z, middle, wide, NULL);
    mpz_clear(root);
}

static void add_roof(const tn_solids *solids, const tn_prism *prism, tn_costs *costs)
{
    tn_cost_line *line = &costs->lines[TN_OF_ROOF];
    const tn_roof_point *points = solids->points + prism->point_first;
    for (size_t i = 0; i + 1 < prism->point_count; i++)
        add_slope(prism, points + i, line);
    line->count++;
}

/* ---- costs */

/* What a unit is in nanometres, squared or cubed. */
static void set_unit(mpz_t unit, tn_price_unit per)
{
    bool feet = per == TN_PER_SQUARE_FOOT || per == TN_PER_CUBIC_FOOT;
    unsigned long power = per == TN_PER_EACH ? 0 : per <= TN_PER_SQUARE_METRE ? 2 : 3;
    mpz_ui_pow_ui(unit, feet ? 304800000u : 1000000000u, power);
}

static void price_line(const tn_house *house, tn_cost_line *line)
{
    line->material = tn_part_material(house, line->part);
    if (line->material == TN_NO_RECORD)
        return;
    const tn_material_record *material = &house->form->module->MATERIAL_records[line->material];
    mpq_t factor;
    mpq_init(factor);
    if (material->unit == TN_PER_EACH)
        mpq_set_ui(line->cost, line->count, 1);
    else if (material->unit <= TN_PER_SQUARE_METRE)
        mpq_set_z(line->cost, line->area);
    else
        mpq_set(line->cost, line->volume);
    mpz_set_si(mpq_numref(factor), material->price);
    set_unit(mpq_denref(factor), (tn_price_unit)material->unit);
    mpz_mul_ui(mpq_denref(factor), mpq_denref(factor), 1000000);
    mpq_canonicalize(factor);
    mpq_mul(line->cost, line->cost, factor);
    mpq_set_ui(factor, 100, 1); /* half up: the floor of twice a hundred times it and one, halved */
    mpq_mul(factor, factor, line->cost);
    mpz_mul_2exp(line->hundredths, mpq_numref(factor), 1);
    mpz_add(line->hundredths, line->hundredths, mpq_denref(factor));
    mpz_mul_2exp(mpq_denref(factor), mpq_denref(factor), 1);
    mpz_fdiv_q(line->hundredths, line->hundredths, mpq_denref(factor));
    mpq_clear(factor);
}

static tn_status make_lines(const tn_house *house, tn_costs *costs, tn_error *error)
{
    uint32_t count = tn_form_parts(house->form);
    costs->lines = malloc(count * sizeof *costs->lines);
    if (!costs->lines)
        return tn_fail_memory(error);
    mpz_init(costs->hundredths);
    mpq_init(costs->exact);
    for (; costs->count < count; costs->count++) {
        tn_cost_line *line = &costs->lines[costs->count];
        *line = (tn_cost_line){.part = (uint32_t)costs->count, .material = TN_NO_RECORD};
        mpz_inits(line->area, line->hundredths, NULL);
        mpq_inits(line->volume, line->cost, NULL);
    }
    return TN_OK;
}

tn_status tn_house_costs(const tn_house *house, const tn_solids *solids, tn_costs *costs, tn_error *error)
{
    tn_solids leaves = {0};
    *costs = (tn_costs){0};
    tn_status status = make_lines(house, costs, error);
    if (status == TN_OK)
        status = tn_house_leaves(house, &leaves, error);
    uint32_t wall = TN_NO_CELL; /* pieces of one wall or flight follow one another */
    for (size_t i = 0; status == TN_OK && i < solids->box_count; i++) {
        const tn_solid *s = &solids->boxes[i];
        bool pieces = is_wall(s->kind) || s->kind == TN_SOLID_FLIGHT;
        add_box(house, s, !pieces || s->of != wall, costs);
        wall = pieces ? s->of : TN_NO_CELL;
    }
    for (size_t i = 0; status == TN_OK && i < leaves.box_count; i++)
        add_box(house, &leaves.boxes[i], true, costs);
    for (size_t i = 0; status == TN_OK && i < solids->prism_count; i++)
        add_roof(solids, &solids->prisms[i], costs);
    for (size_t i = 0; status == TN_OK && i < costs->count; i++) {
        price_line(house, &costs->lines[i]);
        mpz_add(costs->hundredths, costs->hundredths, costs->lines[i].hundredths);
        mpq_add(costs->exact, costs->exact, costs->lines[i].cost);
    }
    tn_solids_clear(&leaves);
    return status;
}

void tn_costs_clear(tn_costs *costs)
{
    for (size_t i = 0; i < costs->count; i++) {
        mpz_clears(costs->lines[i].area, costs->lines[i].hundredths, NULL);
        mpq_clears(costs->lines[i].volume, costs->lines[i].cost, NULL);
    }
    if (costs->lines) {
        mpz_clear(costs->hundredths);
        mpq_clear(costs->exact);
    }
    free(costs->lines);
    *costs = (tn_costs){0};
}
