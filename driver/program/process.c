/* Runs a program with pipes to its standard files. */
#include "driver/program/process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "driver/program/answer.h"
#include "driver/program/keeper.h"

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
    int failed = posix_spawnattr_setflags(attributes,
                                          POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
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

static int start(const char *path, const char *folder, tn_process *p)
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

tn_status tn_process_start(const char *path, tn_process *process, tn_error *error)
{
    *process = (tn_process){.unread = malloc(TN_ANSWER_BYTES)};
    char *folder = strdup(path), *slash = folder ? strrchr(folder, '/') : NULL;
    if (slash)
        slash[slash == folder] = '\0';
    int failed = process->unread && slash ? start(path, folder, process) : ENOMEM;
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

void tn_process_wait(tn_process *p, bool writes, int milliseconds)
{
    struct pollfd files[] = {{p->over || tn_process_overlong(p) ? -1 : p->out, POLLIN, 0},
                             {p->err, POLLIN, 0},
                             {writes ? p->in : -1, POLLOUT, 0}};
    if (poll(files, 3, milliseconds) <= 0)
        return;
    if (files[1].revents && hear_err(p) == 0)
        close_file(&p->err);
    if (files[0].revents)
        hear_out(p);
}

size_t tn_process_write(tn_process *p, const char *bytes, size_t size)
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

const char *tn_process_line(const tn_process *p, size_t *size)
{
    const char *end = p->unread_size ? memchr(p->unread, '\n', p->unread_size) : NULL;
    *size = end ? (size_t)(end - p->unread) : p->unread_size;
    return end || (p->over && p->unread_size) ? p->unread : NULL;
}

void tn_process_take(tn_process *p, size_t size)
{
    size += size < p->unread_size; /* the line's end too */
    p->unread_size -= size;
    memmove(p->unread, p->unread + size, p->unread_size);
}

bool tn_process_overlong(const tn_process *p)
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
        tn_process_wait(p, false, 10);
        if (p->over && p->err < 0) /* then nothing is waited for, above */
            nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    }
    return false;
}

void tn_process_close(tn_process *p)
{
    if (p->pid)
        close_file(&p->in);
}

int tn_process_end(tn_process *p, bool polite)
{
    int status = 0;
    if (!p->pid)
        return 0;
    tn_process_close(p);
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

void tn_process_last_words(const tn_process *p, char *text, size_t room)
{
    size_t end = p->said_size;
    while (end > 0 && (p->said[end - 1] == '\n' || p->said[end - 1] == ' '))
        end--;
    size_t begin = end;
    while (begin > 0 && p->said[begin - 1] != '\n')
        begin--;
    tn_clean_copy(text, room, p->said + begin, end - begin);
}
