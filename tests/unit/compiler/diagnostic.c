/* Diagnostics: their text and JSON forms to the letter, their order, and the limit on their number. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/common/diagnostic.h"

typedef struct fixture {
    tn_sources sources;
    tn_diagnostics list;
} fixture;

static fixture *begin(const char *text)
{
    fixture *f = calloc(1, sizeof *f);
    uint32_t file;
    assert_int_equal(tn_sources_add(&f->sources, "a.plan", text, strlen(text), &file, NULL), TN_OK);
    tn_diagnostics_init(&f->list, &f->sources);
    return f;
}

static void end(fixture *f)
{
    assert_false(f->list.failed);
    tn_diagnostics_clear(&f->list);
    tn_sources_clear(&f->sources);
    free(f);
}

/* Shows everything, in order, and compares. */
static void expect_shown(fixture *f, tn_show_options options, const char *wanted)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    tn_diagnostics_sort(&f->list);
    tn_diagnostics_show(&f->list, &options, out);
    fclose(out);
    assert_string_equal(text, wanted);
    free(text);
}

static void expect_text(fixture *f, const char *wanted)
{
    expect_shown(f, (tn_show_options){0}, wanted);
}

/* The span of a piece of the first source. */
static tn_span piece(fixture *f, const char *words)
{
    const char *text = f->sources.files[0].text;
    uint32_t at = (uint32_t)(strstr(text, words) - text);
    return (tn_span){0, at, at + (uint32_t)strlen(words)};
}

static void test_whole_form(void **state)
{
    (void)state;
    fixture *f = begin("rule a = any\nrule b = trey(4')\n");
    tn_span first = piece(f, "a =");
    tn_diagnostic *item = tn_report(&f->list, E_UNEXPECTED, piece(f, "trey"), "unexpected '%s'", "trey");
    tn_note(&f->list, item, &first, "the rule before is here");
    tn_note(&f->list, item, NULL, "rules are made of trays");
    tn_help(&f->list, item, "did you mean '%s'?", "tray");
    expect_text(f, "a.plan:2:10: error[E0001]: unexpected 'trey'\n"
                   "   2 | rule b = trey(4')\n"
                   "     |          ^^^^\n"
                   "  note: a.plan:1:6: the rule before is here\n"
                   "  note: rules are made of trays\n"
                   "  help: did you mean 'tray'?\n");
    end(f);
}

static void test_colours(void **state)
{
    (void)state;
    fixture *f = begin("x y\n");
    tn_diagnostic *item = tn_report(&f->list, E_UNEXPECTED, piece(f, "y"), "no");
    tn_help(&f->list, item, "yes");
    expect_shown(f, (tn_show_options){.colour = true},
                 "\x1b[1ma.plan:1:3: \x1b[0m\x1b[1;31merror[E0001]:\x1b[0m\x1b[1m no\x1b[0m\n"
                 "\x1b[34m   1 |\x1b[0m x y\n"
                 "\x1b[34m     |\x1b[0m   \x1b[1;32m^\x1b[0m\n"
                 "  \x1b[1;36mhelp:\x1b[0m yes\n");
    end(f);
}

static void test_tabs_and_wide_characters(void **state)
{
    (void)state;
    fixture *f = begin("\ttray(\xE6\xBC\xA2\xE5\xAD\x97, e\xCC\x81t\xC3\xA9)\n");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "tray"), "after a tab");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "\xE6\xBC\xA2\xE5\xAD\x97"), "two wide");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "t\xC3\xA9"), "after a combining mark");
    expect_text(f, "a.plan:1:2: error[E0001]: after a tab\n"
                   "   1 |     tray(\xE6\xBC\xA2\xE5\xAD\x97, e\xCC\x81t\xC3\xA9)\n"
                   "     |     ^^^^\n"
                   "a.plan:1:7: error[E0001]: two wide\n"
                   "   1 |     tray(\xE6\xBC\xA2\xE5\xAD\x97, e\xCC\x81t\xC3\xA9)\n"
                   "     |          ^^^^\n"
                   "a.plan:1:18: error[E0001]: after a combining mark\n"
                   "   1 |     tray(\xE6\xBC\xA2\xE5\xAD\x97, e\xCC\x81t\xC3\xA9)\n"
                   "     |                 ^^\n");
    end(f);
}

