/* Out of memory where a study is evolved and bred by hand without a folder. Each of our allocations fails once, and
 * then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/answer_or_memory.h"

static const char study[] = "evolution {\n  grammar \"words.bnf\"\n  match \"hello\"\n  population 5\n  seed 3\n}\n";

static const char path[] = TARTAN_SOURCE_DIR "/stdlib/bred.study";

static tn_status evolve(tn_session *session, const void *request, tn_reply *answer)
{
    return tn_ask_evolve(session, request, answer);
}

static tn_status breed(tn_session *session, const void *request, tn_reply *answer)
{
    return tn_ask_breed(session, request, answer);
}

static const tn_run_asked run = {.has_generations = true, .generations = 2, .has_threads = true, .threads = 1};

static void evolved_without_memory(void **state)
{
    (void)state;
    answer_or_memory(path, study, evolve, &(tn_evolve_request){.asked = run, .page = true}, 20);
}

static void bred_without_memory(void **state)
{
    (void)state;
    tn_breed_action actions[] = {{.does = 0, .parents = "1 2*3"},
                                 {.does = 1, .change = "mutation codons 0.5"},
                                 {.does = 2, .sentence = "hel"},
                                 {.does = 4, .member = "2"},
                                 {.does = 0, .parents = "2"}};
    const tn_breed_request request = {.asked = run, .actions = {actions, sizeof actions / sizeof *actions}};
    answer_or_memory(path, study, breed, &request, 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(evolved_without_memory), cmocka_unit_test(bred_without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
