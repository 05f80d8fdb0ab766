/* Genomes and evolution through the C interface: mapping and inverting, a fitness of the caller's own, states saved and
 * restored, cancelling, callbacks that fail, and misuse. */
#include "include/tartan/tartan.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char grammar_text[] = "<s> ::= <d> | <d><s>\n<d> ::= \"0\" | \"1\" | \"2\" | \"3\"\n";

static tartan_module *compile(void)
{
    tartan_module *module = NULL;
    tartan_error error;
    if (tartan_compile_text("digits.bnf", grammar_text, sizeof grammar_text - 1, NULL, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return module;
}

/* ---- mapping */

static void maps_and_inverts(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_grammar *grammar = NULL;
    tartan_mapper *mapper = NULL;
    tartan_error error;
    assert_int_equal(tartan_grammar_new(module, &grammar, &error), TARTAN_OK);
    tartan_module_free(module); /* the grammar borrows nothing */
    assert_int_equal(tartan_mapper_new(grammar, &mapper, &error), TARTAN_OK);
    tartan_map_options options = tartan_map_options_init();
    tartan_mapping mapping = tartan_mapping_init();
    assert_int_equal(tartan_map_options_of(grammar, &options, &error), TARTAN_OK);
    options.derivation = true;
    static const uint64_t codons[] = {1, 2, 0, 7};
    assert_int_equal(tartan_map(mapper, codons, 4, &options, &mapping, &error), TARTAN_OK);
    assert_true(mapping.valid && mapping.used == 4);
    assert_string_equal(mapping.sentence, "23");
    const tartan_node *nodes;
    size_t count;
    assert_int_equal(tartan_mapper_nodes(mapper, &nodes, &count, &error), TARTAN_OK);
    assert_true(nodes[0].kind == TARTAN_NODE_RULE && nodes[0].parent == TARTAN_NONE && nodes[0].choice == 1);
    assert_true(nodes[0].text_size == 3 && nodes[0].text[1] == 's' && nodes[0].reads && nodes[0].codon == 1);
    assert_true(nodes[count - 1].kind == TARTAN_NODE_TERMINAL && nodes[count - 1].text[0] == '3');
    void *bytes;
    size_t size;
    assert_int_equal(tartan_derivation_draw(mapper, TARTAN_SVG, NULL, &bytes, &size, &error), TARTAN_OK);
    assert_memory_equal(bytes, "<?xml", 5);
    tartan_bytes_free(bytes);
    assert_int_equal(tartan_map(mapper, codons, 1, NULL, &mapping, &error), TARTAN_OK);
    assert_true(!mapping.valid && mapping.reason == TARTAN_MAP_OUT_OF_CODONS && mapping.sentence[0] == '\0');
    assert_int_equal(tartan_mapper_nodes(mapper, &nodes, &count, &error), TARTAN_INVALID);

    uint64_t *found;
    assert_int_equal(tartan_invert(grammar, "3102", 4, 0, NULL, &found, &count, &error), TARTAN_OK);
    assert_int_equal(tartan_map(mapper, found, count, NULL, &mapping, &error), TARTAN_OK);
    assert_string_equal(mapping.sentence, "3102");
    tartan_bytes_free(found);
    assert_int_equal(tartan_invert(grammar, "31x2", 4, 0, NULL, &found, &count, &error), TARTAN_INVALID);
    assert_int_equal(error.column, 3);
    char *derivations;
    bool by_codons = true;
    assert_int_equal(tartan_grammar_derivations(grammar, 4, &by_codons, &derivations, &error), TARTAN_OK);
    assert_false(by_codons);
    assert_int_equal(strspn(derivations, "0123456789"), strlen(derivations));
    tartan_text_free(derivations);
    tartan_mapper_free(mapper);
    tartan_grammar_free(grammar);
}

/* ---- a fitness */

typedef struct judge {
    atomic_size_t asked, calls, cases_asked;
    size_t most_at_once, fail_after; /* 0: never */
    tartan_status status;
    unsigned threads;
    bool worst; /* says of half of them that they cannot be scored, or that they are not a number */
} judge;

/* How far a sentence is from being "3210321032". */
static tartan_status score(void *context, unsigned thread, const tartan_sentence *sentences, size_t count,
                           tartan_score *scores, tartan_error *error)
{
    static const char wanted[] = "3210321032";
    judge *j = context;
    size_t asked = atomic_fetch_add(&j->asked, count) + count;
    j->calls++;
    if (thread >= j->threads || count == 0 || count > j->most_at_once)
        return TARTAN_INTERNAL;
    if (j->fail_after && asked > j->fail_after) {
        strcpy(error->message, "the judge is tired");
        return j->status;
    }
    for (size_t i = 0; i < count; i++) {
        const char *text = sentences[i].text;
        size_t length = strlen(wanted), size = sentences[i].size;
        scores[i].objectives[0] = fabs((double)size - (double)length);
        for (size_t k = 0; k < size && k < length; k++)
            scores[i].objectives[0] += text[k] != wanted[k];
        if (j->worst && size % 2)
            scores[i].state = TARTAN_SCORE_FAILED;
        else if (j->worst && size % 3 == 0)
            scores[i].objectives[0] = NAN;
    }
    return TARTAN_OK;
}

/* In each place: is the letter another one? */
static tartan_status score_places(void *context, unsigned thread, const tartan_sentence *sentence, double *errors,
                                  tartan_error *error)
{
    static const char wanted[] = "3210321032";
    judge *j = context;
    size_t asked = ++j->cases_asked;
    if (thread >= j->threads)
        return TARTAN_INTERNAL;
    if (j->fail_after && asked > j->fail_after) {
        strcpy(error->message, "the judge of places is tired");
        return j->status;
    }
    for (size_t k = 0; k < strlen(wanted); k++)
        errors[k] = k >= sentence->size ? NAN : sentence->text[k] == wanted[k] ? 0 : 1;
    return TARTAN_OK;
}

static tartan_evolution_options options_for(judge *j)
{
    tartan_evolution_options options = tartan_evolution_options_init();
    options.evaluate = score;
    options.context = j;
    options.population = 60;
    options.seed = 11;
    options.batch = 8;
    options.threads = j->threads = j->threads ? j->threads : 1;
    j->most_at_once = 8;
    return options;
}

static tartan_evolution *begin(const tartan_module *module, const tartan_evolution_options *options)
{
    tartan_evolution *evolution = NULL;
    tartan_error error;
    if (tartan_evolution_new(module, options, &evolution, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return evolution;
}

static void breed(tartan_evolution *evolution, uint32_t generations)
{
    tartan_error error;
    while (tartan_evolution_done(evolution) < generations)
        if (tartan_evolution_step(evolution, NULL, &error) != TARTAN_OK)
            fail_msg("%s", error.message);
}

static void assert_same(const tartan_evolution *a, const tartan_evolution *b)
{
    size_t count = tartan_evolution_members(a);
    assert_int_equal(tartan_evolution_members(b), count);
    for (size_t i = 0; i < count; i++) {
        tartan_individual one = tartan_individual_init(), two = tartan_individual_init();
        assert_int_equal(tartan_evolution_member(a, i, &one, NULL), TARTAN_OK);
        assert_int_equal(tartan_evolution_member(b, i, &two, NULL), TARTAN_OK);
        assert_int_equal(one.id, two.id);
        assert_string_equal(one.sentence, two.sentence);
        assert_int_equal(one.codon_count, two.codon_count);
        assert_memory_equal(one.codons, two.codons, one.codon_count * sizeof *one.codons);
        assert_memory_equal(one.objectives, two.objectives, sizeof one.objectives);
    }
}

static void breeds_the_same_however_it_is_done(void **state)
{
    (void)state;
    tartan_module *module = compile();
    judge alone = {0}, crowd = {.threads = 4}, after = {0};
    tartan_evolution_options options = options_for(&alone);
    tartan_evolution *one = begin(module, &options);
    tartan_evolution_options many = options_for(&crowd);
    many.batch = 3;
    tartan_evolution *four = begin(module, &many);
    breed(one, 15);
    breed(four, 15);
    assert_same(one, four);
    tartan_individual best = tartan_individual_init();
    tartan_generation now = tartan_generation_init();
    assert_int_equal(tartan_evolution_member(one, 0, &best, NULL), TARTAN_OK);
    assert_int_equal(tartan_evolution_generation(one, &now, NULL), TARTAN_OK);
    assert_true(now.number == 14 && now.best[0] == best.objectives[0] && best.objectives[0] < 5);
    assert_true(now.evaluations == alone.asked && alone.asked == crowd.asked && alone.calls < crowd.calls);

    /* saved in the middle, and chosen by a person before that */
    tartan_evolution_options again = options_for(&after);
    tartan_evolution *first = begin(module, &options), *second = begin(module, &options), *restored = NULL;
    tartan_evolution *both[] = {first, second};
    void *bytes;
    size_t size;
    for (size_t i = 0; i < 2; i++) {
        breed(both[i], 4);
        assert_int_equal(tartan_evolution_choose(both[i], (uint32_t[]){3, 5, 5}, 3, NULL), TARTAN_OK);
        breed(both[i], 6);
        assert_int_equal(tartan_evolution_choose(both[i], (uint32_t[]){1, 0}, 2, NULL), TARTAN_OK);
    }
    assert_int_equal(tartan_evolution_save(first, &bytes, &size, NULL), TARTAN_OK);
    assert_int_equal(tartan_evolution_restore(module, &again, bytes, size, &restored, NULL), TARTAN_OK);
    assert_int_equal(after.asked, 0); /* restoring evaluates nothing */
    assert_same(first, restored);
    breed(second, 10);
    breed(restored, 10);
    assert_same(second, restored);
    tartan_bytes_free(bytes);
    tartan_evolution_free(first);
    tartan_evolution_free(second);
    tartan_evolution_free(restored);
    tartan_evolution_free(one);
    tartan_evolution_free(four);
    tartan_module_free(module);
}

static void refuses_other_states(void **state)
{
    (void)state;
    tartan_module *module = compile();
    judge j = {0};
    tartan_evolution_options options = options_for(&j), other = options;
    tartan_evolution *evolution = begin(module, &options), *restored = NULL;
    tartan_error error;
    unsigned char *bytes;
    void *saved;
    size_t size;
    breed(evolution, 3);
    assert_int_equal(tartan_evolution_save(evolution, &saved, &size, NULL), TARTAN_OK);
    bytes = saved;
    other.seed = 12;
    assert_int_equal(tartan_evolution_restore(module, &other, bytes, size, &restored, &error), TARTAN_INVALID);
    assert_non_null(strstr(error.message, "other options"));
    for (size_t cut = 0; cut < size; cut += 97)
        assert_int_equal(tartan_evolution_restore(module, &options, bytes, cut, &restored, &error), TARTAN_INVALID);
    for (size_t at = 0; at < size; at += 61) {
        bytes[at] ^= 0x20;
        assert_int_equal(tartan_evolution_restore(module, &options, bytes, size, &restored, &error), TARTAN_INVALID);
        bytes[at] ^= 0x20;
    }
    assert_null(restored);
    tartan_bytes_free(saved);
    tartan_evolution_free(evolution);
    tartan_module_free(module);
}

static bool no_more(void *context, double done, double total)
{
    (void)done, (void)total;
    return --*(int *)context > 0;
}

/* A step that failed has changed nothing: afterwards all is as if it had never been. */
static void steps_fail_without_a_trace(void **state)
{
    (void)state;
    tartan_module *module = compile();
    for (unsigned threads = 1; threads <= 3; threads += 2) {
        judge good = {.threads = threads}, bad = {.threads = threads, .status = TARTAN_IO};
        tartan_evolution_options options = options_for(&good), failing = options_for(&bad);
        tartan_evolution *one = begin(module, &options), *two = begin(module, &failing);
        tartan_error error;
        breed(one, 8);
        breed(two, 4);
        bad.fail_after = bad.asked + 9; /* in the second batch of the step */
        assert_int_equal(tartan_evolution_step(two, NULL, &error), TARTAN_IO);
        assert_string_equal(error.message, "the judge is tired");
        assert_int_equal(tartan_evolution_done(two), 4);
        bad.status = (tartan_status)77;
        bad.fail_after = bad.asked + 9;
        assert_int_equal(tartan_evolution_step(two, NULL, NULL), TARTAN_INTERNAL);
        bad.fail_after = 0;
        int left = 1;
        tartan_watch watch = tartan_watch_init();
        watch.go_on = no_more;
        watch.context = &left;
        assert_int_equal(tartan_evolution_step(two, &watch, &error), TARTAN_STOPPED);
        breed(two, 8);
        assert_same(one, two);
        tartan_evolution_free(one);
        tartan_evolution_free(two);
    }
    tartan_module_free(module);
}

static void bears_with_bad_scores(void **state)
{
    (void)state;
    tartan_module *module = compile();
    judge j = {.worst = true};
    tartan_evolution_options options = options_for(&j);
    tartan_evolution *evolution = begin(module, &options);
    tartan_generation now = tartan_generation_init();
    breed(evolution, 6);
    assert_int_equal(tartan_evolution_generation(evolution, &now, NULL), TARTAN_OK);
    assert_int_equal(now.scored + now.failed + now.no_sentence + now.limited, 60);
    assert_true(isfinite(now.best[0]));
    tartan_evolution_free(evolution);
    tartan_module_free(module);
}

static void takes_a_study(void **state)
{
    (void)state;
    static const char text[] = "evolution {\n  grammar \"words.bnf\"\n  match \"flat\"\n  population 40\n  seed 5\n"
                               "  selection truncation 0.3\n  elites 0\n}\n";
    static const char *const folders[] = {"stdlib"};
    tartan_module *module = NULL;
    tartan_compile_options compiling = tartan_compile_options_init();
    tartan_evolution_options options = tartan_evolution_options_init();
    tartan_error error;
    compiling.folders = folders;
    compiling.folder_count = 1;
    if (tartan_compile_text("stdlib/x.study", text, sizeof text - 1, &compiling, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_true(tartan_module_has_study(module) && tartan_module_has_grammar(module));
    assert_int_equal(tartan_evolution_options_of(module, &options, &error), TARTAN_OK);
    assert_true(options.population == 40 && options.seed == 5 && options.no_elites);
    assert_true(options.selection == TARTAN_SELECT_TRUNCATION && options.truncation == 0.3);
    tartan_module_free(module);
}

static void selects_by_cases(void **state)
{
    (void)state;
    tartan_module *module = compile();
    static const tartan_selection selections[] = {TARTAN_SELECT_TOURNAMENT, TARTAN_SELECT_LEXICASE,
                                                  TARTAN_SELECT_EPSILON_LEXICASE};
    char sentences[3][64];
    for (size_t s = 0; s < 3; s++) {
        judge alone = {0}, crowd = {.threads = 4}, after = {0};
        tartan_evolution_options options = options_for(&alone), many = options_for(&crowd), again = options_for(&after);
        tartan_evolution_options *all[] = {&options, &many, &again};
        for (size_t i = 0; i < 3 && s > 0; i++) {
            all[i]->evaluate_cases = score_places;
            all[i]->cases = 10;
        }
        for (size_t i = 0; i < 3; i++)
            all[i]->selection = selections[s];
        tartan_evolution *one = begin(module, &options), *four = begin(module, &many), *restored = NULL;
        breed(one, 6);
        breed(four, 12);
        assert_true((alone.cases_asked > 0) == (s > 0));
        void *bytes;
        size_t size;
        assert_int_equal(tartan_evolution_save(one, &bytes, &size, NULL), TARTAN_OK);
        assert_int_equal(tartan_evolution_restore(module, &again, bytes, size, &restored, NULL), TARTAN_OK);
        assert_int_equal(after.asked, 0);
        assert_int_equal(after.cases_asked, 0); /* who the parents were is known */
        assert_same(one, restored);
        breed(one, 12);
        breed(restored, 12);
        assert_same(one, four);
        assert_same(restored, four);
        /* a failing callback leaves no trace */
        after.fail_after = after.cases_asked + 5;
        after.asked = 0;
        after.status = TARTAN_INVALID;
        tartan_error error = {0};
        if (s > 0) {
            assert_int_equal(tartan_evolution_step(restored, NULL, &error), TARTAN_INVALID);
            assert_string_equal(error.message, "the judge of places is tired");
        }
        after.fail_after = 0;
        breed(restored, 13);
        breed(four, 13);
        assert_same(restored, four);
        tartan_individual best = tartan_individual_init();
        assert_int_equal(tartan_evolution_member(one, 5, &best, NULL), TARTAN_OK);
        snprintf(sentences[s], sizeof sentences[s], "%s", best.sentence);
        tartan_bytes_free(bytes);
        tartan_evolution_free(one);
        tartan_evolution_free(four);
        tartan_evolution_free(restored);
    }
    assert_true(strcmp(sentences[0], sentences[1]) != 0 || strcmp(sentences[0], sentences[2]) != 0);

    /* what does not go together */
    judge j = {0};
    tartan_evolution *none = NULL;
    tartan_evolution_options wrong = options_for(&j);
    wrong.selection = TARTAN_SELECT_LEXICASE;
    assert_int_equal(tartan_evolution_new(module, &wrong, &none, NULL), TARTAN_INVALID); /* no errors in cases */
    wrong.evaluate_cases = score_places;
    assert_int_equal(tartan_evolution_new(module, &wrong, &none, NULL), TARTAN_INVALID); /* no cases */
    wrong.cases = 10;
    wrong.steady_state = true;
    assert_int_equal(tartan_evolution_new(module, &wrong, &none, NULL), TARTAN_INVALID);
    wrong.steady_state = false;
    wrong.selection = TARTAN_SELECT_TOURNAMENT;
    assert_int_equal(tartan_evolution_new(module, &wrong, &none, NULL), TARTAN_INVALID); /* nobody looks at cases */
    tartan_module_free(module);
}

static void maps_in_pairs(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_grammar *grammar = NULL;
    tartan_mapper *mapper = NULL;
    assert_int_equal(tartan_grammar_new(module, &grammar, NULL), TARTAN_OK);
    assert_int_equal(tartan_mapper_new(grammar, &mapper, NULL), TARTAN_OK);
    tartan_map_options options = tartan_map_options_init();
    tartan_mapping mapping = tartan_mapping_init();
    assert_int_equal(tartan_map_options_of(grammar, &options, NULL), TARTAN_OK);
    assert_false(options.position_independent);
    options.position_independent = true;
    static const uint64_t codons[] = {0, 1, 1, 0, 1, 3, 0, 2}; /* <d><s>, then the <s>, its <d>, and the first <d> */
    assert_int_equal(tartan_map(mapper, codons, 8, &options, &mapping, NULL), TARTAN_OK);
    assert_true(mapping.valid && mapping.used == 8);
    assert_string_equal(mapping.sentence, "23");

    judge one = {0}, four = {.threads = 4};
    tartan_evolution_options alone = options_for(&one), many = options_for(&four);
    alone.mapping = many.mapping = &options;
    tartan_evolution *first = begin(module, &alone), *second = begin(module, &many), *restored = NULL;
    breed(first, 8);
    breed(second, 8);
    assert_same(first, second);
    void *bytes;
    size_t size;
    assert_int_equal(tartan_evolution_save(first, &bytes, &size, NULL), TARTAN_OK);
    assert_int_equal(tartan_evolution_restore(module, &alone, bytes, size, &restored, NULL), TARTAN_OK);
    assert_same(first, restored);
    alone.mapping = NULL;
    tartan_evolution *other = NULL;
    assert_int_equal(tartan_evolution_restore(module, &alone, bytes, size, &other, NULL), TARTAN_INVALID);
    tartan_bytes_free(bytes);
    tartan_evolution_free(first);
    tartan_evolution_free(second);
    tartan_evolution_free(restored);
    tartan_mapper_free(mapper);
    tartan_grammar_free(grammar);
    tartan_module_free(module);
}

static void refuses_misuse(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_evolution *evolution = NULL;
    tartan_error error;
    judge j = {0};
    tartan_evolution_options options = options_for(&j), wrong = {0};
    assert_int_equal(tartan_evolution_new(module, &wrong, &evolution, &error), TARTAN_INVALID);
    assert_int_equal(tartan_evolution_new(module, NULL, &evolution, &error), TARTAN_INVALID);
    assert_int_equal(tartan_evolution_new(NULL, &options, &evolution, &error), TARTAN_INVALID);
    wrong = options;
    wrong.population = 1;
    assert_int_equal(tartan_evolution_new(module, &wrong, &evolution, &error), TARTAN_INVALID);
    wrong = options;
    wrong.objectives = 9;
    assert_int_equal(tartan_evolution_new(module, &wrong, &evolution, &error), TARTAN_INVALID);
    wrong = options;
    wrong.crossover_rate = NAN;
    assert_int_equal(tartan_evolution_new(module, &wrong, &evolution, &error), TARTAN_INVALID);
    wrong = options;
    wrong.selection = (tartan_selection)50;
    assert_int_equal(tartan_evolution_new(module, &wrong, &evolution, &error), TARTAN_INVALID);
    assert_int_equal(tartan_evolution_options_of(module, &wrong, &error), TARTAN_INVALID);
    assert_null(evolution);
    assert_int_equal(tartan_evolution_step(NULL, NULL, &error), TARTAN_INVALID);
    evolution = begin(module, &options);
    tartan_generation now = tartan_generation_init();
    tartan_individual one = tartan_individual_init();
    assert_int_equal(tartan_evolution_generation(evolution, &now, &error), TARTAN_INVALID);
    assert_int_equal(tartan_evolution_member(evolution, 0, &one, &error), TARTAN_INVALID);
    assert_int_equal(tartan_evolution_choose(evolution, (uint32_t[]){0}, 1, &error), TARTAN_INVALID);
    breed(evolution, 1);
    assert_int_equal(tartan_evolution_choose(evolution, (uint32_t[]){60}, 1, &error), TARTAN_INVALID);
    assert_int_equal(tartan_evolution_member(evolution, 60, &one, &error), TARTAN_INVALID);
    one.size = 3;
    assert_int_equal(tartan_evolution_member(evolution, 0, &one, &error), TARTAN_INVALID);
    tartan_evolution_free(evolution);
    tartan_evolution_free(NULL);
    tartan_mapper_free(NULL);
    tartan_grammar_free(NULL);
    tartan_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_and_inverts),      cmocka_unit_test(breeds_the_same_however_it_is_done),
        cmocka_unit_test(refuses_other_states),  cmocka_unit_test(steps_fail_without_a_trace),
        cmocka_unit_test(bears_with_bad_scores), cmocka_unit_test(takes_a_study),
        cmocka_unit_test(selects_by_cases),      cmocka_unit_test(maps_in_pairs),
        cmocka_unit_test(refuses_misuse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
