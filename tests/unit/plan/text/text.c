#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/text/text.h"
#include "tests/support/test_rule.h"

typedef struct fixture {
    tn_module *module;
    tn_schema *schema;
    tn_plan_scanner *scanner;
    tn_plan plan;
    tn_buffer text;
} fixture;

static void open_fixture(fixture *f, const test_schema *schema)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, schema);
    *f = (fixture){.module = test_module(builder)};
    f->schema = test_schema_open(f->module, 0);
    tn_error error;
    test_ok(tn_plan_scanner_new(f->schema, &f->scanner, &error), &error);
}

static void close_fixture(fixture *f)
{
    free(f->plan.trays);
    free(f->text.data);
    tn_plan_scanner_free(f->scanner);
    tn_schema_free(f->schema);
    tn_module_free(f->module);
}

/* Reads a text with and without a scanner's memory (twice, so that the second time remembers); all must agree. */
static tn_status read_text(fixture *f, const char *text, size_t max_trays, tn_error *error)
{
    bool json = text[0] == '{';
    size_t size = strlen(text);
    char *exact = malloc(size + 1); /* without a zero byte after it, for the sanitizer */
    assert_non_null(exact);
    memcpy(exact, text, size);
    exact = realloc(exact, size > 0 ? size : 1);
    tn_plan alone = {0};
    tn_error first;
    tn_status status = json ? tn_plan_parse_json(f->schema, exact, size, max_trays, &alone, &first)
                            : tn_plan_parse_line(f->schema, exact, size, max_trays, &alone, &first);
    for (int again = 0; again < 2; again++) {
        tn_status same = json ? tn_plan_scan_json(f->scanner, exact, size, max_trays, &f->plan, error)
                              : tn_plan_scan_line(f->scanner, exact, size, max_trays, &f->plan, error);
        assert_int_equal(status, same);
        if (status != TN_OK) {
            assert_string_equal(first.message, error->message);
            assert_int_equal(first.column, error->column);
            assert_int_equal(first.column_end, error->column_end);
            continue;
        }
        assert_int_equal(alone.length, f->plan.length);
        if (alone.length > 0)
            assert_memory_equal(alone.trays, f->plan.trays, alone.length * sizeof *alone.trays);
    }
    free(alone.trays);
    free(exact);
    return status;
}

static void test_round_trip(void **state)
{
    (void)state;
    static const test_schema *const schemas[] = {&test_schema_tiny, &test_schema_house, &test_schema_paper};
    for (size_t s = 0; s < 3; s++) {
        fixture f;
        open_fixture(&f, schemas[s]);
        test_random random = {.seed = s};
        for (uint32_t n = 0; n < 400; n++) {
            uint32_t length = n % 13;
            tn_tray trays[13];
            for (uint32_t k = 0; k < length; k++)
                trays[k] = test_random_below(&random, f.schema->tray_count);
            tn_error error;
            for (int json = 0; json < 2; json++) {
                f.text.size = 0;
                assert_true(tn_buffer_append(&f.text, "", 0));
                assert_true(json ? tn_plan_write_json(f.schema, trays, length, &f.text)
                                 : tn_plan_write_line(f.schema, trays, length, &f.text));
                test_ok(read_text(&f, f.text.data, 13, &error), &error);
                assert_int_equal(f.plan.length, length);
                if (length > 0)
                    assert_memory_equal(f.plan.trays, trays, length * sizeof *trays);
            }
        }
        close_fixture(&f);
    }
}

/* Other ways to write the tray `8' double public dense:8'`, and the plan of it alone. */
static void test_other_spellings(void **state)
{
    (void)state;
    static const char *const same[] = {
        "8' double public dense:8'",
        "  8'\tdouble   public dense:8'\t\r",
        "96\" double public dense:96\"",
        "2.4384m double public dense:2438.4mm",
        "8\xE2\x80\xB2 double public dense:8\xE2\x80\x99",
        "{\"trays\":[{\"width\":\"8'\",\"height\":\"double\",\"public\":true,\"machine\":{\"fill\":\"dense\",\"depth\":"
        "\"8'\"}}]}",
        "{\"trays\":[{\"machine\":{\"depth\":\"8'\",\"fill\":\"dense\"},\"public\":\"public\",\"height\":\"double\","
        "\"width\":\"8'\"}]}",
        " { \"rank\" : \"12\", \"x\":[{\"a\":[1,2.5e3,null,\"}\\\"\"]},true], \"trays\" : [ { \"width\" : \"96\\\"\" , "
        "\"height\" : "
        "\"d\\u006fuble\" , \"public\" : true , \"machine\" : \"dense:8'\" } ] , \"more\": {} } ",
    };
    fixture f;
    open_fixture(&f, &test_schema_house);
    const uint8_t values[] = {1, 1, 1, 1};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        tn_error error;
        const char *text = same[i] + (same[i][0] == ' ' && same[i][1] == '{');
        test_ok(read_text(&f, text, 1, &error), &error);
        assert_int_equal(f.plan.length, 1);
        assert_int_equal(f.plan.trays[0], tn_schema_tray(f.schema, values));
    }
    close_fixture(&f);
}

