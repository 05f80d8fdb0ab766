/* Asks processes of a program, and has them started, timed and ended. */
#include "driver/program/external.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <jansson.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "driver/program/keeper.h"
#include "runtime/base/array.h"
#include "runtime/base/error.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"
#include "runtime/base/watch.h"

#define TN_ANSWER_BYTES 65536u /* the longest line that is an answer */

/* Zero it to begin with: nothing runs. */
typedef struct tn_process {
    pid_t pid; /* and its group; 0: none */
    int in, out, err;
    char *unread; /* [TN_ANSWER_BYTES]: what came, and was not taken; owned */
    size_t unread_size;
    char said[240]; /* the end of what it said on standard error */
    size_t said_size;
    bool over; /* its output has ended */
} tn_process;

static bool process_overlong(const tn_process *process);

/* ---- reading answers */

#define SHOWN 60u /* bytes of an answer that are shown */

/* Copies bytes as they can be shown, in at most `room` bytes and its end. */
static void clean_copy(char *to, size_t room, const char *text, size_t size)
{
    size_t shown = size < SHOWN ? size : SHOWN;
    FILE *out = fmemopen(to, room, "w");
    to[0] = '\0';
    if (!out)
        return; /* then nothing is shown */
    while (shown < size && shown > 0 && ((unsigned char)text[shown] & 0xC0) == 0x80)
        shown--; /* no part of a letter */
    tn_write_clean(out, text, shown);
    fputs(shown < size ? "..." : "", out);
    fclose(out);
    to[room - 1] = '\0';
}

static void refuse(tn_answer *answer, const char *line, size_t size, const char *why)
{
    char shown[TN_REFUSAL_SIZE - 80];
    clean_copy(shown, sizeof shown, line, size);
    if (shown[0])
        snprintf(answer->refusal, sizeof answer->refusal, "answered `%s`, %s", shown, why);
    else
        snprintf(answer->refusal, sizeof answer->refusal, "answered with an empty line, %s", why);
}

/* False where it is neither a number nor a list of `count` of them. */
static bool take_values(const json_t *score, size_t count, double *values)
{
    if (json_is_number(score) && count == 1) {
        values[0] = json_number_value(score);
        return true;
    }
    if (!json_is_array(score) || json_array_size(score) != count)
        return false;
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(score, i);
        if (!json_is_number(value))
            return false;
        values[i] = json_number_value(value);
    }
    return true;
}

static void take_id(const json_t *json, tn_answer *answer)
{
    const json_t *id = json_object_get(json, "id");
    answer->says_id = json_is_integer(id) && json_integer_value(id) >= 0;
    if (answer->says_id)
        answer->id = (uint64_t)json_integer_value(id);
}

static void say_wanted(tn_answer *answer, const char *line, size_t size, size_t count)
{
    char why[80];
    if (count == 1)
        snprintf(why, sizeof why, "and one number is wanted");
    else
        snprintf(why, sizeof why, "and a list of %zu numbers is wanted", count);
    refuse(answer, line, size, why);
}

void tn_answer_read(const char *line, size_t size, size_t count, tn_answer *answer)
{
    json_t *json = json_loadb(line, size, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, NULL);
    *answer = (tn_answer){0};
    take_id(json, answer);
    const json_t *score = json_is_object(json) ? json_object_get(json, "score") : json;
    const char *said = json_string_value(json_object_get(json, "error"));
    bool valued = json && !said && take_values(score, count, answer->values);
    answer->understood = said || valued;
    if (!json) {
        refuse(answer, line, size, "which is not JSON");
    } else if (said) {
        char shown[TN_REFUSAL_SIZE - 40];
        clean_copy(shown, sizeof shown, said, strlen(said));
        snprintf(answer->refusal, sizeof answer->refusal, "says: %s", shown);
    } else if (!valued) {
        say_wanted(answer, line, size, count);
    }
    json_decref(json);
}

/* ---- one running program: its input, its answers line by line, and the end of what it says on standard error
 *
 * Its files never block. Used by one thread at a time. */

#define POLITE_MS 1000 /* that a program has for ending by itself */

extern char **environ;

/* ---- starting */

static int set_up(posix_spawn_file_actions_t *actions, const char *folder, int in, int out, int err)
{
    int failed = posix_spawn_file_actions_addchdir_np(actions, folder);
    failed = failed ? failed : posix_spawn_file_actions_adddup2(actions, in, STDIN_FILENO);
    failed = failed ? failed : posix_spawn_file_actions_adddup2(actions, out, STDOUT_FILENO);
    return failed ? failed : posix_spawn_file_actions_adddup2(actions, err, STDERR_FILENO);
}

