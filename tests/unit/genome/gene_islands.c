/* Islands: parents are chosen within an island, the best move to the next one in the generations that are said, and the
 * run is the same with any number of threads. */
#include <math.h>

#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/problem.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"
#define ISLANDS 5u
#define SIZE 12u
#define POPULATION (ISLANDS * SIZE)

typedef struct trial {
    tn_grammar *grammar;
    tn_problem *problem;
    tn_evaluator evaluator;
    tn_evolution_settings settings;
} trial;

/* A second objective, to have fronts. */
static tn_status match_and_length(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                                  char message[200], tn_error *error)
{
    tn_evaluator inner = tn_problem_evaluator(context);
    score->objectives[1] = (double)size;
    return inner.evaluate(context, thread, sentence, size, score, message, error);
}

/* 0: generations; 1: two objectives; 2: steady. */
static trial trial_of(int variant)
{
    trial t = {.grammar = test_grammar_file(STDLIB "words.bnf"), .settings = tn_evolution_settings_default()};
    assert_int_equal(tn_problem_match("hello islands", &t.problem, NULL), TN_OK);
    t.evaluator = tn_problem_evaluator(t.problem);
    t.settings.population = POPULATION;
    t.settings.islands = ISLANDS;
    t.settings.seed = 3;
    t.settings.elites = 1;
    if (variant == 1) {
        t.evaluator.objectives = 2;
        t.evaluator.evaluate = match_and_length;
        t.settings.select.selection = TN_SELECT_NSGA2;
    }
    t.settings.replacement = variant == 2 ? TN_REPLACE_STEADY : TN_REPLACE_GENERATION;
    return t;
}

static void clear(trial *t)
{
    tn_problem_free(t->problem);
    tn_grammar_free(t->grammar);
}

static tn_evolution *begin(trial *t, unsigned threads)
{
    tn_evolution *evolution;
    t->settings.threads = threads;
    assert_int_equal(tn_evolution_new(t->grammar, &t->settings, &t->evaluator, &evolution, NULL), TN_OK);
    return evolution;
}

/* The island that somebody was born on: those born in a generation are shared out evenly, in their order. */
static uint64_t birthplace(const trial *t, uint64_t id)
{
    bool elites = t->settings.replacement == TN_REPLACE_GENERATION && t->evaluator.objectives == 1 && id >= POPULATION;
    return id % POPULATION / (elites ? SIZE - t->settings.elites : SIZE);
}

/* Each island has its share of the members. Were the parents of those born last born on the same island, or at most
 * `moves` islands before it? Returns how many were not born on it. */
static size_t check_parents(const trial *t, const tn_evolution *e, uint64_t moves)
{
    size_t count, strangers = 0;
    const tn_individual *const *born = tn_evolution_born(e, &count);
    for (size_t i = 0; i < count; i++) {
        for (int p = 0; p < 2; p++) {
            uint64_t here = birthplace(t, born[i]->id), from = birthplace(t, born[i]->parents[p]);
            assert_true((here + ISLANDS - from) % ISLANDS <= moves);
            strangers += here != from;
        }
    }
    return strangers;
}

static void test_apart(void **state)
{
    (void)state;
    for (int variant = 0; variant < 3; variant++) {
        trial t = trial_of(variant);
        tn_evolution *e = begin(&t, 2); /* `every` is 0: nobody moves */
        assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
        for (int g = 0; g < 12; g++) {
            assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
            assert_int_equal(check_parents(&t, e, 0), 0);
        }
        tn_evolution_free(e);
        clear(&t);
    }
}

static void test_migrate(void **state)
{
    (void)state;
    for (int variant = 0; variant < 3; variant++) {
        trial t = trial_of(variant);
        t.settings.migrants = 2;
        t.settings.every = 3;
        tn_evolution *e = begin(&t, 1);
        size_t strangers = 0;
        assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
        for (uint64_t g = 1; g < 10; g++) {
            assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
            strangers += check_parents(&t, e, (g - 1) / 3);
            size_t count;
            tn_evolution_members(e, &count);
            assert_int_equal(count, POPULATION);
            assert_true(g > 3 || strangers == 0);
        }
        assert_true(strangers > 0);
        tn_evolution_free(e);
        clear(&t);
    }
}

static void test_order_and_threads(void **state)
{
    (void)state;
    for (int variant = 0; variant < 3; variant++) {
        trial t = trial_of(variant);
        t.settings.migrants = 1;
        t.settings.every = 2;
        tn_evolution *one = begin(&t, 1), *four = begin(&t, 4);
        for (int g = 0; g < 9; g++) {
            size_t n, m;
            assert_int_equal(tn_evolution_step(one, NULL), TN_OK);
            assert_int_equal(tn_evolution_step(four, NULL), TN_OK);
            const tn_individual *const *a = tn_evolution_members(one, &n), *const *b = tn_evolution_members(four, &m);
            assert_int_equal(n, m);
            for (size_t i = 0; i < n; i++) {
                assert_int_equal(a[i]->id, b[i]->id);
                assert_true(a[i]->member);
                assert_true(variant == 1 || i == 0 || a[i - 1]->score.objectives[0] <= a[i]->score.objectives[0]);
            }
        }
        tn_evolution_free(one);
        tn_evolution_free(four);
        clear(&t);
    }
}

static void test_refused(void **state)
{
    (void)state;
    trial t = trial_of(0);
    tn_evolution *e;
    tn_error error;
    const uint32_t wrong[][3] = {{61, 5, 1}, {60, 60, 1}, {60, 5, 12}}; /* population, islands, migrants */
    for (size_t i = 0; i < 3; i++) {
        t.settings.population = wrong[i][0];
        t.settings.islands = wrong[i][1];
        t.settings.migrants = wrong[i][2];
        t.settings.every = 1;
        assert_int_equal(tn_evolution_new(t.grammar, &t.settings, &t.evaluator, &e, &error), TN_INVALID);
        assert_int_equal(error.code, E_POPULATION);
    }
    t.settings.population = 60;
    t.settings.islands = 5;
    t.settings.migrants = 1;
    e = begin(&t, 1);
    assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
    assert_int_equal(tn_evolution_choose(e, &(tn_chosen){.number = 0, .weight = 1}, 1, &error), TN_INVALID);
    tn_evolution_free(e);
    clear(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_apart), cmocka_unit_test(test_migrate),
                                       cmocka_unit_test(test_order_and_threads), cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
