/* Operations on doubles, by their opcodes: the rows of operations.def as functions.
 *
 * None depends on the machine: each is made of operations of IEEE 754, choices, and functions of
 * runtime/math/elementary.h.
 */
#ifndef TARTAN_NUMBER_OPERATION_H
#define TARTAN_NUMBER_OPERATION_H

#include "runtime/module/opcodes.h"

/* Points that a row holds: one row of each operand stays in the nearest cache. */
#define TN_ROW 256u

#define TN_ARITY_MAX 3u

enum {
    TN_OPERATION_COUNT = 0
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC) +1
#include "runtime/module/operations.def"
#undef OPERATION
};

/* Whose functions an expression may call. */
typedef enum tn_words {
    TN_WORDS_NEITHER = 0,
    TN_WORDS_PLAIN = 1,
    TN_WORDS_PROTECTED = 2,
    TN_WORDS_FIELD = 4,
    TN_WORDS_SHARED = TN_WORDS_PLAIN | TN_WORDS_FIELD,
    TN_WORDS_ALL = TN_WORDS_PLAIN | TN_WORDS_PROTECTED | TN_WORDS_FIELD
} tn_words;

typedef struct tn_operation {
    tn_opcode opcode;
    const char *word;
    tn_words words;
    uint32_t arity;
    const char *doc;
} tn_operation;

/* In the table's order. */
extern const tn_operation tn_operations[TN_OPERATION_COUNT];

/* The function of this name among these words, or NULL. */
const tn_operation *tn_function_named(tn_words words, const char *name, size_t size);

/* The names of all functions among these words, in the table's order; returns how many. */
size_t tn_function_names(tn_words words, const char *names[TN_OPERATION_COUNT]);

/* The value of one point. `operands`: as many as its arity, the lowest on the stack first. */
double tn_operation_apply(tn_opcode opcode, const double *operands);

/* The derivative of the value, which is operands[arity], from those of the operands. */
double tn_operation_slope(tn_opcode opcode, const double *operands, const double *slopes);

/* The values of TN_ROW points, from rows of operands, as many. `out` is none of them. */
void tn_operation_row(tn_opcode opcode, const double *const *operands, double *out);

#endif
