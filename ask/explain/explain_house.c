/* Explains a house by the clauses of a library of houses and of its plans, or by rules. */
#include <stdlib.h>
#include <string.h>

#include "ask/explain/explain.h"
#include "ask/house/numbered.h"
#include "ask/house/typed.h"
#include "ask/session/made.h"
#include "driver/house/change_text.h"
#include "runtime/house/bare.h"
#include "runtime/house/rule/witness.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/ways.h"
#include "runtime/plan/measure/amount.h"

/* ---- says why a plan has no house in a form */

typedef struct cells_explaining {
    const tn_house_form *form;
    tn_bare_cells bare;
} cells_explaining;

static tn_status add_free_tile(cells_explaining *e, uint32_t cell, uint32_t function, uint32_t tile, tn_bare_cell *to,
                               tn_error *error)
{
    tn_tile_failure failure;
    char why[4 * TN_NAME_MAX];
    tn_status status = tn_bare_why(&e->bare, cell, function, tile, &failure, error);
    if (status != TN_OK)
        return status;
    tn_tile_failure_text(e->form, tile, &failure, tn_house_length_style(&e->bare.house), why, sizeof why);
    tn_failing_tile *failing = TN_ADD(failing_tile, to->tiles, error);
    if (!failing)
        return TN_MEMORY;
    failing->tile = tn_text(e->form->module, e->form->module->TILE_records[tile].name);
    failing->has_function = true;
    failing->function = tn_text(e->form->module, tn_form_rule(e->form, function)->name);
    failing->why = strdup(why);
    return failing->why ? TN_OK : tn_fail_memory(error);
}

static tn_status add_tiles(cells_explaining *e, uint32_t cell, uint32_t function, tn_bare_cell *to, tn_error *error)
{
    const tn_form_record *form = e->form->record;
    tn_status status = TN_OK;
    for (uint32_t t = form->tile_first; status == TN_OK && t < form->tile_first + form->tile_count; t++) {
        e->bare.house.cells[cell].function = function;
        bool meant = tn_tile_is_for(&e->bare.house, cell, t);
        e->bare.house.cells[cell].function = TN_NO_FUNCTION;
        if (meant)
            status = add_free_tile(e, cell, function, t, to, error);
    }
    return status;
}

/* A function without tiles, whose ways do not fit. */
static tn_status add_ways(cells_explaining *e, uint32_t cell, uint32_t function, tn_buffer *why, tn_error *error)
{
    tn_way_fault fault;
    char text[TN_NAME_MAX + 200];
    tn_status status = tn_bare_fault(&e->bare, cell, function, &fault, error);
    if (status != TN_OK)
        return status;
    tn_way_fault_text(e->form, &fault, text, sizeof text);
    bool good = tn_buffer_printf(why, "%sas %s, %s", why->size > 0 ? "; " : "",
                                 tn_text(e->form->module, tn_form_rule(e->form, function)->name), text);
    return good ? TN_OK : tn_fail_memory(error);
}

static tn_status set_cell(cells_explaining *e, uint32_t cell, tn_bare_cell *to, tn_error *error)
{
    const tn_house *house = &e->bare.house;
    char name[96];
    tn_buffer why = {0};
    tn_cell_text(house, cell, name, sizeof name);
    to->cell = strdup(name);
    tn_status status = to->cell ? TN_OK : tn_fail_memory(error);
    for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(e->form); f++) {
        if (!tn_cell_may(house, &house->cells[cell], f))
            continue;
        size_t before = to->tiles.count;
        to->usable = true;
        status = add_tiles(e, cell, f, to, error);
        if (status == TN_OK && to->tiles.count == before)
            status = add_ways(e, cell, f, &why, error);
    }
    to->has_why = why.size > 0;
    to->why = why.data; /* freed with the answer */
    return status;
}

static tn_status explain_cells(cells_explaining *e, const tn_numbered *n, const tn_plan *plan, tn_explained_cells *to,
                               tn_error *error)
{
    tn_status status = tn_bare_find(e->form, plan->trays, plan->length, &e->bare, error);
    to->library = tn_text(e->form->module, n->record->name);
    to->form = tn_text(e->form->module, e->form->record->name);
    to->sectionless = status == TN_OK && !e->bare.house.form;
    if (status == TN_OK)
        status = TN_NEW_LIST(bare_cell, to->bare, e->bare.count, error);
    for (size_t i = 0; status == TN_OK && i < e->bare.count; i++)
        status = set_cell(e, e->bare.cells[i], &to->bare.items[i], error);
    return status;
}

/* Each cell could be as it has to be by itself: does any house of the form stand on the plan, whatever clauses say?
 * What takes too much is left open. */
