/* The language server over streams: random edits to rule files, with every question asked anywhere, never crash it,
 * every request has its answer, and what it knows after a thousand edits is what it knows of the same text opened
 * afresh. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "lsp/lines.h"
#include "lsp/lsp.h"
#include "runtime/vm/file.h"

/* ---- a session: messages are written to a file, then served */

typedef struct session {
    FILE *input, *output;
    int requests;
    json_t *answers; /* by id */
} session;

static void send_text(session *s, const char *text)
{
    fprintf(s->input, "Content-Length: %zu\r\n\r\n%s", strlen(text), text);
}

static void send_json(session *s, json_t *message)
{
    assert_non_null(message);
    char *text = json_dumps(message, JSON_COMPACT);
    send_text(s, text);
    free(text);
    json_decref(message);
}

static void tell(session *s, const char *method, json_t *params)
{
    send_json(s, json_pack("{s:s,s:s,s:o}", "jsonrpc", "2.0", "method", method, "params", params));
}

/* The id of the request. */
static int ask(session *s, const char *method, json_t *params)
{
    int id = ++s->requests;
    send_json(s, json_pack("{s:s,s:i,s:s,s:o}", "jsonrpc", "2.0", "id", id, "method", method, "params", params));
    return id;
}

static void start(session *s)
{
    *s = (session){.input = tmpfile(), .output = tmpfile()};
    assert_non_null(s->input);
    assert_non_null(s->output);
    ask(s, "initialize", json_object());
    tell(s, "initialized", json_object());
}

static void open_document(session *s, const char *uri, const char *text)
{
    tell(s, "textDocument/didOpen",
         json_pack("{s:{s:s,s:s,s:i,s:s}}", "textDocument", "uri", uri, "languageId", "plan", "version", 1, "text",
                   text));
}

static void read_answers(session *s)
{
    char header[200];
    rewind(s->output);
    s->answers = json_object();
    while (fgets(header, sizeof header, s->output)) {
        size_t size = strtoul(strchr(header, ':') + 1, NULL, 10);
        assert_non_null(fgets(header, sizeof header, s->output));
        char *text = malloc(size + 1);
        assert_int_equal(fread(text, 1, size, s->output), size);
        json_t *message = json_loadb(text, size, 0, NULL);
        assert_non_null(message);
        const json_t *id = json_object_get(message, "id");
        if (json_is_integer(id)) {
            char key[24];
            snprintf(key, sizeof key, "%d", (int)json_integer_value(id));
            assert_null(json_object_get(s->answers, key));
            json_object_set(s->answers, key, message);
        }
        json_decref(message);
        free(text);
    }
}

static json_t *answer(session *s, int id, const char *part)
{
    char key[24];
    snprintf(key, sizeof key, "%d", id);
    json_t *message = json_object_get(s->answers, key);
    assert_non_null(message);
    return json_object_get(message, part);
}

static void serve(session *s)
{
    tn_error error;
    ask(s, "shutdown", json_object());
    tell(s, "exit", json_object());
    fflush(s->input);
    lseek(fileno(s->input), 0, SEEK_SET);
    assert_int_equal(tn_lsp_serve(fileno(s->input), s->output, &error), TN_OK);
    read_answers(s);
    assert_int_equal(json_object_size(s->answers), s->requests);
}

static void finish(session *s)
{
    json_decref(s->answers);
    fclose(s->input);
    fclose(s->output);
}

static json_t *at(const char *uri, const char *text, size_t offset)
{
    tn_lines lines;
    assert_true(tn_lines_make(&lines, text, strlen(text)));
    json_t *params =
        json_pack("{s:{s:s},s:o}", "textDocument", "uri", uri, "position", tn_lines_position(&lines, offset));
    tn_lines_clear(&lines);
    return params;
}

static json_t *of(const char *uri)
{
    return json_pack("{s:{s:s}}", "textDocument", "uri", uri);
}

/* ---- random edits */

