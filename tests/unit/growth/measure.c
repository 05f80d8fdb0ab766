/* Fitness expressions: what their code gives, beside the same in C, and modules whose code no compiler would make. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/growth/study.h"
#include "runtime/load.h"
#include "runtime/math/elementary.h"
#include "runtime/mesh/openmesh.h"
#include "runtime/module/builder.h"
#include "tests/support/compile_file.h"

static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
static const library_folders options = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};
static const tn_fitness
    flat = {.size = 8, .smoothness = 0, .subdivisions = 0.5, .symmetry = 1, .vertices = 9, .edges = 12, .faces = 4},
    hilly = {.size = 8,
             .smoothness = 30,
             .soft_boundary_nodes = 3,
             .subdivisions = 0.6,
             .symmetry = 0.25,
             .undulation = 2,
             .vertices = 90,
             .edges = 120,
             .faces = 31};

static tn_module *compile(const char *text)
{
    tn_compilation c;
    tn_module *module;
    tn_error error;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    assert_int_equal(compile_text("t.study", text, strlen(text), &options, &c), TN_OK);
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
    tn_compilation_clear(&c);
    return module;
}

static double value_of(const char *expression, const tn_fitness *fitness)
{
    char text[800];
    tn_study study;
    tn_error error;
    snprintf(text, sizeof text, "rules \"square\"\nfitness x = %s", expression);
    tn_module *module = compile(text);
    assert_int_equal(tn_study_read(module, "t.study", &tn_openmesh_reader, &study, &error), TN_OK);
    assert_int_equal(study.goal.named_count, 1);
    assert_string_equal(study.goal.named[0].name, "x");
    double value = tn_named_value(&study.goal.named[0], fitness);
    tn_study_clear(&study);
    tn_module_free(module);
    return value;
}

static void is(const char *expression, double wanted)
{
    double got = value_of(expression, &hilly);
    if (!(got == wanted))
        fail_msg("%s is %.17g, not %.17g", expression, got, wanted);
}

static void test_values(void **state)
{
    (void)state;
    is("size", 8);
    is("smoothness + soft-boundary", 33);
    is("subdivisions * symmetry", 0.6 * 0.25);
    is("vertices - edges + faces", 1);
    is("undulation / size", 0.25);
    is("2 - 3 - 4", -5);
    is("2 + 3 * 4", 14);
    is("(2 + 3) * 4", 20);
    is("12 / 2 / 3", 2);
    is("- undulation * - 3", 6);
    is("-2.5e1", -25);
    is("1 -1", 0);
    is("abs(1 - size)", 7);
    is("sqrt(square(undulation) + 12)", 4);
    is("min(size, 3) + max(size, 3)", 11);
    is("min(max(1, 2), max(3, 4)) - (5 - (6 - 7))", -4);
    is("exp(undulation)", tn_exp(2));
    is("log(size)", tn_log(8));
    is("sin(size) + cos(size) + tanh(size)", tn_sin(8) + tn_cos(8) + tn_tanh(8));
}

static void test_conditions(void **state)
{
    (void)state;
    is("faces < 31", 0);
    is("faces <= 31", 1);
    is("faces = 31", 1);
    is("faces != 31", 0);
    is("faces >= 31", 1);
    is("faces > 31", 0);
    is("faces in 30..31", 1);
    is("faces in 31 .. 40 - 9", 1);
    is("faces in -1..30", 0);
    is("not faces in 1..30", 1);
    is("size = 8 and undulation = 2", 1);
    is("size = 8 AND undulation = 3", 0);
    is("size = 9 or undulation = 2", 1);
    is("size = 9 or size = 8 and not undulation = 2", 0);
    is("(size > 2) + (size > 3) * 10", 11);
    is("2 * size < 3 + 14", 1);
    is("not 0", 1);
    is("undulation", 2);
}

static void test_what_has_no_value(void **state)
{
    (void)state;
    static const char *const none[] = {"size / undulation",  "0 / undulation",           "sqrt(undulation - 1)",
                                       "log(undulation)",    "max(0 / undulation, 1)",   "min(1, 0 / undulation)",
                                       "0 / undulation < 1", "not (0 / undulation = 1)", "0 / undulation in 1..2",
                                       "1 or 0 / undulation"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_false(isfinite(value_of(none[i], &flat)));
}

static void test_they_are_goals_like_others(void **state)
{
    (void)state;
    tn_study study;
    tn_error error;
    tn_module *module = compile("rules \"square\"\nfitness slope = undulation / size target 0.5 weight 4\n"
                                "fitness size target 10 weight 2\nfitness cells = faces target 62");
    assert_int_equal(tn_study_read(module, "t.study", &tn_openmesh_reader, &study, &error), TN_OK);
    double slope = 4 * (0.25 / 1), size = 2 * (2.0 / 10), cells = 31.0 / 62;
    assert_true(tn_fitness_part(&hilly, &study.goal, TN_TERM_SIZE, 1) == size);
    assert_true(tn_fitness_part(&hilly, &study.goal, TN_FITNESS_TERM_COUNT, 1) == slope);
    assert_true(fabs(tn_fitness_total(&hilly, &study.goal, 1) - (slope + size + cells)) < 1e-12);
    study.goal.raw = true;
    assert_true(fabs(tn_fitness_total(&hilly, &study.goal, 1) - (4 * 0.25 + 2 * 8 + 31)) < 1e-12);
    tn_study_clear(&study);
    tn_module_free(module);
}

/* Every byte of an expression's code changed to every value: refused, or run without harm. */
static void test_changed_code(void **state)
{
    (void)state;
    static const char text[] = "rules \"square\"\nfitness x = max(undulation / 2.5, - size) - 1";
    tn_compilation c;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    assert_int_equal(compile_text("t.study", text, strlen(text), &options, &c), TN_OK);
    tn_module *module;
    tn_error error;
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
    uint8_t *place = memmem(c.module, c.module_size, module->code, module->code_size);
    size_t code_size = module->code_size, refused = 0;
    tn_module_free(module);
    assert_non_null(place);
    for (size_t i = 0; i < code_size; i++) {
        uint8_t before = place[i];
        for (unsigned byte = 0; byte < 256; byte++) {
            place[i] = (uint8_t)byte;
            tn_module_rehash(c.module, c.module_size);
            if (tn_module_load(c.module, c.module_size, NULL, &module, &error) != TN_OK) {
                refused++;
                continue;
            }
            tn_study study;
            if (tn_study_read(module, "t.study", &tn_openmesh_reader, &study, &error) == TN_OK)
                tn_named_value(&study.goal.named[0], &hilly);
            tn_study_clear(&study);
            tn_module_free(module);
        }
        place[i] = before;
    }
    assert_true(refused > 1000);
    tn_compilation_clear(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_conditions),
        cmocka_unit_test(test_what_has_no_value),
        cmocka_unit_test(test_they_are_goals_like_others),
        cmocka_unit_test(test_changed_code),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
