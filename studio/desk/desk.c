/* Answers a page's questions about its texts. */
#include "studio/desk/desk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "driver/open/stdlib.h"
#include "include/tartan/ask.h"
#include "lsp/workspace.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"

/* Error codes of JSON-RPC and of the Language Server Protocol. */
enum {
    METHOD_NOT_FOUND = -32601,
    INVALID_PARAMS = -32602,
    REQUEST_CANCELLED = -32800,
    CONTENT_MODIFIED = -32801,
    REQUEST_FAILED = -32803,
};

/* A text that questions are asked about, compiled. */
typedef struct open_text {
    struct open_text *next;
    tn_desk *desk;
    char *uri;
    char *set; /* the values of its params, as JSON */
    tartan_session *session;
    tn_served_files files;
} open_text;

/* A message of bytes that goes before the answer. */
typedef struct parcel {
    struct parcel *next;
    uint8_t *bytes;
    size_t size;
    uint32_t number;
} parcel;

enum { PARCEL_HEADER = 8 };

struct tn_desk {
    const tn_served *served;
    tn_workspace workspace; /* of which only the texts are used */
    open_text *opened;
    const json_t *texts; /* that the request at hand brings, by their names; borrowed */
    parcel *first, **last;
    uint32_t numbered;
};

/* ---- the texts that are open */

static void close_text(open_text *text)
{
    tartan_session_free(text->session);
    tn_served_clear(&text->files);
    free(text->uri);
    free(text->set);
    free(text);
}

/* Any text may be used by any other. */
static void close_all(tn_desk *desk)
{
    for (open_text *text = desk->opened, *next; text; text = next) {
        next = text->next;
        close_text(text);
    }
    desk->opened = NULL;
}

/* ---- what goes as bytes */

uint8_t *tn_desk_bytes(tn_desk *desk, size_t *size)
{
    parcel *p = desk->first;
    if (!p)
        return NULL;
    uint8_t *bytes = p->bytes;
    *size = p->size;
    desk->first = p->next;
    if (!desk->first)
        desk->last = &desk->first;
    free(p);
    return bytes;
}

static void forget_bytes(tn_desk *desk)
{
    size_t size;
    for (uint8_t *bytes; (bytes = tn_desk_bytes(desk, &size));)
        free(bytes);
}

static tartan_status too_large(size_t size, tartan_error *error)
{
    error->code = E_FILE_TOO_LARGE;
    snprintf(error->message, sizeof error->message, "the file has %zu MiB, and a page takes %d MiB at most", size >> 20,
             TN_DESK_BYTES_MAX >> 20);
    snprintf(error->help, sizeof error->help,
             "a coarser grid, or fewer steps, make a mesh smaller; the commands of `tartan` write any size");
    return TARTAN_LIMIT;
}

static tartan_status take_bytes(void *context, const char *format, const char *name, const void *bytes, size_t size,
                                tartan_error *error)
{
    tn_desk *desk = context;
    (void)format, (void)name;
    if (size > TN_DESK_BYTES_MAX)
        return too_large(size, error);
    parcel *p = calloc(1, sizeof *p);
    if (!p)
        return TARTAN_MEMORY;
    p->size = PARCEL_HEADER + size;
    p->bytes = malloc(p->size);
    if (!p->bytes) {
        free(p);
        return TARTAN_MEMORY;
    }
    p->number = ++desk->numbered;
    tn_put_u32(p->bytes, p->number);
    tn_put_u32(p->bytes + 4, (uint32_t)size);
    memcpy(p->bytes + PARCEL_HEADER, bytes, size);
    *desk->last = p;
    desk->last = &p->next;
    return TARTAN_OK;
}

static json_t *numbers_of(const tn_desk *desk)
{
    json_t *numbers = json_array();
    for (const parcel *p = desk->first; p; p = p->next)
        json_array_append_new(numbers, json_integer(p->number));
    return numbers;
}

/* ---- a desk */

tn_status tn_desk_new(const tn_served *served, tn_desk **desk, tn_error *error)
{
    tn_desk *made = calloc(1, sizeof *made);
    *desk = made;
    if (!made)
        return tn_fail_memory(error);
    made->served = served;
    made->last = &made->first;
    return tn_workspace_open(served, &made->workspace, error);
}

void tn_desk_free(tn_desk *desk)
{
    if (!desk)
        return;
    close_all(desk);
    forget_bytes(desk);
    tn_workspace_clear(&desk->workspace);
    free(desk);
}

/* ---- notifications */

