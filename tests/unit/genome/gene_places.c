/* Position-independent mapping against a derivation that is a plain list of symbols, rewritten in place; and what is
 * told of it. */
#include "runtime/base/random.h"
#include "runtime/genome/mapping/genome.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/tree.h"
#include "tests/support/test_grammar.h"

#define FORM 4000u

/* A grammar of rules a, b, ..., whose alternatives are words of rules (small letters) and text (capitals). */
typedef struct plain {
    const char *alternatives[4][4];
    size_t counts[4];
    const char *text;
} plain;

static const plain grammars[] = {
    {{{"a+a", "b", "(a)"}, {"X", "Y"}}, {3, 2}, "<a> ::= <a>+<a> | <b> | (<a>)\n<b> ::= X | Y\n"},
    {{{"bcd"}, {"B", "bB"}, {"", "C", "cb"}, {"D"}},
     {1, 2, 3, 1},
     "<a> ::= <b><c><d>\n<b> ::= B | <b>B\n<c> ::= \"\" | C | <c><b>\n<d> ::= D\n"},
};

/* The sentence in `form`, or false: out of codons, or no longer a form of this size. */
static bool rewrite(const plain *g, const uint64_t *codons, size_t count, uint32_t wraps, char form[FORM],
                    uint64_t *used)
{
    strcpy(form, "a");
    for (*used = 0;; *used += 2) {
        size_t open = 0, at;
        for (at = 0; form[at]; at++)
            open += form[at] >= 'a' && form[at] <= 'd';
        if (open == 0)
            return true;
        if (*used + 2 > count * (wraps + 1) || at + 8 > FORM)
            return false;
        size_t place = (size_t)(codons[*used % count] % open);
        for (at = 0; form[at] < 'a' || form[at] > 'd' || place-- > 0;)
            at++;
        int rule = form[at] - 'a';
        const char *by = g->alternatives[rule][codons[(*used + 1) % count] % g->counts[rule]];
        char rest[FORM];
        strcpy(rest, form + at + 1);
        strcpy(form + at, by);
        strcat(form, rest);
    }
}

