#include "studio/server/window.h"

#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "include/tartan/base.h"
#include "lsp/exchange.h"
#include "lsp/review.h"
#include "runtime/base/watch.h"
#include "studio/desk/desk.h"
#include "studio/server/file_requests.h"
#include "studio/server/folder.h"
#include "studio/server/question_queue.h"

enum { TN_USED_MAX = 256 }; /* files that are noted; of more, changes show when a text is changed */

typedef struct used_file {
    char *name; /* below the folder */
    tn_file_stamp stamp;
} used_file;

typedef struct used_files {
    tn_studio_folder *folder; /* borrowed */
    pthread_mutex_t lock;
    used_file files[TN_USED_MAX];
    size_t count;
} used_files;

/* ---- the files that a window's texts use, which need not be open in it
 *
 * What was read for it is noted, so that it can be told when somebody changes one. Several threads may read. */

static void used_files_begin(used_files *used, tn_studio_folder *folder)
{
    *used = (used_files){.folder = folder};
    pthread_mutex_init(&used->lock, NULL);
}

static void used_files_clear(used_files *used)
{
    for (size_t i = 0; i < used->count; i++)
        free(used->files[i].name);
    pthread_mutex_destroy(&used->lock);
}

/* Files that are not there are noted, too: they may come. */
static void note(used_files *used, const char *name, const tn_file_stamp *stamp)
{
    pthread_mutex_lock(&used->lock);
    size_t i = 0;
    while (i < used->count && strcmp(used->files[i].name, name) != 0)
        i++;
    char *copy = i == used->count && i < TN_USED_MAX ? strdup(name) : NULL;
    if (copy)
        used->files[used->count++] = (used_file){copy, *stamp};
    pthread_mutex_unlock(&used->lock);
}

static tn_status read_noted(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    used_files *used = context;
    const char *name = path + (path[0] == '/');
    /* before it is read: what is written meanwhile is a change */
    tn_file_stamp stamp = tn_studio_folder_stamp(used->folder, name);
    note(used, name, &stamp);
    tn_served served = tn_studio_folder_served(used->folder);
    return served.read(served.context, path, bytes, size, error);
}

static tn_status list(void *context, char ***paths, size_t *count, bool *cut_off, tn_error *error)
{
    used_files *used = context;
    tn_served served = tn_studio_folder_served(used->folder);
    return served.list(served.context, paths, count, cut_off, error);
}

/* The folder for those who compile, with what they read noted. */
static tn_served used_files_served(used_files *used)
{
    return (tn_served){.read = read_noted, .list = list, .context = used};
}

/* Looks at the files from *next on (0 to begin with). The name of the next that has changed since it was read, or since
 * the last look; the caller frees it. NULL: no other has, or out of memory. */
static char *used_files_changed(used_files *used, size_t *next)
{
    char *changed = NULL;
    pthread_mutex_lock(&used->lock);
    while (!changed && *next < used->count) {
        used_file *file = &used->files[(*next)++];
        tn_file_stamp stamp = tn_studio_folder_stamp(used->folder, file->name);
        if (memcmp(&stamp, &file->stamp, sizeof stamp) == 0)
            continue;
        file->stamp = stamp;
        changed = strdup(file->name);
    }
    pthread_mutex_unlock(&used->lock);
    return changed;
}

static bool used_files_any(used_files *used)
{
    pthread_mutex_lock(&used->lock);
    bool any = used->count > 0;
    pthread_mutex_unlock(&used->lock);
    return any;
}

/* Error codes of JSON-RPC and of the Language Server Protocol. */
enum { PARSE_ERROR = -32700, INVALID_REQUEST = -32600, INTERNAL_ERROR = -32603, REQUEST_FAILED = -32803 };

enum { CHANGED = 2 }; /* a FileChangeType */

enum {
    THREAD_STACK = 8 << 20,
    REVIEW_SECONDS = 60,     /* after which rules are looked at no longer */
    LOOK_MILLISECONDS = 1000 /* between two looks at the files that are shown */
};

#define TOLD_SECONDS 0.25 /* between two words on how far a question is, and before the first */

typedef struct parcel {
    struct parcel *next;
    json_t *message;
    size_t size;
} parcel;

