/* Out of memory at the desk and in the language server over served files. Each of our allocations fails once, and then
 * all from there on: nothing crashes, a request is answered (perhaps by an error) or there is no memory to say so, and
 * afterwards the same question has its answer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "lsp/exchange.h"
#include "studio/desk/desk.h"
#include "tests/support/failing_memory.h"

static const char trays[] = "schema row { width = 3m | 4m use = shop | home }\n"
                            "rule pair = neighbour(tray(shop), tray(shop))\n";

static tn_status read_file(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    (void)context;
    if (strcmp(path, "/trays.plan") != 0)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no file %s", path);
    *bytes = (uint8_t *)strdup(trays);
    *size = sizeof trays - 1;
    return *bytes ? TN_OK : tn_fail_memory(error);
}

static const tn_served folder = {.read = read_file};

static json_t *parsed(const char *text)
{
    json_t *message = json_loads(text, 0, NULL);
    assert_non_null(message);
    return message;
}

typedef struct messages {
    json_t *open, *count, *settings, *open_box, *mesh, *hover, *initialize;
} messages;

static messages make_messages(void)
{
    return (messages){
        .open = parsed(
            "{\"method\": \"textDocument/didOpen\", \"params\": {\"textDocument\": {\"uri\": \"file:///a.plan\", "
            "\"version\": 1, \"text\": \"use \\\"trays.plan\\\"\\nparam most = 2\\n"
            "library l { trays 1..2 require quantity(any) <= most prune pair }\\n\"}}}"),
        .count = parsed(
            "{\"id\": 1, \"method\": \"tartan/count\", \"params\": {\"uri\": \"file:///a.plan\", \"version\": 1, "
            "\"request\": {}}}"),
        .settings = parsed("{\"id\": 2, \"method\": \"tartan/settings\", \"params\": {\"uri\": \"file:///a.plan\", "
                           "\"version\": 1, \"request\": {}}}"),
        .open_box = parsed("{\"method\": \"textDocument/didOpen\", \"params\": {\"textDocument\": {\"uri\": "
                           "\"file:///b.solid\", \"version\": 1, \"text\": "
                           "\"solid b { box a at (0, 0, 0) size (1, 1, 1); }\"}}}"),
        .mesh = parsed("{\"id\": 5, \"method\": \"tartan/mesh\", \"params\": {\"uri\": \"file:///b.solid\", "
                       "\"version\": 1, \"binary\": true, \"request\": {\"format\": \"glb\"}}}"),
        .hover = parsed("{\"id\": 3, \"method\": \"textDocument/hover\", \"params\": {\"textDocument\": {\"uri\": "
                        "\"file:///a.plan\"}, \"position\": {\"line\": 2, \"character\": 36}}}"),
        .initialize = parsed("{\"id\": 4, \"method\": \"initialize\", \"params\": {}}"),
    };
}

static void clear_messages(messages *m)
{
    json_decref(m->open);
    json_decref(m->count);
    json_decref(m->settings);
    json_decref(m->open_box);
    json_decref(m->mesh);
    json_decref(m->hover);
    json_decref(m->initialize);
}

/* Is it answered by a result? */
static bool has_result(const char *response)
{
    return response && strstr(response, "\"result\"");
}

/* False where there was no memory to say anything. */
static bool ask(tn_desk *desk, const json_t *message, bool *result)
{
    char *response;
    tn_status status = tn_desk_take(desk, message, NULL, &response);
    assert_true(status == TN_OK ? response != NULL : status == TN_MEMORY && !response);
    *result = has_result(response);
    free(response);
    return status == TN_OK;
}

/* And with its bytes, unless it is an error. */
static bool ask_mesh(tn_desk *desk, const json_t *message, bool *result)
{
    size_t size;
    bool said = ask(desk, message, result);
    uint8_t *bytes = tn_desk_bytes(desk, &size);
    assert_int_equal(bytes != NULL, *result);
    free(bytes);
    return said;
}

/* How many allocations all of it takes. */
static size_t try_desk(const messages *m, size_t failing, int all_after)
{
    tn_desk *desk = NULL;
    tn_error error;
    char *response;
    bool result;
    fail_allocation(failing, all_after);
    tn_status status = tn_desk_new(&folder, &desk, &error);
    if (status == TN_OK && (status = tn_desk_take(desk, m->open, NULL, &response)) == TN_OK &&
        (status = tn_desk_take(desk, m->open_box, NULL, &response)) == TN_OK) {
        ask(desk, m->count, &result);
        ask(desk, m->settings, &result);
        ask_mesh(desk, m->mesh, &result);
    }
    size_t allocations = stop_failing();
    if (status == TN_OK) {
        assert_true(ask(desk, m->count, &result) && result);
        assert_true(ask(desk, m->settings, &result) && result);
        assert_true(ask_mesh(desk, m->mesh, &result) && result);
    }
    tn_desk_free(desk);
    return allocations;
}

static void desk_runs_out_of_memory(void **state)
{
    (void)state;
    messages m = make_messages();
    size_t count = try_desk(&m, SIZE_MAX, 0);
    for (size_t i = 0; i < count; i++)
        for (int all_after = 0; all_after < 2; all_after++)
            try_desk(&m, i, all_after);
    clear_messages(&m);
}

static size_t try_exchange(const messages *m, size_t failing, int all_after)
{
    tn_exchange *exchange = NULL;
    tn_error error;
    fail_allocation(failing, all_after);
    if (tn_exchange_new(&folder, &exchange, &error) == TN_OK) {
        tn_exchange_take(exchange, m->initialize);
        tn_exchange_take(exchange, m->open);
        tn_exchange_work(exchange);
        tn_exchange_take(exchange, m->hover);
    }
    size_t allocations = stop_failing();
    for (json_t *message; exchange && (message = tn_exchange_next(exchange));)
        json_decref(message);
    tn_exchange_free(exchange);
    return allocations;
}

static void exchange_runs_out_of_memory(void **state)
{
    (void)state;
    messages m = make_messages();
    size_t count = try_exchange(&m, SIZE_MAX, 0);
    for (size_t i = 0; i < count; i++)
        for (int all_after = 0; all_after < 2; all_after++)
            try_exchange(&m, i, all_after);
    clear_messages(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(desk_runs_out_of_memory),
        cmocka_unit_test(exchange_runs_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
