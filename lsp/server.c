/* The server's loop: messages in, answers out. */
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#include "lsp/background.h"
#include "lsp/features.h"
#include "lsp/lsp.h"
#include "lsp/wire.h"

/* Error codes of JSON-RPC and of the protocol. */
enum {
    LOG_ERROR = 1, /* a MessageType */
    PARSE_ERROR = -32700,
    INVALID_REQUEST = -32600,
    METHOD_NOT_FOUND = -32601,
    INVALID_PARAMS = -32602,
    INTERNAL_ERROR = -32603,
    NOT_INITIALIZED = -32002,
    REQUEST_FAILED = -32803,
};

enum {
    PAUSE = 200,        /* milliseconds without an edit, after which rules are looked at in the background */
    BACKGROUND = 60000, /* milliseconds after which that is given up */
};

typedef struct server {
    tn_wire wire;
    tn_workspace workspace;
    tn_background *background; /* at work, or NULL */
    tn_document *subject;      /* what it is about; NULL where it was cancelled */
    int wake;                  /* the event by which it says that it is done */
    int64_t time;              /* when to begin, or, while one is at work, to give up; in milliseconds */
    bool initialized, shut_down, exiting;
    int error;          /* of the request at hand; 0: none */
    const char *reason; /* what to say about it */
} server;

static json_t *fail(server *s, int code, const char *reason)
{
    s->error = code;
    s->reason = reason;
    return NULL;
}

/* ---- looking at rules in the background */

static int64_t now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (int64_t)time.tv_sec * 1000 + time.tv_nsec / 1000000;
}

/* A text has changed: what is found out about the old one is of no use, and nobody wants to wait for it. */
static void cancel_background(server *s)
{
    if (s->background)
        tn_background_cancel(s->background);
    s->subject = NULL;
    s->time = now() + PAUSE;
}

/* ---- what is asked about */

typedef struct question {
    tn_document *document;
    tn_file_analysis *analysis;
    size_t offset;
} question;

static const char *uri_of(const json_t *params)
{
    return json_string_value(json_object_get(json_object_get(params, "textDocument"), "uri"));
}

static bool find_document(server *s, const json_t *params, question *asked)
{
    const char *uri = uri_of(params);
    asked->document = uri ? tn_workspace_find(&s->workspace, uri) : NULL;
    asked->analysis = asked->document ? tn_workspace_analyse(&s->workspace, asked->document) : NULL;
    if (!asked->document)
        fail(s, INVALID_PARAMS, "the document is not open");
    else if (!asked->analysis)
        fail(s, INTERNAL_ERROR, "out of memory");
    return asked->analysis != NULL;
}

static bool find_place(server *s, const json_t *params, question *asked)
{
    if (!find_document(s, params, asked))
        return false;
    const tn_lines *lines = tn_analysis_lines(asked->analysis, 0);
    if (!lines || !tn_lines_read(lines, json_object_get(params, "position"), &asked->offset)) {
        fail(s, INVALID_PARAMS, "there is no such position");
        return false;
    }
    return true;
}

/* ---- requests */

typedef json_t *answer(server *s, const json_t *params);

/* The folders that the editor has open, as new editors say it or as old ones did. */
static bool take_roots(server *s, const json_t *params)
{
    const json_t *folders = json_object_get(params, "workspaceFolders"), *folder;
    const char *root = json_string_value(json_object_get(params, "rootUri"));
    size_t i;
    bool good = true;
    if (!json_is_array(folders))
        return !root || tn_workspace_add_root(&s->workspace, root);
    json_array_foreach(folders, i, folder)
    {
        const char *uri = json_string_value(json_object_get(folder, "uri"));
        good = good && (!uri || tn_workspace_add_root(&s->workspace, uri));
    }
    return good;
}

