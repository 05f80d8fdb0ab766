#include "runtime/number/expression.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/any_width.h"
#include "runtime/base/numeric.h"

void tn_expression_clear(tn_expression *expression)
{
    free(expression->steps);
    free(expression->stack);
    free(expression->operands);
    *expression = (tn_expression){0};
}

/* ---- parsing */

typedef struct reader {
    const char *text;
    size_t size, at;
    const char *const *names;
    size_t name_count;
    tn_expression *out;
    size_t height; /* of the stack after the steps so far */
    unsigned nest;
    tn_status status;
    tn_error *error;
} reader;

static void read_sum(reader *r);

static void refuse(reader *r, const char *what)
{
    if (r->status != TN_OK)
        return;
    r->status = tn_fail(r->error, TN_INVALID, E_EXPRESSION, "%s", what);
    tn_error_place(r->error, 0, r->at + 1, r->at + 2);
}

static void emit(reader *r, tn_expression_step step, size_t pops)
{
    tn_expression *e = r->out;
    if (r->status != TN_OK)
        return;
    if (e->count == e->capacity) {
        size_t capacity = e->capacity ? e->capacity * 2 : 64;
        tn_expression_step *steps = realloc(e->steps, capacity * sizeof *steps);
        if (!steps) {
            r->status = tn_fail_memory(r->error);
            return;
        }
        e->steps = steps;
        e->capacity = capacity;
    }
    e->steps[e->count++] = step;
    r->height = r->height - pops + 1;
    e->depth = r->height > e->depth ? r->height : e->depth;
}

static bool take(reader *r, char c)
{
    while (r->at < r->size && (r->text[r->at] == ' ' || r->text[r->at] == '\n' || r->text[r->at] == '\t'))
        r->at++;
    if (r->at == r->size || r->text[r->at] != c)
        return false;
    r->at++;
    return true;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Powers of ten that a double holds exactly: a number of at most 15 digits with as many after the point is then read
 * right by one division (Clinger 1990). */
static const double powers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

static void read_number(reader *r)
{
    uint64_t digits = 0;
    unsigned count = 0, after = 0;
    bool point = false;
    for (; r->at < r->size && (is_digit(r->text[r->at]) || (r->text[r->at] == '.' && !point)); r->at++) {
        if (r->text[r->at] == '.') {
            point = true;
            continue;
        }
        if (count == 15) {
            refuse(r, "a number has more than 15 digits");
            return;
        }
        digits = digits * 10 + (uint64_t)(r->text[r->at] - '0');
        count += digits != 0;
        after += point;
        if (after > 15) {
            refuse(r, "a number has more than 15 digits after the point");
            return;
        }
    }
    emit(r, (tn_expression_step){.op = TN_EXPRESSION_NUMBER, .number = (double)digits / powers[after]}, 0);
}

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || is_digit(c);
}

typedef struct function {
    const char *name;
    tn_expression_op op;
    size_t arguments;
} function;

static void read_call(reader *r, const char *name, size_t length)
{
    static const function functions[] = {{"sqrt", TN_EXPRESSION_SQRT, 1},     {"abs", TN_EXPRESSION_ABS, 1},
                                         {"square", TN_EXPRESSION_SQUARE, 1}, {"sin", TN_EXPRESSION_SIN, 1},
                                         {"cos", TN_EXPRESSION_COS, 1},       {"exp", TN_EXPRESSION_EXP, 1},
                                         {"log", TN_EXPRESSION_LOG, 1},       {"tanh", TN_EXPRESSION_TANH, 1},
                                         {"min", TN_EXPRESSION_MIN, 2},       {"max", TN_EXPRESSION_MAX, 2}};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        if (strlen(functions[i].name) != length || memcmp(functions[i].name, name, length) != 0)
            continue;
        for (size_t k = 0; k < functions[i].arguments; k++) {
            if (k && !take(r, ','))
                refuse(r, "a function wants another argument");
            read_sum(r);
        }
        if (!take(r, ')'))
            refuse(r, "a parenthesis is not closed");
        emit(r, (tn_expression_step){.op = functions[i].op}, functions[i].arguments);
        return;
    }
    refuse(r, "there is no such function: there are sqrt, abs, square, sin, cos, exp, log, tanh, min and max");
}

