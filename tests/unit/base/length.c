/* Lengths: every form, exactly; what is none; what cannot be held. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/length.h"

enum { SPACED = 1, TIGHT = 0 };

/* `text` starts with a length of that many nanometres, spelled with that many bytes. */
static void reads(const char *text, bool spaced, int64_t wanted, size_t bytes)
{
    int64_t nanometres = -1;
    tn_error error;
    size_t got = tn_length_read(text, strlen(text), spaced, &nanometres, &error);
    if (got != bytes || (bytes > 0 && nanometres != wanted) || error.status != TN_OK)
        fail_msg("%s: read %zu bytes, %lld nm (%s)", text, got, (long long)nanometres, error.message);
}

static void whole(const char *text, int64_t wanted)
{
    reads(text, SPACED, wanted, strlen(text));
}

static void none(const char *text)
{
    reads(text, SPACED, 0, 0);
}

static void fails(const char *text, uint32_t code, size_t bytes)
{
    int64_t nanometres = -1;
    tn_error error;
    assert_int_equal(tn_length_read(text, strlen(text), SPACED, &nanometres, &error), 0);
    if (error.status != TN_INVALID || error.code != code || error.column_end != bytes + 1)
        fail_msg("%s: status %d, code %u, %u bytes: %s", text, error.status, error.code, error.column_end - 1,
                 error.message);
    assert_int_equal(tn_length_read(text, strlen(text), SPACED, &nanometres, NULL), 0);
}

#define INCH INT64_C(25400000)
#define FOOT (12 * INCH)

static void test_feet_and_inches(void **state)
{
    (void)state;
    whole("12'", 12 * FOOT);
    whole("0'", 0);
    whole("6\"", 6 * INCH);
    whole("2'6\"", 2 * FOOT + 6 * INCH);
    whole("7'-9\"", 7 * FOOT + 9 * INCH);
    whole("7' 9\"", 7 * FOOT + 9 * INCH);
    whole("5' 6 1/2\"", 5 * FOOT + 6 * INCH + INCH / 2);
    whole("5'6-1/2\"", 5 * FOOT + 6 * INCH + INCH / 2);
    whole("5'-6 1/2\"", 5 * FOOT + 6 * INCH + INCH / 2);
    whole("5' 1/2\"", 5 * FOOT + INCH / 2);
    whole("6 1/2\"", 6 * INCH + INCH / 2);
    whole("3/4\"", 3 * INCH / 4);
    whole("1/64\"", 396875);
    whole("63/64\"", 63 * 396875);
    whole("3\t1/4\"", 3 * INCH + INCH / 4);
    whole("5.5'", 5 * FOOT + 6 * INCH);
    whole("0.015625\"", 396875);
}

static void test_metric(void **state)
{
    (void)state;
    whole("3.6m", 3600000000);
    whole("900mm", 900000000);
    whole("45cm", 450000000);
    whole("0.5mm", 500000);
    whole("0.000000001m", 1);
    whole("1.500000000000000m", 1500000000); /* zeros at the end say nothing */
    whole("25.4mm", INCH);
}

static void test_typographic_signs(void **state)
{
    (void)state;
    whole("12\xE2\x80\x99", 12 * FOOT);
    whole("12\xE2\x80\xB2", 12 * FOOT);
    whole("2\xE2\x80\xB2"
          "6\xE2\x80\xB3",
          2 * FOOT + 6 * INCH);
    whole("2\xE2\x80\x99-6 1/2\xE2\x80\x9D", 2 * FOOT + 6 * INCH + INCH / 2);
    none("12\xE2\x80\x98"); /* an opening quote is no foot mark */
    none("12\xE2\x80");
}

