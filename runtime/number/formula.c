/* Makes the code of an expression, instruction by instruction, folding its constants; and reads the sentences of `fit`.
 */
#include "runtime/number/formula.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/base/nearest.h"
#include "runtime/module/code.h"

/* ==== makes the code of an expression, instruction by instruction, and folds its constants */

enum { NUMBER_SIZE = 9, INDEX_SIZE = 5, PLAIN_SIZE = 1 }; /* bytes of an instruction: opcodes.def */

void tn_formula_clear(tn_formula *formula)
{
    free(formula->code);
    *formula = (tn_formula){0};
}

void tn_formula_begin(tn_formula *formula)
{
    *formula = (tn_formula){.code = formula->code, .capacity = formula->capacity};
}

/* Room for an instruction, with its opcode in place; NULL if out of memory. */
static uint8_t *append(tn_formula *formula, tn_opcode opcode, size_t size)
{
    formula->failed = formula->failed || !tn_array_reserve(&formula->code, &formula->capacity, formula->size, size, 1);
    if (formula->failed)
        return NULL;
    uint8_t *place = formula->code + formula->size;
    *place = (uint8_t)opcode;
    formula->size += size;
    return place + 1;
}

static void push(tn_formula *formula)
{
    formula->height++;
    formula->depth = formula->height > formula->depth ? formula->height : formula->depth;
}

void tn_formula_number(tn_formula *formula, double number)
{
    uint8_t *operand = append(formula, TN_OP_NUMBER, NUMBER_SIZE);
    if (!operand)
        return;
    tn_put_u64(operand, tn_bits_of(number));
    formula->numbers++;
    push(formula);
}

/* An instruction with one small operand, which is no number. */
static bool append_index(tn_formula *formula, tn_opcode opcode, uint32_t index)
{
    uint8_t *operand = append(formula, opcode, INDEX_SIZE);
    if (!operand)
        return false;
    tn_put_u32(operand, index);
    formula->numbers = 0;
    return true;
}

void tn_formula_term(tn_formula *formula, uint32_t term)
{
    if (append_index(formula, TN_OP_TERM, term))
        push(formula);
}

void tn_formula_coordinate(tn_formula *formula, uint32_t axis)
{
    if (append_index(formula, TN_OP_COORDINATE, axis))
        push(formula);
}

void tn_formula_keep(tn_formula *formula, uint32_t local)
{
    if (append_index(formula, TN_OP_KEEP, local))
        formula->height--;
}

void tn_formula_kept(tn_formula *formula, uint32_t local)
{
    if (append_index(formula, TN_OP_KEPT, local))
        push(formula);
}

void tn_formula_mesh_distance(tn_formula *formula, uint32_t mesh)
{
    if (append_index(formula, TN_OP_MESH_DISTANCE, mesh))
        formula->height -= 2;
}

/* Puts the operation's value in the place of its operands, the last numbers of the code. False if it has none. */
static bool fold(tn_formula *formula, tn_opcode opcode, uint32_t arity)
{
    double operands[TN_ARITY_MAX];
    uint8_t *first = formula->code + formula->size - arity * NUMBER_SIZE;
    for (uint32_t i = 0; i < arity; i++)
        operands[i] = tn_double_of(tn_get_u64(first + i * NUMBER_SIZE + 1));
    double value = tn_operation_apply(opcode, operands);
    if (!isfinite(value))
        return false;
    formula->size -= arity * NUMBER_SIZE;
    formula->height -= arity;
    formula->numbers -= arity;
    tn_formula_number(formula, value);
    return true;
}

void tn_formula_operation(tn_formula *formula, tn_opcode opcode, uint32_t arity)
{
    if (formula->failed || (formula->numbers >= arity && fold(formula, opcode, arity)))
        return;
    if (!append(formula, opcode, PLAIN_SIZE))
        return;
    formula->numbers = 0;
    formula->height -= arity - 1;
}

bool tn_formula_repeat(tn_formula *formula, size_t begin, size_t end, size_t most)
{
    if (end - begin > most - formula->size)
        return false;
    formula->failed =
        formula->failed || !tn_array_reserve(&formula->code, &formula->capacity, formula->size, end - begin, 1);
    if (formula->failed)
        return true;
    memcpy(formula->code + formula->size, formula->code + begin, end - begin);
    formula->size += end - begin;
    formula->depth += formula->height; /* as deep as what is repeated was, above what is there: at most this */
    formula->numbers = 0;
    push(formula);
    return true;
}

tn_status tn_formula_end(tn_formula *formula, tn_error *error)
{
    append(formula, TN_OP_VALUE, PLAIN_SIZE);
    return formula->failed ? tn_fail_memory(error) : TN_OK;
}

