/* Arithmetic expressions over named variables, evaluated over columns of numbers: for fitting data and for fitness
 * terms.
 *
 *   expression: term {(+|-) term}   term: factor {(*|/) factor}   factor: number | name | name(expression, ...) |
 * (expression) | -factor
 *
 * Functions: sqrt (of the absolute value), abs, square, min, max, sin, cos, exp, log (of the absolute value, and 0 of
 * 0), tanh. Division is protected: a / b is 1 where b is 0. No operation depends on the machine: each is one IEEE 754
 * operation, a choice, or of runtime/base/numeric.h.
 */
#ifndef TARTAN_NUMBER_EXPRESSION_H
#define TARTAN_NUMBER_EXPRESSION_H

#include "runtime/base/error.h"

typedef enum tn_expression_op {
    TN_EXPRESSION_NUMBER,
    TN_EXPRESSION_VARIABLE,
    TN_EXPRESSION_ADD,
    TN_EXPRESSION_SUBTRACT,
    TN_EXPRESSION_MULTIPLY,
    TN_EXPRESSION_DIVIDE,
    TN_EXPRESSION_NEGATE,
    TN_EXPRESSION_SQRT,
    TN_EXPRESSION_ABS,
    TN_EXPRESSION_SQUARE,
    TN_EXPRESSION_SIN,
    TN_EXPRESSION_COS,
    TN_EXPRESSION_EXP,
    TN_EXPRESSION_LOG,
    TN_EXPRESSION_TANH,
    TN_EXPRESSION_MIN,
    TN_EXPRESSION_MAX,
} tn_expression_op;

typedef struct tn_expression_step {
    tn_expression_op op;
    uint32_t variable;
    double number;
} tn_expression_step;

/* Steps of a stack machine. Zero it to begin with; it may be parsed into again and again. */
typedef struct tn_expression {
    tn_expression_step *steps;
    size_t count, capacity;
    size_t depth;            /* of the stack, at most */
    double *stack;           /* scratch of evaluating: depth rows of TN_EXPRESSION_ROW */
    const double **operands; /* likewise: the rows that are on the stack, a variable's column or one of the above */
    size_t stack_capacity;
} tn_expression;

#define TN_EXPRESSION_ROW 128u   /* points evaluated together: a row of each operand stays in the nearest cache */
#define TN_EXPRESSION_NEST 1000u /* how deep parentheses may nest */

void tn_expression_clear(tn_expression *expression);

/* TN_INVALID with the column (E1242), TN_LIMIT where it nests too deep. */
tn_status tn_expression_parse(const char *text, size_t size, const char *const *names, size_t name_count,
                              tn_expression *expression, tn_error *error);

/* The values at `count` points, columns[variable][point], into `values`. Columns are readable (not changed, and not
 * part of the result) up to the next multiple of TN_EXPRESSION_ROW points. TN_MEMORY, or TN_OK. */
tn_status tn_expression_evaluate(tn_expression *expression, const double *const *columns, size_t count, double *values,
                                 tn_error *error);

#endif
