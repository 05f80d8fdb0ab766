/* Formatting changes nothing but the layout: on every rule file of this repository, and on what fuzzing found worth
 * keeping. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "compiler/compile.h"
#include "compiler/format.h"
#include "runtime/vm/file.h"
#include "runtime/vm/module.h"

static const char *const stdlib_dirs[] = {TARTAN_SOURCE_DIR "/stdlib"};

/* NULL where it has errors. */
static char *formatted(const char *path, const char *text, size_t size)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    char *result;
    size_t result_size;
    tn_diagnostics_init(&diagnostics, &sources);
    tn_status status = tn_format_text(&diagnostics, path, text, size, &result, &result_size);
    assert_true(status == TN_OK || status == TN_INVALID || status == TN_LIMIT);
    assert_int_equal(status == TN_OK, result != NULL);
    assert_int_equal(status == TN_OK, diagnostics.error_count == 0);
    if (result)
        assert_int_equal(strlen(result), result_size);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    return result;
}

static tn_module *compiled(const char *path, const char *text, size_t size)
{
    tn_compile_options options = {.stdlib_dirs = stdlib_dirs, .stdlib_dir_count = 1};
    tn_compilation compilation;
    tn_module *module = NULL;
    tn_error error;
    if (tn_compile_text(path, text, size, &options, &compilation) == TN_OK)
        assert_int_equal(tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error), TN_OK);
    tn_compilation_clear(&compilation);
    return module;
}

/* Names made from a clause's line, as `prune@12`, are compared up to the line. */
static bool same_text(const char *a, const char *b)
{
    size_t size = strcspn(a, "@");
    return strcspn(b, "@") == size && memcmp(a, b, size) == 0 && a[size] == b[size];
}

static bool is_place(const char *field)
{
    return strcmp(field, "file") == 0 || strcmp(field, "begin") == 0 || strcmp(field, "end") == 0;
}

