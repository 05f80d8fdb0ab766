/* Makes the columns of tables of houses, and their rows. */
#include "driver/house/tables.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/house/values.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/house.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/text/text.h"

typedef struct columns {
    tn_house_column *items;
    size_t count, room;
} columns;

struct tn_house_tables {
    const tn_house_form *form;
    tn_house_valuer *valuer;
    bool feet;
    columns of[TN_HOUSE_TABLES];
    tn_buffer cells; /* of the row under way, each with a zero byte */
    size_t *starts;  /* [columns of the widest table]: SIZE_MAX of a cell without a value */
    const char **texts;
    size_t cell_count;
};

/* ---- columns */

const char *tn_house_table_name(tn_house_table table)
{
    static const char *const names[TN_HOUSE_TABLES] = {"houses", "rooms", "faces"};
    return names[table];
}

const tn_house_column *tn_house_table_columns(const tn_house_tables *tables, tn_house_table table, size_t *count)
{
    *count = tables->of[table].count;
    return tables->of[table].items;
}

static bool is_taken(const columns *all, const char *name)
{
    for (size_t i = 0; i < all->count; i++)
        if (strcasecmp(all->items[i].name, name) == 0)
            return true;
    return false;
}

/* Blanks and dashes, which databases want in quotes, become `_`. A name that another column has gets a number. */
static tn_status add_column(columns *all, tn_column_kind kind, const char *name, const char *unit, tn_error *error)
{
    tn_buffer text = {0}, numbered = {0};
    bool good = tn_buffer_printf(&text, "%s%s%s", name, *unit ? "_" : "", unit);
    for (size_t i = 0; good && i < text.size; i++)
        if (text.data[i] == ' ' || text.data[i] == '-')
            text.data[i] = '_';
    good = good && tn_buffer_printf(&numbered, "%s", text.data);
    for (unsigned n = 2; good && is_taken(all, numbered.data); n++) {
        numbered.size = 0;
        good = tn_buffer_printf(&numbered, "%s_%u", text.data, n);
    }
    free(text.data);
    if (!good || !tn_array_reserve(&all->items, &all->room, all->count, 1, sizeof *all->items)) {
        free(numbered.data);
        return tn_fail_memory(error);
    }
    all->items[all->count++] = (tn_house_column){numbered.data, kind};
    return TN_OK;
}

static const char *square_unit(const tn_house_tables *t)
{
    return t->feet ? "sf" : "m2";
}

static const char *function_name(const tn_house_form *form, uint32_t function)
{
    return tn_text(form->module, tn_form_rule(form, function)->name);
}

/* Functions of one name are one: the first of it. */
static bool is_first(const tn_house_form *form, uint32_t function)
{
    for (uint32_t i = 0; i < function; i++)
        if (strcmp(function_name(form, i), function_name(form, function)) == 0)
            return false;
    return true;
}

static tn_status add_functions(tn_house_tables *t, columns *houses, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < tn_form_functions(t->form); i++) {
        char name[2 * TN_NAME_MAX + 8];
        if (!is_first(t->form, i))
            continue;
        snprintf(name, sizeof name, "%s_rooms", function_name(t->form, i));
        status = add_column(houses, TN_COLUMN_WHOLE, name, "", error);
        snprintf(name, sizeof name, "%s_net", function_name(t->form, i));
        if (status == TN_OK)
            status = add_column(houses, TN_COLUMN_REAL, name, square_unit(t), error);
    }
    return status;
}

/* "m2", "ft", "per_m2"; of squares and cubes of feet "sf" and "cf", as in all tables of houses. */
static void measure_unit(tn_amount_unit of, char text[16])
{
    const char *unit = tn_amount_unit_name(of);
    bool per = *unit == '/';
    unit += per;
    snprintf(text, 16, "%s%s", per ? "per_" : "",
             strcmp(unit, "ft2") == 0   ? "sf"
             : strcmp(unit, "ft3") == 0 ? "cf"
                                        : unit);
}

static tn_status add_measures(tn_house_tables *t, columns *houses, tn_error *error)
{
    size_t count;
    const tn_house_value *values = tn_house_values(t->valuer, &count);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        char unit[16];
        measure_unit(values[i].unit, unit);
        status = add_column(houses, TN_COLUMN_REAL, values[i].measure, unit, error);
    }
    return status;
}

static tn_status add_all(columns *to, const tn_house_column *named, size_t count, const char *unit, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = add_column(to, named[i].kind, named[i].name, named[i].kind == TN_COLUMN_REAL ? unit : "", error);
    return status;
}