static json_t *initialize(server *s, const json_t *params)
{
    if (!s->initialized && !take_roots(s, params))
        return NULL;
    s->initialized = true;
    return json_pack("{s:{s:{s:b,s:i},s:b,s:{s:[s,s,s,s]},s:b,s:b,s:b,s:{s:b},s:b,s:b,s:{s:[s]}},s:{s:s,s:s}}",
                     "capabilities", "textDocumentSync", "openClose", 1, "change", 2, "hoverProvider", 1,
                     "completionProvider", "triggerCharacters", "(", "[", " ", "\"", "definitionProvider", 1,
                     "referencesProvider", 1, "documentHighlightProvider", 1, "renameProvider", "prepareProvider", 1,
                     "documentSymbolProvider", 1, "documentFormattingProvider", 1, "codeActionProvider",
                     "codeActionKinds", "quickfix", "serverInfo", "name", "tartan", "version", TARTAN_VERSION);
}

static json_t *shut_down(server *s, const json_t *params)
{
    (void)params;
    s->shut_down = true;
    cancel_background(s);
    return json_null();
}

static json_t *hover(server *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_hover(a.document, a.analysis, a.offset) : NULL;
}

static json_t *definition(server *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_definition(a.document, a.analysis, a.offset) : NULL;
}

static json_t *references(server *s, const json_t *params)
{
    question a;
    bool declaration = json_is_true(json_object_get(json_object_get(params, "context"), "includeDeclaration"));
    return find_place(s, params, &a) ? tn_lsp_references(&s->workspace, a.document, a.analysis, a.offset, declaration)
                                     : NULL;
}

static json_t *highlight(server *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_highlight(a.document, a.analysis, a.offset) : NULL;
}

static json_t *prepare_rename(server *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_prepare_rename(&s->workspace, a.document, a.analysis, a.offset) : NULL;
}

static json_t *rename_symbol(server *s, const json_t *params)
{
    question a;
    const char *name = json_string_value(json_object_get(params, "newName")), *reason;
    if (!name)
        return fail(s, INVALID_PARAMS, "the new name is missing");
    if (!find_place(s, params, &a))
        return NULL;
    json_t *edit = tn_lsp_rename(&s->workspace, a.document, a.analysis, a.offset, name, &reason);
    return reason ? fail(s, REQUEST_FAILED, reason) : edit;
}

static json_t *completion(server *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_completion(&s->workspace, a.document, a.analysis, a.offset) : NULL;
}

static json_t *outline(server *s, const json_t *params)
{
    question a;
    return find_document(s, params, &a) ? tn_lsp_outline(a.document, a.analysis) : NULL;
}

static json_t *formatting(server *s, const json_t *params)
{
    question a;
    if (!find_document(s, params, &a))
        return NULL;
    return tn_lsp_format(a.document);
}

static json_t *actions(server *s, const json_t *params)
{
    question a;
    const json_t *range = json_object_get(params, "range");
    size_t begin, end;
    if (!find_document(s, params, &a))
        return NULL;
    const tn_lines *lines = tn_analysis_lines(a.analysis, 0);
    if (!lines || !tn_lines_read(lines, json_object_get(range, "start"), &begin) ||
        !tn_lines_read(lines, json_object_get(range, "end"), &end))
        return fail(s, INVALID_PARAMS, "there is no such range");
    return tn_lsp_actions(a.document, a.analysis, begin, end);
}

static const struct {
    const char *method;
    answer *answer;
} requests[] = {
    {"initialize", initialize},
    {"shutdown", shut_down},
    {"textDocument/hover", hover},
    {"textDocument/definition", definition},
    {"textDocument/references", references},
    {"textDocument/documentHighlight", highlight},
    {"textDocument/prepareRename", prepare_rename},
    {"textDocument/rename", rename_symbol},
    {"textDocument/completion", completion},
    {"textDocument/documentSymbol", outline},
    {"textDocument/formatting", formatting},
    {"textDocument/codeAction", actions},
};

