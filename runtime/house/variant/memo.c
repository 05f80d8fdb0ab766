/* Keeps the answers of clauses by the classes of functions that they can tell apart. */
#include "runtime/house/variant/memo.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

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
