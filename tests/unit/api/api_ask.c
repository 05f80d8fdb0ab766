/* Questions through the C interface: what sessions keep, notes, imports by the caller's own resolver, cancelling, and
 * misuse. tests/cli/ask_interface.sh holds the answers to those of the commands. */
#include "include/tartan/tartan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                           "rule pair = neighbour(tray(lid), tray(lid))\n"
                           "measure long \"length\" = sum(width)\n"
                           "library rows using box { trays 1..3 prune pair }\n";

static tartan_session *session_of(const char *rules, const tartan_compile_options *options)
{
    tartan_session *session = NULL;
    tartan_error error;
    if (tartan_session_open("box.plan", rules, strlen(rules), options, &session, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return session;
}

/* The member of the answer that begins so, is there. */
static void answers(tartan_session *session, const char *request, const char *member)
{
    char *answer = NULL;
    tartan_error error;
    if (tartan_ask(session, "count", request, NULL, NULL, NULL, &answer, &error) != TARTAN_OK)
        fail_msg("%s: %s", request ? request : "no request", error.message);
    if (!strstr(answer, member))
        fail_msg("%s: no %s in %s", request ? request : "no request", member, answer);
    tartan_text_free(answer);
}

static void refuses(tartan_session *session, const char *question, const char *request, const char *message)
{
    char *answer = NULL;
    tartan_error error = {0};
    assert_int_equal(tartan_ask(session, question, request, NULL, NULL, NULL, &answer, &error), TARTAN_INVALID);
    assert_string_equal(error.message, message);
    assert_null(answer);
}

/* Each question is answered as if it were the first. */
static void answers_one_after_another(void **state)
{
    (void)state;
    tartan_session *session = session_of(text, NULL);
    for (int round = 0; round < 2; round++) {
        answers(session, NULL, "\"kept\": \"56\"");
        answers(session, "{\"trays\": {\"from\": 1, \"to\": 1}}", "\"kept\": \"4\"");
        answers(session, "{\"where\": [\"trays = 2\"]}", "\"kept\": \"12\"");
        answers(session, "{\"where\": [\"trays = 2\", \"tray(lid)\"]}", "\"kept\": \"8\"");
        answers(session, "{\"by\": \"long\"}", "\"most\": \"6\"");
        answers(session, "{\"library\": \"rows\", \"mirror\": true}", "\"mirror\": \"37\"");
        refuses(session, "count", "{\"library\": \"row\"}", "box.plan has no library `row`");
        refuses(session, "count", "{\"where\": [\"tray(lit)\"]}",
                "`lit` is neither a field nor a value of schema `box`");
    }
    tartan_session_free(session);
}

static void count_notes(void *context, const tartan_diagnostic *diagnostic)
{
    *(size_t *)context += diagnostic->severity == TARTAN_NOTE;
}

/* Asks from a place on the stack that is so much deeper, whose numbers the next call finds there. */
static tartan_status ask_deeper(tartan_session *session, const char *question, const char *request, size_t deeper,
                                tartan_error *error)
{
    volatile unsigned char filled[4096];
    char *answer = NULL;
    for (size_t i = 0; i < sizeof filled; i++)
        filled[i] = 1;
    tartan_status status = deeper ? ask_deeper(session, question, request, deeper - 1, error)
                                  : tartan_ask(session, question, request, NULL, NULL, NULL, &answer, error);
    tartan_text_free(answer);
    return status;
}

/* What is kept between two questions does not ask whoever waited for the first. */
static void keeps_no_watch(void **state)
{
    (void)state;
    static const char *const questions[] = {"count",  "sample",   "explain", "complete", "best",
                                            "report", "coverage", "schema",  "settings"};
    static const char *const requests[] = {"{}",
                                           "{\"count\": 3}",
                                           "{\"plan\": \"1m lid | 1m lid\"}",
                                           "{\"pattern\": \"? | ...\"}",
                                           "{\"by\": [{\"measure\": \"long\"}]}",
                                           "{}",
                                           "{}",
                                           "{}",
                                           "{}"};
    static const char rules[] = "schema box { width = 1m | 2m  lid = flag }\n"
                                "rule pair = neighbour(tray(lid), tray(lid))\nrule wide = tray(width 2m)\n"
                                "measure long = sum(width)\n"
                                "library rows using box { trays 1..3 prune pair require wide }\n";
    enum { COUNT = sizeof questions / sizeof *questions };
    for (size_t i = 0; i < (size_t)COUNT * COUNT; i++) {
        const size_t pair[] = {i / COUNT, i % COUNT};
        tartan_session *session = session_of(rules, NULL);
        for (size_t k = 0; k < 2; k++) {
            tartan_error error;
            if (ask_deeper(session, questions[pair[k]], requests[pair[k]], 3 - 2 * k, &error) != TARTAN_OK)
                fail_msg("%s, after %s: %s", questions[pair[k]], questions[pair[0]], error.message);
        }
        tartan_session_free(session);
    }
}

static void tells_notes(void **state)
{
    (void)state;
    size_t notes = 0;
    char *answer = NULL;
    tartan_error error;
    tartan_session *session = NULL;
    const char *folders[] = {TARTAN_SOURCE_DIR "/stdlib"};
    tartan_compile_options options = tartan_compile_options_init();
    options.folders = folders;
    options.folder_count = 1;
    const char *path = TARTAN_SOURCE_DIR "/tests/cli/files/cabins.plan";
    assert_int_equal(tartan_session_open(path, NULL, 0, &options, &session, &error), TARTAN_OK);
    const char *none = "{\"library\": \"cottages\", \"plan\": \"#10\", \"where\": [\"not cell()\"]}";
    assert_int_equal(tartan_ask(session, "count", none, NULL, count_notes, &notes, &answer, &error), TARTAN_OK);
    assert_non_null(strstr(answer, "\"houses\":\"0\""));
    assert_int_equal(notes, 1);
    tartan_text_free(answer);
    tartan_session_free(session);
}

static tartan_status resolve(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    (void)error;
    ++*(unsigned *)context;
    assert_string_equal(use->path, "base.plan");
    found->text = text;
    found->size = sizeof text - 1;
    return TARTAN_OK;
}

/* A question with requirements of its own compiles the text again, and asks for what it uses again; the same ones do
 * not. */
static void compiles_again_for_requirements(void **state)
{
    (void)state;
    unsigned asked = 0;
    tartan_compile_options options = tartan_compile_options_init();
    options.resolve = resolve;
    options.resolve_context = &asked;
    tartan_session *session = session_of("use \"base.plan\"\nlibrary more using box from rows { }\n", &options);
    assert_int_equal(asked, 1);
    answers(session, "{\"library\": \"more\"}", "\"kept\": \"56\"");
    assert_int_equal(asked, 1);
    for (int round = 0; round < 3; round++) {
        answers(session, "{\"library\": \"more\", \"where\": [\"trays = 3\"]}", "\"kept\": \"40\"");
        assert_int_equal(asked, 2);
    }
    answers(session, "{\"library\": \"rows\", \"where\": [\"trays = 3\"]}", "\"kept\": \"40\"");
    assert_int_equal(asked, 3);
    tartan_session_free(session);
}

/* The values that the options give to params hold for every question, also for those that compile the text again. */
static void keeps_values_of_params(void **state)
{
    (void)state;
    static const char rules[] =
        "schema box { long = 1m | 2m }\nparam most \"metres\" = 3m in 1m..6m\nparam side = left | right\n"
        "library rows { trays 1..3 require sum(long) <= most, side = right implies tray(1m) }\n";
    char given[] = "most=2m", word[] = "side=right";
    const char *params[] = {word, given};
    tartan_compile_options options = tartan_compile_options_init();
    tartan_session *session = session_of(rules, NULL);
    answers(session, NULL, "\"kept\": \"6\"");
    tartan_session_free(session);
    options.params = params;
    options.param_count = 2;
    session = session_of(rules, &options);
    memset(given, 'x', sizeof given - 1); /* they are the session's own */
    answers(session, NULL, "\"kept\": \"2\"");
    answers(session, "{\"where\": [\"trays = 2\"]}", "\"kept\": \"1\"");
    tartan_session_free(session);
}

static void refuses_values_of_params(void **state)
{
    (void)state;
    static const struct {
        const char *path, *param, *message;
        tartan_status status;
    } cases[] = {
        {"box.plan", "most=9m", "9m is outside the range of `most`", TARTAN_INVALID},
        {"box.plan", "mast=2m", "box.plan has no param `mast`", TARTAN_INVALID},
        {"box.plan", "most", "expected `=`, but found the end of the file", TARTAN_INVALID},
        {"box.field", "most=2m", "--set most=2m: box.field has no params", TARTAN_INVALID},
        {"box.plan", NULL, "the value of a param is NULL", TARTAN_INVALID},
    };
    static const char rules[] = "schema box { long = 1m | 2m }\nparam most = 3m in 1m..6m\n";
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        tartan_compile_options options = tartan_compile_options_init();
        tartan_error error = {0};
        tartan_session *session = NULL;
        tartan_module *module = NULL;
        options.params = &cases[i].param;
        options.param_count = 1;
        assert_int_equal(tartan_session_open(cases[i].path, rules, strlen(rules), &options, &session, &error),
                         cases[i].status);
        assert_string_equal(error.message, cases[i].message);
        assert_int_equal(tartan_compile_text(cases[i].path, rules, strlen(rules), &options, &module, &error),
                         cases[i].status);
        assert_string_equal(error.message, cases[i].message);
        options.params = NULL;
        assert_int_equal(tartan_session_open("box.plan", rules, strlen(rules), &options, &session, &error),
                         TARTAN_INVALID);
    }
}

static bool refuse(void *context, double done, double total)
{
    (void)done, (void)total;
    ++*(unsigned *)context;
    return false;
}

static void can_be_stopped(void **state)
{
    (void)state;
    unsigned asked = 0;
    char *answer = NULL;
    tartan_error error;
    tartan_watch watch = tartan_watch_init();
    tartan_session *session = session_of(text, NULL);
    watch.go_on = refuse;
    watch.context = &asked;
    assert_int_equal(tartan_ask(session, "count", NULL, &watch, NULL, NULL, &answer, &error), TARTAN_STOPPED);
    assert_string_equal(error.message, "stopped before it was done");
    assert_true(asked > 0);
    assert_null(answer);
    answers(session, NULL, "\"kept\": \"56\"");
    tartan_session_free(session);
}

typedef struct taken {
    size_t files, size;
    tartan_status status; /* what it returns */
} taken;

static tartan_status take_mesh(void *context, const char *format, const char *name, const void *bytes, size_t size,
                               tartan_error *error)
{
    taken *t = context;
    assert_string_equal(format, "glb");
    assert_null(name);
    assert_memory_equal(bytes, "glTF", 4);
    t->files++;
    t->size = size;
    snprintf(error->message, sizeof error->message, "no room");
    snprintf(error->help, sizeof error->help, "make some");
    return t->status;
}

/* A mesh of a box: whether it is in the answer. */
static bool has_mesh(tartan_session *session)
{
    char *answer = NULL;
    tartan_error error;
    assert_int_equal(tartan_ask(session, "mesh", "{\"format\": \"glb\"}", NULL, NULL, NULL, &answer, &error),
                     TARTAN_OK);
    assert_non_null(strstr(answer, "\"glb\""));
    bool has = strstr(answer, "\"base64\"") != NULL;
    tartan_text_free(answer);
    return has;
}

static void gives_bytes_to_whoever_takes_them(void **state)
{
    (void)state;
    static const char rules[] = "solid b { box a at (0, 0, 0) size (1, 1, 1); }";
    char *answer = NULL;
    tartan_error error;
    tartan_session *session = NULL;
    taken t = {.status = TARTAN_OK};
    assert_int_equal(tartan_session_open("b.solid", rules, strlen(rules), NULL, &session, &error), TARTAN_OK);
    assert_true(has_mesh(session));
    tartan_session_take_bytes(session, take_mesh, &t);
    assert_false(has_mesh(session));
    assert_int_equal(t.files, 1);
    assert_true(t.size > 500);
    t.status = TARTAN_LIMIT;
    assert_int_equal(tartan_ask(session, "mesh", "{\"format\": \"glb\"}", NULL, NULL, NULL, &answer, &error),
                     TARTAN_LIMIT);
    assert_string_equal(error.message, "no room");
    assert_string_equal(error.help, "make some");
    assert_null(answer);
    t.status = TARTAN_MEMORY;
    assert_int_equal(tartan_ask(session, "mesh", "{\"format\": \"glb\"}", NULL, NULL, NULL, &answer, &error),
                     TARTAN_MEMORY);
    tartan_session_take_bytes(session, NULL, NULL);
    assert_true(has_mesh(session));
    assert_int_equal(t.files, 3);
    tartan_session_take_bytes(NULL, take_mesh, &t);
    tartan_session_free(session);
}

static void refuses_misuse(void **state)
{
    (void)state;
    char *answer = NULL;
    tartan_session *session = NULL;
    tartan_error error = {0};
    assert_int_equal(tartan_session_open(NULL, text, 1, NULL, &session, &error), TARTAN_INVALID);
    assert_int_equal(tartan_session_open("box.plan", text, sizeof text - 1, NULL, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_session_open("box.plan", "rule", 4, NULL, &session, &error), TARTAN_INVALID);
    assert_int_equal(tartan_session_open("gone.plan", NULL, 0, NULL, &session, &error), TARTAN_IO);
    assert_null(session);
    session = session_of(text, NULL);
    assert_int_equal(tartan_ask(NULL, "count", NULL, NULL, NULL, NULL, &answer, &error), TARTAN_INVALID);
    assert_int_equal(tartan_ask(session, NULL, NULL, NULL, NULL, NULL, &answer, &error), TARTAN_INVALID);
    assert_int_equal(tartan_ask(session, "count", NULL, NULL, NULL, NULL, NULL, &error), TARTAN_INVALID);
    refuses(session, "counts", NULL, "there is no question `counts`");
    refuses(session, "count", "{", "the request is no JSON object: string or '}' expected near end of file");
    refuses(session, "count", "{\"by\": \"long\", \"by\": \"long\"}",
            "the request is no JSON object: duplicate object key near '\"by\"'");
    refuses(session, "count", "{\"bye\": \"long\"}", "a count_request has no `bye`");
    refuses(session, "count", "{\"by\": null, \"where\": [1]}",
            "`where` is a list of texts: only plans, or houses, that meet these requirements too, in the words of the "
            "file");
    assert_null(answer);
    tartan_session_free(session);
    tartan_session_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_one_after_another),
        cmocka_unit_test(keeps_no_watch),
        cmocka_unit_test(tells_notes),
        cmocka_unit_test(compiles_again_for_requirements),
        cmocka_unit_test(keeps_values_of_params),
        cmocka_unit_test(refuses_values_of_params),
        cmocka_unit_test(can_be_stopped),
        cmocka_unit_test(gives_bytes_to_whoever_takes_them),
        cmocka_unit_test(refuses_misuse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
