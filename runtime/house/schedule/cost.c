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
    return tn_form_openings_part(form) + form->record->opening_count + boxes + 1 + form->record->beam_count;
}

uint32_t tn_form_guard_part(const tn_house_form *form)
{
    return tn_form_parts(form) - form->record->beam_count - 1;
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

uint32_t tn_layer_part(const tn_house_form *form, uint32_t layer)
{
    const char *name = tn_text(form->module, tn_form_layer(form, layer)->name);
    uint32_t first = 0;
    while (strcmp(tn_text(form->module, tn_form_layer(form, first)->name), name) != 0)
        first++;
    return TN_OF_COUNT + first;
}

uint32_t tn_solid_whole_part(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item)
{
    switch (kind) {
    case TN_SOLID_OUTSIDE:
    case TN_SOLID_GABLE:
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
        return tn_form_openings_part(house->form) + house->faces[of].kind - TN_FACE_KIND_COUNT;
    case TN_SOLID_ITEM:
        return tn_form_openings_part(house->form) + house->form->record->opening_count +
               named_first(house->form, item) - first_box(house->form);
    case TN_SOLID_GUARD:
        return tn_form_guard_part(house->form);
    case TN_SOLID_BEAM:
        return tn_form_guard_part(house->form) + 1 + item;
    default:
        return TN_OF_ROOF;
    }
}

uint32_t tn_solid_made_part(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item)
{
    tn_layering layers = tn_solid_layering(house, kind, of, item);
    return layers.count > 0 ? tn_layer_part(house->form, layers.first) : tn_solid_whole_part(house, kind, of, item);
}

/* Is a part of the author's called as floors are? Spaces to keep are none. */
static bool has_own_floor(const tn_house_form *form)
{
    uint32_t boxes = tn_form_openings_part(form) + form->record->opening_count, guard = tn_form_guard_part(form);
    for (uint32_t part = TN_OF_COUNT; part < tn_form_parts(form); part++) {
        bool is_box = part >= boxes && part < guard;
        bool is_kept = is_box && form->module->TILE_BOX_records[first_box(form) + part - boxes].flags & TN_TILE_KEEP;
        if (!is_kept && strcmp(tn_form_part_text(form, part), tn_names_OF[TN_OF_DECK]) == 0)
            return true;
    }
    return false;
}

const char *tn_form_part_text(const tn_house_form *form, uint32_t part)
{
    const tn_module *module = form->module;
    if (part == TN_OF_DECK && has_own_floor(form))
        return TN_FLOOR_BEFORE;
    if (part < TN_OF_COUNT)
        return tn_names_OF[part];
    if (part == tn_form_guard_part(form))
        return tn_solid_kind_text(TN_SOLID_GUARD);
    if (part > tn_form_guard_part(form))
        return tn_text(module, tn_form_beam(form, part - tn_form_guard_part(form) - 1)->name);
    part -= TN_OF_COUNT;
    if (part < form->record->layer_count)
        return tn_text(module, tn_form_layer(form, part)->name);
    part -= form->record->layer_count;
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
    mpz_set_ui(to, (uint64_t)(positive >> 64));
    mpz_mul_2exp(to, to, 64);
    mpz_add_ui(to, to, (uint64_t)positive);
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
static void add_box(const tn_house *house, const tn_solid *s, bool counts, tn_cost_line *line)
{
    bool face = is_wall(s->kind) || s->kind == TN_SOLID_PANE || s->kind == TN_SOLID_LEAF;
    mpz_t area;
    mpq_t volume;
    mpz_init(area);
    mpq_init(volume);
    set_wide(mpq_numref(volume), face ? face_of_wall(house, s) : face_of(s));
    mpq_add(line->area, line->area, volume);
    set_wide(mpq_numref(volume), (tn_int128)(s->at.x1 - s->at.x0) * (s->at.y1 - s->at.y0));
    mpz_set_si(area, s->at.z1 - s->at.z0);
    mpz_mul(mpq_numref(volume), mpq_numref(volume), area);
    mpq_add(line->volume, line->volume, volume);
    line->count += counts;
    mpq_clear(volume);
    mpz_clear(area);
}

/* Each layer of a solid, on the line of its part. Those of a post are as wide as they are long along its wall, like
 * those of walls. */
static void add_layers(const tn_house *house, const tn_solid *s, const tn_layering *layers, bool counts,
                       const tn_costs *costs)
{
    for (uint32_t i = layers->first; i < layers->first + layers->count; i++) {
        tn_solid layer = *s;
        layer.at = tn_layer_box(layers, i, &s->at);
        if (s->kind == TN_SOLID_POST) { /* a piece of that wall */
            layer.of = s->item;
            layer.kind = tn_face_wall(house, &house->faces[s->item]);
        }
        add_box(house, &layer, counts, &costs->lines[tn_layer_part(house->form, i)]);
    }
}

static void set_fraction(mpq_t to, tn_fraction fraction)
{
    set_wide(mpq_numref(to), fraction.top);
    set_wide(mpq_denref(to), fraction.bottom);
}

#define SLOPE_PARTS 1000000000u

/* factor := how much longer a slope is than its plan, which rises so much for each unit of that; rounded down to a
 * billionth, so that the area of a roof is the same however it is cut. Changes both. */
static void set_slope(mpq_t factor, mpq_t rise)
{
    mpz_t root;
    mpz_init(root);
    mpq_set_ui(factor, 1, 1);
    mpq_mul(rise, rise, rise);
    mpq_add(factor, factor, rise);
    mpz_ui_pow_ui(root, SLOPE_PARTS, 2);
    mpz_mul(root, root, mpq_numref(factor));
    mpz_fdiv_q(root, root, mpq_denref(factor)); /* the floor of a root is that of the floor's root */
    mpz_sqrt(mpq_numref(factor), root);
    mpz_set_ui(mpq_denref(factor), SLOPE_PARTS);
    mpq_canonicalize(factor);
    mpz_clear(root);
}

/* difference := a - b. */
static void set_difference(mpq_t difference, tn_fraction a, tn_fraction b)
{
    mpq_t less;
    mpq_init(less);
    set_fraction(difference, a);
    set_fraction(less, b);
    mpq_sub(difference, difference, less);
    mpq_clear(less);
}

/* Twice the area of a triangle in plan, and three times how high the prism is in its middle. */
static void measure_triangle(const tn_prism_corner *a, const tn_prism_corner *b, const tn_prism_corner *c, mpq_t twice,
                             mpq_t thrice)
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    set_difference(x, b->x, a->x);
    set_difference(y, c->y, a->y);
    mpq_mul(twice, x, y);
    set_difference(x, c->x, a->x);
    set_difference(y, b->y, a->y);
    mpq_mul(x, x, y);
    mpq_sub(twice, twice, x);
    set_difference(thrice, a->high, a->low);
    set_difference(x, b->high, b->low);
    mpq_add(thrice, thrice, x);
    set_difference(x, c->high, c->low);
    mpq_add(thrice, thrice, x);
    mpq_clears(x, y, NULL);
}

/* The area and the volume of a prism: of a slab along its slope, of a wall below one as if all of it were so thick. */
static void add_prism(const tn_solids *solids, const tn_prism *prism, int64_t thick, tn_cost_line *line)
{
    const tn_prism_corner *corners = solids->corners + prism->corner_first;
    mpq_t twice, thrice, plan, volume;
    mpq_inits(twice, thrice, plan, volume, NULL);
    for (size_t i = 1; i + 1 < prism->corner_count; i++) {
        measure_triangle(&corners[0], &corners[i], &corners[i + 1], twice, thrice);
        mpq_add(plan, plan, twice);
        mpq_mul(twice, twice, thrice);
        mpq_add(volume, volume, twice);
    }
    mpq_div_2exp(plan, plan, 1);
    mpq_set_ui(twice, 1, 6);
    mpq_mul(volume, volume, twice);
    mpq_add(line->volume, line->volume, volume);
    if (prism->kind == TN_SOLID_ROOF) {
        set_fraction(thrice, prism->rise);
        set_slope(twice, thrice);
        mpq_mul(plan, plan, twice);
    } else {
        mpq_set_si(twice, thick, 1);
        mpq_div(plan, volume, twice);
    }
    mpq_add(line->area, line->area, plan);
    mpq_clears(twice, thrice, plan, volume, NULL);
}

/* Each layer of a prism, on the line of its part. */
static tn_status add_prism_layers(const tn_house *house, const tn_solids *solids, const tn_prism *prism, bool counts,
                                  const tn_costs *costs, tn_error *error)
{
    tn_layering layers = tn_solid_layering(house, prism->kind, prism->of, prism->item);
    tn_solids pieces = {0};
    tn_status status = TN_OK;
    for (uint32_t i = layers.first; status == TN_OK && i < layers.first + layers.count; i++) {
        tn_cost_line *line = &costs->lines[tn_layer_part(house->form, i)];
        pieces.prism_count = pieces.corner_count = 0;
        status = tn_layer_prisms(house, solids, prism, &layers, i, &pieces, error);
        for (size_t k = 0; status == TN_OK && k < pieces.prism_count; k++)
            add_prism(&pieces, &pieces.prisms[k], tn_form_layer(house->form, i)->thick, line);
        line->count += counts;
    }
    tn_solids_clear(&pieces);
    return status;
}

/* A cell has one roof, in however many pieces; the walls below it are no walls more. */
static tn_status add_roofs(const tn_house *house, const tn_solids *solids, tn_costs *costs, tn_error *error)
{
    bool *counted = calloc(house->cell_count + 1, sizeof *counted);
    if (!counted)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < solids->prism_count; i++) {
        const tn_prism *prism = &solids->prisms[i];
        if (prism->kind == TN_SOLID_FLIGHT)
            continue;
        bool counts = prism->kind == TN_SOLID_ROOF && !counted[prism->of];
        counted[prism->of] = counted[prism->of] || counts;
        if (tn_solid_layering(house, prism->kind, prism->of, prism->item).count > 0) {
            status = add_prism_layers(house, solids, prism, counts, costs, error);
            continue;
        }
        tn_cost_line *line = &costs->lines[tn_solid_made_part(house, prism->kind, prism->of, prism->item)];
        add_prism(solids, prism, house->form->record->wall, line);
        line->count += counts;
    }
    free(counted);
    return status;
}

