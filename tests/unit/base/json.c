/* JSON: whatever a string or a number is, what is written is valid and reads back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>

#include "runtime/base/json.h"
#include "runtime/base/random.h"
#include "runtime/base/utf8.h"

/* The text that was written, as an independent reader has it; the caller frees it. */
static json_t *read_back(const tn_buffer *text)
{
    json_error_t error;
    json_t *json =
        json_loadb(text->data, text->size, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES | JSON_ALLOW_NUL, &error);
    if (!json)
        fail_msg("%s at %d in: %s", error.text, error.position, text->data);
    return json;
}

/* What a string's bytes are shown as: each that is no UTF-8 becomes U+FFFD. */
static void shown(const char *bytes, size_t size, tn_buffer *out)
{
    for (size_t i = 0, step; i < size; i += step) {
        if (tn_utf8_read(bytes + i, size - i, &step) == TN_REPLACEMENT && step == 1)
            tn_buffer_append(out, "\xEF\xBF\xBD", 3);
        else
            tn_buffer_append(out, bytes + i, step);
    }
}

/* Writes it as an item, as a member and as a key, and compares what is read. */
static void check_string(const char *bytes, size_t size)
{
    tn_buffer text = {0}, expected = {0};
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_bytes(&json, "bytes", bytes, size);
    tn_json_list(&json, "list");
    tn_json_bytes(&json, NULL, bytes, size);
    tn_json_list_end(&json);
    if (!memchr(bytes, 0, size)) {
        char *key = strndup(bytes, size);
        tn_json_object(&json, "object");
        tn_json_string(&json, key, key);
        tn_json_object_end(&json);
        free(key);
    }
    tn_json_object_end(&json);
    shown(bytes, size, &expected);
    json_t *root = read_back(&text);
    const json_t *value = json_object_get(root, "bytes");
    assert_int_equal(json_string_length(value), expected.size);
    assert_memory_equal(json_string_value(value), expected.data ? expected.data : "", expected.size);
    assert_true(json_equal(value, json_array_get(json_object_get(root, "list"), 0)));
    json_t *object = json_object_get(root, "object");
    if (object)
        assert_true(json_equal(json_object_iter_value(json_object_iter(object)), value));
    for (size_t i = 0; i < text.size; i++) /* nothing that changes a terminal, and no line ends */
        assert_true((unsigned char)text.data[i] >= 0x20 && text.data[i] != 0x7F);
    assert_true(tn_is_utf8(text.data, text.size));
    json_decref(root);
    free(text.data);
    free(expected.data);
}

static void test_every_short_string(void **state)
{
    (void)state;
    check_string("", 0);
    for (int a = 0; a < 256; a++) {
        check_string((const char[]){(char)a}, 1);
        for (int b = 0; b < 256; b++)
            check_string((const char[]){(char)a, (char)b}, 2);
    }
}

static void test_words(void **state)
{
    (void)state;
    static const char *const words[] = {
        "7'-9\"",                              /* feet and inches */
        "C:\\drawings\\\"north\"\\",           /* backslashes, also at the end */
        "line\nline\r\n\ttab\b\f\x1b[31m\x7f", /* control characters */
        "\xE2\x80\xA8\xE2\x80\xA9",            /* line and paragraph separators */
        "\xE2\x80\xAE"
        "abc\xE2\x80\xAC\xD7\xA9\xD7\x9C\xD7\x95\xD7\x9D",               /* right to left */
        "\xF0\x9F\x8F\xA0 \xF0\x9F\x91\xA9\xE2\x80\x8D\xF0\x9F\x8E\xA8", /* beyond the basic plane */
        "</script><!-- \\u0000 %s %n",
        "\xED\xA0\x80 \xC0\xAF \xF4\x90\x80\x80 \xE2\x82 ok\xFF", /* surrogates, overlong, too large, cut short */
        "\xEF\xBF\xBD",                                           /* the replacement itself */
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        check_string(words[i], strlen(words[i]));
}

static void test_random_strings(void **state)
{
    (void)state;
    char bytes[40];
    for (uint64_t seed = 0; seed < 20000; seed++) {
        for (size_t i = 0; i < sizeof bytes; i++)
            bytes[i] = (char)tn_random64(seed, 0, i);
        check_string(bytes, seed % (sizeof bytes + 1));
    }
}

/* Exactly what stands in the text: strings may stand in a page and on a terminal. */
static void test_escapes(void **state)
{
    (void)state;
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_json_string(&json, NULL, "\"\\/</\b\f\n\r\t\x01\x7f\xC2\x85\xE2\x80\xA8\xE2\x80\xAE\xC3\xA9\xFF");
    assert_string_equal(text.data,
                        "\"\\\"\\\\/<\\/\\b\\f\\n\\r\\t\\u0001\\u007f\\u0085\\u2028\\u202e\xC3\xA9\xEF\xBF\xBD\"");
    free(text.data);
}

/* ---- numbers */

static void check_number(double value)
{
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_json_list(&json, NULL);
    tn_json_number(&json, NULL, value);
    tn_json_list_end(&json);
    json_t *root = read_back(&text);
    const json_t *item = json_array_get(root, 0);
    if (!isfinite(value)) {
        assert_true(json_is_null(item));
    } else {
        double read = strtod(text.data + 1, NULL);
        assert_true(json_is_number(item) && read == value && signbit(read) == signbit(value));
    }
    json_decref(root);
    free(text.data);
}

static void test_numbers(void **state)
{
    (void)state;
    static const double values[] = {0,        -0.0,      1,    -1,   0.1,     1.0 / 3,   5e-324,
                                    1e-7,     1e15,      1e16, 1e17, 1.7e308, 0.1 + 0.2, 123456789012345680.0,
                                    INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        check_number(values[i]);
    for (uint64_t seed = 0; seed < 20000; seed++) {
        uint64_t bits = tn_random64(seed, 1, 0);
        double value;
        memcpy(&value, &bits, sizeof value);
        check_number(value);
    }
}

static void test_whole_numbers(void **state)
{
    (void)state;
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    mpz_t large;
    mpz_init_set_str(large, "-123456789012345678901234567890", 10);
    tn_json_object(&json, NULL);
    tn_json_whole(&json, "least", INT64_MIN);
    tn_json_count(&json, "most", UINT64_MAX);
    tn_json_digits(&json, "large", large);
    tn_json_rounded(&json, "rounded", 1.0 / 3, 3);
    tn_json_rounded(&json, "none", NAN, 3);
    tn_json_numbers(&json, "three", (const double[]){0.5, -2, INFINITY}, 3);
    tn_json_object_end(&json);
    assert_string_equal(text.data, "{\"least\":-9223372036854775808,\"most\":18446744073709551615,"
                                   "\"large\":\"-123456789012345678901234567890\",\"rounded\":0.333,\"none\":null,"
                                   "\"three\":[0.5,-2,null]}");
    mpz_clear(large);
    free(text.data);
}

/* ---- layouts */

static void write_sample(tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "name", "a");
    tn_json_string(json, "none", NULL);
    tn_json_list(json, "list");
    tn_json_bool(json, NULL, true);
    tn_json_object(json, NULL);
    tn_json_null(json, "x");
    tn_json_object_end(json);
    tn_json_list_end(json);
    tn_json_list(json, "empty");
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_end_line(json);
}

static void check_layout(tn_json_layout layout, const char *expected)
{
    tn_buffer text = {0};
    char *written = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&written, &size);
    tn_json to_text = tn_json_text(&text, layout), to_file = tn_json_file(file, layout);
    for (int i = 0; i < 2; i++) { /* lines of JSON: the second begins like the first */
        write_sample(&to_text);
        write_sample(&to_file);
    }
    fclose(file);
    size_t once = strlen(expected);
    assert_int_equal(text.size, 2 * once);
    assert_memory_equal(text.data, expected, once);
    assert_memory_equal(text.data + once, expected, once);
    assert_string_equal(text.data, written);
    free(text.data);
    free(written);
}

