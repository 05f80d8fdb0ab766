/* The C interface to questions: JSON to a request, and the answer to JSON. */
#include <stdlib.h>
#include <string.h>

#include "api/compiler/compile.h"
#include "ask/growth/grow.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "ask/session/session.h"
#include "driver/open/files.h"
#include "driver/open/served.h"
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
    char **folders, **params;
    asked_file whole;    /* as it was written */
    asked_file narrowed; /* with further requirements, or with statements about growing, */
    char *narrowed_by;   /* which are these: one a line behind the library's name, or a study */
    asked_file before;   /* another file that was compared with it last, */
    char *before_text;
    tartan_bytes_taker *take; /* or NULL */
    void *take_context;
    tn_watch watch; /* whoever waits for the answer: what is kept between questions has its address */
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

/* NULL where out of memory. */
static char **copy_texts(const char *const *texts, size_t count)
{
    char **copy = calloc(count + 1, sizeof *copy);
    for (size_t i = 0; copy && i < count; i++)
        copy[i] = strdup(texts[i]);
    return copy;
}

static void free_texts(char **texts, size_t count)
{
    for (size_t i = 0; texts && i < count; i++)
        free(texts[i]);
    free(texts);
}

static bool all_there(char *const *texts, size_t count)
{
    bool there = texts != NULL;
    for (size_t i = 0; there && i < count; i++)
        there = texts[i] != NULL;
    return there;
}

