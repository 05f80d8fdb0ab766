/* For tests of grammars: from the text of a .bnf file to a grammar, by way of a module's bytes. */
#ifndef TARTAN_TEST_GRAMMAR_H
#define TARTAN_TEST_GRAMMAR_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/bnf/bnf.h"
#include "runtime/base/file.h"
#include "runtime/grammar/grammar.h"
#include "runtime/load.h"

/* Compiles; what there is to say goes to `codes` as "E1004 W1001 ", in the order of the text. NULL where there are
 * errors. */
static inline uint8_t *test_compile_grammar(const char *text, size_t *size, char *codes, size_t codes_size)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    tn_arena *arena = tn_arena_new();
    tn_builder *builder = tn_builder_new();
    tn_error error;
    uint32_t file;
    uint8_t *bytes = NULL;
    tn_diagnostics_init(&diagnostics, &sources);
    assert_non_null(arena);
    assert_non_null(builder);
    assert_int_equal(tn_sources_add(&sources, "test.bnf", text, strlen(text), &file, &error), TN_OK);
    tn_builder_add_SOURCE(builder, &(tn_source_record){.path = tn_builder_string(builder, "test.bnf"),
                                                       .text = tn_builder_string(builder, text)});
    tn_status status = tn_bnf_compile(&sources, file, NULL, &diagnostics, arena, builder, &error);
    tn_diagnostics_sort(&diagnostics);
    if (codes)
        codes[0] = '\0';
    for (size_t i = 0; codes && i < diagnostics.count; i++) {
        char name[8];
        tn_code_name(diagnostics.items[i].code, name);
        size_t used = strlen(codes);
        snprintf(codes + used, codes_size - used, "%s ", name);
    }
    if (!codes && diagnostics.count)
        tn_diagnostics_show(&diagnostics, &(tn_show_options){0}, stderr);
    if (status == TN_OK)
        assert_int_equal(tn_builder_finish(builder, &bytes, size, &error), TN_OK);
    assert_int_equal(status == TN_OK, diagnostics.error_count == 0);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    tn_arena_free(arena);
    tn_builder_free(builder);
    return bytes;
}

static inline tn_grammar *test_grammar(const char *text)
{
    size_t size;
    tn_error error = {0};
    tn_module *module = NULL;
    tn_grammar *grammar = NULL;
    uint8_t *bytes = test_compile_grammar(text, &size, NULL, 0);
    assert_non_null(bytes);
    if (tn_module_load(bytes, size, NULL, &module, &error) != TN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(tn_grammar_new(module, 0, &grammar, &error), TN_OK);
    tn_module_free(module);
    free(bytes);
    return grammar;
}

static inline char *test_read(const char *path)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_file_read(path, 64u << 20, &bytes, &size, &error) != TN_OK)
        fail_msg("%s", error.message);
    return (char *)bytes;
}

static inline tn_grammar *test_grammar_file(const char *path)
{
    char *text = test_read(path);
    tn_grammar *grammar = test_grammar(text);
    free(text);
    return grammar;
}

#endif
