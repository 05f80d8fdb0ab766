/* Out of memory: each allocation of an operation fails once, and then once together with all after it. The operation
 * must say so, leave nothing behind (the sanitized build would see it) and work again afterwards. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "runtime/base/file.h"
#include "runtime/load.h"
#include "tests/support/failing_memory.h"
#include "tests/support/sample_module.h"

/* Does the operation; did it work? Where it did not, it has checked that it was told why. */
typedef bool (*operation)(void *context);

static void expect_robust(operation operate, void *context)
{
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            fail_allocation(number, all_after);
            bool worked = operate(context);
            bool reached = stop_failing() > number;
            if (!reached) {
                assert_true(worked);
                assert_true(number > 0); /* it allocates, or the test tests nothing */
                break;
            }
            assert_false(worked);
        }
    }
}

/* ---- building and loading */

typedef struct file_bytes {
    uint8_t *bytes;
    size_t size;
} file_bytes;

static file_bytes sample_file(void)
{
    file_bytes file;
    tn_builder *builder = sample_builder();
    assert_int_equal(tn_builder_finish(builder, &file.bytes, &file.size, NULL), TN_OK);
    tn_builder_free(builder);
    return file;
}

static bool build(void *context)
{
    (void)context;
    tn_builder *builder = sample_builder();
    if (!builder)
        return false;
    uint8_t *bytes;
    size_t size;
    tn_error error = {0};
    tn_status status = tn_builder_finish(builder, &bytes, &size, &error);
    tn_builder_free(builder);
    free(bytes);
    if (status == TN_OK)
        return true;
    assert_int_equal(status, TN_MEMORY);
    assert_int_equal(error.code, 801);
    assert_null(bytes);
    return false;
}

static void test_building(void **state)
{
    (void)state;
    expect_robust(build, NULL);
}

static bool load(void *context)
{
    const file_bytes *file = context;
    tn_module *module;
    tn_error error = {0};
    tn_status status = tn_module_load(file->bytes, file->size, NULL, &module, &error);
    if (status != TN_OK) {
        assert_int_equal(status, TN_MEMORY);
        assert_int_equal(error.code, 801);
        assert_null(module);
        return false;
    }
    tn_module_free(module);
    return true;
}

static void test_loading(void **state)
{
    (void)state;
    file_bytes file = sample_file();
    expect_robust(load, &file);
    free(file.bytes);
}

static bool list(void *context)
{
    FILE *out = fopen("/dev/null", "w"); /* its buffer comes from the C library's own malloc */
    bool worked = tn_module_disassemble(context, out);
    fclose(out);
    return worked;
}

static void test_listing(void **state)
{
    (void)state;
    file_bytes file = sample_file();
    tn_module *module;
    assert_int_equal(tn_module_load(file.bytes, file.size, NULL, &module, NULL), TN_OK);
    expect_robust(list, module);
    tn_module_free(module);
    free(file.bytes);
}

/* ---- files */

static bool read_back(void *context)
{
    uint8_t *bytes;
    size_t size;
    tn_error error = {0};
    tn_status status = tn_file_read(context, 1 << 20, &bytes, &size, &error);
    free(bytes);
    assert_true(status == TN_OK || (status == TN_MEMORY && error.code == E_OUT_OF_MEMORY && !bytes));
    return status == TN_OK;
}

static bool write_out(void *context)
{
    tn_output output;
    tn_error error = {0};
    tn_status status = tn_output_open(context, &output, &error);
    if (status != TN_OK) {
        assert_null(output.stream);
        return false;
    }
    for (int i = 0; i < 200000; i++)
        fputc('x', output.stream);
    return tn_output_commit(&output, &error) == TN_OK;
}

