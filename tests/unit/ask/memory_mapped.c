/* Out of memory where genomes are mapped, with their derivations, and where a sentence is inverted. Each of our
 * allocations fails once, and then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/session/questions.h"
#include "driver/open/open.h"
#include "tests/support/same_or_memory.h"

typedef struct asked {
    tn_opened opened;
    const tn_map_request *map;
    const tn_invert_request *invert;
} asked;

static tn_status ask(void *context, tn_buffer *out, tn_error *error)
{
    asked *a = context;
    tn_session session = {.opened = &a->opened};
    tn_compilation *compilation = &a->opened.compilation;
    const tn_diagnostics kept = compilation->diagnostics;
    tn_reply answer;
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    tn_status status = a->map ? tn_ask_map(&session, a->map, &answer) : tn_ask_invert(&session, a->invert, &answer);
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

static void ask_of(const char *grammar, const tn_map_request *map, const tn_invert_request *invert)
{
    asked a = {.map = map, .invert = invert};
    assert_int_equal(tn_open_bytes("g.bnf", (const uint8_t *)grammar, strlen(grammar), false, &a.opened), TN_OK);
    same_or_memory(ask, &a, 40);
    tn_close(&a.opened);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static const char plain[] = "<e> ::= <e>+<e> | (<e>) | <v> | <v>\n<v> ::= x | y\n";
    static const char genr8[] = "%dialect genr8\n%repair genome\n"
                                "<L-System> ::= <Axiom> ';' { <RewriteRule> ';' } Angle 45 ';' BranchAngle 45 ';'\n"
                                "<Axiom> ::= Edge + Edge { + Edge }\n<RewriteRule> ::= <Predecessor> -> <Successor>\n"
                                "<Predecessor> ::= Edge\n<Successor> ::= Edge [ + Edge ]\n";
    const char *genome = "0 2 0 3 1 7 8 9 3 5 2 1 8 1 2 3 6";
    tn_map_request map = {.genomes = {&genome, 1}, .trace = true, .tree = 1};
    const tn_invert_request invert = {.sentence = "(x+y)"};
    ask_of(plain, &map, NULL);
    ask_of(plain, NULL, &invert);
    map.tree = 2;
    ask_of(plain, &map, NULL);
    ask_of(genr8, &map, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
