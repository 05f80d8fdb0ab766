/* The language server over streams: random edits to rule files, with every question asked anywhere, never crash it,
 * every request has its answer, and what it knows after a thousand edits is what it knows of the same text opened
 * afresh. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "lsp/serve.h"
#include "lsp/workspace.h"
#include "runtime/base/file.h"

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

static const char *const plan_pieces[] = {
    "(",        ")",          "{",          "}",           "[",       "]",      "|",     ",",     "=",
    "\n",       " ",          "\"",         "'",           "12'",     "tray(",  "rule ", "test ", "use \"",
    "library ", "schema ",    "prune ",     "require ",    "zone ",   "role ",  "not ",  "and ",  "or ",
    "x",        "neighbour(", "symmetric ", "quantity(",   "n > 1",   "#",      "\r\n",  "é",     "\xF0\x9F\x8F\xA0",
    "..",       "from ",      "using ",     "allow W002 ", "match [", "drop [", " by ",  "as ",   "-",
    NULL};
static const char *const hemls_pieces[] = {"+",      "-",      "[", "]",    "A",      "Edge0",  "_i+1",
                                           "->",     "\n//",   ";", " ",    "If i<2", "Weight", "3",
                                           "Angle ", "Sync\n", "<", "\r\n", "é",      NULL};
static const char *const study_pieces[] = {"rules ",
                                           "\"square\"",
                                           "1.5 ",
                                           "-3 ",
                                           "attractor at ",
                                           "evolution {",
                                           "}",
                                           "\n",
                                           ";",
                                           "grammar \"words\"\n",
                                           "boundary box from ",
                                           "fitness ",
                                           "#",
                                           "\"",
                                           "(",
                                           ",",
                                           "size ",
                                           "é",
                                           NULL};
static const char *const bnf_pieces[] = {"<a>", "<b> ::= ",   "|",   "{ ", " }", "[ ",    " ]",  "%dialect genr8\n",
                                         "#",   "'",          "\"",  "\n", "\t", "Edge ", "::=", "<",
                                         ">",   "GE_RANGE:3", "\\x", "é",  NULL};

static const struct {
    const char *name; /* of the notation, and of its files */
    const char *const *pieces;
} notations[] = {{"plan", plan_pieces}, {"hemls", hemls_pieces}, {"study", study_pieces}, {"bnf", bnf_pieces}};

static size_t count_pieces(const char *const *pieces)
{
    size_t count = 0;
    while (pieces[count])
        count++;
    return count;
}

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

