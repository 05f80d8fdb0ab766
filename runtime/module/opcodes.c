/* Describes the opcodes and the kinds of functions, as the rows of opcodes.def and operands.def say. */
#include "runtime/module/opcodes.h"

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
