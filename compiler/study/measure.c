/* Fitness expressions of studies: their names looked up, their code emitted. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/study/study.h"
#include "runtime/base/nearest.h"

static const struct {
    const char *name;
    tn_opcode op;
} functions[] = {{"abs", TN_OP_ABSOLUTE}, {"sqrt", TN_OP_ROOT},       {"square", TN_OP_SQUARE}, {"min", TN_OP_LEAST},
                 {"max", TN_OP_MOST},     {"exp", TN_OP_EXPONENTIAL}, {"log", TN_OP_LOGARITHM}};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static tn_opcode function_named(const char *name)
{
    for (size_t i = 0; i < FUNCTIONS; i++)
        if (strcmp(functions[i].name, name) == 0)
            return functions[i].op;
    return TN_OPCODE_COUNT;
}

static uint32_t measured_named(const char *name)
{
    uint32_t term = 0;
    while (term < TN_MEASURED_COUNT && strcmp(tn_measured_names[term], name) != 0)
        term++;
    return term;
}

bool tn_measure_reserves(const char *name)
{
    return measured_named(name) < TN_MEASURED_COUNT || function_named(name) != TN_OPCODE_COUNT;
}

/* A `-` inside a name: was a minus meant? */
static bool is_difference(const char *name)
{
    char first[TN_NAME_MAX + 1];
    for (const char *minus = strchr(name, '-'); minus; minus = strchr(minus + 1, '-')) {
        size_t size = (size_t)(minus - name);
        snprintf(first, sizeof first, "%.*s", (int)(size < sizeof first ? size : 0), name);
        if (measured_named(first) < TN_MEASURED_COUNT)
            return true;
    }
    return false;
}

static void unknown_term(tn_diagnostics *diagnostics, const tn_study_measure *measure)
{
    tn_diagnostic *d =
        tn_report(diagnostics, E_UNKNOWN_TERM, measure->name_span, "there is no term `%.100s`", measure->name);
    const char *near = tn_nearest(measure->name, tn_measured_names, TN_MEASURED_COUNT);
    if (is_difference(measure->name))
        tn_help(diagnostics, d, "write a minus with blanks on both sides: names may hold `-`");
    else if (near)
        tn_suggest(diagnostics, d, "%s", near);
    else
        tn_help(diagnostics, d,
                "terms are size, smoothness, soft-boundary, subdivisions, symmetry, undulation, "
                "vertices, edges and faces");
}

static void unknown_function(tn_diagnostics *diagnostics, const tn_study_measure *measure)
{
    const char *names[FUNCTIONS];
    for (size_t i = 0; i < FUNCTIONS; i++)
        names[i] = functions[i].name;
    tn_diagnostic *d =
        tn_report(diagnostics, E_UNKNOWN_TERM, measure->name_span, "there is no function `%.100s`", measure->name);
    const char *near = tn_nearest(measure->name, names, FUNCTIONS);
    if (near)
        tn_suggest(diagnostics, d, "%s", near);
    else
        tn_help(diagnostics, d, "functions are abs, sqrt, square, min, max, exp and log");
}

static void check_function(tn_diagnostics *diagnostics, tn_study_measure *measure)
{
    measure->op = function_named(measure->name);
    if (measure->op == TN_OPCODE_COUNT) {
        unknown_function(diagnostics, measure);
        return;
    }
    uint32_t wanted = tn_opcode_describe((uint8_t)measure->op)->pops, given = measure->left->argument_count;
    if (wanted == given)
        return;
    tn_diagnostic *d = tn_report(diagnostics, E_MEASURE, measure->span, "`%s` takes %u argument%s, not %u",
                                 measure->name, wanted, wanted == 1 ? "" : "s", given);
    tn_help(diagnostics, d, wanted == 1 ? "as `%s(undulation)`" : "as `%s(undulation, size)`", measure->name);
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
static void check_node(tn_diagnostics *diagnostics, tn_study_measure *measure)
{
    if (!measure)
        return;
    if (measure->op == TN_OP_TERM) {
        measure->term = measured_named(measure->name);
        if (measure->term == TN_MEASURED_COUNT)
            unknown_term(diagnostics, measure);
    } else if (measure->op == TN_OPCODE_COUNT) {
        check_function(diagnostics, measure);
    }
    check_node(diagnostics, measure->left);
    check_node(diagnostics, measure->right);
}

void tn_check_measure(tn_diagnostics *diagnostics, tn_study_measure *measure)
{
    if (measure->depth <= TN_NESTING_MAX) {
        check_node(diagnostics, measure);
        return;
    }
    tn_diagnostic *d = tn_report(diagnostics, E_TOO_DEEP, measure->span,
                                 "the expression is nested more than %u deep, which is the limit", TN_NESTING_MAX);
    tn_help(diagnostics, d, "make two fitness terms of it: they are added up");
}

/* ---- emitting */

/* Returns how many numbers the stack holds at most. */
static uint32_t emit_node(tn_builder *builder, const tn_study_measure *measure)
{
    int64_t bits = 0;
    uint32_t left = measure->left ? emit_node(builder, measure->left) : 0,
             right = measure->right ? emit_node(builder, measure->right) + 1 : 0;
    if (measure->op == TN_OP_NUMBER)
        memcpy(&bits, &measure->number, sizeof bits);
    else
        bits = measure->term;
    tn_builder_emit(builder, measure->op, bits, 0);
    return left > right ? left : right > 0 ? right : 1;
}

uint32_t tn_emit_measure(tn_builder *builder, const char *name, const tn_study_measure *measure)
{
    tn_function_record record = {.name = tn_builder_string(builder, name), .kind = TN_FUNCTION_MEASURE};
    record.code_begin = tn_builder_offset(builder);
    record.stack_max = emit_node(builder, measure);
    tn_builder_emit(builder, TN_OP_VALUE, 0, 0);
    record.code_end = tn_builder_offset(builder);
    return tn_builder_add_FUNCTION(builder, &record);
}