static char *edit(session *s, const char *uri, char *text, const char *const *pieces, uint32_t *seed)
{
    tn_lines lines;
    size_t begin = random_offset(text, seed), end = begin;
    const char *added = next(seed) % 3 ? pieces[next(seed) % count_pieces(pieces)] : "";
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

static void edit_randomly(const char *name, size_t notation, uint32_t seed, int edits)
{
    char one[100], two[100];
    session s;
    snprintf(one, sizeof one, "file:///nowhere/one.%s", notations[notation].name);
    snprintf(two, sizeof two, "file:///nowhere/two.%s", notations[notation].name);
    start(&s);
    char *text = read_text(name);
    open_document(&s, one, text);
    for (int i = 0; i < edits; i++) {
        text = edit(&s, one, text, notations[notation].pieces, &seed);
        if (next(&seed) % 4 == 0)
            ask_anything(&s, one, text, &seed);
    }
    int outline = ask(&s, "textDocument/documentSymbol", of(one));
    int actions = ask(&s, "textDocument/codeAction", everything(one));
    int layout = ask(&s, "textDocument/formatting", of(one));
    tell(&s, "textDocument/didClose", of(one));
    open_document(&s, two, text);
    int other_outline = ask(&s, "textDocument/documentSymbol", of(two));
    int other_actions = ask(&s, "textDocument/codeAction", everything(two));
    int other_layout = ask(&s, "textDocument/formatting", of(two));
    serve(&s);
    assert_true(json_equal(answer(&s, outline, "result"), answer(&s, other_outline, "result")));
    assert_true(json_equal(answer(&s, layout, "result"), answer(&s, other_layout, "result")));
    assert_int_equal(json_array_size(answer(&s, actions, "result")),
                     json_array_size(answer(&s, other_actions, "result")));
    finish(&s);
    free(text);
}

static void test_random_edits(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 6; seed++) {
        edit_randomly("stdlib/lahave.plan", 0, seed, 300);
        edit_randomly("tests/cli/files/sheds.plan", 0, 100 + seed, 300);
        edit_randomly("tests/diagnostics/many-mistakes.plan", 0, 200 + seed, 200);
        edit_randomly("stdlib/ruffle.hemls", 1, 300 + seed, 300);
        edit_randomly("tests/fuzz/corpus/hemls/mixed", 1, 400 + seed, 200);
        edit_randomly("examples/growing-surfaces/canopy.study", 2, 500 + seed, 300);
        edit_randomly("examples/learning-a-rule/learn.study", 2, 600 + seed, 300);
        edit_randomly("stdlib/genr8-symmetric.bnf", 3, 700 + seed, 300);
        edit_randomly("tests/data/gene/tiny2.bnf", 3, 800 + seed, 300);
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

static bool offers(const json_t *items, const char *label)
{
    size_t i;
    json_t *item;
    json_array_foreach(items, i,
                       item) if (strcmp(json_string_value(json_object_get(item, "label")), label) == 0) return true;
    return false;
}

/* In a rule of a schema that is made from another, words of both are known. */
static void test_schema_made_from_another(void **state)
{
    static const char uri[] = "untitled:newer.plan";
    static const char text[] = "schema old { use = room | store  w = 1m | 2m }\n"
                               "schema new from old { use = ... | lab  glazed = flag }\n"
                               "rule r using new = tray(use lab, room)\n";
    (void)state;
    session s;
    start(&s);
    open_document(&s, uri, text);
    int inside = ask(&s, "textDocument/completion", at(uri, text, (size_t)(strstr(text, "lab, room") - text)));
    int room = ask(&s, "textDocument/definition", at(uri, text, (size_t)(strstr(text, ", room)") + 2 - text)));
    int lab = ask(&s, "textDocument/definition", at(uri, text, (size_t)(strstr(text, "lab, ") - text)));
    int old = ask(&s, "textDocument/definition", at(uri, text, (size_t)(strstr(text, "from old") + 5 - text)));
    serve(&s);
    const json_t *items = answer(&s, inside, "result");
    if (json_is_object(items))
        items = json_object_get(items, "items");
    static const char *const offered[] = {"room", "store", "lab", "w", "glazed"};
    for (size_t i = 0; i < sizeof offered / sizeof *offered; i++)
        assert_true(offers(items, offered[i]));
    const int ids[] = {room, lab, old}, lines[] = {0, 1, 0};
    for (size_t i = 0; i < 3; i++) {
        const json_t *range = json_object_get(answer(&s, ids[i], "result"), "range");
        assert_int_equal(json_integer_value(json_object_get(json_object_get(range, "start"), "line")), lines[i]);
    }
    finish(&s);
}

static void write_file(const char *folder, const char *name, const char *text, bool there)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!there) {
        assert_int_equal(remove(path), 0);
        return;
    }
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static const char base_text[] = "schema s { w = 1m | 2m }\nrule thin = tray(1m)\n";

/* Files that are written, or taken away, for the test below. */
static void set_files(const char *folder, bool there)
{
    char path[200];
    snprintf(path, sizeof path, "%s/sub", folder);
    if (there)
        assert_int_equal(mkdir(path, 0777), 0);
    write_file(folder, "base.plan", base_text, there);
    write_file(folder, "user.plan", "use \"base.plan\"\nrule two = neighbour(thin, thin)\n", there);
    write_file(folder, "sub/deep.plan", "use \"../user.plan\"\nrule three = thin and two\n", there);
    write_file(folder, "other.plan", "schema s { w = 1m | 2m }\nrule thin = tray(2m)\n", there);
    if (!there)
        assert_int_equal(rmdir(path), 0);
}

/* Renames in base.plan, which alone is open; the edits of each file, or why not. `root`: the editor has the folder
 * open. */
static void rename_in(const char *folder, bool root, const char *name, int user, int deep, const char *why)
{
    char uri[200], folder_uri[200], other[200];
    session s = {.input = tmpfile(), .output = tmpfile()};
    snprintf(folder_uri, sizeof folder_uri, "file://%s", folder);
    snprintf(uri, sizeof uri, "%s/base.plan", folder_uri);
    json_t *folders = root ? json_pack("{s:[{s:s,s:s}]}", "workspaceFolders", "uri", folder_uri, "name", "x")
                           : json_pack("{s:n,s:n}", "workspaceFolders", "rootUri");
    ask(&s, "initialize", folders);
    tell(&s, "initialized", json_object());
    open_document(&s, uri, base_text);
    json_t *params = at(uri, base_text, (size_t)(strstr(base_text, "thin") - base_text));
    json_object_set_new(params, "newName", json_string(name));
    int id = ask(&s, "textDocument/rename", params);
    serve(&s);
    const json_t *changes = json_object_get(answer(&s, id, "result"), "changes");
    assert_int_equal(json_array_size(json_object_get(changes, uri)), why ? 0 : 1);
    snprintf(other, sizeof other, "%s/user.plan", folder_uri);
    assert_int_equal(json_array_size(json_object_get(changes, other)), user);
    snprintf(other, sizeof other, "%s/sub/deep.plan", folder_uri);
    assert_int_equal(json_array_size(json_object_get(changes, other)), deep);
    snprintf(other, sizeof other, "%s/other.plan", folder_uri);
    assert_null(json_object_get(changes, other));
    const char *said = json_string_value(json_object_get(answer(&s, id, "error"), "message"));
    assert_true(why ? said && strstr(said, why) : !said);
    finish(&s);
}

/* Files that use the one at hand are found though they are not open; one that only has the name too is left alone. */
static void test_rename_in_files_that_are_not_open(void **state)
{
    (void)state;
    char folder[] = "/tmp/tartan-lsp-XXXXXX";
    assert_non_null(mkdtemp(folder));
    set_files(folder, true);
    rename_in(folder, true, "narrow", 2, 1, NULL);
    rename_in(folder, false, "narrow", 2, 0, NULL); /* what is beside it */
    rename_in(folder, true, "three", 0, 0, "a file that uses this one has something else of this name");
    rename_in(folder, false, "two", 0, 0, "a file that uses this one has something else of this name");
    set_files(folder, false);
    assert_int_equal(rmdir(folder), 0);
}

/* After a header that says nothing useful the next message is found and answered; each is told. */
static void test_wrong_headers(void **state)
{
    (void)state;
    static const char *const headers[] = {
        "Content-Length: -5\r\n\r\n{}",
        "Content-Length: 18446744073709551615\r\n\r\n{\"a\":1}",
        "Content-Length: 12345678901234567890123\r\n\r\n",
        "Content-Length: 9999999999\r\n\r\n",
        "Content-Length:\r\n\r\n",
        "Content-Length: 7x\r\n\r\n",
        "Content-Type: text\r\n\r\n{\"jsonrpc\":\"2.0\"}",
        "\r\n\r\n",
        "nothing of the kind ",
    };
    for (size_t i = 0; i <= sizeof headers / sizeof *headers; i++) {
        session s;
        start(&s);
        if (i < sizeof headers / sizeof *headers)
            fputs(headers[i], s.input);
        for (int n = 0; i == sizeof headers / sizeof *headers && n < 1 << 20; n++)
            fputs("X-Long: ", s.input); /* eight megabytes of one header */
        int known = ask(&s, "textDocument/unknown", json_object());
        serve(&s);
        assert_int_equal(json_integer_value(json_object_get(answer(&s, known, "error"), "code")), -32601);
        finish(&s);
    }
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

/* ---- a live session: the server is a thread, and what it says by itself can be waited for */

typedef struct live {
    session session; /* its input is the pipe to the server */
    FILE *heard;     /* from the server */
    int input;
    FILE *output;
    pthread_t thread;
    tn_status status;
} live;

static void *serve_live(void *context)
{
    live *l = context;
    tn_error error;
    l->status = tn_lsp_serve(l->input, l->output, &error);
    fclose(l->output);
    return NULL;
}

static json_t *hear(live *l)
{
    char header[200];
    assert_non_null(fgets(header, sizeof header, l->heard));
    size_t size = strtoul(strchr(header, ':') + 1, NULL, 10);
    assert_non_null(fgets(header, sizeof header, l->heard));
    char *text = malloc(size + 1);
    assert_int_equal(fread(text, 1, size, l->heard), size);
    json_t *message = json_loadb(text, size, 0, NULL);
    assert_non_null(message);
    free(text);
    return message;
}

/* The answer to a request; what is said in between is passed over. */
static json_t *hear_answer(live *l, int id)
{
    json_t *message;
    fflush(l->session.input);
    while (json_integer_value(json_object_get(message = hear(l), "id")) != id)
        json_decref(message);
    return message;
}

static bool mentions(const json_t *message, const char *text)
{
    char *all = json_dumps(message, JSON_COMPACT);
    bool found = strstr(all, text) != NULL;
    free(all);
    return found;
}

/* Diagnostics of this version, until some say what is wanted. */
static void await_diagnostics(live *l, int version, const char *wanted)
{
    bool found = false;
    fflush(l->session.input);
    while (!found) {
        json_t *message = hear(l), *params = json_object_get(message, "params");
        found = params && json_integer_value(json_object_get(params, "version")) == version && mentions(params, wanted);
        json_decref(message);
    }
}

/* options: the client's initializationOptions. */
static void start_live_with(live *l, json_t *options)
{
    int there[2], back[2];
    *l = (live){0};
    assert_int_equal(pipe(there), 0);
    assert_int_equal(pipe(back), 0);
    l->session.input = fdopen(there[1], "w");
    l->heard = fdopen(back[0], "r");
    l->input = there[0];
    l->output = fdopen(back[1], "w");
    assert_int_equal(pthread_create(&l->thread, NULL, serve_live, l), 0);
    json_t *params = json_pack("{s:o}", "initializationOptions", options);
    json_decref(hear_answer(l, ask(&l->session, "initialize", params)));
    tell(&l->session, "initialized", json_object());
}

static void start_live(live *l)
{
    start_live_with(l, json_null());
}

static void finish_live(live *l)
{
    json_decref(hear_answer(l, ask(&l->session, "shutdown", json_object())));
    tell(&l->session, "exit", json_object());
    fflush(l->session.input);
    pthread_join(l->thread, NULL);
    assert_int_equal(l->status, TN_OK);
    fclose(l->session.input);
    fclose(l->heard);
    close(l->input);
}

/* What is said of a file links its codes to pages so, if the client says that the pages are there. */
static bool links_codes(const char *pages, const char *link)
{
    live l;
    start_live_with(&l, json_pack("{s:s}", "documentation", pages));
    open_document(&l.session, "file:///a.plan", "rule a = b\n");
    fflush(l.session.input);
    json_t *message = hear(&l);
    bool found = mentions(message, link);
    assert_true(mentions(message, "\"code\":\"E"));
    json_decref(message);
    finish_live(&l);
    return found;
}

static void test_codes_have_pages(void **state)
{
    (void)state;
    assert_true(links_codes("https://a.example/tartan", "{\"href\":\"https://a.example/tartan/errors/E0"));
    assert_true(links_codes("file:///usr/share/doc/", "{\"href\":\"file:///usr/share/doc/errors/E0"));
    assert_false(links_codes("", "codeDescription"));
    assert_false(links_codes("command:workbench.action", "codeDescription"));
}

/* Trays that stand for plans are counted while the file is edited, if that is quick; else that is said, and nothing of
 * their values. */
static void test_rows_of_plans(void **state)
{
    static const char quick[] = "schema house { width = 3m | 4m }\n"
                                "measure front using house = sum(width)\n"
                                "library houses using house { trays 1..2 }\n"
                                "schema lots of houses { frontage = measure front }\n"
                                "rule wrong using lots = tray(frontage 5m)\n";
    static const char slow[] = "schema house { width = 3m | 4m  use = a | b }\n"
                               "measure front using house = sum(width of tray(a))\n"
                               "measure rest using house = sum(width of tray(b))\n"
                               "library houses using house { trays 1..400 }\n"
                               "schema lots of houses { frontage = measure front  rest = measure rest }\n"
                               "rule wrong using lots = tray(frontage 5m)\n";
    live l;
    (void)state;
    start_live(&l);
    open_document(&l.session, "file:///quick.plan", quick);
    await_diagnostics(&l, 1, "it can be 3m, 4m, 6m, 7m or 8m");
    open_document(&l.session, "file:///slow.plan", slow);
    fflush(l.session.input);
    json_t *message = hear(&l);
    while (!mentions(message, "slow.plan")) {
        json_decref(message);
        message = hear(&l);
    }
    assert_true(mentions(message, "the plans are not counted here"));
    assert_false(mentions(message, "E0303"));
    json_decref(message);
    finish_live(&l);
}

static const char related[] =
    "use \"lahave\"\nrule wide = tray(12') or tray(8')\nrule one = tray(12')\n"
    "rule never allow W019 = tray(12') and not tray(12')\nrule first = neighbour(beginning, tray(4'))\n"
    "library l using lahave { trays 1..3 require first total <= 36' prune one, wide }\n"
    "measure long \"of all\" = sum(width)\nmeasure twice = 2 * long\n";

static const char housed[] = "schema s { w role length = 8' | 12'  zone z role band = room(9') role void }\n"
                             "form f of s {\n"
                             "  storey low 9'  spine z  wall 8\"  partition 4\"  floor 10\"  roof 8\"\n"
                             "  function sleep \"one rests\" at cell(z, low)\n"
                             "  opening door wide 2'8\" high 6'8\" passage\n"
                             "  face cell(sleep) outside = door | wall\n"
                             "  tile bed for sleep { against wall or door  item bed left 0..3', back 0..6' }\n"
                             "}\n"
                             "library rows using s { trays 1..2 }\n"
                             "library huts from rows in f { require room(sleep, by door) }\n"
                             "test huts { keep [8' room:9' ; 1 flat ; sleep ; door wall wall wall ; bed.back] }\n";

static json_t *ask_at(live *l, const char *method, const char *uri, const char *before, size_t further)
{
    return hear_answer(l,
                       ask(&l->session, method, at(uri, housed, (size_t)(strstr(housed, before) - housed) + further)));
}

/* How many places a rename changes; the new name is free. */
static size_t renamed(live *l, const char *uri, const char *before, size_t further)
{
    json_t *params = at(uri, housed, (size_t)(strstr(housed, before) - housed) + further);
    json_object_set_new(params, "newName", json_string("another"));
    json_t *edit = hear_answer(l, ask(&l->session, "textDocument/rename", params));
    size_t count = json_array_size(json_object_get(json_object_get(json_object_get(edit, "result"), "changes"), uri));
    if (!count)
        count = json_array_size(json_object_get(json_object_get(edit, "changes"), uri));
    json_decref(edit);
    return count;
}

/* What a form declares is known wherever it is named, in the lines of houses too. */
static void test_forms(void **state)
{
    static const char uri[] = "file:///nowhere/huts.plan";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, housed);
    json_t *answer = ask_at(&l, "textDocument/hover", uri, "room(sleep", 6);
    assert_true(mentions(answer, " at cell(z, low)"));
    assert_true(mentions(answer, "function `sleep` of form `f`"));
    json_decref(answer);
    answer = ask_at(&l, "textDocument/hover", uri, "bed.back", 1);
    assert_true(mentions(answer, "against wall or door") && mentions(answer, "tile `bed` of form `f`"));
    json_decref(answer);
    answer = ask_at(&l, "textDocument/completion", uri, "cell(sleep)", 5);
    assert_true(mentions(answer, "sleep") && mentions(answer, "low") && mentions(answer, "void"));
    json_decref(answer);
    answer = ask_at(&l, "textDocument/completion", uri, "cell(z, low)", 5); /* has no function yet */
    assert_true(mentions(answer, "low") && !mentions(answer, "\"sleep\"") && !mentions(answer, "\"void\""));
    json_decref(answer);
    answer = ask_at(&l, "textDocument/completion", uri, "= door | wall", 2);
    assert_true(mentions(answer, "door") && mentions(answer, "party"));
    json_decref(answer);
    answer = ask_at(&l, "textDocument/completion", uri, "in f {", 3);
    assert_true(mentions(answer, "\"f\""));
    json_decref(answer);
    answer = hear_answer(&l, ask(&l.session, "textDocument/documentSymbol", everything(uri)));
    assert_true(mentions(answer, "one rests") && mentions(answer, "\"bed\"") && mentions(answer, "\"low\""));
    json_decref(answer);
    assert_int_equal(renamed(&l, uri, "function sleep", 10), 5);
    assert_int_equal(renamed(&l, uri, "opening door", 9), 5);
    assert_int_equal(renamed(&l, uri, "tile bed", 6), 2);
    assert_int_equal(renamed(&l, uri, "storey low", 8), 2);
    finish_live(&l);
}

/* In `option(`: the form's choices, then what each chooses among. */
static void test_sections(void **state)
{
    static const char uri[] = "file:///nowhere/sections.plan";
    static const char text[] = "schema s { w role length = 8'  zone z role band = room(9') role void }\n"
                               "form f of s { storey low 9' storey high 8' wall 8\" partition 4\" floor 10\" roof 8\"\n"
                               "  option z storeys = 1 | 2  option z roof = gable(9:12) | vault(4')\n"
                               "  option cladding = board | brick  function sleep at cell(z) }\n"
                               "rule r = option(z roof vault) and option(cladding brick)\n";
    const struct {
        const char *before, *offered, *not_offered;
    } cases[] = {
        {"z roof vault", "cladding", "vault"},
        {"roof vault)", "storeys", "cladding"},
        {"vault) and", "gable", "brick"},
        {"brick)", "board", "gable"},
    };
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        json_t *params = at(uri, text, (size_t)(strstr(text, cases[i].before) - text));
        json_t *answer = hear_answer(&l, ask(&l.session, "textDocument/completion", params));
        assert_true(mentions(answer, cases[i].offered));
        assert_false(mentions(answer, cases[i].not_offered));
        json_decref(answer);
    }
    finish_live(&l);
}