static void respond(server *s, const json_t *id, json_t *result)
{
    if (!result && !s->error)
        fail(s, INTERNAL_ERROR, "out of memory");
    json_t *answered = s->error ? json_pack("{s:s,s:O,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", id, "error", "code",
                                            s->error, "message", s->reason)
                                : json_pack("{s:s,s:O,s:o}", "jsonrpc", "2.0", "id", id, "result", result);
    tn_wire_send(&s->wire, answered);
}

static void take_request(server *s, const json_t *id, const char *method, const json_t *params)
{
    json_t *result = NULL;
    s->error = 0;
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        if (strcmp(requests[i].method, method) != 0)
            continue;
        if (!s->initialized && requests[i].answer != initialize)
            fail(s, NOT_INITIALIZED, "the server is not initialized");
        else if (s->shut_down)
            fail(s, INVALID_REQUEST, "the server is shutting down");
        else
            result = requests[i].answer(s, params);
        respond(s, id, result);
        return;
    }
    fail(s, METHOD_NOT_FOUND, "there is no such method");
    respond(s, id, NULL);
}

/* ---- notifications */

static void did_open(server *s, const json_t *params)
{
    const json_t *document = json_object_get(params, "textDocument");
    const char *uri = uri_of(params), *text = json_string_value(json_object_get(document, "text"));
    const char *language = json_string_value(json_object_get(document, "languageId"));
    if (!uri || !text)
        return;
    cancel_background(s);
    if (!tn_workspace_put(&s->workspace, uri, language, text, json_integer_value(json_object_get(document, "version"))))
        s->wire.failed = true;
}

static void did_change(server *s, const json_t *params)
{
    const char *uri = uri_of(params);
    tn_document *document = uri ? tn_workspace_find(&s->workspace, uri) : NULL;
    json_int_t version = json_integer_value(json_object_get(json_object_get(params, "textDocument"), "version"));
    if (!document)
        return;
    cancel_background(s);
    tn_workspace_change(&s->workspace, document, json_object_get(params, "contentChanges"), version);
}

static void notify(server *s, const char *method, json_t *params)
{
    tn_wire_send(&s->wire, json_pack("{s:s,s:s,s:o}", "jsonrpc", "2.0", "method", method, "params", params));
}

static void did_close(server *s, const json_t *params)
{
    const char *uri = uri_of(params);
    if (!uri || !tn_workspace_find(&s->workspace, uri))
        return;
    cancel_background(s);
    notify(s, "textDocument/publishDiagnostics", json_pack("{s:s,s:[]}", "uri", uri, "diagnostics"));
    tn_workspace_remove(&s->workspace, uri);
}

static void take_notification(server *s, const char *method, const json_t *params)
{
    if (strcmp(method, "exit") == 0)
        s->exiting = true;
    else if (!s->initialized || s->shut_down)
        return;
    else if (strcmp(method, "textDocument/didOpen") == 0)
        did_open(s, params);
    else if (strcmp(method, "textDocument/didChange") == 0)
        did_change(s, params);
    else if (strcmp(method, "textDocument/didClose") == 0)
        did_close(s, params);
}

/* ---- the loop */

static void publish(server *s)
{
    for (tn_document *document = s->workspace.documents; document; document = document->next) {
        if (!document->dirty)
            continue;
        tn_file_analysis *analysis = tn_workspace_analyse(&s->workspace, document);
        document->dirty = false;
        if (!analysis)
            continue;
        notify(s, "textDocument/publishDiagnostics", tn_lsp_diagnostics(document, analysis));
    }
}

static bool is_due(const tn_document *document)
{
    return document->due && document->analysis && document->analysis->compilation.module;
}

static tn_document *find_due(const server *s)
{
    tn_document *document = s->workspace.documents;
    while (document && !is_due(document))
        document = document->next;
    return document;
}

/* How long to wait at most for a message; -1: for ever. */
static int patience(const server *s)
{
    if (!s->background && !find_due(s))
        return -1;
    int64_t left = s->time - now();
    return left < 0 ? 0 : (int)left;
}

