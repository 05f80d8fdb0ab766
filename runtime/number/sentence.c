/* Reads the sentences of `fit`: by recursive descent, from the text straight to code. */
#include "runtime/number/sentence.h"

#include <stdio.h>
#include <string.h>

#include "runtime/base/nearest.h"

typedef struct reader {
    const char *text;
    size_t size, at;
    const char *const *names;
    size_t name_count;
    tn_formula *out;
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

static void apply(reader *r, tn_opcode opcode, uint32_t arity)
{
    if (r->status == TN_OK)
        tn_formula_operation(r->out, opcode, arity);
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
    tn_formula_number(r->out, (double)digits / powers[after]);
}

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || is_digit(c);
}

static void refuse_function(reader *r)
{
    const char *functions[TN_OPERATION_COUNT];
    char names[200], what[300];
    tn_word_list(functions, tn_function_names(TN_WORDS_PROTECTED, functions), names, sizeof names);
    snprintf(what, sizeof what, "there is no such function: there are %s", names);
    refuse(r, what);
}

static void read_call(reader *r, const char *name, size_t length)
{
    const tn_operation *function = tn_function_named(TN_WORDS_PROTECTED, name, length);
    if (!function) {
        refuse_function(r);
        return;
    }
    for (uint32_t k = 0; k < function->arity; k++) {
        if (k && !take(r, ','))
            refuse(r, "a function needs another argument");
        read_sum(r);
    }
    if (!take(r, ')'))
        refuse(r, "a parenthesis is not closed");
    apply(r, function->opcode, function->arity);
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
            tn_formula_term(r->out, (uint32_t)i);
            return;
        }
    r->at = begin;
    refuse(r, "there is no variable of this name");
}

static void read_factor(reader *r)
{
    if (r->status != TN_OK)
        return;
    if (++r->nest > TN_SENTENCE_NEST) {
        r->status = tn_fail(r->error, TN_LIMIT, E_EXPRESSION, "the expression nests more than %u deep, the limit",
                            TN_SENTENCE_NEST);
        return;
    }
    if (take(r, '(')) {
        read_sum(r);
        if (!take(r, ')'))
            refuse(r, "a parenthesis is not closed");
    } else if (take(r, '-')) {
        read_factor(r);
        apply(r, TN_OP_NEGATE, 1);
    } else if (r->at < r->size && (is_digit(r->text[r->at]) || r->text[r->at] == '.')) {
        read_number(r);
    } else if (r->at < r->size && is_name(r->text[r->at])) {
        read_name(r);
    } else {
        refuse(r,
               r->at == r->size ? "the expression ends too soon" : "expected a number, a name or a parenthesis here");
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
        apply(r, times ? TN_OP_MULTIPLY : TN_OP_PROTECTED_DIVIDE, 2);
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
        apply(r, plus ? TN_OP_ADD : TN_OP_SUBTRACT, 2);
    }
}

tn_status tn_sentence_read(const char *text, size_t size, const char *const *names, size_t name_count,
                           tn_formula *formula, tn_error *error)
{
    reader r = {.text = text, .size = size, .names = names, .name_count = name_count, .out = formula, .error = error};
    tn_formula_begin(formula);
    read_sum(&r);
    take(&r, ' ');
    if (r.status == TN_OK && r.at < size)
        refuse(&r, "there is more after the end of the expression");
    return r.status == TN_OK ? tn_formula_end(formula, error) : r.status;
}
