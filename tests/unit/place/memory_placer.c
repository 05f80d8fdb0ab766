/* Scoring the rules of a kit, with each allocation failing once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "driver/place/placer.h"
#include "tests/support/fail_each.h"

static const char kit[] =
    "unit 10 x 8 x 10;\n"
    "connector stud joins tube turns 4; connector tube joins stud turns 4;\n"
    "part 3005 { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); }\n"
    "part 3024 { fill 20 x 8 x 20; stud up; tube down at (0, -8, 0); }\n"
    "space tower = box(20, 72, 20);\n"
    "rule all at stud, tube = 3005;\n"
    "model it { inside tower; start stud at (0, 0, 0) by all; require fill = 1; minimize elements; search beam 2; }\n";
static const char sentence[] = "rule all at stud, tube = 3005 | 3024;";
static char path[] = "/tmp/tartan-placer-XXXXXX.kit";

static int write_kit(void **state)
{
    (void)state;
    int file = mkstemps(path, 4);
    bool written = file >= 0 && write(file, kit, sizeof kit - 1) == (ssize_t)(sizeof kit - 1);
    return !written || close(file) != 0;
}

static int remove_kit(void **state)
{
    (void)state;
    return unlink(path);
}

static tn_status score(void)
{
    tn_placer *placer = NULL;
    tn_error error;
    char message[200] = "", *text = NULL;
    tn_score found = {.state = TN_SCORED};
    tn_status status = tn_placer_new(path, false, false, &placer, &error);
    if (status == TN_OK) {
        tn_evaluator evaluator = tn_placer_evaluator(placer);
        status = evaluator.evaluate(evaluator.context, 0, sentence, sizeof sentence - 1, &found, message, &error);
    }
    if (status == TN_OK) {
        assert_int_equal(found.state, TN_SCORED);
        assert_true(found.objectives[0] == 3);
        status = tn_placer_text(placer, sentence, &text, &error);
    }
    if (status == TN_OK)
        assert_non_null(strstr(text, sentence));
    free(text);
    tn_placer_free(placer);
    return status;
}

static void scoring(void **state)
{
    (void)state;
    fail_each(score, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scoring)};
    return cmocka_run_group_tests_name("memory_placer", tests, write_kit, remove_kit);
}
