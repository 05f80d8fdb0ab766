/* Evolution by several ranks: the run of one process, each sentence scored once, and the same failure for all. */
#include <math.h>
#include <stdatomic.h>

#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/problem.h"
#include "tests/support/test_grammar.h"
#include "tests/support/test_ranks.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"
#define RANKS 4u
#define STEPS 8
#define CASES 11u

typedef struct trial {
    int variant;
    tn_problem *problem;
    tn_grammar *grammar;
    atomic_ullong evaluated, errors_found;
    unsigned long long fails_at; /* the evaluation that fails; 0: none */
    int fails_before;            /* the step that one rank fails before */
    tn_evolution *evolutions[RANKS];
    tn_status status[RANKS];
    tn_error error[RANKS];
    int steps[RANKS];
} trial;

/* Two objectives, to have fronts, and messages. */
static tn_status evaluate(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                          char message[200], tn_error *error)
{
    trial *t = context;
    tn_evaluator inner = tn_problem_evaluator(t->problem);
    if (++t->evaluated == t->fails_at)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "at %llu", t->fails_at);
    if (size % 7 == 3) {
        score->state = TN_SCORE_FAILED;
        snprintf(message, 200, "of %zu", size);
        return TN_OK;
    }
    score->objectives[1] = (double)size;
    return inner.evaluate(inner.context, thread, sentence, size, score, message, error);
}

/* Many at once. */
static tn_status evaluate_many(void *context, unsigned thread, struct tn_individual *const *individuals, size_t count,
                               tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = evaluate(context, thread, individuals[i]->sentence, individuals[i]->sentence_size,
                          &individuals[i]->score, individuals[i]->message, error);
    return status;
}

/* How far letters are from those of a text. */
static tn_status evaluate_cases(void *context, unsigned thread, const char *sentence, size_t size, double *errors,
                                tn_error *error)
{
    trial *t = context;
    (void)thread, (void)error;
    t->errors_found++;
    for (size_t i = 0; i < CASES; i++)
        errors[i] = i < size ? fabs((double)sentence[i] - "hello world"[i]) : HUGE_VAL;
    return TN_OK;
}

static tn_evolution *evolution_of(trial *t, const tn_ranks *ranks)
{
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_evaluator evaluator = {.context = t, .objectives = 1 + t->variant % 2, .evaluate = evaluate};
    tn_evolution *evolution = NULL;
    settings.population = 61;
    settings.seed = 11;
    settings.threads = 1 + (ranks ? ranks->rank % 2 : 0);
    settings.ranks = ranks;
    settings.select.selection = t->variant % 2 ? TN_SELECT_NSGA2 : TN_SELECT_TOURNAMENT;
    settings.replacement = t->variant == 2 ? TN_REPLACE_STEADY : TN_REPLACE_GENERATION;
    if (t->variant >= 5) {
        evaluator.cases = CASES;
        evaluator.evaluate_cases = evaluate_cases;
        settings.select.selection = t->variant == 5 ? TN_SELECT_LEXICASE : TN_SELECT_EPSILON_LEXICASE;
    } else if (t->variant >= 3) {
        evaluator.evaluate_many = evaluate_many;
        evaluator.batch = 5;
    }
    return tn_evolution_new(t->grammar, &settings, &evaluator, &evolution, NULL) == TN_OK ? evolution : NULL;
}

static void breed(const tn_ranks *ranks, void *context)
{
    trial *t = context;
    unsigned r = ranks->rank;
    t->evolutions[r] = evolution_of(t, ranks);
    for (t->steps[r] = 0; t->steps[r] < STEPS && t->status[r] == TN_OK; t->steps[r]++)
        t->status[r] = tn_evolution_step(t->evolutions[r], &t->error[r]);
}