static tn_status make_houses(tn_house_tables *t, tn_error *error)
{
    static const tn_house_column first[] = {
        {"house", TN_COLUMN_WHOLE}, {"rank", TN_COLUMN_TEXT},   {"plan_rank", TN_COLUMN_TEXT},
        {"plan", TN_COLUMN_TEXT},   {"trays", TN_COLUMN_WHOLE}, {"rooms", TN_COLUMN_WHOLE},
        {"gross", TN_COLUMN_REAL},  {"net", TN_COLUMN_REAL},    {"glazed", TN_COLUMN_REAL}};
    columns *houses = &t->of[TN_TABLE_HOUSES];
    tn_status status = add_all(houses, first, sizeof first / sizeof *first, square_unit(t), error);
    for (uint32_t i = 0; status == TN_OK && i < t->form->record->choice_count; i++)
        status =
            add_column(houses, TN_COLUMN_TEXT, tn_text(t->form->module, tn_form_choice(t->form, i)->name), "", error);
    if (status == TN_OK)
        status = add_functions(t, houses, error);
    if (status == TN_OK && tn_form_has_costs(t->form))
        status = add_column(houses, TN_COLUMN_REAL, "cost", "", error);
    if (status == TN_OK)
        status = add_measures(t, houses, error);
    return status == TN_OK ? add_column(houses, TN_COLUMN_TEXT, "line", "", error) : status;
}

static tn_status make_rooms(tn_house_tables *t, tn_error *error)
{
    static const tn_house_column all[] = {{"house", TN_COLUMN_WHOLE},   {"room", TN_COLUMN_WHOLE},
                                          {"function", TN_COLUMN_TEXT}, {"storey", TN_COLUMN_TEXT},
                                          {"cells", TN_COLUMN_WHOLE},   {"gross", TN_COLUMN_REAL},
                                          {"net", TN_COLUMN_REAL},      {"glazed", TN_COLUMN_REAL}};
    return add_all(&t->of[TN_TABLE_ROOMS], all, sizeof all / sizeof *all, square_unit(t), error);
}

/* room: of its first cell, other: of its second. x, y: where it begins and ends, along the row and from back to front.
 */
static tn_status make_faces(tn_house_tables *t, tn_error *error)
{
    static const tn_house_column all[] = {{"house", TN_COLUMN_WHOLE},   {"face", TN_COLUMN_WHOLE},
                                          {"room", TN_COLUMN_WHOLE},    {"function", TN_COLUMN_TEXT},
                                          {"other", TN_COLUMN_WHOLE},   {"other_function", TN_COLUMN_TEXT},
                                          {"storey", TN_COLUMN_TEXT},   {"side", TN_COLUMN_TEXT},
                                          {"outside", TN_COLUMN_WHOLE}, {"kind", TN_COLUMN_TEXT}};
    static const tn_house_column places[] = {
        {"x0", TN_COLUMN_REAL}, {"x1", TN_COLUMN_REAL}, {"y0", TN_COLUMN_REAL}, {"y1", TN_COLUMN_REAL}};
    columns *faces = &t->of[TN_TABLE_FACES];
    tn_status status = add_all(faces, all, sizeof all / sizeof *all, "", error);
    if (status == TN_OK)
        status = add_all(faces, places, sizeof places / sizeof *places, t->feet ? "ft" : "m", error);
    return status == TN_OK ? add_column(faces, TN_COLUMN_REAL, "glazed", square_unit(t), error) : status;
}

tn_status tn_house_tables_new(const tn_house_form *form, size_t max_length, tn_house_tables **tables, tn_error *error)
{
    tn_house_tables *t = calloc(1, sizeof *t);
    size_t widest = 0;
    *tables = t;
    if (!t)
        return tn_fail_memory(error);
    t->form = form;
    t->feet = tn_amount_unit_of(form->schema, 1).feet;
    tn_status status = tn_house_valuer_new(form, max_length, NULL, 0, &t->valuer, error);
    if (status == TN_OK)
        status = make_houses(t, error);
    if (status == TN_OK)
        status = make_rooms(t, error);
    if (status == TN_OK)
        status = make_faces(t, error);
    for (int i = 0; i < TN_HOUSE_TABLES; i++)
        widest = t->of[i].count > widest ? t->of[i].count : widest;
    t->starts = malloc((widest + 1) * sizeof *t->starts);
    t->texts = malloc((widest + 1) * sizeof *t->texts);
    return status == TN_OK && !(t->starts && t->texts) ? tn_fail_memory(error) : status;
}

