/* Writes what a house is made of: everything as JSON, its rooms as a table, its parts with their costs as another. */
#include "runtime/house/schedule/describe.h"
#include "runtime/house/schedule/cost.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

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

static void put_fraction(tn_buffer *out, tn_fraction fraction)
{
    tn_buffer_append(out, "\"", 1);
    put_wide(out, fraction.top);
    if (fraction.bottom != 1) {
        tn_buffer_append(out, "/", 1);
        put_wide(out, fraction.bottom);
    }
    tn_buffer_append(out, "\"", 1);
}

static void put_rectangle(tn_buffer *out, const char *name, tn_rectangle r)
{
    tn_buffer_printf(out, ", \"%s\": [%" PRId64 ", %" PRId64 ", %" PRId64 ", %" PRId64 "]", name, r.x0, r.x1, r.y0,
                     r.y1);
}

/* Before the items of a list. */
static void next_line(tn_buffer *out, bool *any)
{
    tn_buffer_printf(out, "%s\n    ", *any ? "," : "");
    *any = true;
}

static tn_int128 area_of(tn_rectangle r)
{
    return (tn_int128)(r.x1 - r.x0) * (r.y1 - r.y0);
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

static void put_cells(const tn_house *house, tn_buffer *out)
{
    const tn_house_form *form = house->form;
    bool any = false;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        next_line(out, &any);
        tn_buffer_printf(out, "{\"id\": %u, \"tray\": %u, \"zone\": ", i, cell->tray);
        tn_buffer_append_json(out, tn_text(form->module, form->schema->fields[cell->zone].name));
        tn_buffer_printf(out, ", \"storey\": %u", cell->storey);
        put_rectangle(out, "rect", cell->at);
        tn_buffer_printf(out, ", \"function\": ");
        tn_buffer_append_json(out, function_of(house, cell));
        put_rectangle(out, "inner", tn_cell_clear(house, i));
        tn_buffer_append(out, "}", 1);
    }
}

static void put_options(const tn_house *house, const tn_face *face, tn_buffer *out)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    size_t count = tn_face_options(house, face, kinds);
    tn_buffer_printf(out, ", \"options\": [");
    for (size_t i = 0; i < count; i++) {
        tn_buffer_printf(out, "%s", i ? ", " : "");
        tn_buffer_append_json(out, tn_form_kind_text(house->form, kinds[i]));
    }
    tn_buffer_append(out, "]", 1);
}

static void put_faces(const tn_house *house, tn_buffer *out)
{
    static const char *const sides[] = {"above", "back", "front", "left", "right"};
    bool any = false;
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        next_line(out, &any);
        tn_buffer_printf(out, "{\"id\": %zu, \"a\": %u, \"b\": ", i, face->first);
        tn_buffer_printf(out, face->second == TN_NO_CELL ? "null" : "%u", face->second);
        tn_buffer_printf(out, ", \"side\": \"%s\", \"rel\": \"%s\"", sides[face->side],
                         face->relation == TN_FACE_OUTSIDE ? "outside"
                         : face->relation == TN_FACE_UNDER ? "above"
                                                           : "beside");
        put_rectangle(out, "at", face->at);
        tn_buffer_printf(out, ", \"kind\": ");
        tn_buffer_append_json(out, tn_form_kind_text(house->form, face->kind));
        put_options(house, face, out);
        tn_buffer_append(out, "}", 1);
    }
}

/* The areas of a room, to the planes and to the walls; voids do not count. */
static void room_areas(const tn_house *house, const uint32_t *rooms, uint32_t room, tn_int128 *gross, tn_int128 *net)
{
    *gross = *net = 0;
    for (uint32_t i = room; i < house->cell_count; i++) {
        if (rooms[i] != room || house->cells[i].open)
            continue;
        *gross += area_of(house->cells[i].at);
        *net += area_of(tn_cell_clear(house, i));
    }
}