static void same_members(const tn_evolution *a, const tn_evolution *b)
{
    size_t na, nb;
    const tn_individual *const *ma = tn_evolution_members(a, &na), *const *mb = tn_evolution_members(b, &nb);
    assert_int_equal(na, nb);
    for (size_t i = 0; i < na; i++) {
        assert_int_equal(ma[i]->id, mb[i]->id);
        assert_string_equal(ma[i]->sentence, mb[i]->sentence);
        assert_int_equal(ma[i]->score.state, mb[i]->score.state);
        assert_memory_equal(ma[i]->score.objectives, mb[i]->score.objectives, sizeof ma[i]->score.objectives);
        assert_string_equal(ma[i]->message, mb[i]->message);
    }
}

static trial trial_of(int variant)
{
    trial t = {.variant = variant, .grammar = test_grammar_file(STDLIB "words.bnf")};
    assert_int_equal(tn_problem_match("hello world", &t.problem, NULL), TN_OK);
    return t;
}

static void clear(trial *t)
{
    for (unsigned r = 0; r < RANKS; r++)
        tn_evolution_free(t->evolutions[r]);
    tn_problem_free(t->problem);
    tn_grammar_free(t->grammar);
}

static void test_same_run(void **state)
{
    (void)state;
    for (int variant = 0; variant < 7; variant++) {
        trial t = trial_of(variant);
        tn_evolution *alone = evolution_of(&t, NULL);
        for (int g = 0; g < STEPS; g++)
            assert_int_equal(tn_evolution_step(alone, NULL), TN_OK);
        unsigned long long errors_found = t.errors_found;
        for (unsigned ranks = 2; ranks <= RANKS; ranks++) {
            t.evaluated = 0;
            t.errors_found = 0;
            test_ranks_run(ranks, breed, &t);
            for (unsigned r = 0; r < ranks; r++) {
                assert_int_equal(t.status[r], TN_OK);
                same_members(alone, t.evolutions[r]);
                tn_evolution_free(t.evolutions[r]);
                t.evolutions[r] = NULL;
            }
            assert_int_equal(t.evaluated, tn_evolution_stats(alone).evaluations); /* each sentence once */
            assert_int_equal(t.errors_found, errors_found);
        }
        tn_evolution_free(alone);
        clear(&t);
    }
}

static void test_same_failure(void **state)
{
    (void)state;
    trial t = trial_of(0);
    t.fails_at = 100;
    test_ranks_run(RANKS, breed, &t);
    for (unsigned r = 0; r < RANKS; r++) {
        assert_int_equal(t.status[r], TN_INTERNAL);
        assert_string_equal(t.error[r].message, "at 100");
        assert_int_equal(t.steps[r], t.steps[0]);
    }
    clear(&t);
}

/* Its own failure before a step, which the others hear of in that step. */
static void breed_late(const tn_ranks *ranks, void *context)
{
    trial *t = context;
    unsigned r = ranks->rank;
    t->evolutions[r] = evolution_of(t, ranks);
    for (t->steps[r] = 0; t->steps[r] < STEPS && t->status[r] == TN_OK; t->steps[r]++) {
        tn_status status = TN_OK;
        if (r == 2 && t->steps[r] == t->fails_before)
            status = tn_fail(&t->error[r], TN_IO, TN_CODE_NONE, "no room for generation %d", t->fails_before);
        t->status[r] = tn_evolution_step_after(t->evolutions[r], status, &t->error[r]);
    }
}

static void test_late_failure(void **state)
{
    (void)state;
    for (int variant = 0; variant < 7; variant++) {
        for (int before = 0; before < 3; before += 2) {
            trial t = trial_of(variant);
            char said[40];
            t.fails_before = before;
            snprintf(said, sizeof said, "no room for generation %d", before);
            test_ranks_run(RANKS, breed_late, &t);
            for (unsigned r = 0; r < RANKS; r++) {
                assert_int_equal(t.status[r], TN_IO);
                assert_string_equal(t.error[r].message, said);
                assert_int_equal(t.steps[r], before + 1);
            }
            clear(&t);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_run), cmocka_unit_test(test_same_failure),
                                       cmocka_unit_test(test_late_failure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
