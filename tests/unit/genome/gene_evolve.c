/* Evolution: the same run whatever the number of threads, runs replayed from their scores, and that it gets better. */
#include <math.h>

#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/problem.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"

/* ---- runs */

typedef struct setup {
    tn_grammar *grammar;
    tn_problem *problem;
    tn_evaluator evaluator;
    tn_evolution_settings settings;
} setup;

/* A second objective, to have fronts: the sentence's length. */
static tn_status match_and_length(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                                  char message[200], tn_error *error)
{
    tn_evaluator inner = tn_problem_evaluator(context);
    score->objectives[1] = (double)size;
    return inner.evaluate(context, thread, sentence, size, score, message, error);
}

/* How far the first letters are from those wanted. */
static tn_status letters(void *context, unsigned thread, const char *sentence, size_t size, double *errors,
                         tn_error *error)
{
    (void)context, (void)thread, (void)error;
    for (size_t i = 0; i < 11; i++)
        errors[i] = i < size ? abs(sentence[i] - "hello world"[i]) : 99;
    return TN_OK;
}

static setup prepare(int variant)
{
    setup s = {.grammar = test_grammar_file(STDLIB "words.bnf"), .settings = tn_evolution_settings_default()};
    assert_int_equal(tn_problem_match("hello world", &s.problem, NULL), TN_OK);
    s.evaluator = tn_problem_evaluator(s.problem);
    s.settings.population = 61;
    s.settings.seed = 11;
    s.settings.initialisation = (tn_initialisation)(variant % TN_INITIALISE_COUNT);
    s.settings.vary.crossover = (tn_crossover)(variant % TN_CROSS_COUNT);
    s.settings.vary.mutation = (tn_mutation)(variant % TN_MUTATE_COUNT);
    s.settings.select.selection = (tn_selection)(variant % TN_SELECT_COUNT);
    s.settings.replacement = variant % 5 == 4 ? TN_REPLACE_STEADY : TN_REPLACE_GENERATION;
    if (s.settings.select.selection >= TN_SELECT_LEXICASE) {
        s.evaluator.cases = 11;
        s.evaluator.evaluate_cases = letters;
        s.settings.replacement = TN_REPLACE_GENERATION;
    }
    if (s.settings.select.selection == TN_SELECT_NSGA2) {
        s.evaluator.objectives = 2;
        s.evaluator.evaluate = match_and_length;
        s.settings.replacement = TN_REPLACE_GENERATION;
    }
    return s;
}

static void clear(setup *s)
{
    tn_problem_free(s->problem);
    tn_grammar_free(s->grammar);
}

static void same_members(const tn_evolution *a, const tn_evolution *b)
{
    size_t na, nb;
    const tn_individual *const *ma = tn_evolution_members(a, &na), *const *mb = tn_evolution_members(b, &nb);
    assert_int_equal(na, nb);
    for (size_t i = 0; i < na; i++) {
        assert_int_equal(ma[i]->id, mb[i]->id);
        assert_int_equal(ma[i]->parents[0], mb[i]->parents[0]);
        assert_int_equal(ma[i]->kind, mb[i]->kind);
        assert_int_equal(ma[i]->genome.count, mb[i]->genome.count);
        assert_memory_equal(ma[i]->genome.codons, mb[i]->genome.codons, ma[i]->genome.count * sizeof(uint64_t));
        assert_string_equal(ma[i]->sentence, mb[i]->sentence);
        assert_memory_equal(ma[i]->score.objectives, mb[i]->score.objectives, sizeof ma[i]->score.objectives);
    }
    tn_generation_stats sa = tn_evolution_stats(a), sb = tn_evolution_stats(b);
    assert_int_equal(sa.evaluations, sb.evaluations);
    assert_int_equal(sa.distinct, sb.distinct);
    assert_true(sa.mean == sb.mean);
}

static void test_threads(void **state)
{
    (void)state;
    for (int variant = 0; variant < 20; variant++) {
        setup s = prepare(variant);
        tn_evolution *one, *four;
        s.settings.threads = 1;
        assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &s.evaluator, &one, NULL), TN_OK);
        s.settings.threads = 4;
        assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &s.evaluator, &four, NULL), TN_OK);
        for (int g = 0; g < 12; g++) {
            assert_int_equal(tn_evolution_step(one, NULL), TN_OK);
            assert_int_equal(tn_evolution_step(four, NULL), TN_OK);
        }
        same_members(one, four);
        tn_evolution_free(one);
        tn_evolution_free(four);
        clear(&s);
    }
}

/* ---- copies */