/* It is time to begin with the next document, or to give up the one at work. */
static void time_is_up(server *s)
{
    tn_document *document = find_due(s);
    if (s->background && s->subject) {
        s->subject->due = false;
        cancel_background(s);
    }
    if (s->background || !document) {
        s->time = now() + PAUSE; /* one that was cancelled is about to end */
        return;
    }
    s->subject = document;
    s->time = now() + BACKGROUND;
    s->background = tn_background_start(&s->workspace, document, s->wake);
    document->due = s->background != NULL;
}

/* Takes over what was found, if that one at work has come to its end. */
static void take_background(server *s)
{
    tn_document *document = s->subject;
    tn_file_analysis *analysis;
    tn_facts *facts;
    uint64_t count;
    (void)!read(s->wake, &count, sizeof count);
    if (!s->background || !tn_background_ended(s->background))
        return;
    tn_background_finish(s->background, &analysis, &facts);
    s->background = NULL;
    s->subject = NULL;
    if (document && analysis) {
        tn_analysis_free(document->analysis);
        tn_facts_free(document->facts);
        document->analysis = analysis;
        document->facts = facts;
        document->dirty = true;
        s->time = now();
    } else {
        tn_analysis_free(analysis);
        tn_facts_free(facts);
    }
    if (document)
        document->due = false;
}

static void take(server *s, const json_t *message)
{
    const json_t *id = json_object_get(message, "id");
    const char *method = json_string_value(json_object_get(message, "method"));
    const json_t *params = json_object_get(message, "params");
    if (method && id)
        take_request(s, id, method, params);
    else if (method)
        take_notification(s, method, params);
}

static void take_message(server *s)
{
    json_t *message;
    tn_wire_result result = tn_wire_read(&s->wire, &message);
    if (result == TN_WIRE_END) {
        s->exiting = true;
    } else if (result == TN_WIRE_MESSAGE) {
        take(s, message);
        json_decref(message);
    } else {
        json_t *null = json_null();
        fail(s, PARSE_ERROR, s->wire.problem);
        respond(s, null, NULL);
        notify(s, "window/logMessage", json_pack("{s:i,s:s}", "type", LOG_ERROR, "message", s->wire.problem));
    }
}

static void loop(server *s)
{
    while (!s->exiting && !s->wire.failed) {
        tn_wire_event event = tn_wire_wait(&s->wire, s->wake, 0);
        if (event != TN_WIRE_INPUT) {
            publish(s);
            event = tn_wire_wait(&s->wire, s->wake, patience(s));
        }
        if (event == TN_WIRE_INPUT)
            take_message(s);
        else if (event == TN_WIRE_WOKEN)
            take_background(s);
        else
            time_is_up(s);
    }
}

static void end_background(server *s)
{
    tn_file_analysis *analysis = NULL;
    tn_facts *facts = NULL;
    if (!s->background)
        return;
    tn_background_cancel(s->background);
    tn_background_finish(s->background, &analysis, &facts);
}

tn_status tn_lsp_serve(int input, FILE *output, tn_error *error)
{
    server s = {.wire = {.input = input, .output = output}, .wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    tn_status status = s.wake >= 0 ? tn_workspace_open(&s.workspace, error) : tn_fail_memory(error);
    if (status == TN_OK)
        loop(&s);
    if (status == TN_OK && s.wire.failed)
        status = ferror(output) ? tn_fail(error, TN_IO, E_CANNOT_WRITE, "the client does not read what it is sent")
                                : tn_fail_memory(error);
    else if (status == TN_OK && !s.shut_down)
        status = tn_fail(error, TN_INVALID, TN_CODE_NONE, "the client went away without `shutdown`");
    end_background(&s);
    tn_workspace_clear(&s.workspace);
    tn_wire_clear(&s.wire);
    if (s.wake >= 0)
        close(s.wake);
    return status;
}
