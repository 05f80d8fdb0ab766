/* Ends processes and removes a folder when the program that started them is gone. */
#include "driver/program/keeper.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* What the keeper is told. Smaller than what a pipe takes whole. */
typedef struct message {
    unsigned slot;
    pid_t group;
} message;

static int remove_entry(const char *path, const struct stat *known, int kind, struct FTW *place)
{
    (void)known, (void)kind, (void)place;
    remove(path);
    return 0;
}

void tn_folder_remove(const char *path)
{
    nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

ssize_t tn_write_quietly(int file, const void *bytes, size_t size)
{
    sigset_t broken, before, waiting;
    sigemptyset(&broken);
    sigaddset(&broken, SIGPIPE);
    sigpending(&waiting);
    pthread_sigmask(SIG_BLOCK, &broken, &before);
    ssize_t written = write(file, bytes, size);
    int reason = errno;
    const struct timespec at_once = {0};
    if (written < 0 && reason == EPIPE && !sigismember(&waiting, SIGPIPE))
        sigtimedwait(&broken, NULL, &at_once);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return written;
}

/* ---- in the process of its own */

static void leave_files(int but)
{
    long most = sysconf(_SC_OPEN_MAX);
    if (most < 0 || most > 65536)
        most = 65536;
    for (int file = 0; file < most; file++)
        if (file != but)
            close(file);
}

static void ignore_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGUSR1};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        signal(numbers[i], SIG_IGN);
}

static _Noreturn void keep(int told, pid_t *groups, unsigned slots, const char *folder)
{
    message m;
    ssize_t got;
    setsid();
    ignore_signals();
    leave_files(told);
    while ((got = read(told, &m, sizeof m)) != 0)
        if (got == (ssize_t)sizeof m && m.slot < slots)
            groups[m.slot] = m.group;
    for (unsigned i = 0; i < slots; i++)
        if (groups[i] > 0)
            kill(-groups[i], SIGKILL);
    tn_folder_remove(folder);
    for (int tries = 0; access(folder, F_OK) == 0 && tries < 20; tries++) { /* what was killed may have been writing */
        nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
        tn_folder_remove(folder);
    }
    free(groups);
    _exit(0);
}

/* ---- */

tn_status tn_keeper_start(unsigned slots, const char *folder, tn_keeper *keeper, tn_error *error)
{
    int ends[2];
    pid_t *groups = calloc(slots, sizeof *groups);
    *keeper = (tn_keeper){0};
    if (!groups)
        return tn_fail_memory(error);
    if (pipe2(ends, O_CLOEXEC) != 0) {
        free(groups);
        return tn_fail(error, TN_IO, E_PROGRAM_START, "there is no pipe to a program: %s", strerror(errno));
    }
    pid_t pid = fork();
    if (pid == 0)
        keep(ends[0], groups, slots, folder);
    int reason = errno;
    free(groups);
    close(ends[0]);
    if (pid < 0) {
        close(ends[1]);
        return tn_fail(error, TN_IO, E_PROGRAM_START, "no process can be started: %s", strerror(reason));
    }
    *keeper = (tn_keeper){pid, ends[1]};
    return TN_OK;
}

void tn_keeper_tell(const tn_keeper *keeper, unsigned slot, pid_t group)
{
    message m;
    memset(&m, 0, sizeof m);
    m.slot = slot;
    m.group = group;
    tn_write_quietly(keeper->pipe, &m, sizeof m);
}

void tn_keeper_end(tn_keeper *keeper)
{
    if (!keeper->pid)
        return;
    close(keeper->pipe);
    while (waitpid(keeper->pid, NULL, 0) < 0 && errno == EINTR)
        ;
    *keeper = (tn_keeper){0};
}
