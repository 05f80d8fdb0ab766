/* Lines of houses that differ: in the order in which people see it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/house/diverse.h"

static const char *const lines[] = {
    "8' a | 8' b ; 1 flat ; bed hall | bath ; door wall ; cot.left cot.right",   /* 0 */
    "8' a | 8' b ; 1 flat ; bed hall | bath ; door wall ; desk.left desk.right", /* 1: other tiles, both */
    "8' a | 8' b ; 1 flat ; bed hall | bath ; wall wall ; cot.left cot.right",   /* 2: another face */
    "8' a | 8' b ; 1 flat ; hall bed | bath ; door wall ; cot.left cot.right",   /* 3: functions elsewhere */
    "8' a | 8' b ; 1 flat ; hall hall | bath ; door wall ; cot.left cot.right",  /* 4: another programme */
    "8' a | 8' b ; 1 gable ; bed hall | bath ; door wall ; cot.left cot.right",  /* 5: another roof */
    "8' a | 9' b ; 1 flat ; bed hall | bath ; door wall ; cot.left cot.right",   /* 6: another plan */
    "8' a ; 1 flat ; bed hall ; - ; -",                                          /* 7: a shorter one */
};

enum { LINES = sizeof lines / sizeof *lines };

/* From the first of the lines before `count` on, so many are these. */
static void expect(size_t count, size_t wanted, const char *numbers)
{
    bool chosen[LINES] = {false};
    char got[LINES + 1] = "";
    tn_error error;
    assert_int_equal(tn_lines_choose(lines, count, 0, wanted, chosen, &error), TN_OK);
    for (size_t i = 0; i < count; i++)
        if (chosen[i])
            strncat(got, &"01234567"[i], 1);
    assert_string_equal(got, numbers);
}

static void what_people_see_first(void **state)
{
    (void)state;
    expect(0, 3, "");
    expect(1, 3, "0");
    expect(LINES, 1, "0");
    for (size_t count = 2; count <= LINES; count++) { /* the last differs most */
        const char numbers[] = {'0', (char)('0' + count - 1), '\0'};
        expect(count, 2, numbers);
    }
    expect(LINES, 3, "067");
    expect(LINES, 4, "0567");
    expect(LINES, 5, "04567");
    expect(LINES, 6, "034567");
    expect(LINES, 7, "0234567");
    expect(LINES, 99, "01234567");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_people_see_first)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
