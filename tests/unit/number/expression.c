/* The front that notations share: what the trees of expressions become, by their text and by their constructors, beside
 * the same by recursion; how far conditions are from holding; how deep they may be. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/common/expression.h"
#include "runtime/growth/model/system.h"
#include "runtime/load.h"
#include "runtime/number/run.h"
#include "tests/support/compile_file.h"
#include "tests/support/test_expression.h"

_Static_assert((int)TN_MEASURED_COUNT >= (int)TEST_TERMS, "test trees speak of what is measured");

static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
static const library_folders options = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};

/* ---- by their text */

static char *write_study(const test_expression *const *trees, size_t count)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fputs("rules \"square\"\n", out);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "fitness goal%zu = ", i);
        test_expression_write(trees[i], tn_names_MEASURED, out);
        fputc('\n', out);
    }
    fclose(out);
    return text;
}

static tn_module *compile(const char *text)
{
    tn_compilation c;
    tn_module *module;
    tn_error error;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    if (compile_text("t.study", text, strlen(text), &options, &c) != TN_OK)
        fail_msg("%s\n%s", c.diagnostics.count ? c.diagnostics.items[0].message : "", text);
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
    tn_compilation_clear(&c);
    return module;
}

static void test_studies(void **state)
{
    (void)state;
    enum { GOALS = 60 };
    test_random random = {.seed = 5};
    for (size_t round = 0; round < 60; round++) {
        test_expression *trees[GOALS];
        double terms[TEST_TERMS];
        for (size_t i = 0; i < GOALS; i++)
            trees[i] = test_expression_new(&random, 2 + (unsigned)(i % 5), false);
        char *text = write_study((const test_expression *const *)trees, GOALS);
        tn_module *module = compile(text);
        assert_int_equal(module->GOAL_count, GOALS);
        for (size_t i = 0; i < GOALS; i++)
            for (size_t point = 0; point < 20; point++) {
                for (size_t t = 0; t < TEST_TERMS; t++)
                    terms[t] = test_number(&random);
                double got = tn_number_run(
                           module->code, module->FUNCTION_records[module->GOAL_records[i].function].code_begin, terms),
                       wanted = test_expression_value(trees[i], terms, false);
                if (!test_same(got, wanted))
                    fail_msg("goal%zu is %a, not %a\n%s", i, got, wanted, text);
            }
        for (size_t i = 0; i < GOALS; i++)
            test_expression_free(trees[i]);
        tn_module_free(module);
        free(text);
    }
}

/* ---- by their constructors */

static tn_opcode opcode_of(const test_expression *e)
{
    for (size_t i = 0; i < TN_OPERATION_COUNT; i++)
        if (strcmp(tn_operations[i].word, e->text) == 0 && tn_operations[i].arity == e->count &&
            tn_operations[i].words != TN_WORDS_PROTECTED)
            return tn_operations[i].opcode;
    fail_msg("no operation %s", e->text);
    return TN_OPCODE_COUNT;
}

static tn_expression *build(tn_arena *arena, const test_expression *e)
{
    tn_span span = {0};
    if (e->kind == TEST_NUMBER)
        return tn_expression_number(arena, span, atof(e->text));
    if (e->kind == TEST_TERM) {
        tn_expression *name = tn_expression_name(arena, span, tn_names_MEASURED[e->term]);
        name->term = e->term;
        return name;
    }
    tn_expression *expression = tn_expression_of(arena, opcode_of(e), span, NULL, NULL, NULL);
    for (uint32_t i = 0; i < e->count; i++)
        tn_expression_add(expression, build(arena, e->operands[i]));
    return expression;
}

static void check_violation(const test_expression *tree, const tn_formula *value, const tn_formula *violation,
                            const double *terms, bool shares)
{
    double got = tn_number_run(violation->code, 0, terms),
           wanted = test_expression_violation(tree, terms, true, shares), truth = tn_number_run(value->code, 0, terms);
    if (!test_same(got, wanted)) {
        test_expression_write(tree, tn_names_MEASURED, stderr);
        fail_msg(" is %a from holding, not %a", got, wanted);
    }
    assert_true(isnan(truth) == isnan(got));
    assert_true(isnan(got) || got >= 0);
    assert_true(isnan(got) || (got == 0) == (truth != 0));
    assert_true(isnan(truth) || test_same(truth, test_expression_value(tree, terms, false)));
}

/* 0 where the condition holds and nowhere else, and what a direct recursion gives. */
static void test_violations(void **state)
{
    (void)state;
    tn_formula value = {0}, violation = {0};
    test_random random = {.seed = 6};
    for (size_t round = 0; round < 30000; round++) {
        tn_arena *arena = tn_arena_new();
        test_expression *tree = test_expression_new(&random, 2 + (unsigned)(round % 6), false);
        const tn_expression *expression = build(arena, tree);
        double terms[TEST_TERMS];
        assert_int_equal(tn_expression_code(expression, &value, NULL), TN_OK);
        assert_int_equal(tn_expression_violation(expression, round % 2, &violation, NULL), TN_OK);
        assert_true(value.depth <= expression->height && violation.depth <= expression->height + 1);
        for (size_t point = 0; point < 20; point++) {
            for (size_t t = 0; t < TEST_TERMS; t++)
                terms[t] = test_number(&random);
            check_violation(tree, &value, &violation, terms, round % 2);
        }
        test_expression_free(tree);
        tn_arena_free(arena);
    }
    tn_formula_clear(&value);
    tn_formula_clear(&violation);
}

/* ---- limits */

static uint32_t first_error(const char *open, size_t times, const char *middle, const char *close)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fputs("rules \"square\"\nfitness x = ", out);
    for (size_t i = 0; i < times; i++)
        fputs(open, out);
    fputs(middle, out);
    for (size_t i = 0; i < times; i++)
        fputs(close, out);
    fclose(out);
    tn_compilation c;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    tn_status status = compile_text("t.study", text, size, &options, &c);
    uint32_t code = status == TN_OK ? TN_CODE_NONE : c.diagnostics.items[0].code;
    if (status == TN_OK) { /* what compiles loads */
        tn_module *module;
        tn_error error;
        assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
        tn_module_free(module);
    }
    tn_compilation_clear(&c);
    free(text);
    return code;
}

static void test_limits(void **state)
{
    (void)state;
    assert_int_equal(first_error("abs(", 255, "size", ")"), TN_CODE_NONE);
    assert_int_equal(first_error("abs(", 256, "size", ")"), E_TOO_DEEP);
    assert_int_equal(first_error("(", 20000, "size", ")"), E_TOO_DEEP); /* than the parser goes */
    assert_int_equal(first_error("size + ", 255, "size", ""), TN_CODE_NONE);
    assert_int_equal(first_error("size + ", 256, "size", ""), E_TOO_DEEP);
    assert_int_equal(first_error("size + (", 253, "size", ")"), TN_CODE_NONE);
    assert_int_equal(first_error("size + (", 255, "size", ")"), E_TOO_DEEP);
    assert_int_equal(first_error("size in 1..(", 127, "size", ")"), TN_CODE_NONE);
    assert_int_equal(first_error("size in 1..(", 128, "size", ")"), E_TOO_DEEP);
    assert_int_equal(first_error("not ", 255, "size", ""), TN_CODE_NONE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_studies),
        cmocka_unit_test(test_violations),
        cmocka_unit_test(test_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