struct tn_window {
    tn_windows *all;
    tn_outbox *outbox;
    used_files used;
    tn_served served;     /* which notes them */
    pthread_mutex_t lock; /* for what follows */
    pthread_cond_t texts_come, questions_come;
    parcel *first, **last; /* for the thread of texts */
    size_t waiting;        /* bytes of them */
    tn_question_queue *questions;
    bool left;      /* by the socket */
    bool over;      /* an answer could not be made, or `exit` was said */
    bool reviewed;  /* the background has come to its end */
    unsigned users; /* the socket and the threads */
    /* of the thread of texts */
    tn_exchange *exchange;
    tn_background *background;
    tn_file_requests files;
    double look; /* when files are looked at next */
    /* of the thread of questions */
    tn_desk *desk;
    double began;        /* the question at work */
    bool late;           /* it was ended for the time it took */
    const json_t *token; /* by which it asked to be told how far it is, or NULL; borrowed from it */
    double told;         /* when it was told last; 0: not yet */
};

/* ---- all of them */

/* A condition that is waited for by the clock that nobody sets. */
static void begin_condition(pthread_cond_t *condition)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(condition, &attributes);
    pthread_condattr_destroy(&attributes);
}

static struct timespec in_milliseconds(int milliseconds)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    time.tv_sec += milliseconds / 1000;
    time.tv_nsec += milliseconds % 1000 * 1000000L;
    if (time.tv_nsec >= 1000000000L) {
        time.tv_sec++;
        time.tv_nsec -= 1000000000L;
    }
    return time;
}

void tn_windows_begin(tn_windows *windows, tn_studio_folder *folder, const char *open, uint64_t memory_limit)
{
    *windows = (tn_windows){.folder = folder, .open = open, .memory_limit = memory_limit};
    pthread_mutex_init(&windows->lock, NULL);
    begin_condition(&windows->left);
}

bool tn_windows_end(tn_windows *windows, unsigned seconds)
{
    const struct timespec latest = in_milliseconds((int)seconds * 1000);
    int late = 0;
    pthread_mutex_lock(&windows->lock);
    while (windows->count > 0 && late == 0)
        late = pthread_cond_timedwait(&windows->left, &windows->lock, &latest);
    bool all = windows->count == 0;
    pthread_mutex_unlock(&windows->lock);
    if (all) {
        pthread_mutex_destroy(&windows->lock);
        pthread_cond_destroy(&windows->left);
    }
    return all;
}

bool tn_windows_full(tn_windows *windows)
{
    pthread_mutex_lock(&windows->lock);
    bool full = windows->count >= TN_WINDOWS_MAX;
    pthread_mutex_unlock(&windows->lock);
    return full;
}

static void count_window(tn_windows *windows, bool one_more)
{
    pthread_mutex_lock(&windows->lock);
    windows->count += one_more ? 1 : -(size_t)1;
    pthread_cond_broadcast(&windows->left);
    pthread_mutex_unlock(&windows->lock);
}

/* ---- what threads share */

static void free_window(tn_window *w)
{
    tn_windows *all = w->all;
    while (w->first) {
        parcel *next = w->first->next;
        json_decref(w->first->message);
        free(w->first);
        w->first = next;
    }
    tn_question_queue_free(w->questions);
    tn_outbox_free(w->outbox);
    tn_exchange_free(w->exchange);
    tn_desk_free(w->desk);
    tn_file_requests_clear(&w->files);
    used_files_clear(&w->used);
    pthread_mutex_destroy(&w->lock);
    pthread_cond_destroy(&w->texts_come);
    pthread_cond_destroy(&w->questions_come);
    free(w);
    count_window(all, false);
}

/* The last who leaves frees it. */
static void let_go(tn_window *w)
{
    pthread_mutex_lock(&w->lock);
    bool last = --w->users == 0;
    pthread_mutex_unlock(&w->lock);
    if (last)
        free_window(w);
}

static void call_over(tn_window *w)
{
    pthread_mutex_lock(&w->lock);
    w->over = true;
    pthread_mutex_unlock(&w->lock);
    tn_outbox_wake(w->outbox);
}

static json_t *failure(const json_t *id, int code, const char *why)
{
    return id ? json_pack("{s:s,s:O,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", id, "error", "code", code, "message", why)
              : json_pack("{s:s,s:n,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", "error", "code", code, "message", why);
}

