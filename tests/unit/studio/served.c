/* The language server and the desk over files that somebody serves: what uses what, what is refused, and that no file
 * of the machine is read. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>
#include <jansson.h>

#include "lsp/exchange.h"
#include "runtime/base/bytes.h"
#include "studio/desk/desk.h"

/* ---- a folder in memory */

typedef struct shelf {
    const char *path, *text;
} shelf;

static const shelf *find(const shelf *files, const char *path)
{
    while (files->path && strcmp(files->path, path) != 0)
        files++;
    return files->path ? files : NULL;
}

static tn_status read_file(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    const shelf *file = find(context, path);
    if (!file)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no file %s", path + 1);
    *bytes = (uint8_t *)strdup(file->text);
    *size = strlen(file->text);
    return *bytes ? TN_OK : tn_fail_memory(error);
}

static tn_status list_files(void *context, char ***paths, size_t *count, bool *cut_off, tn_error *error)
{
    const shelf *files = context;
    *cut_off = false;
    *count = 0;
    *paths = calloc(8, sizeof **paths);
    if (!*paths)
        return tn_fail_memory(error);
    for (; files->path; files++)
        (*paths)[(*count)++] = strdup(files->path);
    return TN_OK;
}

static shelf files[] = {
    {"/trays.plan",
     "schema row { width = 3m | 4m use = shop | home }\nrule pair = neighbour(tray(shop), tray(shop))\n"},
    {"/sub/above.plan", "use \"../trays.plan\"\nlibrary rows { trays 1..3 prune pair }\n"},
    {"/other.plan", "use \"trays.plan\"\nlibrary others { trays 1..2 prune pair }\n"},
    {NULL, NULL},
};

static const tn_served folder = {read_file, list_files, files};

/* ---- messages */

static json_t *opened(const char *uri, const char *text, int version)
{
    return json_pack("{s:s,s:{s:{s:s,s:s,s:i,s:s}}}", "method", "textDocument/didOpen", "params", "textDocument", "uri",
                     uri, "languageId", "plan", "version", version, "text", text);
}

static json_t *request(const char *method, json_t *params)
{
    return json_pack("{s:s,s:i,s:s,s:o}", "jsonrpc", "2.0", "id", 7, "method", method, "params", params);
}

static json_t *about(const char *uri, int version, json_t *question)
{
    return json_pack("{s:s,s:i,s:o}", "uri", uri, "version", version, "request", question);
}

