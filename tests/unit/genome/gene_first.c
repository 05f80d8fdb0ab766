/* First generations: however they are made, their trees are as deep as the study's range says where the grammar has
 * such trees, and ramps are spread over it. Which depths a grammar has, counting its derivations says. */
#include "runtime/genome/breeding/evolve.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"
#define DEEPEST 24u

/* Even and odd depths apart, a long way round, what ends soon beside what goes on, and a rule that reaches few depths.
 */
static const char *const texts[] = {
    "<s> ::= <r>\n<r> ::= <r> and <r> | <b> | <r>\n<b> ::= p<i> > p<i> | p<i> < p<i>\n<i> ::= 0 | 1 | 2\n",
    "<a> ::= <b>x | <b>y\n<b> ::= <a>z | w\n",
    "<a> ::= <b>x | y | z\n<b> ::= <c>x\n<c> ::= <d>x\n<d> ::= <a>x\n",
    "<e> ::= <e><x> | <x><y>\n<x> ::= a | b | <y>\n<y> ::= c | d | e | f | g | h\n",
    "<a> ::= <b> | <c>\n<b> ::= x | y\n<c> ::= <d>\n<d> ::= <f>\n<f> ::= z\n",
};

static const char *const files[] = {STDLIB "arithmetic.bnf", STDLIB "words.bnf", STDLIB "plan-rules.bnf",
                                    STDLIB "kit-rules.bnf"};

#define TEXTS (sizeof texts / sizeof *texts)
#define GRAMMARS (TEXTS + sizeof files / sizeof *files)

static tn_grammar *grammar_of(size_t number)
{
    return number < TEXTS ? test_grammar(texts[number]) : test_grammar_file(files[number - TEXTS]);
}

/* has[d]: there are derivations of exactly d levels. */
static void count_depths(const tn_grammar *g, bool has[DEEPEST + 1])
{
    mpz_t up_to, before;
    mpz_inits(up_to, before, NULL);
    for (uint32_t depth = 1; depth <= DEEPEST; depth++) {
        bool by_codons;
        tn_status status = tn_count_derivations(g, depth, &by_codons, up_to, NULL);
        has[depth] = status == TN_LIMIT || mpz_cmp(up_to, before) > 0;
        mpz_set(before, up_to);
    }
    mpz_clears(up_to, before, NULL);
}

static void test_depths(void **state)
{
    (void)state;
    for (size_t number = 0; number < GRAMMARS; number++) {
        tn_grammar *g = grammar_of(number);
        tn_analysis analysis;
        tn_depths depths;
        bool has[DEEPEST + 1] = {false};
        count_depths(g, has);
        assert_int_equal(tn_analyse(g, &analysis, NULL), TN_OK);
        assert_int_equal(tn_depths_find(g, &analysis, DEEPEST, &depths, NULL), TN_OK);
        for (uint32_t depth = 1; depth <= DEEPEST; depth++)
            assert_int_equal(tn_depths_within(&depths, 0, depth, depth), has[depth]);
        assert_false(tn_depths_within(&depths, 0, DEEPEST + 1, DEEPEST + 100));
        tn_depths_clear(&depths);
        tn_analysis_clear(&analysis);
        tn_grammar_free(g);
    }
}

/* Groups are entered where that alone leads deep enough, and left out where they do not fit. */
static void test_depths_of_groups(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("%dialect genr8\n%repair off\n<s> ::= x [ <t> { <u> } ]\n<t> ::= <v>\n<u> ::= y <s>\n"
                                 "<v> ::= z\n");
    tn_analysis analysis;
    tn_depths depths;
    static const bool has[] = {false, true, false, true, false, true, false, true, false, true};
    assert_int_equal(tn_analyse(g, &analysis, NULL), TN_OK);
    assert_int_equal(tn_depths_find(g, &analysis, 9, &depths, NULL), TN_OK);
    for (uint32_t depth = 1; depth <= 9; depth++)
        assert_int_equal(tn_depths_within(&depths, 0, depth, depth), has[depth]);
    tn_depths_clear(&depths);
    tn_analysis_clear(&analysis);
    tn_grammar_free(g);
}

static tn_status score_nothing(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                               char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)message, (void)error;
    score->objectives[0] = 0;
    return TN_OK;
}

