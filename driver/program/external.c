/* Asks processes of a program, and has them started, timed and ended. */
#include "driver/program/external.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "driver/program/keeper.h"
#include "driver/program/process.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/watch.h"

#define TICK_MS 50 /* how often a watch is looked at */

typedef struct asked {
    tn_process process;
    bool repeats_ids; /* so that several lines can be on their way */
} asked;

struct tn_external {
    tn_external_options options;
    char *path, *folder; /* owned */
    asked *of;           /* [threads] */
    tn_keeper keeper;
    atomic_bool answers;  /* it has answered something that could be understood */
    atomic_uint failures; /* till then */
};

/* ---- making and freeing */

static tn_status make_folder(tn_external *p, tn_error *error)
{
    const char *under = getenv("TMPDIR");
    under = under && *under ? under : "/tmp";
    char *whole = realpath(under, NULL); /* programs run in other folders */
    if (!whole)
        return tn_cannot_make(under, errno, error);
    if (asprintf(&p->folder, "%s/tartan-XXXXXX", whole) < 0)
        p->folder = NULL;
    free(whole);
    if (!p->folder)
        return tn_fail_memory(error);
    if (mkdtemp(p->folder))
        return TN_OK;
    int reason = errno;
    tn_status status = tn_cannot_make(p->folder, reason, error);
    free(p->folder);
    p->folder = NULL;
    return status;
}

static tn_status check_file(const char *path, tn_error *error)
{
    if (access(path, X_OK) == 0)
        return TN_OK;
    tn_fail(error, TN_IO, E_PROGRAM_START, "the program %.300s cannot be run: %s", path, strerror(errno));
    if (errno == EACCES)
        tn_error_help(error, "make it executable: chmod +x %.250s", path);
    return TN_IO;
}

