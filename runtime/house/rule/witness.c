/* Finds what a rule's questions of a house rest on, by asking them of each cell, room and face. */
#include "runtime/house/rule/witness.h"

#include <stdlib.h>

#include "runtime/house/form/form.h"
#include "runtime/house/house.h"
#include "runtime/house/rule/asked_data.h"
#include "runtime/module/code.h"

typedef struct witnessing {
    tn_house_rules *rules;
    tn_witness_seen *seen;
    void *context;
    bool *entered; /* [function] */
} witnessing;

static tn_status see_cells(const witnessing *w, tn_witness found, uint32_t decides, tn_error *error)
{
    const tn_house *house = w->rules->house;
    tn_status status = TN_OK;
    for (found.first = 0; status == TN_OK && found.first < house->cell_count; found.first++)
        if (tn_house_decide(house, decides, &house->cells[found.first]))
            status = w->seen(w->context, &found, error);
    return status;
}

static tn_status see_rooms(const witnessing *w, tn_witness found, uint32_t decides, tn_error *error)
{
    tn_status status = tn_rooms_gather(w->rules, error);
    for (size_t r = 0; status == TN_OK && r < w->rules->room_count; r++) {
        found.first = w->rules->rooms[r].room;
        if (tn_room_decide(w->rules, decides, &w->rules->rooms[r]))
            status = w->seen(w->context, &found, error);
    }
    return status;
}

static tn_status see_meetings(const witnessing *w, tn_witness found, const tn_meeting_record *meeting, tn_error *error)
{
    const tn_house *house = w->rules->house;
    tn_status status = TN_OK;
    for (found.face = 0; status == TN_OK && found.face < house->face_count; found.face++) {
        found.first = house->faces[found.face].first;
        if (tn_face_meets(house, meeting, &house->faces[found.face]))
            status = w->seen(w->context, &found, error);
    }
    return status;
}

static tn_status see_walks(const witnessing *w, tn_witness found, const tn_meeting_record *walk, tn_error *error)
{
    const tn_house *house = w->rules->house;
    tn_status status = TN_OK;
    found.reached = w->rules->seen;
    for (found.first = 0; status == TN_OK && found.first < house->cell_count; found.first++) {
        const tn_cell *cell = &house->cells[found.first];
        if (!cell->open && tn_house_decide(house, walk->first, cell) && tn_cell_apart(w->rules, walk, found.first))
            status = w->seen(w->context, &found, error);
    }
    return status;
}

/* The cell that a term's number is of, with its walk. */
static tn_status see_walked(const witnessing *w, tn_witness found, tn_error *error)
{
    tn_walked walked;
    tn_walk_line *lines = NULL;
    tn_status status = tn_house_walked(w->rules, found.term, &walked, error);
    if (status != TN_OK || walked.cell == TN_NO_CELL)
        return status;
    found.first = walked.cell;
    found.number = walked.worth == TN_HAS_WORTH ? walked.number : TN_NO_PATH;
    if (tn_house_term_walks(found.term->kind))
        status = tn_house_walk_lines(w->rules, found.term, found.first, &lines, &found.line_count, error);
    found.lines = lines;
    if (status == TN_OK)
        status = w->seen(w->context, &found, error);
    free(lines);
    return status;
}

static tn_status see_terms(const witnessing *w, tn_witness found, uint32_t sum, tn_error *error)
{
    const tn_module *module = w->rules->house->form->module;
    const tn_house_sum_record *record = &module->HOUSE_SUM_records[sum];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < record->term_count; i++) {
        found.term = &module->HOUSE_TERM_records[record->term_first + i];
        if (tn_house_term_of_floors(found.term->kind))
            status = see_walked(w, found, error);
    }
    return status;
}

static tn_status see_question(const witnessing *w, const tn_instruction *op, uint32_t offset, tn_error *error)
{
    const tn_module *module = w->rules->house->form->module;
    uint32_t first = (uint32_t)op->first;
    tn_witness found = {.opcode = op->opcode, .offset = offset, .first = TN_NO_CELL};
    tn_status status = w->seen(w->context, &found, error);
    if (status != TN_OK)
        return status;
    switch (op->opcode) {
    case TN_OP_SOME_CELL:
    case TN_OP_CELLS:
    case TN_OP_AREAS:
        return see_cells(w, found, first, error);
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        return see_rooms(w, found, first, error);
    case TN_OP_MEETS:
        return see_meetings(w, found, &module->MEETING_records[first], error);
    case TN_OP_APART:
        return see_walks(w, found, &module->MEETING_records[first], error);
    default:
        return tn_code_compares_house((tn_opcode)op->opcode) ? see_terms(w, found, first, error) : TN_OK;
    }
}

/* Recursion is as deep as functions call each other: each calls lower ones only, and is entered once. */
static tn_status enter(witnessing *w, uint32_t function, tn_error *error)
{
    const tn_module *module = w->rules->house->form->module;
    const tn_function_record *record = &module->FUNCTION_records[function];
    tn_status status = TN_OK;
    if (w->entered[function])
        return TN_OK;
    w->entered[function] = true;
    for (uint32_t at = record->code_begin; status == TN_OK && at < record->code_end;) {
        tn_instruction op = tn_code_read(module->code, at);
        if (tn_code_asks_house(op.opcode) && op.opcode != TN_OP_SECTION_IS)
            status = see_question(w, &op, at, error);
        else if (tn_code_operands((uint8_t)op.opcode) == TN_OPERANDS_FUNC)
            status = enter(w, (uint32_t)op.first, error);
        at += op.length;
    }
    return status;
}

tn_status tn_house_rules_witness(tn_house_rules *rules, uint32_t function, tn_witness_seen *seen, void *context,
                                 tn_error *error)
{
    witnessing w = {rules, seen, context, calloc(function + (size_t)1, sizeof *w.entered)};
    if (!w.entered)
        return tn_fail_memory(error);
    tn_status status = enter(&w, function, error);
    free(w.entered);
    return status;
}