/* In a study of evolution: its one statement, and in the block settings with what their values are. */
static void test_settings(void **state)
{
    static const char uri[] = "file:///nowhere/never.study";
    static const char text[] = "evolution {\n  population 20\n  initialise ramped\n}\n";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, text);
    json_t *answer = hear_answer(
        &l, ask(&l.session, "textDocument/completion", at(uri, text, (size_t)(strstr(text, "initialise") - text))));
    assert_true(mentions(answer, "a whole number") && mentions(answer, "`random|ramped|grow|pi-grow`"));
    assert_false(mentions(answer, "repeller"));
    json_decref(answer);
    answer = hear_answer(
        &l, ask(&l.session, "textDocument/hover", at(uri, text, (size_t)(strstr(text, "population") - text))));
    assert_true(mentions(answer, "`population`: a whole number"));
    json_decref(answer);
    answer = hear_answer(
        &l, ask(&l.session, "textDocument/completion", at(uri, text, (size_t)(strstr(text, "evolution {") - text))));
    assert_true(mentions(answer, "how forms are bred") && !mentions(answer, "\"population\""));
    json_decref(answer);
    finish_live(&l);
}

/* What a form says for nothing is warned of, and can be allowed there. */
static void test_form_allows(void **state)
{
    static const char uri[] = "file:///nowhere/never.plan";
    char text[sizeof housed + 100];
    const char *rest = strstr(housed, "  opening door");
    (void)state;
    live l;
    start_live(&l);
    snprintf(text, sizeof text, "%.*s  function never at cell(z, low, 8', 12')\n%s", (int)(rest - housed), housed,
             rest);
    open_document(&l.session, uri, text);
    await_diagnostics(&l, 1, "W202");
    json_t *actions = hear_answer(&l, ask(&l.session, "textDocument/codeAction", everything(uri)));
    assert_true(mentions(actions, "Allow W202 in f") && mentions(actions, "  allow W202\\n"));
    json_decref(actions);
    finish_live(&l);
}

