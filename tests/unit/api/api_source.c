/* Rule files with their source through the C interface: layout, tests, coverage, reports, cancelling, and misuse. */
#include "include/tartan/tartan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                           "rule pair = neighbour(tray(lid), tray(lid))\n"
                           "library rows using box { trays 1..3 prune pair }\n"
                           "test pair {\n"
                           "  match [1m lid | 1m lid]\n"
                           "  reject [1m | 1m lid]\n"
                           "  match [1m | 1m] \"this is wrong\"\n"
                           "  todo match [2m | 2m]\n"
                           "  todo match [2m lid | 2m lid]\n"
                           "}\n";

static tartan_source *source_of(const char *path, const char *rules)
{
    tartan_source *source = NULL;
    tartan_error error;
    if (tartan_source_open(path, rules, strlen(rules), NULL, &source, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return source;
}

static bool refuse(void *context, double done, double total)
{
    (void)done, (void)total;
    ++*(unsigned *)context;
    return false;
}

static void tells_what_became_of_each_test(void **state)
{
    (void)state;
    static const tartan_test_outcome wanted[] = {TARTAN_TEST_PASSED, TARTAN_TEST_PASSED, TARTAN_TEST_FAILED,
                                                 TARTAN_TEST_TODO, TARTAN_TEST_DONE};
    tartan_source *source = source_of("box.plan", text);
    tartan_error error;
    for (int round = 0; round < 2; round++) { /* the source stays as it was */
        tartan_tests *tests = NULL;
        if (tartan_source_test(source, 0, NULL, &tests, &error) != TARTAN_OK)
            fail_msg("%s", error.message);
        assert_int_equal(tartan_tests_count(tests), 5);
        assert_int_equal(tartan_tests_failed(tests), 2);
        for (size_t i = 0; i < 5; i++) {
            tartan_test_case test = tartan_test_case_init();
            assert_int_equal(tartan_tests_case(tests, i, &test, &error), TARTAN_OK);
            assert_int_equal(test.outcome, wanted[i]);
            assert_string_equal(test.subject, "pair");
            assert_string_equal(test.path, "box.plan");
            assert_true(test.source_begin < test.source_end && test.source_end < sizeof text);
            if (i == 2) {
                assert_string_equal(test.doc, "this is wrong");
                assert_string_equal(test.message, "`pair` should match this plan, and does not");
            }
            assert_true((test.message != NULL) == (i == 2 || i == 4));
        }
        tartan_test_case test = tartan_test_case_init();
        assert_int_equal(tartan_tests_case(tests, 5, &test, &error), TARTAN_INVALID);
        tartan_tests_free(tests);
    }
    assert_int_equal(tartan_module_rule_count(tartan_source_module(source)), 1);
    tartan_source_free(source);
}

/* The library that is in the program has the bytes of that of the sources. */
static void has_the_standard_library(void **state)
{
    (void)state;
    size_t count = tartan_stdlib_count(), size = 1;
    assert_true(count > 30);
    for (size_t i = 0; i < count; i++) {
        char path[1000], *kept = malloc(1 << 20);
        const char *name = tartan_stdlib_name(i), *found = tartan_stdlib_text(name, &size);
        assert_true(i == 0 || strcmp(tartan_stdlib_name(i - 1), name) < 0);
        snprintf(path, sizeof path, "%s/stdlib/%s", TARTAN_SOURCE_DIR, name);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        assert_non_null(kept);
        assert_int_equal(fread(kept, 1, 1 << 20, file), size);
        assert_memory_equal(kept, found, size);
        assert_int_equal(found[size], '\0');
        fclose(file);
        free(kept);
    }
    assert_null(tartan_stdlib_name(count));
    assert_null(tartan_stdlib_text("shapes", &size));
    assert_int_equal(size, 0);
    assert_null(tartan_stdlib_text(NULL, NULL));
}

static tartan_status compile(const char *path, const char *rules, const tartan_compile_options *options,
                             tartan_error *error)
{
    tartan_module *module = NULL;
    tartan_status status = tartan_compile_text(path, rules, strlen(rules), options, &module, error);
    tartan_module_free(module);
    return status;
}

static void uses_the_standard_library_without_folders(void **state)
{
    (void)state;
    const char *const nowhere[] = {"/nowhere"};
    tartan_compile_options options = tartan_compile_options_init();
    tartan_error error;
    assert_int_equal(compile("a.field", "use \"shapes\"\nsurface s = block(x, y, z, 1, 1, 1)\n", NULL, &error),
                     TARTAN_OK);
    assert_int_equal(compile("a.plan", "use \"lahave-houses\"\n", &options, &error), TARTAN_OK);
    assert_int_equal(compile("a.plan", "use \"lahav\"\n", &options, &error), TARTAN_INVALID);
    assert_string_equal(error.message, "the standard library has no `lahav`");
    assert_string_equal(error.help, "did you mean `lahave`?");
    options.folders = nowhere;
    options.folder_count = 1;
    assert_int_equal(compile("a.plan", "use \"lahave\"\n", &options, &error), TARTAN_INVALID);
}

static void tells_what_tests_cover(void **state)
{
    (void)state;
    tartan_source *source = source_of("box.plan", text);
    tartan_coverage *coverage = NULL;
    tartan_covered_part part = tartan_covered_part_init();
    tartan_error error;
    if (tartan_source_cover(source, NULL, 0, NULL, &coverage, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_true(tartan_coverage_count(coverage) >= 3 && tartan_coverage_noticed(coverage) > 0);
    assert_int_equal(tartan_coverage_part(coverage, 0, &part, &error), TARTAN_OK);
    assert_string_equal(part.rule, "pair");
    assert_int_equal(part.depth, 0);
    assert_string_equal(part.kind, "neighbour");
    assert_string_equal(part.plans, "28"); /* 4 of two trays, 24 of three */
    assert_true(part.noticed);
    assert_int_equal(tartan_coverage_part(coverage, 1000, &part, &error), TARTAN_INVALID);
    tartan_coverage_free(coverage);
    tartan_source_free(source);
}

static void writes_a_report(void **state)
{
    (void)state;
    tartan_source *source = source_of("box.plan", text);
    char *page = NULL;
    size_t size;
    tartan_error error;
    if (tartan_source_report(source, NULL, NULL, &page, &size, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(strlen(page), size);
    assert_non_null(strstr(page, "</html>"));
    tartan_text_free(page);
    tartan_report_options options = tartan_report_options_init();
    options.library = "row";
    assert_int_equal(tartan_source_report(source, &options, NULL, &page, &size, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "did you mean `rows`?");
    options.library = NULL;
    options.samples = 2001;
    assert_int_equal(tartan_source_report(source, &options, NULL, &page, &size, &error), TARTAN_LIMIT);
    tartan_source_free(source);
}

static void count(void *context, const tartan_diagnostic *diagnostic)
{
    *(size_t *)context += diagnostic->severity == TARTAN_ERROR;
}

static void lays_texts_out(void **state)
{
    (void)state;
    static const char rough[] = "surface   ball=x*x+1   # a note\n", wrong[] = "surface = = 1\n";
    char *laid = NULL, *again = NULL;
    size_t size, again_size, errors = 0;
    tartan_error error;
    assert_int_equal(tartan_format_text("a.field", rough, sizeof rough - 1, NULL, NULL, &laid, &size, &error),
                     TARTAN_OK);
    assert_string_equal(laid, "surface ball = x*x + 1  # a note\n");
    assert_int_equal(tartan_format_text("a.field", laid, size, NULL, NULL, &again, &again_size, &error), TARTAN_OK);
    assert_string_equal(again, laid);
    tartan_text_free(laid);
    tartan_text_free(again);
    laid = NULL;
    assert_int_equal(tartan_format_text("a.field", wrong, sizeof wrong - 1, count, &errors, &laid, &size, &error),
                     TARTAN_INVALID);
    assert_true(errors > 0 && error.message[0] && !laid);
    assert_int_equal(tartan_format_text(NULL, rough, 1, NULL, NULL, &laid, &size, &error), TARTAN_INVALID);
    assert_int_equal(tartan_format_text("a.field", NULL, 1, NULL, NULL, &laid, &size, &error), TARTAN_INVALID);
    assert_int_equal(tartan_format_text("a.plan", NULL, 0, NULL, NULL, &laid, &size, &error), TARTAN_OK);
    assert_int_equal(size, 0);
    tartan_text_free(laid);
}

static void refuses_misuse(void **state)
{
    (void)state;
    tartan_source *source = NULL, *field = source_of("a.field", "surface a = x\nbox (-1, -1, -1)..(1, 1, 1)\n");
    tartan_tests *tests = NULL;
    tartan_coverage *coverage = NULL;
    char *page = NULL;
    size_t size;
    tartan_error error;
    assert_int_equal(tartan_source_open("a.plan", "rule", 4, NULL, &source, &error), TARTAN_INVALID);
    assert_int_equal(tartan_source_open("/nowhere/a.plan", NULL, 0, NULL, &source, &error), TARTAN_IO);
    assert_int_equal(tartan_source_open(NULL, text, 0, NULL, &source, &error), TARTAN_INVALID);
    assert_int_equal(tartan_source_open("a.plan", text, 4, NULL, NULL, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_source_test(NULL, 0, NULL, &tests, &error), TARTAN_INVALID);
    assert_int_equal(tartan_source_test(field, 0, NULL, &tests, &error), TARTAN_INVALID);
    assert_int_equal(tartan_source_test(field, 0, NULL, NULL, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_source_cover(field, NULL, 0, NULL, &coverage, &error), TARTAN_INVALID);
    assert_int_equal(tartan_source_report(field, NULL, NULL, &page, &size, &error), TARTAN_INVALID);
    assert_true(error.message[0]);
    assert_int_equal(tartan_source_report(field, &(tartan_report_options){0}, NULL, &page, &size, &error),
                     TARTAN_INVALID);
    assert_true(!source && !tests && !coverage && !page);
    tartan_source_free(NULL);
    tartan_tests_free(NULL);
    tartan_coverage_free(NULL);
    tartan_source_free(field);
}

static void can_be_stopped(void **state)
{
    (void)state;
    tartan_source *source = source_of("box.plan", text), *none = NULL;
    const tartan_module *module = tartan_source_module(source);
    unsigned asked = 0;
    tartan_watch watch = tartan_watch_init();
    tartan_compile_options options = tartan_compile_options_init();
    tartan_tests *tests = NULL;
    tartan_coverage *coverage = NULL;
    tartan_explanation *why = NULL;
    tartan_error error;
    char *page = NULL;
    size_t size;
    watch.go_on = refuse;
    watch.context = &asked;
    options.watch = &watch;
    assert_int_equal(tartan_source_open("box.plan", text, sizeof text - 1, &options, &none, &error), TARTAN_STOPPED);
    assert_string_equal(error.message, "stopped before it was done");
    assert_int_equal(tartan_source_test(source, 0, &watch, &tests, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_source_cover(source, NULL, 0, &watch, &coverage, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_source_report(source, NULL, &watch, &page, &size, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_explain_rules(module, NULL, 0, (uint32_t[]){1, 1}, 2, &watch, &why, &error),
                     TARTAN_STOPPED);
    assert_true(asked >= 5 && !none && !tests && !coverage && !page && !why);
    /* and afterwards all is as before */
    assert_int_equal(tartan_source_test(source, 0, NULL, &tests, &error), TARTAN_OK);
    tartan_tests_free(tests);
    tartan_source_free(source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(has_the_standard_library),
        cmocka_unit_test(uses_the_standard_library_without_folders),
        cmocka_unit_test(tells_what_became_of_each_test),
        cmocka_unit_test(tells_what_tests_cover),
        cmocka_unit_test(writes_a_report),
        cmocka_unit_test(lays_texts_out),
        cmocka_unit_test(refuses_misuse),
        cmocka_unit_test(can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
