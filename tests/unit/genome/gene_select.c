/* The parts of evolution, each by itself: how often selection draws whom, how much mutation changes, that a sentence is
 * scored once, that what has no score is the worst and counted, elites and both kinds of replacement. */
#include <math.h>

#include "runtime/genome/breeding/evolve.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"

enum { MEMBERS = 10, DRAWS = 20000 };

/* How often each place of ten is drawn. Scores are 0 to 8, and the last has none. */
static void draw(tn_select_options options, size_t drawn[MEMBERS])
{
    static const double scores[MEMBERS][1] = {{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}, {8}, {HUGE_VAL}};
    tn_merit merits[MEMBERS];
    tn_chance chance = tn_chance_for(1, TN_PURPOSE_SELECT, 0, (uint64_t)options.selection);
    memset(drawn, 0, MEMBERS * sizeof *drawn);
    for (uint32_t i = 0; i < MEMBERS; i++)
        merits[i] = (tn_merit){.objectives = scores[i], .index = i};
    for (int i = 0; i < DRAWS; i++)
        drawn[tn_select(&options, &chance, merits, MEMBERS)]++;
}

/* Within five standard deviations of what is expected. */
static void is_about(size_t count, double share)
{
    double expected = share * DRAWS, slack = 5 * sqrt(DRAWS * share * (1 - share)) + 1;
    if (fabs((double)count - expected) > slack)
        fail_msg("drawn %zu times, not about %.0f", count, expected);
}

static void test_selection(void **state)
{
    (void)state;
    size_t drawn[MEMBERS];
    draw((tn_select_options){.selection = TN_SELECT_TOURNAMENT, .tournament = 3}, drawn);
    for (int i = 0; i < MEMBERS; i++) /* the best of three draws is i: all at i or behind, less all behind */
        is_about(drawn[i], (pow(MEMBERS - i, 3) - pow(MEMBERS - i - 1, 3)) / pow(MEMBERS, 3));
    draw((tn_select_options){.selection = TN_SELECT_NSGA2, .tournament = 2}, drawn);
    for (int i = 0; i < MEMBERS; i++)
        is_about(drawn[i], (pow(MEMBERS - i, 2) - pow(MEMBERS - i - 1, 2)) / pow(MEMBERS, 2));
    draw((tn_select_options){.selection = TN_SELECT_TRUNCATION, .truncation = 0.3}, drawn);
    for (int i = 0; i < MEMBERS; i++)
        is_about(drawn[i], i < 3 ? 1.0 / 3 : 0);
    draw((tn_select_options){.selection = TN_SELECT_ROULETTE}, drawn);
    for (int i = 0; i < MEMBERS; i++) /* how much better than the worst, and the hundredth part that it keeps itself */
        is_about(drawn[i], i == 9 ? 0 : (8 - i + 0.08) / (36 + 9 * 0.08));
}

/* ---- mutation */

typedef struct mutating {
    tn_grammar *grammar;
    tn_analysis analysis;
    tn_mapping_options mapping;
    tn_breeder *breeder;
} mutating;

static mutating begin(void)
{
    mutating m = {.grammar = test_grammar_file(STDLIB "words.bnf")};
    m.mapping = tn_mapping_options_of(m.grammar);
    assert_int_equal(tn_analyse(m.grammar, &m.analysis, NULL), TN_OK);
    m.breeder = tn_breeder_new(m.grammar, &m.analysis, &m.mapping);
    return m;
}

static void end(mutating *m)
{
    tn_breeder_free(m->breeder);
    tn_analysis_clear(&m->analysis);
    tn_grammar_free(m->grammar);
}

enum { LENGTH = 40, USED = 15 };

/* How many codons mutation changes in a genome of which only some are used; in all of it, and behind the used part. */
static size_t mutate(mutating *m, tn_vary_options options, uint64_t round, size_t *behind)
{
    uint64_t codons[LENGTH];
    for (uint64_t i = 0; i < LENGTH; i++)
        codons[i] = UINT64_MAX - i; /* nothing that mutation draws */
    tn_genome parent = {codons, LENGTH, LENGTH}, children[2] = {0}, *into[2] = {&children[0], &children[1]};
    tn_parent parents[2] = {{&parent, USED, 1}, {&parent, USED, 1}};
    tn_chance chance = tn_chance_for(4, TN_PURPOSE_BIRTH, 0, round);
    uint8_t kinds[2];
    size_t changed = 0;
    assert_int_equal(tn_breed(m->breeder, &options, &chance, parents, into, kinds, NULL), TN_OK);
    assert_int_equal(children[0].count, LENGTH);
    for (size_t i = 0; i < LENGTH; i++) {
        bool differs = children[0].codons[i] != codons[i];
        assert_true(!differs || children[0].codons[i] < options.codon_limit);
        changed += differs;
        *behind += differs && i >= USED;
    }
    assert_int_equal(kinds[0], changed ? TN_BIRTH_CLONE + TN_BIRTH_MUTATED : TN_BIRTH_CLONE);
    tn_genome_clear(&children[0]);
    tn_genome_clear(&children[1]);
    return changed;
}