static const char placed[] =
    "schema s { w role length = 8' | 12'  zone z role band = room(9') | hall(14')\n"
    "  zone b role band = nook(4') role void }\n"
    "form f of s {\n"
    "  storey low 9'  storey high 8'  spine z  wall 8\"  partition 4\"  floor 10\"  roof 8\"\n"
    "  option z storeys = 1 | 2  option b storeys = 1  option z roof = flat | gable(9:12)\n"
    "  option cladding = board | brick\n"
    "  forbid option(z storeys 2) and option(z roof gable)\n"
    "  void cell(z hall, high)\n"
    "  function sleep at cell(z room)  function sit at cell(z)  function niche at cell(b nook)\n"
    "  opening door wide 2'8\" high 6'8\" passage  opening gate wide 8' high 7'6\" passage\n"
    "  flight dogleg wide 2' rise 6\"..8\" going 9\" turn half\n"
    "  face cell(sit) outside = gate | door | wall\n"
    "  face cell(sit) under cell(sit) = dogleg | floor\n"
    "  tile bed for sleep { wide 5'..11'  item bed left 0..3', back 0..6'  keep way right 2'..right 0, back 0..6' }\n"
    "  tile pool for niche { item pool left 0..5', back 0..5' }\n"
    "  tile pole for niche { item pole left 0..1', back 0..1', up 0..9' }\n"
    "}\n"
    "rule tall = option(z storeys 2) and option(cladding brick)\n";

