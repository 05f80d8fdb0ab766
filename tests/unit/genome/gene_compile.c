/* The compiler of .bnf grammars: what it says of wrong ones, and how it reads awkward ones. */
#include "runtime/genome/mapping/mapper.h"
#include "runtime/load.h"
#include "tests/support/test_grammar.h"

static size_t wrong; /* of what `says` was told */

static void says(const char *text, const char *codes)
{
    char found[400];
    size_t size;
    uint8_t *bytes = test_compile_grammar(text, &size, found, sizeof found);
    free(bytes);
    if (strcmp(found, codes) != 0)
        print_error("%.200s\nsays `%s`, not `%s`\n", text, found, codes);
    wrong += strcmp(found, codes) != 0;
}

static void test_diagnostics(void **state)
{
    (void)state;
    says("<a> ::= x\n", "");
    says("", "E1208 ");
    says("# only a comment\n", "E1208 ");
    says("just text\n", "E1208 W154 ");
    says("text\n<a> ::= x\n", "W154 ");
    says("<a> ::= <b>\n", "E1204 ");
    says("<a> ::= x\n<a> ::= y\n", "E1205 ");
    says("<a> ::= \n", "E1206 ");
    says("<a> ::=\n<b> ::= x", "E1206 W151 ");
    says("<a> ::= <a>x\n", "E1207 ");
    says("<a> ::= <b> | x\n<b> ::= <c>\n<c> ::= <b>\n", "E1207 E1207 ");
    says("<a> ::= x | | y\n", "W152 ");
    says("<a> ::= x | y |\n", "W152 ");
    says("<a> ::= x # comment\n | y\n", "");
    says("<a> ::= x\n<b> ::= y\n", "W151 ");
    says("<a> ::= it's\n", "E0002 ");
    says("<a> ::= \\x4\n", "E1209 ");
    says("<a> ::= \\ud800\n", "E1209 ");
    says("<a> ::= \\0\n", "E1209 ");
    says("<a> ::= x\\\n", "E1209 ");
    says("<a> ::= GE_RANGE:dataset_n_vars\n", "E1213 ");
    says("<a> ::= GE_RANGE:3 and more\n", "W153 ");
    says("<a> ::= GE_RANGE:0\n", "E1206 ");
    says("<a> ::= GE_RANGE:2000000\n", "E1214 ");
    says("<a> ::= { x }\n", "W157 ");
    says("%repair off\n<a> ::= Edge { x }\n", "W157 ");
    says("<a> ::= \"{\" x # { y\n", "");
    says("<b> ::= [<a>]\n<a> ::= x[:, <c>]\n<c> ::= 1\n", "");
    says("%dialect ge\n<a> ::= { x }\n", "");
    says("%dialect ge\n<a> ::= x[:, 1] {: y :}\n", "");
    says("<a> ::= x[:, 1] {: y :}\n", "");
    says("%dialect pge\n<a> ::= x\n", "E1202 ");
    says("%dialect ge\n%dialect ge\n<a> ::= x\n", "E1202 ");
    says("%wrap 2\n<a> ::= x\n", "E1202 ");
    says("%wraps -2\n<a> ::= x\n", "E1202 ");
    says("%max-depth 99999999999\n<a> ::= x\n", "E1202 ");
    says("%repair off\n<a> ::= x\n", "E1202 ");
    says("%dialect genr8\n<a> ::= x\n", "E1212 E1212 E1212 ");
    says("%dialect genr8\n%repair off\n<a> ::= x\n", "");
    says("%dialect genr8\n%repair off\n%single-choice skip\n<a> ::= x\n", "E1202 ");
    says("%dialect genr8\n%repair off\n<a> ::= { x\n", "E1211 ");
    says("%dialect genr8\n%repair off\n<a> ::= x }\n", "E1211 ");
    says("%dialect genr8\n%repair off\n<a> ::= { x ]\n", "E1211 ");
    says("%dialect genr8\n%repair off\n<a> ::= { x | y }\n<b> ::= z", "E1211 W151 ");
    says("%dialect genr8\n%repair off\n<a> ::= {x }\n", "E1211 ");
    says("%dialect genr8\n%repair off\n<a> ::= x{ y\n", "E1210 ");
    says("%dialect genr8\n%repair off\n<a> ::= <b>+\n<b> ::= x\n", "E1210 W151 ");
    says("%dialect genr8\n%repair off\n<a> ::= 'x y'\n", "E1210 ");
    says("%dialect genr8\n%repair off\n<a> ::= Edge0\n", "E1210 ");
    says("%dialect genr8\n%repair off\n<a> ::= '{' \"'\" '|' ' '\n", "E1210 E1210 ");
    assert_int_equal(wrong, 0);
}

/* The sentences of a ge grammar's start rule, alternative by alternative. */
static void reads(const char *text, size_t count, const char *const *sentences)
{
    tn_grammar *g = test_grammar(text);
    assert_int_equal(g->rules[0].count, count);
    tn_mapper *mapper = tn_mapper_new(g);
    for (uint64_t i = 0; i < count; i++) {
        uint64_t codons[4] = {i, 0, 0, 0};
        tn_mapping mapping;
        tn_mapping_options options = {0};
        assert_int_equal(tn_mapper_derive(mapper, codons, 4, &options, &mapping, NULL), TN_OK);
        assert_true(mapping.valid);
        assert_string_equal(mapping.phenotype, sentences[i]);
    }
    tn_mapper_free(mapper);
    tn_grammar_free(g);
}