void tn_house_tables_free(tn_house_tables *t)
{
    if (!t)
        return;
    for (int i = 0; i < TN_HOUSE_TABLES; i++) {
        for (size_t k = 0; k < t->of[i].count; k++)
            free((char *)(uintptr_t)t->of[i].items[k].name);
        free(t->of[i].items);
    }
    tn_house_valuer_free(t->valuer);
    free(t->cells.data);
    free(t->starts);
    free(t->texts);
    free(t);
}

/* ---- cells of a row */

static void begin_row(tn_house_tables *t)
{
    t->cells.size = 0;
    t->cell_count = 0;
}

static void begin_cell(tn_house_tables *t)
{
    t->starts[t->cell_count++] = t->cells.size;
}

static void end_cell(tn_house_tables *t)
{
    tn_buffer_append(&t->cells, "", 1);
}

static void put_nothing(tn_house_tables *t)
{
    t->starts[t->cell_count++] = SIZE_MAX;
}

static void put_text(tn_house_tables *t, const char *text)
{
    begin_cell(t);
    tn_buffer_append(&t->cells, text, strlen(text));
    end_cell(t);
}

static void put_whole(tn_house_tables *t, uint64_t number)
{
    begin_cell(t);
    tn_buffer_printf(&t->cells, "%" PRIu64, number);
    end_cell(t);
}

/* A decimal of six places at most, rounded half up. */
static void put_real(tn_house_tables *t, const mpq_t number)
{
    enum { PLACES = 1000000 };
    mpz_t scaled, bottom;
    begin_cell(t);
    mpz_inits(scaled, bottom, NULL);
    mpz_mul_ui(scaled, mpq_numref(number), 2 * PLACES);
    mpz_add(scaled, scaled, mpq_denref(number));
    mpz_mul_2exp(bottom, mpq_denref(number), 1);
    mpz_fdiv_q(scaled, scaled, bottom);
    if (mpz_sgn(scaled) < 0)
        tn_buffer_append(&t->cells, "-", 1);
    mpz_abs(scaled, scaled);
    unsigned rest = (unsigned)mpz_fdiv_q_ui(scaled, scaled, PLACES);
    tn_buffer_integer(&t->cells, scaled);
    if (rest) {
        char digits[8];
        snprintf(digits, sizeof digits, "%06u", rest);
        for (size_t last = 6; last > 0 && digits[last - 1] == '0'; last--)
            digits[last - 1] = '\0';
        tn_buffer_printf(&t->cells, ".%s", digits);
    }
    end_cell(t);
    mpz_clears(scaled, bottom, NULL);
}

/* Nanometres to a power, in the unit of the tables. */
static void put_nanometres(tn_house_tables *t, tn_int128 number, int power)
{
    mpq_t value;
    bool below = number < 0;
    tn_uint128 bits = below ? -(tn_uint128)number : (tn_uint128)number;
    mpq_init(value);
    mpz_set_ui(mpq_numref(value), (unsigned long)(bits >> 96));
    for (int part = 2; part >= 0; part--) {
        mpz_mul_2exp(mpq_numref(value), mpq_numref(value), 32);
        mpz_add_ui(mpq_numref(value), mpq_numref(value), (unsigned long)(uint32_t)(bits >> (32 * part)));
    }
    if (below)
        mpq_neg(value, value);
    tn_amount_convert((tn_amount_unit){.feet = t->feet, .power = power}, value);
    put_real(t, value);
    mpq_clear(value);
}

static tn_status give_row(tn_house_tables *t, tn_house_table table, tn_house_row *row, void *context, tn_error *error)
{
    if (t->cells.failed)
        return tn_fail_memory(error);
    for (size_t i = 0; i < t->cell_count; i++)
        t->texts[i] = t->starts[i] == SIZE_MAX ? NULL : t->cells.data + t->starts[i];
    return row(context, table, t->texts, error);
}

/* ---- rooms */

/* A room of a house: its first cell, and what its cells come to. */
typedef struct room {
    uint32_t first, cells;
    tn_int128 gross, net, glazed;
} room;

static void measure_room(const tn_house *house, const uint32_t *rooms, uint32_t first, room *r)
{
    *r = (room){.first = first, .glazed = tn_room_glazing(house, rooms, first)};
    r->cells = tn_room_areas(house, rooms, first, &r->gross, &r->net);
}

static const char *cell_function(const tn_house *house, uint32_t cell)
{
    return house->cells[cell].open ? "void" : function_name(house->form, house->cells[cell].function);
}

