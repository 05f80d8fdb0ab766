/* Notes signals that are to end the command, measures its memory, and ends it if it does not end by itself. */
#include "cli/common/interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/common/options.h"
#include "compiler/common/diagnostic.h"
#include "runtime/base/memory.h"
#include "runtime/base/utf8.h"

#define PATIENCE 1u /* seconds from the signal to the end; two are promised */

/* A text in either of two places, so that one is whole while the other is written. */
typedef struct last_words {
    char text[1200];
    size_t size;
} last_words;

/* The only mutable globals of the program: a signal handler can reach nothing else. */
static tn_watch waiting;
static last_words words[2];
static atomic_int current;
static bool as_json;
static atomic_bool asked, stops_within; /* by a signal that leaves time */

static void note(int signal_number)
{
    (void)signal_number;
    waiting.stop = true;
    alarm(PATIENCE);
}

/* Only calls that are safe in a signal handler. */
static void give_up(int signal_number)
{
    (void)signal_number;
    const last_words *last = &words[atomic_load(&current)];
    (void)!write(STDERR_FILENO, last->text, last->size);
    _exit(TN_EXIT_INTERRUPTED);
}

/* Ends the program now, from whichever thread: writes the text, and for people the last words behind it. */
static void interrupt_end(const char *text, size_t size, int exit_code)
{
    const last_words *last = &words[atomic_load(&current)];
    (void)!write(STDERR_FILENO, text, size);
    if (!as_json)
        (void)!write(STDERR_FILENO, last->text, last->size);
    _exit(exit_code);
}

static void note_gently(int signal_number)
{
    (void)signal_number;
    asked = true;
    if (stops_within)
        waiting.stop = true;
}

const atomic_bool *tn_interrupt_gently(bool terminate, bool within)
{
    struct sigaction action = {.sa_handler = note_gently, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    stops_within = within;
    sigaction(SIGUSR1, &action, NULL);
    action.sa_flags = (int)(SA_RESETHAND | SA_RESTART);
    if (terminate)
        sigaction(SIGTERM, &action, NULL);
    return &asked;
}

static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};

void tn_interrupt_watch(bool json)
{
    struct sigaction before,
        late = {.sa_handler = give_up},
        action = {.sa_handler = note, .sa_flags = (int)(SA_RESETHAND | SA_RESTART)}; /* no write cut short */
    sigemptyset(&action.sa_mask);
    sigemptyset(&late.sa_mask);
    as_json = json;
    sigaction(SIGALRM, &late, NULL);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
}

bool tn_interrupted(void)
{
    return waiting.stop;
}

tn_status tn_interrupt_check(tn_error *error)
{
    return tn_watch_check(&waiting, error);
}

tn_watch *tn_interrupt_waiting(void)
{
    return &waiting;
}

void tn_interrupt_last_words(const char *format, ...)
{
    char message[480];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    int spare = !atomic_load(&current);
    last_words *next = &words[spare];
    FILE *out = fmemopen(next->text, sizeof next->text, "w");
    if (!out)
        return; /* then without words */
    if (as_json) {
        tn_diagnostics_show_alone(TN_NOTE, TN_CODE_NONE, message, NULL, out);
    } else {
        fputs(isatty(STDERR_FILENO) ? "\r\033[Knote: " : "note: ", out); /* in place of the progress */
        tn_write_clean(out, message, strlen(message));
        fputc('\n', out);
    }
    long size = ftell(out);
    bool whole = fclose(out) == 0 && size > 0;
    next->size = whole ? (size_t)size : 0;
    atomic_store(&current, spare);
}

void tn_interrupt_answered(void)
{
    alarm(0);
}

void tn_interrupt_asking(bool asking)
{
    struct sigaction action;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (sigaction(numbers[i], NULL, &action) != 0 || action.sa_handler != note)
            continue;
        action.sa_flags = (int)(asking ? SA_RESETHAND : SA_RESETHAND | SA_RESTART);
        sigaction(numbers[i], &action, NULL);
    }
}

/* ---- the limit of memory */

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
    interrupt_end(text, size > 0 ? (size_t)size : 0, TN_EXIT_LIMIT);
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
