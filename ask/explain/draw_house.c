/* Draws why houses are kept or dropped: what the explanation names is lit up on the house's plans. */
#include <stdlib.h>
#include <string.h>

#include "ask/explain/explain.h"
#include "ask/session/made.h"
#include "driver/house/change_text.h"
#include "runtime/base/array.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/rule/witness.h"
#include "runtime/house/solids.h"
#include "runtime/house/ways.h"

/* A reason under construction; its texts and lits are owned. */
typedef struct drawn_reason {
    char *heading;
    tn_owneds lines;
    tn_lit *lits;
    size_t lit_count, lit_room;
    bool good;
} drawn_reason;

/* The reasons of a picture. */
typedef struct drawing {
    const tn_house *house;
    uint32_t *rooms; /* tn_house_rooms; owned */
    drawn_reason *reasons;
    size_t count, room;
} drawing;

static void clear_drawing(drawing *d)
{
    for (size_t i = 0; i < d->count; i++) {
        drawn_reason *reason = &d->reasons[i];
        free(reason->heading);
        for (size_t k = 0; k < reason->lines.count; k++)
            free(reason->lines.items[k]);
        free(reason->lines.items);
        free(reason->lits);
    }
    free(d->reasons);
    free(d->rooms);
}

/* ---- what is said: takes what the text has */

/* A picture shows names without the backquotes of messages. */
static void take_quotes(tn_buffer *text)
{
    size_t kept = 0;
    for (size_t i = 0; i < text->size; i++)
        if (text->data[i] != '`')
            text->data[kept++] = text->data[i];
    if (text->data)
        text->data[kept] = '\0';
    text->size = kept;
}

static tn_status add_reason(drawing *d, tn_buffer *heading, bool good, tn_error *error)
{
    take_quotes(heading);
    drawn_reason reason = {.heading = heading->data, .good = good};
    if (heading->failed || !heading->data ||
        !tn_array_reserve(&d->reasons, &d->room, d->count, 1, sizeof *d->reasons)) {
        free(heading->data);
        return tn_fail_memory(error);
    }
    d->reasons[d->count++] = reason;
    return TN_OK;
}

static tn_status add_line(drawing *d, tn_buffer *line, tn_error *error)
{
    take_quotes(line);
    if (!line->failed && line->data)
        return tn_owneds_add(&d->reasons[d->count - 1].lines, line->data, error);
    free(line->data);
    return tn_fail_memory(error);
}

/* ---- what is lit up */

/* What is lit up twice shines as what is worse. */
static tn_status light(drawing *d, uint32_t storey, const tn_rectangle *at, tn_lit_tone tone, tn_error *error)
{
    drawn_reason *reason = &d->reasons[d->count - 1];
    const tn_lit lit = {storey, *at, reason->good && tone != TN_LIT_WALK ? TN_LIT_GOOD : tone};
    for (size_t i = 0; i < reason->lit_count; i++) {
        tn_lit *known = &reason->lits[i];
        if (known->storey != storey || memcmp(&known->at, at, sizeof *at) != 0)
            continue;
        known->tone = lit.tone < known->tone ? lit.tone : known->tone;
        return TN_OK;
    }
    if (!tn_array_reserve(&reason->lits, &reason->lit_room, reason->lit_count, 1, sizeof *reason->lits))
        return tn_fail_memory(error);
    reason->lits[reason->lit_count++] = lit;
    return TN_OK;
}

static tn_status light_cell(drawing *d, uint32_t cell, tn_lit_tone tone, tn_error *error)
{
    const tn_rectangle clear = tn_cell_clear(d->house, cell);
    return light(d, d->house->cells[cell].storey, &clear, tone, error);
}

/* A floor is the ceiling below it, too. */
static tn_status light_face(drawing *d, uint32_t number, tn_error *error)
{
    const tn_face *face = &d->house->faces[number];
    tn_status status = light(d, d->house->cells[face->first].storey, &face->at, TN_LIT_FAULT, error);
    if (status == TN_OK && face->relation == TN_FACE_UNDER && face->second != TN_NO_CELL)
        status = light(d, d->house->cells[face->second].storey, &face->at, TN_LIT_FAULT, error);
    return status;
}

static tn_status light_room(drawing *d, uint32_t room, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = room; status == TN_OK && i < d->house->cell_count; i++)
        if (d->rooms[i] == room)
            status = light_cell(d, i, TN_LIT_FAULT, error);
    return status;
}