static const char *storey_name(const tn_house *house, uint32_t storey)
{
    return tn_text(house->form->module,
                   house->form->module->STOREY_records[house->form->record->storey_first + storey].name);
}

/* The house at hand. */
typedef struct adding {
    tn_house_tables *t;
    const tn_house *house;
    uint64_t number;
    const uint32_t *rooms; /* [cells]: the lowest cell of each one's room */
    room *of;              /* the rooms, */
    uint32_t room_count;
    uint32_t *numbers; /* and [cells]: the number of its room, from 1 */
    tn_house_row *row;
    void *context;
} adding;

static tn_status add_rooms(const adding *a, tn_error *error)
{
    tn_house_tables *t = a->t;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < a->room_count; i++) {
        const room *r = &a->of[i];
        begin_row(t);
        put_whole(t, a->number);
        put_whole(t, (uint64_t)i + 1);
        put_text(t, cell_function(a->house, r->first));
        put_text(t, storey_name(a->house, a->house->cells[r->first].storey));
        put_whole(t, r->cells);
        put_nanometres(t, r->gross, 2);
        put_nanometres(t, r->net, 2);
        put_nanometres(t, r->glazed, 2);
        status = give_row(t, TN_TABLE_ROOMS, a->row, a->context, error);
    }
    return status;
}

/* ---- faces */

static void put_cell(const adding *a, uint32_t cell)
{
    if (cell == TN_NO_CELL) {
        put_nothing(a->t);
        put_nothing(a->t);
        return;
    }
    put_whole(a->t, a->numbers[a->rooms[cell]]);
    put_text(a->t, cell_function(a->house, cell));
}

/* Of a wall between a room and a cell in the open, the room comes first, and the side is its. */
static void put_face(const adding *a, uint32_t number)
{
    static const char *const sides[] = {"above", "back", "front", "left", "right"};
    static const int turned[] = {0, 2, 1, 4, 3};
    tn_house_tables *t = a->t;
    const tn_face *face = &a->house->faces[number];
    bool outer = tn_face_is_outer(a->house, face),
         turns = outer && face->second != TN_NO_CELL && tn_face_sheltered(a->house, face) == face->second;
    put_whole(t, a->number);
    put_whole(t, (uint64_t)number + 1);
    put_cell(a, turns ? face->second : face->first);
    put_cell(a, turns ? face->first : face->second);
    put_text(t, storey_name(a->house, face->storey));
    put_text(t, sides[turns ? turned[face->side] : (int)face->side]);
    put_whole(t, outer);
    put_text(t, tn_form_kind_text(a->house->form, face->kind));
    put_nanometres(t, face->at.x0, 1);
    put_nanometres(t, face->at.x1, 1);
    put_nanometres(t, face->at.y0, 1);
    put_nanometres(t, face->at.y1, 1);
    put_nanometres(t, tn_face_glazing(a->house, face), 2);
}

static tn_status add_faces(const adding *a, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < a->house->face_count; i++) {
        begin_row(a->t);
        put_face(a, i);
        status = give_row(a->t, TN_TABLE_FACES, a->row, a->context, error);
    }
    return status;
}

/* ---- houses */

static void put_totals(const adding *a)
{
    tn_int128 gross = 0, net = 0, glazed = 0;
    for (uint32_t i = 0; i < a->room_count; i++) {
        gross += a->of[i].gross;
        net += a->of[i].net;
        glazed += a->of[i].glazed;
    }
    put_whole(a->t, a->room_count);
    put_nanometres(a->t, gross, 2);
    put_nanometres(a->t, net, 2);
    put_nanometres(a->t, glazed, 2);
}

static void put_functions(const adding *a)
{
    const tn_house_form *form = a->house->form;
    for (uint32_t f = 0; f < tn_form_functions(form); f++) {
        uint32_t count = 0;
        tn_int128 net = 0;
        if (!is_first(form, f))
            continue;
        for (uint32_t i = 0; i < a->room_count; i++)
            if (strcmp(cell_function(a->house, a->of[i].first), function_name(form, f)) == 0) {
                count++;
                net += a->of[i].net;
            }
        put_whole(a->t, count);
        put_nanometres(a->t, net, 2);
    }
}

