/* Requests of any bytes, of each question, to three files: each is answered or refused, an answer is JSON, and what was
 * asked before changes no answer. */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "include/tartan/tartan.h"
#include "tests/fuzz/fuzz.h"

static const struct {
    const char *path, *text;
} files[] = {
    {"plans.plan",
     "schema s { w = 1m | 2m  lid = flag }\nrule pair = neighbour(tray(lid), tray(lid))\nmeasure m = sum(w)\n"
     "library l using s { trays 1..3 prune pair require sum(w) <= 5m }\nlibrary k using s { trays 2 }\n"},
    {"houses.plan", "schema s { w = 4m  zone z = room(4m) | none }\nlibrary l using s { trays 1..2 }\n"
                    "form f of s {\n  storey low 2.7m\n  wall 250mm\n  partition 200mm\n  floor 200mm\n  roof 250mm\n"
                    "  function hall at cell(any)\n}\nmeasure tall using f = quantity(cell(any))\n"
                    "library h from l in f { require quantity(cell(any)) >= 1 }\n"},
    {"parts.kit",
     "unit 10 x 8 x 10;\nconnector stud joins tube turns 4 every 20;\nconnector tube joins stud turns 4 every 20;\n"
     "part a { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); }\n"},
};

static const char *const questions[] = {"count", "explain", "rank", "unrank", "relations"};

static void fail(const char *what, const char *request)
{
    fprintf(stderr, "requests: %s: %s\n", what, request);
    abort();
}

/* Longer plans and more parts are asked for without an end. */
static bool takes_long(const char *request)
{
    return strstr(request, "\"trays\"") || strstr(request, "\"parts\"");
}

/* The answer, which the caller frees, or NULL. */
static char *ask(tartan_session *session, const char *question, const char *request)
{
    char *answer = NULL;
    tartan_error error = {0};
    tartan_status status = tartan_ask(session, question, request, NULL, NULL, NULL, &answer, &error);
    if ((status == TARTAN_OK) != (answer != NULL))
        fail("neither answered nor refused", request);
    if (status != TARTAN_OK && !error.message[0])
        fail("refused without a reason", request);
    if (status == TARTAN_INTERNAL)
        fail(error.message, request);
    return answer;
}

static void check_json(const char *answer, const char *request)
{
    json_error_t wrong;
    json_t *json = answer ? json_loads(answer, JSON_REJECT_DUPLICATES, &wrong) : NULL;
    if (answer && !json)
        fail("the answer is no JSON", request);
    json_decref(json);
}

static void check(const char *path, const char *text, const char *question, const char *request)
{
    tartan_session *session = NULL;
    tartan_error error;
    if (tartan_session_open(path, text, strlen(text), NULL, &session, &error) != TARTAN_OK)
        fail(error.message, path);
    char *first = ask(session, question, request);
    char *other = ask(session, "count", "{\"no_effects\": true}");
    char *another = ask(session, "explain", "{\"plan\": \"1m lid\"}");
    char *again = ask(session, question, request);
    check_json(first, request);
    if (!first != !again || (first && strcmp(first, again) != 0))
        fail("another answer the second time", request);
    tartan_text_free(first);
    tartan_text_free(other);
    tartan_text_free(another);
    tartan_text_free(again);
    tartan_session_free(session);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *request = malloc(size + 1);
    if (!request)
        return 0;
    memcpy(request, data, size);
    request[size] = '\0';
    for (size_t i = 0; i < sizeof files / sizeof *files && !takes_long(request); i++) {
        for (size_t q = 0; q < sizeof questions / sizeof *questions; q++)
            check(files[i].path, files[i].text, questions[q], request);
    }
    free(request);
    return 0;
}