static uint32_t next(uint32_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

static const char *const pieces[] = {
    "(",        ")",          "{",          "}",           "[",       "]",      "|",     ",",     "=",
    "\n",       " ",          "\"",         "'",           "12'",     "tray(",  "rule ", "test ", "use \"",
    "library ", "schema ",    "prune ",     "require ",    "zone ",   "role ",  "not ",  "and ",  "or ",
    "x",        "neighbour(", "symmetric ", "quantity(",   "n > 1",   "#",      "\r\n",  "é",     "\xF0\x9F\x8F\xA0",
    "..",       "from ",      "using ",     "allow W002 ", "match [", "drop [", " by ",  "as ",   "-"};

/* A place between characters. */
static size_t random_offset(const char *text, uint32_t *seed)
{
    size_t offset = next(seed) % (strlen(text) + 1);
    while (offset > 0 && ((unsigned char)text[offset] & 0xC0) == 0x80)
        offset--;
    return offset;
}

static char *edited(const char *text, size_t begin, size_t end, const char *added)
{
    char *result = malloc(strlen(text) - (end - begin) + strlen(added) + 1);
    memcpy(result, text, begin);
    strcpy(result + begin, added);
    strcat(result, text + end);
    return result;
}

static char *edit(session *s, const char *uri, char *text, uint32_t *seed)
{
    tn_lines lines;
    size_t begin = random_offset(text, seed), end = begin;
    const char *added = next(seed) % 3 ? pieces[next(seed) % (sizeof pieces / sizeof *pieces)] : "";
    if (next(seed) % 2)
        for (end += next(seed) % 12; end > strlen(text) || ((unsigned char)text[end] & 0xC0) == 0x80;)
            end--;
    if (end < begin)
        end = begin;
    assert_true(tn_lines_make(&lines, text, strlen(text)));
    /* between \r and \n is no place of the protocol */
    bool split = (begin > 0 && text[begin - 1] == '\r' && text[begin] == '\n') ||
                 (end > 0 && text[end - 1] == '\r' && text[end] == '\n');
    json_t *range = tn_lines_range(&lines, begin, end);
    tn_lines_clear(&lines);
    if (split) {
        json_decref(range);
        return text;
    }
    tell(s, "textDocument/didChange",
         json_pack("{s:{s:s,s:i},s:[{s:o,s:s}]}", "textDocument", "uri", uri, "version", 2, "contentChanges", "range",
                   range, "text", added));
    char *result = edited(text, begin, end, added);
    free(text);
    return result;
}

static void ask_anything(session *s, const char *uri, const char *text, uint32_t *seed)
{
    static const char *const methods[] = {"textDocument/hover", "textDocument/definition", "textDocument/completion",
                                          "textDocument/documentHighlight", "textDocument/prepareRename"};
    size_t offset = random_offset(text, seed);
    switch (next(seed) % 5) {
    case 0: {
        json_t *params = at(uri, text, offset);
        json_object_set_new(params, "newName", json_string(next(seed) % 2 ? "fresh" : "rule"));
        ask(s, "textDocument/rename", params);
        break;
    }
    case 1: {
        json_t *params = at(uri, text, offset);
        json_object_set_new(params, "context", json_pack("{s:b}", "includeDeclaration", 1));
        ask(s, "textDocument/references", params);
        break;
    }
    case 2:
        ask(s, next(seed) % 2 ? "textDocument/formatting" : "textDocument/documentSymbol", of(uri));
        break;
    default:
        ask(s, methods[next(seed) % (sizeof methods / sizeof *methods)], at(uri, text, offset));
    }
}

static json_t *everything(const char *uri)
{
    return json_pack("{s:{s:s},s:{s:{s:i,s:i},s:{s:i,s:i}}}", "textDocument", "uri", uri, "range", "start", "line", 0,
                     "character", 0, "end", "line", 1000000, "character", 0);
}

static char *read_text(const char *name)
{
    char path[4096];
    uint8_t *bytes;
    size_t size;
    tn_error error;
    snprintf(path, sizeof path, "%s/%s", TARTAN_SOURCE_DIR, name);
    assert_int_equal(tn_file_read(path, 1 << 20, &bytes, &size, &error), TN_OK);
    return (char *)bytes;
}

static void edit_randomly(const char *name, uint32_t seed, int edits)
{
    static const char one[] = "file:///nowhere/one.plan", two[] = "file:///nowhere/two.plan";
    session s;
    start(&s);
    char *text = read_text(name);
    open_document(&s, one, text);
    for (int i = 0; i < edits; i++) {
        text = edit(&s, one, text, &seed);
        if (next(&seed) % 4 == 0)
            ask_anything(&s, one, text, &seed);
    }
    int outline = ask(&s, "textDocument/documentSymbol", of(one));
    int actions = ask(&s, "textDocument/codeAction", everything(one));
    tell(&s, "textDocument/didClose", of(one));
    open_document(&s, two, text);
    int other_outline = ask(&s, "textDocument/documentSymbol", of(two));
    int other_actions = ask(&s, "textDocument/codeAction", everything(two));
    serve(&s);
    assert_true(json_equal(answer(&s, outline, "result"), answer(&s, other_outline, "result")));
    assert_int_equal(json_array_size(answer(&s, actions, "result")),
                     json_array_size(answer(&s, other_actions, "result")));
    finish(&s);
    free(text);
}

static void test_random_edits(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 6; seed++) {
        edit_randomly("stdlib/lahave.plan", seed, 300);
        edit_randomly("tests/cli/files/sheds.plan", 100 + seed, 300);
        edit_randomly("tests/diagnostics/many-mistakes.plan", 200 + seed, 200);
    }
}

/* ---- what is said */

