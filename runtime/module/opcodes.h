/* What opcodes.def says, as C: enums, and one description of each opcode and each kind of function. */
#ifndef TARTAN_MODULE_OPCODES_H
#define TARTAN_MODULE_OPCODES_H

#include <stddef.h>
#include <stdint.h>

typedef enum tn_operands {
#define OPERANDS(NAME, FIRST, SECOND) TN_OPERANDS_##NAME,
#include "runtime/module/operands.def"
    TN_OPERANDS_COUNT
} tn_operands;

/* Bytes that each operand takes: TN_FIRST_SPEC, TN_SECOND_SPEC and so on. */
#define TN_WIDTH_NOTHING 0
#define TN_WIDTH_U32 4
#define TN_WIDTH_I64 8
#define TN_WIDTH_F64 8
#define TN_WIDTH_STRING 4
#define TN_WIDTH_INDEX(SECTION) 4
enum {
#define OPERANDS(NAME, FIRST, SECOND) TN_FIRST_##NAME = TN_WIDTH_##FIRST, TN_SECOND_##NAME = TN_WIDTH_##SECOND,
#include "runtime/module/operands.def"
};

typedef enum tn_code_kind {
#define CODE_KIND(NAME) TN_CODE_##NAME,
#include "runtime/module/opcodes.def"
    TN_CODE_KIND_COUNT
} tn_code_kind;

/* The counts are one more than the highest number, wherever its row stands: these unions have so many bytes. */
union tn_function_kinds_bytes {
#define FUNCTION_KIND(NAME, NUMBER, CODE, LAST, WORD) char of_##NAME[(NUMBER) + 1];
#include "runtime/module/opcodes.def"
};

union tn_opcodes_bytes {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC) char of_##NAME[(NUMBER) + 1];
#include "runtime/module/opcodes.def"
};

typedef enum tn_function_kind {
#define FUNCTION_KIND(NAME, NUMBER, CODE, LAST, WORD) TN_FUNCTION_##NAME = (NUMBER),
#include "runtime/module/opcodes.def"
    TN_FUNCTION_KIND_COUNT = sizeof(union tn_function_kinds_bytes)
} tn_function_kind;

typedef enum tn_opcode {
#define X(NAME, NUMBER, OPERANDS, POPS, PUSHES, CODE, DOC) TN_OP_##NAME = (NUMBER),
#include "runtime/module/opcodes.def"
    TN_OPCODE_COUNT = sizeof(union tn_opcodes_bytes)
} tn_opcode;

_Static_assert(TN_OPCODE_COUNT <= UINT8_MAX, "an opcode is a byte");

typedef struct tn_opcode_info {
    const char *name;
    const char *doc;
    tn_operands operands;
    tn_code_kind code;
    uint8_t pops;
    uint8_t pushes;
    uint8_t length; /* bytes of the whole instruction */
} tn_opcode_info;

typedef struct tn_function_kind_info {
    tn_code_kind code;
    tn_opcode last; /* the one instruction that such a function ends with */
} tn_function_kind_info;

extern const tn_function_kind_info tn_function_kinds[TN_FUNCTION_KIND_COUNT];

/* Their words, by number; NULL for a number that is no kind. */
extern const char *const tn_names_FUNCTION_KIND[TN_FUNCTION_KIND_COUNT];

/* NULL for a byte that is no opcode. */
const tn_opcode_info *tn_opcode_describe(uint8_t opcode);

#endif
