/* UTF-8: what is text, how wide it is, and what is kept from a terminal. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/utf8.h"

/* Writes a code point by the definition of UTF-8, also where it may not be written. */
static size_t encode(uint32_t c, char *to)
{
    static const unsigned char leads[] = {0, 0, 0xC0, 0xE0, 0xF0};
    size_t size = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = size - 1; i > 0; i--) {
        to[i] = (char)(0x80 | (c & 0x3F));
        c >>= 6;
    }
    to[0] = (char)(leads[size] | c);
    return size;
}

static void test_every_character(void **state)
{
    (void)state;
    char text[4];
    for (uint32_t c = 0; c <= 0x1FFFFF; c++) {
        bool good = c <= 0x10FFFF && (c < 0xD800 || c > 0xDFFF);
        size_t size = encode(c, text), got;
        uint32_t read = tn_utf8_read(text, size, &got);
        if (good != tn_is_utf8(text, size) || read != (good ? c : TN_REPLACEMENT) || got != (good ? size : 1))
            fail_msg("U+%X", c);
        if (size > 1 && good) /* cut short */
            assert_int_equal(tn_utf8_read(text, size - 1, &got), TN_REPLACEMENT);
    }
}

static void test_what_is_not_utf8(void **state)
{
    (void)state;
    static const char *const bad[] = {"\x80",
                                      "\xC0\x80",
                                      "\xC1\xBF",
                                      "\xE0\x80\x80",
                                      "\xE0\x9F\xBF",
                                      "\xF0\x80\x80\x80",
                                      "\xF0\x8F\xBF\xBF",
                                      "\xC3(",
                                      "\xE2\x82(",
                                      "\xF5\x80\x80\x80",
                                      "\xFF",
                                      "ok\xC3"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(tn_is_utf8(bad[i], strlen(bad[i])));
    assert_true(tn_is_utf8("", 0));
    assert_true(tn_is_utf8("a\0b", 3));
    assert_true(tn_is_utf8("\xEF\xBF\xBD", 3)); /* the replacement character itself is text */
}

static void test_widths(void **state)
{
    (void)state;
    assert_int_equal(tn_character_width('a'), 1);
    assert_int_equal(tn_character_width(0xE9), 1);
    assert_int_equal(tn_character_width(0x301), 0);
    assert_int_equal(tn_character_width(0x6F22), 2);
    assert_int_equal(tn_character_width(0xAC00), 2);
    assert_int_equal(tn_character_width(0xFF21), 2);
    assert_int_equal(tn_character_width(0x1F3E0), 2);
    assert_int_equal(tn_character_width(0x2032), 1);
}

static void expect_clean(const char *text, const char *wanted)
{
    char *got;
    size_t size;
    FILE *out = open_memstream(&got, &size);
    tn_write_clean(out, text, strlen(text));
    fclose(out);
    assert_string_equal(got, wanted);
    free(got);
}

static void test_cleaning(void **state)
{
    (void)state;
    expect_clean("plain \xC3\xA9", "plain \xC3\xA9");
    expect_clean("a\tb\nc\r", "a b c ");
    expect_clean("\x1b]0;x\x07", "\\x1b]0;x\\x07");
    expect_clean("\xC2\x9B", "\\u009b");     /* CSI as one character */
    expect_clean("\xE2\x80\xAE", "\\u202e"); /* right-to-left override */
    expect_clean("\xFFz", "\xEF\xBF\xBDz");
}

static void expect_copy(const char *text, size_t room, const char *wanted)
{
    char copy[8];
    memset(copy, 'x', sizeof copy);
    tn_utf8_copy(text, room, copy);
    assert_string_equal(copy, wanted);
}

static void test_copying(void **state)
{
    (void)state;
    expect_copy("abc", 8, "abc");
    expect_copy("abc", 4, "abc");
    expect_copy("abc", 3, "ab");
    expect_copy("a\xC3\xA9z", 4, "a\xC3\xA9");
    expect_copy("a\xC3\xA9z", 3, "a");
    expect_copy("\xF0\x90\xA4\x80", 5, "\xF0\x90\xA4\x80");
    expect_copy("\xF0\x90\xA4\x80", 4, "");
    expect_copy("a", 1, "");
}

static void test_utf16(void **state)
{
    (void)state;
    assert_int_equal(tn_utf16_units("", 0), 0);
    assert_int_equal(tn_utf16_units("a\xC3\xA9\xE4\xB8\xAD", 6), 3);
    assert_int_equal(tn_utf16_units("\xF0\x9F\x8F\xA0z", 5), 3);
    assert_int_equal(tn_utf16_units("\xF0\x9F\x8F\xA0z", 2), 2); /* cut in the middle */
    assert_int_equal(tn_utf16_units("\xFFz", 2), 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_character), cmocka_unit_test(test_what_is_not_utf8), cmocka_unit_test(test_widths),
        cmocka_unit_test(test_cleaning),        cmocka_unit_test(test_copying),          cmocka_unit_test(test_utf16),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
