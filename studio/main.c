/* tartan-studio: serves a folder to a browser, as `tartan studio` asks. */
#include <errno.h>
#include <libgen.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/program.h"
#include "cli/studio/studio.h"
#include "runtime/base/file.h"
#include "studio/server/server.h"

extern char **environ;

static void say_none(void)
{
    fputs("note: no browser was opened here: open the address above in one\n", stderr);
}

/* With the signals as programs expect them to be, and nothing on our standard output. */
static bool start(const char *address, pid_t *child)
{
    char program[] = "xdg-open", copy[256];
    snprintf(copy, sizeof copy, "%s", address);
    char *words[] = {program, copy, NULL};
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t files;
    sigset_t none, changed;
    sigemptyset(&none);
    sigemptyset(&changed); /* which programs of ours ignore */
    sigaddset(&changed, SIGPIPE);
    sigaddset(&changed, SIGXFSZ);
    bool started = false;
    if (posix_spawnattr_init(&attributes) != 0)
        return false;
    if (posix_spawn_file_actions_init(&files) == 0) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &changed);
        posix_spawnattr_setpgroup(&attributes, 0); /* Ctrl-C is for us, not for the browser */
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", 0, 0);
        posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
        started = posix_spawnp(child, program, &files, &attributes, words, environ) == 0;
        posix_spawn_file_actions_destroy(&files);
    }
    posix_spawnattr_destroy(&attributes);
    return started;
}

static void *wait_for(void *context)
{
    int how;
    if (waitpid((pid_t)(intptr_t)context, &how, 0) > 0 && (!WIFEXITED(how) || WEXITSTATUS(how) != 0))
        say_none();
    return NULL;
}

/* Does not wait for it. If no browser opens, a note on standard error says so, now or when that is known. */
static void browser_open(const char *address)
{
    pid_t child;
    pthread_t thread;
    if (!start(address, &child))
        say_none();
    else if (pthread_create(&thread, NULL, wait_for, (void *)(intptr_t)child) == 0)
        pthread_detach(thread);
}

/* ---- what is served */

typedef struct place {
    char folder[PATH_MAX], file[NAME_MAX + 1]; /* the file is empty if there is none */
} place;

/* A folder, or a rule file's. */
static tn_status find_place(const char *path, place *found, tn_error *error)
{
    struct stat kind;
    *found = (place){"", ""};
    if (strlen(path) >= sizeof found->folder)
        return tn_cannot_read(path, ENAMETOOLONG, error);
    if (stat(path, &kind) != 0)
        return tn_cannot_read(path, errno, error);
    strcpy(found->folder, path);
    if (S_ISDIR(kind.st_mode))
        return TN_OK;
    char copy[PATH_MAX];
    strcpy(copy, path);
    const char *name = basename(copy);
    if (strlen(name) >= sizeof found->file)
        return tn_cannot_read(path, ENAMETOOLONG, error);
    strcpy(found->file, name);
    char *slash = strrchr(found->folder, '/');
    if (slash)
        slash[slash == found->folder] = '\0';
    else
        strcpy(found->folder, ".");
    return tn_studio_name_check(found->file, error);
}

/* ---- the end */

static void signals_that_end(sigset_t *set)
{
    sigemptyset(set);
    sigaddset(set, SIGINT);
    sigaddset(set, SIGTERM);
    sigaddset(set, SIGHUP);
}

/* The thread that waits for signals. */
typedef struct waiting {
    pthread_mutex_t lock;
    tn_server *server; /* that a signal ends; NULL once it ends by itself, and may be freed */
    bool over;         /* no signal is waited for any more */
    pthread_t thread;
} waiting;

/* A signal came: ends the server. Is that all? */
static bool take_signal(waiting *w)
{
    pthread_mutex_lock(&w->lock);
    if (w->server)
        tn_server_end(w->server);
    bool over = w->over;
    pthread_mutex_unlock(&w->lock);
    return over;
}

