/* Builds trees of expressions, looks their names up, and makes their code. */
#include "compiler/common/expression.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "runtime/base/nearest.h"
#include "runtime/module/code.h"
#include "runtime/number/run.h"

/* ---- trees */

static tn_expression *new_node(tn_arena *arena, tn_opcode op, tn_span span)
{
    tn_expression *expression = TN_NEW(arena, tn_expression);
    if (expression)
        *expression = (tn_expression){.op = op, .span = span, .depth = 1, .height = 1};
    return expression;
}

tn_expression *tn_expression_number(tn_arena *arena, tn_span span, double number)
{
    tn_expression *expression = new_node(arena, TN_OP_NUMBER, span);
    if (expression)
        expression->number = number;
    return expression;
}

tn_expression *tn_expression_name(tn_arena *arena, tn_span span, const char *name)
{
    tn_expression *expression = new_node(arena, TN_OP_TERM, span);
    if (expression) {
        expression->name = name;
        expression->name_span = span;
    }
    return expression;
}

tn_expression *tn_expression_call(tn_arena *arena, tn_span span, const char *name, tn_expression *first)
{
    tn_expression *expression = tn_expression_name(arena, span, name);
    if (expression)
        expression->op = TN_OPCODE_COUNT;
    tn_expression_add(expression, first);
    return expression;
}

tn_expression *tn_expression_of(tn_arena *arena, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b,
                                tn_expression *c)
{
    tn_expression *expression = new_node(arena, op, span);
    tn_expression_add(expression, a);
    tn_expression_add(expression, b);
    tn_expression_add(expression, c);
    return expression;
}

void tn_expression_add(tn_expression *expression, tn_expression *operand)
{
    if (!expression || !operand)
        return;
    uint32_t depth = operand->depth + 1, height = expression->operand_count + operand->height;
    expression->depth = depth > expression->depth ? depth : expression->depth;
    expression->height = height > expression->height ? height : expression->height;
    expression->operand_count++;
    TN_CHAIN(expression, operand);
}

/* ---- names */

static uint32_t term_named(const tn_expression_scope *scope, const char *name, size_t size)
{
    uint32_t term = 0;
    while (term < scope->count && (strlen(scope->names[term]) != size || memcmp(scope->names[term], name, size) != 0))
        term++;
    return term;
}

bool tn_expression_reserves(const tn_expression_scope *scope, const char *name)
{
    size_t size = strlen(name);
    return term_named(scope, name, size) < scope->count || tn_function_named(scope->words, name, size);
}

/* A `-` inside a name: was a minus meant? */
static bool is_difference(const tn_expression_scope *scope, const char *name)
{
    for (const char *minus = strchr(name, '-'); minus; minus = strchr(minus + 1, '-'))
        if (term_named(scope, name, (size_t)(minus - name)) < scope->count)
            return true;
    return false;
}

/* "did you mean `size`?", or all that there are. */
static void help_with_names(tn_diagnostics *diagnostics, tn_diagnostic *d, const char *wrong, const char *what,
                            const char *const *names, size_t count)
{
    char list[400];
    const char *near = tn_nearest(wrong, names, count);
    if (near) {
        tn_suggest(diagnostics, d, "%s", near);
        return;
    }
    tn_word_list(names, count, list, sizeof list);
    tn_help(diagnostics, d, "%ss are %s", what, list);
}

static void unknown_term(tn_diagnostics *diagnostics, const tn_expression_scope *scope, const tn_expression *e)
{
    tn_diagnostic *d =
        tn_report(diagnostics, scope->unknown, e->name_span, "there is no %s `%.100s`", scope->what, e->name);
    if (is_difference(scope, e->name))
        tn_help(diagnostics, d, "write a minus with blanks on both sides: names may hold `-`");
    else
        help_with_names(diagnostics, d, e->name, scope->what, scope->names, scope->count);
}