/* Takes over a message for the thread of questions, and answers those that it ended. */
static bool put_question(tn_window *w, json_t *message, size_t size)
{
    json_t *ended;
    pthread_mutex_lock(&w->lock);
    bool good = message && tn_question_queue_size(w->questions) + size <= TN_UNTAKEN_MAX;
    if (good)
        good = tn_question_queue_put(w->questions, message, size);
    else
        json_decref(message);
    pthread_cond_signal(&w->questions_come);
    while ((ended = tn_question_queue_ended(w->questions)))
        good = tn_outbox_put_now(w->outbox, ended) && good;
    pthread_mutex_unlock(&w->lock);
    return good;
}

/* ---- the thread of texts */

/* The next message; waits at most so long for it (-1: as long as it takes). NULL: something else is to be done. */
static json_t *next_text(tn_window *w, int milliseconds)
{
    const struct timespec latest = in_milliseconds(milliseconds < 0 ? 0 : milliseconds);
    json_t *message = NULL;
    int late = milliseconds == 0;
    pthread_mutex_lock(&w->lock);
    while (!w->first && !w->left && !w->reviewed && late == 0)
        late = milliseconds < 0 ? pthread_cond_wait(&w->texts_come, &w->lock)
                                : pthread_cond_timedwait(&w->texts_come, &w->lock, &latest);
    parcel *p = w->left ? NULL : w->first;
    if (p) {
        w->first = p->next;
        if (!w->first)
            w->last = &w->first;
        w->waiting -= p->size;
        message = p->message;
        free(p);
    }
    pthread_mutex_unlock(&w->lock);
    return message;
}

static bool is_left(tn_window *w)
{
    pthread_mutex_lock(&w->lock);
    bool left = w->left;
    pthread_mutex_unlock(&w->lock);
    return left;
}

/* On the thread of the review. */
static void note_reviewed(void *context)
{
    tn_window *w = context;
    pthread_mutex_lock(&w->lock);
    w->reviewed = true;
    pthread_cond_signal(&w->texts_come);
    pthread_mutex_unlock(&w->lock);
}

static void end_review(tn_window *w)
{
    tn_review *review = tn_background_join(w->background);
    w->background = NULL;
    w->reviewed = false;
    tn_exchange_reviewed(w->exchange, review);
}

static void take_review(tn_window *w)
{
    pthread_mutex_lock(&w->lock);
    bool reviewed = w->reviewed;
    pthread_mutex_unlock(&w->lock);
    if (reviewed && w->background)
        end_review(w);
}

static void begin_review(tn_window *w)
{
    tn_review *review = tn_exchange_review(w->exchange);
    if (!review)
        return;
    w->background = tn_background_start(review, REVIEW_SECONDS, note_reviewed, w);
    if (!w->background) {
        tn_review_cancel(review);
        tn_exchange_reviewed(w->exchange, review);
    }
}

static bool looks_at_files(tn_window *w)
{
    return w->files.watched_count > 0 || used_files_any(&w->used);
}

/* Those who keep what they read of it are told, and so is the page, whose answers are old. */
static void tell_of_file(tn_window *w, const char *name)
{
    char path[PATH_MAX + 1];
    snprintf(path, sizeof path, "/%s", name);
    char *uri = tn_path_uri(path);
    json_t *message =
        json_pack("{s:s,s:s,s:{s:[{s:s,s:i}]}}", "jsonrpc", "2.0", "method", "workspace/didChangeWatchedFiles",
                  "params", "changes", "uri", uri ? uri : "", "type", CHANGED);
    free(uri);
    tn_exchange_take(w->exchange, message);
    put_question(w, message, 0);
    tn_outbox_put(w->outbox, tn_file_requests_tell(&w->files, name));
}

static void look_at_files(tn_window *w)
{
    size_t next = 0, next_used = 0;
    if (tn_seconds() < w->look || !looks_at_files(w))
        return;
    for (json_t *changed; (changed = tn_file_requests_changed(&w->files, &next));)
        tn_outbox_put(w->outbox, changed);
    for (char *name; (name = used_files_changed(&w->used, &next_used)); free(name))
        tell_of_file(w, name);
    w->look = tn_seconds() + LOOK_MILLISECONDS * 1e-3;
}

static void send_all(tn_window *w)
{
    for (json_t *message; (message = tn_exchange_next(w->exchange));)
        tn_outbox_put(w->outbox, message);
    if (tn_exchange_ended(w->exchange) || tn_exchange_failed(w->exchange))
        call_over(w);
}

static void take_text(tn_window *w, json_t *message)
{
    const char *method = json_string_value(json_object_get(message, "method"));
    if (method && tn_file_requests_takes(method))
        tn_outbox_put(w->outbox, tn_file_requests_answer(&w->files, message));
    else
        tn_exchange_take(w->exchange, message);
    json_decref(message);
}