tn_status tn_external_new(const tn_external_options *options, tn_external **program, tn_error *error)
{
    tn_external *p = calloc(1, sizeof *p);
    *program = NULL;
    if (!p)
        return tn_fail_memory(error);
    p->options = *options;
    p->path = strdup(options->path);
    p->of = calloc(options->threads, sizeof *p->of);
    tn_status status = p->path && p->of ? check_file(p->path, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = make_folder(p, error);
    if (status == TN_OK && (status = tn_keeper_start(options->threads, p->folder, &p->keeper, error)) != TN_OK)
        tn_folder_remove(p->folder);
    if (status == TN_OK)
        *program = p;
    else
        tn_external_free(p);
    return status;
}

static void end_process(tn_external *p, unsigned thread, bool polite, int *status)
{
    int ended = tn_process_end(&p->of[thread].process, polite);
    tn_keeper_tell(&p->keeper, thread, 0);
    if (status)
        *status = ended;
}

void tn_external_free(tn_external *p)
{
    if (!p)
        return;
    bool polite = !tn_watch_stopped(p->options.watch);
    for (unsigned t = 0; p->keeper.pid && t < p->options.threads; t++)
        tn_process_close(&p->of[t].process); /* all of them at once */
    for (unsigned t = 0; p->keeper.pid && t < p->options.threads; t++)
        end_process(p, t, polite, NULL);
    tn_keeper_end(&p->keeper);
    free(p->of);
    free(p->path);
    free(p->folder);
    free(p);
}

const char *tn_external_folder(const tn_external *program)
{
    return program->folder;
}

const char *tn_external_path(const tn_external *program)
{
    return program->path;
}

tn_status tn_external_useless(const tn_external *p, uint64_t id, const char *refusal, tn_error *error)
{
    if (id == UINT64_MAX)
        tn_fail(error, TN_INVALID, E_PROGRAM_ANSWERS,
                "the program %.200s scores nothing: asked about %u individuals, it %.180s", p->path,
                TN_EXTERNAL_PATIENCE, refusal);
    else
        tn_fail(error, TN_INVALID, E_PROGRAM_ANSWERS,
                "the program %.200s scores nothing: asked about individual %" PRIu64 ", it %.180s", p->path, id,
                refusal);
    tn_error_help(error, "try it by hand: it reads a line of JSON and writes a number, and must write it at once");
    return TN_INVALID;
}

/* ---- asking */

typedef struct asking {
    tn_external *program;
    unsigned thread;
    asked *of;
    tn_question *questions;
    size_t count, sent; /* those on their way: sent, and not done */
    char *outgoing;     /* what is not written yet of them */
    size_t outgoing_size, outgoing_room;
    double since; /* when the wait for the next answer began */
} asking;

/* The first that is on its way, or, with `waiting`, that is to be sent; NULL: none. */
static tn_question *first(const asking *a, bool waiting)
{
    for (size_t i = 0; i < a->count; i++)
        if (!a->questions[i].done && a->questions[i].sent != waiting)
            return &a->questions[i];
    return NULL;
}

static void finish(asking *a, tn_question *q)
{
    if (q->answer.understood)
        a->program->answers = true;
    else
        a->program->failures++;
    q->done = true;
    q->sent = false;
    a->sent--;
    a->since = tn_seconds();
}

__attribute__((format(printf, 3, 4))) static void fail_question(asking *a, tn_question *q, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(q->answer.refusal, sizeof q->answer.refusal, format, args);
    va_end(args);
    finish(a, q);
}

static tn_status start(asking *a, tn_error *error)
{
    tn_status status = tn_process_start(a->program->path, &a->of->process, error);
    if (status == TN_OK)
        tn_keeper_tell(&a->program->keeper, a->thread, a->of->process.pid);
    a->of->repeats_ids = false;
    return status;
}

static tn_status send(asking *a, tn_question *q, tn_error *error)
{
    if (!tn_array_reserve_from(&a->outgoing, &a->outgoing_room, 1024, a->outgoing_size, q->size, 1))
        return tn_fail_memory(error);
    memcpy(a->outgoing + a->outgoing_size, q->line, q->size);
    a->outgoing_size += q->size;
    q->sent = true;
    if (a->sent++ == 0)
        a->since = tn_seconds();
    return TN_OK;
}

/* One at a time, until answers say whom they are about. What has been asked before is asked alone. */
static tn_status send_more(asking *a, tn_error *error)
{
    tn_status status = TN_OK;
    for (tn_question *q; status == TN_OK && (q = first(a, true));) {
        const tn_question *other = first(a, false);
        if (other && (!a->of->repeats_ids || q->tries || other->tries))
            break;
        status = send(a, q, error);
    }
    return status;
}

/* The process is done with, for a reason such as "ended with status 1". Whoever was asked alone for the second time, or
 * has had its time, has failed; the others are asked again. */
static void give_up(asking *a, const char *reason, bool at_once)
{
    char words[120];
    tn_process_last_words(&a->of->process, words, sizeof words);
    bool alone = a->sent == 1;
    a->outgoing_size = 0;
    for (size_t i = 0; i < a->count; i++) {
        tn_question *q = &a->questions[i];
        if (!q->sent)
            continue;
        q->tries++;
        if (alone && (at_once || q->tries > 1)) {
            fail_question(a, q, words[0] ? "%s: %s" : "%s", reason, words);
        } else {
            q->sent = false;
            a->sent--;
        }
    }
}

static void end_and_give_up(asking *a, const char *why, bool at_once)
{
    int status = 0;
    char reason[80];
    end_process(a->program, a->thread, !why, &status);
    if (why)
        snprintf(reason, sizeof reason, "%s", why);
    else if (WIFSIGNALED(status))
        snprintf(reason, sizeof reason, "was ended by signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status))
        snprintf(reason, sizeof reason, "ended with status %d instead of an answer", WEXITSTATUS(status));
    else
        snprintf(reason, sizeof reason, "ended without an answer");
    give_up(a, reason, at_once);
}

static tn_status unasked(const asking *a, const char *text, size_t size, tn_error *error)
{
    char shown[80];
    const char *end = memchr(text, '\n', size);
    tn_clean_copy(shown, sizeof shown, text, end ? (size_t)(end - text) : size);
    tn_fail(error, TN_INVALID, E_PROGRAM_ANSWERS,
            "the program %.200s answered `%s`, and was not asked: its answers cannot be told apart", a->program->path,
            shown);
    tn_error_help(error, "it must write one line for each line that it reads");
    return TN_INVALID;
}

/* Whom an answer is about: whom it names, or the only one asked; NULL: nobody. */
static tn_question *find_question(const asking *a, const tn_answer *answer)
{
    if (!answer->says_id)
        return a->sent == 1 ? first(a, false) : NULL;
    for (size_t i = 0; i < a->count; i++)
        if (a->questions[i].sent && a->questions[i].id == answer->id)
            return &a->questions[i];
    return NULL;
}

static tn_status take_answers(asking *a, tn_error *error)
{
    size_t size;
    for (const char *line; (line = tn_process_line(&a->of->process, &size));) {
        tn_answer answer;
        tn_answer_read(line, size, a->program->options.values, &answer);
        tn_question *q = find_question(a, &answer);
        if (!q)
            return unasked(a, line, size, error);
        q->answer = answer;
        a->of->repeats_ids = answer.says_id;
        finish(a, q);
        tn_process_take(&a->of->process, size);
    }
    return TN_OK;
}

/* One wait for what comes, and what it brings. */
static tn_status turn(asking *a, tn_error *error)
{
    tn_process *process = &a->of->process;
    tn_status status = tn_watch_check(a->program->options.watch, error);
    if (status != TN_OK)
        return status;
    size_t written = a->outgoing_size ? tn_process_write(process, a->outgoing, a->outgoing_size) : 0;
    a->outgoing_size -= written;
    if (written)
        memmove(a->outgoing, a->outgoing + written, a->outgoing_size);
    tn_process_wait(process, a->outgoing_size && process->in >= 0, TICK_MS);
    status = take_answers(a, error);
    if (status != TN_OK || a->sent == 0)
        return status;
    char late[60];
    snprintf(late, sizeof late, "gave no answer within %u second%s", a->program->options.seconds,
             a->program->options.seconds == 1 ? "" : "s");
    if (process->over)
        end_and_give_up(a, NULL, false);
    else if (tn_process_overlong(process))
        end_and_give_up(a, "gave an answer of more than 65536 bytes", true);
    else if (tn_seconds() - a->since > a->program->options.seconds)
        end_and_give_up(a, late, true);
    return TN_OK;
}

/* A program that does not work at all is not asked about everybody. */
static tn_status lose_patience(const asking *a, tn_error *error)
{
    const tn_external *p = a->program;
    const tn_question *last = NULL;
    if (p->answers || p->failures < TN_EXTERNAL_PATIENCE)
        return TN_OK;
    for (size_t i = 0; i < a->count; i++)
        if (a->questions[i].done && !a->questions[i].answer.understood)
            last = &a->questions[i];
    if (!last)
        return TN_OK;
    return tn_external_useless(p, UINT64_MAX, last->answer.refusal, error);
}

/* Lines that nobody asked for show that answers are not those of their questions. */
static tn_status look_for_unasked(asking *a, tn_error *error)
{
    tn_process *process = &a->of->process;
    if (!process->pid)
        return TN_OK;
    tn_process_wait(process, false, 0);
    if (process->unread_size)
        return unasked(a, process->unread, process->unread_size, error);
    if (process->over)
        end_process(a->program, a->thread, true, NULL);
    return TN_OK;
}

tn_status tn_external_ask(tn_external *program, unsigned thread, tn_question *questions, size_t count, tn_error *error)
{
    asking a = {
        .program = program, .thread = thread, .of = &program->of[thread], .questions = questions, .count = count};
    tn_status status = look_for_unasked(&a, error);
    while (status == TN_OK && (first(&a, true) || a.sent)) {
        if (!a.of->process.pid)
            status = start(&a, error);
        if (status == TN_OK)
            status = send_more(&a, error);
        if (status == TN_OK)
            status = turn(&a, error);
        if (status == TN_OK)
            status = lose_patience(&a, error);
    }
    if (status == TN_OK)
        status = look_for_unasked(&a, error);
    if (status != TN_OK)
        end_process(program, thread, false, NULL);
    free(a.outgoing);
    return status;
}