static void test_several_lines(void **state)
{
    (void)state;
    fixture *f = begin("rule a =\n  neighbour(any,\n    any,\n      any)\n");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "neighbour(any,\n    any,\n      any)"), "over three lines");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "a =\n  nei"), "over two");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "=\n"), "with a line end");
    expect_text(f, "a.plan:1:6: error[E0001]: over two\n"
                   "   1 | rule a =\n"
                   "     |      ^^^\n"
                   "   2 |   neighbour(any,\n"
                   "     |   ^^^\n"
                   "a.plan:1:8: error[E0001]: with a line end\n"
                   "   1 | rule a =\n"
                   "     |        ^\n"
                   "a.plan:2:3: error[E0001]: over three lines\n"
                   "   2 |   neighbour(any,\n"
                   "     |   ^^^^^^^^^^^^^^\n"
                   " ... |\n"
                   "   4 |       any)\n"
                   "     |       ^^^^\n");
    end(f);
}

static void test_empty_spans_and_the_end(void **state)
{
    (void)state;
    fixture *f = begin("rule\nx\n");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 4, 4}, "end of a line");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 5, 5}, "before a word");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 7, 7}, "end of file");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 4, 5}, "the line end itself");
    expect_text(f, "a.plan:1:5: error[E0001]: end of a line\n"
                   "   1 | rule\n"
                   "     |     ^\n"
                   "a.plan:1:5: error[E0001]: the line end itself\n"
                   "   1 | rule\n"
                   "     |     ^\n"
                   "a.plan:2:1: error[E0001]: before a word\n"
                   "   2 | x\n"
                   "     | ^\n"
                   "a.plan:3:1: error[E0001]: end of file\n"
                   "   3 |\n"
                   "     | ^\n");
    end(f);
}

static void test_end_of_a_last_line_without_an_end(void **state)
{
    (void)state;
    fixture *f = begin("rule a = ");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 9, 9}, "end of file");
    expect_text(f, "a.plan:1:10: error[E0001]: end of file\n"
                   "   1 | rule a = \n"
                   "     |          ^\n");
    end(f);
}

static void test_carriage_returns(void **state)
{
    (void)state;
    fixture *f = begin("one\r\ntwo\r\n");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "two"), "no");
    expect_text(f, "a.plan:2:1: error[E0001]: no\n"
                   "   2 | two\n"
                   "     | ^^^\n");
    end(f);
}

/* Of a long line a window is shown; its width does not depend on how long the line is. */
static void test_long_lines(void **state)
{
    (void)state;
    char text[1001];
    memset(text, 'x', 1000);
    text[1000] = '\0';
    memcpy(text + 500, "HERE", 4);
    fixture *f = begin(text);
    tn_report(&f->list, E_UNEXPECTED, piece(f, "HERE"), "in the middle");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 2, 4}, "at the start");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 1000, 1000}, "at the end");
    char wanted[2000], xs[201];
    memset(xs, 'x', 200);
    xs[200] = '\0';
    snprintf(wanted, sizeof wanted,
             "a.plan:1:3: error[E0001]: at the start\n"
             "   1 | %.110s...\n"
             "     |   ^^\n"
             "a.plan:1:501: error[E0001]: in the middle\n"
             "   1 | ...%.50sHERE%.56s...\n"
             "     | %53s^^^^\n"
             "a.plan:1:1001: error[E0001]: at the end\n"
             "   1 | ...%.50s\n"
             "     | %53s^\n",
             xs, xs, xs, "", xs, "");
    expect_text(f, wanted);
    end(f);
}

/* A mark longer than the window ends with it. */
static void test_long_mark(void **state)
{
    (void)state;
    char text[301], wanted[600];
    memset(text, 'x', 300);
    text[300] = '\0';
    fixture *f = begin(text);
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 0, 300}, "all");
    char carets[111];
    memset(carets, '^', 110);
    carets[110] = '\0';
    snprintf(wanted, sizeof wanted, "a.plan:1:1: error[E0001]: all\n   1 | %.110s...\n     | %s\n", text, carets);
    expect_text(f, wanted);
    end(f);
}

