/* Runs the code of expressions on a stack of numbers, or of rows of numbers; and verifies it when a module is loaded.
 */
#include "runtime/number/run.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"
#include "runtime/number/operation.h"

/* ==== runs the code of expressions on a stack of numbers, or of rows of numbers */

/* What the code of a function can speak of. */
typedef struct scope {
    const double *terms; /* or coordinates */
    const tn_distances *distances;
    double *kept;
} scope;

/* Runs one instruction that is no operation; returns the stack's new height. */
static size_t run_other(const scope *given, const tn_instruction *i, double *stack, size_t height)
{
    switch (i->opcode) {
    case TN_OP_NUMBER:
        stack[height] = tn_double_of((uint64_t)i->first);
        return height + 1;
    case TN_OP_TERM:
    case TN_OP_COORDINATE:
        stack[height] = given->terms[i->first];
        return height + 1;
    case TN_OP_KEPT:
        stack[height] = given->kept[i->first];
        return height + 1;
    case TN_OP_KEEP:
        given->kept[i->first] = stack[height - 1];
        return height - 1;
    default: /* TN_OP_MESH_DISTANCE */
        height -= 3;
        stack[height] = given->distances->measure(given->distances->meshes, (uint32_t)i->first, stack + height, NULL);
        return height + 1;
    }
}

static bool is_operation(tn_opcode opcode)
{
    return opcode != TN_OP_NUMBER && opcode != TN_OP_TERM && opcode != TN_OP_COORDINATE && opcode != TN_OP_KEEP &&
           opcode != TN_OP_KEPT && opcode != TN_OP_MESH_DISTANCE;
}

static double run(const uint8_t *code, uint32_t offset, const scope *given)
{
    double stack[TN_MEASURE_STACK_MAX];
    size_t height = 0;
    for (;;) {
        tn_instruction i = tn_code_read(code, offset);
        offset += i.length;
        if (i.opcode == TN_OP_VALUE)
            return stack[0];
        if (!is_operation(i.opcode)) {
            height = run_other(given, &i, stack, height);
            continue;
        }
        height -= tn_code_effect((uint8_t)i.opcode).pops;
        stack[height] = tn_operation_apply(i.opcode, stack + height);
        height++;
    }
}

double tn_number_run(const uint8_t *code, uint32_t offset, const double *terms)
{
    return run(code, offset, &(scope){.terms = terms});
}

tn_interval tn_number_bounds(const uint8_t *code, uint32_t offset, const tn_interval *terms)
{
    tn_interval stack[TN_MEASURE_STACK_MAX];
    size_t height = 0;
    for (;;) {
        tn_instruction i = tn_code_read(code, offset);
        offset += i.length;
        if (i.opcode == TN_OP_VALUE)
            return stack[0];
        if (i.opcode == TN_OP_NUMBER) {
            stack[height++] = tn_interval_of(tn_double_of((uint64_t)i.first));
        } else if (i.opcode == TN_OP_TERM) {
            stack[height++] = terms[i.first];
        } else {
            height -= tn_code_effect((uint8_t)i.opcode).pops;
            const tn_interval *operands[] = {stack + height, stack + height + 1, stack + height + 2};
            stack[height] = tn_operation_bounds(i.opcode, operands);
            height++;
        }
    }
}

double tn_number_run_at(const uint8_t *code, uint32_t offset, const double point[3], const tn_distances *distances,
                        double *kept)
{
    return run(code, offset, &(scope){.terms = point, .distances = distances, .kept = kept});
}

uint32_t tn_number_kept(const uint8_t *code, uint32_t offset)
{
    uint32_t kept = 0;
    for (tn_instruction i = tn_code_read(code, offset); i.opcode != TN_OP_VALUE; i = tn_code_read(code, offset)) {
        kept += i.opcode == TN_OP_KEEP;
        offset += i.length;
    }
    return kept;
}

/* ---- by rows */

void tn_number_rows_clear(tn_number_rows *rows)
{
    free(rows->stack);
    free(rows->operands);
    *rows = (tn_number_rows){0};
}

static bool reserve(tn_number_rows *rows, size_t depth)
{
    if (depth <= rows->capacity)
        return true;
    if (!tn_array_resize(&rows->stack, 2 * depth, TN_ROW * sizeof *rows->stack) ||
        !tn_array_resize(&rows->operands, depth, sizeof *rows->operands))
        return false;
    rows->capacity = depth;
    return true;
}

static void fill(double *row, double number)
{
    for (size_t i = 0; i < TN_ROW; i++)
        row[i] = number;
}

/* One row of results, from rows of terms. An operation's result may be no row of its operands: results of one level of
 * the stack are written to that level's two rows in turn, and the operands above it are of other levels. */