static json_t *ask_placed(live *l, const char *method, const char *uri, const char *before, size_t further)
{
    return hear_answer(l,
                       ask(&l->session, method, at(uri, placed, (size_t)(strstr(placed, before) - placed) + further)));
}

/* What a form's declarations come to, over all trays and sections. */
static void test_places(void **state)
{
    static const char uri[] = "file:///nowhere/placed.plan";
    static const struct {
        const char *before;
        size_t further;
        const char *said[4];
    } cases[] = {
        {"form f of", 5, {"4 trays of `s` have 12 cells", "6 combinations of options; 2 more are forbidden"}},
        {"storey high",
         8,
         {"it has 4 of 12 cells", "z: 4 cells, 2 of them open to the cell below, in 2 of 6 combinations of options"}},
        {"z storeys = 1", 3, {"choice `z storeys` of form `f`", "- `1`: in 4 of 6 combinations of options", "- `2`: in 2 of 6"}},
        {"cladding brick", 1, {"choice `cladding` of form `f`", "- `brick`: in 3 of 6 combinations of options"}},
        {"function sit",
         10,
         {"it may be in 6 of 12 cells", "z, low: 4 of 4 cells, 8' to 12' wide and 9' to 14' deep, 72 ft2 to 168 ft2",
          "z, high: 2 of 4 cells, 8' to 12' wide and 9' deep, 72 ft2 to 108 ft2",
          "other functions there: `sleep`; in 2 of these cells no other may be"}},
        {"function niche",
         10,
         {"b, low: 4 of 4 cells", "no other function may be there",
          "none of its tiles fits with walls round it in cells of 8' by 4', 12' by 4'"}},
        {"tile bed",
         6,
         {"clear rooms 5' to 11' wide and at least 6' deep", "z, low: cells of 8' by 9', 12' by 9'; ",
          "; its back at any side; up to 8 layouts", "z, high: cells of 8' by 9'"}},
        {"tile pool",
         6,
         {"clear rooms at least 5' wide and at least 5' deep",
          "it fits nowhere; in the largest cell for it, b, low, 12' by 4': `pool` is not inside"}},
        {"tile pole", 6, {"`pole` reaches higher than the room, which is 8'2\\\" high"}},
        {"opening door",
         9,
         {"needs a face at least 3'4\\\" wide and 6'8\\\" high: storey `low`, `high`",
          "may be in outside walls, storey `low`, `high`: `sit`"}},
        {"opening gate", 9, {"needs a face at least 8'8\\\" wide and 7'6\\\" high: storey `low`\\n"}},
        {"flight dogleg",
         8,
         {"has room in z, low: cells of 8' by 14', 12' by 9', 12' by 14'",
          "may be in floors between cells, storey `low`: `sit`"}},
    };
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, placed);
    await_diagnostics(&l, 1, "W204");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        json_t *answer = ask_placed(&l, "textDocument/hover", uri, cases[i].before, cases[i].further);
        for (size_t k = 0; k < 4 && cases[i].said[k]; k++)
            assert_true(mentions(answer, cases[i].said[k]));
        json_decref(answer);
    }
    finish_live(&l);
}