static tn_status find_houseless(tn_numbered *n, const tn_plan *plan, tn_explained_cells *to, tn_error *error)
{
    tn_other_clauses none;
    tn_numbered some;
    mpz_t houses;
    mpz_init(houses);
    tn_other_clauses_set(&n->form, n->record, NULL, 0, &none);
    tn_numbered_other(n, &none.module, &none.library, n->plans, &some);
    tn_status status = tn_numbered_houses_on(&some, plan->trays, (uint32_t)plan->length, houses, error);
    to->houseless = status == TN_OK && mpz_sgn(houses) == 0;
    tn_numbered_other_close(&some);
    mpz_clear(houses);
    return status == TN_LIMIT ? TN_OK : status;
}

/* A plan, #P or #P: */
static tn_status read_plan(tn_numbered *n, const tn_explain_request *request, tn_plan *plan)
{
    size_t size = strlen(request->plan);
    bool colon = request->plan[0] == '#' && request->plan[size - 1] == ':';
    char *text = strndup(request->plan, size - colon);
    tn_error error;
    tn_status status = TN_OK;
    if (text) {
        status = tn_numbered_plan(n, text, tn_asked_length(&request->subject), plan);
    } else {
        tn_fail_memory(&error);
        status = tn_session_fail(n->session, &error);
    }
    free(text);
    return status;
}

static tn_status explain_on(tn_numbered *n, const tn_explain_request *request, tn_reply *answer)
{
    cells_explaining e = {.form = &n->form};
    tn_plan plan = {0};
    tn_error error = {0};
    tn_status status = read_plan(n, request, &plan);
    if (status == TN_OK) {
        status = tn_reply_new(&tn_message_explained_cells, answer, &error);
        if (status == TN_OK)
            status = explain_cells(&e, n, &plan, answer->value, &error);
        if (status == TN_OK && e.bare.count == 0 && e.bare.house.form)
            status = find_houseless(n, &plan, answer->value, &error);
        if (status != TN_OK)
            tn_session_fail(n->session, &error);
        else if (tn_answer_has_picture(&request->drawn))
            status = tn_explain_cells_draw(n->session, request, &e.bare, answer);
    }
    free(plan.trays);
    tn_bare_clear(&e.bare);
    return status;
}

tn_status tn_explain_cells(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    tn_numbered n;
    tn_status status = tn_numbered_open(&n, session, &settings);
    if (status == TN_OK)
        status = explain_on(&n, request, answer);
    tn_numbered_close(&n);
    return status;
}

/* ---- says on what of a house an answer rests */

enum { TEXT_MAX = 4096 };

/* ---- what questions find */

typedef struct answering {
    tn_house_explaining *e;
    tn_list *why; /* of tn_asked_of_house; what is found is of the last of them */
} answering;

/* The question as its author wrote it, on one line; the word of its kind where there is no source. */
static void question_text(const tn_house_explaining *e, uint32_t offset, char *text, size_t size)
{
    tn_span span;
    size_t used = 0;
    if (!e->session->opened->compiled || !tn_code_span(e->session->opened, offset, &span)) {
        snprintf(text, size, "a question of the file");
        return;
    }
    const char *source = e->session->opened->compilation.sources.files[span.file].text;
    for (uint32_t i = span.begin; i < span.end && used + 1 < size; i++) {
        bool blank = strchr(" \t\r\n", source[i]) != NULL;
        if (!blank || (used > 0 && text[used - 1] != ' '))
            text[used++] = blank ? ' ' : source[i];
    }
    text[used] = '\0';
}

static void room_text(const tn_house *house, uint32_t room, char *text, size_t size)
{
    uint32_t *rooms = NULL;
    tn_error error;
    size_t used = 0;
    char cell[96];
    if (tn_house_rooms(house, &rooms, &error) != TN_OK)
        return;
    for (uint32_t i = room; i < house->cell_count && used + sizeof cell < size; i++) {
        if (rooms[i] != room)
            continue;
        tn_cell_text(house, i, cell, sizeof cell);
        used += (size_t)snprintf(text + used, size - used, "%s%s", i == room ? "" : " with ", cell);
    }
    free(rooms);
}

/* "2.body.upper, from where one comes to 2.body.ground" */
static void walk_text(const tn_house *house, const tn_witness *found, char *text, size_t size)
{
    char cell[96];
    size_t used, others = 0;
    tn_cell_text(house, found->first, cell, sizeof cell);
    used = (size_t)snprintf(text, size, "%s, from where the walk ", cell);
    for (uint32_t i = 0; i < house->cell_count && used + sizeof cell < size; i++) {
        if (!found->reached[i] || i == found->first)
            continue;
        tn_cell_text(house, i, cell, sizeof cell);
        used += (size_t)snprintf(text + used, size - used, "%s%s", others++ ? ", " : "comes only to ", cell);
    }
    if (others == 0 && used < size)
        snprintf(text + used, size - used, "leads nowhere");
}