/* How many members of twelve generations have the sentence of another one of theirs. */
static size_t count_copies(int variant, bool kept)
{
    setup s = prepare(variant);
    tn_evolution *evolution;
    size_t copies = 0;
    s.settings.keeps_copies = kept;
    s.settings.mapping.wraps = 2;
    assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &s.evaluator, &evolution, NULL), TN_OK);
    for (int g = 0; g < 12; g++) {
        assert_int_equal(tn_evolution_step(evolution, NULL), TN_OK);
        tn_generation_stats stats = tn_evolution_stats(evolution);
        copies += s.settings.population - stats.no_sentence - stats.distinct;
    }
    tn_evolution_free(evolution);
    clear(&s);
    return copies;
}

/* Of this grammar there are always others to be had, and mostly found; how parents are replaced or selected
 * makes no difference. */
static void test_copies(void **state)
{
    (void)state;
    for (int variant = 0; variant < 20; variant++) {
        size_t again = count_copies(variant, false), kept = count_copies(variant, true);
        if (again * 2 > kept + 6)
            fail_msg("variant %d: %zu copies, %zu where they are kept", variant, again, kept);
    }
}

/* A grammar without another sentence has copies, and is not tried without end. */
static void test_only_copies(void **state)
{
    (void)state;
    setup s = prepare(0);
    tn_grammar *one = test_grammar("<a> ::= <b> | <b>\n<b> ::= x\n");
    tn_evolution *evolution;
    assert_int_equal(tn_evolution_new(one, &s.settings, &s.evaluator, &evolution, NULL), TN_OK);
    for (int g = 0; g < 3; g++)
        assert_int_equal(tn_evolution_step(evolution, NULL), TN_OK);
    assert_int_equal(tn_evolution_stats(evolution).distinct, 1);
    assert_int_equal(tn_evolution_known(evolution), 1);
    tn_evolution_free(evolution);
    tn_grammar_free(one);
    clear(&s);
}

/* ---- replay: the same run with scores recalled and an evaluator that must not be asked */

typedef struct memory {
    tn_score *scores;
    size_t count;
} memory;

static bool recall(void *context, uint64_t id, tn_score *score)
{
    const memory *m = context;
    if (id >= m->count)
        return false;
    *score = m->scores[id];
    return true;
}

static tn_status never(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                       char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)score, (void)message;
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "asked");
}

static void test_replay(void **state)
{
    (void)state;
    for (int variant = 0; variant < 20; variant += 3) {
        setup s = prepare(variant);
        tn_evolution *first, *again;
        memory m = {calloc(61 * 10, sizeof(tn_score)), 0};
        assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &s.evaluator, &first, NULL), TN_OK);
        for (int g = 0; g < 10; g++) {
            assert_int_equal(tn_evolution_step(first, NULL), TN_OK);
            size_t born;
            const tn_individual *const *b = tn_evolution_born(first, &born);
            for (size_t i = 0; i < born; i++)
                m.scores[b[i]->id] = b[i]->score;
            m.count = (size_t)(g + 1) * 61;
        }
        tn_evaluator none = s.evaluator;
        none.evaluate = never;
        assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &none, &again, NULL), TN_OK);
        tn_evolution_recall(again, recall, &m);
        for (int g = 0; g < 10; g++)
            assert_int_equal(tn_evolution_step(again, NULL), TN_OK);
        same_members(first, again);
        assert_int_equal(tn_evolution_step(again, NULL), TN_INTERNAL); /* beyond what is known it does ask */
        tn_evolution_free(first);
        tn_evolution_free(again);
        free(m.scores);
        clear(&s);
    }
}

static void test_better(void **state)
{
    (void)state;
    setup s = prepare(0);
    tn_evolution *e;
    s.settings.population = 300;
    s.settings.initialisation = TN_INITIALISE_RAMPED;
    s.settings.vary.mutation = TN_MUTATE_CODONS;
    s.settings.select.tournament = 4;
    assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &s.evaluator, &e, NULL), TN_OK);
    assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
    double before = tn_evolution_stats(e).best[0], best = before;
    for (int g = 0; g < 60; g++) {
        assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
        double now = tn_evolution_stats(e).best[0];
        assert_true(now <= best); /* the elite stays */
        best = now;
    }
    assert_true(best < before / 2);
    tn_evolution_free(e);
    clear(&s);
}