static void read_name(reader *r)
{
    const char *name = r->text + r->at;
    size_t begin = r->at;
    while (r->at < r->size && is_name(r->text[r->at]))
        r->at++;
    size_t length = r->at - begin;
    if (take(r, '(')) {
        read_call(r, name, length);
        return;
    }
    for (size_t i = 0; i < r->name_count; i++)
        if (strlen(r->names[i]) == length && memcmp(r->names[i], name, length) == 0) {
            emit(r, (tn_expression_step){.op = TN_EXPRESSION_VARIABLE, .variable = (uint32_t)i}, 0);
            return;
        }
    r->at = begin;
    refuse(r, "there is no variable of this name");
}

static void read_factor(reader *r)
{
    if (r->status != TN_OK)
        return;
    if (++r->nest > TN_EXPRESSION_NEST) {
        r->status = tn_fail(r->error, TN_LIMIT, E_EXPRESSION, "the expression nests more than %u deep, the limit",
                            TN_EXPRESSION_NEST);
        return;
    }
    if (take(r, '(')) {
        read_sum(r);
        if (!take(r, ')'))
            refuse(r, "a parenthesis is not closed");
    } else if (take(r, '-')) {
        read_factor(r);
        emit(r, (tn_expression_step){.op = TN_EXPRESSION_NEGATE}, 1);
    } else if (r->at < r->size && (is_digit(r->text[r->at]) || r->text[r->at] == '.')) {
        read_number(r);
    } else if (r->at < r->size && is_name(r->text[r->at])) {
        read_name(r);
    } else {
        refuse(r,
               r->at == r->size ? "the expression ends too soon" : "a number, a name or a parenthesis is wanted here");
    }
    r->nest--;
}

static void read_product(reader *r)
{
    read_factor(r);
    while (r->status == TN_OK) {
        bool times = take(r, '*');
        if (!times && !take(r, '/'))
            return;
        read_factor(r);
        emit(r, (tn_expression_step){.op = times ? TN_EXPRESSION_MULTIPLY : TN_EXPRESSION_DIVIDE}, 2);
    }
}

static void read_sum(reader *r)
{
    read_product(r);
    while (r->status == TN_OK) {
        bool plus = take(r, '+');
        if (!plus && !take(r, '-'))
            return;
        read_product(r);
        emit(r, (tn_expression_step){.op = plus ? TN_EXPRESSION_ADD : TN_EXPRESSION_SUBTRACT}, 2);
    }
}

tn_status tn_expression_parse(const char *text, size_t size, const char *const *names, size_t name_count,
                              tn_expression *expression, tn_error *error)
{
    reader r = {
        .text = text, .size = size, .names = names, .name_count = name_count, .out = expression, .error = error};
    expression->count = expression->depth = 0;
    read_sum(&r);
    take(&r, ' ');
    if (r.status == TN_OK && r.at < size)
        refuse(&r, "the expression goes on where it should end");
    return r.status;
}

/* ---- evaluating: row by row, each operation over a whole row. Rows have one length, so that compilers turn the loops
 * into vector code. */

#define ROW TN_EXPRESSION_ROW
#define EACH for (size_t i = 0; i < ROW; i++)

