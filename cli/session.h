/* One run of a command: the file it works on, what there is to report, and the exit code in the end.
 *
 * Commands begin a session, open their file, call the library, and return what tn_session_end returns. Anything that
 * fails goes through tn_session_fail, which turns it into a diagnostic and remembers the exit code.
 */
#ifndef TARTAN_CLI_SESSION_H
#define TARTAN_CLI_SESSION_H

#include "cli/options.h"
#include "driver/findings.h"
#include "driver/open.h"
#include "runtime/vm/file.h"

enum {
    TN_EXIT_DONE = 0,
    TN_EXIT_INVALID = 1,
    TN_EXIT_USAGE = 2,
    TN_EXIT_IO = 3,
    TN_EXIT_LIMIT = 4,
    TN_EXIT_INTERNAL = 70,
    TN_EXIT_INTERRUPTED = 130, /* as shells report SIGINT */
};

typedef struct tn_session {
    const tn_settings *settings;
    tn_opened opened;
    bool open;
    int exit_code;           /* the gravest so far */
    bool reader_gone;        /* standard output's reader went away: end quietly */
    size_t errors, warnings; /* shown so far */
} tn_session;

void tn_session_begin(tn_session *session, const tn_settings *settings);

/* Opens a rule file or module; false where that failed (then end the session). */
bool tn_session_open(tn_session *session, const char *path);

/* Opens another file for the same command, after what there was to say about the one before is said. */
bool tn_session_reopen(tn_session *session, const char *path);

/* Where diagnostics go. */
tn_diagnostics *tn_session_diagnostics(tn_session *session);

/* Records a failure. A closed pipe is not one: it ends the command quietly. */
void tn_session_fail(tn_session *session, const tn_error *error);

/* Takes note of a status whose diagnostic is there already. */
void tn_session_status(tn_session *session, tn_status status);

/* Records wrong usage, found after the options were read. */
tn_diagnostic *tn_session_usage(tn_session *session, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a plain note. */
void tn_session_note(tn_session *session, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Shows what has been collected so far (as text; JSON is one array at the end). Before long work. */
void tn_session_show(tn_session *session);

/* Shows the rest, frees everything and returns the exit code. */
int tn_session_end(tn_session *session);

/* The exit code for a status. */
int tn_exit_code(tn_status status);

/* An output by option: NULL is standard output. */
bool tn_session_output(tn_session *session, const char *path, tn_output *output);

/* Puts the output in place. A failure is recorded. */
void tn_session_commit(tn_session *session, tn_output *output);

/* The same where the work came to its end; otherwise a file is given up (its target stays as it was), and standard
 * output keeps what was written. */
void tn_session_close(tn_session *session, tn_output *output, bool complete);

#endif
