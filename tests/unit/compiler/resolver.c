/* Compiling from memory alone: texts come from a table, and what its resolver says is what the author is told. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/compile.h"
#include "runtime/load.h"

#define SCHEMA "schema s { width = 4' | 8' }\n"

typedef struct entry {
    const char *asked, *name, *text, *identity, *recorded;
} entry;

/* What there is, and what was asked. */
typedef struct table {
    const entry *entries;
    tn_error error; /* for what is not there */
    const char *meant;
    size_t calls;
    char log[400]; /* "USER PATH EXTENSION;" each */
} table;

static tn_status look_up(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    table *t = context;
    size_t used = strlen(t->log);
    t->calls++;
    snprintf(t->log + used, sizeof t->log - used, "%s %s %s;", request->user, request->path, request->extension);
    for (const entry *e = t->entries; e->asked; e++) {
        if (strcmp(e->asked, request->path) != 0)
            continue;
        *found = (tn_input){e->text, strlen(e->text), e->name ? e->name : e->asked, e->identity, e->recorded};
        return TN_OK;
    }
    *error = t->error;
    if (t->meant)
        snprintf(meant, TN_MEANT_SIZE, "%s", t->meant);
    return t->error.status;
}

static tn_status compile(const tn_notation *notation, const char *text, table *t, tn_compilation *c)
{
    tn_compile_options options = {.resolver = {t ? look_up : NULL, t}};
    tn_input input = {.text = text, .size = strlen(text), .name = "a text"};
    return tn_compile_text(notation, &input, &options, c);
}

/* One error, of this code, in a text of one `use`. */
static void expect_error(table *t, tn_code code, const char *message, const char *help, const char *replacement)
{
    tn_compilation c;
    assert_int_equal(compile(TN_NOTATION(plan), "use \"b\"\n", t, &c), TN_INVALID);
    assert_null(c.module);
    assert_int_equal(c.diagnostics.count, 1);
    const tn_diagnostic *item = &c.diagnostics.items[0];
    assert_int_equal(item->code, code);
    assert_int_equal(item->span.begin, 4);
    assert_string_equal(item->message, message);
    assert_string_equal(item->help, help);
    if (replacement)
        assert_string_equal(item->replacement, replacement);
    else
        assert_null(item->replacement);
    tn_compilation_clear(&c);
}

static void test_uses(void **state)
{
    (void)state;
    static const entry entries[] = {
        {"base", "shelf/base", SCHEMA "rule low = tray(4')\n", NULL, "<shelf>/base"},
        {"left", "shelf/left", "use \"base\"\nrule left = low\n", NULL, NULL},
        {"same", "other name", "no text of rules", "shelf/base", NULL},
        {NULL, NULL, NULL, NULL, NULL},
    };
    table t = {.entries = entries};
    tn_compilation c;
    tn_module *module;
    assert_int_equal(
        compile(TN_NOTATION(plan), "use \"left\"\nuse \"same\"\nuse \"base\"\nrule top = left and low\n", &t, &c),
        TN_OK);
    assert_string_equal(t.log, "a text left .plan;shelf/left base .plan;a text same .plan;a text base .plan;");
    assert_null(c.input);
    assert_int_equal(c.sources.count, 3); /* one identity is one text */
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, NULL), TN_OK);
    assert_int_equal(module->SOURCE_count, 3);
    assert_string_equal(tn_text(module, module->SOURCE_records[0].path), "a text");
    assert_string_equal(tn_text(module, module->SOURCE_records[1].path), "shelf/left");
    assert_string_equal(tn_text(module, module->SOURCE_records[2].path), "<shelf>/base");
    tn_module_free(module);
    tn_compilation_clear(&c);
}

/* The extension that is asked for is what the statement takes. */
static void test_extensions(void **state)
{
    (void)state;
    static const entry entries[] = {{"square", "square.hemls", "A + A + A + A\nA -> A\nAngle 90\n", NULL, NULL},
                                    {"more", "more.study", "steps 3\n", NULL, NULL},
                                    {"words", "words.bnf", "<a> ::= x\n", NULL, NULL},
                                    {NULL, NULL, NULL, NULL, NULL}};
    tn_compilation c;
    table t = {.entries = entries};
    assert_int_equal(compile(TN_NOTATION(study), "rules \"square\"\nuse \"more\"\n", &t, &c), TN_OK);
    assert_string_equal(t.log, "a text square .hemls;a text more .study;");
    tn_compilation_clear(&c);
    table words = {.entries = entries};
    assert_int_equal(compile(TN_NOTATION(evolution), "evolution { grammar \"words\"; match \"x\" }", &words, &c),
                     TN_OK);
    assert_string_equal(words.log, "a text words .bnf;");
    tn_compilation_clear(&c);
    assert_int_equal(compile(TN_NOTATION(hemls), "A + A + A\nA -> A\nAngle 120\n", NULL, &c), TN_OK);
    tn_compilation_clear(&c);
    assert_int_equal(compile(TN_NOTATION(bnf), "<a> ::= x\n", NULL, &c), TN_OK);
    tn_compilation_clear(&c);
}

