/* The C interface to questions: JSON to a request, and the answer to JSON. */
#include <stdlib.h>
#include <string.h>

#include "api/compiler/compile.h"
#include "ask/questions.h"
#include "ask/session/session.h"
#include "include/tartan/ask.h"
#include "runtime/base/file.h"

/* A file that is open, and what is kept of it. */
typedef struct asked_file {
    tn_opened opened;
    tn_session session;
    bool open;
} asked_file;

struct tartan_session {
    char *path, *text; /* the caller's, copied */
    size_t size;
    tartan_compile_options options; /* with folders of our own */
    char **folders;
    asked_file whole;    /* as it was written */
    asked_file narrowed; /* with further requirements or an open plan, */
    char *narrowed_by;   /* which are these, one a line behind the library's name and the open plan */
};

/* ---- opened */

static void close_file(asked_file *file)
{
    if (!file->open)
        return;
    tn_session_forget(&file->session);
    tn_close(&file->opened);
    *file = (asked_file){0};
}

static tartan_status open_file(tartan_session *session, const tn_questions *asking, asked_file *file,
                               tartan_error *error)
{
    tartan_status status =
        tn_api_open(session->path, session->text, session->size, &session->options, asking, &file->opened, error);
    file->open = status == TARTAN_OK;
    if (!file->open)
        tn_close(&file->opened);
    file->session = (tn_session){.opened = &file->opened};
    return status;
}

static bool copy_folders(tartan_session *session, const tartan_compile_options *given)
{
    session->folders = calloc(given->folder_count + 1, sizeof *session->folders);
    for (size_t i = 0; session->folders && i < given->folder_count; i++) {
        session->folders[i] = strdup(given->folders[i]);
        if (!session->folders[i])
            return false;
    }
    session->options.folders = (const char *const *)session->folders;
    return session->folders != NULL;
}

/* The caller's text, or that of the file. */
static tartan_status take_text(tartan_session *session, const char *path, const char *text, size_t size,
                               tartan_error *error)
{
    uint8_t *bytes = NULL;
    tn_error found;
    if (!text && tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &found) != TN_OK)
        return tn_api_fail(&found, error);
    session->path = strdup(path);
    session->text = text ? malloc(size + 1) : (char *)bytes;
    session->size = size;
    if (!session->path || !session->text)
        return tn_api_memory(error);
    if (text)
        memcpy(session->text, text, size);
    return TARTAN_OK;
}

/* The report is for opening alone: questions have one each. */
static tartan_status begin(tartan_session *session, const char *path, const char *text, size_t size,
                           const tartan_compile_options *given, tartan_error *error)
{
    tartan_status status = TN_API_TAKE(tartan_compile_options, &session->options, given, error);
    if (status == TARTAN_OK && session->options.folder_count && !session->options.folders)
        return tn_api_missing(error, "array of folders");
    if (status == TARTAN_OK)
        status = take_text(session, path, text, size, error);
    if (status == TARTAN_OK && given && !copy_folders(session, given))
        status = tn_api_memory(error);
    if (status == TARTAN_OK)
        status = open_file(session, NULL, &session->whole, error);
    session->options.report = NULL;
    session->options.watch = NULL;
    return status;
}

tartan_status tartan_session_open(const char *path, const char *text, size_t size,
                                  const tartan_compile_options *options, tartan_session **session, tartan_error *error)
{
    if (!path || !session)
        return tn_api_missing(error, path ? "room for the session" : "path");
    tartan_session *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = begin(made, path, text, size, options, error);
    if (status == TARTAN_OK)
        *session = made;
    else
        tartan_session_free(made);
    return status;
}

void tartan_session_free(tartan_session *session)
{
    if (!session)
        return;
    close_file(&session->whole);
    close_file(&session->narrowed);
    for (size_t i = 0; session->folders && i < session->options.folder_count; i++)
        free(session->folders[i]);
    free(session->folders);
    free(session->narrowed_by);
    free(session->path);
    free(session->text);
    free(session);
}

/* ---- with further requirements */

/* The library that a request is about, or NULL if it is about none. */
static const tn_library_asked *library_of(const tn_message *message, const void *request)
{
    for (size_t i = 0; i < message->member_count; i++)
        if (message->members[i].of == &tn_message_library_asked)
            return (const void *)((const char *)request + message->members[i].offset);
    return NULL;
}

/* The open plan that a request is about, or NULL. */
static const char *pattern_of(const tn_message *message, const void *request)
{
    return message == &tn_message_complete_request ? ((const tn_complete_request *)request)->pattern : NULL;
}