/* Choices of sections: where they are named, and which may be renamed. */
static void test_choices(void **state)
{
    static const char uri[] = "file:///nowhere/placed.plan";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, placed);
    json_t *answer = ask_placed(&l, "textDocument/definition", uri, "storeys 2) and option(c", 1);
    assert_true(mentions(answer, "\"line\":4"));
    json_decref(answer);
    answer = hear_answer(&l, ask(&l.session, "textDocument/documentSymbol", everything(uri)));
    assert_true(mentions(answer, "\"z roof\"") && mentions(answer, "\"cladding\""));
    json_decref(answer);
    json_t *params = at(uri, placed, (size_t)(strstr(placed, "cladding brick") - placed));
    json_object_set_new(params, "newName", json_string("facade"));
    answer = hear_answer(&l, ask(&l.session, "textDocument/rename", params));
    assert_int_equal(
        json_array_size(json_object_get(json_object_get(json_object_get(answer, "result"), "changes"), uri)), 2);
    json_decref(answer);
    params = at(uri, placed, (size_t)(strstr(placed, "storeys = 1") - placed));
    json_object_set_new(params, "newName", json_string("floors"));
    answer = hear_answer(&l, ask(&l.session, "textDocument/rename", params));
    assert_true(mentions(answer, "a choice that a zone has keeps its name"));
    json_decref(answer);
    answer = ask_placed(&l, "textDocument/prepareRename", uri, "storeys = 1", 0);
    assert_true(json_is_null(json_object_get(answer, "result")));
    json_decref(answer);
    finish_live(&l);
}

static const char lots[] = "schema row { width = 2m | 3m  use = hall | room }\n"
                           "param lot \"how wide the lot is\" = 12m in 9m..20m\n"
                           "param side = left | right\n"
                           "param use-of = hall | room\n"
                           "rule wide = sum(width) > lot or sum(width, w > lot) or tray(use-of)\n"
                           "rule ends = side = right implies neighbour(beginning, tray(hall))\n"
                           "test wide with lot = 9m, side = left { match [3m] }\n";

static json_t *ask_lots(live *l, const char *method, const char *uri, const char *before, size_t further)
{
    return hear_answer(l, ask(&l->session, method, at(uri, lots, (size_t)(strstr(lots, before) - lots) + further)));
}

/* Params: what they are, where they are named, and what may stand beside them. */
static void test_params(void **state)
{
    static const char uri[] = "file:///nowhere/lots.plan";
    static const struct {
        const char *before;
        size_t further;
        const char *line; /* of its definition, from 0 */
    } uses[] = {{"> lot or", 2, "\"line\":1"},
                {"tray(use-of", 5, "\"line\":3"},
                {"side = right", 0, "\"line\":2"},
                {"with lot", 5, "\"line\":1"},
                {"side = left {", 0, "\"line\":2"}};
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, lots);
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        json_t *answer = ask_lots(&l, "textDocument/definition", uri, uses[i].before, uses[i].further);
        assert_true(mentions(answer, uses[i].line));
        json_decref(answer);
    }
    json_t *answer = ask_lots(&l, "textDocument/hover", uri, "> lot or", 2);
    assert_true(mentions(answer, "param lot") && mentions(answer, "12m in 9m..20m") &&
                mentions(answer, "how wide the lot is") && mentions(answer, "param `lot`"));
    json_decref(answer);
    answer = ask_lots(&l, "textDocument/completion", uri, "> lot or", 2);
    assert_true(mentions(answer, "\"lot\"") && mentions(answer, "\"side\""));
    json_decref(answer);
    answer = ask_lots(&l, "textDocument/completion", uri, "right implies", 0);
    assert_true(mentions(answer, "\"left\"") && mentions(answer, "\"right\""));
    json_decref(answer);
    answer = ask_lots(&l, "textDocument/completion", uri, "side = left {", 7);
    assert_true(mentions(answer, "\"left\"") && mentions(answer, "\"right\"") && !mentions(answer, "\"hall\""));
    json_decref(answer);
    answer = ask_lots(&l, "textDocument/completion", uri, "lot = 9m", 0);
    assert_true(mentions(answer, "\"lot\"") && mentions(answer, "\"use-of\""));
    json_decref(answer);
    json_t *params = at(uri, lots, (size_t)(strstr(lots, "lot \"") - lots));
    json_object_set_new(params, "newName", json_string("plot"));
    answer = hear_answer(&l, ask(&l.session, "textDocument/rename", params));
    assert_int_equal(
        json_array_size(json_object_get(json_object_get(json_object_get(answer, "result"), "changes"), uri)), 4);
    json_decref(answer);
    answer = hear_answer(&l, ask(&l.session, "textDocument/documentSymbol", everything(uri)));
    assert_true(mentions(answer, "\"use-of\""));
    json_decref(answer);
    finish_live(&l);
}

/* A library that is projected: where its schema and the other library are, and which schemas may stand there. */
static void test_projected(void **state)
{
    static const char uri[] = "file:///nowhere/onto.plan";
    static const char text[] = "schema row { width = 3m | 4m }\n"
                               "schema zoned-row from row { zone bay = open(1m) | none }\n"
                               "schema shed { depth = 2m }\n"
                               "library zoned using zoned-row { trays 1..3 }\n"
                               "library bare from zoned onto row { prune tray(4m) }\n";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, text);
    size_t onto = (size_t)(strstr(text, "onto row") - text);
    json_t *answer = hear_answer(&l, ask(&l.session, "textDocument/definition", at(uri, text, onto + 5)));
    assert_true(mentions(answer, "\"line\":0"));
    json_decref(answer);
    answer = hear_answer(&l, ask(&l.session, "textDocument/hover", at(uri, text, onto)));
    assert_true(mentions(answer, "without their newer fields"));
    json_decref(answer);
    answer = hear_answer(&l, ask(&l.session, "textDocument/completion", at(uri, text, onto + 5)));
    assert_true(mentions(answer, "\"row\"") && !mentions(answer, "\"shed\"") && !mentions(answer, "\"zoned-row\""));
    json_decref(answer);
    json_t *params = at(uri, text, onto + 5);
    json_object_set_new(params, "newName", json_string("bays"));
    answer = hear_answer(&l, ask(&l.session, "textDocument/rename", params));
    assert_int_equal(
        json_array_size(json_object_get(json_object_get(json_object_get(answer, "result"), "changes"), uri)), 3);
    json_decref(answer);
    finish_live(&l);
}