static const char *word(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

/* ---- the desk */

static tn_desk *new_desk(void)
{
    tn_desk *desk;
    tn_error error;
    assert_int_equal(tn_desk_new(&folder, &desk, &error), TN_OK);
    return desk;
}

static json_t *take_watched(tn_desk *desk, json_t *message, const tartan_watch *watch)
{
    char *text;
    assert_non_null(message);
    assert_int_equal(tn_desk_take(desk, message, watch, &text), TN_OK);
    json_decref(message);
    json_t *response = text ? json_loads(text, 0, NULL) : NULL;
    assert_true(!text || response);
    free(text);
    return response;
}

static json_t *take(tn_desk *desk, json_t *message)
{
    return take_watched(desk, message, NULL);
}

/* The answer of a question, which must have one. */
static json_t *answered(tn_desk *desk, json_t *message)
{
    json_t *response = take(desk, message), *result = json_object_get(response, "result");
    json_t *answer = json_incref(json_object_get(result, "answer"));
    if (!answer)
        print_error("%s\n", json_dumps(response, 0));
    assert_non_null(answer);
    json_decref(response);
    return answer;
}

static void assert_error(tn_desk *desk, json_t *message, int code, const char *says)
{
    json_t *response = take(desk, message), *error = json_object_get(response, "error");
    assert_int_equal(json_integer_value(json_object_get(error, "code")), code);
    char *all = json_dumps(error, 0);
    if (!strstr(all, says))
        print_error("%s\n", all);
    assert_non_null(strstr(all, says));
    free(all);
    json_decref(response);
}

static void assert_kept(tn_desk *desk, json_t *params, const char *kept)
{
    json_t *answer = answered(desk, request("tartan/count", params));
    assert_string_equal(word(answer, "kept"), kept);
    json_decref(answer);
}

static const char rows[] = "use \"trays.plan\"\nlibrary rows { trays 1..2 prune pair }\n";

static void test_counts_what_is_open(void **state)
{
    (void)state;
    tn_desk *desk = new_desk();
    assert_null(take(desk, opened("file:///rows.plan", rows, 1)));
    assert_kept(desk, about("file:///rows.plan", 1, json_object()), "16"); /* 4 + 16 - 4 */
    assert_null(
        take(desk, opened("file:///trays.plan",
                          "schema row { use = shop | home }\nrule pair = neighbour(tray(shop), tray(shop))\n", 1)));
    assert_kept(desk, about("file:///rows.plan", 1, json_object()), "5"); /* 2 + 4 - 1 */
    assert_null(take(desk, json_pack("{s:s,s:{s:{s:s}}}", "method", "textDocument/didClose", "params", "textDocument",
                                     "uri", "file:///trays.plan")));
    assert_kept(desk, about("file:///rows.plan", 1, json_object()), "16");
    tn_desk_free(desk);
}

static void test_follows_edits(void **state)
{
    (void)state;
    tn_desk *desk = new_desk();
    take(desk, opened("file:///rows.plan", rows, 1));
    json_t *change =
        json_pack("{s:s,s:{s:{s:s,s:i},s:[{s:{s:{s:i,s:i},s:{s:i,s:i}},s:s}]}}", "method", "textDocument/didChange",
                  "params", "textDocument", "uri", "file:///rows.plan", "version", 2, "contentChanges", "range",
                  "start", "line", 1, "character", 24, "end", "line", 1, "character", 25, "text", "1");
    assert_null(take(desk, change));
    assert_kept(desk, about("file:///rows.plan", 2, json_object()), "4");
    assert_error(desk, request("tartan/count", about("file:///rows.plan", 1, json_object())), -32801, "changed");
    tn_desk_free(desk);
}

static void test_paths_end_at_the_folder(void **state)
{
    (void)state;
    static const struct {
        const char *used, *says;
    } cases[] = {
        {"/etc/passwd", "somewhere on this machine"},
        {"../trays.plan", "leads out of the folder"},
        {"sub/../../x.plan", "leads out"},
        {"none.plan", "there is no file none.plan"},
        {"nothing", "standard library has no"},
        {"lahav", "lahave"},
    };
    tn_desk *desk = new_desk();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[100];
        snprintf(text, sizeof text, "use \"%s\"\nlibrary l { trays 1..1 }\n", cases[i].used);
        take(desk, opened("file:///a.plan", text, 1));
        assert_error(desk, request("tartan/count", about("file:///a.plan", 1, json_object())), -32803, cases[i].says);
    }
    take(desk, opened("file:///sub/b.plan", "use \"./above.plan\"\n", 1));
    assert_kept(desk, about("file:///sub/b.plan", 1, json_object()), "56"); /* 4 + 12 + 40 */
    tn_desk_free(desk);
}

static void test_params_and_texts_of_a_request(void **state)
{
    (void)state;
    tn_desk *desk = new_desk();
    take(desk, opened("file:///p.plan",
                      "use \"trays.plan\"\nparam most = 8m\nlibrary l { trays 1..2 require sum(width) <= most }\n", 1));
    assert_kept(desk, about("file:///p.plan", 1, json_object()), "20");
    json_t *set = about("file:///p.plan", 1, json_object());
    json_object_set_new(set, "set", json_pack("[s]", "most=6m"));
    assert_kept(desk, set, "8"); /* 4 + 4 */
    set = about("file:///p.plan", 1, json_object());
    json_object_set_new(set, "set", json_pack("[s]", "mist=6m"));
    assert_error(desk, request("tartan/count", set), -32803, "most");
    json_t *before = about("file:///p.plan", 1, json_pack("{s:s}", "before", "saved.plan"));
    json_object_set_new(before, "texts",
                        json_pack("{s:s}", "saved.plan", "use \"trays.plan\"\nlibrary l { trays 1..2 }\n"));
    json_t *answer = answered(desk, request("tartan/diff", before));
    json_decref(answer);
    tn_desk_free(desk);
}