/* "2.body.upper, from where it is 27.3m", "... no walk leads", "... 1 way leads outside" */
static void walked_text(const tn_house *house, const tn_witness *found, char *text, size_t size)
{
    char cell[96], length[64] = "";
    tn_cell_text(house, found->first, cell, sizeof cell);
    if (found->term->kind == TN_HOUSE_EXITS) {
        snprintf(text, size, "%s, from where %lld %s outside", cell, (long long)found->number,
                 found->number == 1 ? "way leads" : "ways lead");
    } else if (found->number == TN_NO_PATH) {
        snprintf(text, size, "%s, from where no walk leads there", cell);
    } else {
        tn_way_length_text(house, found->number, length);
        snprintf(text, size, "%s, from where it is %s", cell, length);
    }
}

static void found_text(const tn_house *house, const tn_witness *found, char *text, size_t size)
{
    if (found->term) {
        walked_text(house, found, text, size);
        return;
    }
    switch (found->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        room_text(house, found->first, text, size);
        return;
    case TN_OP_MEETS:
        tn_face_text(house, found->face, text, size);
        snprintf(text + strlen(text), size - strlen(text), ": %s",
                 tn_form_kind_text(house->form, house->faces[found->face].kind));
        return;
    case TN_OP_APART:
        walk_text(house, found, text, size);
        return;
    default:
        tn_cell_text(house, found->first, text, size);
    }
}

/* Exactly where a decimal does that, else to six digits. */
static bool append_amount(tn_amount_unit unit, mpq_t value, tn_buffer *out)
{
    bool good = tn_amount_write(unit, value, out);
    if (!good || !strchr(out->data, '/'))
        return good;
    out->size = 0;
    tn_amount_convert(unit, value);
    return tn_amount_write_about(unit, value, out);
}

/* Or what it is instead of a number. */
static bool append_worth(tn_amount_unit unit, tn_worth worth, mpq_t value, tn_buffer *out)
{
    static const char *const others[] = {NULL, "no number", "less than any number, as there are no such cells",
                                         "more than any number, as there are no such cells"};
    return worth == TN_HAS_WORTH ? append_amount(unit, value, out) : tn_buffer_printf(out, "%s", others[worth]);
}

static tn_status append_found(answering *a, const char *text, tn_error *error)
{
    tn_asked_of_house *questions = a->why->items;
    return tn_owneds_add(&questions[a->why->count - 1].found, strdup(text), error);
}

