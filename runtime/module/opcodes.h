/* What opcodes.def says, as C: the enum of opcodes and one description of each. */
#ifndef TARTAN_MODULE_OPCODES_H
#define TARTAN_MODULE_OPCODES_H

#include <stddef.h>
#include <stdint.h>

typedef enum tn_operands {
    TN_OPERANDS_NONE,
    TN_OPERANDS_SPEC,
    TN_OPERANDS_FUNC,
    TN_OPERANDS_COND,
    TN_OPERANDS_FIELD_COND,
    TN_OPERANDS_INT,
    TN_OPERANDS_INT2,
    TN_OPERANDS_TEXT,
    TN_OPERANDS_SYMBOL,
    TN_OPERANDS_LETTER,
    TN_OPERANDS_BODY,
    TN_OPERANDS_REAL,
    TN_OPERANDS_TERM,
} tn_operands;

typedef enum tn_code_engine { TN_CODE_RULE, TN_CODE_CONDITION, TN_CODE_MAP, TN_CODE_MEASURE } tn_code_engine;

typedef enum tn_opcode {
#define X(NAME, OPERANDS, POPS, PUSHES, ENGINE, DOC) TN_OP_##NAME,
#include "runtime/module/opcodes.def"
#undef X
    TN_OPCODE_COUNT
} tn_opcode;

typedef struct tn_opcode_info {
    const char *name;
    const char *doc;
    tn_operands operands;
    tn_code_engine engine;
    uint8_t pops;
    uint8_t pushes;
    uint8_t length; /* bytes of the whole instruction */
} tn_opcode_info;

/* NULL for a byte that is no opcode. */
const tn_opcode_info *tn_opcode_describe(uint8_t opcode);

#endif
