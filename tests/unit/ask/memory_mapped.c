/* Out of memory where genomes are mapped, with their derivations, and where a sentence is inverted. Each of our
 * allocations fails once, and then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/answer_or_memory.h"

static tn_status map(tn_session *session, const void *request, tn_reply *answer)
{
    return tn_ask_map(session, request, answer);
}

static tn_status invert(tn_session *session, const void *request, tn_reply *answer)
{
    return tn_ask_invert(session, request, answer);
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
    tn_map_request mapped = {.genomes = {&genome, 1}, .trace = true, .tree = 1};
    const tn_invert_request inverted = {.sentence = "(x+y)"};
    answer_or_memory("g.bnf", plain, map, &mapped, 40);
    answer_or_memory("g.bnf", plain, invert, &inverted, 40);
    mapped.tree = 2;
    answer_or_memory("g.bnf", plain, map, &mapped, 40);
    answer_or_memory("g.bnf", genr8, map, &mapped, 40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