/* The folders and the values of params. */
static bool copy_options(tartan_session *session, const tartan_compile_options *given)
{
    session->folders = copy_texts(given->folders, given->folder_count);
    session->params = copy_texts(given->params, given->param_count);
    session->options.folders = (const char *const *)session->folders;
    session->options.params = (const char *const *)session->params;
    return all_there(session->folders, given->folder_count) && all_there(session->params, given->param_count);
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
    const tartan_compile_options taken = session->options;
    if (status == TARTAN_OK)
        status = tn_api_compile_texts(&taken, error);
    if (status == TARTAN_OK)
        status = take_text(session, path, text, size, error);
    if (status == TARTAN_OK && !copy_options(session, &taken))
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
    close_file(&session->before);
    free(session->before_text);
    free_texts(session->folders, session->options.folder_count);
    free_texts(session->params, session->options.param_count);
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

/* (malloc) */
static char *key_of(const tn_library_asked *asked)
{
    tn_buffer key = {0};
    tn_buffer_printf(&key, "%s", asked->library ? asked->library : "");
    for (size_t i = 0; i < asked->where.count; i++)
        tn_buffer_printf(&key, "\n%s", asked->where.items[i]);
    if (key.failed) {
        free(key.data);
        return NULL;
    }
    return key.data;
}

/* The file as the request wants it: compiled again only if other requirements were asked for before. */
static tartan_status choose_file(tartan_session *session, const tn_library_asked *asked, tartan_report *report,
                                 void *context, asked_file **file, tartan_error *error)
{
    *file = &session->whole;
    if (!asked || asked->where.count == 0)
        return TARTAN_OK;
    *file = &session->narrowed;
    char *key = key_of(asked);
    if (!key)
        return tn_api_memory(error);
    if (session->narrowed.open && strcmp(session->narrowed_by, key) == 0) {
        free(key);
        return TARTAN_OK;
    }
    const tn_questions asking = {
        .library = asked->library, .wheres = asked->where.items, .where_count = asked->where.count};
    close_file(&session->narrowed);
    free(session->narrowed_by);
    session->narrowed_by = key;
    session->options.report = report;
    session->options.report_context = context;
    tartan_status status = open_file(session, &asking, &session->narrowed, error);
    session->options.report = NULL;
    return status;
}

/* What a request says of growing, or NULL. */
static const tn_grow_statements *statements_of(const tn_message *message, const void *request)
{
    return message == &tn_message_grow_request ? &((const tn_grow_request *)request)->said : NULL;
}

/* The study that the statements are, which uses the session's file, takes its place. */
static tartan_status open_study(tartan_session *session, const char *study, size_t size, tartan_report *report,
                                void *context, tartan_error *error)
{
    const tn_input used = {.text = session->text, .size = session->size, .name = session->path};
    tartan_compile_options options = session->options;
    options.report = report;
    options.report_context = context;
    tartan_status status =
        tn_api_open_study("<options>", study, size, &options, &used, &session->narrowed.opened, error);
    session->narrowed.open = status == TARTAN_OK;
    if (!session->narrowed.open)
        tn_close(&session->narrowed.opened);
    session->narrowed.session = (tn_session){.opened = &session->narrowed.opened};
    return status;
}

/* The file as it is to grow. */
static tartan_status choose_growing(tartan_session *session, const tn_grow_statements *said, tartan_report *report,
                                    void *context, asked_file **file, tartan_error *error)
{
    const tn_notation *notation = tn_notation_or_first(session->path, session->text, session->size);
    char *study = NULL;
    size_t size = 0;
    tn_error wrong;
    *file = &session->whole;
    if (tn_notation_takes(notation, "grow") &&
        tn_grow_study_text(said, session->path, notation == TN_NOTATION(hemls), &study, &size, &wrong) != TN_OK)
        return tn_api_fail(&wrong, error);
    if (!study)
        return TARTAN_OK;
    *file = &session->narrowed;
    if (session->narrowed.open && strcmp(session->narrowed_by, study) == 0) {
        free(study);
        return TARTAN_OK;
    }
    close_file(&session->narrowed);
    free(session->narrowed_by);
    session->narrowed_by = study;
    return open_study(session, study, size, report, context, error);
}

/* ---- another file */

/* One question, and whom it is asked for. */
typedef struct answering {
    tartan_session *session;
    const tn_library_asked *subject; /* or NULL */
    tn_watch *watch;
    tartan_report *report;
    void *report_context;
    tartan_error *error;
    bool failed; /* it is in `error` why */
} answering;

/* The text of that name, by the caller's resolver if there is one; *text is owned. */
static tartan_status find_text(tartan_session *session, const char *path, const char *extension, char **text,
                               size_t *size, tartan_error *error)
{
    const tartan_compile_options *options = &session->options;
    const tartan_use use = {path, extension, session->path};
    tartan_text found = {.name = path};
    tn_error wrong;
    if (!options->resolve)
        return tn_file_read(path, TN_SOURCE_BYTES_MAX, (uint8_t **)text, size, &wrong) == TN_OK
                   ? TARTAN_OK
                   : tn_api_fail(&wrong, error);
    tartan_status status = options->resolve(options->resolve_context, &use, &found, error);
    if (status != TARTAN_OK)
        return status;
    *size = found.size;
    *text = malloc(found.size + 1);
    if (!*text)
        return tn_api_memory(error);
    if (found.size > 0)
        memcpy(*text, found.text, found.size);
    return TARTAN_OK;
}

/* Opens it anew for each question: it may be another text by now. */
static tartan_status open_before(answering *a, const char *path)
{
    tartan_session *session = a->session;
    const tn_library_asked *asked = a->subject;
    const tn_questions asking = {
        .library = asked->library, .wheres = asked->where.items, .where_count = asked->where.count};
    tartan_compile_options options = session->options;
    size_t size;
    close_file(&session->before);
    free(session->before_text);
    session->before_text = NULL;
    tartan_status status = find_text(session, path, ".plan", &session->before_text, &size, a->error);
    if (status != TARTAN_OK)
        return status;
    options.report = a->report;
    options.report_context = a->report_context;
    status = tn_api_open(path, session->before_text, size, &options, asked->where.count ? &asking : NULL,
                         &session->before.opened, a->error);
    session->before.open = status == TARTAN_OK;
    if (!session->before.open)
        tn_close(&session->before.opened);
    session->before.session = (tn_session){.opened = &session->before.opened};
    return status;
}

static tn_status give_other(void *context, const char *path, tn_session **other)
{
    answering *a = context;
    asked_file *before = &a->session->before;
    tartan_status status = open_before(a, path);
    a->failed = status != TARTAN_OK;
    if (a->failed)
        return (tn_status)status;
    tn_diagnostics_clear(&before->opened.compilation.diagnostics);
    tn_diagnostics_init(&before->opened.compilation.diagnostics, &before->opened.compilation.sources);
    before->opened.module->watch = a->watch;
    *other = &before->session;
    return TN_OK;
}

/* A model that was drawn. */
static tn_status read_drawn(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    tartan_session *session = context;
    tartan_error said = {.status = TARTAN_OK};
    tartan_status status = find_text(session, path, ".ldr", (char **)bytes, size, &said);
    if (status == TARTAN_OK)
        return TN_OK;
    if (status == TARTAN_MEMORY)
        return tn_fail_memory(error);
    tn_fail(error, TN_INVALID, E_CANNOT_READ, "%.479s", said.message[0] ? said.message : "there is no such text");
    if (said.help[0])
        tn_error_help(error, "%.319s", said.help);
    return TN_INVALID;
}

/* ---- what is no text */

void tartan_session_take_bytes(tartan_session *session, tartan_bytes_taker *take, void *context)
{
    if (!session)
        return;
    session->take = take;
    session->take_context = context;
}

static tn_status take_bytes(void *context, const tn_made_file *file, const uint8_t *bytes, size_t size, tn_error *error)
{
    const tartan_session *session = context;
    tartan_error said = {.status = TARTAN_OK};
    tartan_status status =
        session->take(session->take_context, file->format, file->has_name ? file->name : NULL, bytes, size, &said);
    if (status == TARTAN_OK)
        return TN_OK;
    if (status == TARTAN_MEMORY)
        return tn_fail_memory(error);
    tn_fail(error, (tn_status)status, (tn_code)said.code, "%.479s",
            said.message[0] ? said.message : "the file is not taken");
    if (said.help[0])
        tn_error_help(error, "%.319s", said.help);
    return error->status;
}

/* ---- a text that is made of an answer */

/* What the session has is used as it has it; all else comes from the caller. */
static tartan_status resolve_with_own(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    const tartan_session *session = context;
    char *identity = tn_file_identity(session->path);
    bool own = strcmp(use->path, session->path) == 0 || (identity && strcmp(use->path, identity) == 0);
    free(identity);
    if (!own)
        return session->options.resolve(session->options.resolve_context, use, found, error);
    *found = (tartan_text){.text = session->text, .size = session->size, .name = session->path};
    return TARTAN_OK;
}

static tn_status open_made(void *context, const char *path, const char *text, size_t size,
                           const tn_questions *questions, tn_opened *opened)
{
    tartan_session *session = context;
    tartan_compile_options options = session->options;
    tartan_error error;
    if (options.resolve) {
        options.resolve = resolve_with_own;
        options.resolve_context = session;
    }
    return (tn_status)tn_api_open(path, text, size, &options, questions, opened, &error);
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

/* Which of the two files it is said of why the question failed. */
static tartan_status say_why(const answering *to, const tn_diagnostics *said, tn_status status)
{
    const asked_file *before = &to->session->before;
    bool elsewhere = said->error_count == 0 && before->open && before->opened.compilation.diagnostics.error_count > 0;
    return to->failed ? (tartan_status)status
                      : tn_api_first_error(elsewhere ? &before->opened.compilation.diagnostics : said, status,
                                           to->watch, to->error);
}

/* What is said of one question is forgotten before the next one. */
static tartan_status ask(asked_file *file, const asking *a, answering *to, char **answer)
{
    tn_compilation *compilation = &file->opened.compilation;
    const tn_diagnostics kept = compilation->diagnostics;
    size_t source_count = compilation->sources.count;
    tn_reply reply = {0};
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    file->opened.module->watch = to->watch;
    file->session.other = give_other;
    file->session.other_context = to;
    const tn_text_opener opener = {open_made, to->session};
    file->session.opener = &opener;
    file->opened.meshes = to->session->options.resolve ? &tn_no_meshes : NULL;
    file->session.reads = to->session->options.resolve ? read_drawn : NULL;
    file->session.reads_context = to->session;
    const tn_bytes_taker taker = {take_bytes, to->session};
    file->session.bytes = to->session->take ? &taker : NULL;
    tn_status status = a->kind->ask(&file->session, a->request, &reply);
    file->opened.module->watch = NULL;
    file->session.opener = NULL;
    file->session.bytes = NULL;
    if (to->session->before.open)
        tn_api_report(&to->session->before.opened.compilation.diagnostics, to->report, to->report_context);
    tn_api_report(&compilation->diagnostics, to->report, to->report_context);
    tartan_status result =
        status == TN_OK ? give(&reply, answer, to->error) : say_why(to, &compilation->diagnostics, status);
    tn_reply_clear(&reply);
    close_file(&to->session->before);
    tn_diagnostics_clear(&compilation->diagnostics);
    compilation->diagnostics = kept;
    tn_sources_keep(&compilation->sources, source_count); /* without texts of the request */
    return result;
}

tartan_status tartan_ask(tartan_session *session, const char *question, const char *request, const tartan_watch *given,
                         tartan_report *report, void *report_context, char **answer, tartan_error *error)
{
    asking a = {0};
    asked_file *file;
    tn_error found;
    if (!session || !question || !answer)
        return tn_api_missing(error, !session ? "session" : !question ? "question" : "room for the answer");
    tartan_status status = tn_api_watch(given, &session->watch, error);
    if (status != TARTAN_OK)
        return status;
    if (read_request(&a, question, request, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    const tn_grow_statements *said = status == TARTAN_OK ? statements_of(a.kind->request, a.request) : NULL;
    if (said)
        status = choose_growing(session, said, report, report_context, &file, error);
    else if (status == TARTAN_OK)
        status = choose_file(session, library_of(a.kind->request, a.request), report, report_context, &file, error);
    if (status == TARTAN_OK)
        status = ask(file, &a,
                     &(answering){session, library_of(a.kind->request, a.request), &session->watch, report,
                                  report_context, error, false},
                     answer);
    clear(&a);
    tn_watch_begin(&session->watch, NULL, NULL); /* nobody waits any more */
    return status;
}