static tn_status light_walk(drawing *d, const tn_witness *found, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < d->house->cell_count; i++)
        if (found->reached[i] && i != found->first)
            status = light_cell(d, i, TN_LIT_BESIDE, error);
    return status == TN_OK ? light_cell(d, found->first, TN_LIT_FAULT, error) : status;
}

/* The cell, and the walk from it to where it leads. */
static tn_status light_walked(drawing *d, const tn_witness *found, tn_error *error)
{
    tn_status status = light_cell(d, found->first, TN_LIT_FAULT, error);
    for (size_t i = 0; status == TN_OK && i < found->line_count; i++) {
        const tn_walk_line *line = &found->lines[i];
        const tn_rectangle at = {line->from.x, line->to.x, line->from.y, line->to.y};
        status = light(d, line->storey, &at, TN_LIT_WALK, error);
    }
    return status;
}

static tn_status see_found(void *context, const tn_witness *found, tn_error *error)
{
    drawing *d = context;
    if (found->first == TN_NO_CELL)
        return TN_OK;
    if (found->term)
        return light_walked(d, found, error);
    switch (found->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        return light_room(d, found->first, error);
    case TN_OP_MEETS:
        return light_face(d, found->face, error);
    case TN_OP_APART:
        return light_walk(d, found, error);
    default:
        return light_cell(d, found->first, TN_LIT_FAULT, error);
    }
}

/* The cell that an explanation names; TN_NO_CELL: there is none. */
static uint32_t named_cell(const drawing *d, const char *name)
{
    char text[96];
    for (uint32_t i = 0; i < d->house->cell_count; i++) {
        tn_cell_text(d->house, i, text, sizeof text);
        if (strcmp(text, name) == 0)
            return i;
    }
    return TN_NO_CELL;
}

/* How far a person comes in a cell: the things there, the ground, the person, and what is not reached. */
static tn_status light_stop(drawing *d, uint32_t cell, const tn_way_stop *stop, tn_error *error)
{
    uint32_t storey = d->house->cells[cell].storey;
    tn_status status = light_cell(d, cell, TN_LIT_BESIDE, error);
    for (size_t i = 0; status == TN_OK && i < stop->items.count; i++)
        status = light(d, storey, &stop->items.items[i], TN_LIT_THING, error);
    for (size_t i = 0; status == TN_OK && i < stop->at.ground_count; i++)
        status = light(d, storey, &stop->at.ground[i], TN_LIT_GROUND, error);
    if (status == TN_OK && stop->at.square.x0 < stop->at.square.x1)
        status = light(d, storey, &stop->at.square, TN_LIT_PERSON, error);
    return status == TN_OK ? light(d, storey, &stop->at.missed, TN_LIT_FAULT, error) : status;
}

/* What stops a person in a cell in which no tile stands: of the first tile that does; *found: there is one. */
static tn_status find_tile_stop(const drawing *d, uint32_t cell, bool *tiles, bool *found, tn_way_stop *stop,
                                tn_error *error)
{
    const tn_form_record *form = d->house->form->record;
    tn_status status = TN_OK;
    for (uint32_t t = form->tile_first; status == TN_OK && !*found && t < form->tile_first + form->tile_count; t++) {
        tn_tile_failure failure;
        if (!tn_tile_is_for(d->house, cell, t))
            continue;
        *tiles = true;
        status = tn_tile_fails(d->house, cell, t, &failure, error);
        *found = status == TN_OK && tn_tile_failure_stops(&failure);
        if (*found)
            status = tn_tile_stop(d->house, cell, t, &failure, stop, error);
    }
    return status;
}

/* Of a house whose functions and faces are known. */
static tn_status find_stop(const drawing *d, uint32_t cell, bool *found, tn_way_stop *stop, tn_error *error)
{
    tn_way_fault fault;
    bool tiles = false;
    *found = false;
    tn_status status = find_tile_stop(d, cell, &tiles, found, stop, error);
    if (status != TN_OK || tiles)
        return status;
    status = tn_cell_ways(d->house, cell, &fault, error);
    *found = status == TN_OK && !fault.flight && fault.fault != TN_FLOOR_FITS;
    return *found ? tn_cell_stop(d->house, cell, stop, error) : status;
}

/* Where a flight comes nearest to a place. *found: the cell begins a stack in which one stands nowhere. */
static tn_status light_flight(drawing *d, uint32_t cell, bool *found, tn_error *error)
{
    tn_way_fault fault;
    tn_flight_stop stop = {0};
    tn_status status = tn_cell_ways(d->house, cell, &fault, error);
    *found = status == TN_OK && fault.flight;
    if (!*found)
        return status;
    status = tn_stack_stop(d->house, cell, &stop, error);
    if (status == TN_OK)
        status = light_stop(d, stop.cell, &stop.way, error);
    tn_way_stop_clear(&stop.way);
    return status;
}

