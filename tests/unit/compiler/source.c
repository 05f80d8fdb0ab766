/* Source texts: lines and columns of byte ranges. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/common/source.h"

static tn_sources sources_of(const char *text, size_t size)
{
    tn_sources sources = {0};
    uint32_t file;
    assert_int_equal(tn_sources_add(&sources, "a.plan", text, size, &file, NULL), TN_OK);
    assert_int_equal(file, 0);
    return sources;
}

static void expect(tn_sources *sources, uint32_t begin, uint32_t end, size_t line, size_t column, size_t end_line,
                   size_t end_column, const char *text)
{
    tn_place place = tn_sources_place(sources, (tn_span){0, begin, end});
    assert_string_equal(place.path, "a.plan");
    assert_int_equal(place.line, line);
    assert_int_equal(place.column, column);
    assert_int_equal(place.end_line, end_line);
    assert_int_equal(place.end_column, end_column);
    assert_int_equal(place.line_size, strlen(text));
    assert_memory_equal(place.line_text, text, strlen(text));
}

static void test_lines_and_columns(void **state)
{
    (void)state;
    const char *text = "one\ntwo\r\n\nfour";
    tn_sources sources = sources_of(text, strlen(text));
    expect(&sources, 0, 3, 1, 1, 1, 4, "one");
    expect(&sources, 3, 3, 1, 4, 1, 4, "one"); /* the line's end belongs to it */
    expect(&sources, 4, 8, 2, 1, 2, 5, "two");
    expect(&sources, 9, 10, 3, 1, 4, 1, "");
    expect(&sources, 1, 12, 1, 2, 4, 3, "one");
    expect(&sources, 14, 14, 4, 5, 4, 5, "four"); /* the end of the file */
    tn_sources_clear(&sources);
    assert_int_equal(sources.count, 0);
}

static void test_end_after_a_last_line_end(void **state)
{
    (void)state;
    tn_sources sources = sources_of("a\n", 2);
    expect(&sources, 2, 2, 2, 1, 2, 1, "");
    tn_sources_clear(&sources);
    sources = sources_of("", 0);
    expect(&sources, 0, 0, 1, 1, 1, 1, "");
    tn_sources_clear(&sources);
}

static void test_columns_count_bytes(void **state)
{
    (void)state;
    const char *text = "\xE6\xBC\xA2 x";
    tn_sources sources = sources_of(text, strlen(text));
    expect(&sources, 4, 5, 1, 5, 1, 6, text);
    tn_sources_clear(&sources);
}

static void test_byte_order_mark_is_not_counted(void **state)
{
    (void)state;
    const char *text = "\xEF\xBB\xBFone\ntwo";
    tn_sources sources = sources_of(text, strlen(text));
    expect(&sources, 3, 6, 1, 1, 1, 4, "one");
    expect(&sources, 0, 3, 1, 1, 1, 1, "one");
    expect(&sources, 7, 10, 2, 1, 2, 4, "two");
    tn_sources_clear(&sources);
}

/* The place of any span, found with the table of lines and by walking, is what counting by hand gives. */
static void test_every_span(void **state)
{
    (void)state;
    const char *text = "\n\nab\n\r\nc\n";
    uint32_t size = (uint32_t)strlen(text);
    tn_sources sources = sources_of(text, size);
    for (uint32_t begin = 0; begin <= size; begin++) {
        size_t line = 1, column = 1;
        for (uint32_t i = 0; i < begin; i++) {
            column = text[i] == '\n' ? 1 : column + 1;
            line += text[i] == '\n';
        }
        tn_place place = tn_sources_place(&sources, (tn_span){0, begin, begin});
        assert_int_equal(place.line, line);
        assert_int_equal(place.column, column);
    }
    tn_sources_clear(&sources);
}

static void test_spans_outside_are_cut(void **state)
{
    (void)state;
    tn_sources sources = sources_of("abc", 3);
    expect(&sources, 7, 9, 1, 4, 1, 4, "abc");
    expect(&sources, 2, 1, 1, 3, 1, 3, "abc");
    tn_place place = tn_sources_place(&sources, (tn_span){5, 0, 0});
    assert_int_equal(place.line, 0);
    assert_string_equal(place.path, "");
    tn_sources_clear(&sources);
}

static void test_two_zero_bytes_follow(void **state)
{
    (void)state;
    tn_sources sources = sources_of("abc", 3);
    assert_memory_equal(sources.files[0].text, "abc\0\0", 5);
    tn_sources_clear(&sources);
}

static void test_too_large(void **state)
{
    (void)state;
    tn_sources sources = {0};
    tn_error error;
    uint32_t file;
    char *text = calloc(TN_SOURCE_BYTES_MAX + 1u, 1);
    assert_int_equal(tn_sources_add(&sources, "big", text, TN_SOURCE_BYTES_MAX + 1u, &file, &error), TN_LIMIT);
    assert_int_equal(error.code, 804);
    assert_string_equal(error.message, "big is 16777217 bytes long; the limit for a source file is 16777216");
    for (uint32_t i = 0; i < TN_SOURCES_BYTES_MAX / TN_SOURCE_BYTES_MAX; i++)
        assert_int_equal(tn_sources_add(&sources, "big", text, TN_SOURCE_BYTES_MAX, &file, &error), TN_OK);
    assert_int_equal(tn_sources_add(&sources, "small", "x", 1, &file, &error), TN_LIMIT);
    assert_int_equal(error.code, 804);
    assert_string_equal(error.message, "with small the source files together pass the limit of 67108864 bytes");
    assert_int_equal(tn_sources_add(&sources, "empty", "", 0, &file, &error), TN_OK);
    free(text);
    tn_sources_clear(&sources);
}

static void test_many_files(void **state)
{
    (void)state;
    tn_sources sources = {0};
    for (uint32_t i = 0; i < 100; i++) {
        uint32_t file;
        assert_int_equal(tn_sources_add(&sources, "f", "x\ny", 3, &file, NULL), TN_OK);
        assert_int_equal(file, i);
    }
    assert_int_equal(tn_sources_place(&sources, (tn_span){99, 2, 3}).line, 2);
    tn_sources_clear(&sources);
}

static void test_joining(void **state)
{
    (void)state;
    tn_span joined = tn_span_join((tn_span){1, 2, 4}, (tn_span){1, 6, 9});
    assert_int_equal(joined.begin, 2);
    assert_int_equal(joined.end, 9);
    joined = tn_span_join((tn_span){1, 2, 8}, (tn_span){1, 3, 4});
    assert_int_equal(joined.end, 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines_and_columns),
        cmocka_unit_test(test_end_after_a_last_line_end),
        cmocka_unit_test(test_columns_count_bytes),
        cmocka_unit_test(test_byte_order_mark_is_not_counted),
        cmocka_unit_test(test_every_span),
        cmocka_unit_test(test_spans_outside_are_cut),
        cmocka_unit_test(test_two_zero_bytes_follow),
        cmocka_unit_test(test_too_large),
        cmocka_unit_test(test_many_files),
        cmocka_unit_test(test_joining),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
