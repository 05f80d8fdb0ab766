#include "runtime/module/opcodes.h"

/* Bytes that each kind of operands takes. */
enum {
    LENGTH_NONE = 0,
    LENGTH_SPEC = 4,
    LENGTH_FUNC = 4,
    LENGTH_COND = 4,
    LENGTH_FIELD_COND = 8,
    LENGTH_INT = 8,
    LENGTH_INT2 = 16,
    LENGTH_TEXT = 4,
    LENGTH_SYMBOL = 4,
    LENGTH_LETTER = 4,
    LENGTH_BODY = 4,
    LENGTH_REAL = 8,
    LENGTH_TERM = 4,
};

#define ENGINE_RULE TN_CODE_RULE
#define ENGINE_CONDITION TN_CODE_CONDITION
#define ENGINE_MAP TN_CODE_MAP
#define ENGINE_MEASURE TN_CODE_MEASURE

static const tn_opcode_info infos[TN_OPCODE_COUNT] = {
#define X(NAME, OPERANDS, POPS, PUSHES, ENGINE, DOC)                                                                   \
    {#NAME, DOC, TN_OPERANDS_##OPERANDS, ENGINE_##ENGINE, POPS, PUSHES, 1 + LENGTH_##OPERANDS},
#include "runtime/module/opcodes.def"
#undef X
};

const tn_opcode_info *tn_opcode_describe(uint8_t opcode)
{
    return opcode < TN_OPCODE_COUNT ? &infos[opcode] : NULL;
}