static void same_recorded(tn_mapper *mapper, const tn_grammar *grammar, const uint64_t *codons, size_t count,
                          const tn_mapping_options *options, const char *expected)
{
    tn_mapping_options recording = *options;
    tn_mapping mapping;
    tn_tree tree;
    recording.record = true;
    assert_int_equal(tn_mapper_derive(mapper, codons, count, &recording, &mapping, NULL), TN_OK);
    assert_int_equal(mapping.valid, expected != NULL);
    assert_int_equal(tn_tree_make(mapping.events, mapping.event_count, &tree, NULL), TN_OK);
    char text[FORM] = "";
    for (size_t i = 0; i < tree.count; i++) {
        const tn_event *event = &mapping.events[tree.nodes[i].event];
        assert_int_not_equal(event->kind, TN_EVENT_PLACE);
        if (expected && event->kind == TN_EVENT_TERMINAL)
            strncat(text, grammar->texts + grammar->terminals[event->symbol].offset,
                    grammar->terminals[event->symbol].length);
    }
    if (expected)
        assert_string_equal(text, expected);
    char *trace = NULL;
    size_t size;
    FILE *out = open_memstream(&trace, &size);
    assert_true(tn_trace_write(grammar, mapping.events, mapping.event_count, out));
    fclose(out);
    unsigned last = 0, gene;
    for (const char *line = strchr(trace, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
        gene = (unsigned)strtoul(line + 1, NULL, 10);
        assert_int_equal(gene, ++last); /* genes in the order in which they were read */
    }
    free(trace);
    tn_tree_clear(&tree);
}

static void test_against_rewriting(void **state)
{
    (void)state;
    size_t valid = 0, other = 0;
    for (size_t k = 0; k < sizeof grammars / sizeof *grammars; k++) {
        tn_grammar *grammar = test_grammar(grammars[k].text);
        tn_mapper *mapper = tn_mapper_new(grammar);
        for (uint64_t i = 0; i < 2000; i++) {
            uint64_t codons[60], used;
            size_t count = 1 + tn_random64(9, i, 0) % 60;
            char form[FORM];
            for (size_t c = 0; c < count; c++)
                codons[c] = tn_random64(9, i, c + 1) >> (i % 2 ? 0 : 40);
            tn_mapping_options options = {.wraps = (uint32_t)(i % 3), .position_independent = true}, leftmost = options;
            bool expected = rewrite(&grammars[k], codons, count, options.wraps, form, &used);
            tn_mapping mapping;
            assert_int_equal(tn_mapper_derive(mapper, codons, count, &options, &mapping, NULL), TN_OK);
            assert_int_equal(mapping.valid, expected);
            if (expected) {
                assert_string_equal(mapping.phenotype, form);
                assert_int_equal(mapping.used, used);
                valid++;
            } else {
                assert_int_equal(mapping.reason, TN_MAPPING_OUT_OF_CODONS);
            }
            same_recorded(mapper, grammar, codons, count, &options, expected ? form : NULL);
            leftmost.position_independent = false;
            assert_int_equal(tn_mapper_derive(mapper, codons, count, &leftmost, &mapping, NULL), TN_OK);
            other += expected && (!mapping.valid || strcmp(mapping.phenotype, form) != 0);
        }
        tn_mapper_free(mapper);
        tn_grammar_free(grammar);
    }
    assert_true(valid > 500);
    assert_true(other > 300); /* it is another mapping */
}

/* With the leftmost non-terminal each time, nodes and depth are those of the other mapping. */
static void test_leftmost_pairs(void **state)
{
    (void)state;
    tn_grammar *grammar = test_grammar(grammars[0].text);
    tn_mapper *mapper = tn_mapper_new(grammar);
    for (uint64_t i = 0; i < 500; i++) {
        uint64_t codons[40], pairs[80] = {0};
        for (size_t c = 0; c < 40; c++)
            pairs[2 * c + 1] = codons[c] = tn_random64(4, i, c) >> 33;
        for (uint32_t depth = 0; depth < 7; depth += 3) {
            tn_mapping_options options = {.max_depth = depth, .position_independent = true};
            tn_mapping mapping;
            assert_int_equal(tn_mapper_derive(mapper, pairs, 80, &options, &mapping, NULL), TN_OK);
            tn_mapping one = mapping;
            char text[FORM];
            snprintf(text, sizeof text, "%s", mapping.phenotype);
            options.position_independent = false;
            assert_int_equal(tn_mapper_derive(mapper, codons, 40, &options, &mapping, NULL), TN_OK);
            assert_int_equal(one.valid, mapping.valid);
            assert_int_equal(one.reason, mapping.reason);
            assert_int_equal(one.nodes, mapping.nodes);
            assert_int_equal(one.depth, mapping.depth);
            assert_int_equal(one.used, 2 * mapping.used);
            assert_string_equal(text, mapping.phenotype);
        }
    }
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
}

/* Straightened, a genome derives the same, and subtrees are stretches of it. */
static void test_straightening(void **state)
{
    (void)state;
    tn_grammar *grammar = test_grammar(grammars[1].text);
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_genome straight = {0};
    tn_spans spans = {0};
    size_t tried = 0;
    for (uint64_t i = 0; i < 500; i++) {
        uint64_t codons[50];
        for (size_t c = 0; c < 50; c++)
            codons[c] = tn_random64(6, i, c) >> 30;
        tn_mapping_options options = {.wraps = 1, .position_independent = true, .record = true};
        tn_mapping mapping, again;
        assert_int_equal(tn_mapper_derive(mapper, codons, 50, &options, &mapping, NULL), TN_OK);
        if (!mapping.valid)
            continue;
        char text[FORM];
        snprintf(text, sizeof text, "%s", mapping.phenotype);
        tn_event *events = malloc(mapping.event_count * sizeof *events);
        assert_non_null(events);
        memcpy(events, mapping.events, mapping.event_count * sizeof *events);
        mapping.events = events;
        assert_true(tn_events_straighten(events, mapping.event_count, codons, 50, mapping.used, &straight));
        assert_true(tn_spans_find(&mapping, &spans));
        assert_int_equal(spans.count * 2, mapping.used);
        assert_int_equal(spans.items[0].begin, 0);
        assert_int_equal(spans.items[0].end, mapping.used);
        for (size_t s = 0; s < spans.count; s++)
            assert_int_equal((spans.items[s].end - spans.items[s].begin) % 2, 0);
        options.record = false;
        assert_int_equal(tn_mapper_derive(mapper, straight.codons, straight.count, &options, &again, NULL), TN_OK);
        assert_true(again.valid);
        assert_string_equal(again.phenotype, text);
        free(events);
        tried++;
    }
    assert_true(tried > 100);
    tn_spans_clear(&spans);
    tn_genome_clear(&straight);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
}

static void test_inverting(void **state)
{
    (void)state;
    tn_grammar *grammar = test_grammar(grammars[0].text);
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_genome genome = {0};
    const char *sentence = "((X+Y)+(Y))+X";
    const tn_invert_options how = {.position_independent = true};
    const tn_mapping_options options = {.position_independent = true};
    tn_mapping mapping;
    assert_int_equal(tn_invert(grammar, sentence, strlen(sentence), &how, &genome, NULL), TN_OK);
    assert_int_equal(tn_mapper_derive(mapper, genome.codons, genome.count, &options, &mapping, NULL), TN_OK);
    assert_string_equal(mapping.phenotype, sentence);
    assert_int_equal(mapping.used, genome.count);
    tn_genome_clear(&genome);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
}

/* A form of 100,000 non-terminals, which are then replaced in any order. */
static void test_large(void **state)
{
    (void)state;
    enum { OPEN = 100000, PAIRS = 2 * OPEN - 1 };
    tn_grammar *grammar = test_grammar("<a> ::= <a><a> | x\n");
    tn_mapper *mapper = tn_mapper_new(grammar);
    uint64_t *codons = malloc(2 * PAIRS * sizeof *codons);
    assert_non_null(codons);
    for (size_t i = 0; i < PAIRS; i++) {
        codons[2 * i] = tn_random64(1, i, 0);
        codons[2 * i + 1] = i >= OPEN - 1;
    }
    tn_mapping_options options = {.position_independent = true};
    tn_mapping mapping;
    assert_int_equal(tn_mapper_derive(mapper, codons, 2 * PAIRS, &options, &mapping, NULL), TN_OK);
    assert_true(mapping.valid);
    assert_int_equal(mapping.phenotype_size, OPEN);
    assert_int_equal(mapping.nodes, 1 + 2 * (OPEN - 1) + OPEN);
    options.max_steps = 1000;
    assert_int_equal(tn_mapper_derive(mapper, codons, 2 * PAIRS, &options, &mapping, NULL), TN_OK);
    assert_int_equal(mapping.reason, TN_MAPPING_TOO_LONG);
    free(codons);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_rewriting),
        cmocka_unit_test(test_leftmost_pairs),
        cmocka_unit_test(test_straightening),
        cmocka_unit_test(test_inverting),
        cmocka_unit_test(test_large),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