/* What a comparison finds: the number of the house and the one that is compared with it, costs to the cent. */
static tn_status append_numbers(answering *a, uint32_t offset, tn_error *error)
{
    const tn_module *module = a->e->judge.module;
    tn_instruction op = tn_code_read(module->code, offset);
    const tn_sum_record *sum = &module->SUM_records[module->HOUSE_SUM_records[op.first].sum];
    tn_amount_unit unit = tn_amount_unit_of(a->e->judge.schema, sum->power);
    tn_buffer left = {0}, right = {0}, said = {0};
    bool costs = false;
    tn_worth worth = TN_HAS_WORTH;
    mpq_t value, constant;
    mpq_inits(value, constant, NULL);
    tn_status status = tn_house_rules_sum(a->e->judge.rules, (uint32_t)op.first, value, &worth, &costs, error);
    mpq_set_str(constant, tn_text(module, sum->constant), 10);
    mpq_sub(value, value, constant);
    mpq_neg(constant, constant);
    if (costs)
        tn_round_to_cent(value);
    bool alone = mpq_sgn(constant) == 0;
    if (status == TN_OK && (!append_worth(unit, worth, value, &left) || !append_amount(unit, constant, &right)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        tn_buffer_printf(&said, "%s%s%s%s", alone ? "the left side less the right side is " : "", left.data,
                         alone ? "" : ", compared with ", alone ? "" : right.data);
    if (status == TN_OK && said.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = append_found(a, said.data, error);
    free(said.data);
    free(left.data);
    free(right.data);
    mpq_clears(value, constant, NULL);
    return status;
}

static tn_status begin_question(answering *a, uint32_t offset, tn_error *error)
{
    char text[TEXT_MAX] = "";
    tn_asked_of_house *asked = tn_message_add(&tn_message_asked_of_house, a->why, error);
    if (!asked)
        return TN_MEMORY;
    question_text(a->e, offset, text, sizeof text);
    asked->question = strdup(text);
    return asked->question ? TN_OK : tn_fail_memory(error);
}

static tn_status see_found(void *context, const tn_witness *found, tn_error *error)
{
    answering *a = context;
    char text[TEXT_MAX] = "";
    if (found->first != TN_NO_CELL) {
        found_text(&a->e->house, found, text, sizeof text);
        return append_found(a, text, error);
    }
    tn_status status = begin_question(a, found->offset, error);
    return status == TN_OK && tn_code_compares_house((tn_opcode)found->opcode) ? append_numbers(a, found->offset, error)
                                                                               : status;
}

tn_status tn_explain_found(tn_house_explaining *e, uint32_t function, tn_list *why, tn_error *error)
{
    answering a = {e, why};
    return tn_house_rules_witness(e->judge.rules, function, see_found, &a, error);
}

/* ---- tiles */

/* Behind the reason, how far a person comes. */
static void append_stop(const tn_house *house, const tn_way_stop *stop, char *text, size_t size)
{
    char said[200];
    size_t used = strlen(text);
    tn_way_stop_text(house, stop, said, sizeof said);
    if (*said)
        snprintf(text + used, size - used, "; %s", said);
}

static tn_status append_tile_stop(tn_house_explaining *e, uint32_t cell, uint32_t tile, const tn_tile_failure *failure,
                                  char *text, size_t size, tn_error *error)
{
    tn_way_stop stop = {0};
    if (!tn_tile_failure_stops(failure))
        return TN_OK;
    tn_status status = tn_tile_stop(&e->house, cell, tile, failure, &stop, error);
    if (status == TN_OK)
        append_stop(&e->house, &stop, text, size);
    tn_way_stop_clear(&stop);
    return status;
}

static tn_status add_tile(tn_house_explaining *e, uint32_t cell, uint32_t tile, tn_bare_cell *bare, tn_error *error)
{
    const tn_tile_record *record = &e->judge.module->TILE_records[tile];
    tn_tile_failure failure;
    char text[TEXT_MAX];
    tn_status status = tn_tile_fails(&e->house, cell, tile, &failure, error);
    if (status != TN_OK)
        return status;
    tn_tile_failure_text(&e->judge.form, tile, &failure, tn_house_length_style(&e->house), text, sizeof text);
    status = append_tile_stop(e, cell, tile, &failure, text, sizeof text, error);
    if (status != TN_OK)
        return status;
    tn_failing_tile *to = TN_ADD(failing_tile, bare->tiles, error);
    if (!to)
        return TN_MEMORY;
    to->tile = tn_text(e->judge.module, record->name);
    to->why = strdup(text);
    return to->why ? TN_OK : tn_fail_memory(error);
}

static tn_status append_cell_stop(tn_house_explaining *e, uint32_t cell, char *text, size_t size, tn_error *error)
{
    tn_way_stop stop = {0};
    tn_status status = tn_cell_stop(&e->house, cell, &stop, error);
    if (status == TN_OK)
        append_stop(&e->house, &stop, text, size);
    tn_way_stop_clear(&stop);
    return status;
}

static tn_status append_flight_stop(tn_house_explaining *e, uint32_t cell, char *text, size_t size, tn_error *error)
{
    tn_flight_stop stop = {0};
    char said[400], name[96];
    size_t used = strlen(text);
    tn_status status = tn_stack_stop(&e->house, cell, &stop, error);
    if (status == TN_OK) {
        tn_cell_text(&e->house, stop.cell, name, sizeof name);
        tn_flight_stop_text(&e->house, &stop, name, said, sizeof said);
        snprintf(text + used, size - used, "%s%s", *said ? "; " : "", said);
    }
    tn_way_stop_clear(&stop.way);
    return status;
}

/* Why a cell without tiles does not fit. */
static tn_status add_fault(tn_house_explaining *e, uint32_t cell, tn_bare_cell *bare, tn_error *error)
{
    tn_way_fault fault;
    char text[TEXT_MAX];
    tn_status status = tn_cell_ways(&e->house, cell, &fault, error);
    if (status != TN_OK)
        return status;
    tn_way_fault_text(&e->judge.form, &fault, text, sizeof text);
    status = (fault.flight ? append_flight_stop : append_cell_stop)(e, cell, text, sizeof text, error);
    if (status != TN_OK)
        return status;
    bare->has_why = true;
    bare->why = strdup(text);
    return bare->why ? TN_OK : tn_fail_memory(error);
}

static tn_status add_bare(tn_house_explaining *e, uint32_t cell, tn_list *list, tn_error *error)
{
    const tn_form_record *form = e->judge.form.record;
    char text[96];
    tn_cell_text(&e->house, cell, text, sizeof text);
    tn_bare_cell *bare = tn_message_add(&tn_message_bare_cell, list, error);
    if (!bare)
        return TN_MEMORY;
    bare->usable = true;
    bare->cell = strdup(text);
    tn_status status = bare->cell ? TN_OK : tn_fail_memory(error);
    bool tiles = false;
    for (uint32_t t = form->tile_first; status == TN_OK && t < form->tile_first + form->tile_count; t++)
        if (tn_tile_is_for(&e->house, cell, t)) {
            status = add_tile(e, cell, t, bare, error);
            tiles = true;
        }
    return status == TN_OK && !tiles ? add_fault(e, cell, bare, error) : status;
}

static tn_status is_bare(const tn_house_explaining *e, uint32_t cell, bool *bare, tn_error *error)
{
    tn_variants tiles;
    tn_status status = tn_tile_variants(&e->house, cell, &tiles, error);
    *bare = status == TN_OK && tiles.wanted && tiles.count == 0;
    if (status == TN_OK && !tiles.wanted) {
        tn_way_fault fault;
        status = tn_cell_ways(&e->house, cell, &fault, error);
        *bare = fault.fault != TN_FLOOR_FITS || fault.flight;
    }
    tn_variants_clear(&tiles);
    return status;
}

tn_status tn_explain_bare(tn_house_explaining *e, tn_list *list, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t cell = 0; status == TN_OK && cell < e->house.cell_count; cell++) {
        bool bare = false;
        status = is_bare(e, cell, &bare, error);
        if (status == TN_OK && bare)
            status = add_bare(e, cell, list, error);
    }
    return status;
}

/* ---- openings behind lower roofs */

tn_status tn_explain_covered(tn_house_explaining *e, tn_list *list, tn_error *error)
{
    for (uint32_t i = 0; i < e->house.face_count; i++) {
        char face[256], why[200];
        tn_behind_roof behind;
        if (!tn_face_behind_roof(&e->house, &e->house.faces[i], TN_NO_RECORD, &behind))
            continue;
        tn_covered_opening *to = tn_message_add(&tn_message_covered_opening, list, error);
        if (!to)
            return TN_MEMORY;
        tn_face_text(&e->house, i, face, sizeof face);
        tn_behind_roof_text(&e->house, &behind, why, sizeof why);
        to->opening = tn_form_kind_text(&e->judge.form, behind.kind);
        to->face = strdup(face);
        to->why = strdup(why);
        if (!to->face || !to->why)
            return tn_fail_memory(error);
    }
    return TN_OK;
}

/* ---- walls over nothing */

tn_status tn_explain_hanging(tn_house_explaining *e, tn_list *list, tn_error *error)
{
    int64_t from, to;
    tn_flights flights;
    tn_bearing bearing = {0};
    tn_status status = tn_flights_stand(&e->house, &flights, error);
    if (status == TN_OK)
        status = tn_house_bearing(&e->house, &flights, &bearing, error);
    for (uint32_t i = 0; status == TN_OK && i < e->house.face_count; i++) {
        char text[600];
        if (!tn_face_hangs(&bearing, &e->house.faces[i], &from, &to, NULL))
            continue;
        tn_hanging_wall *wall = tn_message_add(&tn_message_hanging_wall, list, error);
        tn_hanging_text(&e->house, &bearing, i, text, sizeof text);
        if (!wall || !(wall->wall = strdup(text)))
            status = tn_fail_memory(error);
    }
    tn_bearing_clear(&bearing);
    tn_flights_clear(&flights);
    return status;
}

/* ---- looks for kept houses near to one that is dropped */

enum { NEAREST_MAX = 5 };

/* ---- one change */

typedef struct nearing {
    tn_house_explaining *e;
    tn_explained_house *explained;
} nearing;

static tn_status set_words(const tn_change_words *w, char **where, char **from, char **to, tn_error *error)
{
    *where = strdup(w->where);
    *from = strdup(w->from);
    *to = strdup(w->to);
    return *where && *from && *to ? TN_OK : tn_fail_memory(error);
}

static tn_status see_near(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    nearing *n = context;
    tn_change_words w;
    tn_buffer line = {0};
    if (n->explained->nearest.count == NEAREST_MAX) {
        n->explained->more++;
        return TN_OK;
    }
    tn_nearest_house *near = TN_ADD(nearest_house, n->explained->nearest, error);
    if (!near)
        return TN_MEMORY;
    tn_change_text(&n->e->house, change, &w);
    near->has_where = near->has_from = near->has_to = true;
    tn_status status = set_words(&w, &near->where, &near->from, &near->to, error);
    if (status == TN_OK)
        status = tn_house_write(changed, &line, error);
    near->house = line.data;
    return status;
}

/* ---- several changes */

enum {
    BEAM = 16,
    DEPTH = 8,
    NODES = 1 + BEAM * DEPTH,
    TRIED_MAX = 400000 /* cells of houses that are looked at: about a second */
};

/* A house that was come to by changes. */
typedef struct near_node {
    char *line;
    size_t dropping, parent; /* clauses that drop it */
    size_t sections;         /* of the changes that lead to it, those of its section, which change much besides */
    tn_change_words words;   /* of the change from its parent */
} near_node;

/* Houses with as many changes as the level are nodes [first, count): the best so far, the best first. */
typedef struct beam {
    tn_house_explaining *e;
    const tn_house *from;
    bool few_sections; /* of nodes that as many clauses drop, those with fewer changes of the section are better */
    size_t parent, first, count, tried;
    near_node nodes[NODES];
} beam;

static tn_status count_dropping(tn_house_explaining *e, const tn_house *house, size_t *count, tn_error *error)
{
    tn_status status = tn_house_rules_start(e->judge.rules, house, error);
    *count = 0;
    for (uint32_t i = 0; status == TN_OK && i < e->library->clause_count; i++) {
        bool drops = false;
        status = tn_house_rules_drop(e->judge.rules, e->library, i, &drops, error);
        *count += drops;
    }
    return status;
}

static bool is_met(const beam *b, const char *line)
{
    for (size_t i = 0; i < b->count; i++)
        if (strcmp(b->nodes[i].line, line) == 0)
            return true;
    return false;
}

/* Did a change on the way to the node, that node's included, choose the same thing? */
static bool is_chosen(const beam *b, size_t node, const char *where)
{
    for (; node != 0; node = b->nodes[node].parent)
        if (strcmp(b->nodes[node].words.where, where) == 0)
            return true;
    return false;
}

static bool is_better(const beam *b, const near_node *node, const near_node *other)
{
    return node->dropping != other->dropping ? node->dropping < other->dropping
                                             : b->few_sections && node->sections < other->sections;
}

/* Takes the node into its level, if it is among the best there; else it is freed. */
static void insert(beam *b, const near_node *node)
{
    size_t at = b->count;
    while (at > b->first && is_better(b, node, &b->nodes[at - 1]))
        at--;
    if (at == b->first + BEAM) {
        free(node->line);
        return;
    }
    if (b->count == b->first + BEAM)
        free(b->nodes[--b->count].line);
    memmove(&b->nodes[at + 1], &b->nodes[at], (b->count - at) * sizeof *b->nodes);
    b->nodes[at] = *node;
    b->count++;
}

static tn_status see_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    beam *b = context;
    near_node node = {.parent = b->parent};
    tn_buffer line = {0};
    b->tried += changed->cell_count;
    tn_change_text(b->from, change, &node.words);
    if (is_chosen(b, b->parent, node.words.where))
        return TN_OK;
    tn_status status = count_dropping(b->e, changed, &node.dropping, error);
    bool full = b->count == b->first + BEAM;
    node.sections = b->nodes[b->parent].sections + (change->kind == TN_CHANGE_SECTION);
    if (status != TN_OK || (full && !is_better(b, &node, &b->nodes[b->count - 1])))
        return status;
    status = tn_house_write(changed, &line, error);
    if (status != TN_OK || is_met(b, line.data)) {
        free(line.data);
        return status;
    }
    node.line = line.data;
    insert(b, &node);
    return TN_OK;
}

static tn_status try_changes(beam *b, const tn_house *from, size_t parent, tn_error *error)
{
    b->from = from;
    b->parent = parent;
    return tn_house_changes(from, b->e->judge.rules, NULL, TN_NO_CELL, see_change, b, error);
}

/* Node 0 is the house that is explained. It may have cells in which no tile stands, so that its line cannot be read. */
static tn_status expand(beam *b, size_t parent, tn_error *error)
{
    const char *line = b->nodes[parent].line;
    tn_house from = {0};
    if (parent == 0)
        return try_changes(b, &b->e->house, parent, error);
    tn_status status = tn_house_read_open(&b->e->judge.form, line, strlen(line), b->e->house.length, &from, error);
    if (status == TN_OK)
        status = try_changes(b, &from, parent, error);
    tn_house_clear(&from);
    return status;
}

/* The changes that lead to a node, the first first. */
static tn_status add_steps(const beam *b, size_t node, tn_nearest_house *near, tn_error *error)
{
    if (b->nodes[node].parent != 0) {
        tn_status status = add_steps(b, b->nodes[node].parent, near, error);
        if (status != TN_OK)
            return status;
    }
    tn_house_step *step = TN_ADD(house_step, near->changes, error);
    return step ? set_words(&b->nodes[node].words, &step->where, &step->from, &step->to, error) : TN_MEMORY;
}

/* *depth: how many changes lead to the kept house that is found first in its level, or 0. */
static tn_status search(beam *b, int *depth, tn_error *error)
{
    tn_status status = TN_OK;
    size_t level = 0, end = 1;     /* the nodes that are expanded now */
    b->nodes[0].line = strdup(""); /* a way back to it would be no shorter */
    if (!b->nodes[0].line)
        return tn_fail_memory(error);
    b->count = 1;
    for (int d = 1; status == TN_OK && *depth == 0 && d <= DEPTH && level < end; d++) {
        b->first = b->count;
        for (size_t i = level; status == TN_OK && i < end && b->tried < TRIED_MAX; i++)
            status = expand(b, i, error);
        level = b->first;
        end = b->count;
        if (status == TN_OK && end > level && b->nodes[level].dropping == 0)
            *depth = d;
    }
    return status;
}

static tn_status add_found(const beam *b, tn_explained_house *explained, tn_error *error)
{
    tn_nearest_house *near = TN_ADD(nearest_house, explained->nearest, error);
    if (!near)
        return TN_MEMORY;
    near->has_changes = true;
    near->house = strdup(b->nodes[b->first].line);
    return near->house ? add_steps(b, b->first, near, error) : tn_fail_memory(error);
}

static void clear_beam(beam *b)
{
    for (size_t i = 0; i < b->count; i++)
        free(b->nodes[i].line);
}

/* Some houses are found sooner where the section is left alone, others where it is changed first: both are tried. */
static tn_status find_several(tn_house_explaining *e, tn_explained_house *explained, tn_error *error)
{
    beam *both = calloc(2, sizeof *both);
    int depth[2] = {0};
    tn_status status = both ? TN_OK : tn_fail_memory(error);
    for (int i = 0; status == TN_OK && i < 2; i++) {
        both[i].e = e;
        both[i].few_sections = i == 0;
        status = search(&both[i], &depth[i], error);
    }
    bool second = depth[0] == 0 || (depth[1] > 0 && depth[1] < depth[0]);
    if (status == TN_OK && (depth[0] > 0 || depth[1] > 0))
        status = add_found(&both[second], explained, error);
    for (int i = 0; both && i < 2; i++)
        clear_beam(&both[i]);
    free(both);
    return status;
}

tn_status tn_explain_nearest(tn_house_explaining *e, tn_explained_house *explained, tn_error *error)
{
    nearing n = {e, explained};
    tn_status status = tn_house_changes(&e->house, e->judge.rules, e->library, TN_NO_CELL, see_near, &n, error);
    return status == TN_OK && explained->nearest.count == 0 ? find_several(e, explained, error) : status;
}

/* ---- explains a house by the clauses of a library of houses and of its plans, or by rules */

/* The library that is named, or the first of the rules, says of which form the house is. */
static tn_status choose(tn_house_explaining *e, const tn_explain_request *request, uint32_t *form)
{
    const tn_module *module = e->session->opened->module;
    const char *library = request->subject.library;
    if (request->rules.count > 0) {
        uint32_t rule = tn_house_rule_find(module, request->rules.items[0]);
        *form = rule == TN_NO_RECORD ? 0 : module->HOUSE_RULE_records[rule].form;
        return rule != TN_NO_RECORD
                   ? TN_OK
                   : tn_session_refuse(e->session, "name a rule that asks for cells, rooms or options",
                                       "the file has no rule `%.80s` about houses", request->rules.items[0]);
    }
    uint32_t found = tn_house_library_find(module, library);
    if (found == TN_NO_RECORD)
        return tn_say_no_houses(e->session, library);
    e->library = &module->HOUSE_LIBRARY_records[found];
    *form = e->library->form;
    return TN_OK;
}

/* ---- a library */

static tn_status set_clause(tn_house_explaining *e, const tn_house_clause *clause, tn_explained_house_clause *to,
                            tn_error *error)
{
    to->name = clause->name;
    to->doc = clause->doc;
    to->kind = clause->trays ? "trays" : tn_names_CLAUSE_KIND[clause->kind];
    to->of = clause->of_plans ? "plan" : "house";
    to->holds = clause->holds;
    to->drops = clause->drops;
    return clause->function == TN_NO_RECORD ? TN_OK : tn_explain_found(e, clause->function, TN_WHY(to->why), error);
}

/* drops: a clause does. by_plan: one about plans does. */
static tn_status set_clauses(tn_house_explaining *e, tn_explained_house *to, bool *drops, bool *by_plan,
                             tn_error *error)
{
    tn_house_clause *clauses = NULL;
    size_t count = 0;
    tn_status status = tn_house_judge_clauses(&e->judge, e->library, &e->house, &clauses, &count, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(explained_house_clause, to->clauses, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        *drops |= clauses[i].drops;
        *by_plan |= clauses[i].drops && clauses[i].of_plans;
        status = set_clause(e, &clauses[i], &to->clauses.items[i], error);
    }
    free(clauses);
    return status;
}

static tn_status explain_library(tn_house_explaining *e, tn_explained_house *to, tn_error *error)
{
    bool drops = false, by_plan = false;
    to->library = tn_text(e->judge.module, e->library->name);
    tn_status status = set_clauses(e, to, &drops, &by_plan, error);
    if (status == TN_OK)
        status = tn_explain_bare(e, (tn_list *)&to->bare, error);
    if (status == TN_OK)
        status = tn_explain_covered(e, (tn_list *)&to->behind_roofs, error);
    if (status == TN_OK)
        status = tn_explain_hanging(e, (tn_list *)&to->hanging, error);
    to->has_hanging = to->hanging.count > 0;
    to->kept = !drops && to->bare.count == 0;
    to->has_nearest = !to->kept && !by_plan;
    return status == TN_OK && to->has_nearest ? tn_explain_nearest(e, to, error) : status;
}

/* ---- rules */

static tn_status explain_rule(tn_house_explaining *e, const char *name, tn_explained_house_rule *to, tn_error *error)
{
    const tn_module *module = e->judge.module;
    uint32_t rule = tn_house_rule_find(module, name);
    if (rule == TN_NO_RECORD || &module->FORM_records[module->HOUSE_RULE_records[rule].form] != e->judge.form.record)
        return tn_fail(error, TN_INVALID, E_NOT_IN_FILE, "there is no rule `%.80s` about houses of that form", name);
    uint32_t holds = module->HOUSE_RULE_records[rule].holds;
    to->name = name;
    tn_status status = tn_house_rules_hold(e->judge.rules, holds, &to->matches, error);
    return status == TN_OK ? tn_explain_found(e, holds, TN_WHY(to->why), error) : status;
}

static tn_status explain_rules(tn_house_explaining *e, const tn_texts *rules, tn_explained_house_by_rules *to,
                               tn_error *error)
{
    tn_status status = tn_house_rules_start(e->judge.rules, &e->house, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(explained_house_rule, to->rules, rules->count, error);
    for (size_t i = 0; status == TN_OK && i < rules->count; i++)
        status = explain_rule(e, rules->items[i], &to->rules.items[i], error);
    return status;
}

/* ---- the whole */

static tn_status explain(tn_house_explaining *e, const tn_explain_request *request, uint32_t form, const char *line,
                         tn_reply *answer)
{
    tn_error error = {0};
    tn_buffer own = {0};
    bool library = e->library != NULL, completed;
    const tn_typed_among among = {.form = &e->judge.form,
                                  .form_number = form,
                                  .library = e->library,
                                  .options = tn_asked_options(&request->subject),
                                  .max_length = tn_asked_length(&request->subject),
                                  .tiles_free = true};
    tn_status status = tn_typed_house(e->session, &among, line, &e->house, &completed);
    if (status != TN_OK)
        return status;
    if (completed)
        status = tn_house_write(&e->house, &own, &error);
    if (status != TN_OK)
        return tn_session_fail(e->session, &error);
    status = tn_reply_new(library ? &tn_message_explained_house : &tn_message_explained_house_by_rules, answer, &error);
    tn_explained_house *of_library = status == TN_OK ? TN_REPLY(explained_house, answer) : NULL;
    tn_explained_house_by_rules *of_rules = status == TN_OK ? TN_REPLY(explained_house_by_rules, answer) : NULL;
    if (status == TN_OK) {
        char *copy = completed ? own.data : strdup(line);
        *(library ? &of_library->house : &of_rules->house) = copy;
        status = copy ? TN_OK : tn_fail_memory(&error);
    }
    if (status == TN_OK)
        status = library ? explain_library(e, of_library, &error) : explain_rules(e, &request->rules, of_rules, &error);
    if (status != TN_OK)
        return tn_session_fail(e->session, &error);
    return tn_answer_has_picture(&request->drawn) ? tn_explain_house_draw(e, request, answer) : TN_OK;
}

static tn_status explain_line(tn_session *session, const tn_explain_request *request, const char *line,
                              tn_reply *answer)
{
    tn_house_explaining e = {.session = session};
    uint32_t form;
    tn_error error;
    tn_status status = choose(&e, request, &form);
    if (status == TN_OK) {
        status =
            tn_house_judge_open(session->opened->module, form, tn_asked_length(&request->subject), &e.judge, &error);
        status = status == TN_OK ? explain(&e, request, form, line, answer) : tn_session_fail(session, &error);
    }
    tn_house_clear(&e.house);
    tn_house_judge_close(&e.judge);
    return status;
}

static tn_status write_line(void *line, const tn_house *house, tn_error *error)
{
    return tn_house_write(house, line, error);
}

tn_status tn_explain_house(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    tn_buffer line = {0};
    if (!tn_is_house_number(request->house))
        return explain_line(session, request, request->house, answer);
    tn_status status = tn_session_house(session, &settings, request->house, write_line, &line);
    if (status == TN_OK)
        status = explain_line(session, request, line.data, answer);
    free(line.data);
    return status;
}