static void put_room(const tn_house *house, const uint32_t *rooms, uint32_t room, tn_buffer *out)
{
    tn_int128 gross, net;
    room_areas(house, rooms, room, &gross, &net);
    tn_buffer_printf(out, "{\"function\": ");
    tn_buffer_append_json(out, function_of(house, &house->cells[room]));
    tn_buffer_printf(out, ", \"cells\": [");
    for (uint32_t i = room; i < house->cell_count; i++)
        if (rooms[i] == room)
            tn_buffer_printf(out, "%s%u", i == room ? "" : ", ", i);
    tn_buffer_printf(out, "], \"area\": \"");
    put_wide(out, gross);
    tn_buffer_printf(out, "\", \"net\": \"");
    put_wide(out, net);
    tn_buffer_printf(out, "\"}");
}

static void put_solids(const tn_house *house, const tn_solids *solids, tn_buffer *out)
{
    const tn_module *module = house->form->module;
    bool any = false;
    for (size_t i = 0; i < solids->box_count; i++) {
        const tn_solid *s = &solids->boxes[i];
        next_line(out, &any);
        tn_buffer_printf(out, "{\"kind\": \"%s\", \"of\": %u", tn_solid_kind_text(s->kind), s->of);
        if (s->kind == TN_SOLID_ITEM) {
            tn_buffer_printf(out, ", \"name\": ");
            tn_buffer_append_json(out, tn_text(module, module->TILE_BOX_records[s->item].name));
        }
        tn_buffer_printf(out,
                         ", \"box\": [%" PRId64 ", %" PRId64 ", %" PRId64 ", %" PRId64 ", %" PRId64 ", %" PRId64 "]}",
                         s->at.x0, s->at.x1, s->at.y0, s->at.y1, s->at.z0, s->at.z1);
    }
}

static void put_roofs(const tn_solids *solids, tn_buffer *out)
{
    bool any = false;
    for (size_t i = 0; i < solids->prism_count; i++) {
        const tn_prism *p = &solids->prisms[i];
        next_line(out, &any);
        tn_buffer_printf(out, "{\"of\": %u, \"%s\": [%" PRId64 ", %" PRId64 "], \"base\": %" PRId64 ", ", p->of,
                         p->across ? "y" : "x", p->from, p->to, p->base);
        if (p->slab)
            tn_buffer_printf(out, "\"slab\": %" PRId64 ", ", p->slab);
        tn_buffer_printf(out, "\"profile\": [");
        for (size_t k = 0; k < p->point_count; k++) {
            const tn_roof_point *point = &solids->points[p->point_first + k];
            tn_buffer_printf(out, "%s[", k ? ", " : "");
            put_fraction(out, point->y);
            tn_buffer_printf(out, ", ");
            put_fraction(out, point->z);
            tn_buffer_append(out, "]", 1);
        }
        tn_buffer_printf(out, "]}");
    }
}

/* ---- parts and what they cost */

/* Appends a text that GMP made, and frees it. */
static void put_digits(tn_buffer *out, char *digits)
{
    tn_buffer_append(out, digits, strlen(digits));
    free(digits);
}

static void put_hundredths(tn_buffer *out, const mpz_t hundredths)
{
    mpz_t whole;
    mpz_init(whole);
    unsigned long rest = mpz_fdiv_q_ui(whole, hundredths, 100);
    put_digits(out, mpz_get_str(NULL, 10, whole));
    tn_buffer_printf(out, ".%02lu", rest);
    mpz_clear(whole);
}

static void put_part(const tn_house *house, const tn_cost_line *line, tn_buffer *out)
{
    const tn_module *module = house->form->module;
    tn_buffer_printf(out, "{\"part\": ");
    tn_buffer_append_json(out, tn_form_part_text(house->form, line->part));
    tn_buffer_printf(out, ", \"number\": %zu, \"area\": \"", line->count);
    put_digits(out, mpq_get_str(NULL, 10, line->area));
    tn_buffer_printf(out, "\", \"volume\": \"");
    put_digits(out, mpq_get_str(NULL, 10, line->volume));
    tn_buffer_printf(out, "\"");
    if (line->material != TN_NO_RECORD) {
        tn_buffer_printf(out, ", \"material\": ");
        tn_buffer_append_json(out, tn_text(module, module->MATERIAL_records[line->material].name));
        tn_buffer_printf(out, ", \"cost\": \"");
        put_hundredths(out, line->hundredths);
        tn_buffer_printf(out, "\"");
    }
    tn_buffer_append(out, "}", 1);
}