static const char rules[] = "use \"lahave\"\nrule \xC3\xA9nd \"\xF0\x9F\x8F\xA0\" = tray(4') and narrow-pair\n"
                            "rule other = \xC3\xA9nd or tray(duoble)\n";

static void test_positions_are_utf16(void **state)
{
    static const char uri[] = "file:///nowhere/a.plan";
    (void)state;
    session s;
    start(&s);
    open_document(&s, uri, rules);
    int id = ask(&s, "textDocument/definition", at(uri, rules, (size_t)(strstr(rules, "narrow-pair") - rules)));
    int highlight =
        ask(&s, "textDocument/documentHighlight", at(uri, rules, (size_t)(strstr(rules, "or tray") - rules - 2)));
    int actions = ask(&s, "textDocument/codeAction", everything(uri));
    serve(&s);
    const char *target = json_string_value(json_object_get(answer(&s, id, "result"), "uri"));
    assert_non_null(target);
    assert_non_null(strstr(target, "/lahave.plan"));
    assert_int_equal(json_array_size(answer(&s, highlight, "result")), 2);
    json_t *first = json_array_get(answer(&s, actions, "result"), 0);
    assert_string_equal(json_string_value(json_object_get(first, "title")), "Replace with double");
    json_t *edits = json_object_get(json_object_get(json_object_get(first, "edit"), "changes"), uri);
    json_t *range = json_object_get(json_array_get(edits, 0), "range");
    json_t *wanted =
        json_pack("{s:{s:i,s:i},s:{s:i,s:i}}", "start", "line", 2, "character", 25, "end", "line", 2, "character", 31);
    assert_true(json_equal(range, wanted));
    json_decref(wanted);
    finish(&s);
}

/* A name used in two documents that are open, and not saved anywhere, is renamed in both. */
static void test_rename_across_documents(void **state)
{
    char folder[] = "/tmp/tartan-lsp-XXXXXX", base_uri[100], user_uri[100], path[100];
    static const char base[] = "use \"lahave\"\nrule low = tray(single)\n";
    static const char user[] = "use \"base.plan\"\nrule both = low and tray(4')\n";
    (void)state;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/base.plan", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("rule stale = any\n", file);
    fclose(file);
    snprintf(base_uri, sizeof base_uri, "file://%s/base.plan", folder);
    snprintf(user_uri, sizeof user_uri, "file://%s/user.plan", folder);
    session s;
    start(&s);
    open_document(&s, base_uri, base);
    open_document(&s, user_uri, user);
    json_t *params = at(user_uri, user, (size_t)(strstr(user, "low") - user));
    json_object_set_new(params, "newName", json_string("lower"));
    int id = ask(&s, "textDocument/rename", params);
    serve(&s);
    json_t *changes = json_object_get(answer(&s, id, "result"), "changes");
    assert_int_equal(json_object_size(changes), 2);
    assert_int_equal(json_array_size(json_object_get(changes, base_uri)), 1);
    assert_int_equal(json_array_size(json_object_get(changes, user_uri)), 1);
    finish(&s);
    unlink(path);
    rmdir(folder);
}

static void test_wrong_messages(void **state)
{
    (void)state;
    session s;
    start(&s);
    send_text(&s, "{\"jsonrpc\":");
    send_text(&s, "[]");
    send_text(&s, "{\"id\":{},\"method\":7}");
    fputs("Content-Length: x\r\n\r\n", s.input);
    fputs("X: 1\r\n\r\n", s.input);
    int unknown = ask(&s, "textDocument/unknown", json_object());
    int not_open = ask(&s, "textDocument/hover", at("file:///not/open.plan", "", 0));
    int no_params = ask(&s, "textDocument/rename", json_null());
    tell(&s, "textDocument/didOpen", json_array());
    tell(&s, "textDocument/didChange", json_pack("{s:i}", "textDocument", 3));
    tell(&s, "$/anything", json_object());
    open_document(&s, "untitled:1", "rule a = any");
    tell(&s, "textDocument/didChange",
         json_pack("{s:{s:s},s:[{s:i}]}", "textDocument", "uri", "untitled:1", "contentChanges", "text", 5));
    json_t *params = at("untitled:1", "", 0);
    json_object_set_new(json_object_get(params, "position"), "line", json_integer(-1));
    int no_place = ask(&s, "textDocument/hover", params);
    serve(&s);
    assert_int_equal(json_integer_value(json_object_get(answer(&s, unknown, "error"), "code")), -32601);
    assert_non_null(answer(&s, not_open, "error"));
    assert_non_null(answer(&s, no_params, "error"));
    assert_non_null(answer(&s, no_place, "error"));
    finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_edits),
        cmocka_unit_test(test_positions_are_utf16),
        cmocka_unit_test(test_rename_across_documents),
        cmocka_unit_test(test_wrong_messages),
    };
    setenv("TARTAN_PATH", TARTAN_SOURCE_DIR "/stdlib", 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