static void test_cycles(void **state)
{
    (void)state;
    static const entry entries[] = {{"b", "b", "use \"c\"\n", NULL, NULL},
                                    {"c", "c", "use \"back\"\n", NULL, NULL},
                                    {"back", "another way", "", "b", NULL},
                                    {"self", "a text", "use \"self\"", NULL, NULL},
                                    {NULL, NULL, NULL, NULL, NULL}};
    table t = {.entries = entries};
    tn_compilation c;
    assert_int_equal(compile(TN_NOTATION(plan), "use \"b\"\n", &t, &c), TN_INVALID);
    assert_int_equal(c.diagnostics.items[0].code, E_IMPORT_CYCLE);
    assert_string_equal(c.diagnostics.items[0].message, "files use each other in a circle: b uses c uses b");
    tn_compilation_clear(&c);
    assert_int_equal(compile(TN_NOTATION(plan), "use \"self\"\n", &t, &c), TN_INVALID);
    assert_int_equal(c.diagnostics.items[0].code, E_IMPORT_CYCLE);
    assert_string_equal(c.diagnostics.items[0].help, "a file need not use itself: leave this out");
    tn_compilation_clear(&c);
}

static void test_missing(void **state)
{
    (void)state;
    static const entry none[] = {{NULL, NULL, NULL, NULL, NULL}};
    table t = {.entries = none, .meant = "shelf/base"};
    tn_fail(&t.error, TN_INVALID, E_IMPORT_NOT_FOUND, "the shelf has no `b`");
    tn_error_help(&t.error, "did you mean `shelf/base`?");
    expect_error(&t, E_IMPORT_NOT_FOUND, "the shelf has no `b`", "did you mean `shelf/base`?", "\"shelf/base\"");
    t.meant = NULL;
    tn_fail(&t.error, TN_IO, E_CANNOT_READ, "the shelf is locked");
    expect_error(&t, E_CANNOT_READ, "the shelf is locked", "check that it is a file that you may read", NULL);
    tn_fail(&t.error, TN_LIMIT, TN_CODE_NONE, "the shelf is full");
    expect_error(&t, E_IMPORT_NOT_FOUND, "the shelf is full", "check that it is a file that you may read", NULL);
    expect_error(NULL, E_IMPORT_NOT_FOUND, "there is no file `b`", "this text is compiled alone, and can use no other",
                 NULL);
}

static void test_no_memory(void **state)
{
    (void)state;
    static const entry none[] = {{NULL, NULL, NULL, NULL, NULL}};
    table t = {.entries = none};
    tn_compilation c;
    tn_fail_memory(&t.error);
    assert_int_equal(compile(TN_NOTATION(plan), "use \"b\"\nuse \"c\"\n", &t, &c), TN_MEMORY);
    assert_int_equal(t.calls, 1);
    assert_int_equal(c.diagnostics.count, 1);
    tn_compilation_clear(&c);
}

/* A chain of more texts than may be, made as it is asked for. */
static tn_status next_text(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    static char names[300][16], texts[300][32];
    size_t *count = context, n = (*count)++;
    (void)request, (void)meant, (void)error;
    assert_true(n < 300);
    snprintf(names[n], sizeof names[n], "t%zu", n);
    snprintf(texts[n], sizeof texts[n], "use \"t%zu\"\n", n + 1);
    *found = (tn_input){.text = texts[n], .size = strlen(texts[n]), .name = names[n]};
    return TN_OK;
}

static void test_limits(void **state)
{
    (void)state;
    size_t count = 0;
    tn_compile_options options = {.resolver = {next_text, &count}};
    tn_input input = {.text = "use \"t0\"\n", .size = 9, .name = "a text"};
    tn_compilation c;
    assert_int_equal(tn_compile_text(TN_NOTATION(plan), &input, &options, &c), TN_INVALID);
    assert_int_equal(c.diagnostics.items[0].code, E_TOO_MANY);
    assert_int_equal(count, 256);
    tn_compilation_clear(&c);
    static const entry huge[] = {{"b", "b", "", NULL, NULL}, {NULL, NULL, NULL, NULL, NULL}};
    table t = {.entries = huge};
    input = (tn_input){.text = "", .size = TN_SOURCE_BYTES_MAX + 1, .name = "a text"};
    options.resolver = (tn_resolver){look_up, &t};
    assert_int_equal(tn_compile_text(TN_NOTATION(plan), &input, &options, &c), TN_LIMIT);
    assert_int_equal(c.diagnostics.items[0].code, E_FILE_TOO_LARGE);
    tn_compilation_clear(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uses),    cmocka_unit_test(test_extensions), cmocka_unit_test(test_cycles),
        cmocka_unit_test(test_missing), cmocka_unit_test(test_no_memory),  cmocka_unit_test(test_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