static void put_parts(const tn_house *house, const tn_costs *costs, tn_buffer *out)
{
    bool any = false;
    for (size_t i = 0; i < costs->count; i++)
        if (costs->lines[i].count > 0) {
            next_line(out, &any);
            put_part(house, &costs->lines[i], out);
        }
}

tn_status tn_house_describe(const tn_house *house, const tn_solids *solids, tn_buffer *out, tn_error *error)
{
    uint32_t *rooms;
    tn_buffer line = {0};
    tn_costs costs = {0};
    tn_status status = tn_house_rooms(house, &rooms, error);
    if (status != TN_OK)
        return status;
    status = tn_house_write(house, &line, error);
    tn_buffer_printf(out, "{\n  \"house\": ");
    tn_buffer_append_json(out, line.data ? line.data : "");
    tn_buffer_printf(out, ",\n  \"cells\": [");
    put_cells(house, out);
    tn_buffer_printf(out, "],\n  \"faces\": [");
    put_faces(house, out);
    tn_buffer_printf(out, "],\n  \"rooms\": [");
    bool any = false;
    for (uint32_t i = 0; i < house->cell_count; i++)
        if (rooms[i] == i) {
            next_line(out, &any);
            put_room(house, rooms, i, out);
        }
    tn_buffer_printf(out, "],\n  \"solids\": [");
    put_solids(house, solids, out);
    tn_buffer_printf(out, "],\n  \"roofs\": [");
    put_roofs(solids, out);
    if (status == TN_OK)
        status = tn_house_costs(house, solids, &costs, error);
    tn_buffer_printf(out, "],\n  \"parts\": [");
    put_parts(house, &costs, out);
    tn_buffer_printf(out, "]");
    if (status == TN_OK && tn_form_has_costs(house->form)) {
        tn_buffer_printf(out, ",\n  \"cost\": \"");
        put_hundredths(out, costs.hundredths);
        tn_buffer_printf(out, "\"");
    }
    tn_buffer_printf(out, "\n}\n");
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
        uint32_t cells = 0;
        room_areas(house, rooms, i, &gross, &net);
        for (uint32_t k = i; k < house->cell_count; k++)
            cells += rooms[k] == i && !house->cells[k].open;
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
static void put_in_unit(tn_buffer *out, const mpq_t number, int64_t unit, unsigned long power)
{
    mpz_t top, bottom;
    mpz_init_set_ui(bottom, (unsigned long)unit);
    mpz_init(top);
    mpz_pow_ui(bottom, bottom, power);
    mpz_mul(bottom, bottom, mpq_denref(number));
    mpz_mul_ui(top, mpq_numref(number), 2000000);
    mpz_add(top, top, bottom);
    mpz_mul_2exp(bottom, bottom, 1);
    mpz_fdiv_q(top, top, bottom);
    unsigned long rest = mpz_fdiv_q_ui(top, top, 1000000);
    put_digits(out, mpz_get_str(NULL, 10, top));
    tn_buffer_printf(out, ".%06lu", rest);
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
        put_hundredths(out, line->hundredths);
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
        if (costs.lines[i].count > 0)
            put_part_row(house, &costs.lines[i], unit.length, out);
    if (status == TN_OK && tn_form_has_costs(house->form)) {
        tn_buffer_printf(out, "total,,,,,,,");
        put_hundredths(out, costs.hundredths);
        tn_buffer_append(out, "\r\n", 2);
    }
    tn_costs_clear(&costs);
    return status == TN_OK && out->failed ? tn_fail_memory(error) : status;
}