/* Nothing from a source or a message changes the terminal's state. */
static void test_what_is_not_text(void **state)
{
    (void)state;
    fixture *f = begin("a\x1b[31m\xFF\x01 b\xE2\x80\xAE!");
    tn_report(&f->list, E_UNEXPECTED, piece(f, "b"), "an \x1b in\nhere");
    expect_text(f, "a.plan:1:10: error[E0001]: an \\x1b in here\n"
                   "   1 | a\xEF\xBF\xBD[31m\xEF\xBF\xBD\xEF\xBF\xBD b\xEF\xBF\xBD!\n"
                   "     |          ^\n");
    end(f);
}

static void test_zero_bytes_in_a_source(void **state)
{
    (void)state;
    fixture f = {0};
    uint32_t file;
    assert_int_equal(tn_sources_add(&f.sources, "a.plan", "a\0b\n", 4, &file, NULL), TN_OK);
    tn_diagnostics_init(&f.list, &f.sources);
    tn_report(&f.list, E_UNEXPECTED, (tn_span){0, 1, 2}, "zero");
    expect_text(&f, "a.plan:1:2: error[E0001]: zero\n"
                    "   1 | a\xEF\xBF\xBD"
                    "b\n"
                    "     |  ^\n");
    tn_diagnostics_clear(&f.list);
    tn_sources_clear(&f.sources);
}

static void test_large_line_numbers(void **state)
{
    (void)state;
    char text[12001];
    memset(text, '\n', 12000);
    text[12000] = '\0';
    text[11000] = 'x';
    text[11999] = 'y';
    fixture *f = begin(text);
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 11000, 12000}, "far down");
    expect_text(f, "a.plan:11001:1: error[E0001]: far down\n"
                   "11001 | x\n"
                   "      | ^\n"
                   "  ... |\n"
                   "11999 | y\n"
                   "      | ^\n");
    end(f);
}

static void test_json(void **state)
{
    (void)state;
    fixture *f = begin("rule \"a\n");
    tn_span all = {0, 0, 4};
    tn_diagnostic *item = tn_report(&f->list, E_UNTERMINATED_STRING, piece(f, "\"a"), "a \"quote\" \\ \t\x01\xFF");
    tn_note(&f->list, item, &all, "here");
    tn_note(&f->list, item, NULL, "there");
    tn_help(&f->list, item, "close it");
    item->replacement = strdup("\"a\"");
    tn_report_bare(&f->list, TN_NOTE, TN_CODE_NONE, "plain");
    expect_shown(
        f, (tn_show_options){.json = true},
        "[\n"
        " {\"severity\":\"error\",\"code\":\"E0002\",\"message\":\"a \\\"quote\\\" \\\\ \\t\\u0001\xEF\xBF\xBD\","
        "\"file\":\"a.plan\",\"line\":1,\"column\":6,\"end_line\":1,\"end_column\":8,"
        "\"notes\":[{\"message\":\"here\",\"file\":\"a.plan\",\"line\":1,\"column\":1},"
        "{\"message\":\"there\",\"file\":null,\"line\":null,\"column\":null}],"
        "\"help\":\"close it\",\"replacement\":\"\\\"a\\\"\"},\n"
        " {\"severity\":\"note\",\"code\":null,\"message\":\"plain\",\"file\":null,\"line\":null,"
        "\"column\":null,\"end_line\":null,\"end_column\":null,\"notes\":[],\"help\":null,"
        "\"replacement\":null}\n"
        "]\n");
    end(f);
    f = begin("");
    expect_shown(f, (tn_show_options){.json = true}, "[]\n");
    end(f);
}

static void test_input_places(void **state)
{
    (void)state;
    fixture *f = begin("");
    tn_error error;
    tn_fail(&error, TN_INVALID, E_PLAN_VALUE, "no such width");
    tn_error_help(&error, "4' and 8' are");
    tn_error_place(&error, 12, 5, 8);
    tn_report_error(&f->list, &error, "plans.txt", "8' |13' | and more that is no part of it", 9);
    tn_fail(&error, TN_LIMIT, E_TOO_MANY_STATES, "too many states");
    tn_report_error(&f->list, &error, NULL, NULL, 0);
    expect_text(f, "plans.txt:12:5: error[E0602]: no such width\n"
                   "  12 | 8' |13' |\n"
                   "     |     ^^^\n"
                   "  help: 4' and 8' are\n"
                   "error[E0802]: too many states\n");
    expect_shown(f, (tn_show_options){.json = true},
                 "[\n"
                 " {\"severity\":\"error\",\"code\":\"E0602\",\"message\":\"no such width\",\"file\":\"plans.txt\","
                 "\"line\":12,\"column\":5,\"end_line\":12,\"end_column\":8,\"notes\":[],\"help\":\"4' and 8' are\","
                 "\"replacement\":null},\n"
                 " {\"severity\":\"error\",\"code\":\"E0802\",\"message\":\"too many states\",\"file\":null,"
                 "\"line\":null,\"column\":null,\"end_line\":null,\"end_column\":null,\"notes\":[],\"help\":null,"
                 "\"replacement\":null}\n"
                 "]\n");
    end(f);
}

