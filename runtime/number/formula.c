/* Makes the code of an expression, instruction by instruction, and folds its constants. */
#include "runtime/number/formula.h"

#include <math.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/module/code.h"

enum { NUMBER_SIZE = 9, INDEX_SIZE = 5, PLAIN_SIZE = 1 }; /* bytes of an instruction: opcodes.def */

void tn_formula_clear(tn_formula *formula)
{
    free(formula->code);
    *formula = (tn_formula){0};
}

void tn_formula_begin(tn_formula *formula)
{
    *formula = (tn_formula){.code = formula->code, .capacity = formula->capacity};
}

/* Room for an instruction, with its opcode in place; NULL where out of memory. */
static uint8_t *append(tn_formula *formula, tn_opcode opcode, size_t size)
{
    formula->failed = formula->failed || !tn_array_reserve(&formula->code, &formula->capacity, formula->size, size, 1);
    if (formula->failed)
        return NULL;
    uint8_t *place = formula->code + formula->size;
    *place = (uint8_t)opcode;
    formula->size += size;
    return place + 1;
}

static void push(tn_formula *formula)
{
    formula->height++;
    formula->depth = formula->height > formula->depth ? formula->height : formula->depth;
}

void tn_formula_number(tn_formula *formula, double number)
{
    uint8_t *operand = append(formula, TN_OP_NUMBER, NUMBER_SIZE);
    if (!operand)
        return;
    tn_put_u64(operand, tn_bits_of(number));
    formula->numbers++;
    push(formula);
}

/* An instruction with one small operand, which is no number. */
static bool append_index(tn_formula *formula, tn_opcode opcode, uint32_t index)
{
    uint8_t *operand = append(formula, opcode, INDEX_SIZE);
    if (!operand)
        return false;
    tn_put_u32(operand, index);
    formula->numbers = 0;
    return true;
}

void tn_formula_term(tn_formula *formula, uint32_t term)
{
    if (append_index(formula, TN_OP_TERM, term))
        push(formula);
}

void tn_formula_coordinate(tn_formula *formula, uint32_t axis)
{
    if (append_index(formula, TN_OP_COORDINATE, axis))
        push(formula);
}

void tn_formula_keep(tn_formula *formula, uint32_t local)
{
    if (append_index(formula, TN_OP_KEEP, local))
        formula->height--;
}

void tn_formula_kept(tn_formula *formula, uint32_t local)
{
    if (append_index(formula, TN_OP_KEPT, local))
        push(formula);
}

void tn_formula_mesh_distance(tn_formula *formula, uint32_t mesh)
{
    if (append_index(formula, TN_OP_MESH_DISTANCE, mesh))
        formula->height -= 2;
}

/* Puts the operation's value in the place of its operands, the last numbers of the code. False where it has none. */
static bool fold(tn_formula *formula, tn_opcode opcode, uint32_t arity)
{
    double operands[TN_ARITY_MAX];
    uint8_t *first = formula->code + formula->size - arity * NUMBER_SIZE;
    for (uint32_t i = 0; i < arity; i++)
        operands[i] = tn_double_of(tn_get_u64(first + i * NUMBER_SIZE + 1));
    double value = tn_operation_apply(opcode, operands);
    if (!isfinite(value))
        return false;
    formula->size -= arity * NUMBER_SIZE;
    formula->height -= arity;
    formula->numbers -= arity;
    tn_formula_number(formula, value);
    return true;
}

void tn_formula_operation(tn_formula *formula, tn_opcode opcode, uint32_t arity)
{
    if (formula->failed || (formula->numbers >= arity && fold(formula, opcode, arity)))
        return;
    if (!append(formula, opcode, PLAIN_SIZE))
        return;
    formula->numbers = 0;
    formula->height -= arity - 1;
}

bool tn_formula_repeat(tn_formula *formula, size_t begin, size_t end, size_t most)
{
    if (end - begin > most - formula->size)
        return false;
    formula->failed =
        formula->failed || !tn_array_reserve(&formula->code, &formula->capacity, formula->size, end - begin, 1);
    if (formula->failed)
        return true;
    memcpy(formula->code + formula->size, formula->code + begin, end - begin);
    formula->size += end - begin;
    formula->depth += formula->height; /* as deep as what is repeated was, above what is there: at most this */
    formula->numbers = 0;
    push(formula);
    return true;
}

tn_status tn_formula_end(tn_formula *formula, tn_error *error)
{
    append(formula, TN_OP_VALUE, PLAIN_SIZE);
    return formula->failed ? tn_fail_memory(error) : TN_OK;
}

bool tn_formula_is_constant(const tn_formula *formula, double *number)
{
    if (formula->numbers != 1 || formula->size != NUMBER_SIZE + PLAIN_SIZE)
        return false;
    *number = tn_double_of(tn_get_u64(formula->code + 1));
    return true;
}

bool tn_formula_has_terms(const tn_formula *formula)
{
    uint32_t offset = 0;
    while (offset < formula->size && tn_code_read(formula->code, offset).opcode != TN_OP_TERM)
        offset += tn_code_read(formula->code, offset).length;
    return offset < formula->size;
}

uint64_t tn_formula_terms(const tn_formula *formula)
{
    uint64_t terms = 0;
    for (uint32_t offset = 0; offset < formula->size;) {
        tn_instruction instruction = tn_code_read(formula->code, offset);
        if (instruction.opcode == TN_OP_TERM && instruction.first < 64)
            terms |= UINT64_C(1) << instruction.first;
        offset += instruction.length;
    }
    return terms;
}
