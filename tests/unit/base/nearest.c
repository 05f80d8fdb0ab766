/* Suggestions: near enough to be meant, and nothing else. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/nearest.h"

static const char *const words[] = {"machine", "body", "bay", "width", "neighbour", "4'", "x"};

static void expect(const char *word, const char *wanted)
{
    const char *got = tn_nearest(word, words, sizeof words / sizeof *words);
    if (wanted)
        assert_string_equal(got ? got : "nothing", wanted);
    else if (got)
        fail_msg("%s: suggested %s", word, got);
}

static void test_slips(void **state)
{
    (void)state;
    expect("mahcine", "machine"); /* swapped */
    expect("machin", "machine");  /* left out */
    expect("machiine", "machine");
    expect("maxhime", "machine"); /* two wrong of seven */
    expect("neighbor", "neighbour");
    expect("Width", "width");
    expect("BODY", "body");
    expect("boy", "body"); /* and bay is as near, but later */
    expect("4\"", "4'");
}

static void test_nothing_like_it(void **state)
{
    (void)state;
    expect("", NULL);
    expect("kitchen", NULL);
    expect("y", NULL); /* x is one step away, but nothing of the word remains */
    expect("by-the-way", NULL);
    char longest[200];
    memset(longest, 'm', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    expect(longest, NULL);
    const char *candidates[] = {longest};
    assert_null(tn_nearest("mmm", candidates, 1));
    assert_null(tn_nearest("mmm", NULL, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slips),
        cmocka_unit_test(test_nothing_like_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
