/* One run of a command: the file it works on, what there is to report, and the exit code in the end.
 *
 * Commands begin a job, open their file, call the library, and return what tn_job_end returns. Anything that
 * fails goes through tn_job_fail, which turns it into a diagnostic and remembers the exit code.
 */
#ifndef TARTAN_CLI_COMMON_JOB_H
#define TARTAN_CLI_COMMON_JOB_H

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

#include "ask/session/made.h"
#include "ask/session/session.h"
#include "cli/common/options.h"
#include "cli/common/progress.h"
#include "driver/open/open.h"
#include "runtime/base/file.h"

/* The files that a command has read, and whether they have changed since: for --watch.
 *
 * They are looked at five times a second, by name: so it does not matter whether an editor writes into a file or puts
 * another one in its place, and it works on every file system.
 */

/* All zero: none yet. Owns the names. */
typedef struct tn_files_read {
    struct tn_file_seen *files;
    size_t count, capacity;
} tn_files_read;

/* Runs a command, and again whenever a file that it has read changes, until it is interrupted. `once` adds what it
 * reads and returns an exit code. Returns the last one; the interrupt itself is no failure, but where it cuts a run
 * short. */
int tn_watch_files(const tn_settings *settings, int (*once)(const tn_settings *settings, tn_files_read *read));

/* Who is told what there was to say about each file, before it is forgotten. The list is sorted. */
typedef struct tn_listener {
    void (*listen)(struct tn_listener *listener, const tn_diagnostics *list);
} tn_listener;

typedef struct tn_job {
    const tn_settings *settings;
    tn_listener *listener;      /* or NULL */
    struct tn_files_read *read; /* or NULL: the names of all files that are read are added to it */
    tn_opened opened;
    tn_session session; /* of that file */
    tn_progress progress;
    bool open;
    int exit_code;           /* the gravest so far */
    bool reader_gone;        /* standard output's reader went away: end quietly */
    bool stopped;            /* by an interrupt, and not all was done */
    bool said;               /* what is missing, of that */
    size_t errors, warnings; /* shown so far */
    char *words;             /* shown so far, with several ranks; owned */
} tn_job;

void tn_job_begin(tn_job *job, const tn_settings *settings);

/* Opens a rule file or module, unless that is open; false where that failed (then end the job). */
bool tn_job_open(tn_job *job, const char *path);

/* The same, with what the command line asks of a .plan file; NULL: nothing. */
bool tn_job_open_asking(tn_job *job, const char *path, const tn_questions *questions);

/* Opens several files that are one text together. */
bool tn_job_open_joined(tn_job *job, const char *const *paths, size_t count);

/* Says what there is to say about the file that is open, and closes it: for commands that take several. */
void tn_job_next(tn_job *job);

/* Opens another file for the same command, after what there was to say about the one before is said. */
bool tn_job_reopen(tn_job *job, const char *path);

/* Where diagnostics go. */
tn_diagnostics *tn_job_diagnostics(tn_job *job);

/* Records a failure. A closed pipe is not one: it ends the command quietly. */
void tn_job_fail(tn_job *job, const tn_error *error);

/* Takes note of a status whose diagnostic is there already. */
void tn_job_status(tn_job *job, tn_status status);

/* Takes note of what a question came to (ask/session/session.h); true for TN_OK. */
bool tn_job_answered(tn_job *job, tn_status status);

/* Writes an answer as JSON. */
void tn_job_write_json(const tn_reply *answer, FILE *out);

/* Records wrong usage, found after the options were read. */
tn_diagnostic *tn_job_usage(tn_job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The command was interrupted: records that, with a note of what was written and what is missing. */
void tn_job_interrupted(tn_job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a plain note. */
void tn_job_note(tn_job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Shows what has been collected so far (as text; JSON is one array at the end). Before long work. */
void tn_job_show(tn_job *job);

/* Where several ranks do the command together, all call it: is it well with all of them? Without ranks: `well`. */
bool tn_job_agree(const tn_job *job, bool well);

/* Shows the rest, frees everything and returns the exit code. With several ranks together: rank 0 shows what each had
 * to say, the same only once, and all have the gravest exit code. */
int tn_job_end(tn_job *job);

/* Is the path (NULL: standard output) the name of a picture: .svg, .png or .pdf? */
bool tn_job_draws(const char *path);

/* Is the path (NULL: standard output) the name of something that is written so, by the command as it is asked?
 * Otherwise wrong usage is recorded, with the endings that there are. For what the table of options cannot tell. what:
 * is written, "a list of plans"; NULL: the output of the command. */
bool tn_job_writes(tn_job *job, const char *what, const char *path, tn_file_formats writes);

/* Is the path of a text output (NULL: standard output) not the name of a picture? Otherwise wrong usage is recorded. */
bool tn_job_takes_text(tn_job *job, const char *path);

/* An output by option: NULL is standard output. False where it cannot be opened, or has the name of a picture. */
bool tn_job_output(tn_job *job, const char *path, tn_output *output);

/* Puts the output in place. A failure is recorded. */
void tn_job_commit(tn_job *job, tn_output *output);

/* The same where the work came to its end; otherwise a file is given up (its target stays as it was), and standard
 * output keeps what was written. */
void tn_job_close(tn_job *job, tn_output *output, bool complete);

/* ---- puts the files that a question makes where -o says */

typedef struct tn_made_outputs {
    tn_job *job;
    const char *const *paths;   /* borrowed; of the files, in the order in which they are made */
    const char *const *folders; /* the folder of each that is made if it is not there; NULL: none. It may be set. */
    size_t count, next;
    bool folder;     /* the one path is a folder, and each file has a name in it; one without is index.html */
    char *in_folder; /* the path of the file that is open there; owned */
    tn_output output;
    tn_file_taker taker;
} tn_made_outputs;

/* From now on files that questions of the job's session make go there. The folder is made with its first file. */
void tn_job_files(tn_job *job, tn_made_outputs *outputs, const char *const *paths, size_t count, bool folder);

/* No longer. */
void tn_job_files_end(tn_made_outputs *outputs);

/* Which of the words of a request's `format` the name of a picture means. */
unsigned tn_picture_choice(const char *path);

/* The same of the pictures of answers: the word none, 0, if the name is none of a picture. */
unsigned tn_answer_picture_choice(const char *path);

/* Asks for a picture, and puts it there. */
void tn_job_draw(tn_job *job, const tn_draw_request *request, const char *path);

#endif
