/* Mapping against independent results: PonyGE2's for the ge dialect, a reference implementation's for genr8, and the
 * worked example of the Genr8 paper (5.2), gene by gene. */
#include <jansson.h>

#include "runtime/genome/mapping/mapper.h"
#include "runtime/genome/mapping/sentences.h"
#include "tests/support/test_grammar.h"

#define DATA TARTAN_SOURCE_DIR "/tests/data/gene/"
#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"

static size_t read_genome(const json_t *row, uint64_t **codons)
{
    const json_t *array = json_object_get(row, "genome");
    size_t count = json_array_size(array);
    *codons = calloc(count + 1, sizeof **codons);
    assert_non_null(*codons);
    for (size_t i = 0; i < count; i++)
        (*codons)[i] = (uint64_t)json_integer_value(json_array_get(array, i));
    return count;
}

static uint64_t number(const json_t *row, const char *key)
{
    return (uint64_t)json_integer_value(json_object_get(row, key));
}

static void check_genr8(const json_t *row, const tn_mapping *m)
{
    assert_int_equal(m->max_id, number(row, "max_id"));
    const char *repaired = json_string_value(json_object_get(row, "repaired_phenotype"));
    assert_int_equal(m->valid, repaired != NULL);
    assert_int_equal(m->reason, repaired ? TN_MAPPING_VALID : TN_MAPPING_REPAIR_OUT_OF_CODONS);
    if (!repaired)
        return;
    assert_string_equal(m->repaired_phenotype, repaired);
    assert_int_equal(m->repaired_used, number(row, "repaired_used_codons"));
    const json_t *ids = json_object_get(row, "repaired_ids");
    assert_int_equal(m->repaired_count, json_array_size(ids));
    for (size_t i = 0; i < m->repaired_count; i++)
        assert_int_equal(m->repaired_ids[i], json_integer_value(json_array_get(ids, i)));
}

static void check_row(const json_t *row, const tn_mapping *m, bool genr8)
{
    const char *phenotype = json_string_value(json_object_get(row, "phenotype"));
    if (!phenotype) {
        assert_false(m->valid);
        assert_false(m->has_phenotype);
        assert_int_equal(m->reason, TN_MAPPING_OUT_OF_CODONS);
        return;
    }
    assert_true(m->has_phenotype);
    assert_string_equal(m->phenotype, phenotype);
    assert_int_equal(m->phenotype_size, strlen(phenotype));
    assert_int_equal(m->used, number(row, "used_codons"));
    assert_int_equal(m->nodes, number(row, "nodes"));
    assert_int_equal(m->depth, number(row, "depth"));
    if (genr8)
        check_genr8(row, m);
    else
        assert_true(m->valid);
}

/* Every row of a file of results, with and without recording. Returns how many there were. */
static size_t check_file(const char *grammar_path, const char *rows_path, uint32_t wraps, bool genr8)
{
    tn_grammar *grammar = test_grammar_file(grammar_path);
    tn_mapper *mapper = tn_mapper_new(grammar);
    assert_non_null(mapper);
    char *text = test_read(rows_path);
    size_t rows = 0;
    for (char *line = text, *end; (end = strchr(line, '\n')); line = end + 1, rows++) {
        json_t *row = json_loadb(line, (size_t)(end - line), 0, NULL);
        assert_non_null(row);
        uint64_t *codons;
        size_t count = read_genome(row, &codons);
        for (int recorded = 0; recorded < 2; recorded++) {
            tn_mapping_options options = tn_mapping_options_of(grammar);
            tn_mapping mapping;
            options.wraps = wraps;
            options.record = recorded;
            assert_int_equal(tn_mapper_derive(mapper, codons, count, &options, &mapping, NULL), TN_OK);
            check_row(row, &mapping, genr8);
        }
        free(codons);
        json_decref(row);
    }
    free(text);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
    return rows;
}

static void test_ge_rows(void **state)
{
    (void)state;
    assert_int_equal(check_file(DATA "tiny1.bnf", DATA "tiny1.jsonl", 2, false), 40);
    assert_int_equal(check_file(DATA "tiny2.bnf", DATA "tiny2.jsonl", 2, false), 40);
}

static void test_genr8_rows(void **state)
{
    (void)state;
    assert_int_equal(check_file(STDLIB "genr8.bnf", DATA "genr8_fixtures.jsonl", 2, true), 60);
}