static bool did_open(tn_desk *desk, const json_t *params)
{
    const json_t *document = json_object_get(params, "textDocument");
    const char *uri = json_string_value(json_object_get(document, "uri"));
    const char *text = json_string_value(json_object_get(document, "text"));
    const char *language = json_string_value(json_object_get(document, "languageId"));
    json_int_t version = json_integer_value(json_object_get(document, "version"));
    return !uri || !text || tn_workspace_put(&desk->workspace, uri, language, text, version);
}

static bool did_change(tn_desk *desk, const json_t *params)
{
    const json_t *document = json_object_get(params, "textDocument");
    const char *uri = json_string_value(json_object_get(document, "uri"));
    tn_document *changed = uri ? tn_workspace_find(&desk->workspace, uri) : NULL;
    if (changed)
        tn_workspace_change(&desk->workspace, changed, json_object_get(params, "contentChanges"),
                            json_integer_value(json_object_get(document, "version")));
    return true;
}

static bool did_close(tn_desk *desk, const json_t *params)
{
    const char *uri = json_string_value(json_object_get(json_object_get(params, "textDocument"), "uri"));
    if (uri)
        tn_workspace_remove(&desk->workspace, uri);
    return true;
}

static bool did_change_files(tn_desk *desk, const json_t *params)
{
    (void)desk, (void)params;
    return true;
}

/* False where out of memory. */
static bool take_notification(tn_desk *desk, const char *method, const json_t *params)
{
    static const struct {
        const char *method;
        bool (*take)(tn_desk *desk, const json_t *params);
    } notifications[] = {
        {"textDocument/didOpen", did_open},
        {"textDocument/didChange", did_change},
        {"textDocument/didClose", did_close},
        {"workspace/didChangeWatchedFiles", did_change_files},
    };
    for (size_t i = 0; i < sizeof notifications / sizeof *notifications; i++)
        if (strcmp(notifications[i].method, method) == 0) {
            close_all(desk);
            return notifications[i].take(desk, params);
        }
    return true;
}

/* ---- where what is named comes from */

static tartan_status not_found(const tn_error *why, tartan_error *error)
{
    snprintf(error->message, sizeof error->message, "%s", why->message);
    snprintf(error->help, sizeof error->help, "%s", why->help);
    return why->status == TN_MEMORY ? TARTAN_MEMORY : TARTAN_INVALID;
}

static tartan_status find_text(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    open_text *text = context;
    const json_t *brought = json_object_get(text->desk->texts, use->path);
    if (json_is_string(brought)) {
        *found = (tartan_text){json_string_value(brought), json_string_length(brought), use->path};
        return TARTAN_OK;
    }
    const tn_request request = {use->path, use->extension, use->user};
    char meant[TN_MEANT_SIZE] = "";
    tn_input input;
    tn_error why;
    if (tn_served_find(&text->files, &request, &input, meant, &why) != TN_OK)
        return not_found(&why, error);
    *found = (tartan_text){input.text, input.size, input.name};
    return TARTAN_OK;
}

/* ---- what is said of a question */

typedef struct noted {
    json_t *list;
    const char *first_code; /* of the first error; borrowed from the list */
} noted;

static void note(void *context, const tartan_diagnostic *said)
{
    static const char *const severities[] = {
        [TARTAN_NOTE] = "note", [TARTAN_WARNING] = "warning", [TARTAN_ERROR] = "error"};
    noted *notes = context;
    json_t *item = json_pack("{s:s,s:s,s:s}", "severity", severities[said->severity], "code", said->code, "message",
                             said->message);
    if (said->help)
        json_object_set_new(item, "help", json_string(said->help));
    if (said->path) {
        json_object_set_new(item, "path", json_string(said->path));
        json_object_set_new(item, "line", json_integer((json_int_t)said->line));
        json_object_set_new(item, "column", json_integer((json_int_t)said->column));
    }
    json_array_append_new(notes->list, item);
}

/* ---- a request */

typedef struct asked {
    const json_t *id, *params;
    const char *uri, *question;
    json_int_t version;
    json_t *notes;
    char **response;
} asked;

/* The text of a message; `message` NULL (out of memory) has none. Releases it. */
static tn_status give(const asked *a, json_t *message)
{
    *a->response = message ? json_dumps(message, JSON_COMPACT) : NULL;
    json_decref(message);
    return *a->response ? TN_OK : TN_MEMORY;
}

static tn_status refuse(const asked *a, int code, const char *message)
{
    return give(a, json_pack("{s:s,s:O,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", a->id, "error", "code", code, "message",
                             message));
}