static void test_layouts(void **state)
{
    (void)state;
    check_layout(TN_JSON_TIGHT, "{\"name\":\"a\",\"none\":null,\"list\":[true,{\"x\":null}],\"empty\":[]}\n");
    check_layout(TN_JSON_SPACED, "{\"name\": \"a\", \"none\": null, \"list\": [true, {\"x\": null}], \"empty\": []}\n");
    check_layout(TN_JSON_LINES, "{\n  \"name\": \"a\",\n  \"none\": null,\n  \"list\": [\n    true,\n    {\n"
                                "      \"x\": null\n    }\n  ],\n  \"empty\": []\n}\n");
    check_layout((tn_json_layout){.spaced = true, .lines = 1, .indent = 1},
                 "{\n \"name\": \"a\",\n \"none\": null,\n \"list\": [true, {\"x\": null}],\n \"empty\": []\n}\n");
}

/* What one writer wrote goes into the text of another as if it had been written there. */
static void test_written(void **state)
{
    (void)state;
    const tn_json_layout layouts[] = {TN_JSON_TIGHT, TN_JSON_SPACED, TN_JSON_LINES};
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        for (int before = 0; before < 2; before++) {
            tn_buffer part = {0}, text = {0}, straight = {0};
            tn_json inner = tn_json_text(&part, layouts[i]), outer = tn_json_text(&text, layouts[i]);
            tn_json whole = tn_json_text(&straight, layouts[i]);
            tn_json *const both[] = {&outer, &whole};
            inner.depth = 1;
            tn_json_whole(&inner, "b", 2);
            tn_json_whole(&inner, "c", 3);
            for (int k = 0; k < 2; k++) {
                tn_json_object(both[k], NULL);
                if (before)
                    tn_json_whole(both[k], "a", 1);
            }
            tn_json_written(&outer, part.data, part.size);
            tn_json_written(&outer, NULL, 0);
            tn_json_whole(&whole, "b", 2);
            tn_json_whole(&whole, "c", 3);
            for (int k = 0; k < 2; k++) {
                tn_json_whole(both[k], "d", 4);
                tn_json_object_end(both[k]);
            }
            assert_string_equal(text.data, straight.data);
            free(part.data);
            free(text.data);
            free(straight.data);
        }
    }
}

static void test_places(void **state)
{
    (void)state;
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_json_list(&json, NULL);
    tn_json_object(&json, NULL);
    tn_json_place_whole(&json, &(tn_json_place){"my \"plans\".plan", 3, 7, 4, 1});
    tn_json_object_end(&json);
    tn_json_object(&json, NULL);
    tn_json_place_begin(&json, &(tn_json_place){.line = 3});
    tn_json_object_end(&json);
    tn_json_list_end(&json);
    assert_string_equal(text.data, "[{\"file\":\"my \\\"plans\\\".plan\",\"line\":3,\"column\":7,\"end_line\":4,"
                                   "\"end_column\":1},{\"file\":null,\"line\":3,\"column\":null}]");
    free(text.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_short_string),
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_random_strings),
        cmocka_unit_test(test_escapes),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_whole_numbers),
        cmocka_unit_test(test_layouts),
        cmocka_unit_test(test_written),
        cmocka_unit_test(test_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
