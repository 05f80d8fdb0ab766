/* Finds the faces whose kinds clauses can tell apart, by deciding on rooms of which only one cell is known. */
#include "runtime/house/variant/relevant.h"

#include <stdlib.h>

#include "runtime/house/rule/outcome.h"

void tn_room_questions_clear(tn_room_questions *questions)
{
    free(questions->functions);
    *questions = (tn_room_questions){0};
}

static bool asks_for_faces(const tn_module *module, uint32_t function)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    for (uint32_t at = f->code_begin; at < f->code_end;) {
        tn_instruction op = tn_code_read(module->code, at);
        if (op.opcode == TN_OP_HAS_FACE || op.opcode == TN_OP_ROOM_GLAZING)
            return true;
        at += op.length;
    }
    return false;
}

tn_status tn_room_questions_find(const tn_module *module, tn_room_questions *questions, tn_error *error)
{
    *questions = (tn_room_questions){.functions = malloc((module->FUNCTION_count + 1) * sizeof(uint32_t))};
    if (!questions->functions)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < module->FUNCTION_count; f++)
        if (module->FUNCTION_records[f].kind == TN_FUNCTION_ROOM && asks_for_faces(module, f))
            questions->functions[questions->count++] = f;
    return TN_OK;
}

typedef struct tn_known_cell {
    const tn_house *house;
    const tn_cell *cell;
} tn_known_cell;

/* Of a room that has this cell, and perhaps others. */
static tn_outcome ask(const void *context, const tn_instruction *op)
{
    const tn_known_cell *known = context;
    if (op->opcode == TN_OP_EVERY)
        return TN_OUTCOME_TRUE;
    if (op->opcode == TN_OP_ALL_CELLS && !tn_house_decide(known->house, (uint32_t)op->first, known->cell))
        return TN_OUTCOME_FALSE;
    return TN_OUTCOME_OPEN;
}

/* A void has no function: it belongs to the room of the first cell below it that is none. */
static const tn_cell *floor_below(const tn_cell *cell)
{
    while (cell->open) /* the cells of a stack follow one another upwards, and the lowest is no void */
        cell--;
    return cell;
}

bool tn_face_relevant(const tn_house *house, const tn_room_questions *questions, const tn_face *face)
{
    if (face->relation != TN_FACE_OUTSIDE)
        return true;
    const tn_cell *cell = floor_below(&house->cells[face->first]);
    tn_known_cell known = {house, cell};
    for (size_t i = 0; i < questions->count; i++)
        if (tn_outcome_decide(house->form->module, questions->functions[i], ask, &known) == TN_OUTCOME_OPEN)
            return true;
    return false;
}