static bool never(void *context, double done, double total)
{
    (void)context, (void)done, (void)total;
    return false;
}

static void test_what_is_no_question(void **state)
{
    (void)state;
    tn_desk *desk = new_desk();
    tartan_watch watch = tartan_watch_init();
    take(desk, opened("file:///rows.plan", rows, 1));
    assert_error(desk, request("tartan/cuont", about("file:///rows.plan", 1, json_object())), -32601, "count");
    assert_error(desk, request("tartan/runs", about("file:///rows.plan", 1, json_object())), -32601, "terminal");
    assert_error(desk, request("textDocument/hover", json_object()), -32601, "method");
    assert_error(desk, request("tartan/count", about("file:///none.plan", 1, json_object())), -32602, "not open");
    assert_error(desk, request("tartan/count", json_null()), -32602, "not open");
    assert_error(desk, request("tartan/count", about("file:///rows.plan", 1, json_pack("{s:i}", "no", 1))), -32602,
                 "no");
    assert_error(desk, request("tartan/count", about("file:///rows.plan", 1, json_pack("{s:s}", "library", "row"))),
                 -32803, "rows");
    assert_error(desk, request("tartan/stdlib", json_pack("{s:s}", "name", "x")), -32602, "standard library");
    watch.go_on = never;
    json_t *ended = take_watched(
        desk, request("tartan/sample", about("file:///rows.plan", 1, json_pack("{s:i}", "count", 100000))), &watch);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(ended, "error"), "code")), -32800);
    json_decref(ended);
    json_t *names = take(desk, request("tartan/stdlib", json_object()));
    assert_true(json_array_size(json_object_get(json_object_get(names, "result"), "names")) > 10);
    json_decref(names);
    tn_desk_free(desk);
}

/* ---- what goes as bytes */

static const char ball[] = "surface ball = x*x + y*y + z*z - 2\nbox (-2, -2, -2) .. (2, 2, 2)\n";

static json_t *mesh_asked(const char *format, int grid, bool binary)
{
    json_t *params =
        about("file:///ball.field", 1, json_pack("{s:s,s:i,s:b}", "format", format, "grid", grid, "stats", 1));
    json_object_set_new(params, "binary", json_boolean(binary));
    return request("tartan/mesh", params);
}

static void assert_none_waits(tn_desk *desk)
{
    size_t size;
    assert_null(tn_desk_bytes(desk, &size));
}

static const json_t *only_file(const json_t *response)
{
    return json_array_get(json_object_get(json_object_get(json_object_get(response, "result"), "answer"), "files"), 0);
}

static void test_meshes_go_as_bytes(void **state)
{
    (void)state;
    tn_desk *desk = new_desk();
    take(desk, opened("file:///ball.field", ball, 1));
    for (uint32_t number = 1; number <= 2; number++) {
        size_t size;
        json_t *response = take(desk, mesh_asked("glb", 12, true));
        const json_t *result = json_object_get(response, "result"), *file = only_file(response);
        json_int_t vertices = json_integer_value(json_object_get(json_object_get(result, "answer"), "vertices"));
        assert_int_equal(json_integer_value(json_array_get(json_object_get(result, "bytes"), 0)), number);
        assert_string_equal(word(file, "format"), "glb");
        assert_int_equal(json_object_size(file), 1);
        uint8_t *bytes = tn_desk_bytes(desk, &size);
        assert_non_null(bytes);
        assert_int_equal(tn_get_u32(bytes), number);
        assert_int_equal(tn_get_u32(bytes + 4), size - 8);
        assert_memory_equal(bytes + 8, "glTF", 4);
        assert_int_equal(tn_get_u32(bytes + 16), size - 8);
        size_t binary = 8 + 20 + tn_get_u32(bytes + 20);
        assert_int_equal(binary % 4, 0);
        /* places, and two triangles for each vertex but two, of a closed form without a hole */
        assert_int_equal(tn_get_u32(bytes + binary), 12 * vertices + 12 * (2 * vertices - 4));
        free(bytes);
        assert_none_waits(desk);
        json_decref(response);
    }
    tn_desk_free(desk);
}