/* One ends the server, another one does not wait for it. */
static void *wait_for_signals(void *context)
{
    sigset_t set;
    int number;
    signals_that_end(&set);
    sigwait(&set, &number);
    if (take_signal(context))
        return NULL;
    sigwait(&set, &number);
    if (!take_signal(context))
        _exit(TN_EXIT_DONE);
    return NULL;
}

static tn_status start_waiting(waiting *w, tn_server *server, tn_error *error)
{
    *w = (waiting){.lock = PTHREAD_MUTEX_INITIALIZER, .server = server};
    return pthread_create(&w->thread, NULL, wait_for_signals, w) == 0 ? TN_OK : tn_fail_memory(error);
}

/* Whoever tells the server that it is to end has done so afterwards. */
static void leave_server(waiting *w)
{
    pthread_mutex_lock(&w->lock);
    w->server = NULL;
    pthread_mutex_unlock(&w->lock);
}

static void end_waiting(waiting *w)
{
    pthread_mutex_lock(&w->lock);
    w->over = true;
    pthread_mutex_unlock(&w->lock);
    pthread_kill(w->thread, SIGTERM);
    pthread_join(w->thread, NULL);
    pthread_mutex_destroy(&w->lock);
}

/* ---- the server */

static tn_status announce(const tn_server *server, const tn_studio_folder *folder, const tn_studio_settings *settings,
                          tn_error *error)
{
    printf("%s\n", tn_server_address(server));
    if (fflush(stdout) != 0)
        return tn_cannot_write("standard output", errno, error);
    if (settings->common.diagnostics == 0)
        fprintf(stderr, "note: %s is served%s; Ctrl-C ends it\n", tn_studio_folder_path(folder),
                settings->read_only ? " to be read only" : "");
    if (!settings->no_open)
        browser_open(tn_server_address_once(server));
    return TN_OK;
}

/* What is still at work when it ends is left to the system. */
static tn_status serve_folder(const tn_studio_settings *settings, tn_studio_folder *folder, const char *file,
                              tn_error *error)
{
    const tn_server_options options = {.folder = folder,
                                       .open = file[0] ? file : NULL,
                                       .port = (unsigned)settings->port.value,
                                       .memory_limit = tn_interrupt_waiting()->memory_limit};
    tn_server *server;
    tn_status status = tn_server_new(&options, &server, error);
    if (status != TN_OK)
        return status;
    waiting waits;
    status = start_waiting(&waits, server, error);
    if (status != TN_OK) {
        tn_server_free(server); /* nobody was let in yet */
        return status;
    }
    status = announce(server, folder, settings, error);
    if (status == TN_OK)
        tn_server_run(server);
    fflush(stderr);
    leave_server(&waits);
    if (!tn_server_free(server))
        _exit(status == TN_OK ? TN_EXIT_DONE : TN_EXIT_IO);
    end_waiting(&waits);
    return status;
}

static tn_status serve(const tn_studio_settings *settings, tn_error *error)
{
    const tn_option_list *operands = &settings->common.operands;
    place where;
    tn_studio_folder *folder;
    tn_status status = find_place(operands->count ? operands->items[0] : ".", &where, error);
    if (status == TN_OK)
        status = tn_studio_folder_open(where.folder, settings->read_only, &folder, error);
    if (status != TN_OK)
        return status;
    status = serve_folder(settings, folder, where.file, error);
    tn_studio_folder_close(folder);
    return status;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_error error;
    sigset_t set;
    signals_that_end(&set);
    pthread_sigmask(SIG_BLOCK, &set, NULL); /* in all threads: one waits for them */
    tn_job_begin(&job, settings);
    if (serve((const tn_studio_settings *)settings, &error) != TN_OK)
        tn_job_fail(&job, &error);
    return tn_job_end(&job);
}

int main(int argc, char **argv)
{
    tn_program_begin();
    if (argc == 2 && strcmp(argv[1], "--version") == 0) {
        puts("tartan-studio " TARTAN_VERSION);
        return tn_program_printed();
    }
    tn_command command = *tn_command_find(&tn_all_commands, "studio");
    command.run = run;
    return tn_program_run(&tn_all_commands, &command, argc - 1, argv + 1, NULL);
}