/* (malloc) */
static char *key_of(const tn_library_asked *asked, const char *pattern)
{
    tn_buffer key = {0};
    tn_buffer_printf(&key, "%s\n%s", asked->library ? asked->library : "", pattern ? pattern : "");
    for (size_t i = 0; i < asked->where.count; i++)
        tn_buffer_printf(&key, "\n%s", asked->where.items[i]);
    if (key.failed) {
        free(key.data);
        return NULL;
    }
    return key.data;
}

/* The file as the request wants it: compiled again only if other requirements were asked for before. */
static tartan_status choose_file(tartan_session *session, const tn_library_asked *asked, const char *pattern,
                                 tartan_report *report, void *context, asked_file **file, tartan_error *error)
{
    *file = &session->whole;
    if (!asked || (asked->where.count == 0 && !pattern))
        return TARTAN_OK;
    *file = &session->narrowed;
    char *key = key_of(asked, pattern);
    if (!key)
        return tn_api_memory(error);
    if (session->narrowed.open && strcmp(session->narrowed_by, key) == 0) {
        free(key);
        return TARTAN_OK;
    }
    const tn_questions asking = {
        .library = asked->library, .wheres = asked->where.items, .where_count = asked->where.count, .pattern = pattern};
    close_file(&session->narrowed);
    free(session->narrowed_by);
    session->narrowed_by = key;
    session->options.report = report;
    session->options.report_context = context;
    tartan_status status = open_file(session, &asking, &session->narrowed, error);
    session->options.report = NULL;
    return status;
}

/* ---- asked */

typedef struct asking {
    const tn_request_kind *kind;
    json_t *json;  /* what the request borrows its texts from */
    void *request; /* a message of the kind's type */
} asking;

static void clear(asking *a)
{
    if (a->request)
        tn_message_clear(a->kind->request, a->request);
    free(a->request);
    json_decref(a->json);
}

static tn_status read_request(asking *a, const char *question, const char *text, tn_error *error)
{
    json_error_t wrong;
    tn_status status = tn_request_kind_named(question, &a->kind, error);
    if (status != TN_OK)
        return status;
    a->json = json_loads(text ? text : "{}", JSON_REJECT_DUPLICATES, &wrong);
    if (!json_is_object(a->json))
        return tn_fail(error, TN_INVALID, E_USAGE, "the request is no JSON object: %s",
                       a->json ? "it is another value" : wrong.text);
    a->request = malloc(a->kind->request->size);
    if (!a->request)
        return tn_fail_memory(error);
    tn_message_init(a->kind->request, a->request);
    return tn_message_read(a->kind->request, a->json, a->request, error);
}

static tartan_status give(const tn_reply *reply, char **answer, tartan_error *error)
{
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, tn_reply_layout(reply));
    tn_message_write(reply->message, reply->value, NULL, &json);
    tn_json_end_line(&json);
    if (text.failed) {
        free(text.data);
        return tn_api_memory(error);
    }
    *answer = text.data;
    return TARTAN_OK;
}

/* What is said of one question is forgotten before the next one. */
static tartan_status ask(asked_file *file, const asking *a, tn_watch *watch, tartan_report *report, void *context,
                         char **answer, tartan_error *error)
{
    tn_compilation *compilation = &file->opened.compilation;
    const tn_diagnostics kept = compilation->diagnostics;
    tn_reply reply = {0};
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    file->opened.module->watch = watch;
    tn_status status = a->kind->ask(&file->session, a->request, &reply);
    file->opened.module->watch = NULL;
    tn_api_report(&compilation->diagnostics, report, context);
    tartan_status result = status == TN_OK ? give(&reply, answer, error)
                                           : tn_api_first_error(&compilation->diagnostics, status, watch, error);
    tn_reply_clear(&reply);
    tn_diagnostics_clear(&compilation->diagnostics);
    compilation->diagnostics = kept;
    return result;
}

tartan_status tartan_ask(tartan_session *session, const char *question, const char *request, const tartan_watch *given,
                         tartan_report *report, void *report_context, char **answer, tartan_error *error)
{
    asking a = {0};
    asked_file *file;
    tn_watch watch;
    tn_error found;
    if (!session || !question || !answer)
        return tn_api_missing(error, !session ? "session" : !question ? "question" : "room for the answer");
    tartan_status status = tn_api_watch(given, &watch, error);
    if (status != TARTAN_OK)
        return status;
    if (read_request(&a, question, request, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    if (status == TARTAN_OK)
        status = choose_file(session, library_of(a.kind->request, a.request), pattern_of(a.kind->request, a.request),
                             report, report_context, &file, error);
    if (status == TARTAN_OK)
        status = ask(file, &a, &watch, report, report_context, answer, error);
    clear(&a);
    return status;
}