/* Also of a form in a file that is used. */
static void test_places_of_used(void **state)
{
    static const char uri[] = "file:///nowhere/used.plan";
    static const char text[] = "use \"lahave-form\"\nrule never = tray(12') and not tray(12')\n"
                               "rule seldom = room(bath, area < 40sf)\n";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, text);
    await_diagnostics(&l, 1, "W001");
    json_t *answer =
        hear_answer(&l, ask(&l.session, "textDocument/hover", at(uri, text, (size_t)(strstr(text, "bath") - text))));
    assert_true(mentions(answer, "machine, ground: 384 of 480 cells, 8' to 12' wide and 4' to 8' deep"));
    json_decref(answer);
    finish_live(&l);
}

static void test_meaning(void **state)
{
    static const char uri[] = "file:///nowhere/a.plan";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, related);
    await_diagnostics(&l, 1, "W001");
    json_t *hovered = hear_answer(
        &l, ask(&l.session, "textDocument/hover", at(uri, related, (size_t)(strstr(related, "wide") - related))));
    assert_true(mentions(hovered, "subsumes (matches all that they match): `one`"));
    assert_true(mentions(hovered, "plans of `l`"));
    json_decref(hovered);
    hovered = hear_answer(
        &l, ask(&l.session, "textDocument/hover", at(uri, related, (size_t)(strstr(related, "first") - related))));
    assert_true(mentions(hovered, "required in `l`: keeps out 299,013,696 plans of its lengths, 0 of them alone"));
    json_decref(hovered);
    hovered = hear_answer(
        &l, ask(&l.session, "textDocument/hover", at(uri, related, (size_t)(strstr(related, "l using") - related))));
    assert_true(mentions(hovered, "`total` keeps out 0 plans of its lengths, 0 of them alone"));
    assert_true(mentions(hovered, "by trays: 1: ") && mentions(hovered, "`long`: 4 ft to 12 ft, "));
    json_decref(hovered);
    hovered = hear_answer(
        &l, ask(&l.session, "textDocument/hover", at(uri, related, (size_t)(strstr(related, "* long") + 2 - related))));
    assert_true(mentions(hovered, "measure `long`") && mentions(hovered, "over `l`: 4 ft to 12 ft, ") &&
                mentions(hovered, " on average (standard deviation "));
    json_decref(hovered);
    json_t *actions = hear_answer(&l, ask(&l.session, "textDocument/codeAction", everything(uri)));
    assert_true(mentions(actions, "Allow W001 in never"));
    assert_true(mentions(actions, "Allow W003 in one"));
    json_decref(actions);
    tell(&l.session, "textDocument/didChange",
         json_pack("{s:{s:s,s:i},s:[{s:s}]}", "textDocument", "uri", uri, "version", 2, "contentChanges", "text",
                   "use \"lahave\"\nrule all = any or not any\nrule same = any\n"));
    await_diagnostics(&l, 2, "W002");
    finish_live(&l);
}

/* ---- rules as pictures */

static const char drawn[] = "use \"lahave\"\n\nrule r =\n  neighbour(tray(4', great), any)\n";

/* The actions of that kind at a place of `drawn`. */
static json_t *actions_at(live *l, const char *uri, const char *before, const char *only)
{
    tn_lines lines;
    size_t offset = (size_t)(strstr(drawn, before) - drawn);
    assert_true(tn_lines_make(&lines, drawn, strlen(drawn)));
    json_t *context = json_pack("{s:[]}", "diagnostics");
    if (only)
        json_object_set_new(context, "only", json_pack("[s]", only));
    json_t *params = json_pack("{s:{s:s},s:o,s:o}", "textDocument", "uri", uri, "range",
                               tn_lines_range(&lines, offset, offset), "context", context);
    tn_lines_clear(&lines);
    return hear_answer(l, ask(&l->session, "textDocument/codeAction", params));
}

/* The action of that title, of those in an answer. */
static const json_t *titled(const json_t *answer, const char *title)
{
    const json_t *list = json_object_get(answer, "result"), *action;
    size_t i;
    json_array_foreach(list, i, action) if (strcmp(json_string_value(json_object_get(action, "title")), title) ==
                                            0) return action;
    return NULL;
}

/* Without `resolve`, actions have their edits where they are asked for by kind, and are not offered otherwise. */
static void test_rule_actions(void **state)
{
    static const char uri[] = "untitled:1";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, drawn);
    json_t *answer = actions_at(&l, uri, "great", "refactor");
    assert_true(mentions(answer, "Put `not` around `tray(4', great)`") && mentions(answer, "Leave `great` out") &&
                mentions(answer, "Ask for `not great` instead of `great`"));
    assert_true(mentions(titled(answer, "Put `symmetric` around `tray(4', great)`"), "\"newText\":\"symmetric \""));
    json_decref(answer);
    answer = actions_at(&l, uri, "4'", "refactor.rewrite");
    assert_true(mentions(titled(answer, "Ask for `8'` instead of `4'`"), "\"newText\":\"8\""));
    json_decref(answer);
    answer = actions_at(&l, uri, "neighbour", "refactor");
    assert_true(mentions(answer, "Leave `any` of `neighbour`"));
    json_decref(answer);
    answer = actions_at(&l, uri, "great", "quickfix");
    assert_int_equal(json_array_size(json_object_get(answer, "result")), 0);
    json_decref(answer);
    answer = actions_at(&l, uri, "great", NULL);
    assert_int_equal(json_array_size(json_object_get(answer, "result")), 0);
    json_decref(answer);
    finish_live(&l);
}