/* Milliseconds until something is to be done that is no message. */
static int patience_of(tn_window *w)
{
    int patience = tn_exchange_patience(w->exchange);
    return (patience < 0 || patience > LOOK_MILLISECONDS) && looks_at_files(w) ? LOOK_MILLISECONDS : patience;
}

static void *answer_texts(void *context)
{
    tn_window *w = context;
    while (!is_left(w)) {
        json_t *message = next_text(w, 0);
        if (!message) {
            tn_exchange_work(w->exchange);
            begin_review(w);
            send_all(w);
            message = next_text(w, patience_of(w));
        }
        take_review(w);
        if (message)
            take_text(w, message);
        look_at_files(w);
        send_all(w);
    }
    tn_exchange_cancel(w->exchange);
    if (w->background)
        end_review(w);
    let_go(w);
    return NULL;
}

/* ---- the thread of questions */

static void tell(tn_window *w, json_t *value)
{
    tn_outbox_put(w->outbox, json_pack("{s:s,s:s,s:{s:O,s:o}}", "jsonrpc", "2.0", "method", "$/progress", "params",
                                       "token", w->token, "value", value));
}

/* Begins with a title, as the Language Server Protocol has it. */
static void tell_how_far(tn_window *w, double done, double total)
{
    double now = tn_seconds();
    if (!w->token || now - fmax(w->told, w->began) < TOLD_SECONDS)
        return;
    json_t *value = w->told > 0 ? json_pack("{s:s}", "kind", "report")
                                : json_pack("{s:s,s:s}", "kind", "begin", "title", "working");
    if (total > 0)
        json_object_set_new(value, "percentage", json_integer((json_int_t)(100 * fmin(done / total, 1))));
    tell(w, value);
    w->told = now;
}

static bool goes_on(void *context, double done, double total)
{
    tn_window *w = context;
    tell_how_far(w, done, total);
    pthread_mutex_lock(&w->lock);
    bool wanted = !w->left && !tn_question_queue_unwanted(w->questions);
    pthread_mutex_unlock(&w->lock);
    w->late = w->late || tn_seconds() - w->began > TN_QUESTION_SECONDS_MAX;
    return wanted && !w->late;
}

static const json_t *next_question(tn_window *w)
{
    const json_t *message = NULL;
    pthread_mutex_lock(&w->lock);
    while (!w->left && !(message = tn_question_queue_next(w->questions)))
        pthread_cond_wait(&w->questions_come, &w->lock);
    pthread_mutex_unlock(&w->lock);
    return message;
}

/* The text of what the desk says; NULL: nothing. */
static char *ask(tn_window *w, const json_t *message)
{
    char *response = NULL;
    tartan_watch watch = tartan_watch_init();
    watch.go_on = goes_on;
    watch.context = w;
    watch.memory_limit = w->all->memory_limit;
    w->began = tn_seconds();
    w->late = false;
    w->token = json_object_get(json_object_get(message, "params"), "workDoneToken");
    w->told = 0;
    bool answered = tn_desk_take(w->desk, message, &watch, &response) == TN_OK;
    if (w->told > 0)
        tell(w, json_pack("{s:s}", "kind", "end"));
    return answered ? response : NULL;
}

/* If the desk has none: why. */
static json_t *answer_instead(const tn_window *w, const json_t *id, const char *response)
{
    if (id && w->late)
        return failure(id, REQUEST_FAILED,
                       "this takes longer than two minutes: the commands of `tartan` have no such limit");
    return id && !response ? failure(id, INTERNAL_ERROR, "out of memory") : NULL;
}

/* What goes before the answer. */
static void send_bytes(tn_window *w)
{
    size_t size;
    for (uint8_t *bytes; (bytes = tn_desk_bytes(w->desk, &size));)
        tn_outbox_put_bytes(w->outbox, bytes, size);
}

static void *answer_questions(void *context)
{
    tn_window *w = context;
    for (const json_t *message; (message = next_question(w));) {
        char *response = ask(w, message);
        json_t *instead = answer_instead(w, json_object_get(message, "id"), response), *ended;
        pthread_mutex_lock(&w->lock);
        ended = tn_question_queue_done(w->questions);
        pthread_mutex_unlock(&w->lock);
        if (ended || instead) {
            free(response);
            response = NULL;
        }
        if (ended) {
            json_decref(instead);
            instead = ended;
        }
        tn_outbox_put(w->outbox, instead);
        if (response)
            send_bytes(w);
        tn_outbox_put_text(w->outbox, response);
    }
    let_go(w);
    return NULL;
}