static void test_what_is_left_out(void **state)
{
    (void)state;
    fixture f;
    open_fixture(&f, &test_schema_house);
    tn_error error;
    test_ok(read_text(&f, "{\"trays\":[{}]}", 4, &error), &error);
    assert_int_equal(f.plan.trays[0], 0);
    /* A fill alone, and a depth of null, take the first depth. */
    test_ok(read_text(&f, "4' single - dense", 4, &error), &error);
    assert_int_equal(f.plan.trays[0], 0);
    test_ok(read_text(&f, "{\"trays\":[{\"machine\":{\"depth\":null,\"fill\":\"dense\"}}]}", 4, &error), &error);
    assert_int_equal(f.plan.trays[0], 0);
    test_ok(read_text(&f, "", 4, &error), &error);
    assert_int_equal(f.plan.length, 0);
    test_ok(read_text(&f, " \t\r", 4, &error), &error);
    assert_int_equal(f.plan.length, 0);
    test_ok(read_text(&f, "{\"trays\":[]}", 0, &error), &error);
    assert_int_equal(f.plan.length, 0);
    close_fixture(&f);
}

typedef struct wrong {
    const char *text;
    uint32_t code, column, column_end;
    const char *message, *help; /* parts of them */
} wrong;

static void test_errors(void **state)
{
    (void)state;
    static const wrong wrongs[] = {
        {"8' doubel - empty", 602, 4, 10, "`doubel` is not a value of height, which can be single or double",
         "did you mean double?"},
        {"5' single - empty", 602, 1, 3, "`5'` is not a value of width, which can be 4', 8' or 12'", ""},
        {"double 8' - empty", 602, 1, 7, "is not a value of width", "`double` is a value of height; the values"},
        {"8' single - dense:5'", 602, 13, 21, "dense:4', dense:8' or empty", "did you mean dense:"},
        {"8' single - empty:4'", 602, 13, 21, "`empty:4'`", ""},
        {"8' single - open", 602, 13, 17, "`open` is not a value of machine", ""},
        {"8' single pubic empty", 602, 11, 16, "not a value of public, which can be - or public",
         "did you mean public?"},
        {"8' single -", 601, 1, 12, "ends after 3: there is none for machine", "width height public machine"},
        {"8' single - empty 4' single - empty", 601, 19, 21, "`4'` is one more", "separate trays with |"},
        {"8' single - empty |", 601, 19, 20, "there is no tray here", "|"},
        {"| 8' single - empty", 601, 1, 2, "there is no tray here", "|"},
        {"8' single - empty || 8' single - empty", 601, 20, 21, "there is no tray here", "|"},
        {"8' single - empty | 4' double - dense:4'", 603, 21, 41, "schema house has no such tray: forbid it", "change"},
        {"8' single - empty | 8' single - empty | 8' single - empty | 12' single - empty", 805, 61, 79, "limit of 3",
         "--max-length"},
        {"8' \x01\x02 - empty", 602, 4, 6, "`?\?`", ""},
        {"{", 601, 2, 2, "double quotes", ""},
        {"{\"trays\":[{\"width\":\"8'\"}]", 601, 26, 26, "a comma or }", ""},
        {"{\"trays\":[{\"width\":\"8'\"}]} x", 601, 28, 29, "nothing may follow", ""},
        {"{\"trays\":{}}", 601, 10, 11, "list", ""},
        {"{\"plan\":[]}", 601, 1, 2, "no \"trays\"", ""},
        {"{\"trays\":[],\"trays\":[]}", 601, 13, 20, "twice", ""},
        {"{\"trays\":[{\"width\":8}]}", 601, 20, 21, "in double quotes", ""},
        {"{\"trays\":[{\"widht\":\"8'\"}]}", 601, 12, 19, "`widht` is not a field of schema house", "width height"},
        {"{\"trays\":[{\"width\":\"8'\",\"width\":\"8'\"}]}", 601, 25, 32, "twice", ""},
        {"{\"trays\":[{\"height\":\"doubel\"}]}", 602, 21, 29, "`doubel`", "did you mean double?"},
        {"{\"trays\":[{\"public\":1}]}", 601, 21, 22, "true or false", ""},
        {"{\"trays\":[{\"machine\":{\"depth\":\"4'\"}}]}", 601, 22, 36, "needs a \"fill\"", ""},
        {"{\"trays\":[{\"machine\":{\"fill\":\"dense\",\"depth\":\"5'\"}}]}", 602, 22, 51, "not a value of machine",
         ""},
        {"{\"trays\":[{\"machine\":{\"fill\":\"dense\",\"fill\":\"dense\"}}]}", 601, 38, 44, "one \"fill\"", ""},
        {"{\"trays\":[{\"height\":\"double\",\"width\":\"4'\"}]}", 603, 11, 43, "forbid it", ""},
        {"{\"trays\":[{},{},{},{}]}", 805, 20, 22, "limit of 3", ""},
        {"{\"trays\":[{\"width\":\"8", 601, 20, 22, "closing quote", ""},
        {"{\"trays\":[{\"width\":\"\\u12\"}]}", 601, 21, 27, "four hexadecimal digits", ""},
        {"{\"trays\":[{\"width\":\"\\ud800\"}]}", 601, 21, 27, "not a character", ""},
        {"{\"trays\":[{\"width\":\"\\x\"}]}", 601, 21, 23, "backslash", ""},
        {"{\"x\":[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[1", 601, 71, 72, "too deep",
         ""},
    };
    fixture f;
    int failures = 0;
    open_fixture(&f, &test_schema_house);
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        const wrong *w = &wrongs[i];
        tn_error error = {0};
        tn_status status = read_text(&f, w->text, 3, &error);
        bool right = status == (w->code == E_PLAN_TOO_LONG ? TN_LIMIT : TN_INVALID) && error.code == w->code &&
                     error.column == w->column && error.column_end == w->column_end &&
                     strstr(error.message, w->message) && strstr(error.help, w->help);
        if (!right)
            print_error("%s\n  E%04u [%u, %u): %s; %s\n", w->text, (unsigned)error.code, (unsigned)error.column,
                        (unsigned)error.column_end, error.message, error.help);
        failures += !right;
    }
    assert_int_equal(failures, 0);
    close_fixture(&f);
}

