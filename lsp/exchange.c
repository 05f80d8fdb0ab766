/* Messages in, answers out. */
#include "lsp/exchange.h"

#include <stdlib.h>
#include <string.h>

#include "lsp/features.h"
#include "runtime/base/watch.h"

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
    CONTENT_MODIFIED = -32801,
};

#define PAUSE 0.2 /* seconds without an edit, after which rules are looked at */

struct tn_exchange {
    tn_workspace workspace;
    json_t *sent; /* an array: what the client has not taken yet, from `next` on */
    size_t next;
    tn_review *review;    /* at work, or NULL */
    tn_document *subject; /* what it is about; NULL where it was cancelled */
    double time;          /* when the next review may begin (tn_seconds) */
    bool initialized, shut_down, ended, failed;
    bool resolves;      /* the client asks for the edits of actions when they are chosen */
    char *pages;        /* where the documentation's pages are, for links of codes; or NULL */
    int error;          /* of the request at hand; 0: none */
    const char *reason; /* what to say about it */
    char why[400];      /* a reason that was made for one request */
};

/* Says it to the client; NULL (out of memory) is a failure. */
static void say(tn_exchange *s, json_t *message)
{
    if (!message || json_array_append_new(s->sent, message) != 0)
        s->failed = true;
}

static json_t *fail(tn_exchange *s, int code, const char *reason)
{
    s->error = code;
    s->reason = reason;
    return NULL;
}

/* ---- looking at rules */