static void test_rule_actions_later(void **state)
{
    static const char uri[] = "untitled:1";
    (void)state;
    live l;
    start_live(&l);
    json_decref(hear_answer(&l, ask(&l.session, "initialize",
                                    json_pack("{s:{s:{s:{s:{s:[s]}}}}}", "capabilities", "textDocument", "codeAction",
                                              "resolveSupport", "properties", "edit"))));
    open_document(&l.session, uri, drawn);
    json_t *offered = actions_at(&l, uri, "great", NULL);
    json_t *action = json_deep_copy(titled(offered, "Leave `great` out"));
    assert_non_null(action);
    assert_null(json_object_get(action, "edit"));
    json_decref(offered);
    json_t *resolved = hear_answer(&l, ask(&l.session, "codeAction/resolve", json_deep_copy(action)));
    assert_true(mentions(resolved, "\"edit\"") && mentions(resolved, "\"newText\":\"\""));
    json_decref(resolved);
    json_object_set_new(json_object_get(action, "data"), "item", json_integer(9));
    resolved = hear_answer(&l, ask(&l.session, "codeAction/resolve", json_deep_copy(action)));
    assert_true(mentions(resolved, "-32803") && mentions(resolved, "the tray has 2 items"));
    json_decref(resolved);
    json_object_set_new(json_object_get(action, "data"), "version", json_integer(7));
    resolved = hear_answer(&l, ask(&l.session, "codeAction/resolve", action));
    assert_true(mentions(resolved, "-32801"));
    json_decref(resolved);
    finish_live(&l);
}

/* What is at work is given up: by an edit, by closing, by the end. */
static void test_meaning_given_up(void **state)
{
    static const char uri[] = "untitled:1", other[] = "untitled:2";
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, uri, related);
    for (int version = 2; version < 40; version++) {
        tell(&l.session, "textDocument/didChange",
             json_pack("{s:{s:s,s:i},s:[{s:s}]}", "textDocument", "uri", uri, "version", version, "contentChanges",
                       "text", related));
        if (version % 4 == 0)
            await_diagnostics(&l, version, "[]");
        if (version % 10 == 0)
            await_diagnostics(&l, version, "W001");
        if (version == 33) {
            open_document(&l.session, other, related);
            await_diagnostics(&l, 1, "W001");
            tell(&l.session, "textDocument/didClose", of(other));
        }
    }
    finish_live(&l);
}

/* A grammar's own warnings come so too. */
static void test_meaning_of_grammar(void **state)
{
    (void)state;
    live l;
    start_live(&l);
    open_document(&l.session, "file:///nowhere/a.bnf", "<a> ::= <a><a> | <a><a> | x\n");
    await_diagnostics(&l, 1, "W15");
    finish_live(&l);
}

/* "name kind detail(children);" */
static void show_outline(const json_t *list, char *shown, size_t size)
{
    size_t i;
    json_t *item;
    json_array_foreach(list, i, item)
    {
        const char *detail = json_string_value(json_object_get(item, "detail"));
        const json_t *children = json_object_get(item, "children");
        size_t used = strlen(shown);
        snprintf(shown + used, size - used, "%s %d%s%s%s", json_string_value(json_object_get(item, "name")),
                 (int)json_integer_value(json_object_get(item, "kind")), detail ? " " : "", detail ? detail : "",
                 children ? "(" : "");
        if (children)
            show_outline(children, shown, size);
        strcat(shown, children ? ");" : ";");
    }
}

static void test_outlines(void **state)
{
    static const char *const cases[][3] = {
        {"file:///nowhere/a.hemls", "A + B + A\nA -> A\n -> B\nAngle 90", "A + B + A 14;A 12 -> A;Angle 7 90;"},
        {"file:///nowhere/a.study", "rules \"square\" fitness size target 3\nevolution { grammar \"words\"; seed 3",
         "rules 7 \"square\";fitness size 7 target 3;evolution 2(grammar 7 \"words\";seed 7 3;);"},
        {"file:///nowhere/a.bnf", "%wraps 2 # c\n<a> ::= x | <b>\n\n<b> ::= y", "%wraps 2 7;<a> 12;<b> 12;"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char shown[500] = "";
        session s;
        start(&s);
        open_document(&s, cases[i][0], cases[i][1]);
        int id = ask(&s, "textDocument/documentSymbol", of(cases[i][0]));
        serve(&s);
        show_outline(answer(&s, id, "result"), shown, sizeof shown);
        assert_string_equal(shown, cases[i][2]);
        finish(&s);
    }
}

/* What a text without a file is, the editor says. */
static void test_language_of_untitled(void **state)
{
    (void)state;
    session s;
    start(&s);
    tell(&s, "textDocument/didOpen",
         json_pack("{s:{s:s,s:s,s:i,s:s}}", "textDocument", "uri", "untitled:1", "languageId", "hemls", "version", 1,
                   "text", "A+B+A"));
    int id = ask(&s, "textDocument/formatting", of("untitled:1"));
    serve(&s);
    json_t *edit = json_array_get(answer(&s, id, "result"), 0);
    assert_string_equal(json_string_value(json_object_get(edit, "newText")), "A + B + A\n");
    finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_edits),
        cmocka_unit_test(test_positions_are_utf16),
        cmocka_unit_test(test_rename_across_documents),
        cmocka_unit_test(test_schema_made_from_another),
        cmocka_unit_test(test_rename_in_files_that_are_not_open),
        cmocka_unit_test(test_codes_have_pages),
                                       cmocka_unit_test(test_rows_of_plans),
        cmocka_unit_test(test_wrong_headers),
        cmocka_unit_test(test_wrong_messages),
        cmocka_unit_test(test_meaning),
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_sections),
        cmocka_unit_test(test_settings),
        cmocka_unit_test(test_form_allows),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_choices),
        cmocka_unit_test(test_params),
        cmocka_unit_test(test_projected),
        cmocka_unit_test(test_places_of_used),
        cmocka_unit_test(test_rule_actions),
        cmocka_unit_test(test_rule_actions_later),
        cmocka_unit_test(test_meaning_given_up),
        cmocka_unit_test(test_meaning_of_grammar),
        cmocka_unit_test(test_outlines),
        cmocka_unit_test(test_language_of_untitled),
    };
    setenv("TARTAN_PATH", TARTAN_SOURCE_DIR "/stdlib", 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