static void test_bytes_are_asked_for(void **state)
{
    (void)state;
    size_t size;
    tn_desk *desk = new_desk();
    take(desk, opened("file:///ball.field", ball, 1));
    json_t *whole = take(desk, mesh_asked("glb", 12, false));
    assert_none_waits(desk);
    assert_null(json_object_get(json_object_get(whole, "result"), "bytes"));
    size_t written = strlen(word(only_file(whole), "base64"));
    json_decref(take(desk, mesh_asked("glb", 12, true)));
    free(tn_desk_bytes(desk, &size));
    assert_int_equal(written, (size - 8 + 2) / 3 * 4);
    json_t *text = take(desk, mesh_asked("obj", 12, true));
    assert_none_waits(desk);
    assert_non_null(strstr(word(only_file(text), "text"), "v "));
    json_decref(take(desk, mesh_asked("glb", 12, true))); /* nobody takes its bytes */
    json_decref(whole);
    json_decref(text);
    tn_desk_free(desk);
}

static void test_no_bytes_without_an_answer(void **state)
{
    (void)state;
    tn_desk *desk = new_desk();
    tartan_watch watch = tartan_watch_init();
    take(desk, opened("file:///ball.field", ball, 1));
    assert_error(desk, mesh_asked("glb", 1, true), -32602, "grid");
    assert_none_waits(desk);
    watch.go_on = never;
    json_t *ended = take_watched(desk, mesh_asked("glb", 60, true), &watch);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(ended, "error"), "code")), -32800);
    assert_none_waits(desk);
    json_decref(ended);
    assert_error(desk, mesh_asked("glb", 1000, true), -32803, "a page takes 64 MiB at most");
    assert_none_waits(desk);
    tn_desk_free(desk);
}

/* ---- the language server */

/* What it says next of the text. */
static json_t *diagnostics(tn_exchange *exchange, const char *uri)
{
    tn_exchange_work(exchange);
    json_t *found = NULL;
    for (json_t *message; (message = tn_exchange_next(exchange));) {
        const json_t *params = json_object_get(message, "params");
        if (strcmp(word(params, "uri"), uri) == 0) {
            json_decref(found);
            found = json_incref(json_object_get(params, "diagnostics"));
        }
        json_decref(message);
    }
    return found;
}

static tn_exchange *new_exchange(const tn_served *served)
{
    tn_exchange *exchange;
    tn_error error;
    assert_int_equal(tn_exchange_new(served, &exchange, &error), TN_OK);
    return exchange;
}

static void tell(tn_exchange *exchange, json_t *message)
{
    assert_non_null(message);
    tn_exchange_take(exchange, message);
    json_decref(message);
}

static json_t *asked(tn_exchange *exchange, const char *method, json_t *params)
{
    tell(exchange, request(method, params));
    json_t *message = tn_exchange_next(exchange), *result = json_incref(json_object_get(message, "result"));
    json_decref(message);
    assert_non_null(result);
    return result;
}

static json_t *at(const char *uri, int line, int character)
{
    return json_pack("{s:{s:s},s:{s:i,s:i}}", "textDocument", "uri", uri, "position", "line", line, "character",
                     character);
}

