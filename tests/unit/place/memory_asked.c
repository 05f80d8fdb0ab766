/* What a command line asks of placing, --fitness and --require, with each allocation failing once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/place/asked.h"
#include "tests/support/fail_each.h"

static tn_opened opened;

static int open_files(void **state)
{
    static const char grammar[] = "S -> 'PlaceBoundingBox(8,9,8)' T\n"
                                  "T -> 'FillRect(2,3,2)' 'Place(3005)' 'Move(0,-3,0)' T | 'Place(3024)'\n"
                                  "T ->\n";
    (void)state;
    return tn_open_bytes("own.pcfg", (const uint8_t *)grammar, sizeof grammar - 1, false, &opened) != TN_OK;
}

static int close_files(void **state)
{
    (void)state;
    tn_close(&opened);
    return 0;
}

static double value_of(void *context, const tn_placed_model *model, const char *const *ahead, size_t ahead_count)
{
    return tn_place_fitness_value(context, model, ahead, ahead_count);
}

/* Derives by a fitness: at most two bricks are placed, then plates have their turn. */
static tn_status place_by_fitness(const char *text)
{
    tn_place_rules rules;
    tn_place_fitness fitness = {.seen = 0};
    tn_placed_model model = {0};
    tn_place_fault fault;
    tn_error error;
    tn_status status = tn_place_rules_make(opened.module, &rules, &error);
    if (status == TN_OK)
        status = tn_place_fitness_make(&rules, text, &fitness);
    const tn_place_options options = {.value = value_of, .context = &fitness};
    if (status == TN_OK)
        status = tn_place_derive(&rules, &options, &model, &fault, &error);
    if (status == TN_OK) {
        assert_int_equal(model.count, 3);
        assert_string_equal(model.parts[2].name, "3024");
    }
    tn_placed_model_clear(&model);
    tn_place_fitness_clear(&fitness);
    tn_place_rules_clear(&rules);
    return status;
}

static tn_status by_fitness(void)
{
    return place_by_fitness("count(3005) <= 2");
}

/* A text with mistakes is an error, and never taken for another. */
static tn_status by_wrong_fitness(void)
{
    tn_status status = place_by_fitness("mass < 3");
    return status == TN_INVALID ? TN_OK : status == TN_OK ? TN_INVALID : status;
}

/* Holds a model of two parts to conditions, of which one fails. */
static tn_status require(void)
{
    static const char *const parts[] = {"3005", "3024"};
    tn_placed_part placed[] = {{.name = parts[0]}, {.name = parts[1]}};
    const tn_placed_model model = {.parts = placed, .count = 2};
    tn_placed_measures measured = {.terms = {[TN_PLACED_ELEMENTS] = 2}};
    tn_opened asked, told;
    tn_error error;
    uint32_t file;
    told = (tn_opened){.path = "model"};
    tn_diagnostics_init(&told.compilation.diagnostics, &told.compilation.sources);
    tn_status status = tn_sources_add(&told.compilation.sources, "model", "", 0, &file, &error);
    tn_status compiled = tn_kit_ask("--require", "elements = 2, count(3005) > 1", parts, 2, &asked);
    status = status == TN_OK ? compiled : status;
    if (status == TN_OK) {
        status = tn_kit_hold(&told, &asked, &model, &measured);
        if (status == TN_INVALID && !told.compilation.diagnostics.failed)
            assert_int_equal(told.compilation.diagnostics.error_count, 1);
        status = status == TN_INVALID ? TN_OK : status == TN_OK ? TN_INVALID : status;
    }
    tn_close(&asked);
    tn_close(&told);
    return status;
}

static void fitness(void **state)
{
    (void)state;
    fail_each(by_fitness, false);
}

static void wrong_fitness(void **state)
{
    (void)state;
    fail_each(by_wrong_fitness, true);
}

static void requirements(void **state)
{
    (void)state;
    fail_each(require, true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fitness), cmocka_unit_test(wrong_fitness),
                                       cmocka_unit_test(requirements)};
    return cmocka_run_group_tests_name("memory_asked", tests, open_files, close_files);
}
