/* Writes what a house is made of: everything as JSON, its rooms as a table, its parts with their costs as another. */
#include "runtime/house/schedule/describe.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/ways.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/integers.h"

/* ---- numbers beyond 64 bits */

static void put_wide(tn_buffer *out, tn_int128 number)
{
    char digits[48];
    size_t at = sizeof digits;
    bool negative = number < 0;
    do {
        int digit = (int)(number % 10);
        digits[--at] = (char)('0' + (digit < 0 ? -digit : digit));
        number /= 10;
    } while (number);
    if (negative)
        digits[--at] = '-';
    tn_buffer_append(out, digits + at, sizeof digits - at);
}

/* "7" or "7/2" */
static void put_fraction(tn_json *json, tn_fraction fraction)
{
    tn_buffer text = {0};
    put_wide(&text, fraction.top);
    if (fraction.bottom != 1) {
        tn_buffer_append(&text, "/", 1);
        put_wide(&text, fraction.bottom);
    }
    json->text->failed |= text.failed;
    tn_json_string(json, NULL, text.data);
    free(text.data);
}

static void put_lengths(tn_json *json, const char *key, const int64_t *lengths, size_t count)
{
    tn_json_list(json, key);
    for (size_t i = 0; i < count; i++)
        tn_json_whole(json, NULL, lengths[i]);
    tn_json_list_end(json);
}

static void put_rectangle(tn_json *json, const char *key, tn_rectangle r)
{
    put_lengths(json, key, (const int64_t[]){r.x0, r.x1, r.y0, r.y1}, 4);
}

static void put_box(tn_json *json, tn_box b)
{
    put_lengths(json, "box", (const int64_t[]){b.x0, b.x1, b.y0, b.y1, b.z0, b.z1}, 6);
}

static void put_area(tn_json *json, const char *key, tn_int128 area)
{
    tn_buffer text = {0};
    put_wide(&text, area);
    json->text->failed |= text.failed;
    tn_json_string(json, key, text.data);
    free(text.data);
}

static const char *function_of(const tn_house *house, const tn_cell *cell)
{
    return cell->open ? "void" : tn_text(house->form->module, tn_form_rule(house->form, cell->function)->name);
}

static const char *storey_of(const tn_house *house, uint32_t storey)
{
    return tn_text(house->form->module,
                   house->form->module->STOREY_records[house->form->record->storey_first + storey].name);
}

/* ---- lists */

