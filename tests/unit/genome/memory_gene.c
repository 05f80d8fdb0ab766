/* Mapping without memory: each allocation of an operation fails once, and then once together with all after it. The
 * operation says so, leaves nothing behind (the sanitized build would see it), and works again with what it failed on.
 */
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/tree.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"
#define CODONS 2000u

typedef struct trial {
    tn_grammar *grammar;
    uint64_t codons[CODONS];
    bool record, position_independent;
    tn_mapper *mapper; /* what the last mapping was made with */
} trial;

/* Does the operation; did it work? Where it did not, it has checked that it was told why. */
typedef bool (*operation)(trial *t);

static void expect_robust(operation operate, operation again, trial *t)
{
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            fail_allocation(number, all_after);
            bool worked = operate(t);
            bool reached = stop_failing() > number;
            assert_int_equal(worked, !reached);
            assert_true(again(t));
            if (!reached) {
                assert_true(number > 0); /* it allocates, or the test tests nothing */
                break;
            }
        }
    }
}

static bool said(tn_status status, const tn_error *error)
{
    if (status == TN_OK)
        return true;
    assert_int_equal(status, TN_MEMORY);
    assert_int_equal(error->code, 801);
    return false;
}

static trial trial_of(const char *path)
{
    trial t = {.grammar = test_grammar_file(path)};
    for (uint64_t i = 0; i < CODONS; i++)
        t.codons[i] = (i * i * 7919 + i * 13) % 1009;
    return t;
}

/* ---- mapping */

static bool map_again(trial *t)
{
    if (!t->mapper)
        return true; /* there was no memory for the mapper itself */
    tn_mapping_options options = tn_mapping_options_of(t->grammar);
    tn_mapping mapping;
    tn_error error = {0};
    options.record = t->record;
    options.position_independent = t->position_independent;
    if (!said(tn_mapper_derive(t->mapper, t->codons, CODONS, &options, &mapping, &error), &error))
        return false;
    size_t size;
    assert_true(mapping.valid);
    const char *sentence = tn_mapping_sentence(&mapping, &size);
    assert_int_equal(strlen(sentence), size);
    assert_int_equal(mapping.event_count > 0, t->record);
    return true;
}

static bool map_first(trial *t)
{
    tn_mapper_free(t->mapper);
    t->mapper = tn_mapper_new(t->grammar);
    return t->mapper && map_again(t);
}

static void expect_mapping_robust(const char *path, bool position_independent)
{
    trial t = trial_of(path);
    t.position_independent = position_independent;
    for (int record = 0; record < 2; record++) {
        t.record = record;
        expect_robust(map_first, map_again, &t);
    }
    tn_mapper_free(t.mapper);
    tn_grammar_free(t.grammar);
}

static void test_mapping(void **state)
{
    (void)state;
    expect_mapping_robust(STDLIB "genr8.bnf", false); /* with repair */
    expect_mapping_robust(STDLIB "genr8-symmetric.bnf", false);
    expect_mapping_robust(STDLIB "words.bnf", false);
    expect_mapping_robust(STDLIB "plan-rules.bnf", false);
    expect_mapping_robust(STDLIB "words.bnf", true);
    expect_mapping_robust(STDLIB "plan-rules.bnf", true);
}

/* ---- backwards */

static bool invert(trial *t)
{
    static const char sentence[] = "((x0 * x1) + sqrt((x2 - 0.25)))";
    tn_genome genome = {0};
    tn_invert_options options = {0};
    tn_error error = {0};
    bool worked = said(tn_invert(t->grammar, sentence, strlen(sentence), &options, &genome, &error), &error);
    assert_true(!worked || genome.count > 0);
    tn_genome_clear(&genome);
    return worked;
}

static void test_inverting(void **state)
{
    (void)state;
    trial t = trial_of(STDLIB "arithmetic.bnf");
    expect_robust(invert, invert, &t);
    tn_grammar_free(t.grammar);
}

/* ---- derivation trees */

static bool make_tree(trial *t)
{
    tn_mapping_options options = tn_mapping_options_of(t->grammar);
    tn_mapping mapping;
    tn_tree tree;
    tn_error error = {0};
    options.record = true;
    tn_mapper *mapper = tn_mapper_new(t->grammar);
    bool worked = mapper && said(tn_mapper_derive(mapper, t->codons, CODONS, &options, &mapping, &error), &error);
    if (worked) {
        worked = said(tn_tree_make(mapping.events, mapping.event_count, &tree, &error), &error);
        assert_true(!worked || tree.count > 1);
        tn_tree_clear(&tree);
    }
    tn_mapper_free(mapper);
    return worked;
}

static void test_trees(void **state)
{
    (void)state;
    trial t = trial_of(STDLIB "genr8.bnf");
    expect_robust(make_tree, make_tree, &t);
    tn_grammar_free(t.grammar);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mapping),
        cmocka_unit_test(test_inverting),
        cmocka_unit_test(test_trees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