bool tn_formula_is_constant(const tn_formula *formula, double *number)
{
    if (formula->numbers != 1 || formula->size != NUMBER_SIZE + PLAIN_SIZE)
        return false;
    *number = tn_double_of(tn_get_u64(formula->code + 1));
    return true;
}

bool tn_formula_has_terms(const tn_formula *formula)
{
    uint32_t offset = 0;
    while (offset < formula->size && tn_code_read(formula->code, offset).opcode != TN_OP_TERM)
        offset += tn_code_read(formula->code, offset).length;
    return offset < formula->size;
}

uint64_t tn_formula_terms(const tn_formula *formula)
{
    uint64_t terms = 0;
    for (uint32_t offset = 0; offset < formula->size;) {
        tn_instruction instruction = tn_code_read(formula->code, offset);
        if (instruction.opcode == TN_OP_TERM && instruction.first < 64)
            terms |= UINT64_C(1) << instruction.first;
        offset += instruction.length;
    }
    return terms;
}

/* ==== reads the sentences of `fit`: by recursive descent, from the text straight to code */

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

static void read_expression(reader *r);

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

/* The next character that is no blank; 0 at the end. */
static inline char peek(reader *r)
{
    while (r->at < r->size && (r->text[r->at] == ' ' || r->text[r->at] == '\n' || r->text[r->at] == '\t'))
        r->at++;
    return r->at < r->size ? r->text[r->at] : '\0';
}