static void test_all_rows(void **state)
{
    (void)state;
    const char *folder = getenv("TARTAN_ORACLES");
    if (!folder || !*folder)
        skip();
    char grammar[512], rows[512];
    for (int i = 1; i <= 2; i++) {
        snprintf(grammar, sizeof grammar, "%s/ge/grammars/tiny%d.bnf", folder, i);
        snprintf(rows, sizeof rows, "%s/ge/tiny%d.w2.tree.jsonl", folder, i);
        assert_true(check_file(grammar, rows, 2, false) > 100);
        snprintf(rows, sizeof rows, "%s/ge/tiny%d.w0.jsonl", folder, i);
        assert_true(check_file(grammar, rows, 0, false) > 100);
    }
    snprintf(rows, sizeof rows, "%s/ge/genr8_fixtures.jsonl", folder);
    assert_true(check_file(STDLIB "genr8.bnf", rows, 2, true) >= 100);
}

/* ---- the worked example */

typedef struct expected_step {
    uint64_t codon, modulus, value;
    tn_event_kind kind;
} expected_step;

static void test_worked_example(void **state)
{
    (void)state;
    static const uint64_t genome[] = {212, 187, 632, 832, 800, 517, 338, 39, 878, 185, 954, 863};
    static const expected_step steps[] = {
        {212, 1, 0, TN_EVENT_EXPAND},                                                            /* start symbol */
        {187, 1, 0, TN_EVENT_EXPAND},                                                            /* axiom */
        {632, 3, 2, TN_EVENT_EDGE},                                                              /* a new edge type */
        {832, 4, 0, TN_EVENT_EDGE},   {800, 4, 0, TN_EVENT_EDGE},   {517, 2, 1, TN_EVENT_AGAIN}, /* 1 > 0 */
        {338, 4, 2, TN_EVENT_EDGE},   {39, 3, 0, TN_EVENT_STOP},                                 /* 0 < 1 */
        {878, 1, 0, TN_EVENT_EXPAND}, {185, 4, 1, TN_EVENT_EXPAND}, {954, 4, 2, TN_EVENT_EDGE},
        {863, 4, 3, TN_EVENT_EDGE}, /* another new one */
    };
    tn_grammar *grammar = test_grammar_file(STDLIB "genr8-example.bnf");
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_mapping_options options = {.record = true, .repair = TN_REPAIR_OFF};
    tn_mapping mapping;
    assert_int_equal(tn_mapper_derive(mapper, genome, 12, &options, &mapping, NULL), TN_OK);
    assert_int_equal(mapping.reason, TN_MAPPING_OUT_OF_CODONS);
    size_t step = 0;
    for (size_t i = 0; i < mapping.event_count; i++) {
        const tn_event *event = &mapping.events[i];
        if (event->read == TN_NO_READ)
            continue;
        assert_true(step < 12);
        assert_int_equal(event->read, step);
        assert_int_equal(event->kind, steps[step].kind);
        assert_int_equal(event->codon, steps[step].codon);
        assert_int_equal(event->modulus, steps[step].modulus);
        assert_int_equal(event->value, steps[step].value);
        step++;
    }
    assert_int_equal(step, 12);
    /* with more codons, the sentence begins as the paper prints it */
    uint64_t longer[200];
    for (size_t i = 0; i < 200; i++)
        longer[i] = i < 12 ? genome[i] : 40;
    assert_int_equal(tn_mapper_derive(mapper, longer, 200, &options, &mapping, NULL), TN_OK);
    assert_true(mapping.valid);
    assert_memory_equal(mapping.phenotype, "Edge2 + Edge0 + Edge0 + Edge2 ;", 31);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
}

/* ---- small cases */

static void map_text(tn_grammar *grammar, const char *codons, const tn_mapping_options *options, const char *expected)
{
    uint64_t genome[64];
    size_t count = 0;
    for (char *at = (char *)(uintptr_t)codons; *at;)
        genome[count++] = strtoull(at, &at, 10);
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_mapping mapping;
    assert_int_equal(tn_mapper_derive(mapper, genome, count, options, &mapping, NULL), TN_OK);
    if (mapping.valid) {
        size_t size;
        assert_string_equal(tn_mapping_sentence(&mapping, &size), expected);
        assert_int_equal(size, strlen(expected));
    } else {
        assert_string_equal(tn_mapping_reason_text(mapping.reason), expected);
    }
    tn_mapper_free(mapper);
}

static void test_small_cases(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("<s> ::= <a><b>\n<a> ::= x\n<b> ::= 0 | 1 | <s>\n");
    tn_mapping_options options = {0};
    map_text(g, "0 0 1", &options, "x1");
    map_text(g, "0 0 18446744073709551615", &options, "x0"); /* 2^64 - 1 is divisible by 3 */
    map_text(g, "0 0 4294967296", &options, "x1");
    map_text(g, "0 0", &options, "out of codons");
    map_text(g, "", &options, "out of codons");
    options.wraps = 1;
    map_text(g, "0 0 2 0", &options, "xx0");
    map_text(g, "2", &options, "out of codons");
    options = (tn_mapping_options){.max_depth = 3};
    map_text(g, "0 0 1", &options, "x1");
    map_text(g, "0 0 2 0 0 0", &options, "too deep");
    options = (tn_mapping_options){.wraps = UINT32_MAX, .max_steps = 1000};
    map_text(g, "2", &options, "too long");
    tn_grammar_free(g);
    g = test_grammar("%single-choice skip\n<s> ::= <a><b>\n<a> ::= x\n<b> ::= 0 | 1 | <s>\n");
    options = (tn_mapping_options){0};
    map_text(g, "1", &options, "x1");
    map_text(g, "2 1", &options, "xx1");
    tn_grammar_free(g);
    g = test_grammar("%single-choice skip\n<s> ::= <a><a>\n<a> ::= x\n");
    map_text(g, "", &options, "xx");
    tn_grammar_free(g);
}

