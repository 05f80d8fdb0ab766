/* What the compiler makes of the stdlib, as the loader sees it: refused in every truncation and with any byte changed;
 * with the hash made right again refused or harmless. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/module/builder.h"
#include "runtime/module/module.h"
#include "tests/support/compile_file.h"

static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
static const library_folders options = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};
static const char *const files[] = {TARTAN_SOURCE_DIR "/stdlib/lahave.plan", TARTAN_SOURCE_DIR "/stdlib/terrace.plan",
                                    TARTAN_SOURCE_DIR "/stdlib/lahave-houses.plan",
                                    TARTAN_SOURCE_DIR "/tests/plan/semantics.plan",
                                    TARTAN_SOURCE_DIR "/examples/learning-a-rule/learn.study"};

enum { FILES = sizeof files / sizeof *files };

static void compile(const char *path, tn_compilation *compilation)
{
    tn_status status = compile_file(path, &options, compilation);
    if (status != TN_OK || !compilation->module)
        fail_msg("%s does not compile", path);
}

/* A reproducible choice of places and values: changing every byte to every value would take minutes. */
static size_t next(uint64_t *random, size_t below)
{
    *random = *random * 6364136223846793005u + 1442695040888963407u;
    return (size_t)((*random >> 33) % below);
}

static void test_they_load(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILES; i++) {
        tn_compilation compilation;
        tn_module *module;
        tn_error error = {0};
        compile(files[i], &compilation);
        if (tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error) != TN_OK)
            fail_msg("%s: %s", files[i], error.message);
        tn_module_free(module);
        tn_compilation_clear(&compilation);
    }
}

static void test_compiling_again_gives_the_same_bytes(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILES; i++) {
        tn_compilation first, second;
        compile(files[i], &first);
        compile(files[i], &second);
        assert_int_equal(first.module_size, second.module_size);
        assert_memory_equal(first.module, second.module, first.module_size);
        tn_compilation_clear(&first);
        tn_compilation_clear(&second);
    }
}

static void test_every_truncation_is_refused(void **state)
{
    (void)state;
    tn_compilation compilation;
    compile(files[0], &compilation);
    for (size_t size = 0; size < compilation.module_size; size++) {
        uint8_t *part = malloc(size + !size);
        memcpy(part, compilation.module, size);
        tn_module *module;
        assert_int_equal(tn_module_load(part, size, NULL, &module, NULL), TN_INVALID);
        free(part);
    }
    tn_compilation_clear(&compilation);
}

static void test_every_changed_byte_is_refused(void **state)
{
    (void)state;
    tn_compilation compilation;
    compile(files[0], &compilation);
    uint64_t random = 1;
    for (size_t at = 0; at < compilation.module_size; at++) {
        uint8_t change = (uint8_t)(1 + next(&random, 255));
        tn_module *module;
        compilation.module[at] ^= change;
        assert_int_equal(tn_module_load(compilation.module, compilation.module_size, NULL, &module, NULL), TN_INVALID);
        compilation.module[at] ^= change;
    }
    tn_compilation_clear(&compilation);
}

static void walk(const tn_module *module)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_true(tn_module_disassemble(module, out));
    fclose(out);
    free(text);
}

/* One to four bytes changed at once. */
static void test_changes_with_the_right_hash_are_harmless(void **state)
{
    (void)state;
    size_t refused = 0, loaded = 0;
    uint64_t random = 7;
    for (size_t i = 0; i < FILES; i++) {
        tn_compilation compilation;
        compile(files[i], &compilation);
        uint8_t *changed = malloc(compilation.module_size);
        for (size_t round = 0; round < 3000; round++) {
            memcpy(changed, compilation.module, compilation.module_size);
            for (size_t k = 0; k <= round % 4; k++)
                changed[next(&random, compilation.module_size)] ^= (uint8_t)(1 + next(&random, 255));
            tn_module_rehash(changed, compilation.module_size);
            tn_module *module;
            if (tn_module_load(changed, compilation.module_size, NULL, &module, NULL) == TN_OK) {
                loaded++;
                walk(module);
            } else {
                refused++;
            }
            tn_module_free(module);
        }
        free(changed);
        tn_compilation_clear(&compilation);
    }
    assert_true(refused > 1000 && loaded > 100); /* both happen, or the test tests nothing */
}

/* A form whose walls and roofs have layers of lengths that nothing else has. */
static const char layered[] = "schema s { front = 4m  zone body role band = space(6m) role void }\n"
                              "form f of s { storey ground 3m wall outside 200mm { boards 63mm, studs 137mm }\n"
                              "  partition 100mm { studs 100mm } floor 300mm roof 240mm { tiles 31mm, rafters 209mm } function hall at cell(body) }\n";

/* Puts another number, of eight bytes, in the place of one that is there once. */
static void put_in_place(uint8_t *bytes, size_t size, int64_t from, int64_t to)
{
    size_t found = 0, at = 0;
    for (size_t i = 0; i + sizeof from <= size; i++)
        if (memcmp(bytes + i, &from, sizeof from) == 0) {
            found++;
            at = i;
        }
    assert_int_equal(found, 1);
    memcpy(bytes + at, &to, sizeof to);
    tn_module_rehash(bytes, size);
}

static void test_layers_fill_what_they_are_layers_of(void **state)
{
    (void)state;
    static const struct {
        int64_t from, thick;
        const char *reason;
    } changes[] = {{INT64_C(137000000), INT64_C(137000001), "not as thick as it is"},
                   {INT64_C(137000001), INT64_C(136999999), "not as thick as it is"},
                   {INT64_C(136999999), INT64_C(-137000000), "thick"},
                   {INT64_C(-137000000), INT64_C(137000000), NULL},
                   {INT64_C(209000000), INT64_C(209000001), "layers of a roof are not as thick as it is"},
                   {INT64_C(209000001), INT64_C(209000000), NULL}};
    tn_compilation compilation;
    assert_int_equal(compile_text("layered.plan", layered, sizeof layered - 1, &options, &compilation), TN_OK);
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        tn_module *module;
        tn_error error = {0};
        put_in_place(compilation.module, compilation.module_size, changes[i].from, changes[i].thick);
        tn_status status = tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error);
        assert_int_equal(status, changes[i].reason ? TN_INVALID : TN_OK);
        if (changes[i].reason && !strstr(error.message, changes[i].reason))
            fail_msg("refused as: %s", error.message);
        tn_module_free(module);
    }
    tn_compilation_clear(&compilation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_they_load),
        cmocka_unit_test(test_compiling_again_gives_the_same_bytes),
        cmocka_unit_test(test_every_truncation_is_refused),
        cmocka_unit_test(test_every_changed_byte_is_refused),
        cmocka_unit_test(test_changes_with_the_right_hash_are_harmless),
        cmocka_unit_test(test_layers_fill_what_they_are_layers_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
