/* Describes the opcodes, the kinds of code, of functions and of operands, as the rows of opcodes.def and operands.def
 * say. */
#include "runtime/module/opcodes.h"

#include "runtime/module/code.h"

static const tn_opcode_info infos[TN_OPCODE_COUNT] = {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC)                                                             \
    [TN_OP_##NAME] = {#NAME,                                                                                           \
                      DOC,                                                                                             \
                      TN_OPERANDS_##OPERANDS,                                                                          \
                      TN_CODE_##CODE,                                                                                  \
                      POPS,                                                                                            \
                      PUSHES,                                                                                          \
                      1 + TN_FIRST_##OPERANDS + TN_SECOND_##OPERANDS},
#include "runtime/module/opcodes.def"
};

const tn_opcode_info *tn_opcode_describe(uint8_t opcode)
{
    return opcode < TN_OPCODE_COUNT && infos[opcode].name ? &infos[opcode] : NULL;
}

const tn_function_kind_info tn_function_kinds[TN_FUNCTION_KIND_COUNT] = {
#define FUNCTION_KIND(NAME, NUMBER, CODE, LAST, WORD) [TN_FUNCTION_##NAME] = {TN_CODE_##CODE, TN_OP_##LAST},
#include "runtime/module/opcodes.def"
};

const char *const tn_names_FUNCTION_KIND[TN_FUNCTION_KIND_COUNT] = {
#define FUNCTION_KIND(NAME, NUMBER, CODE, LAST, WORD) [TN_FUNCTION_##NAME] = (WORD),
#include "runtime/module/opcodes.def"
};

#define SLOT_NOTHING                                                                                                   \
    {                                                                                                                  \
        .kind = TN_SLOT_NOTHING                                                                                        \
    }
#define SLOT_U32                                                                                                       \
    {                                                                                                                  \
        .kind = TN_SLOT_U32                                                                                            \
    }
#define SLOT_I64                                                                                                       \
    {                                                                                                                  \
        .kind = TN_SLOT_I64                                                                                            \
    }
#define SLOT_F64                                                                                                       \
    {                                                                                                                  \
        .kind = TN_SLOT_F64                                                                                            \
    }
#define SLOT_STRING                                                                                                    \
    {                                                                                                                  \
        .kind = TN_SLOT_STRING                                                                                         \
    }
#define SLOT_INDEX(SECTION)                                                                                            \
    {                                                                                                                  \
        .kind = TN_SLOT_INDEX, .section = TN_SECTION_##SECTION                                                         \
    }

const tn_slot tn_operand_slots[TN_OPERANDS_COUNT][2] = {
#define OPERANDS(NAME, FIRST, SECOND) {SLOT_##FIRST, SLOT_##SECOND},
#include "runtime/module/operands.def"
};