static void test_mutation(void **state)
{
    (void)state;
    enum { ROUNDS = 2000 };
    mutating m = begin();
    tn_vary_options options = {.crossover_rate = 0, .codon_limit = 1000, .max_codons = 100, .tree_depth = 5};
    for (int within = 0; within < 2; within++) {
        size_t codons = 0, genome = 0, own = 0, behind = 0, part = within ? USED : LENGTH;
        options.within_used = within;
        for (uint64_t round = 0; round < ROUNDS; round++) {
            options.mutation = TN_MUTATE_CODONS;
            options.mutation_rate = 0.2;
            codons += mutate(&m, options, round, &behind);
            options.mutation_rate = -1; /* one a genome, on average */
            own += mutate(&m, options, round, &behind);
            options.mutation = TN_MUTATE_GENOME;
            options.mutation_rate = 3;
            size_t three = mutate(&m, options, round, &behind);
            assert_true(three >= 1 && three <= 3); /* a place may be drawn twice */
            genome += three;
        }
        assert_true(fabs((double)codons / ROUNDS - 0.2 * (double)part) < 0.3);
        assert_true(fabs((double)own / ROUNDS - 1) < 0.15);
        assert_true((double)genome / ROUNDS > 2.6);
        assert_true(within ? behind == 0 : behind > 1000);
    }
    end(&m);
}

/* ---- scores */

enum { SEEN_MAX = 4000 };

/* Remembers what it has scored; words that begin with a vowel fail, those with `b` pass a limit. */
typedef struct witness {
    char *seen[SEEN_MAX];
    size_t count;
} witness;

static tn_status observe(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                         char message[200], tn_error *error)
{
    witness *w = context;
    (void)thread, (void)error;
    for (size_t i = 0; i < w->count; i++)
        assert_string_not_equal(w->seen[i], sentence);
    assert_true(w->count < SEEN_MAX);
    w->seen[w->count++] = strdup(sentence);
    if (strchr("aeiou", sentence[0])) {
        score->state = TN_SCORE_FAILED;
        snprintf(message, 200, "a vowel");
    } else if (sentence[0] == 'b') {
        score->state = TN_SCORE_LIMIT;
    }
    score->objectives[0] = (double)size;
    return TN_OK;
}

static void count_states(const tn_evolution *e, uint32_t counts[TN_SCORE_STATE_COUNT])
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(e, &count);
    memset(counts, 0, TN_SCORE_STATE_COUNT * sizeof *counts);
    for (size_t i = 0; i < count; i++) {
        const tn_individual *one = members[i];
        counts[one->score.state]++;
        assert_true(one->score.state == TN_SCORED ? isfinite(one->score.objectives[0])
                                                  : one->score.objectives[0] == HUGE_VAL);
        assert_true(i == 0 || members[i - 1]->score.objectives[0] <= one->score.objectives[0]);
        assert_int_equal(one->score.state == TN_SCORE_NO_SENTENCE, one->reason != TN_MAPPING_VALID);
    }
}

static void breed(tn_replacement replacement, uint32_t elites)
{
    tn_grammar *grammar = test_grammar_file(STDLIB "words.bnf");
    witness w = {.count = 0};
    tn_evaluator evaluator = {.context = &w, .objectives = 1, .evaluate = observe};
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_evolution *e;
    uint32_t counts[TN_SCORE_STATE_COUNT], failed = 0, limited = 0, lost = 0;
    settings.population = 40;
    settings.initialisation = TN_INITIALISE_RANDOM;
    settings.codons = 12; /* too few for many a word */
    settings.threads = 1;
    settings.replacement = replacement;
    settings.elites = elites;
    assert_int_equal(tn_evolution_new(grammar, &settings, &evaluator, &e, NULL), TN_OK);
    for (int g = 0; g < 12; g++) {
        uint64_t best[3] = {0};
        size_t count, kept = 0, old = 0;
        const tn_individual *const *members = tn_evolution_members(e, &count);
        for (size_t i = 0; g && i < elites; i++)
            best[i] = members[i]->id;
        assert_int_equal(tn_evolution_step(e, NULL), TN_OK);
        tn_generation_stats s = tn_evolution_stats(e);
        members = tn_evolution_members(e, &count);
        assert_int_equal(count, 40);
        for (size_t i = 0; i < count; i++) {
            old += members[i]->id < (uint64_t)g * 40;
            for (size_t k = 0; g && k < elites; k++)
                kept += members[i]->id == best[k];
        }
        assert_true(g == 0 || kept == elites || replacement == TN_REPLACE_STEADY);
        assert_true(g == 0 || replacement == TN_REPLACE_STEADY || old == elites);
        count_states(e, counts);
        assert_int_equal(counts[TN_SCORED], s.scored);
        assert_int_equal(counts[TN_SCORE_FAILED], s.failed);
        assert_int_equal(counts[TN_SCORE_LIMIT], s.limited);
        assert_int_equal(counts[TN_SCORE_NO_SENTENCE], s.no_sentence);
        failed += s.failed;
        limited += s.limited;
        lost += s.no_sentence;
        assert_int_equal(s.evaluations, w.count); /* each sentence once, in all generations */
    }
    assert_true(failed > 0 && lost > 0 && limited > 0);
    tn_evolution_free(e);
    tn_grammar_free(grammar);
    for (size_t i = 0; i < w.count; i++)
        free(w.seen[i]);
}

static void test_generations(void **state)
{
    (void)state;
    breed(TN_REPLACE_GENERATION, 0);
    breed(TN_REPLACE_GENERATION, 3);
    breed(TN_REPLACE_STEADY, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_selection),
        cmocka_unit_test(test_mutation),
        cmocka_unit_test(test_generations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