static tn_status light_bare(drawing *d, const char *name, bool of_house, tn_error *error)
{
    uint32_t cell = named_cell(d, name);
    bool found = false;
    tn_way_stop stop = {0};
    if (cell == TN_NO_CELL)
        return TN_OK;
    tn_status status = of_house ? light_flight(d, cell, &found, error) : TN_OK;
    if (status != TN_OK || found)
        return status;
    if (of_house)
        status = find_stop(d, cell, &found, &stop, error);
    if (status == TN_OK)
        status = found ? light_stop(d, cell, &stop, error) : light_cell(d, cell, TN_LIT_FAULT, error);
    tn_way_stop_clear(&stop);
    return status;
}

static tn_status light_named_face(drawing *d, const char *name, tn_error *error)
{
    char text[256];
    for (uint32_t i = 0; i < d->house->face_count; i++) {
        tn_face_text(d->house, i, text, sizeof text);
        if (strcmp(text, name) == 0)
            return light_face(d, i, error);
    }
    return TN_OK;
}

/* ---- reasons */

/* What the questions of a clause find, in words and on the plans. */
static tn_status add_found(drawing *d, tn_house_explaining *e, uint32_t function, const tn_asked_of_house *questions,
                           size_t count, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_buffer line = {0};
        tn_explained_question_said(&questions[i], &line);
        status = add_line(d, &line, error);
    }
    if (status != TN_OK || function == TN_NO_RECORD)
        return status;
    return tn_house_rules_witness(e->judge.rules, function, see_found, d, error);
}

static tn_status add_bare(drawing *d, const tn_bare_cell *cell, bool of_house, tn_error *error)
{
    tn_buffer heading = {0};
    tn_explained_bare_said(cell, of_house, &heading);
    tn_status status = add_reason(d, &heading, false, error);
    for (size_t i = 0; status == TN_OK && i < cell->tiles.count; i++) {
        tn_buffer line = {0};
        tn_explained_tile_said(&cell->tiles.items[i], &line);
        status = add_line(d, &line, error);
    }
    return status == TN_OK ? light_bare(d, cell->cell, of_house, error) : status;
}

static tn_status add_covered(drawing *d, const tn_explained_house *explained, tn_error *error)
{
    tn_buffer heading = {0};
    tn_buffer_printf(&heading, "behind lower roofs");
    tn_status status = add_reason(d, &heading, true, error);
    for (size_t i = 0; status == TN_OK && i < explained->behind_roofs.count; i++) {
        tn_buffer line = {0};
        tn_explained_covered_said(&explained->behind_roofs.items[i], &line);
        status = add_line(d, &line, error);
        if (status == TN_OK)
            status = light_named_face(d, explained->behind_roofs.items[i].face, error);
    }
    return status;
}

static tn_status add_clauses(drawing *d, tn_house_explaining *e, const tn_explained_house *explained, bool full,
                             tn_error *error)
{
    tn_house_clause *clauses = NULL;
    size_t count = 0;
    tn_status status = tn_house_judge_clauses(&e->judge, e->library, &e->house, &clauses, &count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const tn_explained_house_clause *clause = &explained->clauses.items[i];
        tn_buffer heading = {0};
        if (!full && !clause->drops)
            continue;
        tn_explained_clause_said(clause, &heading);
        status = add_reason(d, &heading, !clause->drops, error);
        if (status == TN_OK)
            status = add_found(d, e, clauses[i].function, clause->why.items, clause->why.count, error);
    }
    free(clauses);
    return status;
}

static tn_status add_of_library(drawing *d, tn_house_explaining *e, const tn_explained_house *explained, bool full,
                                tn_error *error)
{
    tn_status status = add_clauses(d, e, explained, full, error);
    for (size_t i = 0; status == TN_OK && i < explained->bare.count; i++)
        status = add_bare(d, &explained->bare.items[i], true, error);
    if (status == TN_OK && full && explained->behind_roofs.count > 0)
        status = add_covered(d, explained, error);
    return status;
}