/* More spellings than a scanner remembers: what it forgets it reads anew. */
static void test_scanner_forgets(void **state)
{
    (void)state;
    fixture f;
    open_fixture(&f, &test_schema_house);
    test_random random = {.seed = 5};
    for (uint32_t n = 0; n < 20000; n++) {
        char line[200];
        uint32_t width = test_random_below(&random, 3), blanks = test_random_below(&random, 100);
        snprintf(line, sizeof line, "%u'%*ssingle - empty", 4 * (width + 1), (int)blanks + 1, "");
        tn_error error;
        test_ok(tn_plan_scan_line(f.scanner, line, strlen(line), 1, &f.plan, &error), &error);
        assert_int_equal(tn_tray_value(f.schema, f.plan.trays[0], 0), width);
    }
    close_fixture(&f);
}

static void test_buffer(void **state)
{
    (void)state;
    tn_buffer buffer = {0};
    for (int i = 0; i < 1000; i++)
        assert_true(tn_buffer_printf(&buffer, "%d,", i));
    assert_int_equal(buffer.size, 10 * 2 + 90 * 3 + 900 * 4);
    assert_int_equal(buffer.data[buffer.size], '\0');
    assert_string_equal(buffer.data + buffer.size - 4, "999,");
    free(buffer.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),       cmocka_unit_test(test_other_spellings),
        cmocka_unit_test(test_what_is_left_out), cmocka_unit_test(test_errors),
        cmocka_unit_test(test_scanner_forgets),  cmocka_unit_test(test_buffer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
