/* What is said of grammars without mapping: depths, recursion, growth, numbers of derivations. */
#include "runtime/genome/mapping/mapper.h"
#include "runtime/grammar/analysis.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"

static void test_depths(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("<s> ::= <a><b> | <c>\n<a> ::= x\n<b> ::= <a> | <s>\n<c> ::= <b>\n");
    tn_analysis a;
    assert_int_equal(tn_analyse(g, &a, NULL), TN_OK);
    static const uint32_t depths[] = {4, 2, 3, 4};
    static const uint8_t recursive[] = {1, 0, 1, 1};
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(a.rule_depth[i], depths[i]);
        assert_int_equal(a.recursive[i], recursive[i]);
    }
    tn_analysis_clear(&a);
    tn_grammar_free(g);
    g = test_grammar_file(STDLIB "genr8.bnf");
    assert_int_equal(tn_analyse(g, &a, NULL), TN_OK);
    assert_int_equal(a.rule_depth[0], 3);            /* start symbol, rewrite rule, predecessor */
    assert_true(a.growth > 0.69 && a.growth < 0.71); /* seven of ten productions of <Modifier> hold another */
    assert_string_equal(tn_rule_name(g, a.growing_rule), "<Modifier>");
    tn_analysis_clear(&a);
    tn_grammar_free(g);
}

static double growth_of(const char *text)
{
    tn_grammar *g = test_grammar(text);
    tn_analysis a;
    assert_int_equal(tn_analyse(g, &a, NULL), TN_OK);
    double growth = a.growth;
    tn_analysis_clear(&a);
    tn_grammar_free(g);
    return growth;
}

static void test_growth(void **state)
{
    (void)state;
    assert_true(growth_of("<s> ::= x\n") == 0);
    double even = growth_of("<e> ::= <e><e> | x\n");
    assert_true(even > 0.99 && even < 1.01);
    assert_true(growth_of("<e> ::= <e><e> | <e><e><e> | x\n") > 1.6);
    double swinging = growth_of("<a> ::= <b><b> | x\n<b> ::= <a> | y\n"); /* square root of 1 * 1/2 */
    assert_true(swinging > 0.70 && swinging < 0.72);
    double loop = growth_of("%dialect genr8\n%repair off\n<a> ::= { <a> } x\n");
    assert_true(loop > 0.71 && loop < 0.73);
}

static void count(const char *text, uint32_t depth, bool by_codons, const char *expected)
{
    tn_grammar *g = test_grammar(text);
    mpz_t total;
    bool codons;
    mpz_init(total);
    assert_int_equal(tn_count_derivations(g, depth, &codons, total, NULL), TN_OK);
    assert_int_equal(codons, by_codons);
    char *digits = mpz_get_str(NULL, 10, total);
    assert_string_equal(digits, expected);
    free(digits);
    mpz_clear(total);
    tn_grammar_free(g);
}

static void test_counts(void **state)
{
    (void)state;
    const char *tree = "<e> ::= <e><e> | x | y\n"; /* a(d) = a(d-1)^2 + 2 */
    count(tree, 1, false, "0");
    count(tree, 2, false, "2");
    count(tree, 3, false, "6");
    count(tree, 4, false, "38");
    count(tree, 5, false, "1446");
    count(tree, 9, false, "365338978906606237729724396156395693696687137202086");
    /* by codons: start symbol, then the loop's k rounds of one digit each and its k + 1 tests: 2^k ways with 2k + 2
     * codons */
    const char *loop = "%dialect genr8\n%repair off\n<s> ::= { <d> }\n<d> ::= 0 | 1\n";
    count(loop, 2, true, "1");
    count(loop, 3, true, "0");
    count(loop, 4, true, "2");
    count(loop, 6, true, "4");
    count(loop, 12, true, "32");
    const char *option = "%dialect genr8\n%repair off\n<s> ::= a [ <s> ] | b\n"; /* a(d) = 2 + a(d-1) */
    count(option, 1, false, "2");
    count(option, 5, false, "10");
}

static void test_number_limit(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("<e> ::= <e><e><e><e> | x | y\n");
    mpz_t total;
    bool codons;
    tn_error error;
    mpz_init(total);
    assert_int_equal(tn_count_derivations(g, 40, &codons, total, &error), TN_LIMIT);
    assert_int_equal(error.code, 1227);
    mpz_clear(total);
    tn_grammar_free(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_depths),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_number_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