/* ---- costs */

/* What a unit is in nanometres, squared or cubed. */
static void set_unit(mpz_t unit, tn_price_unit per)
{
    bool feet = per == TN_PER_SQUARE_FOOT || per == TN_PER_CUBIC_FOOT;
    unsigned power = per == TN_PER_EACH ? 0 : per <= TN_PER_SQUARE_METRE ? 2 : 3;
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
        mpq_set(line->cost, line->area);
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

void tn_round_to_cent(mpq_t cost)
{
    mpz_t cents;
    mpz_init(cents);
    mpz_mul_ui(cents, mpq_numref(cost), 200);
    mpz_add(cents, cents, mpq_denref(cost));
    mpz_fdiv_q(cents, cents, mpq_denref(cost));
    mpz_fdiv_q_2exp(mpq_numref(cost), cents, 1);
    mpz_set_ui(mpq_denref(cost), 100);
    mpq_canonicalize(cost);
    mpz_clear(cents);
}

static void line_init(tn_cost_line *line, uint32_t part)
{
    *line = (tn_cost_line){.part = part, .material = TN_NO_RECORD};
    mpz_init(line->hundredths);
    mpq_inits(line->area, line->volume, line->cost, NULL);
}

static void line_clear(tn_cost_line *line)
{
    mpz_clear(line->hundredths);
    mpq_clears(line->area, line->volume, line->cost, NULL);
}

static tn_status make_lines(const tn_house *house, tn_costs *costs, tn_error *error)
{
    uint32_t count = tn_form_parts(house->form);
    costs->lines = malloc(count * sizeof *costs->lines);
    if (!costs->lines)
        return tn_fail_memory(error);
    mpz_init(costs->hundredths);
    mpq_init(costs->exact);
    for (; costs->count < count; costs->count++)
        line_init(&costs->lines[costs->count], (uint32_t)costs->count);
    return TN_OK;
}

static tn_cost_line *line_of(const tn_house *house, const tn_solid *s, const tn_costs *costs)
{
    return &costs->lines[tn_solid_made_part(house, s->kind, s->of, s->item)];
}

/* Pieces of one wall or guard follow one another. */
static bool is_piece_of(const tn_solid *s, const tn_solid *before)
{
    return (is_wall(s->kind) || s->kind == TN_SOLID_GUARD) && s->kind == before->kind && s->of == before->of;
}

static void add_wedge(const tn_wedge *wedge, tn_cost_line *line)
{
    tn_int128 twice = 0;
    mpq_t area, high;
    mpq_inits(area, high, NULL);
    for (size_t i = 0; i < wedge->count; i++) {
        const int64_t *a = wedge->at[i], *b = wedge->at[(i + 1) % wedge->count];
        twice += (tn_int128)a[0] * b[1] - (tn_int128)b[0] * a[1];
    }
    set_wide(mpq_numref(area), twice);
    mpq_div_2exp(area, area, 1);
    mpq_add(line->area, line->area, area);
    mpz_set_si(mpq_numref(high), wedge->levels[2] - wedge->levels[0]);
    mpq_mul(area, area, high);
    mpq_add(line->volume, line->volume, area);
    mpq_clears(area, high, NULL);
}

/* Their steps count whole, also where a post stands in one, so that a flight costs the same in all its places. */
static tn_status add_flights(const tn_house *house, const tn_costs *costs, tn_error *error)
{
    tn_flights flights;
    tn_status status = tn_flights_stand(house, &flights, error);
    for (size_t i = 0; status == TN_OK && i < flights.count; i++) {
        const tn_flight *flight = &flights.items[i];
        tn_solid step = {.kind = TN_SOLID_FLIGHT, .of = flight->face};
        tn_cost_line *line = line_of(house, &step, costs);
        line->count += flight->tread_count + flight->wedge_count > 0;
        for (size_t t = 0; t < flight->tread_count; t++) {
            step.at = flight->treads[t];
            add_box(house, &step, false, line);
        }
        for (size_t w = 0; w < flight->wedge_count; w++)
            add_wedge(&flight->wedges[w], line);
    }
    tn_flights_clear(&flights);
    return status;
}

tn_status tn_house_costs(const tn_house *house, const tn_solids *solids, tn_costs *costs, tn_error *error)
{
    tn_solids leaves = {0};
    *costs = (tn_costs){0};
    tn_status status = make_lines(house, costs, error);
    if (status == TN_OK)
        status = tn_house_leaves(house, &leaves, error);
    for (size_t i = 0; status == TN_OK && i < solids->box_count; i++) {
        const tn_solid *s = &solids->boxes[i];
        bool counts = i == 0 || !is_piece_of(s, &solids->boxes[i - 1]);
        tn_layering layers = tn_solid_layering(house, s->kind, s->of, s->item);
        if (layers.count > 0)
            add_layers(house, s, &layers, counts, costs);
        else if (s->kind != TN_SOLID_FLIGHT)
            add_box(house, s, counts, line_of(house, s, costs));
    }
    if (status == TN_OK)
        status = add_flights(house, costs, error);
    for (size_t i = 0; status == TN_OK && i < leaves.box_count; i++)
        add_box(house, &leaves.boxes[i], true, line_of(house, &leaves.boxes[i], costs));
    if (status == TN_OK)
        status = add_roofs(house, solids, costs, error);
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
    for (size_t i = 0; i < costs->count; i++)
        line_clear(&costs->lines[i]);
    if (costs->lines) {
        mpz_clear(costs->hundredths);
        mpq_clear(costs->exact);
    }
    free(costs->lines);
    *costs = (tn_costs){0};
}

tn_status tn_house_bill(const tn_house *house, tn_house_build *build, tn_costs *costs, tn_error *error)
{
    tn_solids solids = {0};
    *costs = (tn_costs){0};
    tn_status status = build(house, &solids, error);
    if (status == TN_OK)
        status = tn_house_costs(house, &solids, costs, error);
    tn_solids_clear(&solids);
    return status;
}

tn_status tn_house_exact_cost(const tn_house *house, tn_house_build *build, mpq_t cost, tn_error *error)
{
    tn_costs costs;
    tn_status status = tn_house_bill(house, build, &costs, error);
    if (status == TN_OK)
        mpq_set(cost, costs.exact);
    tn_costs_clear(&costs);
    return status;
}

void tn_house_items_cost(const tn_house *house, const tn_standing_item *items, size_t count, mpq_t cost)
{
    mpq_set_ui(cost, 0, 1);
    for (size_t i = 0; i < count; i++) {
        const tn_solid solid = {.kind = TN_SOLID_ITEM, .item = items[i].box, .at = items[i].at};
        tn_cost_line line;
        line_init(&line, tn_solid_made_part(house, TN_SOLID_ITEM, 0, items[i].box));
        add_box(house, &solid, true, &line);
        price_line(house, &line);
        mpq_add(cost, cost, line.cost);
        line_clear(&line);
    }
}
