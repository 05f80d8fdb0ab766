/* The settings of an evolution: the table's words are the engine's numbers, and a module whose settings are not what a
 * study could say is refused. */
#include "runtime/genome/settings.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/problem.h"
#include "runtime/load.h"
#include "tests/support/test_grammar.h"

static void is_choice(tn_setting setting, const char *word, uint32_t number, uint32_t count)
{
    char name[32];
    const tn_setting_row *row = &tn_setting_rows[setting];
    assert_int_equal(tn_setting_choice(row, word), number);
    assert_int_equal(tn_setting_choice_count(row), count);
    tn_setting_choice_name(row, number, name);
    assert_string_equal(name, word);
}

static void test_choices_are_the_engines(void **state)
{
    (void)state;
    is_choice(TN_SET_INITIALISE, "random", TN_INITIALISE_RANDOM, TN_INITIALISE_COUNT);
    is_choice(TN_SET_INITIALISE, "ramped", TN_INITIALISE_RAMPED, TN_INITIALISE_COUNT);
    is_choice(TN_SET_INITIALISE, "grow", TN_INITIALISE_GROW, TN_INITIALISE_COUNT);
    is_choice(TN_SET_INITIALISE, "pi-grow", TN_INITIALISE_PI_GROW, TN_INITIALISE_COUNT);
    is_choice(TN_SET_SELECTION, "tournament", TN_SELECT_TOURNAMENT, TN_SELECT_COUNT);
    is_choice(TN_SET_SELECTION, "truncation", TN_SELECT_TRUNCATION, TN_SELECT_COUNT);
    is_choice(TN_SET_SELECTION, "roulette", TN_SELECT_ROULETTE, TN_SELECT_COUNT);
    is_choice(TN_SET_SELECTION, "nsga2", TN_SELECT_NSGA2, TN_SELECT_COUNT);
    is_choice(TN_SET_SELECTION, "lexicase", TN_SELECT_LEXICASE, TN_SELECT_COUNT);
    is_choice(TN_SET_SELECTION, "epsilon-lexicase", TN_SELECT_EPSILON_LEXICASE, TN_SELECT_COUNT);
    is_choice(TN_SET_ERROR, "rmse", TN_FIT_RMSE, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_ERROR, "mse", TN_FIT_MSE, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_ERROR, "mae", TN_FIT_MAE, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_ERROR, "r2", TN_FIT_R2, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_ERROR, "log-loss", TN_FIT_LOG_LOSS, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_ERROR, "accuracy", TN_FIT_ACCURACY, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_ERROR, "f1", TN_FIT_F1, TN_FIT_ERROR_COUNT);
    is_choice(TN_SET_CROSSOVER, "one-point", TN_CROSS_ONE_POINT, TN_CROSS_COUNT);
    is_choice(TN_SET_CROSSOVER, "fixed-one-point", TN_CROSS_FIXED_ONE_POINT, TN_CROSS_COUNT);
    is_choice(TN_SET_CROSSOVER, "two-point", TN_CROSS_TWO_POINT, TN_CROSS_COUNT);
    is_choice(TN_SET_CROSSOVER, "fixed-two-point", TN_CROSS_FIXED_TWO_POINT, TN_CROSS_COUNT);
    is_choice(TN_SET_CROSSOVER, "subtree", TN_CROSS_SUBTREE, TN_CROSS_COUNT);
    is_choice(TN_SET_MUTATION, "codons", TN_MUTATE_CODONS, TN_MUTATE_COUNT);
    is_choice(TN_SET_MUTATION, "genome", TN_MUTATE_GENOME, TN_MUTATE_COUNT);
    is_choice(TN_SET_MUTATION, "subtree", TN_MUTATE_SUBTREE, TN_MUTATE_COUNT);
    is_choice(TN_SET_REPLACEMENT, "generational", TN_REPLACE_GENERATION, TN_REPLACE_COUNT);
    is_choice(TN_SET_REPLACEMENT, "steady-state", TN_REPLACE_STEADY, TN_REPLACE_COUNT);
    assert_int_equal(tn_setting_choice(&tn_setting_rows[TN_SET_CROSSOVER], "Two-Point"), TN_CROSS_TWO_POINT);
    assert_int_equal(tn_setting_choice(&tn_setting_rows[TN_SET_CROSSOVER], "two"), UINT32_MAX);
}