static tn_status add_of_rules(drawing *d, tn_house_explaining *e, const tn_explained_house_by_rules *explained,
                              tn_error *error)
{
    const tn_module *module = e->judge.module;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < explained->rules.count; i++) {
        const tn_explained_house_rule *rule = &explained->rules.items[i];
        uint32_t record = tn_house_rule_find(module, rule->name);
        tn_buffer heading = {0};
        tn_explained_rule_said(rule, &heading);
        status = add_reason(d, &heading, rule->matches, error);
        if (status == TN_OK)
            status = add_found(d, e, module->HOUSE_RULE_records[record].holds, rule->why.items, rule->why.count, error);
    }
    return status;
}

/* ---- drawn */

static tn_status draw_reasons(const drawing *d, tn_lit_house *what, tn_picture *to, tn_error *error)
{
    tn_solids solids = {0};
    tn_lit_reason *reasons = calloc(d->count + 1, sizeof *reasons);
    tn_status status = reasons ? tn_house_solids(d->house, &solids, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < d->count; i++) {
        const drawn_reason *r = &d->reasons[i];
        reasons[i] = (tn_lit_reason){r->heading,     r->good, (const char *const *)r->lines.items,
                                     r->lines.count, r->lits, r->lit_count};
    }
    what->house = d->house;
    what->solids = &solids;
    what->reasons = reasons;
    what->reason_count = d->count;
    if (status == TN_OK)
        status = tn_lit_house_draw(what, to, error);
    tn_solids_clear(&solids);
    free(reasons);
    return status;
}

static tn_status give(tn_session *session, const tn_explain_request *request, const drawing *d, tn_buffer *title,
                      const char *said, tn_status status, tn_error *error, tn_list *files, bool *has)
{
    tn_picture to = tn_answer_picture_begin(&request->drawn);
    take_quotes(title);
    tn_lit_house what = {.title = title->data, .said = said};
    to.watch = session->opened->module->watch;
    if (status == TN_OK && title->failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = draw_reasons(d, &what, &to, error);
    free(title->data);
    return tn_answer_picture_give(session, &request->drawn, &to, status, error, files, has);
}

tn_status tn_explain_house_draw(tn_house_explaining *e, const tn_explain_request *request, tn_reply *answer)
{
    tn_explained_house *by_library = TN_REPLY(explained_house, answer);
    tn_explained_house_by_rules *by_rules = TN_REPLY(explained_house_by_rules, answer);
    drawing d = {.house = &e->house};
    tn_buffer title = {0};
    tn_error error = {0};
    tn_status status = tn_house_rooms(&e->house, &d.rooms, &error);
    if (by_library)
        tn_buffer_printf(&title, "`%s` %s this house", by_library->library, by_library->kept ? "keeps" : "drops");
    else
        tn_buffer_printf(&title, "what rules say of this house");
    if (status == TN_OK)
        status = by_library ? add_of_library(&d, e, by_library, request->full, &error)
                            : add_of_rules(&d, e, by_rules, &error);
    status = give(e->session, request, &d, &title, by_library ? by_library->house : by_rules->house, status, &error,
                  by_library ? (tn_list *)&by_library->files : (tn_list *)&by_rules->files,
                  by_library ? &by_library->has_files : &by_rules->has_files);
    clear_drawing(&d);
    return status;
}

/* The plan stands up without functions, between plain walls. */
static tn_status stand_up(const tn_bare_cells *bare, tn_house *house, tn_error *error)
{
    const tn_house *found = &bare->house;
    if (found->form)
        return tn_house_stand(found->form, found->trays, found->length, found->shapes, house, error);
    tn_status status = tn_fail(error, TN_INVALID, E_BAD_HOUSE, "there is nothing to draw: the form has no house");
    tn_error_help(error, "its `forbid` lines forbid all combinations of options; leave out -o to read that");
    return status;
}

tn_status tn_explain_cells_draw(tn_session *session, const tn_explain_request *request, const tn_bare_cells *bare,
                                tn_reply *answer)
{
    tn_explained_cells *explained = answer->value;
    tn_house house = {0};
    tn_buffer title = {0}, plan = {0};
    tn_error error = {0};
    drawing d = {.house = &house};
    tn_status status = stand_up(bare, &house, &error);
    tn_explained_cells_said(explained, &title);
    if (status == TN_OK && !tn_plan_write_line(house.form->schema, house.trays, house.length, &plan))
        status = tn_fail_memory(&error);
    for (size_t i = 0; status == TN_OK && i < explained->bare.count; i++)
        status = add_bare(&d, &explained->bare.items[i], false, &error);
    status = give(session, request, &d, &title, plan.data, status, &error, (tn_list *)&explained->files,
                  &explained->has_files);
    free(plan.data);
    clear_drawing(&d);
    tn_house_clear(&house);
    return status;
}