const char *tn_function_elsewhere(tn_words words, const char *name)
{
    static const struct { /* needs: what the text calls */
        const char *name, *needs, *text;
    } others[] = {
        {"asin", "atan2", "atan2(a, sqrt(1 - a * a))"},
        {"arcsin", "atan2", "atan2(a, sqrt(1 - a * a))"},
        {"acos", "atan2", "atan2(sqrt(1 - a * a), a)"},
        {"arccos", "atan2", "atan2(sqrt(1 - a * a), a)"},
        {"atan", "atan2", "atan2(a, 1)"},
        {"arctan", "atan2", "atan2(a, 1)"},
        {"sinh", "exp", "(exp(a) - exp(-a)) / 2"},
        {"cosh", "exp", "(exp(a) + exp(-a)) / 2"},
        {"ln", "log", "log(a)"},
        {"log10", "log", "log(a) / log(10)"},
        {"log2", "log", "log(a) / log(2)"},
        {"exp2", "pow", "pow(2, a)"},
        {"power", "pow", "pow(a, b)"},
        {"cbrt", "pow", "pow(a, 1 / 3)"},
        {"sqr", "square", "square(a)"},
        {"hypot", "square", "sqrt(square(a) + square(b))"},
        {"length", "square", "sqrt(square(a) + square(b))"},
        {"ceil", "floor", "-floor(-a)"},
        {"round", "floor", "floor(a + 0.5)"},
        {"fract", "floor", "a - floor(a)"},
        {"mod", "floor", "a % b"},
        {"fmod", "floor", "a % b"},
        {"lerp", "mix", "mix(a, b, c)"},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (strcmp(others[i].name, name) == 0)
            return tn_function_named(words, others[i].needs, strlen(others[i].needs)) ? others[i].text : "";
    }
    return NULL;
}

/* The word of the notation that is written as a function is and that this one was likely meant to be; or NULL. */
static const char *meant_word(const tn_expression_scope *scope, const char *name)
{
    enum { CALLS_MAX = 32 };
    const char *calls[CALLS_MAX];
    size_t count = !scope->vocabulary ? 0
                                      : tn_vocabulary_list(scope->vocabulary, scope->places, TN_AS_CALL | TN_AS_PREFIX,
                                                           calls, CALLS_MAX);
    return tn_nearest(name, calls, count);
}

static void unknown_function(tn_diagnostics *diagnostics, const tn_expression_scope *scope, const tn_expression *e)
{
    const char *names[TN_OPERATION_COUNT];
    tn_diagnostic *d = tn_report(diagnostics, scope->unknown, e->name_span, "there is no function `%.100s`", e->name);
    const char *meant = tn_function_elsewhere(scope->words, e->name), *word = meant_word(scope, e->name);
    if (word)
        tn_suggest(diagnostics, d, "%s", word);
    else if (meant && *meant)
        tn_help(diagnostics, d, "write `%s`", meant);
    else
        help_with_names(diagnostics, d, meant ? "" : e->name, "function", names,
                        tn_function_names(scope->words, names));
}

static void check_function(tn_diagnostics *diagnostics, const tn_expression_scope *scope, tn_expression *e)
{
    const tn_operation *function = tn_function_named(scope->words, e->name, strlen(e->name));
    if (!function) {
        unknown_function(diagnostics, scope, e);
        return;
    }
    e->op = function->opcode;
    if (function->arity == e->operand_count)
        return;
    tn_diagnostic *d = tn_report(diagnostics, scope->wrong, e->span, "`%s` takes %u argument%s, not %u", e->name,
                                 function->arity, function->arity == 1 ? "" : "s", e->operand_count);
    tn_help(diagnostics, d, "as `%s(%s)`", e->name, scope->examples[function->arity - 1]);
}

/* The value of an expression that is one number, whatever it is of. */
static bool constant(const tn_expression *e, double *number)
{
    bool negative = e->op == TN_OP_NEGATE && e->first && e->first->op == TN_OP_NUMBER;
    if (!negative && e->op != TN_OP_NUMBER)
        return false;
    *number = negative ? -e->first->number : e->number;
    return true;
}