static void test_genr8_cases(void **state)
{
    (void)state;
    /* a variable is one edge type within its production, and another in the next */
    tn_grammar *g = test_grammar("%dialect genr8\n%repair off\n<s> ::= EdgeX EdgeY EdgeX EdgeY <t>\n<t> ::= EdgeX\n");
    tn_mapping_options options = {0};
    map_text(g, "0 2 1 9 0", &options, "Edge2 Edge1 Edge2 Edge1 Edge0");
    tn_grammar_free(g);
    /* from max_depth on, only productions without non-terminals are candidates */
    g = test_grammar("%dialect genr8\n%repair off\n<s> ::= <m>\n<m> ::= a <m> | b | { c } | [ <m> ]\n");
    options = (tn_mapping_options){.max_depth = 3};
    map_text(g, "0 0 0", &options, "a b");
    map_text(g, "0 0 1 1 2 0", &options, "a c c");
    map_text(g, "0 3 1 0", &options, "b");
    map_text(g, "0 3 0", &options, "");
    tn_grammar_free(g);
    /* repair by identity reads nothing */
    const char *text = "%dialect genr8\n%repair identity\n<s> ::= <RewriteRule> ';' Edge\n" /* Edge3 is new */
                       "<RewriteRule> ::= <Predecessor> -> <Successor>\n<Predecessor> ::= Edge '<' Edge | Edge\n"
                       "<Successor> ::= Edge Edge\n";
    g = test_grammar(text);
    options = tn_mapping_options_of(g);
    map_text(g, "0 0 1 0 0 1 2 3", &options,
             "Edge0 -> Edge1 Edge2 ; Edge1 -> Edge1 ; Edge2 -> Edge2 ; Edge3 -> Edge3 ; Edge3");
    tn_grammar_free(g);
}

/* ---- bounds */

/* A sentence with 100,000 edge types that have no rule: repaired in ascending order, but for Edge1, which only the
 * first of the added rules mentions. */
enum { TYPES = 100000 };

static tn_mapping_reason repair_many(const tn_grammar *grammar, const tn_mapping_options *options)
{
    uint64_t *codons = calloc(9 + 4 * TYPES, sizeof *codons);
    size_t count = 6; /* start symbol, rule, predecessor, its edge, successor, its edge: all 0 */
    assert_non_null(codons);
    for (uint64_t c = 0; c < TYPES; c++) {
        codons[count++] = c + 1; /* another one, */
        codons[count++] = c + 2; /* of a new type */
    }
    codons[count++] = 0;   /* enough */
    codons[count + 1] = 1; /* the successor of Edge2 is Edge1 */
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_mapping m;
    assert_int_equal(tn_mapper_derive(mapper, codons, 9 + 4 * TYPES, options, &m, NULL), TN_OK);
    tn_mapping_reason reason = m.reason;
    assert_true(m.has_phenotype);
    assert_int_equal(m.max_id, TYPES + 2);
    assert_int_equal(m.valid, reason == TN_MAPPING_VALID);
    if (m.valid) {
        bool one = options->repair == TN_REPAIR_GENOME; /* Edge1 occurs */
        assert_int_equal(m.repaired_count, TYPES + one);
        for (uint32_t i = 0; i < TYPES; i++)
            assert_int_equal(m.repaired_ids[i + (one && i > 0)], i + 2);
        assert_true(!one || m.repaired_ids[1] == 1);
    }
    free(codons);
    tn_mapper_free(mapper);
    return reason;
}

static void test_repair_is_bounded(void **state)
{
    (void)state;
    tn_grammar *g = test_grammar("%dialect genr8\n%repair genome\n<s> ::= <RewriteRule> ';' { Edge }\n"
                                 "<RewriteRule> ::= <Predecessor> -> <Successor>\n<Predecessor> ::= Edge\n"
                                 "<Successor> ::= Edge\n");
    tn_mapping_options options = tn_mapping_options_of(g);
    assert_int_equal(repair_many(g, &options), TN_MAPPING_VALID);
    options.max_steps = 4 * TYPES;
    assert_int_equal(repair_many(g, &options), TN_MAPPING_REPAIR_TOO_LONG);
    options.repair = TN_REPAIR_IDENTITY; /* a step for each rule, and nothing else */
    assert_int_equal(repair_many(g, &options), TN_MAPPING_VALID);
    options.max_steps = 2 * TYPES + TYPES / 2;
    assert_int_equal(repair_many(g, &options), TN_MAPPING_REPAIR_TOO_LONG);
    tn_grammar_free(g);
}