static tn_status put_measures(const adding *a, const mpq_t price, tn_error *error)
{
    size_t count;
    const tn_house_value *values = tn_house_values(a->t->valuer, &count);
    tn_status status = tn_house_values_find(a->t->valuer, a->house, price, error);
    mpq_t shown;
    mpq_init(shown);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        if (!values[i].has) {
            put_nothing(a->t);
            continue;
        }
        mpq_set(shown, values[i].value);
        tn_amount_convert(values[i].unit, shown);
        put_real(a->t, shown);
    }
    mpq_clear(shown);
    return status;
}

static tn_status find_price(const tn_house *house, mpq_t price, mpz_t hundredths, tn_error *error)
{
    tn_costs costs = {0};
    if (!tn_form_has_costs(house->form))
        return TN_OK;
    tn_status status = tn_house_bill(house, tn_house_solids, &costs, error);
    if (status == TN_OK) {
        mpq_set(price, costs.exact);
        mpz_set(hundredths, costs.hundredths);
    }
    tn_costs_clear(&costs);
    return status;
}

static void put_rank(tn_house_tables *t, mpz_srcptr rank)
{
    if (!rank) {
        put_nothing(t);
        return;
    }
    begin_cell(t);
    tn_buffer_integer(&t->cells, rank);
    end_cell(t);
}

static tn_status put_lines(const adding *a, mpz_srcptr rank, mpz_srcptr plan_rank, tn_error *error)
{
    tn_house_tables *t = a->t;
    tn_buffer plan = {0};
    bool good =
        tn_plan_write_line(t->form->schema, a->house->trays, a->house->length, &plan) && tn_buffer_append(&plan, "", 1);
    put_whole(t, a->number);
    put_rank(t, rank);
    put_rank(t, plan_rank);
    put_text(t, good ? plan.data : "");
    put_whole(t, a->house->length);
    free(plan.data);
    return good ? TN_OK : tn_fail_memory(error);
}

static tn_status put_house_line(const adding *a, tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(a->house, &line, error);
    if (status == TN_OK)
        tn_buffer_append(&line, "", 1);
    put_text(a->t, status == TN_OK && !line.failed ? line.data : "");
    if (status == TN_OK && line.failed)
        status = tn_fail_memory(error);
    free(line.data);
    return status;
}

static tn_status add_house(const adding *a, mpz_srcptr rank, mpz_srcptr plan, tn_error *error)
{
    tn_house_tables *t = a->t;
    mpq_t price, shown;
    mpz_t hundredths;
    mpq_inits(price, shown, NULL);
    mpz_init(hundredths);
    begin_row(t);
    tn_status status = find_price(a->house, price, hundredths, error);
    if (status == TN_OK)
        status = put_lines(a, rank, plan, error);
    put_totals(a);
    for (uint32_t i = 0; i < t->form->record->choice_count; i++)
        put_text(t, tn_house_option(a->house, i));
    put_functions(a);
    if (status == TN_OK && tn_form_has_costs(t->form)) {
        mpq_set_z(shown, hundredths);
        mpz_set_ui(mpq_denref(shown), 100);
        put_real(t, shown);
    }
    if (status == TN_OK)
        status = put_measures(a, price, error);
    if (status == TN_OK)
        status = put_house_line(a, error);
    mpq_clears(price, shown, NULL);
    mpz_clear(hundredths);
    return status == TN_OK ? give_row(t, TN_TABLE_HOUSES, a->row, a->context, error) : status;
}

static void find_rooms(adding *a)
{
    for (uint32_t i = 0; i < a->house->cell_count; i++)
        if (a->rooms[i] == i) {
            measure_room(a->house, a->rooms, i, &a->of[a->room_count++]);
            a->numbers[i] = a->room_count;
        }
}

tn_status tn_house_tables_add(tn_house_tables *t, const tn_house *house, uint64_t number, mpz_srcptr rank,
                              mpz_srcptr plan, tn_house_row *row, void *context, tn_error *error)
{
    uint32_t *rooms = NULL;
    tn_status status = tn_house_rooms(house, &rooms, error);
    if (status != TN_OK)
        return status;
    adding a = {.t = t,
                .house = house,
                .number = number,
                .rooms = rooms,
                .of = calloc((size_t)house->cell_count + 1, sizeof *a.of),
                .numbers = calloc((size_t)house->cell_count + 1, sizeof *a.numbers),
                .row = row,
                .context = context};
    status = a.of && a.numbers ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        find_rooms(&a);
        status = add_house(&a, rank, plan, error);
    }
    if (status == TN_OK)
        status = add_rooms(&a, error);
    if (status == TN_OK)
        status = add_faces(&a, error);
    free(a.of);
    free(a.numbers);
    free(rooms);
    return status;
}