/* A text has changed: what is found out about the old one is of no use, and nobody wants to wait for it. */
static void cancel_review(tn_exchange *s)
{
    tn_exchange_cancel(s);
    s->time = tn_seconds() + PAUSE;
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

static bool find_document(tn_exchange *s, const json_t *params, question *asked)
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

static bool find_place(tn_exchange *s, const json_t *params, question *asked)
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

typedef json_t *answer(tn_exchange *s, const json_t *params);

/* The folders that the editor has open, as new editors say it or as old ones did. */
static bool take_roots(tn_exchange *s, const json_t *params)
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

/* Does the client say that it asks for the edit of an action later? */
static bool takes_edits_later(const json_t *params)
{
    const json_t *text = json_object_get(json_object_get(params, "capabilities"), "textDocument");
    const json_t *support = json_object_get(json_object_get(text, "codeAction"), "resolveSupport");
    const json_t *properties = json_object_get(support, "properties"), *property;
    size_t i;
    json_array_foreach(properties, i, property)
    {
        const char *name = json_string_value(property);
        if (name && strcmp(name, "edit") == 0)
            return true;
    }
    return false;
}

/* The address of the documentation's pages that the client names, or NULL; only one that a browser opens. */
static const char *pages_of(const json_t *params)
{
    const char *pages =
        json_string_value(json_object_get(json_object_get(params, "initializationOptions"), "documentation"));
    bool opens = pages && (strncmp(pages, "https://", 8) == 0 || strncmp(pages, "http://", 7) == 0 ||
                           strncmp(pages, "file:///", 8) == 0);
    return opens ? pages : NULL;
}

static bool take_pages(tn_exchange *s, const json_t *params)
{
    const char *pages = pages_of(params);
    s->pages = pages ? strdup(pages) : NULL;
    return !pages || s->pages;
}

static json_t *initialize(tn_exchange *s, const json_t *params)
{
    if (!s->initialized && (!take_roots(s, params) || !take_pages(s, params)))
        return NULL;
    s->initialized = true;
    s->resolves = takes_edits_later(params);
    return json_pack("{s:{s:{s:b,s:i},s:b,s:{s:[s,s,s,s]},s:b,s:b,s:b,s:{s:b},s:b,s:b,s:{s:[s,s],s:b}},s:{s:s,s:s}}",
                     "capabilities", "textDocumentSync", "openClose", 1, "change", 2, "hoverProvider", 1,
                     "completionProvider", "triggerCharacters", "(", "[", " ", "\"", "definitionProvider", 1,
                     "referencesProvider", 1, "documentHighlightProvider", 1, "renameProvider", "prepareProvider", 1,
                     "documentSymbolProvider", 1, "documentFormattingProvider", 1, "codeActionProvider",
                     "codeActionKinds", "quickfix", "refactor.rewrite", "resolveProvider", 1, "serverInfo", "name",
                     "tartan", "version", TARTAN_VERSION);
}

static json_t *shut_down(tn_exchange *s, const json_t *params)
{
    (void)params;
    s->shut_down = true;
    cancel_review(s);
    return json_null();
}

static json_t *hover(tn_exchange *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_hover(a.document, a.analysis, a.offset) : NULL;
}

static json_t *definition(tn_exchange *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_definition(a.document, a.analysis, a.offset) : NULL;
}

static json_t *references(tn_exchange *s, const json_t *params)
{
    question a;
    bool declaration = json_is_true(json_object_get(json_object_get(params, "context"), "includeDeclaration"));
    return find_place(s, params, &a) ? tn_lsp_references(&s->workspace, a.document, a.analysis, a.offset, declaration)
                                     : NULL;
}

static json_t *highlight(tn_exchange *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_highlight(a.document, a.analysis, a.offset) : NULL;
}

static json_t *prepare_rename(tn_exchange *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_prepare_rename(&s->workspace, a.document, a.analysis, a.offset) : NULL;
}

static json_t *rename_symbol(tn_exchange *s, const json_t *params)
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

static json_t *completion(tn_exchange *s, const json_t *params)
{
    question a;
    return find_place(s, params, &a) ? tn_lsp_completion(&s->workspace, a.document, a.analysis, a.offset) : NULL;
}

static json_t *outline(tn_exchange *s, const json_t *params)
{
    question a;
    return find_document(s, params, &a) ? tn_lsp_outline(a.document, a.analysis) : NULL;
}

static json_t *formatting(tn_exchange *s, const json_t *params)
{
    question a;
    if (!find_document(s, params, &a))
        return NULL;
    return tn_lsp_format(a.document);
}

/* Does the client want actions of this kind? It names kinds, or those that they begin with, or none. */
static bool is_wanted(const json_t *params, const char *kind)
{
    const json_t *only = json_object_get(json_object_get(params, "context"), "only"), *one;
    size_t i;
    json_array_foreach(only, i, one)
    {
        const char *name = json_string_value(one);
        size_t size = name ? strlen(name) : 0;
        if (name && strncmp(name, kind, size) == 0 && (kind[size] == '.' || kind[size] == '\0' || size == 0))
            return true;
    }
    return json_array_size(only) == 0;
}

/* What would be worked out for each movement of the cursor is only so where the client does not ask for it later, and
 * somebody has marked something or wants such actions alone. */
static json_t *actions(tn_exchange *s, const json_t *params)
{
    question a;
    const json_t *range = json_object_get(params, "range");
    bool some = json_array_size(json_object_get(json_object_get(params, "context"), "only")) > 0;
    size_t begin, end;
    if (!find_document(s, params, &a))
        return NULL;
    const tn_lines *lines = tn_analysis_lines(a.analysis, 0);
    if (!lines || !tn_lines_read(lines, json_object_get(range, "start"), &begin) ||
        !tn_lines_read(lines, json_object_get(range, "end"), &end))
        return fail(s, INVALID_PARAMS, "there is no such range");
    json_t *list = json_array();
    if (is_wanted(params, "quickfix"))
        tn_lsp_fixes(a.document, a.analysis, begin, end, list);
    bool offered = s->resolves || some || end > begin;
    if (list && offered && is_wanted(params, "refactor.rewrite") &&
        !tn_lsp_rule_actions(a.document, a.analysis, begin, end, !s->resolves, list)) {
        json_decref(list);
        return NULL;
    }
    return list;
}

static json_t *resolve_action(tn_exchange *s, const json_t *params)
{
    tn_document *document = tn_lsp_action_document(&s->workspace, params);
    if (!document)
        return fail(s, CONTENT_MODIFIED, "the text has changed since this was offered");
    tn_file_analysis *analysis = tn_workspace_analyse(&s->workspace, document);
    json_t *resolved = analysis ? tn_lsp_resolve(document, analysis, params, s->why) : NULL;
    return resolved || !*s->why ? resolved : fail(s, REQUEST_FAILED, s->why);
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
    {"codeAction/resolve", resolve_action},
};

static void respond(tn_exchange *s, const json_t *id, json_t *result)
{
    if (!result && !s->error)
        fail(s, INTERNAL_ERROR, "out of memory");
    json_t *answered = s->error ? json_pack("{s:s,s:O,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", id, "error", "code",
                                            s->error, "message", s->reason)
                                : json_pack("{s:s,s:O,s:o}", "jsonrpc", "2.0", "id", id, "result", result);
    say(s, answered);
}

static void take_request(tn_exchange *s, const json_t *id, const char *method, const json_t *params)
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

static void did_open(tn_exchange *s, const json_t *params)
{
    const json_t *document = json_object_get(params, "textDocument");
    const char *uri = uri_of(params), *text = json_string_value(json_object_get(document, "text"));
    const char *language = json_string_value(json_object_get(document, "languageId"));
    if (!uri || !text)
        return;
    cancel_review(s);
    if (!tn_workspace_put(&s->workspace, uri, language, text, json_integer_value(json_object_get(document, "version"))))
        s->failed = true;
}

static void did_change(tn_exchange *s, const json_t *params)
{
    const char *uri = uri_of(params);
    tn_document *document = uri ? tn_workspace_find(&s->workspace, uri) : NULL;
    json_int_t version = json_integer_value(json_object_get(json_object_get(params, "textDocument"), "version"));
    if (!document)
        return;
    cancel_review(s);
    tn_workspace_change(&s->workspace, document, json_object_get(params, "contentChanges"), version);
}

static void notify(tn_exchange *s, const char *method, json_t *params)
{
    say(s, json_pack("{s:s,s:s,s:o}", "jsonrpc", "2.0", "method", method, "params", params));
}

static void did_close(tn_exchange *s, const json_t *params)
{
    const char *uri = uri_of(params);
    if (!uri || !tn_workspace_find(&s->workspace, uri))
        return;
    cancel_review(s);
    notify(s, "textDocument/publishDiagnostics", json_pack("{s:s,s:[]}", "uri", uri, "diagnostics"));
    tn_workspace_remove(&s->workspace, uri);
}

/* Of files that are not open. */
static void did_change_files(tn_exchange *s, const json_t *params)
{
    size_t i;
    const json_t *change;
    json_array_foreach(json_object_get(params, "changes"), i, change)
    {
        const char *uri = json_string_value(json_object_get(change, "uri"));
        if (!uri || tn_workspace_find(&s->workspace, uri))
            continue;
        cancel_review(s);
        tn_workspace_file_changed(&s->workspace, uri);
    }
}

static void take_notification(tn_exchange *s, const char *method, const json_t *params)
{
    if (strcmp(method, "exit") == 0)
        s->ended = true;
    else if (!s->initialized || s->shut_down)
        return;
    else if (strcmp(method, "textDocument/didOpen") == 0)
        did_open(s, params);
    else if (strcmp(method, "textDocument/didChange") == 0)
        did_change(s, params);
    else if (strcmp(method, "textDocument/didClose") == 0)
        did_close(s, params);
    else if (strcmp(method, "workspace/didChangeWatchedFiles") == 0)
        did_change_files(s, params);
}

/* ---- work between messages */

static bool is_due(const tn_document *document)
{
    return document->due && document->analysis && document->analysis->compilation.module;
}

static tn_document *find_due(const tn_exchange *s)
{
    tn_document *document = s->workspace.documents;
    while (document && !is_due(document))
        document = document->next;
    return document;
}

static bool any_dirty(const tn_exchange *s)
{
    const tn_document *document = s->workspace.documents;
    while (document && !document->dirty)
        document = document->next;
    return document;
}

void tn_exchange_work(tn_exchange *s)
{
    for (tn_document *document = s->workspace.documents; document; document = document->next) {
        if (!document->dirty)
            continue;
        tn_file_analysis *analysis = tn_workspace_analyse(&s->workspace, document);
        document->dirty = false;
        if (analysis)
            notify(s, "textDocument/publishDiagnostics", tn_lsp_diagnostics(document, analysis, s->pages));
    }
}

int tn_exchange_patience(const tn_exchange *s)
{
    if (any_dirty(s))
        return 0;
    if (s->review || !find_due(s))
        return -1;
    double left = s->time - tn_seconds();
    return left < 0 ? 0 : (int)(left * 1000) + 1;
}

tn_review *tn_exchange_review(tn_exchange *s)
{
    tn_document *document = s->review || s->time > tn_seconds() ? NULL : find_due(s);
    if (!document)
        return NULL;
    s->review = tn_review_new(&s->workspace, document);
    s->subject = s->review ? document : NULL;
    document->due = s->review != NULL;
    return s->review;
}

void tn_exchange_reviewed(tn_exchange *s, tn_review *review)
{
    tn_document *document = s->subject;
    tn_file_analysis *analysis;
    tn_facts *facts;
    tn_review_end(review, &analysis, &facts);
    s->review = NULL;
    s->subject = NULL;
    if (document)
        document->due = false;
    if (document && analysis) {
        tn_analysis_free(document->analysis);
        tn_facts_free(document->facts);
        document->analysis = analysis;
        document->facts = facts;
        document->dirty = true;
    } else {
        tn_analysis_free(analysis);
        tn_facts_free(facts);
    }
}

void tn_exchange_cancel(tn_exchange *s)
{
    if (s->review)
        tn_review_cancel(s->review);
    s->subject = NULL;
}

/* ---- messages */

void tn_exchange_take(tn_exchange *s, const json_t *message)
{
    const json_t *id = json_object_get(message, "id");
    const char *method = json_string_value(json_object_get(message, "method"));
    const json_t *params = json_object_get(message, "params");
    if (method && id)
        take_request(s, id, method, params);
    else if (method)
        take_notification(s, method, params);
}

void tn_exchange_malformed(tn_exchange *s, const char *why)
{
    fail(s, PARSE_ERROR, why);
    respond(s, json_null(), NULL);
    notify(s, "window/logMessage", json_pack("{s:i,s:s}", "type", LOG_ERROR, "message", why));
}

json_t *tn_exchange_next(tn_exchange *s)
{
    json_t *message = json_array_get(s->sent, s->next);
    if (!message) {
        json_array_clear(s->sent);
        s->next = 0;
        return NULL;
    }
    s->next++;
    return json_incref(message);
}

bool tn_exchange_ended(const tn_exchange *s)
{
    return s->ended;
}

bool tn_exchange_shut_down(const tn_exchange *s)
{
    return s->shut_down;
}

bool tn_exchange_failed(const tn_exchange *s)
{
    return s->failed;
}

/* ---- the beginning and the end */

tn_status tn_exchange_new(const tn_served *served, tn_exchange **exchange, tn_error *error)
{
    tn_exchange *s = calloc(1, sizeof *s);
    *exchange = s;
    if (!s)
        return tn_fail_memory(error);
    s->sent = json_array();
    tn_status status = s->sent ? tn_workspace_open(served, &s->workspace, error) : tn_fail_memory(error);
    if (status == TN_OK)
        return TN_OK;
    tn_exchange_free(s);
    *exchange = NULL;
    return status;
}

void tn_exchange_free(tn_exchange *s)
{
    if (!s)
        return;
    json_decref(s->sent);
    tn_workspace_clear(&s->workspace);
    free(s->pages);
    free(s);
}