static void put_cells(const tn_house *house, tn_json *json)
{
    const tn_house_form *form = house->form;
    tn_json_list(json, "cells");
    for (uint32_t i = 0; i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        tn_json_object(json, NULL);
        tn_json_count(json, "id", i);
        tn_json_count(json, "tray", cell->tray);
        tn_json_string(json, "zone", tn_text(form->module, form->schema->fields[cell->zone].name));
        tn_json_count(json, "storey", cell->storey);
        put_rectangle(json, "rect", cell->at);
        tn_json_string(json, "function", function_of(house, cell));
        put_rectangle(json, "inner", tn_cell_clear(house, i));
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void put_options(const tn_house *house, const tn_face *face, tn_json *json)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    size_t count = tn_face_options(house, face, kinds);
    tn_json_list(json, "options");
    for (size_t i = 0; i < count; i++)
        tn_json_string(json, NULL, tn_form_kind_text(house->form, kinds[i]));
    tn_json_list_end(json);
}

/* Where an opening begins and ends along its face, if it is not in the middle. */
static void put_opening(const tn_house *house, const tn_face *face, tn_json *json)
{
    const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
    bool in_y = face->at.x0 == face->at.x1;
    if (!opening || (in_y ? opening->near_y : opening->near_x) == TN_HOUSE_ANY_SIDE)
        return;
    int64_t from = tn_opening_begins(face, opening);
    put_lengths(json, "opening", (const int64_t[]){from, from + opening->wide}, 2);
}

/* If the form asks for ways: which cell a leaf opens into; where one stands before a flight and behind it. */
static tn_status put_ways(const tn_house *house, const tn_face *face, tn_json *json, tn_error *error)
{
    uint32_t leaf = face->relation == TN_FACE_UNDER ? TN_NO_CELL : tn_face_leaf(house, face);
    tn_flight flight = {0};
    tn_status status = TN_OK;
    if (leaf != TN_NO_CELL)
        tn_json_count(json, "leaf", leaf);
    if (face->relation == TN_FACE_UNDER)
        status = tn_flight_stand(house, face, &flight, error);
    if (flight.tread_count > 0) {
        put_rectangle(json, "foot", flight.foot);
        put_rectangle(json, "head", flight.head);
    }
    tn_flight_clear(&flight);
    return status;
}

static tn_status put_faces(const tn_house *house, tn_json *json, tn_error *error)
{
    static const char *const sides[] = {"above", "back", "front", "left", "right"};
    tn_json_list(json, "faces");
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        tn_json_object(json, NULL);
        tn_json_count(json, "id", i);
        tn_json_count(json, "a", face->first);
        if (face->second == TN_NO_CELL)
            tn_json_null(json, "b");
        else
            tn_json_count(json, "b", face->second);
        tn_json_string(json, "side", sides[face->side]);
        tn_json_string(json, "rel",
                       face->relation == TN_FACE_OUTSIDE ? "outside"
                       : face->relation == TN_FACE_UNDER ? "above"
                                                         : "beside");
        put_rectangle(json, "at", face->at);
        tn_json_string(json, "kind", tn_form_kind_text(house->form, face->kind));
        put_options(house, face, json);
        put_opening(house, face, json);
        if (tn_form_asks_ways(house->form))
            status = put_ways(house, face, json, error);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
    return status;
}

static void put_room(const tn_house *house, const uint32_t *rooms, uint32_t room, tn_json *json)
{
    tn_int128 gross, net;
    tn_room_areas(house, rooms, room, &gross, &net);
    tn_json_object(json, NULL);
    tn_json_string(json, "function", function_of(house, &house->cells[room]));
    tn_json_list(json, "cells");
    for (uint32_t i = room; i < house->cell_count; i++)
        if (rooms[i] == room)
            tn_json_count(json, NULL, i);
    tn_json_list_end(json);
    put_area(json, "area", gross);
    put_area(json, "net", net);
    tn_json_object_end(json);
}

static void put_rooms(const tn_house *house, const uint32_t *rooms, tn_json *json)
{
    tn_json_list(json, "rooms");
    for (uint32_t i = 0; i < house->cell_count; i++)
        if (rooms[i] == i)
            put_room(house, rooms, i, json);
    tn_json_list_end(json);
}

/* The layers of a solid, each with its box. */
static void put_layers(const tn_house *house, const tn_solid *s, tn_json *json)
{
    tn_layering layers = tn_solid_layering(house, s->kind, s->of, s->item);
    if (layers.count == 0)
        return;
    tn_json_list(json, "layers");
    for (uint32_t i = layers.first; i < layers.first + layers.count; i++) {
        tn_json_object(json, NULL);
        tn_json_string(json, "name", tn_text(house->form->module, tn_form_layer(house->form, i)->name));
        put_box(json, tn_layer_box(&layers, i, &s->at));
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void put_solids(const tn_house *house, const tn_solids *solids, tn_json *json)
{
    const tn_module *module = house->form->module;
    tn_json_list(json, "solids");
    for (size_t i = 0; i < solids->box_count; i++) {
        const tn_solid *s = &solids->boxes[i];
        tn_json_object(json, NULL);
        tn_json_string(json, "kind", tn_solid_kind_text(s->kind));
        tn_json_count(json, "of", s->of);
        if (s->kind == TN_SOLID_ITEM)
            tn_json_string(json, "name", tn_text(module, module->TILE_BOX_records[s->item].name));
        if (s->kind == TN_SOLID_BEAM)
            tn_json_string(json, "name", tn_text(module, tn_form_beam(house->form, s->item)->name));
        put_box(json, s->at);
        put_layers(house, s, json);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void put_corners(const tn_solids *solids, const tn_prism *prism, tn_json *json)
{
    tn_json_list(json, "corners");
    for (size_t k = 0; k < prism->corner_count; k++) {
        const tn_prism_corner *corner = &solids->corners[prism->corner_first + k];
        tn_json_list(json, NULL);
        put_fraction(json, corner->x);
        put_fraction(json, corner->y);
        put_fraction(json, corner->low);
        put_fraction(json, corner->high);
        tn_json_list_end(json);
    }
    tn_json_list_end(json);
}

/* The layers of a prism, each with its corners: one may be in pieces. */
static void put_prism_layers(const tn_house *house, const tn_solids *solids, const tn_prism *prism, tn_json *json)
{
    tn_layering layers = tn_solid_layering(house, prism->kind, prism->of, prism->item);
    tn_solids pieces = {0};
    tn_error error;
    if (layers.count == 0)
        return;
    tn_json_list(json, "layers");
    for (uint32_t i = layers.first; i < layers.first + layers.count; i++) {
        pieces.prism_count = pieces.corner_count = 0;
        json->text->failed |= tn_layer_prisms(house, solids, prism, &layers, i, &pieces, &error) != TN_OK;
        for (size_t k = 0; k < pieces.prism_count; k++) {
            tn_json_object(json, NULL);
            tn_json_string(json, "name", tn_text(house->form->module, tn_form_layer(house->form, i)->name));
            tn_json_whole(json, "thick", tn_form_layer(house->form, i)->thick);
            put_corners(&pieces, &pieces.prisms[k], json);
            tn_json_object_end(json);
        }
    }
    tn_json_list_end(json);
    tn_solids_clear(&pieces);
}

static void put_prism(const tn_house *house, const tn_solids *solids, const tn_prism *prism, tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "kind", tn_solid_kind_text(prism->kind));
    tn_json_count(json, "of", prism->of);
    if (prism->kind == TN_SOLID_GABLE && prism->item != TN_NO_FACE)
        tn_json_count(json, "face", prism->item);
    put_corners(solids, prism, json);
    put_prism_layers(house, solids, prism, json);
    tn_json_object_end(json);
}

static bool has_wedges(const tn_solids *solids)
{
    for (size_t i = 0; i < solids->prism_count; i++)
        if (solids->prisms[i].kind == TN_SOLID_FLIGHT)
            return true;
    return false;
}

/* Those of roofs and of the walls below them, or the wedges of flights. */
static void put_prisms(const tn_house *house, const tn_solids *solids, const char *name, bool wedges, tn_json *json)
{
    tn_json_list(json, name);
    for (size_t i = 0; i < solids->prism_count; i++)
        if ((solids->prisms[i].kind == TN_SOLID_FLIGHT) == wedges)
            put_prism(house, solids, &solids->prisms[i], json);
    tn_json_list_end(json);
}

/* ---- parts and what they cost */

bool tn_cost_write(tn_buffer *out, const mpz_t hundredths)
{
    mpz_t whole;
    mpz_init(whole);
    unsigned rest = (unsigned)mpz_fdiv_q_ui(whole, hundredths, 100);
    tn_buffer_integer(out, whole);
    mpz_clear(whole);
    return tn_buffer_printf(out, ".%02u", rest);
}

static void put_quotient(tn_json *json, const char *key, const mpq_t value)
{
    char *digits = mpq_get_str(NULL, 10, value);
    tn_json_string(json, key, digits);
    free(digits);
}

static void put_money(tn_json *json, const char *key, const mpz_t hundredths)
{
    tn_buffer text = {0};
    tn_cost_write(&text, hundredths);
    json->text->failed |= text.failed;
    tn_json_string(json, key, text.data);
    free(text.data);
}

static void put_part(const tn_house *house, const tn_cost_line *line, tn_json *json)
{
    const tn_module *module = house->form->module;
    tn_json_object(json, NULL);
    tn_json_string(json, "part", tn_form_part_text(house->form, line->part));
    tn_json_count(json, "number", line->count);
    put_quotient(json, "area", line->area);
    put_quotient(json, "volume", line->volume);
    if (line->material != TN_NO_RECORD) {
        tn_json_string(json, "material", tn_text(module, module->MATERIAL_records[line->material].name));
        put_money(json, "cost", line->hundredths);
    }
    tn_json_object_end(json);
}

static void put_parts(const tn_house *house, const tn_costs *costs, tn_json *json)
{
    tn_json_list(json, "parts");
    for (size_t i = 0; i < costs->count; i++)
        if (tn_cost_line_stands(&costs->lines[i]))
            put_part(house, &costs->lines[i], json);
    tn_json_list_end(json);
}

/* ---- measures */

static void put_value(const tn_house_value *value, tn_json *json)
{
    tn_buffer text = {0};
    tn_json_object(json, NULL);
    tn_json_string(json, "measure", value->measure);
    if (value->has) {
        json->text->failed |= !tn_amount_write_exact(value->unit, value->value, &text);
        tn_json_string(json, "value", text.data ? text.data : "");
    }
    tn_json_string(json, "unit", tn_amount_unit_name(value->unit));
    tn_json_object_end(json);
    free(text.data);
}

static void put_values(const tn_house_value *values, size_t count, tn_json *json)
{
    tn_json_list(json, "measures");
    for (size_t i = 0; i < count; i++)
        put_value(&values[i], json);
    tn_json_list_end(json);
}

/* ---- all */

/* All but its measures, with the house's line and what it costs. */
static tn_status put_house(const tn_house *house, const tn_solids *solids, const char *line, const uint32_t *rooms,
                           const tn_costs *costs, tn_json *json, tn_error *error)
{
    tn_json_string(json, "house", line);
    put_cells(house, json);
    tn_status status = put_faces(house, json, error);
    put_rooms(house, rooms, json);
    put_solids(house, solids, json);
    put_prisms(house, solids, "roofs", false, json);
    if (has_wedges(solids))
        put_prisms(house, solids, "wedges", true, json);
    put_parts(house, costs, json);
    if (tn_form_has_costs(house->form))
        put_money(json, "cost", costs->hundredths);
    return status;
}

tn_status tn_house_describe(const tn_house *house, const tn_solids *solids, const tn_house_value *values,
                            size_t value_count, tn_buffer *out, tn_error *error)
{
    uint32_t *rooms;
    tn_buffer line = {0};
    tn_costs costs = {0};
    tn_json json = tn_json_text(out, TN_JSON_LINES);
    json.layout.lines = 2;
    tn_status status = tn_house_rooms(house, &rooms, error);
    if (status != TN_OK)
        return status;
    status = tn_house_write(house, &line, error);
    if (status == TN_OK)
        status = tn_house_costs(house, solids, &costs, error);
    tn_json_object(&json, NULL);
    if (status == TN_OK)
        status = put_house(house, solids, line.data, rooms, &costs, &json, error);
    if (value_count > 0)
        put_values(values, value_count, &json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    tn_costs_clear(&costs);
    free(rooms);
    free(line.data);
    return status == TN_OK && out->failed ? tn_fail_memory(error) : status;
}

/* ---- a table of rooms */

/* What tables are in: a length, in nanometres, and what its square and its cube are called. */
typedef struct tn_table_unit {
    int64_t length;
    const char *square, *cube;
} tn_table_unit;

/* That of the widths of the schema. */
static tn_table_unit unit_of(const tn_house *house)
{
    return tn_house_length_style(house) == TN_STYLE_FEET ? (tn_table_unit){TN_FOOT_NM, "sf", "cf"}
                                                         : (tn_table_unit){INT64_C(1000000000), "m2", "m3"};
}

/* Square nanometres in a unit of that length, to six places, rounded half up. */
static void put_square(tn_buffer *out, tn_int128 area, int64_t unit)
{
    tn_int128 square = (tn_int128)unit * unit, millionths = (2000000 * area + square) / (2 * square);
    put_wide(out, millionths / 1000000);
    tn_buffer_printf(out, ".%06d", (int)(millionths % 1000000));
}

tn_status tn_house_schedule(const tn_house *house, tn_buffer *out, tn_error *error)
{
    uint32_t *rooms;
    tn_status status = tn_house_rooms(house, &rooms, error);
    if (status != TN_OK)
        return status;
    const tn_table_unit unit = unit_of(house);
    tn_buffer_printf(out, "function,storey,cells,gross_%s,net_%s,glazed_%s\r\n", unit.square, unit.square, unit.square);
    for (uint32_t i = 0; i < house->cell_count; i++) {
        if (rooms[i] != i)
            continue;
        tn_int128 gross, net;
        uint32_t cells = tn_room_areas(house, rooms, i, &gross, &net);
        tn_buffer_printf(out, "%s,%s,%u,", function_of(house, &house->cells[i]),
                         storey_of(house, house->cells[i].storey), cells);
        put_square(out, gross, unit.length);
        tn_buffer_append(out, ",", 1);
        put_square(out, net, unit.length);
        tn_buffer_append(out, ",", 1);
        put_square(out, tn_room_glazing(house, rooms, i), unit.length);
        tn_buffer_append(out, "\r\n", 2);
    }
    free(rooms);
    return out->failed ? tn_fail_memory(error) : TN_OK;
}

/* ---- a table of parts */

/* An area or a volume, of nanometres, in a unit of that length to that power; to six places, rounded half up. */
static void put_in_unit(tn_buffer *out, const mpq_t number, int64_t unit, unsigned power)
{
    mpz_t top, bottom;
    mpz_init_set_ui(bottom, (uint64_t)unit);
    mpz_init(top);
    mpz_pow_ui(bottom, bottom, power);
    mpz_mul(bottom, bottom, mpq_denref(number));
    mpz_mul_ui(top, mpq_numref(number), 2000000);
    mpz_add(top, top, bottom);
    mpz_mul_2exp(bottom, bottom, 1);
    mpz_fdiv_q(top, top, bottom);
    unsigned rest = (unsigned)mpz_fdiv_q_ui(top, top, 1000000);
    tn_buffer_integer(out, top);
    tn_buffer_printf(out, ".%06u", rest);
    mpz_clears(top, bottom, NULL);
}

static void put_part_row(const tn_house *house, const tn_cost_line *line, int64_t unit, tn_buffer *out)
{
    static const char *const units[] = {"each", "sf", "m2", "cf", "m3"};
    const tn_module *module = house->form->module;
    tn_buffer_printf(out, "%s,%zu,", tn_form_part_text(house->form, line->part), line->count);
    put_in_unit(out, line->area, unit, 2);
    tn_buffer_append(out, ",", 1);
    put_in_unit(out, line->volume, unit, 3);
    if (line->material == TN_NO_RECORD) {
        tn_buffer_printf(out, ",,,,\r\n");
    } else {
        const tn_material_record *material = &module->MATERIAL_records[line->material];
        tn_buffer_printf(out, ",%s,%" PRId64 ".%06" PRId64 ",%s,", tn_text(module, material->name),
                         material->price / 1000000, material->price % 1000000, units[material->unit]);
        tn_cost_write(out, line->hundredths);
        tn_buffer_append(out, "\r\n", 2);
    }
}

tn_status tn_house_parts(const tn_house *house, const tn_solids *solids, tn_buffer *out, tn_error *error)
{
    tn_costs costs;
    tn_status status = tn_house_costs(house, solids, &costs, error);
    const tn_table_unit unit = unit_of(house);
    tn_buffer_printf(out, "part,number,area_%s,volume_%s,material,price,per,cost\r\n", unit.square, unit.cube);
    for (size_t i = 0; status == TN_OK && i < costs.count; i++)
        if (tn_cost_line_stands(&costs.lines[i]))
            put_part_row(house, &costs.lines[i], unit.length, out);
    if (status == TN_OK && tn_form_has_costs(house->form)) {
        tn_buffer_printf(out, "total,,,,,,,");
        tn_cost_write(out, costs.hundredths);
        tn_buffer_append(out, "\r\n", 2);
    }
    tn_costs_clear(&costs);
    return status == TN_OK && out->failed ? tn_fail_memory(error) : status;
}