static const double *run_row(const tn_number_rows *rows, const uint8_t *code, uint32_t offset,
                             const double *const *columns, size_t from)
{
    const double **operands = rows->operands;
    size_t height = 0;
    for (;;) {
        tn_instruction i = tn_code_read(code, offset);
        offset += i.length;
        if (i.opcode == TN_OP_VALUE)
            return operands[0];
        if (i.opcode == TN_OP_TERM) {
            operands[height++] = columns[i.first] + from;
            continue;
        }
        height -= tn_code_effect((uint8_t)i.opcode).pops;
        double *row = rows->stack + 2 * height * TN_ROW;
        const double **own = operands + height++;
        if (i.opcode == TN_OP_NUMBER) {
            fill(row, tn_double_of((uint64_t)i.first));
        } else {
            row = own[0] == row ? row + TN_ROW : row;
            tn_operation_row(i.opcode, own, row);
        }
        own[0] = row;
    }
}

tn_status tn_number_run_rows(tn_number_rows *rows, const uint8_t *code, uint32_t offset, size_t depth,
                             const double *const *columns, size_t count, double *values, tn_error *error)
{
    if (!reserve(rows, depth))
        return tn_fail_memory(error);
    for (size_t from = 0; from < count; from += TN_ROW) {
        size_t points = count - from < TN_ROW ? count - from : TN_ROW;
        memcpy(values + from, run_row(rows, code, offset, columns, from), points * sizeof *values);
    }
    return TN_OK;
}

uint64_t tn_number_asked(const tn_module *module, uint32_t function)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    uint64_t asked = 0;
    for (uint32_t offset = record->code_begin; offset < record->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        if (instruction.opcode == TN_OP_TERM)
            asked |= UINT64_C(1) << instruction.first;
        offset += instruction.length;
    }
    return asked;
}

/* ==== verifies the code of expressions: what they may hold at once, what they may speak of, and that a number is kept
 * before it is used */

static tn_status verify_function(const tn_checker *checker, uint32_t function)
{
    if (checker->module->FUNCTION_records[function].stack_max > TN_MEASURE_STACK_MAX)
        return tn_refuse(checker, "an expression's stack passes %u", TN_MEASURE_STACK_MAX);
    return TN_OK;
}

static tn_status check_term(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_engine *engine =
        tn_engine_of_terms(checker->engines, checker->module->FUNCTION_records[checker->record].kind);
    if (!engine || instruction->first >= engine->term_count)
        return tn_refuse(checker, "nothing of this number is measured");
    return TN_OK;
}

static void list_term(tn_lister *lister, const tn_instruction *instruction)
{
    const tn_engine *engine =
        tn_engine_of_terms(lister->engines, lister->module->FUNCTION_records[lister->function].kind);
    fputs(engine->terms[instruction->first], lister->out);
}

static tn_status check_axis(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->first < 3 ? TN_OK : tn_refuse(checker, "there are three coordinates");
}

static void list_axis(tn_lister *lister, const tn_instruction *instruction)
{
    fputc("xyz"[instruction->first], lister -> out);
}

/* Fields have places, other expressions have terms. Locals are numbered as they are kept. */
static tn_status verify_words(const tn_checker *checker, const tn_function_record *function)
{
    bool field = function->kind == TN_FUNCTION_FIELD;
    uint32_t kept = 0;
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction i = tn_code_read(checker->module->code, offset);
        bool place = i.opcode == TN_OP_COORDINATE || i.opcode == TN_OP_MESH_DISTANCE || i.opcode == TN_OP_KEEP ||
                     i.opcode == TN_OP_KEPT;
        if (field ? i.opcode == TN_OP_TERM : place)
            return tn_refuse(checker, field ? "a field has no terms" : "an expression has no coordinates");
        if (i.opcode == TN_OP_KEEP && i.first != kept++)
            return tn_refuse(checker, "a number is kept out of order");
        if (i.opcode == TN_OP_KEPT && i.first >= kept)
            return tn_refuse(checker, "a number is used that was not kept");
        offset += i.length;
    }
    return TN_OK;
}

static tn_status verify_after(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_status status = TN_OK;
    for (size_t i = 0; i < module->FUNCTION_count && status == TN_OK; i++) {
        const tn_function_record *function = &module->FUNCTION_records[i];
        if (tn_function_kinds[function->kind].code == TN_CODE_MEASURE)
            status = verify_words(checker, function);
    }
    return status;
}

static const tn_operand_rules operands[] = {{TN_OPERANDS_TERM, check_term, list_term},
                                            {TN_OPERANDS_AXIS, check_axis, list_axis}};

extern const tn_engine tn_engine_number;
const tn_engine tn_engine_number = {.name = "number",
                                    .codes = 1u << TN_CODE_MEASURE,
                                    .operands = operands,
                                    .operand_count = sizeof operands / sizeof *operands,
                                    .verify_function = verify_function,
                                    .verify_after = verify_after};
