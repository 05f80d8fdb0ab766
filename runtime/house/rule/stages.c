/* Finds when clauses of a library of houses can be asked, by what their functions name. */
#include "runtime/house/rule/stages.h"

#include <stdlib.h>

#include "runtime/house/form/form.h"

static tn_clause_stage later(tn_clause_stage a, tn_clause_stage b)
{
    return a > b ? a : b;
}

static tn_clause_stage of_sum(const tn_module *module, uint32_t index, const tn_clause_stage *known)
{
    const tn_sum_record *sum = &module->SUM_records[index];
    tn_clause_stage stage = TN_STAGE_SECTION;
    for (uint32_t i = 0; i < sum->term_count; i++)
        stage = later(stage, known[module->TERM_records[sum->term_first + i].part]);
    return stage;
}

static tn_clause_stage of_house_sum(const tn_module *module, uint32_t index, const tn_clause_stage *known)
{
    const tn_house_sum_record *sum = &module->HOUSE_SUM_records[index];
    tn_clause_stage stage = of_sum(module, sum->sum, known);
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_house_term_record *term = &module->HOUSE_TERM_records[sum->term_first + i];
        bool tiles = term->kind == TN_HOUSE_COST || tn_house_term_of_floors(term->kind);
        stage = later(stage, tiles                          ? TN_STAGE_TILES
                             : term->kind == TN_HOUSE_ROOMS ? TN_STAGE_FACES
                                                            : known[term->part]);
    }
    return stage;
}

/* The latest of the functions that an instruction names; they are lower, and so known. */
static tn_clause_stage of_operands(const tn_module *module, const tn_instruction *op, const tn_clause_stage *known)
{
    switch (tn_code_operands((uint8_t)op->opcode)) {
    case TN_OPERANDS_FUNC:
    case TN_OPERANDS_DECISION:
    case TN_OPERANDS_DECISION_COND:
        return known[op->first];
    case TN_OPERANDS_SUMMED:
        return of_sum(module, (uint32_t)op->first, known);
    case TN_OPERANDS_HOUSE_SUMMED:
        return of_house_sum(module, (uint32_t)op->first, known);
    default:
        return TN_STAGE_SECTION;
    }
}

static tn_clause_stage of_instruction(const tn_module *module, const tn_instruction *op, const tn_clause_stage *known)
{
    switch (op->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
    case TN_OP_MEETS:
    case TN_OP_APART:
        return TN_STAGE_FACES;
    case TN_OP_IS_FOR:
        return TN_STAGE_FUNCTIONS;
    default:
        return of_operands(module, op, known);
    }
}

tn_status tn_clause_stages(const tn_house_form *form, const tn_house_library_record *library, tn_clause_stage *stages,
                           tn_error *error)
{
    const tn_module *module = form->module;
    tn_clause_stage *known = calloc(module->FUNCTION_count + 1, sizeof *known);
    if (!known)
        return tn_fail_memory(error);
    for (size_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        tn_code_kind code = tn_function_kinds[function->kind].code;
        for (uint32_t at = function->code_begin;
             (code == TN_CODE_RULE || code == TN_CODE_HOUSE) && at < function->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            known[f] = later(known[f], of_instruction(module, &op, known));
            at += op.length;
        }
    }
    for (uint32_t i = 0; i < library->clause_count; i++)
        stages[i] = known[module->HOUSE_CLAUSE_records[library->clause_first + i].holds];
    free(known);
    return TN_OK;
}

/* ---- terms that are asked for */

static bool has_term(const tn_module *module, uint32_t first, uint32_t count, tn_term_asked *asked)
{
    for (uint32_t i = 0; i < count; i++)
        if (asked(module->HOUSE_TERM_records[first + i].kind))
            return true;
    return false;
}

bool tn_measure_walks(const tn_module *module, const tn_house_measured *measure)
{
    return has_term(module, measure->term_first, measure->term_count, tn_house_term_of_floors);
}