TN_ANY_WIDTH static void compute(tn_expression_op op, const double *a, const double *b, double *restrict out)
{
    switch (op) {
    case TN_EXPRESSION_ADD:
        EACH out[i] = a[i] + b[i];
        break;
    case TN_EXPRESSION_SUBTRACT:
        EACH out[i] = a[i] - b[i];
        break;
    case TN_EXPRESSION_MULTIPLY:
        EACH out[i] = a[i] * b[i];
        break;
    case TN_EXPRESSION_DIVIDE:
        EACH
        {
            double quotient = a[i] / b[i];
            out[i] = b[i] == 0 ? 1 : quotient;
        }
        break;
    case TN_EXPRESSION_MIN:
        EACH out[i] = a[i] < b[i] ? a[i] : b[i];
        break;
    case TN_EXPRESSION_MAX:
        EACH out[i] = a[i] > b[i] ? a[i] : b[i];
        break;
    case TN_EXPRESSION_NEGATE:
        EACH out[i] = -a[i];
        break;
    case TN_EXPRESSION_SQRT:
        EACH out[i] = __builtin_sqrt(__builtin_fabs(a[i]));
        break;
    case TN_EXPRESSION_ABS:
        EACH out[i] = __builtin_fabs(a[i]);
        break;
    default:
        EACH out[i] = a[i] * a[i];
        break;
    }
}

static double protected_log(double x)
{
    return x == 0 ? 0 : tn_log(__builtin_fabs(x));
}

/* Functions that are more than one operation, element by element. */
static void compute_function(tn_expression_op op, const double *a, double *restrict out)
{
    static double (*const functions[])(double) = {tn_sin, tn_cos, tn_exp, protected_log, tn_tanh};
    double (*const apply)(double) = functions[op - TN_EXPRESSION_SIN];
    EACH out[i] = apply(a[i]);
}

static bool takes_one(tn_expression_op op)
{
    return op != TN_EXPRESSION_MIN && op != TN_EXPRESSION_MAX && op >= TN_EXPRESSION_NEGATE;
}

/* One row of results, from rows of variables. `out` may be no operand: results of one level of the stack are written to
 * the scratch row of that level, which two operands of the same level never share; so each level has two rows, used in
 * turn. */
static const double *evaluate_row(const tn_expression *e, const double *const *columns, size_t from)
{
    size_t top = 0;
    for (size_t s = 0; s < e->count; s++) {
        const tn_expression_step *step = &e->steps[s];
        if (step->op == TN_EXPRESSION_VARIABLE) {
            e->operands[top++] = columns[step->variable] + from;
            continue;
        }
        if (step->op == TN_EXPRESSION_NUMBER) {
            double *row = e->stack + 2 * top * ROW;
            EACH row[i] = step->number;
            e->operands[top++] = row;
            continue;
        }
        top -= takes_one(step->op) ? 1 : 2;
        double *row = e->stack + 2 * top * ROW;
        row = e->operands[top] == row ? row + ROW : row;
        if (step->op >= TN_EXPRESSION_SIN && step->op <= TN_EXPRESSION_TANH)
            compute_function(step->op, e->operands[top], row);
        else
            compute(step->op, e->operands[top], takes_one(step->op) ? NULL : e->operands[top + 1], row);
        e->operands[top++] = row;
    }
    return e->operands[0];
}

static bool reserve(tn_expression *e)
{
    if (e->depth <= e->stack_capacity)
        return true;
    double *stack = realloc(e->stack, 2 * e->depth * ROW * sizeof *stack);
    if (!stack)
        return false;
    e->stack = stack;
    const double **operands = realloc(e->operands, e->depth * sizeof *operands);
    if (!operands)
        return false;
    e->operands = operands;
    e->stack_capacity = e->depth;
    return true;
}

tn_status tn_expression_evaluate(tn_expression *e, const double *const *columns, size_t count, double *values,
                                 tn_error *error)
{
    if (!reserve(e))
        return tn_fail_memory(error);
    for (size_t from = 0; from < count; from += ROW)
        memcpy(values + from, evaluate_row(e, columns, from),
               (count - from < ROW ? count - from : ROW) * sizeof *values);
    return TN_OK;
}