/* ---- the socket */

static bool start(tn_window *w, void *(*run)(void *context))
{
    pthread_t thread;
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0)
        return false;
    pthread_attr_setstacksize(&attributes, THREAD_STACK);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    w->users++;
    bool started = pthread_create(&thread, &attributes, run, w) == 0;
    pthread_attr_destroy(&attributes);
    if (!started)
        let_go(w);
    return started;
}

tn_window *tn_window_open(tn_windows *windows, void (*woken)(void *context), void *context)
{
    tn_error error;
    tn_window *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    count_window(windows, true);
    w->all = windows;
    w->users = 1;
    w->last = &w->first;
    used_files_begin(&w->used, windows->folder);
    w->served = used_files_served(&w->used);
    w->files = (tn_file_requests){.folder = windows->folder, .open = windows->open};
    pthread_mutex_init(&w->lock, NULL);
    begin_condition(&w->texts_come);
    begin_condition(&w->questions_come);
    w->outbox = tn_outbox_new(woken, context);
    w->questions = tn_question_queue_new();
    if (w->outbox && w->questions && tn_exchange_new(&w->served, &w->exchange, &error) == TN_OK &&
        tn_desk_new(&w->served, &w->desk, &error) == TN_OK && start(w, answer_texts) && start(w, answer_questions))
        return w;
    tn_window_leave(w);
    return NULL;
}

static bool put_text(tn_window *w, json_t *message, size_t size)
{
    parcel *p = message ? malloc(sizeof *p) : NULL;
    if (!p) {
        json_decref(message);
        return false;
    }
    *p = (parcel){NULL, message, size};
    pthread_mutex_lock(&w->lock);
    bool room = w->waiting + size <= TN_UNTAKEN_MAX;
    if (room) {
        *w->last = p;
        w->last = &p->next;
        w->waiting += size;
        pthread_cond_signal(&w->texts_come);
    }
    pthread_mutex_unlock(&w->lock);
    if (!room) {
        json_decref(message);
        free(p);
    }
    return room;
}

/* Texts that are open, or files that are not. */
static bool changes_a_text(const char *method)
{
    return strcmp(method, "textDocument/didOpen") == 0 || strcmp(method, "textDocument/didChange") == 0 ||
           strcmp(method, "textDocument/didClose") == 0 || strcmp(method, "workspace/didChangeWatchedFiles") == 0;
}

static bool is_question(const char *method)
{
    return strcmp(method, "$/cancelRequest") == 0 ||
           (strncmp(method, "tartan/", strlen("tartan/")) == 0 && !tn_file_requests_takes(method));
}

/* Who answers it? Each thread has a copy of its own. */
static bool hand_out(tn_window *w, json_t *message, size_t size)
{
    const char *said = json_string_value(json_object_get(message, "method")), *method = said ? said : "";
    if (changes_a_text(method))
        return put_question(w, json_deep_copy(message), size) & put_text(w, message, size);
    return is_question(method) ? put_question(w, message, size) : put_text(w, message, size);
}

bool tn_window_take(tn_window *window, const char *text, size_t size)
{
    json_error_t error;
    json_t *message = json_loadb(text, size, 0, &error);
    if (json_is_object(message))
        return hand_out(window, message, size);
    json_t *refusal = message ? failure(NULL, INVALID_REQUEST, "a message is to be a JSON object")
                              : failure(NULL, PARSE_ERROR, error.text);
    json_decref(message);
    return tn_outbox_put_now(window->outbox, refusal);
}

tn_outbox *tn_window_outbox(tn_window *window)
{
    return window->outbox;
}

bool tn_window_over(tn_window *window)
{
    pthread_mutex_lock(&window->lock);
    bool over = window->over;
    pthread_mutex_unlock(&window->lock);
    return over;
}

void tn_window_leave(tn_window *window)
{
    if (window->outbox)
        tn_outbox_close(window->outbox);
    pthread_mutex_lock(&window->lock);
    window->left = true;
    pthread_cond_broadcast(&window->texts_come);
    pthread_cond_broadcast(&window->questions_come);
    pthread_mutex_unlock(&window->lock);
    let_go(window);
}