static void test_order_and_repeats(void **state)
{
    (void)state;
    fixture *f = begin("abcdef\n");
    uint32_t file;
    assert_int_equal(tn_sources_add(&f->sources, "b.plan", "x", 1, &file, NULL), TN_OK);
    tn_report_bare(&f->list, TN_NOTE, TN_CODE_NONE, "last");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){1, 0, 1}, "five");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 3, 4}, "three");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 3, 4}, "three");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 3, 4}, "four");
    tn_report(&f->list, E_STRAY_CHARACTER, (tn_span){0, 1, 2}, "two");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 1, 2}, "one");
    assert_int_equal(f->list.error_count, 6);
    for (int round = 0; round < 2; round++) {
        tn_diagnostics_sort(&f->list);
        static const char *const wanted[] = {"one", "two", "three", "four", "five", "last"};
        assert_int_equal(f->list.count, 6);
        assert_int_equal(f->list.error_count, 5);
        for (size_t i = 0; i < 6; i++)
            assert_string_equal(f->list.items[i].message, wanted[i]);
    }
    end(f);
}

static void test_limit(void **state)
{
    (void)state;
    fixture *f = begin("x\n");
    f->list.error_limit = 2;
    for (int i = 0; i < 5; i++) {
        tn_diagnostic *item = tn_report(&f->list, E_UNEXPECTED, (tn_span){0, 0, 1}, "number %d", i);
        tn_note(&f->list, item, NULL, "a note");
        tn_help(&f->list, item, "a help");
    }
    assert_int_equal(f->list.count, 2);
    assert_int_equal(f->list.error_count, 5);
    tn_diagnostics_sort(&f->list);
    expect_text(f, "a.plan:1:1: error[E0001]: number 0\n   1 | x\n     | ^\n  note: a note\n  help: a help\n"
                   "a.plan:1:1: error[E0001]: number 1\n   1 | x\n     | ^\n  note: a note\n  help: a help\n"
                   "note: 3 more like these are not shown\n");
    end(f);
}

static void test_code_names(void **state)
{
    (void)state;
    char name[8];
    tn_code_name(E_UNEXPECTED, name);
    assert_string_equal(name, "E0001");
    tn_code_name(10012, name);
    assert_string_equal(name, "W012");
    tn_code_name(UINT32_MAX, name); /* from anywhere: it fits */
    assert_true(strlen(name) < 8);
}

static void test_unknown_file(void **state)
{
    (void)state;
    fixture *f = begin("x\n");
    tn_report(&f->list, E_UNEXPECTED, (tn_span){7, 0, 1}, "nowhere");
    expect_text(f, "error[E0001]: nowhere\n");
    end(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whole_form),
        cmocka_unit_test(test_colours),
        cmocka_unit_test(test_tabs_and_wide_characters),
        cmocka_unit_test(test_several_lines),
        cmocka_unit_test(test_empty_spans_and_the_end),
        cmocka_unit_test(test_end_of_a_last_line_without_an_end),
        cmocka_unit_test(test_carriage_returns),
        cmocka_unit_test(test_long_lines),
        cmocka_unit_test(test_long_mark),
        cmocka_unit_test(test_what_is_not_text),
        cmocka_unit_test(test_zero_bytes_in_a_source),
        cmocka_unit_test(test_large_line_numbers),
        cmocka_unit_test(test_json),
        cmocka_unit_test(test_input_places),
        cmocka_unit_test(test_order_and_repeats),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_code_names),
        cmocka_unit_test(test_unknown_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
