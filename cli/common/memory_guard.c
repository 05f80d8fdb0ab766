/* Measures the memory of the command that runs, and ends it past its limit. */
#include "cli/common/memory_guard.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "compiler/common/diagnostic.h"
#include "runtime/base/memory.h"

#define PAUSE_NS 10000000 /* between two measurements: some 50 MB at most are taken in it */
#define GRACE_BYTES(LIMIT) ((LIMIT) / 8 + (32u << 20)) /* past the limit, for finishing what was begun */

typedef struct guard {
    const tn_command *command;
    bool json;
} guard;

bool tn_memory_guard_full(void)
{
    return tn_interrupt_waiting()->full;
}

void tn_memory_guard_describe(const tn_command *command, tn_error *error)
{
    char limit[32];
    tn_memory_write(tn_interrupt_waiting()->memory_limit, limit);
    tn_fail(error, TN_LIMIT, E_MEMORY_LIMIT, "`tartan %s` needs more memory than its limit of %s", command->name,
            limit);
    if (command->ask_less)
        tn_error_help(error, "%s, or raise the limit with --memory-limit", command->ask_less);
    else
        tn_error_help(error, "raise the limit with --memory-limit");
}

/* Without the job, which another thread is at work on. */
static void end_from_without(const guard *own)
{
    tn_error error;
    char text[1200];
    tn_memory_guard_describe(own->command, &error);
    FILE *out = fmemopen(text, sizeof text, "w");
    if (out && own->json) {
        tn_diagnostics_show_alone(TN_ERROR, error.code, error.message, error.help, out);
    } else if (out) {
        fprintf(out, "error[E%04d]: %s\n  help: %s\n", error.code, error.message, error.help);
    }
    long size = out ? ftell(out) : 0;
    if (out)
        fclose(out);
    tn_interrupt_end(text, size > 0 ? (size_t)size : 0, TN_EXIT_LIMIT);
}

static void *measure(void *argument)
{
    const guard *own = argument;
    tn_watch *watch = tn_interrupt_waiting();
    const struct timespec pause = {.tv_nsec = PAUSE_NS};
    for (;;) {
        nanosleep(&pause, NULL);
        tn_watch_measure(watch);
        if (watch->full && tn_memory_used() > watch->memory_limit + GRACE_BYTES(watch->memory_limit))
            end_from_without(own);
    }
    return NULL;
}

/* Signals are for the thread that may wait for a line. */
static bool start_thread(guard *own)
{
    pthread_t thread;
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    bool started = pthread_create(&thread, NULL, measure, own) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started && pthread_detach(thread) == 0;
}

/* Once for each piece of work, however often it looks ahead. */
static void announce(const char *what, uint64_t bytes)
{
    static char last[128];
    char needed[32];
    if (strncmp(last, what, sizeof last - 1) == 0)
        return;
    snprintf(last, sizeof last, "%s", what);
    tn_memory_write(bytes, needed);
    fprintf(stderr, "%snote: %s will need about %s of memory\n", isatty(STDERR_FILENO) ? "\r\033[K" : "", what, needed);
}

void tn_memory_guard_start(const tn_command *command, const tn_settings *settings)
{
    static guard own; /* the thread's, for as long as the process lives */
    tn_watch *watch = tn_interrupt_waiting();
    uint64_t available = settings->memory_limit.given ? 0 : tn_memory_available("");
    if (settings->memory_limit.given)
        watch->memory_limit = settings->memory_limit.value << 20;
    else if (available != TN_MEMORY_UNKNOWN)
        watch->memory_limit = tn_memory_used() + available / 2;
    own = (guard){command, settings->diagnostics == 1};
    watch->large = own.json ? NULL : announce; /* JSON holds diagnostics alone */
    if (watch->memory_limit && !start_thread(&own))
        watch->caller = pthread_self(); /* which then measures where work asks */
}
