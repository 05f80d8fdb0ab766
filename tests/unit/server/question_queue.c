/* Questions that wait: their order, and which end which. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "studio/server/question_queue.h"

static void put(tn_question_queue *queue, json_t *message)
{
    assert_non_null(message);
    assert_true(tn_question_queue_put(queue, message, 10));
}

static void ask(tn_question_queue *queue, int id, const char *name, const char *uri, const char *subject)
{
    put(queue, json_pack("{s:i,s:s,s:{s:s,s:s*}}", "id", id, "method", name, "params", "uri", uri, "subject", subject));
}

static void change(tn_question_queue *queue, const char *uri)
{
    put(queue,
        json_pack("{s:s,s:{s:{s:s}}}", "method", "textDocument/didChange", "params", "textDocument", "uri", uri));
}

static void cancel(tn_question_queue *queue, json_t *id)
{
    put(queue, json_pack("{s:s,s:{s:o}}", "method", "$/cancelRequest", "params", "id", id));
}

static int id_of(const json_t *message)
{
    return (int)json_integer_value(json_object_get(message, "id"));
}

/* The id of the next that is worked on; 0 for a change, -1 if there is none. */
static int next(tn_question_queue *queue)
{
    const json_t *message = tn_question_queue_next(queue);
    return message ? id_of(message) : -1;
}

/* Takes an answer that says that a question was ended: its id; -1 if there is none. */
static int ended(json_t *answer)
{
    if (!answer)
        return -1;
    int id = id_of(answer);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(answer, "error"), "code")), TN_CANCELLED);
    assert_string_equal(json_string_value(json_object_get(answer, "jsonrpc")), "2.0");
    json_decref(answer);
    return id;
}

static void keeps_the_order(void **state)
{
    tn_question_queue *queue = *state;
    ask(queue, 1, "tartan/count", "a", NULL);
    change(queue, "a");
    ask(queue, 2, "tartan/sample", "a", NULL);
    assert_int_equal(tn_question_queue_size(queue), 30);
    assert_int_equal(next(queue), 1);
    assert_null(tn_question_queue_next(queue)); /* one at a time */
    assert_int_equal(ended(tn_question_queue_done(queue)), -1);
    assert_int_equal(next(queue), 0);
    assert_null(tn_question_queue_done(queue));
    assert_int_equal(next(queue), 2);
    assert_int_equal(tn_question_queue_size(queue), 0);
    assert_null(tn_question_queue_done(queue));
    assert_int_equal(next(queue), -1);
    assert_null(tn_question_queue_done(queue)); /* harmless */
    assert_null(tn_question_queue_ended(queue));
}

static void the_newer_ends_the_older(void **state)
{
    tn_question_queue *queue = *state;
    ask(queue, 1, "tartan/count", "a", NULL);
    ask(queue, 2, "tartan/count", "a", "one"); /* another subject */
    ask(queue, 3, "tartan/count", "b", NULL);  /* another text */
    ask(queue, 4, "tartan/sample", "a", NULL); /* another question */
    assert_null(tn_question_queue_ended(queue));
    assert_int_equal(next(queue), 1);
    ask(queue, 5, "tartan/count", "a", NULL);
    assert_true(tn_question_queue_unwanted(queue));
    ask(queue, 6, "tartan/sample", "a", NULL);
    ask(queue, 7, "tartan/count", "a", NULL);
    assert_int_equal(ended(tn_question_queue_ended(queue)), 4);
    assert_int_equal(ended(tn_question_queue_ended(queue)), 5);
    assert_int_equal(ended(tn_question_queue_ended(queue)), -1);
    assert_int_equal(ended(tn_question_queue_done(queue)), 1);
    assert_false(tn_question_queue_unwanted(queue));
    const int left[] = {2, 3, 6, 7};
    for (size_t i = 0; i < sizeof left / sizeof *left; i++) {
        assert_int_equal(next(queue), left[i]);
        assert_null(tn_question_queue_done(queue));
    }
    assert_int_equal(next(queue), -1);
}

static void changes_are_never_ended(void **state)
{
    tn_question_queue *queue = *state;
    change(queue, "a");
    change(queue, "a");
    assert_int_equal(next(queue), 0);
    change(queue, "a");
    assert_false(tn_question_queue_unwanted(queue));
    assert_null(tn_question_queue_done(queue));
    assert_int_equal(next(queue), 0);
    assert_null(tn_question_queue_done(queue));
    assert_int_equal(next(queue), 0);
}

static void cancels(void **state)
{
    tn_question_queue *queue = *state;
    ask(queue, 1, "tartan/count", "a", NULL);
    ask(queue, 2, "tartan/sample", "a", NULL);
    ask(queue, 3, "tartan/draw", "a", NULL);
    assert_int_equal(next(queue), 1);
    cancel(queue, json_integer(4));
    cancel(queue, json_string("1")); /* is another id */
    cancel(queue, json_object());
    assert_false(tn_question_queue_unwanted(queue));
    assert_null(tn_question_queue_ended(queue));
    cancel(queue, json_integer(1));
    assert_true(tn_question_queue_unwanted(queue));
    cancel(queue, json_integer(3));
    assert_int_equal(ended(tn_question_queue_ended(queue)), 3);
    assert_int_equal(ended(tn_question_queue_done(queue)), 1);
    ask(queue, 5, "tartan/draw", "b", NULL); /* behind what became the last */
    assert_int_equal(next(queue), 2);
    assert_null(tn_question_queue_done(queue));
    assert_int_equal(next(queue), 5);
    cancel(queue, json_integer(5));
    cancel(queue, json_integer(5));
    assert_int_equal(ended(tn_question_queue_done(queue)), 5);
    assert_int_equal(next(queue), -1);
}

/* Whatever members are missing, or of another type. */
static void takes_anything(void **state)
{
    tn_question_queue *queue = *state;
    put(queue, json_object());
    put(queue, json_pack("{s:n,s:i,s:[]}", "id", "method", 17, "params"));
    put(queue, json_pack("{s:[i],s:s,s:s}", "id", 1, "method", "tartan/count", "params", "none"));
    put(queue, json_pack("{s:s}", "method", "$/cancelRequest"));
    for (int i = 0; i < 3; i++) {
        assert_non_null(tn_question_queue_next(queue));
        json_decref(tn_question_queue_done(queue));
    }
    assert_int_equal(next(queue), -1);
}

static int set_up(void **state)
{
    return (*state = tn_question_queue_new()) ? 0 : -1;
}

static int tear_down(void **state)
{
    tn_question_queue_free(*state);
    return 0;
}

#define CASE(NAME) cmocka_unit_test_setup_teardown(NAME, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {CASE(keeps_the_order), CASE(the_newer_ends_the_older),
                                       CASE(changes_are_never_ended), CASE(cancels), CASE(takes_anything)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