static void test_files(void **state)
{
    (void)state;
    char folder[] = "/tmp/tartan-test-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/file", folder);
    for (size_t number = 0; number < 2; number++) { /* the folder's name, for syncing it, may fail unseen */
        fail_allocation(number, 1);
        assert_false(write_out(path));
        stop_failing();
        assert_int_equal(access(path, F_OK), -1);
    }
    assert_true(write_out(path));
    expect_robust(read_back, path);
    unlink(path);
    assert_int_equal(rmdir(folder), 0); /* no temporary file stayed */
}

/* ---- the compiler's infrastructure */

static bool use_arena(void *context)
{
    (void)context;
    tn_arena *arena = tn_arena_new();
    if (!arena)
        return false;
    for (size_t i = 0; i < 50; i++) {
        char *memory = tn_arena_alloc(arena, i * 100);
        if (memory)
            memset(memory, 1, i * 100);
        assert_true(memory || tn_arena_failed(arena));
    }
    bool worked = !tn_arena_failed(arena);
    tn_arena_free(arena);
    return worked;
}

static void test_arena(void **state)
{
    (void)state;
    expect_robust(use_arena, NULL);
}

static bool add_sources(void *context)
{
    (void)context;
    tn_sources sources = {0};
    tn_error error = {0};
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < 20 && status == TN_OK; i++) {
        uint32_t file;
        status = tn_sources_add(&sources, "a.plan", "one\ntwo", 7, &file, &error);
    }
    assert_true(status == TN_OK || status == TN_MEMORY);
    tn_sources_clear(&sources);
    return status == TN_OK;
}

static void test_sources(void **state)
{
    (void)state;
    expect_robust(add_sources, NULL);
}

static void test_places_need_no_memory(void **state)
{
    (void)state;
    tn_sources sources = {0};
    uint32_t file;
    assert_int_equal(tn_sources_add(&sources, "a.plan", "one\ntwo\nthree", 13, &file, NULL), TN_OK);
    fail_allocation(0, 1);
    tn_place place = tn_sources_place(&sources, (tn_span){file, 9, 11});
    stop_failing();
    assert_int_equal(place.line, 3);
    assert_int_equal(place.column, 2);
    assert_int_equal(place.line_size, 5);
    tn_sources_clear(&sources);
}

static bool report(void *context)
{
    tn_diagnostics list;
    tn_diagnostics_init(&list, context);
    tn_span span = {0, 0, 1};
    for (int i = 0; i < 20; i++) {
        tn_diagnostic *item = tn_report(&list, E_UNEXPECTED, span, "number %d", i);
        assert_non_null(item);
        tn_note(&list, item, &span, "a note");
        tn_help(&list, item, "a help");
    }
    tn_error error;
    tn_fail(&error, TN_INVALID, E_PLAN_SYNTAX, "unreadable");
    tn_error_place(&error, 1, 1, 2);
    tn_error_help(&error, "a help");
    tn_report_error(&list, &error, "plans.txt", "x", 1);
    tn_diagnostics_sort(&list);
    FILE *out = fopen("/dev/null", "w");
    tn_diagnostics_show(&list, &(tn_show_options){0}, out);
    tn_diagnostics_show(&list, &(tn_show_options){.json = true}, out);
    fclose(out);
    assert_int_equal(list.error_count, 21); /* counted, whatever became of the text */
    bool worked = !list.failed;
    tn_diagnostics_clear(&list);
    return worked;
}

static void test_diagnostics(void **state)
{
    (void)state;
    tn_sources sources = {0};
    uint32_t file;
    assert_int_equal(tn_sources_add(&sources, "a.plan", "x\n", 2, &file, NULL), TN_OK);
    tn_sources_place(&sources, (tn_span){0}); /* finds the lines, which may fail unseen */
    expect_robust(report, &sources);
    tn_sources_clear(&sources);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_building),
        cmocka_unit_test(test_loading),
        cmocka_unit_test(test_listing),
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_arena),
        cmocka_unit_test(test_sources),
        cmocka_unit_test(test_places_need_no_memory),
        cmocka_unit_test(test_diagnostics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