static void test_where_a_length_ends(void **state)
{
    (void)state;
    reads("4' | 8'", SPACED, 4 * FOOT, 2);
    reads("4'|8'", SPACED, 4 * FOOT, 2);
    reads("40'..56'", SPACED, 40 * FOOT, 3);
    reads("4' 8", SPACED, 4 * FOOT, 2);
    reads("4' 8'", SPACED, 4 * FOOT, 2);
    reads("4'-x", SPACED, 4 * FOOT, 2);
    reads("4' 6 1/2", SPACED, 4 * FOOT, 2);
    reads("4' 6 1", SPACED, 4 * FOOT, 2);
    reads("6\"|8\"", SPACED, 6 * INCH, 2);
    reads("3m..4m", SPACED, 3000000000, 2);
    reads("2'\n6\"", SPACED, 2 * FOOT, 2);
    reads("5' 6 1/2\"", TIGHT, 5 * FOOT, 2);
    reads("5'6\" x", TIGHT, 5 * FOOT + 6 * INCH, 4);
    reads("6 1/2\"", TIGHT, 0, 0);
}

static void test_what_is_no_length(void **state)
{
    (void)state;
    none("");
    none("'");
    none("x4'");
    none("4");
    none("4..9");
    none("4.");
    none(".5m");
    none("4 '");
    none("4 m");
    none("3max");
    none("3m2");
    none("3m_");
    none("3m\xC3\xA9");
    none("3km");
    none("1/2");
    none("1/\"");
    none("-4'");
    none("4-9");
}

static void test_what_cannot_be_held(void **state)
{
    (void)state;
    fails("1/128\"", 6, 6);
    fails("1/3\"", 6, 4);
    fails("6 1/3\" x", 6, 6);
    fails("2'-1/128\"", 6, 9);
    fails("0.0000000001m", 6, 13);
    fails("0.0000001mm", 6, 11);
    fails("1.00000000000000000000000000000001'", 6, 35);
}

static void test_too_large(void **state)
{
    (void)state;
    whole("1125899.906842624m", TN_LENGTH_MAX);
    fails("1125899.906842625m", 5, 18);
    fails("99999999999999999999999999'", 5, 27);
    fails("1125899907mm 5", 5, 12);
    fails("3693898'", 5, 8);
    fails("1/0\"", 6, 4);
    fails("99999999999999999999999999/99999999999999999999999999\"", 5, 54);
    fails("3693000' 999999999\"", 5, 19);
}

static void writes(int64_t nanometres, const char *wanted)
{
    char text[64];
    tn_length_write(nanometres, text, sizeof text);
    assert_string_equal(text, wanted);
}

static void test_writing(void **state)
{
    (void)state;
    writes(0, "0'");
    writes(12 * FOOT, "12'");
    writes(6 * INCH, "6\"");
    writes(2 * FOOT + 6 * INCH, "2'6\"");
    writes(5 * FOOT + 6 * INCH + INCH / 2, "5'6-1/2\"");
    writes(5 * FOOT + INCH / 64, "5'1/64\"");
    writes(INCH / 4 * 3, "3/4\"");
    writes(900000000, "900mm");
    writes(500000, "0.5mm");
    writes(1, "0.000001mm");
    writes(3600000000, "3600mm");
    writes(-6 * INCH, "-6\"");
    writes(-1, "-0.000001mm");
    writes(INT64_MIN, "-9223372036854.775808mm");
}

/* What is written is read back as the same length, in rules and in plan lines. */
static void test_writing_and_reading_are_inverse(void **state)
{
    (void)state;
    char text[64];
    uint64_t random = 1;
    for (int i = 0; i < 20000; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        int64_t nanometres = (int64_t)(random >> (14 + random % 40));
        if (i % 2)
            nanometres = nanometres / 396875 * 396875;
        tn_length_write(nanometres, text, sizeof text);
        reads(text, TIGHT, nanometres, strlen(text));
        reads(text, SPACED, nanometres, strlen(text));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_feet_and_inches),
        cmocka_unit_test(test_metric),
        cmocka_unit_test(test_typographic_signs),
        cmocka_unit_test(test_where_a_length_ends),
        cmocka_unit_test(test_what_is_no_length),
        cmocka_unit_test(test_what_cannot_be_held),
        cmocka_unit_test(test_too_large),
        cmocka_unit_test(test_writing),
        cmocka_unit_test(test_writing_and_reading_are_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