static void test_names_lead_into_served_files(void **state)
{
    (void)state;
    tn_exchange *exchange = new_exchange(&folder);
    json_decref(asked(exchange, "initialize", json_pack("{s:s}", "rootUri", "file:///")));
    tell(exchange, opened("file:///rows.plan", rows, 1));
    json_t *found = diagnostics(exchange, "file:///rows.plan");
    assert_int_equal(json_array_size(found), 0);
    json_decref(found);
    json_t *place = asked(exchange, "textDocument/definition", at("file:///rows.plan", 1, 32));
    assert_string_equal(word(place, "uri"), "file:///trays.plan");
    json_decref(place);
    json_t *params = at("file:///rows.plan", 1, 32);
    json_object_set_new(params, "newName", json_string("two-shops"));
    json_t *edit = asked(exchange, "textDocument/rename", params);
    json_t *changes = json_object_get(edit, "changes");
    assert_int_equal(json_object_size(changes), 4); /* where it is said, and the three that use it */
    assert_non_null(json_object_get(changes, "file:///sub/above.plan"));
    json_decref(edit);
    tn_exchange_free(exchange);
}

static void test_the_standard_library_is_built_in(void **state)
{
    (void)state;
    tn_exchange *exchange = new_exchange(&folder);
    json_decref(asked(exchange, "initialize", json_object()));
    tell(exchange, opened("file:///a.plan", "use \"lahave\"\nlibrary l using lahave { trays 1..2 }\n", 1));
    json_t *found = diagnostics(exchange, "file:///a.plan");
    assert_int_equal(json_array_size(found), 0);
    json_decref(found);
    json_t *place = asked(exchange, "textDocument/definition", at("file:///a.plan", 1, 18));
    assert_string_equal(word(place, "uri"), "stdlib:/lahave.plan");
    json_decref(place);
    tn_exchange_free(exchange);
}

static void test_files_that_change_outside(void **state)
{
    (void)state;
    tn_exchange *exchange = new_exchange(&folder);
    const char *before = files[0].text;
    json_decref(asked(exchange, "initialize", json_object()));
    tell(exchange, opened("file:///rows.plan", rows, 1));
    json_decref(diagnostics(exchange, "file:///rows.plan"));
    files[0].text = "schema row { use = shop }\n";
    tell(exchange, json_pack("{s:s,s:{s:[{s:s,s:i}]}}", "method", "workspace/didChangeWatchedFiles", "params",
                             "changes", "uri", "file:///trays.plan", "type", 2));
    json_t *found = diagnostics(exchange, "file:///rows.plan");
    files[0].text = before;
    assert_int_equal(json_array_size(found), 1);
    json_decref(found);
    tn_exchange_free(exchange);
}

/* A review finds what compiling does not, on this very thread. */
static void test_reviews_without_threads(void **state)
{
    (void)state;
    tn_exchange *exchange = new_exchange(&folder);
    json_decref(asked(exchange, "initialize", json_object()));
    tell(exchange,
         opened("file:///a.plan",
                "use \"trays.plan\"\nrule never = pair and not pair\nlibrary l { trays 1..2 prune never }\n", 1));
    json_decref(diagnostics(exchange, "file:///a.plan"));
    tn_review *review = NULL;
    for (int patience; !review && (patience = tn_exchange_patience(exchange)) >= 0;) {
        struct timespec pause = {.tv_nsec = patience * 1000000L};
        nanosleep(&pause, NULL);
        review = tn_exchange_review(exchange);
    }
    assert_non_null(review);
    tn_review_run(review, 60);
    tn_exchange_reviewed(exchange, review);
    json_t *found = diagnostics(exchange, "file:///a.plan");
    assert_true(json_array_size(found) > 0);
    assert_string_equal(word(json_array_get(found, 0), "code"), "W001");
    json_decref(found);
    tn_exchange_free(exchange);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts_what_is_open),          cmocka_unit_test(test_follows_edits),
        cmocka_unit_test(test_paths_end_at_the_folder),      cmocka_unit_test(test_params_and_texts_of_a_request),
        cmocka_unit_test(test_what_is_no_question),          cmocka_unit_test(test_meshes_go_as_bytes),
        cmocka_unit_test(test_bytes_are_asked_for),          cmocka_unit_test(test_no_bytes_without_an_answer),
        cmocka_unit_test(test_names_lead_into_served_files), cmocka_unit_test(test_the_standard_library_is_built_in),
        cmocka_unit_test(test_files_that_change_outside),    cmocka_unit_test(test_reviews_without_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
