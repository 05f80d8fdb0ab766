#include "studio/server/browser.h"

#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

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

void tn_browser_open(const char *address)
{
    pid_t child;
    pthread_t thread;
    if (!start(address, &child))
        say_none();
    else if (pthread_create(&thread, NULL, wait_for, (void *)(intptr_t)child) == 0)
        pthread_detach(thread);
}