static void test_choice(void **state)
{
    (void)state;
    setup s = prepare(0);
    tn_evolution *e;
    size_t count;
    assert_int_equal(tn_evolution_new(s.grammar, &s.settings, &s.evaluator, &e, NULL), TN_OK);
    assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
    const tn_individual *const *members = tn_evolution_members(e, &count);
    uint64_t a = members[4]->id, b = members[7]->id;
    const tn_chosen places[] = {{.number = 4, .weight = 1}, {.number = 7, .weight = 1}, {.number = 7, .weight = 1}},
                    beyond[] = {{.number = 61, .weight = 1}};
    assert_int_equal(tn_evolution_choose(e, beyond, 1, NULL), TN_INVALID);
    assert_int_equal(tn_evolution_choose(e, places, 3, NULL), TN_OK);
    assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
    const tn_individual *const *born = tn_evolution_born(e, &count);
    size_t of_b = 0;
    for (size_t i = 0; i < count; i++) {
        assert_true(born[i]->parents[0] == a || born[i]->parents[0] == b);
        of_b += born[i]->parents[0] == b;
    }
    assert_true(of_b > count / 2);
    tn_evolution_free(e);
    clear(&s);
}

static void test_nsga2(void **state)
{
    (void)state;
    const double values[][2] = {{1, 5}, {2, 3}, {4, 1}, {3, 4}, {4, 4}, {HUGE_VAL, HUGE_VAL}, {2, 3}};
    static const uint32_t fronts[] = {0, 0, 0, 1, 2, 3, 0};
    tn_merit merits[7];
    uint32_t scratch[21];
    for (uint32_t i = 0; i < 7; i++)
        merits[i] = (tn_merit){.objectives = values[i], .index = i};
    tn_nsga2(merits, 7, 2, scratch);
    for (size_t i = 0; i < 7; i++)
        assert_int_equal(merits[i].front, fronts[i]);
    assert_true(isinf(merits[0].room) && isinf(merits[2].room));
    tn_merit_sort(merits, 7);
    assert_int_equal(merits[6].index, 5);
}

/* Whoever is nearer to what is required dominates, whatever the objectives. */
static void test_constrained_domination(void **state)
{
    (void)state;
    const double values[][2] = {{1, 1}, {2, 2}, {9, 9}, {0, 0}, {8, 9}};
    static const double violations[] = {0.5, 0.25, 0, 0.25, 0};
    static const uint32_t fronts[] = {4, 3, 1, 2, 0};
    tn_merit merits[5];
    uint32_t scratch[15];
    for (uint32_t i = 0; i < 5; i++)
        merits[i] = (tn_merit){.objectives = values[i], .violation = violations[i], .index = i};
    tn_nsga2(merits, 5, 2, scratch);
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(merits[i].front, fronts[i]);
}

static void test_csv(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint32_t line, column;
    } wrong[] = {
        {"", 0, 0},       {"x,y\n", 0, 0},  {"x,y\n1\n", 2, 2},    {"x,y\n1,2,3\n", 2, 5}, {"x,y\n1,two\n", 2, 3},
        {"x,,y\n", 1, 3}, {"y\n1\n", 0, 0}, {"x,y\n1,inf\n", 2, 3}};
    static const tn_fit_options options = {.threads = 1};
    tn_problem *problem;
    tn_error error;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(tn_problem_fit_csv(wrong[i].text, strlen(wrong[i].text), &options, &problem, &error),
                         TN_INVALID);
        assert_int_equal(error.line, wrong[i].line);
        assert_int_equal(error.column, wrong[i].column);
    }
    const char *good = "a, b, sum\r\n1, 2, 3\r\n-1.5, 2.5e0, 1\r\n";
    assert_int_equal(tn_problem_fit_csv(good, strlen(good), &options, &problem, &error), TN_OK);
    tn_evaluator evaluator = tn_problem_evaluator(problem);
    tn_score score = {0};
    char message[200];
    assert_int_equal(evaluator.evaluate(evaluator.context, 0, "a + b", 5, &score, message, &error), TN_OK);
    assert_true(score.objectives[0] == 0);
    assert_int_equal(evaluator.evaluate(evaluator.context, 0, "a", 1, &score, message, &error), TN_OK);
    assert_true(score.objectives[0] > 2.2 && score.objectives[0] < 2.3);
    assert_int_equal(evaluator.evaluate(evaluator.context, 0, "a +", 3, &score, message, &error), TN_OK);
    assert_int_equal(score.state, TN_SCORE_FAILED);
    tn_problem_free(problem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_threads),     cmocka_unit_test(test_copies),
        cmocka_unit_test(test_only_copies), cmocka_unit_test(test_replay),
        cmocka_unit_test(test_better),      cmocka_unit_test(test_choice),
        cmocka_unit_test(test_nsga2),       cmocka_unit_test(test_constrained_domination),
        cmocka_unit_test(test_csv),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