static void test_reading(void **state)
{
    (void)state;
    /* what the grammars of common practice contain, read to the same productions */
    reads("<a> ::= x # c\n y | z\n", 3, (const char *const[]){"x", "y", "z"});
    reads("<a> ::= a\"b\"c | 'x' 'y' | \"|\"'\"' | \"\"\n", 4, (const char *const[]){"abc", "x y", "|\"", ""});
    reads("<a> ::= <b> + <b>\n<b> ::= 1\n", 1, (const char *const[]){"1 + 1"});
    reads("<a> ::= one  \n   two | \" x \"\n", 2, (const char *const[]){"one  \ntwo", " x "});
    reads("<a> ::= one\r\n\ttwo\r\n", 1, (const char *const[]){"one\n\ttwo"});
    reads("<a> ::= a < b | p <b c> q | \"<b>\" | <<\n", 4, (const char *const[]){"a < b", "p <b c> q", "<b>", "<<"});
    reads("<a> ::= \\n | \\x41 | \\u00e9 | \\061 | \\\\ | \\d | \\U0001F600 | caf\xc3\xa9\n", 8,
          (const char *const[]){"\n", "A", "\xc3\xa9", "1", "\\", "\\d", "\xf0\x9f\x98\x80", "caf\xc3\xa9"});
    reads("<a> ::= GE_RANGE:3 | z\n", 4, (const char *const[]){"0", "1", "2", "z"});
    reads("<a> ::= x <b> ::= y", 1, (const char *const[]){"x"});
    reads("# <old> ::= 1 | 2\n<a> ::= x\n", 1, (const char *const[]){"x"});
    reads("\xef\xbb\xbf<a> ::= x\n", 1, (const char *const[]){"x"});
}

static char *repeat(const char *text, size_t count, const char *before, const char *after)
{
    size_t length = strlen(text), at = strlen(before);
    char *all = malloc(at + count * length + strlen(after) + 1);
    assert_non_null(all);
    memcpy(all, before, at);
    for (size_t i = 0; i < count; i++, at += length)
        memcpy(all + at, text, length);
    memcpy(all + at, after, strlen(after) + 1);
    return all;
}

static void test_large(void **state)
{
    (void)state;
    char *text = repeat("x|", 999999, "<a> ::= ", "x\n"); /* a million alternatives */
    tn_grammar *g = test_grammar(text);
    assert_int_equal(g->production_count, 1000000);
    tn_grammar_free(g);
    free(text);
    text = repeat("x|", 1000000, "<a> ::= ", "x\n");
    says(text, "E1214 ");
    free(text);
    text = repeat("{ ", 64, "%dialect genr8\n%repair off\n<a> ::= ", "");
    char *nested = repeat("} ", 64, text, "\n");
    says(nested, "");
    free(nested);
    free(text);
    text = repeat("{ ", 65, "%dialect genr8\n%repair off\n<a> ::= ", "");
    nested = repeat("} ", 65, text, "\n");
    says(nested, "E1211 ");
    free(nested);
    free(text);
    text = repeat("[ ", 100000, "%dialect genr8\n%repair off\n<a> ::= ", "\n");
    says(text, "E1214 ");
    free(text);
    text = repeat("n", 253, "<", "> ::= x\n"); /* a name of 255 bytes */
    says(text, "");
    free(text);
    text = repeat("n", 254, "<", "> ::= x\n");
    says(text, "E0812 ");
    free(text);
    assert_int_equal(wrong, 0);
}

/* Every truncation and every change of one byte of a module is refused, or maps within bounds. */
static void test_damaged_modules(void **state)
{
    (void)state;
    size_t size;
    uint8_t *bytes = test_compile_grammar(
        "%dialect genr8\n%repair off\n<a> ::= { EdgeX [ - <b> ] } x\n<b> ::= Edge | y <a>\n", &size, NULL, 0);
    assert_non_null(bytes);
    for (size_t length = 0; length < size; length++) {
        tn_module *module;
        assert_int_not_equal(tn_module_load(bytes, length, NULL, &module, NULL), TN_OK);
    }
    size_t loaded = 0;
    for (size_t at = 40; at < size; at++) {
        for (unsigned change = 1; change < 256; change += 37) {
            tn_module *module;
            tn_grammar *grammar;
            bytes[at] ^= (uint8_t)change;
            tn_module_rehash(bytes, size);
            if (tn_module_load(bytes, size, NULL, &module, NULL) == TN_OK) {
                if (tn_grammar_new(module, 0, &grammar, NULL) == TN_OK) {
                    uint64_t codons[] = {1, 3, 5, 7, 9, 11, 2, 4};
                    tn_mapping mapping;
                    tn_mapping_options options = {.wraps = 3, .max_steps = 1000, .record = true};
                    tn_mapper *mapper = tn_mapper_new(grammar);
                    assert_int_equal(tn_mapper_derive(mapper, codons, 8, &options, &mapping, NULL), TN_OK);
                    tn_mapper_free(mapper);
                    tn_grammar_free(grammar);
                    loaded++;
                }
                tn_module_free(module);
            }
            bytes[at] ^= (uint8_t)change;
        }
    }
    assert_true(loaded > 100);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_diagnostics),
        cmocka_unit_test(test_reading),
        cmocka_unit_test(test_large),
        cmocka_unit_test(test_damaged_modules),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
