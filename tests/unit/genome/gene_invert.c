/* Mapping backwards: map(invert(s)) = s for random sentences of all kinds of grammars, and clear answers where there is
 * no genome. */
#include "runtime/base/random.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/mapper.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"

/* Random genomes' sentences are inverted, and the new genome mapped; returns how many sentences there were. */
static size_t round_trips(const char *path, uint32_t max_depth, size_t genomes, size_t longest)
{
    tn_grammar *grammar = test_grammar_file(path);
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_genome genome = {0};
    uint64_t codons[100];
    size_t valid = 0;
    for (uint64_t i = 0; i < genomes; i++) {
        for (uint64_t k = 0; k < 100; k++)
            codons[k] = tn_random64(7, i, k);
        tn_mapping_options options = {.max_depth = max_depth, .repair = TN_REPAIR_OFF};
        tn_mapping mapping;
        tn_error error = {0};
        assert_int_equal(tn_mapper_derive(mapper, codons, 100, &options, &mapping, NULL), TN_OK);
        if (!mapping.valid || mapping.phenotype_size > longest)
            continue;
        char *sentence = strdup(mapping.phenotype);
        tn_invert_options inverting = {.max_depth = max_depth};
        if (tn_invert(grammar, sentence, mapping.phenotype_size, &inverting, &genome, &error) != TN_OK)
            fail_msg("%s: %s", sentence, error.message);
        assert_int_equal(tn_mapper_derive(mapper, genome.codons, genome.count, &options, &mapping, NULL), TN_OK);
        assert_true(mapping.valid);
        assert_string_equal(mapping.phenotype, sentence);
        assert_int_equal(mapping.used, genome.count);
        free(sentence);
        valid++;
    }
    tn_genome_clear(&genome);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
    return valid;
}

static void test_round_trips(void **state)
{
    (void)state;
    assert_true(round_trips(TARTAN_SOURCE_DIR "/tests/data/gene/tiny1.bnf", 0, 100, 60) > 50);
    assert_true(round_trips(TARTAN_SOURCE_DIR "/tests/data/gene/tiny2.bnf", 0, 100, 40) > 20);
    assert_true(round_trips(STDLIB "arithmetic.bnf", 0, 60, 200) > 20);
    assert_true(round_trips(STDLIB "arithmetic.bnf", 6, 100, 200) > 10);
    assert_true(round_trips(STDLIB "plan-rules.bnf", 0, 60, 400) > 20);
    assert_true(round_trips(STDLIB "words.bnf", 0, 40, 200) > 20);
    assert_true(round_trips(STDLIB "genr8.bnf", 10, 100, 400) > 50);
    assert_true(round_trips(STDLIB "genr8.bnf", 5, 100, 400) > 50);
    assert_true(round_trips(STDLIB "genr8-probabilistic.bnf", 10, 60, 400) > 20);
    assert_true(round_trips(STDLIB "genr8-symmetric.bnf", 10, 60, 400) > 20);
}

static void refused(tn_grammar *grammar, const char *sentence, uint32_t max_depth, const char *message, uint32_t column)
{
    tn_genome genome = {0};
    tn_error error = {0};
    tn_invert_options options = {.max_depth = max_depth};
    assert_int_equal(tn_invert(grammar, sentence, strlen(sentence), &options, &genome, &error), TN_INVALID);
    assert_int_equal(error.code, 1222);
    assert_string_equal(error.message, message);
    assert_int_equal(error.column, column);
    tn_genome_clear(&genome);
}

static void test_refusals(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("<e> ::= <e>+<e> | (<e>) | x\n");
    refused(g, "x+*x", 0, "the sentence cannot be derived: `*` does not fit here", 3);
    refused(g, "x+x)", 0, "the sentence cannot be derived: `)` does not fit here", 4);
    refused(g, "(x+x", 0, "the sentence cannot be derived: it ends too soon", 5);
    refused(g, "", 0, "the sentence cannot be derived: it ends too soon", 1);
    refused(g, "((x))", 3, "no genome gives this sentence within a depth of 3: its shallowest derivation needs 4", 0);
    tn_grammar_free(g);
    g = test_grammar_file(STDLIB "genr8.bnf");
    refused(g, "Edge0 + Edge4 + Edge0", 0, "no genome gives this sentence: Edge4 stands before there was an Edge2", 9);
    refused(g, "Edge0 + Edge1 + Edge2 + Edge3 ; Edge0 -> Edge1 ; Angle 31 ; BranchAngle 15", 0,
            "the sentence cannot be derived: `31` does not fit here", 56);
    tn_grammar_free(g);
}

/* Edge variables bind: the same letter is the same edge type. */
static void test_binding(void **state)
{
    (void)state;
    tn_grammar *g =
        test_grammar("%dialect genr8\n%repair off\n<s> ::= { EdgeX - } EdgeX EdgeY <t>\n<t> ::= EdgeX [ <t> ]\n");
    tn_genome genome = {0};
    tn_error error;
    tn_invert_options options = {0};
    const char *good = "Edge1 - Edge1 - Edge1 Edge0 Edge2 Edge0";
    assert_int_equal(tn_invert(g, good, strlen(good), &options, &genome, &error), TN_OK);
    const char *bad = "Edge1 - Edge0 - Edge1 Edge0 Edge2 Edge0";
    assert_int_equal(tn_invert(g, bad, strlen(bad), &options, &genome, &error), TN_INVALID);
    tn_genome_clear(&genome);
    tn_grammar_free(g);
}

/* Left recursion, hidden recursion, empty cycles and exponentially many derivations all end, within the limit of
 * states. */
static void test_hostile(void **state)
{
    (void)state;
    static const char *const grammars[] = {
        "<s> ::= <s><s> | \"\" | x\n",
        "<s> ::= <s> | <a> | x\n<a> ::= <s>\n",
        "<s> ::= <a><a><a><a>\n<a> ::= <s> | x | \"\"\n",
        "<s> ::= <b><s>x | x\n<b> ::= \"\" | <b><b>\n",
    };
    char sentence[65];
    memset(sentence, 'x', 64);
    sentence[64] = '\0';
    for (size_t i = 0; i < 4; i++) {
        tn_grammar *g = test_grammar(grammars[i]);
        tn_genome genome = {0};
        tn_error error;
        tn_invert_options options = {0};
        assert_int_equal(tn_invert(g, sentence, i == 1 ? 1 : 64, &options, &genome, &error), TN_OK);
        options.max_items = 10;
        tn_status status = tn_invert(g, sentence, i == 1 ? 1 : 64, &options, &genome, &error);
        assert_true(status == TN_LIMIT || i == 1);
        tn_genome_clear(&genome);
        tn_grammar_free(g);
    }
}

/* Few states, met very often. */
static void test_ambiguity_is_bounded(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("<s> ::= <s><s> | <s><s><s> | \"\" | x\n");
    char sentence[121];
    tn_genome genome = {0};
    tn_error error;
    memset(sentence, 'x', 120);
    tn_invert_options options = {.max_items = 38000};
    assert_int_equal(tn_invert(g, sentence, 120, &options, &genome, &error), TN_LIMIT);
    assert_non_null(strstr(error.message, "1216000 steps"));
    options.max_items = 76000;
    assert_int_equal(tn_invert(g, sentence, 120, &options, &genome, &error), TN_OK);
    tn_genome_clear(&genome);
    tn_grammar_free(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trips),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_binding),
        cmocka_unit_test(test_hostile),
        cmocka_unit_test(test_ambiguity_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