/* What holds where a study says nothing is what the engine begins with. */
static void test_defaults_are_the_engines(void **state)
{
    (void)state;
    tn_evolution_study s;
    tn_evolution_settings e = tn_evolution_settings_default();
    tn_evolution_study_default(&s);
    assert_int_equal(s.of[TN_SET_POPULATION].first, e.population);
    assert_int_equal(s.of[TN_SET_INITIALISE].choice, e.initialisation);
    assert_int_equal(s.of[TN_SET_CODONS].first, e.codons);
    assert_int_equal(s.of[TN_SET_DEPTH].first, e.depth_low);
    assert_int_equal(s.of[TN_SET_DEPTH].second, e.depth_high);
    assert_true(s.of[TN_SET_TAIL].first == e.tail);
    assert_int_equal(s.of[TN_SET_SELECTION].choice, e.select.selection);
    assert_int_equal(s.of[TN_SET_SELECTION].second, e.select.tournament);
    assert_true(s.of[TN_SET_CROSSOVER].second == e.vary.crossover_rate);
    assert_true(s.of[TN_SET_MUTATION].second == e.vary.mutation_rate);
    assert_int_equal(s.of[TN_SET_CODON_LIMIT].first, e.vary.codon_limit);
    assert_int_equal(s.of[TN_SET_MAX_CODONS].first, e.vary.max_codons);
    assert_int_equal(s.of[TN_SET_ELITES].first, e.elites);
}

/* A module of a small grammar and of settings, and what loading it says. */
static void expect(const tn_setting_record *settings, size_t count, bool with_grammar, const char *reason)
{
    static const char grammar[] = "<a> ::= x | y\n";
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    tn_arena *arena = tn_arena_new();
    tn_builder *builder = tn_builder_new();
    tn_module *module = NULL;
    tn_error error = {0};
    uint8_t *bytes = NULL;
    uint32_t file;
    size_t size;
    tn_diagnostics_init(&diagnostics, &sources);
    assert_int_equal(tn_sources_add(&sources, "a.bnf", grammar, strlen(grammar), &file, &error), TN_OK);
    tn_builder_add_SOURCE(
        builder, &(tn_source_record){tn_builder_string(builder, "a.bnf"), tn_builder_string(builder, grammar)});
    if (with_grammar)
        assert_int_equal(tn_bnf_compile(&sources, file, NULL, &diagnostics, arena, builder, &error), TN_OK);
    for (size_t i = 0; i < count; i++) {
        tn_setting_record record = settings[i];
        record.text = record.text ? tn_builder_string(builder, "text") : 0;
        tn_builder_add_SETTING(builder, &record);
    }
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, &error), TN_OK);
    tn_status status = tn_module_load(bytes, size, NULL, &module, &error);
    if (reason ? !strstr(error.message, reason) : status != TN_OK)
        fail_msg("wanted \"%s\", got \"%s\"", reason ? reason : "", error.message);
    tn_module_free(module);
    free(bytes);
    tn_builder_free(builder);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    tn_arena_free(arena);
}

static void test_wrong_modules_are_refused(void **state)
{
    (void)state;
    static const char range[] = "unknown, out of order or out of range";
    tn_setting_record good[] = {{.setting = TN_SET_GRAMMAR, .written = 1, .text = 1},
                                {.setting = TN_SET_MATCH, .written = 1, .text = 1},
                                {.setting = TN_SET_POPULATION, .written = 1, .first = 20},
                                {.setting = TN_SET_DEPTH, .written = 1, .first = 2, .second = 5},
                                {.setting = TN_SET_SELECTION, .written = 2, .choice = 1, .second = 0.5},
                                {.setting = TN_SET_MAPPING, .written = 1}};
    enum { COUNT = sizeof good / sizeof *good };
    tn_setting_record bad[COUNT];
    expect(good, COUNT, true, NULL);
    expect(good, COUNT, false, "needs one grammar");
    expect(good + 1, COUNT - 1, true, "does not say which grammar");
#define REFUSED(index, assignment, reason)                                                                             \
    do {                                                                                                               \
        memcpy(bad, good, sizeof bad);                                                                                 \
        bad[index].assignment;                                                                                         \
        expect(bad, COUNT, true, reason);                                                                              \
    } while (0)
    REFUSED(0, text = 0, range);
    REFUSED(0, setting = TN_SET_MATCH, range);
    REFUSED(1, setting = TN_SET_GRAMMAR, range);
    REFUSED(4, setting = TN_SETTING_COUNT, range);
    REFUSED(2, first = 1, range);
    REFUSED(2, first = 20.5, range);
    REFUSED(2, written = 0, range);
    REFUSED(2, written = 2, range);
    REFUSED(3, second = 1, range);
    REFUSED(4, choice = TN_SELECT_COUNT, range);
    REFUSED(4, second = -1, range);
    REFUSED(4, second = 3, "takes the share of the best");
    REFUSED(4, choice = TN_SELECT_NSGA2, "weighs several objectives");
    REFUSED(5, choice = 1, "maps genomes otherwise than its grammar");
    REFUSED(5, choice = 2, range);
    REFUSED(2, begin = 3, "names a place outside its source");
#undef REFUSED
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_choices_are_the_engines),
        cmocka_unit_test(test_defaults_are_the_engines),
        cmocka_unit_test(test_wrong_modules_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