/* Itself, or by a function that it calls, which is lower, and so known. */
static bool asks(const tn_module *module, const tn_instruction *op, tn_term_asked *asked, const bool *known)
{
    const tn_house_sum_record *sums = module->HOUSE_SUM_records;
    switch (tn_code_operands((uint8_t)op->opcode)) {
    case TN_OPERANDS_FUNC:
        return known[op->first];
    case TN_OPERANDS_HOUSE_SUMMED:
        return has_term(module, sums[op->first].term_first, sums[op->first].term_count, asked);
    default:
        return false;
    }
}

tn_status tn_functions_asking(const tn_module *module, tn_term_asked *asked, bool **functions, tn_error *error)
{
    bool *known = *functions = calloc(module->FUNCTION_count + 1, sizeof *known);
    if (!known)
        return tn_fail_memory(error);
    for (size_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        bool rule = tn_function_kinds[function->kind].code == TN_CODE_RULE;
        for (uint32_t at = function->code_begin; rule && at < function->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            known[f] = known[f] || asks(module, &op, asked, known);
            at += op.length;
        }
    }
    return TN_OK;
}

tn_status tn_functions_walking(const tn_module *module, bool **functions, tn_error *error)
{
    return tn_functions_asking(module, tn_house_term_of_floors, functions, error);
}

tn_status tn_clauses_asking(const tn_house_form *form, const tn_house_library_record *library, tn_term_asked *asked,
                            bool *clauses, tn_error *error)
{
    const tn_module *module = form->module;
    bool *known;
    tn_status status = tn_functions_asking(module, asked, &known, error);
    for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++)
        clauses[i] = known[module->HOUSE_CLAUSE_records[library->clause_first + i].holds];
    free(known);
    return status;
}

tn_status tn_clauses_walking(const tn_house_form *form, const tn_house_library_record *library, bool *clauses,
                             tn_error *error)
{
    return tn_clauses_asking(form, library, tn_house_term_of_floors, clauses, error);
}

tn_status tn_clauses_not_walking(const tn_house_form *form, const tn_house_library_record *library,
                                 tn_house_clause_record **clauses, uint32_t *count, tn_error *error)
{
    const tn_house_clause_record *own = form->module->HOUSE_CLAUSE_records + library->clause_first;
    bool *walks = calloc((size_t)library->clause_count + 1, sizeof *walks);
    *clauses = malloc(((size_t)library->clause_count + 1) * sizeof **clauses);
    *count = 0;
    tn_status status = walks && *clauses ? tn_clauses_walking(form, library, walks, error) : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++)
        if (!walks[i])
            (*clauses)[(*count)++] = own[i];
    free(walks);
    return status;
}

/* ---- functions that are named */

static void mark_sum(const tn_module *module, uint32_t index, bool *reached)
{
    const tn_sum_record *sum = &module->SUM_records[index];
    for (uint32_t i = 0; i < sum->term_count; i++)
        reached[module->TERM_records[sum->term_first + i].part] = true;
}

static void mark_walk(const tn_meeting_record *walk, bool *reached)
{
    const uint32_t functions[] = {walk->first, walk->second, walk->through};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (functions[i] != TN_NO_RECORD)
            reached[functions[i]] = true;
}

void tn_mark_operands(const tn_module *module, const tn_instruction *op, bool *reached)
{
    switch (tn_code_operands((uint8_t)op->opcode)) {
    case TN_OPERANDS_FUNC:
    case TN_OPERANDS_DECISION:
    case TN_OPERANDS_DECISION_COND:
        reached[op->first] = true;
        return;
    case TN_OPERANDS_SUMMED:
        mark_sum(module, (uint32_t)op->first, reached);
        return;
    case TN_OPERANDS_HOUSE_SUMMED: {
        const tn_house_sum_record *sum = &module->HOUSE_SUM_records[op->first];
        mark_sum(module, sum->sum, reached);
        for (uint32_t i = 0; i < sum->term_count; i++) {
            const tn_house_term_record *term = &module->HOUSE_TERM_records[sum->term_first + i];
            if (term->part != TN_NO_RECORD)
                reached[term->part] = true;
            if (term->walk != TN_NO_RECORD)
                mark_walk(&module->MEETING_records[term->walk], reached);
        }
        return;
    }
    default:
        return;
    }
}
