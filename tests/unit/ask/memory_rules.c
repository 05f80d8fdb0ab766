/* Out of memory where a rule is shown as a tree, and where it is edited. Each of our allocations fails once, and then
 * all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/answer_or_memory.h"

static const char path[] = "rules.plan";

/* Comments that edits move, and a rule that stands as it is laid out. */
static const char text[] = "schema row { width = 1m | 2m  lit = flag  zone wall = solid(1m, 2m) | open }\n"
                           "rule wide = tray(2m)\n"
                           "rule pair(p, q) = symmetric neighbour(p, q)\n"
                           "rule laid-out = quantity(wide, n > 1) or tray(1m)\n"
                           "rule long = (tray(1m # a\n, lit) and some v in width (tray(v, lit))) # b\n"
                           "  or neighbour(beginning, wide, # c\n ...) or tray(lit) beside pair(wide, any)\n";

static tn_status tree(tn_session *session, const void *request, tn_reply *answer)
{
    return tn_ask_rule_tree(session, request, answer);
}

static tn_status edit(tn_session *session, const void *request, tn_reply *answer)
{
    return tn_ask_rule_edit(session, request, answer);
}

static void shown_without_memory(void **state)
{
    (void)state;
    answer_or_memory(path, text, tree, &(tn_rule_tree_request){.rule = "long"}, 20);
}

/* In the order of the request's words. */
enum { STEP, SET, CLEAR, ADD, WRAP, UNWRAP, JOIN, INSERT, MOVE, REMOVE, CONDITION, TEXT, NEW };

static void edited_without_memory(void **state)
{
    (void)state;
    const tn_rule_edit_request edits[] = {
        {.rule = "laid-out", .operation = WRAP, .by = "not"},
        {.rule = "laid-out", .operation = STEP, .has_part = true, .part = 3, .field = "wall"},
        {.rule = "long", .operation = MOVE, .has_part = true, .part = 5, .has_from = true, .from = 2},
        {.rule = "long", .operation = REMOVE, .has_part = true, .part = 2},
        {.rule = "long", .operation = TEXT, .text = "tray(3m"},
        {.rule = "long", .operation = INSERT, .text = "tray(3m)"},
        {.rule = "newest", .operation = NEW, .has_at = true, .at = 90},
    };
    for (size_t i = 0; i < sizeof edits / sizeof *edits; i++)
        answer_or_memory(path, text, edit, &edits[i], 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(shown_without_memory), cmocka_unit_test(edited_without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