/* seen[d]: how many of a first generation of 180 have the depth d. */
static void make(const tn_grammar *g, tn_initialisation method, uint32_t low, uint32_t high, uint32_t seen[DEEPEST + 1])
{
    static const tn_evaluator evaluator = {.objectives = 1, .evaluate = score_nothing};
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_evolution *evolution;
    settings.population = 180;
    settings.initialisation = method;
    settings.depth_low = low;
    settings.depth_high = high;
    settings.mapping = tn_mapping_options_of(g);
    settings.vary.max_codons = 1000000;
    assert_int_equal(tn_evolution_new(g, &settings, &evaluator, &evolution, NULL), TN_OK);
    assert_int_equal(tn_evolution_step(evolution, NULL), TN_OK);
    size_t count;
    const tn_individual *const *members = tn_evolution_members(evolution, &count);
    for (size_t i = 0; i < count; i++) {
        assert_true(members[i]->sentence_size > 0);
        assert_true(members[i]->depth <= DEEPEST);
        seen[members[i]->depth]++;
    }
    tn_evolution_free(evolution);
}

static const tn_initialisation methods[] = {TN_INITIALISE_RAMPED, TN_INITIALISE_GROW, TN_INITIALISE_PI_GROW};

static void test_bounds(void **state)
{
    (void)state;
    static const uint32_t ranges[][2] = {{9, 10}, {6, 12}, {8, 8}, {5, 5}, {2, 10}};
    for (size_t number = 0; number < GRAMMARS; number++) {
        tn_grammar *g = grammar_of(number);
        bool has[DEEPEST + 1] = {false};
        count_depths(g, has);
        for (size_t range = 0; range < sizeof ranges / sizeof *ranges; range++) {
            uint32_t low = ranges[range][0], high = ranges[range][1];
            bool any = false;
            for (uint32_t depth = low; depth <= high; depth++)
                any |= has[depth];
            for (size_t method = 0; any && method < sizeof methods / sizeof *methods; method++) {
                uint32_t seen[DEEPEST + 1] = {0};
                make(g, methods[method], low, high, seen);
                for (uint32_t depth = 1; depth <= DEEPEST; depth++)
                    if (seen[depth] && (depth < low || depth > high || !has[depth]))
                        fail_msg("grammar %zu, method %d, depth %u..%u: %u of depth %u", number, (int)methods[method],
                                 low, high, seen[depth], depth);
            }
        }
        tn_grammar_free(g);
    }
}

/* Groups are entered for the depth's sake, and mapping ends trees at its own depth. */
static void test_bounds_of_groups(void **state)
{
    (void)state;
    static const char *const grammars[] = {STDLIB "genr8.bnf", STDLIB "genr8-example.bnf",
                                           STDLIB "genr8-probabilistic.bnf"};
    static const char option[] = "%dialect genr8\n%repair off\n%max-depth 30\n<s> ::= x [ <s> ] | y { <t> } | z\n"
                                 "<t> ::= x [ <s> ]\n";
    for (size_t number = 0; number < 4; number++) {
        tn_grammar *g = number < 3 ? test_grammar_file(grammars[number]) : test_grammar(option);
        for (size_t method = 0; method < sizeof methods / sizeof *methods; method++) {
            uint32_t seen[DEEPEST + 1] = {0};
            make(g, methods[method], 7, 9, seen);
            if (seen[7] + seen[8] + seen[9] != 180)
                fail_msg("grammar %zu, method %d: %u of 180", number, (int)methods[method],
                         seen[7] + seen[8] + seen[9]);
        }
        tn_grammar_free(g);
    }
}

/* Of each depth that the grammar has, PI grow makes an equal share; ramped half and half makes some of it, full. */
static void test_ramps(void **state)
{
    (void)state;
    for (size_t number = 0; number < GRAMMARS; number++) {
        tn_grammar *g = grammar_of(number);
        bool has[DEEPEST + 1] = {false};
        count_depths(g, has);
        bool all = true;
        for (uint32_t depth = 8; depth <= 12; depth++)
            all &= has[depth];
        for (size_t method = 0; all && method < 3; method += 2) {
            uint32_t seen[DEEPEST + 1] = {0};
            make(g, methods[method], 8, 12, seen);
            for (uint32_t depth = 8; depth <= 12; depth++)
                if (method == 2)
                    assert_int_equal(seen[depth], 36);
                else
                    assert_true(seen[depth] >= 9);
        }
        tn_grammar_free(g);
    }
}

/* Where no depth of the range is one that the grammar has, trees are as deep as it can. */
static void test_other_grammars(void **state)
{
    (void)state;
    for (size_t method = 0; method < sizeof methods / sizeof *methods; method++) {
        tn_grammar *g = test_grammar("<a> ::= <b> | x\n<b> ::= y | z\n");
        uint32_t seen[DEEPEST + 1] = {0};
        make(g, methods[method], 9, 10, seen);
        assert_int_equal(seen[2] + seen[3], 180);
        tn_grammar_free(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_depths), cmocka_unit_test(test_depths_of_groups),
        cmocka_unit_test(test_bounds), cmocka_unit_test(test_bounds_of_groups),
        cmocka_unit_test(test_ramps),  cmocka_unit_test(test_other_grammars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
