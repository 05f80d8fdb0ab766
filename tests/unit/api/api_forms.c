/* Questions about forms behind the C interface: what a request says of growing, texts that no file holds, limits, and
 * whoever does not wait. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "include/tartan/tartan.h"

static const char leaf[] = "A + A + A\nA -> A [+ A] ~ A\nAngle 60\n";

/* There is one text, whatever is asked for. */
static tartan_status give_leaf(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    (void)error;
    ++*(int *)context;
    assert_string_equal(use->path, "leaf.hemls");
    found->text = leaf;
    found->size = sizeof leaf - 1;
    return TARTAN_OK;
}

static tartan_session *open_text(const char *path, const char *text, const tartan_compile_options *options)
{
    tartan_session *session = NULL;
    tartan_error error = {0};
    if (tartan_session_open(path, text, strlen(text), options, &session, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return session;
}

static char *ask(tartan_session *session, const char *question, const char *request)
{
    char *answer = NULL;
    tartan_error error = {0};
    if (tartan_ask(session, question, request, NULL, NULL, NULL, &answer, &error) != TARTAN_OK)
        fail_msg("%s: %s", request, error.message);
    return answer;
}

/* Statements make a study that uses the session's text; those of one request are none of the next. */
static void test_statements(void **state)
{
    (void)state;
    tartan_session *session = open_text("leaf.hemls", leaf, NULL);
    char *plain = ask(session, "grow", "{\"steps\": 2}");
    char *scaled = ask(session, "grow", "{\"steps\": 2, \"scale\": \"3\"}");
    char *again = ask(session, "grow", "{\"steps\": 2, \"scale\": \"3\"}");
    char *after = ask(session, "grow", "{\"statements\": [\"steps 2\"]}");
    assert_string_not_equal(plain, scaled);
    assert_string_equal(scaled, again);
    assert_string_equal(plain, after);
    tartan_text_free(plain);
    tartan_text_free(scaled);
    tartan_text_free(again);
    tartan_text_free(after);
    tartan_session_free(session);
}

/* What the text itself uses comes from the caller as ever. */
static void test_resolved(void **state)
{
    (void)state;
    int asked = 0;
    tartan_compile_options options = tartan_compile_options_init();
    options.resolve = give_leaf;
    options.resolve_context = &asked;
    tartan_session *study = open_text("two.study", "rules \"leaf.hemls\"\nsteps 2\n", &options);
    tartan_session *rules = open_text("leaf.hemls", leaf, &options);
    char *by_study = ask(study, "grow", "{\"scale\": \"3\"}");
    assert_int_equal(asked, 2);
    char *by_rules = ask(rules, "grow", "{\"steps\": 2, \"scale\": \"3\"}");
    assert_int_equal(asked, 2);
    assert_string_equal(by_study, by_rules);
    tartan_text_free(by_study);
    tartan_text_free(by_rules);
    tartan_session_free(study);
    tartan_session_free(rules);
}

static bool stop_at_once(void *context, double done, double total)
{
    (void)context, (void)done, (void)total;
    return false;
}

static void test_ended(void **state)
{
    (void)state;
    const tartan_watch watch = {.size = sizeof watch, .go_on = stop_at_once};
    tartan_session *session = open_text("leaf.hemls", leaf, NULL);
    char *answer = NULL;
    tartan_error error = {0};
    assert_int_equal(
        tartan_ask(session, "grow", "{\"steps\": 9, \"edge_limit\": \"40\"}", NULL, NULL, NULL, &answer, &error),
        TARTAN_LIMIT);
    assert_non_null(strstr(error.message, "edges"));
    assert_int_equal(tartan_ask(session, "grow", "{\"steps\": 9}", &watch, NULL, NULL, &answer, &error),
                     TARTAN_STOPPED);
    assert_null(answer);
    tartan_session_free(session);
}

/* A place is a list of three numbers, and a field has no value everywhere. */
static void test_points(void **state)
{
    (void)state;
    tartan_session *session = open_text("root.field", "surface root = sqrt(x) - 1\n", NULL);
    char *answer = ask(session, "mesh", "{\"points\": [[4, 0, 0], [-1, 0, 0]]}");
    assert_string_equal(answer, "{\"surface\":\"root\",\"points\":[{\"value\":1,\"gradient\":[0.25,0,0],\"inside\":"
                                "false},{\"value\":null,\"gradient\":null,\"inside\":false}]}\n");
    tartan_text_free(answer);
    tartan_session_free(session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_statements), cmocka_unit_test(test_resolved),
                                       cmocka_unit_test(test_ended), cmocka_unit_test(test_points)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