/* Signals are as in a new program, whatever is done with them here. */
static int set_attributes(posix_spawnattr_t *attributes)
{
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    int failed =
        posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    failed = failed ? failed : posix_spawnattr_setpgroup(attributes, 0);
    failed = failed ? failed : posix_spawnattr_setsigdefault(attributes, &all);
    return failed ? failed : posix_spawnattr_setsigmask(attributes, &none);
}

static int spawn(const char *path, const char *folder, const int files[3], pid_t *pid)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    char *word = strdup(path), *const words[] = {word, NULL};
    if (!word || posix_spawn_file_actions_init(&actions) != 0) {
        free(word);
        return ENOMEM;
    }
    int failed = posix_spawnattr_init(&attributes);
    if (failed == 0) {
        failed = set_up(&actions, folder, files[0], files[1], files[2]);
        failed = failed ? failed : set_attributes(&attributes);
        failed = failed ? failed : posix_spawn(pid, path, &actions, &attributes, words, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    free(word);
    return failed;
}

static void close_file(int *file)
{
    if (*file >= 0)
        close(*file);
    *file = -1;
}

static void close_pair(int pair[2])
{
    close_file(&pair[0]);
    close_file(&pair[1]);
}

static int start_at(const char *path, const char *folder, tn_process *p)
{
    int in[2] = {-1, -1}, out[2] = {-1, -1}, err[2] = {-1, -1};
    bool made = pipe2(in, O_CLOEXEC) == 0 && pipe2(out, O_CLOEXEC) == 0 && pipe2(err, O_CLOEXEC) == 0;
    int failed = made ? spawn(path, folder, (const int[]){in[0], out[1], err[1]}, &p->pid) : errno;
    if (failed) {
        close_pair(in);
        close_pair(out);
        close_pair(err);
        p->pid = 0;
        return failed;
    }
    close(in[0]);
    close(out[1]);
    close(err[1]);
    p->in = in[1];
    p->out = out[0];
    p->err = err[0];
    const int own[] = {p->in, p->out, p->err};
    for (size_t i = 0; i < 3; i++)
        fcntl(own[i], F_SETFL, O_NONBLOCK);
    return 0;
}

/* Runs the file at `path`, a whole path, in its folder, as a group of its own. E1254 (TN_IO) where that fails. */
static tn_status process_start(const char *path, tn_process *process, tn_error *error)
{
    *process = (tn_process){.unread = malloc(TN_ANSWER_BYTES)};
    char *folder = strdup(path), *slash = folder ? strrchr(folder, '/') : NULL;
    if (slash)
        slash[slash == folder] = '\0';
    int failed = process->unread && slash ? start_at(path, folder, process) : ENOMEM;
    free(folder);
    if (failed == 0)
        return TN_OK;
    free(process->unread);
    process->unread = NULL;
    tn_fail(error, TN_IO, E_PROGRAM_START, "the program %.300s cannot be started: %s", path, strerror(failed));
    if (failed == ENOEXEC || failed == ENOENT)
        tn_error_help(error, "a script begins with a line that names its interpreter, as #!/bin/sh");
    return TN_IO;
}

/* ---- reading and writing */

static void hear_out(tn_process *p)
{
    size_t room = TN_ANSWER_BYTES - p->unread_size;
    ssize_t got = room ? read(p->out, p->unread + p->unread_size, room) : -1;
    if (got > 0)
        p->unread_size += (size_t)got;
    else if (got == 0)
        p->over = true;
}

/* Only the end of it is kept. What `read` returns. */
static ssize_t hear_err(tn_process *p)
{
    char bytes[4096];
    ssize_t got = read(p->err, bytes, sizeof bytes);
    if (got <= 0)
        return got;
    size_t size = (size_t)got, room = sizeof p->said;
    const char *end = bytes + size;
    size = size < room ? size : room;
    size_t stays = p->said_size + size <= room ? p->said_size : room - size;
    memmove(p->said, p->said + p->said_size - stays, stays);
    memcpy(p->said + stays, end - size, size);
    p->said_size = stays + size;
    return got;
}

/* Waits at most so many milliseconds for answers, and, with `writes`, for room in its input; takes in what comes. */
static void process_wait(tn_process *p, bool writes, int milliseconds)
{
    struct pollfd files[] = {{p->over || process_overlong(p) ? -1 : p->out, POLLIN, 0},
                             {p->err, POLLIN, 0},
                             {writes ? p->in : -1, POLLOUT, 0}};
    if (poll(files, 3, milliseconds) <= 0)
        return;
    if (files[1].revents && hear_err(p) == 0)
        close_file(&p->err);
    if (files[0].revents)
        hear_out(p);
}

/* Writes as much as there is room for: how many bytes. It is no error here if nobody reads them: that shows in the
 * answers. */
static size_t process_write(tn_process *p, const char *bytes, size_t size)
{
    if (p->in < 0)
        return 0;
    ssize_t written = tn_write_quietly(p->in, bytes, size);
    if (written >= 0)
        return (size_t)written;
    if (errno == EPIPE) /* it reads no more; it may answer all the same */
        close_file(&p->in);
    return 0;
}

/* The line that has come first, without its end; NULL where none is whole. Take it before the next call. A line without
 * an end counts where the output has ended. */
static const char *process_line(const tn_process *p, size_t *size)
{
    const char *end = p->unread_size ? memchr(p->unread, '\n', p->unread_size) : NULL;
    *size = end ? (size_t)(end - p->unread) : p->unread_size;
    return end || (p->over && p->unread_size) ? p->unread : NULL;
}

static void process_take(tn_process *p, size_t size)
{
    size += size < p->unread_size; /* the line's end too */
    p->unread_size -= size;
    memmove(p->unread, p->unread + size, p->unread_size);
}

/* A line that is longer than an answer can be has come. */
static bool process_overlong(const tn_process *p)
{
    return p->unread_size == TN_ANSWER_BYTES && !memchr(p->unread, '\n', p->unread_size);
}

/* ---- ending */

static bool gone(pid_t pid, int *status)
{
    return waitpid(pid, status, WNOHANG) == pid;
}

/* What it still says is read, so that it need not wait for that. */
static bool wait_for_end(tn_process *p, int *status)
{
    for (int waited = 0; waited < POLITE_MS; waited += 10) {
        if (gone(p->pid, status))
            return true;
        p->unread_size = 0;
        process_wait(p, false, 10);
        if (p->over && p->err < 0) /* then nothing is waited for, above */
            nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    }
    return false;
}

/* Closes its input, by which it knows that nothing more is asked. */
static void process_close(tn_process *p)
{
    if (p->pid)
        close_file(&p->in);
}

/* Closes its input, and waits a moment for its end if it is polite; then ends its group. Its exit status, as waitpid
 * gives it. */
static int process_end(tn_process *p, bool polite)
{
    int status = 0;
    if (!p->pid)
        return 0;
    process_close(p);
    bool ended = polite && wait_for_end(p, &status);
    kill(-p->pid, SIGKILL); /* whatever it has started is ended with it */
    while (!ended && waitpid(p->pid, &status, 0) < 0 && errno == EINTR)
        ;
    while (p->err >= 0 && hear_err(p) > 0)
        ;
    close_file(&p->out);
    close_file(&p->err);
    free(p->unread);
    p->unread = NULL;
    p->unread_size = 0;
    p->pid = 0;
    return status;
}

/* The last line that it said on standard error, in `room` bytes; empty where it said nothing. */
static void process_last_words(const tn_process *p, char *text, size_t room)
{
    size_t end = p->said_size;
    while (end > 0 && (p->said[end - 1] == '\n' || p->said[end - 1] == ' '))
        end--;
    size_t begin = end;
    while (begin > 0 && p->said[begin - 1] != '\n')
        begin--;
    clean_copy(text, room, p->said + begin, end - begin);
}

/* ---- the processes of a program, started, timed and ended */

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
    int ended = process_end(&p->of[thread].process, polite);
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
        process_close(&p->of[t].process); /* all of them at once */
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
    tn_status status = process_start(a->program->path, &a->of->process, error);
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
    process_last_words(&a->of->process, words, sizeof words);
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
    clean_copy(shown, sizeof shown, text, end ? (size_t)(end - text) : size);
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
    for (const char *line; (line = process_line(&a->of->process, &size));) {
        tn_answer answer;
        tn_answer_read(line, size, a->program->options.values, &answer);
        tn_question *q = find_question(a, &answer);
        if (!q)
            return unasked(a, line, size, error);
        q->answer = answer;
        a->of->repeats_ids = answer.says_id;
        finish(a, q);
        process_take(&a->of->process, size);
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
    size_t written = a->outgoing_size ? process_write(process, a->outgoing, a->outgoing_size) : 0;
    a->outgoing_size -= written;
    if (written)
        memmove(a->outgoing, a->outgoing + written, a->outgoing_size);
    process_wait(process, a->outgoing_size && process->in >= 0, TICK_MS);
    status = take_answers(a, error);
    if (status != TN_OK || a->sent == 0)
        return status;
    char late[60];
    snprintf(late, sizeof late, "gave no answer within %u second%s", a->program->options.seconds,
             a->program->options.seconds == 1 ? "" : "s");
    if (process->over)
        end_and_give_up(a, NULL, false);
    else if (process_overlong(process))
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
    process_wait(process, false, 0);
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