/* `x in 3..1` */
static void check_range(tn_diagnostics *diagnostics, const tn_expression_scope *scope, const tn_expression *e)
{
    double low, high;
    if (e->operand_count != 3 || !constant(e->first->next, &low) || !constant(e->last, &high) || low <= high)
        return;
    tn_span span = tn_span_join(e->first->next->span, e->last->span);
    tn_diagnostic *d = tn_report(diagnostics, scope->wrong, span, "nothing lies between %.15g and %.15g", low, high);
    tn_advise(diagnostics, d, "%.15g..%.15g", high, low);
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
static void check_node(tn_diagnostics *diagnostics, const tn_expression_scope *scope, tn_expression *e)
{
    if (e->op == TN_OP_TERM) {
        e->term = term_named(scope, e->name, strlen(e->name));
        if (e->term == scope->count)
            unknown_term(diagnostics, scope, e);
    } else if (e->op == TN_OPCODE_COUNT) {
        check_function(diagnostics, scope, e);
    } else if (e->op == TN_OP_IS_BETWEEN) {
        check_range(diagnostics, scope, e);
    }
    for (tn_expression *operand = e->first; operand; operand = operand->next)
        check_node(diagnostics, scope, operand);
}

void tn_expression_check(tn_diagnostics *diagnostics, const tn_expression_scope *scope, tn_expression *expression)
{
    tn_diagnostic *d;
    if (expression->depth > TN_NESTING_MAX) {
        d = tn_report(diagnostics, E_TOO_DEEP, expression->span,
                      "the expression is nested more than %u deep, which is the limit", TN_NESTING_MAX);
        tn_help(diagnostics, d, "%s", scope->split);
        return;
    }
    if (expression->height >= TN_MEASURE_STACK_MAX) { /* a violation may hold one number more than the value does */
        d = tn_report(diagnostics, E_TOO_DEEP, expression->span,
                      "the expression holds more than %u numbers at once, which is the limit",
                      TN_MEASURE_STACK_MAX - 1);
        tn_help(diagnostics, d, "%s", scope->split);
        return;
    }
    check_node(diagnostics, scope, expression);
}

/* ---- code */

static void add_value(tn_formula *formula, const tn_expression *e)
{
    for (const tn_expression *operand = e->first; operand; operand = operand->next)
        add_value(formula, operand);
    if (e->op == TN_OP_NUMBER)
        tn_formula_number(formula, e->number);
    else if (e->op == TN_OP_TERM)
        tn_formula_term(formula, e->term);
    else
        tn_formula_operation(formula, e->op, e->operand_count);
}

tn_status tn_expression_code(const tn_expression *expression, tn_formula *formula, tn_error *error)
{
    tn_formula_begin(formula);
    add_value(formula, expression);
    return tn_formula_end(formula, error);
}

/* What says how far a comparison, and its opposite, is from holding. */
static const struct {
    tn_opcode comparison, holds, fails;
} shortfalls[] = {
    {TN_OP_IS_BELOW, TN_OP_SHORT_OF_BELOW, TN_OP_SHORT_OF_AT_LEAST},
    {TN_OP_IS_AT_MOST, TN_OP_SHORT_OF_AT_MOST, TN_OP_SHORT_OF_ABOVE},
    {TN_OP_IS_EQUAL, TN_OP_SHORT_OF_EQUAL, TN_OP_SHORT_OF_UNEQUAL},
    {TN_OP_IS_UNEQUAL, TN_OP_SHORT_OF_UNEQUAL, TN_OP_SHORT_OF_EQUAL},
    {TN_OP_IS_AT_LEAST, TN_OP_SHORT_OF_AT_LEAST, TN_OP_SHORT_OF_BELOW},
    {TN_OP_IS_ABOVE, TN_OP_SHORT_OF_ABOVE, TN_OP_SHORT_OF_AT_MOST},
    {TN_OP_IS_BETWEEN, TN_OP_SHORT_OF_BETWEEN, TN_OP_SHORT_OF_OUTSIDE},
};

bool tn_expression_is_condition(const tn_expression *expression)
{
    bool joins = expression->op == TN_OP_IS_BOTH || expression->op == TN_OP_IS_EITHER || expression->op == TN_OP_IS_NOT;
    for (const tn_expression *e = expression->first; joins && e; e = e->next)
        if (!tn_expression_is_condition(e))
            return false;
    for (size_t i = 0; !joins && i < sizeof shortfalls / sizeof *shortfalls; i++)
        joins = shortfalls[i].comparison == expression->op;
    return joins;
}

static bool names_a_term(const tn_expression *e)
{
    bool names = e->op == TN_OP_TERM;
    for (const tn_expression *operand = e->first; operand && !names; operand = operand->next)
        names = names_a_term(operand);
    return names;
}

#define UNIT_MOST 1e300 /* an endless distance stays endless, also as a share of an endless bound */

/* Divides the distance on the stack by the bound's size, or by 1 where that is smaller. */
static void add_share(tn_formula *formula, const tn_expression *bound)
{
    double number;
    if (constant(bound, &number)) {
        number = fmin(fmax(fabs(number), 1), UNIT_MOST);
        if (number == 1)
            return;
        tn_formula_number(formula, number);
    } else {
        add_value(formula, bound);
        tn_formula_operation(formula, TN_OP_ABSOLUTE, 1);
        tn_formula_number(formula, 1);
        tn_formula_operation(formula, TN_OP_MOST, 2);
        tn_formula_number(formula, UNIT_MOST);
        tn_formula_operation(formula, TN_OP_LEAST, 2);
    }
    tn_formula_operation(formula, TN_OP_DIVIDE, 2);
}

static void add_distance(tn_formula *formula, tn_opcode distance, const tn_expression *left, const tn_expression *right,
                         const tn_expression *bound)
{
    add_value(formula, left);
    add_value(formula, right);
    tn_formula_operation(formula, distance, 2);
    add_share(formula, bound);
}

/* Of two sides the bound is the right one, unless the left alone is a number, as in 25 <= angle. `a in b..c` is a >= b
 * and a <= c, so that each is a share of its own bound. */
static void add_shares(tn_formula *formula, const tn_expression *e, tn_opcode distance, bool wanted)
{
    const tn_expression *left = e->first, *right = left->next;
    if (e->op != TN_OP_IS_BETWEEN) {
        add_distance(formula, distance, left, right, names_a_term(right) && !names_a_term(left) ? left : right);
        return;
    }
    add_distance(formula, wanted ? TN_OP_SHORT_OF_AT_LEAST : TN_OP_SHORT_OF_BELOW, left, right, right);
    add_distance(formula, wanted ? TN_OP_SHORT_OF_AT_MOST : TN_OP_SHORT_OF_ABOVE, left, e->last, e->last);
    tn_formula_operation(formula, wanted ? TN_OP_ADD : TN_OP_LEAST, 2);
}

static void add_shortfall(tn_formula *formula, const tn_expression *e, bool wanted, bool shares)
{
    for (size_t i = 0; i < sizeof shortfalls / sizeof *shortfalls; i++) {
        if (shortfalls[i].comparison != e->op)
            continue;
        tn_opcode distance = wanted ? shortfalls[i].holds : shortfalls[i].fails;
        if (shares) {
            add_shares(formula, e, distance, wanted);
            return;
        }
        for (const tn_expression *operand = e->first; operand; operand = operand->next)
            add_value(formula, operand);
        tn_formula_operation(formula, distance, e->operand_count);
        return;
    }
    add_value(formula, e); /* no condition */
    tn_formula_number(formula, 0);
    tn_formula_operation(formula, wanted ? TN_OP_SHORT_OF_UNEQUAL : TN_OP_SHORT_OF_EQUAL, 2);
}

/* Of the expression, or of its opposite where it is not wanted. */
static void add_violation(tn_formula *formula, const tn_expression *e, bool wanted, bool shares)
{
    if (e->op == TN_OP_IS_NOT) {
        add_violation(formula, e->first, !wanted, shares);
    } else if (e->op == TN_OP_IS_BOTH || e->op == TN_OP_IS_EITHER) {
        add_violation(formula, e->first, wanted, shares);
        add_violation(formula, e->last, wanted, shares);
        tn_formula_operation(formula, (e->op == TN_OP_IS_BOTH) == wanted ? TN_OP_ADD : TN_OP_LEAST, 2);
    } else {
        add_shortfall(formula, e, wanted, shares);
    }
}

tn_status tn_expression_violation(const tn_expression *expression, bool shares, tn_formula *formula, tn_error *error)
{
    tn_formula_begin(formula);
    add_violation(formula, expression, true, shares);
    return tn_formula_end(formula, error);
}

uint32_t tn_formula_emit(tn_builder *builder, tn_function_kind kind, const char *name, const tn_formula *formula)
{
    tn_function_record record = {.name = tn_builder_string(builder, name), .kind = kind};
    record.code_begin = tn_builder_offset(builder);
    record.stack_max = formula->depth;
    tn_instruction instruction;
    for (uint32_t offset = 0; offset < formula->size; offset += instruction.length) {
        instruction = tn_code_read(formula->code, offset);
        tn_builder_emit(builder, instruction.opcode, instruction.first, instruction.second);
    }
    record.code_end = tn_builder_offset(builder);
    return tn_builder_add_FUNCTION(builder, &record);
}