static tn_status refuse_question(const asked *a, const tn_error *why)
{
    return give(a, json_pack("{s:s,s:O,s:{s:i,s:s,s:{s:s}}}", "jsonrpc", "2.0", "id", a->id, "error", "code",
                             METHOD_NOT_FOUND, "message", why->message, "data", "help", why->help));
}

static json_t *first_error(const json_t *notes)
{
    size_t i;
    json_t *item;
    json_array_foreach(notes, i, item)
    {
        if (strcmp(json_string_value(json_object_get(item, "severity")), "error") == 0)
            return item;
    }
    return NULL;
}

/* Why it failed: with what the first error among the notes says of its place. */
static tn_status fail(const asked *a, tartan_status status, const tartan_error *error)
{
    static const char *const places[] = {"path", "line", "column"};
    int code = status == TARTAN_STOPPED ? REQUEST_CANCELLED : error->code == E_USAGE ? INVALID_PARAMS : REQUEST_FAILED;
    char name[8] = "";
    if (error->code != TN_CODE_NONE)
        tn_code_name((tn_code)error->code, name);
    const json_t *first = first_error(a->notes);
    json_t *data = json_pack("{s:s,s:s,s:O}", "code", name, "help", error->help, "notes", a->notes);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        if (json_object_get(first, places[i]))
            json_object_set(data, places[i], json_object_get(first, places[i]));
    return give(a, json_pack("{s:s,s:O,s:{s:i,s:s,s:o}}", "jsonrpc", "2.0", "id", a->id, "error", "code", code,
                             "message", error->message, "data", data));
}

/* The answer, which is JSON already, is put into the message as it stands. */
static tn_status answer(const tn_desk *desk, const asked *a, const char *text)
{
    json_t *around = json_pack("{s:s,s:I,s:O}", "uri", a->uri, "version", a->version, "notes", a->notes);
    if (desk->first && json_object_set_new(around, "bytes", numbers_of(desk)) != 0) {
        json_decref(around);
        return TN_MEMORY;
    }
    char *id = json_dumps(a->id, JSON_COMPACT | JSON_ENCODE_ANY), *rest = json_dumps(around, JSON_COMPACT);
    bool good =
        id && rest &&
        asprintf(a->response, "{\"jsonrpc\":\"2.0\",\"id\":%s,\"result\":{\"answer\":%s,%s}", id, text, rest + 1) >= 0;
    json_decref(around);
    free(id);
    free(rest);
    if (!good)
        *a->response = NULL;
    return good ? TN_OK : TN_MEMORY;
}

/* ---- asking */

/* The values of params, as the compiler takes them; the caller frees the array alone. False where out of memory. */
static bool read_set(const json_t *set, const char ***values, size_t *count)
{
    size_t i;
    const json_t *value;
    *count = 0;
    *values = calloc(json_array_size(set) + 1, sizeof **values);
    if (!*values)
        return false;
    json_array_foreach(set, i, value)
    {
        if (json_is_string(value))
            (*values)[(*count)++] = json_string_value(value);
    }
    return true;
}

static tartan_status open_session(open_text *text, const tn_document *document, const asked *a, noted *notes,
                                  tartan_error *error)
{
    tartan_compile_options options = tartan_compile_options_init();
    const char **values;
    if (!read_set(json_object_get(a->params, "set"), &values, &options.param_count))
        return TARTAN_MEMORY;
    options.params = values;
    options.report = note;
    options.report_context = notes;
    options.resolve = find_text;
    options.resolve_context = text;
    tartan_status status =
        tartan_session_open(document->path, document->text, document->size, &options, &text->session, error);
    free(values);
    return status;
}

static open_text *new_text(tn_desk *desk, const asked *a, char *set)
{
    open_text *text = calloc(1, sizeof *text);
    if (!text)
        return NULL;
    tn_served_begin(&text->files, desk->served, tn_workspace_text, &desk->workspace);
    text->desk = desk;
    text->set = set;
    text->uri = strdup(a->uri);
    if (text->uri)
        return text;
    text->set = NULL;
    close_text(text);
    return NULL;
}

