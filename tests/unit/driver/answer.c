/* Answers of a program that scores: what is understood, and what is said of the others. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "driver/program/external.h"

static tn_answer read_line(const char *line, size_t count)
{
    tn_answer answer;
    tn_answer_read(line, strlen(line), count, &answer);
    return answer;
}

static void takes_numbers(void **state)
{
    (void)state;
    tn_answer one = read_line("1.5", 1), list = read_line(" [1.5, -20]\r", 2), only = read_line("[7]", 1);
    assert_true(one.understood && one.values[0] == 1.5 && !one.says_id && !one.refusal[0]);
    assert_true(list.understood && list.values[0] == 1.5 && list.values[1] == -20);
    assert_true(only.understood && only.values[0] == 7);
    tn_answer object = read_line("{\"score\": [2, 3], \"id\": 12, \"more\": null}", 2);
    assert_true(object.understood && object.says_id && object.id == 12 && object.values[1] == 3);
}

static void takes_reasons(void **state)
{
    (void)state;
    tn_answer answer = read_line("{\"id\": 3, \"error\": \"it falls\\u001b over\", \"score\": 1}", 1);
    assert_true(answer.understood && answer.says_id && answer.id == 3);
    assert_string_equal(answer.refusal, "says: it falls\\x1b over");
}

static void is_refused(const char *line, size_t count, const char *wanted)
{
    tn_answer answer = read_line(line, count);
    assert_false(answer.understood);
    assert_string_equal(answer.refusal, wanted);
}

static void refuses_others(void **state)
{
    (void)state;
    is_refused("", 1, "answered with an empty line, which is not JSON");
    is_refused("NaN", 1, "answered `NaN`, which is not JSON");
    is_refused("Infinity", 1, "answered `Infinity`, which is not JSON");
    is_refused("1e999", 1, "answered `1e999`, which is not JSON");
    is_refused("1 2", 1, "answered `1 2`, which is not JSON");
    is_refused("[1, 2]", 1, "answered `[1, 2]`, and one number is wanted");
    is_refused("1", 2, "answered `1`, and a list of 2 numbers is wanted");
    is_refused("[1, \"2\"]", 2, "answered `[1, \"2\"]`, and a list of 2 numbers is wanted");
    is_refused("null", 1, "answered `null`, and one number is wanted");
    is_refused("{\"score\": 1, \"score\": 2}", 1, "answered `{\"score\": 1, \"score\": 2}`, which is not JSON");
    assert_false(read_line("{\"id\": -1, \"score\": 1}", 1).says_id);
}

static void shows_the_beginning(void **state)
{
    (void)state;
    char line[1000];
    memset(line, 'x', sizeof line);
    tn_answer answer;
    tn_answer_read(line, sizeof line, 1, &answer);
    assert_int_equal(strlen(answer.refusal), strlen("answered ``, which is not JSON") + 60 + strlen("..."));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(takes_numbers), cmocka_unit_test(takes_reasons),
                                       cmocka_unit_test(refuses_others), cmocka_unit_test(shows_the_beginning)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