/* Everything but the sources and the places in them. */
static void assert_same_modules(const tn_module *a, const tn_module *b)
{
    assert_int_equal(a->code_size, b->code_size);
    assert_memory_equal(a->code, b->code, a->code_size);
#define F(KIND, FIELD) COMPARE_##KIND(FIELD)
#define COMPARE_U32(FIELD)                                                                                             \
    if (!is_place(#FIELD))                                                                                             \
        assert_int_equal(one->FIELD, other->FIELD);
#define COMPARE_I64(FIELD)                                                                                             \
    if (strcmp(#FIELD, "sources_hash") != 0)                                                                           \
        assert_int_equal(one->FIELD, other->FIELD);
#define COMPARE_F64(FIELD) assert_true(one->FIELD == other->FIELD);
#define COMPARE_STR(FIELD)                                                                                             \
    if (strcmp(#FIELD, "text") != 0)                                                                                   \
        assert_true(same_text(tn_text(a, one->FIELD), tn_text(b, other->FIELD)));
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    if (strcmp(#NAME, "MAP") != 0) {                                                                                   \
        assert_int_equal(a->NAME##_count, b->NAME##_count);                                                            \
        for (size_t i = 0; i < a->NAME##_count; i++) {                                                                 \
            const TYPE *one = &a->NAME##_records[i], *other = &b->NAME##_records[i];                                   \
            FIELDS                                                                                                     \
        }                                                                                                              \
    }
#include "runtime/vm/records.def"
#undef SECTION
#undef F
}

static size_t count_lines_longer(const char *text, size_t width)
{
    size_t count = 0;
    for (size_t size; *text; text += size + (text[size] == '\n')) {
        size = strcspn(text, "\n");
        count += size > width;
        assert_true(size == 0 || (text[size - 1] != ' ' && text[size - 1] != '\t'));
    }
    return count;
}

static size_t formatted_files, compiled_files;

static void check_text(const char *path, const char *text, size_t size)
{
    char *once = formatted(path, text, size);
    if (!once)
        return;
    char *twice = formatted(path, once, strlen(once));
    assert_non_null(twice);
    assert_string_equal(once, twice);
    formatted_files++;
    tn_module *before = compiled(path, text, size), *after = compiled(path, once, strlen(once));
    assert_int_equal(before != NULL, after != NULL);
    if (before) {
        assert_same_modules(before, after);
        compiled_files++;
    }
    tn_module_free(before);
    tn_module_free(after);
    free(once);
    free(twice);
}

static void check_file(const char *path)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    assert_int_equal(tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &error), TN_OK);
    check_text(path, (const char *)bytes, size);
    free(bytes);
}

static void check_folder(const char *folder, const char *extension)
{
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[4096];
        struct stat status;
        size_t size = strlen(entry->d_name), end = strlen(extension);
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] == '.' || stat(path, &status) != 0)
            continue;
        if (S_ISDIR(status.st_mode))
            check_folder(path, extension);
        else if (size >= end && strcmp(entry->d_name + size - end, extension) == 0)
            check_file(path);
    }
    closedir(directory);
}

static void test_rule_files(void **state)
{
    (void)state;
    check_folder(TARTAN_SOURCE_DIR "/stdlib", ".plan");
    check_folder(TARTAN_SOURCE_DIR "/examples", ".plan");
    check_folder(TARTAN_SOURCE_DIR "/tests", ".plan");
    check_folder(TARTAN_SOURCE_DIR "/bench", ".plan");
    assert_true(formatted_files > 60);
    assert_true(compiled_files > 15);
}

static void test_fuzzed_files(void **state)
{
    (void)state;
    size_t before = formatted_files;
    check_folder(TARTAN_SOURCE_DIR "/tests/fuzz/corpus/plan", "");
    assert_true(formatted_files > before);
}

/* What ships is laid out so. */
static void test_standard_library_is_formatted(void **state)
{
    static const char *const names[] = {"lahave", "lahave-houses", "terrace"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[4096];
        uint8_t *bytes;
        size_t size;
        tn_error error;
        snprintf(path, sizeof path, "%s/%s.plan", stdlib_dirs[0], names[i]);
        assert_int_equal(tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &error), TN_OK);
        char *once = formatted(path, (const char *)bytes, size);
        assert_non_null(once);
        assert_string_equal(once, (const char *)bytes);
        free(once);
        free(bytes);
    }
}

static void assert_format(const char *text, const char *wanted)
{
    char *once = formatted("t.plan", text, strlen(text));
    assert_non_null(once);
    assert_string_equal(once, wanted);
    char *twice = formatted("t.plan", once, strlen(once));
    assert_string_equal(twice, wanted);
    assert_int_equal(count_lines_longer(once, TN_FORMAT_WIDTH), 0);
    free(once);
    free(twice);
}

static void test_layout(void **state)
{
    (void)state;
    assert_format("", "");
    assert_format("USE \"lahave\"   # why\r\n\r\n\r\n\r\nuse\n\"b.plan\"", "use \"lahave\"  # why\n\nuse \"b.plan\"\n");
    assert_format("RULE a=Tray( 8' ,not  great )", "rule a = tray(8', not great)\n");
}

static void test_comments(void **state)
{
    (void)state;
    assert_format("# head\n\n\n# of a\nrule a \"t\" = # one\n# two\nany # three\nor  # four\n not any\n# end\n",
                  "# head\n\n# of a\nrule a \"t\" =  # one\n  # two\n  any  # three\n  or   # four\n"
                  "  not any\n# end\n");
    assert_format("library l {trays 1..2 # few\n # none\n\n prune a # the first\n,b}#end",
                  "library l {\n  trays 1..2  # few\n  # none\n\n  prune a,  # the first\n      b\n}  #end\n");
}

static void test_lengths_stay_apart(void **state)
{
    (void)state;
    assert_format("test a { match [4'\n6\"] }", "test a {\n  match [4'\n  6\"]\n}\n");
}

static void test_clauses_named_by_lines(void **state)
{
    (void)state;
    assert_format("schema s { w = 4' | 8' } library l { trays 1..2 prune tray(4') and tray(8') }\n\n\n"
                  "test l { drop [4' | 8'] by prune@1 }",
                  "schema s {\n  w = 4' | 8'\n}\n\nlibrary l {\n  trays 1..2\n  prune tray(4') and tray(8')\n}\n\n"
                  "test l {\n  drop [4' | 8'] by prune@7\n}\n");
}

static void test_tables(void **state)
{
    (void)state;
    assert_format("rule a=any rule b=any test a,b{match reject[4'] \"x\" todo  match match [8' | 4' ]\n}",
                  "rule a = any\nrule b = any\n\ntest a, b {\n  match reject [4']  \"x\"\n"
                  "  todo  match match [8' | 4']\n}\n");
}

static void test_errors_are_left_alone(void **state)
{
    (void)state;
    assert_null(formatted("t.plan", "rule a = ", 9));
    assert_null(formatted("t.plan", "rule a = \xff", 10));
    enum { DEPTH = 3000 };
    static char deep[9 + 2 * DEPTH + 4];
    memcpy(deep, "rule a = ", 9);
    memset(deep + 9, '(', DEPTH);
    memcpy(deep + 9 + DEPTH, "any", 3);
    memset(deep + 9 + DEPTH + 3, ')', DEPTH);
    assert_null(formatted("t.plan", deep, 9 + 2 * DEPTH + 3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rule_files),
        cmocka_unit_test(test_fuzzed_files),
        cmocka_unit_test(test_standard_library_is_formatted),
        cmocka_unit_test(test_layout),
        cmocka_unit_test(test_comments),
        cmocka_unit_test(test_lengths_stay_apart),
        cmocka_unit_test(test_clauses_named_by_lines),
        cmocka_unit_test(test_tables),
        cmocka_unit_test(test_errors_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
