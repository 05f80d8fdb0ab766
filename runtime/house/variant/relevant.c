/* Finds the faces whose kinds clauses can tell apart, by deciding on rooms of which only one cell is known. */
#include "runtime/house/variant/relevant.h"

#include <stdlib.h>

#include "runtime/module/code.h"

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

/* What is known of a decision: nothing, or its outcome. */
typedef enum tn_outcome { OUTCOME_FALSE, OUTCOME_TRUE, OUTCOME_OPEN } tn_outcome;

static tn_outcome both(tn_outcome a, tn_outcome b)
{
    if (a == OUTCOME_FALSE || b == OUTCOME_FALSE)
        return OUTCOME_FALSE;
    return a == OUTCOME_TRUE && b == OUTCOME_TRUE ? OUTCOME_TRUE : OUTCOME_OPEN;
}

static tn_outcome denied(tn_outcome a)
{
    return a == OUTCOME_OPEN ? OUTCOME_OPEN : a == OUTCOME_TRUE ? OUTCOME_FALSE : OUTCOME_TRUE;
}

/* Of a room that has this cell, and perhaps others. */
static tn_outcome ask(const tn_house *house, const tn_cell *cell, const tn_instruction *op)
{
    if (op->opcode == TN_OP_EVERY)
        return OUTCOME_TRUE;
    if (op->opcode == TN_OP_ALL_CELLS && !tn_house_decide(house, (uint32_t)op->first, cell))
        return OUTCOME_FALSE;
    return OUTCOME_OPEN;
}

static tn_outcome decide(const tn_house *house, uint32_t function, const tn_cell *cell)
{
    const tn_module *module = house->form->module;
    tn_outcome stack[TN_DECISION_STACK_MAX];
    size_t depth = 0;
    for (uint32_t at = module->FUNCTION_records[function].code_begin;;) {
        tn_instruction op = tn_code_read(module->code, at);
        at += op.length;
        switch (op.opcode) {
        case TN_OP_ALL_OF:
            depth--;
            stack[depth - 1] = both(stack[depth - 1], stack[depth]);
            break;
        case TN_OP_ONE_OF:
            depth--;
            stack[depth - 1] = denied(both(denied(stack[depth - 1]), denied(stack[depth])));
            break;
        case TN_OP_NONE_OF:
            stack[depth - 1] = denied(stack[depth - 1]);
            break;
        case TN_OP_DECIDE:
            return stack[depth - 1];
        default:
            stack[depth++] = ask(house, cell, &op);
        }
    }
}

/* A void belongs to the room of the cell below: its function is not asked for, so the room is open. */
bool tn_face_relevant(const tn_house *house, const tn_room_questions *questions, const tn_face *face)
{
    const tn_cell *cell = &house->cells[face->first];
    if (face->relation != TN_FACE_OUTSIDE || cell->open)
        return true;
    for (size_t i = 0; i < questions->count; i++)
        if (decide(house, questions->functions[i], cell) == OUTCOME_OPEN)
            return true;
    return false;
}