static inline bool take(reader *r, char c)
{
    bool taken = peek(r) == c; /* which is never 0 */
    r->at += taken;
    return taken;
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

/* ---- functions */

/* Names that Python programs give to operations. Those of PonyGE2 are protected; those of NumPy are what they are
 * elsewhere, and may have no value. */
static const struct {
    const char *word;
    tn_opcode opcode;
    uint32_t arity;
} aliases[] = {
    {"pdiv", TN_OP_PROTECTED_DIVIDE, 2},
    {"psqrt", TN_OP_PROTECTED_ROOT, 1},
    {"rlog", TN_OP_PROTECTED_LOGARITHM, 1},
    {"np.sin", TN_OP_SINE, 1},
    {"np.cos", TN_OP_COSINE, 1},
    {"np.tan", TN_OP_TANGENT, 1},
    {"np.tanh", TN_OP_HYPERBOLIC_TANGENT, 1},
    {"np.exp", TN_OP_EXPONENTIAL, 1},
    {"np.log", TN_OP_LOGARITHM, 1},
    {"np.sqrt", TN_OP_ROOT, 1},
    {"np.abs", TN_OP_ABSOLUTE, 1},
    {"np.absolute", TN_OP_ABSOLUTE, 1},
    {"np.square", TN_OP_SQUARE, 1},
    {"np.negative", TN_OP_NEGATE, 1},
    {"np.floor", TN_OP_FLOOR, 1},
    {"np.add", TN_OP_ADD, 2},
    {"np.subtract", TN_OP_SUBTRACT, 2},
    {"np.multiply", TN_OP_MULTIPLY, 2},
    {"np.divide", TN_OP_DIVIDE, 2},
    {"np.power", TN_OP_POWER, 2},
    {"np.minimum", TN_OP_LEAST, 2},
    {"np.maximum", TN_OP_MOST, 2},
    {"np.arctan2", TN_OP_ARC_TANGENT, 2},
    {"np.logical_and", TN_OP_IS_BOTH, 2},
    {"np.logical_or", TN_OP_IS_EITHER, 2},
    {"np.logical_not", TN_OP_IS_NOT, 1},
};

static bool same_word(const char *word, const char *name, size_t length)
{
    size_t same = 0;
    while (same < length && word[same] && word[same] == name[same])
        same++;
    return same == length && !word[same];
}

static void refuse_function(reader *r, const char *name, size_t length)
{
    const char *functions[TN_OPERATION_COUNT];
    char names[200], what[400];
    tn_word_list(functions, tn_function_names(TN_WORDS_PROTECTED, functions), names, sizeof names);
    snprintf(what, sizeof what, "there is no function `%.*s`: there are %s", (int)(length < 60 ? length : 60), name,
             names);
    refuse(r, what);
}

static void read_arguments(reader *r, uint32_t first, uint32_t arity)
{
    for (uint32_t k = first; k < arity; k++) {
        if (k && !take(r, ','))
            refuse(r, "a function needs another argument");
        read_expression(r);
    }
    if (!take(r, ')'))
        refuse(r, "a parenthesis is not closed");
}

/* What PonyGE2 makes of several operations: plog(a) = log(1 + |a|), aq(a, b) = a / sqrt(1 + b * b). */
static bool read_composed(reader *r, const char *name, size_t length)
{
    bool logarithm = same_word("plog", name, length);
    if (!logarithm && !same_word("aq", name, length))
        return false;
    read_arguments(r, 0, logarithm ? 1 : 2);
    apply(r, logarithm ? TN_OP_ABSOLUTE : TN_OP_SQUARE, 1);
    if (r->status == TN_OK)
        tn_formula_number(r->out, 1);
    apply(r, TN_OP_ADD, 2);
    apply(r, logarithm ? TN_OP_LOGARITHM : TN_OP_ROOT, 1);
    if (!logarithm)
        apply(r, TN_OP_DIVIDE, 2);
    return true;
}

/* np.where(c, a, b) is c a + (not c) b, where c is 1 or 0. The condition's code stands there twice. */
static bool read_choice(reader *r, const char *name, size_t length)
{
    if (!same_word("np.where", name, length))
        return false;
    size_t begin = r->out->size, end;
    read_expression(r);
    apply(r, TN_OP_IS_NOT, 1);
    end = r->out->size;
    apply(r, TN_OP_IS_NOT, 1);
    if (!take(r, ','))
        refuse(r, "a function needs another argument");
    read_expression(r);
    apply(r, TN_OP_MULTIPLY, 2);
    if (r->status == TN_OK && !tn_formula_repeat(r->out, begin, end, TN_SENTENCE_CODE))
        r->status = tn_fail(r->error, TN_LIMIT, E_EXPRESSION, "conditions of np.where nest too deep");
    if (!take(r, ','))
        refuse(r, "a function needs another argument");
    read_expression(r);
    apply(r, TN_OP_MULTIPLY, 2);
    apply(r, TN_OP_ADD, 2);
    if (!take(r, ')'))
        refuse(r, "a parenthesis is not closed");
    return true;
}

static void read_call(reader *r, const char *name, size_t length)
{
    const tn_operation *function = tn_function_named(TN_WORDS_PROTECTED, name, length);
    if (function) {
        read_arguments(r, 0, function->arity);
        apply(r, function->opcode, function->arity);
        return;
    }
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        if (same_word(aliases[i].word, name, length)) {
            read_arguments(r, 0, aliases[i].arity);
            apply(r, aliases[i].opcode, aliases[i].arity);
            return;
        }
    if (!read_composed(r, name, length) && !read_choice(r, name, length))
        refuse_function(r, name, length);
}

/* ---- variables */

static bool take_term(reader *r, const char *name, size_t length)
{
    for (size_t i = 0; i < r->name_count; i++)
        if (same_word(r->names[i], name, length)) {
            tn_formula_term(r->out, (uint32_t)i);
            return true;
        }
    return false;
}

/* A column by its number: x[:, 2], x.iloc[:, 2] or x[2], behind the bracket. */
static void read_column(reader *r)
{
    size_t column = 0, begin, digits = 0;
    char what[120];
    if (take(r, ':') && !take(r, ','))
        refuse(r, "expected a comma and a column's number here");
    take(r, ' ');
    for (begin = r->at; r->at < r->size && is_digit(r->text[r->at]) && digits < 6; r->at++, digits++)
        column = column * 10 + (size_t)(r->text[r->at] - '0');
    if (!digits) {
        refuse(r, "expected a column's number here");
        return;
    }
    if (!take(r, ']'))
        refuse(r, "a bracket is not closed");
    if (column < r->name_count) {
        tn_formula_term(r->out, (uint32_t)column);
        return;
    }
    r->at = begin;
    snprintf(what, sizeof what, "there is no column %zu: the data have %zu columns to compute with, from 0 on", column,
             r->name_count);
    refuse(r, what);
}

static void refuse_name(reader *r, size_t begin, const char *name, size_t length)
{
    char what[160];
    bool constants = same_word("c", name, length) && r->at < r->size && r->text[r->at] == '[';
    r->at = begin;
    if (constants)
        snprintf(what, sizeof what, "constants that are fitted afterwards, as `c[0]`, are not supported");
    else
        snprintf(what, sizeof what, "there is no variable `%.*s`", (int)(length < 60 ? length : 60), name);
    refuse(r, what);
}

/* A name goes on with a `.` where NumPy's or Pandas' do; a `-` in it is a sign where the whole is no name. */
static void read_name(reader *r)
{
    const char *name = r->text + r->at;
    size_t begin = r->at;
    bool dotted = r->size - begin > 3 && memcmp(name, "np.", 3) == 0;
    r->at += dotted ? 3 : 0;
    while (r->at < r->size && is_name(r->text[r->at]))
        r->at++;
    size_t length = r->at - begin;
    if (length == 1 && *name == 'x' && r->size - r->at > 6 && memcmp(r->text + r->at, ".iloc[", 6) == 0)
        r->at += 5;
    if (length == 1 && *name == 'x' && r->at < r->size && r->text[r->at] == '[') {
        r->at++;
        read_column(r);
        return;
    }
    const char *sign = memchr(name, '-', length);
    size_t before = sign ? (size_t)(sign - name) : length;
    if (take_term(r, name, length))
        return;
    if (sign && take_term(r, name, before)) {
        r->at = begin + before;
        return;
    }
    if (take(r, '(')) {
        read_call(r, name, length);
        return;
    }
    refuse_name(r, begin, name, before);
}

static bool take_both(reader *r, char first, char second)
{
    size_t before = r->at;
    if (take(r, first) && r->at < r->size && r->text[r->at] == second) {
        r->at++;
        return true;
    }
    r->at = before;
    return false;
}

static void nest(reader *r, void (*read)(reader *r))
{
    if (r->status != TN_OK)
        return;
    if (++r->nest > TN_SENTENCE_NEST) {
        r->status = tn_fail(r->error, TN_LIMIT, E_EXPRESSION, "the expression nests more than %u deep, the limit",
                            TN_SENTENCE_NEST);
        return;
    }
    read(r);
    r->nest--;
}

static void read_factor(reader *r);

static void read_simple(reader *r)
{
    if (take(r, '(')) {
        read_expression(r);
        if (!take(r, ')'))
            refuse(r, "a parenthesis is not closed");
    } else if (take(r, '~')) {
        read_factor(r);
        apply(r, TN_OP_IS_NOT, 1);
    } else if (take(r, '+')) {
        read_factor(r);
    } else if (r->at < r->size && (is_digit(r->text[r->at]) || r->text[r->at] == '.')) {
        read_number(r);
    } else if (r->at < r->size && is_name(r->text[r->at])) {
        read_name(r);
    } else {
        refuse(r,
               r->at == r->size ? "the expression ends too soon" : "expected a number, a name or a parenthesis here");
    }
}

/* A power is of what stands before it without its sign, and powers of powers are read from the right. */
static void read_factor(reader *r)
{
    if (take(r, '-')) {
        nest(r, read_factor);
        apply(r, TN_OP_NEGATE, 1);
        return;
    }
    nest(r, read_simple);
    if (take_both(r, '*', '*')) {
        nest(r, read_factor);
        apply(r, TN_OP_POWER, 2);
    }
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

/* ---- conditions, as NumPy has them: 1 or 0 */

static tn_opcode take_comparison(reader *r)
{
    static const struct {
        char first, second;
        tn_opcode opcode;
    } signs[] = {{'<', '=', TN_OP_IS_AT_MOST}, {'>', '=', TN_OP_IS_AT_LEAST}, {'=', '=', TN_OP_IS_EQUAL},
                 {'!', '=', TN_OP_IS_UNEQUAL}, {'<', '\0', TN_OP_IS_BELOW},   {'>', '\0', TN_OP_IS_ABOVE}};
    if (!memchr("<>=!", peek(r), 4)) /* as nearly always */
        return TN_OP_VALUE;
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (signs[i].second ? take_both(r, signs[i].first, signs[i].second) : take(r, signs[i].first))
            return signs[i].opcode;
    return TN_OP_VALUE;
}

static void read_conjunction(reader *r)
{
    read_sum(r);
    while (r->status == TN_OK && take(r, '&')) {
        read_sum(r);
        apply(r, TN_OP_IS_BOTH, 2);
    }
}

static void read_disjunction(reader *r)
{
    read_conjunction(r);
    while (r->status == TN_OK && take(r, '|')) {
        read_conjunction(r);
        apply(r, TN_OP_IS_EITHER, 2);
    }
}

/* In Python `&` and `|` bind closer than comparisons do. */
static void read_expression(reader *r)
{
    read_disjunction(r);
    tn_opcode compares = r->status == TN_OK ? take_comparison(r) : TN_OP_VALUE;
    if (compares == TN_OP_VALUE)
        return;
    read_disjunction(r);
    apply(r, compares, 2);
}

tn_status tn_sentence_read(const char *text, size_t size, const char *const *names, size_t name_count,
                           tn_formula *formula, tn_error *error)
{
    reader r = {.text = text, .size = size, .names = names, .name_count = name_count, .out = formula, .error = error};
    tn_formula_begin(formula);
    read_expression(&r);
    take(&r, ' ');
    if (r.status == TN_OK && r.at < size)
        refuse(&r, "there is more after the end of the expression");
    return r.status == TN_OK ? tn_formula_end(formula, error) : r.status;
}
