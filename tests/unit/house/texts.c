/* Texts in building models and drawings: what STEP and DXF write, read again by their rules, letter by letter. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/utf8.h"
#include "runtime/house/export/step.h"

/* UTF-8 of one character. */
static size_t spell(uint32_t c, char *to)
{
    static const unsigned char leads[] = {0, 0, 0xC0, 0xE0, 0xF0};
    size_t size = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = size; i-- > 1; c >>= 6)
        to[i] = (char)(0x80 | (c & 0x3F));
    to[0] = (char)(leads[size] | c);
    to[size] = '\0';
    return size;
}

static uint32_t digits(const char *text, int count)
{
    char number[9] = "";
    memcpy(number, text, (size_t)count);
    assert_int_equal(strspn(number, "0123456789ABCDEF"), count);
    return (uint32_t)strtoul(number, NULL, 16);
}

/* What a string of ISO 10303-21 says, by its section 6.4.3; fails where it is none. */
static void read_step(const char *text, char *said)
{
    int run = 0;
    for (*said = '\0'; *text;) {
        if (run && strncmp(text, "\\X0\\", 4) != 0) {
            said += spell(digits(text, run), said);
            text += run;
        } else if (run) {
            run = 0;
            text += 4;
        } else if (strncmp(text, "\\X2\\", 4) == 0 || strncmp(text, "\\X4\\", 4) == 0) {
            run = text[2] == '2' ? 4 : 8;
            text += 4;
        } else {
            assert_in_range(*text, ' ', '~');
            if (*text == '\'' || *text == '\\') {
                assert_int_equal(text[0], text[1]);
                text++;
            }
            *said++ = *text++;
            *said = '\0';
        }
    }
    assert_int_equal(run, 0);
}

static void expect_step(const char *text)
{
    char said[4096];
    tn_stepfile_name name = tn_stepfile_text(text);
    tn_buffer whole = {0};
    read_step(name.text, said);
    assert_string_equal(said, text);
    assert_true(tn_stepfile_put_text(&whole, text));
    assert_string_equal(whole.data, name.text);
    free(whole.data);
}

static void test_every_character(void **state)
{
    (void)state;
    char text[16];
    for (uint32_t c = 1; c <= 0x10FFFF; c += c < 0x3000 ? 1 : 97) {
        if (c >= 0xD800 && c < 0xE000)
            continue;
        size_t size = spell(c, text);
        expect_step(text);
        memcpy(text + size, "-\xC3\xA9", 4); /* after and before others */
        expect_step(text);
    }
}

static void test_quotes(void **state)
{
    (void)state;
    expect_step("7'6\" \\X2\\0041\\X0\\ '' \\\\");
    expect_step("");
    assert_string_equal(tn_stepfile_text("k\xC3\xBC\xC3\xB6 \xF0\x90\xA4\x80\xC3\xBC").text,
                        "k\\X2\\00FC00F6\\X0\\ \\X4\\00010900\\X0\\\\X2\\00FC\\X0\\");
    assert_string_equal(tn_stepfile_text("\xFF'").text, "\\X2\\FFFD\\X0\\''"); /* no UTF-8 */
}

/* A name that is too long ends behind a whole character, outside of a run. */
static void test_long_names(void **state)
{
    static const char *const parts[] = {"\xC3\xBC", "x\xC3\xBC", "\xF0\x90\xA4\x80", "\xF0\x90\xA4\x80\xC3\xBC", "'"};
    (void)state;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        char text[4000] = "", said[4000];
        for (size_t k = 0; k < 400; k++)
            strcat(text, parts[i]);
        read_step(tn_stepfile_text(text).text, said);
        assert_int_equal(strncmp(text, said, strlen(said)), 0);
        assert_true(strlen(said) >= 100 && tn_is_utf8(said, strlen(said)));
        tn_buffer whole = {0};
        assert_true(tn_stepfile_put_text(&whole, text));
        read_step(whole.data, said);
        assert_string_equal(said, text);
        free(whole.data);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_character),
        cmocka_unit_test(test_quotes),
        cmocka_unit_test(test_long_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
