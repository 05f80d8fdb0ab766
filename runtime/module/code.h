/* Reading the code of a verified module, one instruction at a time. */
#ifndef TARTAN_MODULE_CODE_H
#define TARTAN_MODULE_CODE_H

#include "runtime/base/bytes.h"
#include "runtime/module/module.h"
#include "runtime/module/opcodes.h"

/* An instruction with its operands in the order of its row; 0 where it has none. */
typedef struct tn_instruction {
    tn_opcode opcode;
    uint32_t length; /* bytes */
    int64_t first;
    int64_t second;
} tn_instruction;

/* How an opcode's operands are laid out. */
static inline tn_operands tn_code_operands(uint8_t opcode)
{
    static const uint8_t kinds[TN_OPCODE_COUNT] = {
#define X(NAME, OPERANDS, POPS, PUSHES, ENGINE, DOC) TN_OPERANDS_##OPERANDS,
#include "runtime/module/opcodes.def"
#undef X
    };
    return (tn_operands)kinds[opcode];
}

typedef struct tn_opcode_effect {
    uint8_t pops;
    uint8_t pushes;
} tn_opcode_effect;

/* What an opcode does to the stack. */
static inline tn_opcode_effect tn_code_effect(uint8_t opcode)
{
    static const tn_opcode_effect effects[TN_OPCODE_COUNT] = {
#define X(NAME, OPERANDS, POPS, PUSHES, ENGINE, DOC) {POPS, PUSHES},
#include "runtime/module/opcodes.def"
#undef X
    };
    return effects[opcode];
}

/* The instruction at a byte offset of the code section, which must be one that verifying has seen. */
static inline tn_instruction tn_code_read(const uint8_t *code, uint32_t offset)
{
    const uint8_t *bytes = code + offset;
    tn_instruction instruction = {.opcode = (tn_opcode)bytes[0], .length = 1};
    switch (tn_code_operands(bytes[0])) {
    case TN_OPERANDS_NONE:
        break;
    case TN_OPERANDS_SPEC:
    case TN_OPERANDS_FUNC:
    case TN_OPERANDS_COND:
    case TN_OPERANDS_TEXT:
    case TN_OPERANDS_SYMBOL:
    case TN_OPERANDS_LETTER:
    case TN_OPERANDS_BODY:
    case TN_OPERANDS_TERM:
        instruction.first = tn_get_u32(bytes + 1);
        instruction.length = 5;
        break;
    case TN_OPERANDS_FIELD_COND:
        instruction.first = tn_get_u32(bytes + 1);
        instruction.second = tn_get_u32(bytes + 5);
        instruction.length = 9;
        break;
    case TN_OPERANDS_INT:
    case TN_OPERANDS_REAL: /* its bits */
        instruction.first = tn_get_i64(bytes + 1);
        instruction.length = 9;
        break;
    case TN_OPERANDS_INT2:
        instruction.first = tn_get_i64(bytes + 1);
        instruction.second = tn_get_i64(bytes + 9);
        instruction.length = 17;
        break;
    }
    return instruction;
}

#endif
