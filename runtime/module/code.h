/* Reading the code of a verified module, one instruction at a time. */
#ifndef TARTAN_MODULE_CODE_H
#define TARTAN_MODULE_CODE_H

#include "runtime/base/bytes.h"
#include "runtime/module/module.h"
#include "runtime/module/opcodes.h"

/* An instruction with its operands in the order of its row; 0 if it has none. F64: its bits. */
typedef struct tn_instruction {
    tn_opcode opcode;
    uint32_t length; /* bytes */
    int64_t first;
    int64_t second;
} tn_instruction;

#define TN_OPERANDS_MAX 3 /* relations that an instruction takes from the stack */

/* Into how many stretches REPEATED may cut one. */
#define TN_REPEATED_MAX 1000000u

/* What an operand is (operands.def). */
typedef enum tn_slot_kind {
    TN_SLOT_NOTHING,
    TN_SLOT_U32,
    TN_SLOT_I64,
    TN_SLOT_F64,
    TN_SLOT_STRING,
    TN_SLOT_INDEX
} tn_slot_kind;

typedef struct tn_slot {
    tn_slot_kind kind;
    tn_section section; /* of an INDEX */
} tn_slot;

/* The two operands of each kind. */
extern const tn_slot tn_operand_slots[TN_OPERANDS_COUNT][2];

/* What kind of operands an opcode has. */
static inline tn_operands tn_code_operands(uint8_t opcode)
{
    static const uint8_t kinds[TN_OPCODE_COUNT] = {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC) [TN_OP_##NAME] = TN_OPERANDS_##OPERANDS,
#include "runtime/module/opcodes.def"
    };
    return (tn_operands)kinds[opcode];
}

/* Does it take the relation of another function? Calls lead to lower functions, except in a circle (AGAIN). */
static inline bool tn_code_calls(tn_opcode opcode)
{
    return opcode == TN_OP_CALL || opcode == TN_OP_MIRROR || opcode == TN_OP_AGAIN;
}

/* Is it the judgement M of a rule? */
static inline bool tn_function_is_whole(const tn_function_record *function)
{
    return function->kind == TN_FUNCTION_WHOLE || function->kind == TN_FUNCTION_CIRCLE;
}

/* Does it compare a number of the whole house with 0? */
static inline bool tn_code_compares_house(tn_opcode opcode)
{
    return tn_code_operands((uint8_t)opcode) == TN_OPERANDS_HOUSE_SUMMED;
}

/* Does it compare a sum on the stretches of a plan? */
static inline bool tn_code_compares(tn_opcode opcode)
{
    return opcode == TN_OP_BELOW || opcode == TN_OP_ZERO || opcode == TN_OP_ABOVE || opcode == TN_OP_MULTIPLE;
}

/* Is it a relation over the trays of a house, which a plan alone does not say? */
static inline bool tn_code_asks_house(tn_opcode opcode)
{
    static const bool asks[TN_OPCODE_COUNT] = {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC)                                                             \
    [TN_OP_##NAME] =                                                                                                   \
        TN_CODE_##CODE == TN_CODE_RULE &&                                                                              \
        (TN_OPERANDS_##OPERANDS == TN_OPERANDS_DECISION || TN_OPERANDS_##OPERANDS == TN_OPERANDS_MEETING ||            \
         TN_OPERANDS_##OPERANDS == TN_OPERANDS_DECISION_COND || TN_OPERANDS_##OPERANDS == TN_OPERANDS_HOUSE_SUMMED),
#include "runtime/module/opcodes.def"
    };
    return asks[opcode];
}

typedef struct tn_opcode_effect {
    uint8_t pops;
    uint8_t pushes;
} tn_opcode_effect;

/* What an opcode does to the stack. */
static inline tn_opcode_effect tn_code_effect(uint8_t opcode)
{
    static const tn_opcode_effect effects[TN_OPCODE_COUNT] = {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC) [TN_OP_##NAME] = {POPS, PUSHES},
#include "runtime/module/opcodes.def"
    };
    return effects[opcode];
}

typedef struct tn_operand_widths {
    uint8_t first;
    uint8_t second;
} tn_operand_widths;

/* Bytes of an opcode's operands. */
static inline tn_operand_widths tn_code_widths(uint8_t opcode)
{
    static const tn_operand_widths widths[TN_OPCODE_COUNT] = {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC) [TN_OP_##NAME] = {TN_FIRST_##OPERANDS, TN_SECOND_##OPERANDS},
#include "runtime/module/opcodes.def"
    };
    return widths[opcode];
}

static inline int64_t tn_code_operand(const uint8_t *bytes, uint8_t width)
{
    return width == 4 ? (int64_t)tn_get_u32(bytes) : width == 8 ? tn_get_i64(bytes) : 0;
}

/* The instruction at a byte offset of the code section, which must be one that verifying has seen. */
static inline tn_instruction tn_code_read(const uint8_t *code, uint32_t offset)
{
    const uint8_t *bytes = code + offset;
    tn_operand_widths widths = tn_code_widths(bytes[0]);
    return (tn_instruction){.opcode = (tn_opcode)bytes[0],
                            .length = 1u + widths.first + widths.second,
                            .first = tn_code_operand(bytes + 1, widths.first),
                            .second = tn_code_operand(bytes + 1 + widths.first, widths.second)};
}

/* The source place of the instruction at `offset` of the code section: its own, or that of the nearest instruction
 * before it in the same function or production that has one; NULL if there is none. */
const tn_source_map_record *tn_module_place(const tn_module *module, uint32_t offset);

#endif
