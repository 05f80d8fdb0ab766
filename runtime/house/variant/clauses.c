/* What clauses ask of the houses on one plan: how much of a house has to be known for it, answers that are kept, and
 * which faces they can tell apart. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/rule/outcome.h"
#include "runtime/house/variant/parts.h"
#include "runtime/module/code.h"

/* ==== when a clause can be asked */

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
        stage = later(stage, term->kind == TN_HOUSE_COST    ? TN_STAGE_TILES
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

/* ==== answers to functions
 *
 * Keeps the answers of clauses by the classes of functions that they can tell apart. */

enum { QUESTIONS_MAX = 64 }; /* the bits of what they say of a function */

struct tn_clause_memo {
    bool asked;          /* with the functions, by questions that are not too many */
    uint32_t *questions; /* [question_count] functions of kind CELL that the clause reaches */
    size_t question_count;
    uint32_t *weights; /* [choice of a wheel] its class, times the number of combinations of the wheels before */
    size_t weight_room;
    uint8_t *answers; /* NULL where there are too many */
    size_t end;
};

static void forget_answers(struct tn_clause_memo *memo)
{
    free(memo->answers);
    memo->answers = NULL;
    memo->end = 0;
}

void tn_memos_free(tn_house_variants *v)
{
    for (uint32_t i = 0; v->memos && i < v->library->clause_count; i++) {
        forget_answers(&v->memos[i]);
        free(v->memos[i].questions);
        free(v->memos[i].weights);
    }
    free(v->memos);
    v->memos = NULL;
}

/* ---- what a clause asks */

static void mark_sum(const tn_module *module, uint32_t index, bool *reached)
{
    const tn_sum_record *sum = &module->SUM_records[index];
    for (uint32_t i = 0; i < sum->term_count; i++)
        reached[module->TERM_records[sum->term_first + i].part] = true;
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
        }
        return;
    }
    default:
        return;
    }
}

/* The functions of kind CELL that a clause reaches: those that its code names, all of them lower. False: too many. */
static bool find_questions(const tn_module *module, uint32_t holds, bool *reached, uint32_t questions[QUESTIONS_MAX],
                           size_t *count)
{
    memset(reached, 0, module->FUNCTION_count * sizeof *reached);
    reached[holds] = true;
    *count = 0;
    for (uint32_t f = holds + 1; f-- > 0;) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        if (!reached[f])
            continue;
        if (function->kind == TN_FUNCTION_CELL) {
            if (*count == QUESTIONS_MAX)
                return false;
            questions[(*count)++] = f;
        }
        for (uint32_t at = function->code_begin; at < function->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            tn_mark_operands(module, &op, reached);
            at += op.length;
        }
    }
    return true;
}

static tn_status begin_memo(tn_house_variants *v, uint32_t clause, bool *reached, tn_error *error)
{
    struct tn_clause_memo *memo = &v->memos[clause];
    uint32_t questions[QUESTIONS_MAX];
    uint32_t holds = v->form->module->HOUSE_CLAUSE_records[v->library->clause_first + clause].holds;
    memo->asked = v->stages[clause] == TN_STAGE_FUNCTIONS &&
                  find_questions(v->form->module, holds, reached, questions, &memo->question_count);
    if (!memo->asked)
        return TN_OK;
    memo->questions = malloc((memo->question_count + 1) * sizeof *memo->questions);
    if (!memo->questions)
        return tn_fail_memory(error);
    memcpy(memo->questions, questions, memo->question_count * sizeof *questions);
    return TN_OK;
}

tn_status tn_memos_begin(tn_house_variants *v, tn_error *error)
{
    bool *reached = malloc(v->form->module->FUNCTION_count + 1);
    v->memos = calloc((size_t)v->library->clause_count + 1, sizeof *v->memos);
    tn_status status = reached && v->memos ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < v->library->clause_count; i++)
        status = begin_memo(v, i, reached, error);
    free(reached);
    return status;
}

/* ---- classes */

static uint64_t seen_by(tn_house_variants *v, const struct tn_clause_memo *memo, uint32_t cell, uint32_t function)
{
    uint64_t bits = 0;
    v->house.cells[cell].function = function;
    for (size_t q = 0; q < memo->question_count; q++)
        bits |= (uint64_t)tn_house_decide(&v->house, memo->questions[q], &v->house.cells[cell]) << q;
    return bits;
}

/* The classes of a wheel's functions, in the order in which they come. Returns how many. */
static uint32_t classify(tn_house_variants *v, struct tn_clause_memo *memo, const tn_wheel *w)
{
    uint64_t known[TN_CELL_RULES_MAX];
    uint32_t found = 0;
    for (uint32_t k = 0; k < w->count; k++) {
        uint64_t bits = seen_by(v, memo, w->of, v->functions.choices[w->first + k]);
        uint32_t class = 0;
        while (class < found && known[class] != bits)
            class ++;
        known[class] = bits;
        found += class == found;
        memo->weights[w->first + k] = class;
    }
    return found;
}

static tn_status make_memo(tn_house_variants *v, struct tn_clause_memo *memo, tn_error *error)
{
    size_t size = 1;
    forget_answers(memo);
    if (!tn_array_reserve(&memo->weights, &memo->weight_room, 0, v->functions.choice_count + 1, sizeof *memo->weights))
        return tn_fail_memory(error);
    for (size_t i = 0; i < v->functions.count && size <= TN_MEMO_ANSWERS_MAX; i++) {
        const tn_wheel *w = &v->functions.items[i];
        uint32_t classes = classify(v, memo, w);
        for (uint32_t k = 0; k < w->count; k++)
            memo->weights[w->first + k] *= (uint32_t)size;
        size *= classes;
        memo->end = classes > 1 ? i + 1 : memo->end;
    }
    if (size > TN_MEMO_ANSWERS_MAX)
        return TN_OK;
    memo->answers = calloc(size, sizeof *memo->answers);
    return memo->answers ? TN_OK : tn_fail_memory(error);
}

tn_status tn_memos_make(tn_house_variants *v, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < v->library->clause_count; i++)
        if (v->memos[i].asked)
            status = make_memo(v, &v->memos[i], error);
    return status;
}

/* ---- answers */

uint8_t *tn_memo_answer(const tn_house_variants *v, uint32_t clause)
{
    const struct tn_clause_memo *memo = v->memos ? &v->memos[clause] : NULL;
    if (!memo || !memo->answers)
        return NULL;
    size_t at = 0;
    for (size_t i = 0; i < v->functions.count; i++)
        at += memo->weights[v->functions.items[i].first + v->functions.items[i].at];
    return &memo->answers[at];
}

size_t tn_memo_end(const tn_house_variants *v, uint32_t clause)
{
    return v->memos[clause].end;
}

/* ==== faces
 *
 * Finds the faces whose kinds clauses can tell apart, by deciding on rooms of which only one cell is known. */

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
