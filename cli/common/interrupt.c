/* Notes signals that are to end the command, and ends it where it does not end by itself. */
#include "cli/common/interrupt.h"

#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/options.h"
#include "compiler/common/diagnostic.h"
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

void tn_interrupt_end(const char *text, size_t size, int exit_code)
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