/* Few symbols can be a long text: that too counts as steps, and alike in all forms of the machine. */
static void test_long_texts_are_bounded(void **state)
{
    (void)state;
    char text[1400] = "<s> ::= <t><s> | <t>\n<t> ::= ";
    memset(text + strlen(text), 'x', 10 * TN_MAPPING_STEP_BYTES);
    static const uint64_t twice[] = {0, 0, 1, 0};
    tn_grammar *g = test_grammar(text);
    tn_mapper *mapper = tn_mapper_new(g);
    tn_mapping m;
    uint64_t enough = 0;
    for (uint64_t steps = 1; steps < 60; steps++) {
        tn_mapping_reason reasons[2];
        for (int recorded = 0; recorded < 2; recorded++) {
            tn_mapping_options options = {.max_steps = steps, .record = recorded};
            assert_int_equal(tn_mapper_derive(mapper, twice, 4, &options, &m, NULL), TN_OK);
            reasons[recorded] = m.reason;
        }
        assert_int_equal(reasons[0], reasons[1]);
        assert_true(reasons[0] == TN_MAPPING_VALID || (reasons[0] == TN_MAPPING_TOO_LONG && !enough));
        enough = reasons[0] == TN_MAPPING_VALID && !enough ? steps : enough;
    }
    assert_true(enough > 20 && enough < 40);
    tn_mapping_options endless = {.wraps = UINT32_MAX};
    assert_int_equal(tn_mapper_derive(mapper, twice, 2, &endless, &m, NULL), TN_OK);
    assert_int_equal(m.reason, TN_MAPPING_TOO_LONG);
    tn_mapper_free(mapper);
    tn_grammar_free(g);
}

/* ---- few sentences */

static size_t sentences_of(tn_grammar *g, size_t most)
{
    tn_mapping_options options = tn_mapping_options_of(g);
    size_t count;
    assert_int_equal(tn_count_sentences(g, &options, most, &count, NULL), TN_OK);
    tn_grammar_free(g);
    return count;
}

static void test_sentences(void **state)
{
    (void)state;
    assert_int_equal(sentences_of(test_grammar("<a> ::= x\n"), 1), 1);
    assert_int_equal(sentences_of(test_grammar("<a> ::= x | y | <b>\n<b> ::= x | z\n"), 4), 3); /* x in two ways */
    assert_int_equal(sentences_of(test_grammar("<a> ::= x | y | <b>\n<b> ::= x | z\n"), 3), SIZE_MAX);
    assert_int_equal(sentences_of(test_grammar("<a> ::= <d><d><d>\n<d> ::= GE_RANGE:7\n"), 1000), 343);
    assert_int_equal(sentences_of(test_grammar("%single-choice skip\n<a> ::= <b><b>\n<b> ::= <c>\n<c> ::= p | q\n"), 9),
                     4);
    assert_int_equal(sentences_of(test_grammar_file(TARTAN_SOURCE_DIR "/stdlib/genr8-quads.bnf"), 1000), 120);
    assert_int_equal(sentences_of(test_grammar("<a> ::= <a>x | y\n"), 1000), SIZE_MAX); /* the first one has no end */
    assert_int_equal(sentences_of(test_grammar("<a> ::= y | <a>x\n"), 1000), SIZE_MAX);
    assert_int_equal(sentences_of(test_grammar("%max-depth 4\n<a> ::= y | <a>x\n"), 1000),
                     3); /* the others are too deep */
    /* one edge type of two, then of as many as there are; an option; a loop has no end */
    assert_int_equal(sentences_of(test_grammar("%dialect genr8\n%repair off\n<a> ::= Edge Edge\n"), 100), 10);
    assert_int_equal(sentences_of(test_grammar("%dialect genr8\n%repair off\n<a> ::= x [ <b> ]\n<b> ::= y | z\n"), 9),
                     3);
    assert_int_equal(sentences_of(test_grammar("%dialect genr8\n%repair off\n<a> ::= { x }\n"), 1000), SIZE_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sentences),
        cmocka_unit_test(test_ge_rows),
        cmocka_unit_test(test_genr8_rows),
        cmocka_unit_test(test_all_rows),
        cmocka_unit_test(test_worked_example),
        cmocka_unit_test(test_small_cases),
        cmocka_unit_test(test_genr8_cases),
        cmocka_unit_test(test_repair_is_bounded),
        cmocka_unit_test(test_long_texts_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
