/* Out of memory where a study is evolved and bred by hand without a folder. Each of our allocations fails once, and
 * then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/session/questions.h"
#include "driver/open/open.h"
#include "tests/support/same_or_memory.h"

static const char study[] = "evolution {\n  grammar \"words.bnf\"\n  match \"hello\"\n  population 5\n  seed 3\n}\n";

typedef struct asked {
    tn_opened opened;
    const tn_evolve_request *evolve;
    const tn_breed_request *breed;
} asked;

static tn_status ask(void *context, tn_buffer *out, tn_error *error)
{
    asked *a = context;
    tn_session session = {.opened = &a->opened};
    tn_compilation *compilation = &a->opened.compilation;
    const tn_diagnostics kept = compilation->diagnostics;
    tn_reply answer;
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    tn_status status =
        a->evolve ? tn_ask_evolve(&session, a->evolve, &answer) : tn_ask_breed(&session, a->breed, &answer);
    if (status == TN_OK) {
        tn_json json = tn_json_text(out, TN_JSON_TIGHT);
        tn_message_write(answer.message, answer.value, NULL, &json);
    }
    if (status == TN_MEMORY || out->failed)
        status = tn_fail_memory(error);
    tn_reply_clear(&answer);
    tn_session_forget(&session);
    tn_diagnostics_clear(&compilation->diagnostics);
    compilation->diagnostics = kept;
    return status;
}

static void ask_of(const tn_evolve_request *evolve, const tn_breed_request *breed)
{
    asked a = {.evolve = evolve, .breed = breed};
    assert_int_equal(
        tn_open_bytes(TARTAN_SOURCE_DIR "/stdlib/bred.study", (const uint8_t *)study, strlen(study), false, &a.opened),
        TN_OK);
    same_or_memory(ask, &a, 20);
    tn_close(&a.opened);
}

static const tn_run_asked run = {.has_generations = true, .generations = 2, .has_threads = true, .threads = 1};

static void evolved_without_memory(void **state)
{
    (void)state;
    ask_of(&(tn_evolve_request){.asked = run, .page = true}, NULL);
}

static void bred_without_memory(void **state)
{
    (void)state;
    tn_breed_action actions[] = {{.does = 0, .parents = "1 2*3"},
                                 {.does = 1, .change = "mutation codons 0.5"},
                                 {.does = 2, .sentence = "hel"},
                                 {.does = 4, .member = "2"},
                                 {.does = 0, .parents = "2"}};
    ask_of(NULL, &(tn_breed_request){.asked = run, .actions = {actions, sizeof actions / sizeof *actions}});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(evolved_without_memory), cmocka_unit_test(bred_without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