/* The document, compiled with the values that the request sets: as it is open already, or anew. */
static tartan_status open_text_of(tn_desk *desk, const tn_document *document, const asked *a, open_text **found,
                                  tartan_error *error)
{
    const json_t *given = json_object_get(a->params, "set");
    char *set = given ? json_dumps(given, JSON_COMPACT | JSON_ENCODE_ANY) : strdup("");
    if (!set)
        return TARTAN_MEMORY;
    for (*found = desk->opened; *found; *found = (*found)->next)
        if (strcmp((*found)->uri, a->uri) == 0 && strcmp((*found)->set, set) == 0) {
            free(set);
            return TARTAN_OK;
        }
    *found = new_text(desk, a, set);
    if (!*found) {
        free(set);
        return TARTAN_MEMORY;
    }
    tartan_status status = open_session(*found, document, a, &(noted){.list = a->notes}, error);
    if (status != TARTAN_OK) {
        close_text(*found);
        return status;
    }
    json_array_clear(a->notes); /* what compiling warns of is the language server's to say */
    (*found)->next = desk->opened;
    desk->opened = *found;
    return TARTAN_OK;
}

static tn_status ask(tn_desk *desk, const tn_document *document, const asked *a, const tartan_watch *watch)
{
    tartan_error error = {.status = TARTAN_OK};
    open_text *text;
    char *request = json_dumps(json_object_get(a->params, "request"), JSON_COMPACT), *answered = NULL;
    bool binary = json_is_true(json_object_get(a->params, "binary"));
    desk->texts = json_object_get(a->params, "texts");
    tartan_status status = open_text_of(desk, document, a, &text, &error);
    if (status == TARTAN_OK) {
        tartan_session_take_bytes(text->session, binary ? take_bytes : NULL, desk);
        status =
            tartan_ask(text->session, a->question, request, watch, note, &(noted){.list = a->notes}, &answered, &error);
    }
    desk->texts = NULL;
    tn_status given = status == TARTAN_OK       ? answer(desk, a, answered)
                      : status == TARTAN_MEMORY ? TN_MEMORY
                                                : fail(a, status, &error);
    if (status != TARTAN_OK || given != TN_OK)
        forget_bytes(desk);
    free(request);
    tartan_text_free(answered);
    return given;
}

/* ---- the standard library */

static tn_status stdlib_asked(const asked *a)
{
    const char *name = json_string_value(json_object_get(a->params, "name"));
    const tn_stdlib_text *text = name ? tn_stdlib_text_named(name) : NULL;
    if (name && !text)
        return refuse(a, INVALID_PARAMS, "the standard library has no such file");
    json_t *names = json_array();
    for (size_t i = 0; !name && i < tn_stdlib_text_count; i++)
        json_array_append_new(names, json_string(tn_stdlib_texts[i].name));
    json_t *result =
        name ? json_pack("{s:s,s:s}", "name", text->name, "text", text->text) : json_pack("{s:O}", "names", names);
    json_decref(names);
    return give(a, json_pack("{s:s,s:O,s:o}", "jsonrpc", "2.0", "id", a->id, "result", result));
}

/* ---- messages */

static tn_status take_request(tn_desk *desk, const asked *a, const tartan_watch *watch)
{
    const tn_request_kind *kind;
    tn_error error;
    const tn_document *document = a->uri ? tn_workspace_find(&desk->workspace, a->uri) : NULL;
    if (strcmp(a->question, "stdlib") == 0)
        return stdlib_asked(a);
    if (tn_request_kind_named(a->question, &kind, &error) != TN_OK)
        return refuse_question(a, &error);
    if (kind->runs)
        return refuse(a, METHOD_NOT_FOUND, "runs of evolution are asked about at a terminal, by the command `tartan`");
    if (!document)
        return refuse(a, INVALID_PARAMS, "the document is not open");
    if (document->version != a->version)
        return refuse(a, CONTENT_MODIFIED, "the text has changed since");
    return ask(desk, document, a, watch);
}

tn_status tn_desk_take(tn_desk *desk, const json_t *message, const tartan_watch *watch, char **response)
{
    static const char prefix[] = "tartan/";
    const char *method = json_string_value(json_object_get(message, "method"));
    asked a = {
        .id = json_object_get(message, "id"), .params = json_object_get(message, "params"), .response = response};
    *response = NULL;
    forget_bytes(desk);
    if (!method)
        return TN_OK;
    if (!a.id)
        return take_notification(desk, method, a.params) ? TN_OK : TN_MEMORY;
    if (strncmp(method, prefix, sizeof prefix - 1) != 0)
        return refuse(&a, METHOD_NOT_FOUND, "there is no such method");
    a.question = method + sizeof prefix - 1;
    a.uri = json_string_value(json_object_get(a.params, "uri"));
    a.version = json_integer_value(json_object_get(a.params, "version"));
    a.notes = json_array();
    tn_status status = a.notes ? take_request(desk, &a, watch) : TN_MEMORY;
    json_decref(a.notes);
    return status;
}
