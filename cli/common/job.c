/* Runs the parts that commands share: opening files, messages, output, exit codes. */
#include "cli/common/job.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "cli/common/memory_guard.h"
#include "runtime/base/picture.h"

int tn_exit_code(tn_status status)
{
    switch (status) {
    case TN_OK:
        return TN_EXIT_DONE;
    case TN_INVALID:
        return TN_EXIT_INVALID;
    case TN_IO:
        return TN_EXIT_IO;
    case TN_LIMIT:
    case TN_MEMORY:
        return TN_EXIT_LIMIT;
    case TN_STOPPED:
        return TN_EXIT_INTERRUPTED;
    case TN_INTERNAL:
        break;
    }
    return TN_EXIT_INTERNAL;
}

static void worsen(tn_job *job, int exit_code)
{
    if (exit_code == TN_EXIT_INTERRUPTED && tn_memory_guard_full())
        exit_code = TN_EXIT_LIMIT; /* nobody asked for the end */
    if (exit_code > job->exit_code)
        job->exit_code = exit_code;
}

void tn_job_begin(tn_job *job, const tn_settings *settings)
{
    *job = (tn_job){.settings = settings};
    tn_diagnostics_init(&job->opened.compilation.diagnostics, &job->opened.compilation.sources);
}

bool tn_job_open(tn_job *job, const char *path)
{
    return tn_job_open_asking(job, path, NULL);
}

bool tn_job_open_asking(tn_job *job, const char *path, const tn_questions *questions)
{
    if (job->opened.module && job->opened.path == path)
        return true;
    worsen(job, tn_exit_code(tn_open_asking(path, job->settings->werror, questions, &job->opened)));
    if (job->opened.module)
        job->opened.module->watch = tn_interrupt_waiting();
    return job->opened.module != NULL;
}

bool tn_job_open_joined(tn_job *job, const char *const *paths, size_t count)
{
    worsen(job, tn_exit_code(tn_open_joined(paths, count, job->settings->werror, &job->opened)));
    return job->opened.module != NULL;
}

void tn_job_status(tn_job *job, tn_status status)
{
    worsen(job, tn_exit_code(status));
    job->stopped |= status == TN_STOPPED;
}

tn_diagnostics *tn_job_diagnostics(tn_job *job)
{
    return &job->opened.compilation.diagnostics;
}

void tn_job_fail(tn_job *job, const tn_error *error)
{
    if (error->code == E_CLOSED_PIPE) {
        job->reader_gone = true;
        return;
    }
    if (error->status == TN_STOPPED) {
        tn_job_status(job, TN_STOPPED);
        return;
    }
    tn_finding_error(&job->opened, error);
    bool cannot_be_asked = error->code == E_USAGE || error->code == E_PART_ABSENT;
    worsen(job, cannot_be_asked ? TN_EXIT_USAGE : tn_exit_code(error->status));
}

tn_diagnostic *tn_job_usage(tn_job *job, const char *format, ...)
{
    char text[480];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    worsen(job, TN_EXIT_USAGE);
    return tn_report_bare(tn_job_diagnostics(job), TN_ERROR, E_USAGE, "%s", text);
}

void tn_job_note(tn_job *job, const char *format, ...)
{
    char text[480];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tn_report_bare(tn_job_diagnostics(job), TN_NOTE, TN_CODE_NONE, "%s", text);
}

void tn_job_interrupted(tn_job *job, const char *format, ...)
{
    char text[480];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tn_job_status(job, TN_STOPPED);
    job->said = true;
    tn_job_note(job, "%s", text);
}

static void say_what_was_passed(tn_job *job)
{
    tn_error error;
    tn_memory_guard_describe(job->settings->command, &error);
    tn_finding_error(&job->opened, &error);
    worsen(job, TN_EXIT_LIMIT);
}

/* Where no command said it itself. */
static void say_what_is_missing(tn_job *job)
{
    const char *output = tn_settings_output(job->settings);
    job->stopped |= tn_job_diagnostics(job)->stopped;
    if (job->stopped && tn_memory_guard_full())
        say_what_was_passed(job);
    bool nothing_to_lose = tn_memory_guard_full() && !(output && strcmp(output, "-") != 0);
    if (!job->stopped || job->said || nothing_to_lose)
        return;
    if (output && strcmp(output, "-") != 0)
        tn_job_interrupted(job, "interrupted; %.400s is not written", output);
    else
        tn_job_interrupted(job, "interrupted before the end");
}

static bool wants_colour(void)
{
    const char *no_colour = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && !(no_colour && *no_colour) && !(terminal && strcmp(terminal, "dumb") == 0);
}

static void show(tn_job *job)
{
    tn_diagnostics *list = tn_job_diagnostics(job);
    tn_show_options options = {.json = job->settings->diagnostics == 1, .colour = wants_colour()};
    tn_diagnostics_sort(list);
    job->errors += list->error_count;
    job->warnings += list->warning_count;
    job->stopped |= list->stopped;
    if (job->listener)
        job->listener->listen(job->listener, list);
    if (list->count || list->failed || options.json)
        tn_diagnostics_show(list, &options, stderr);
    if (list->failed)
        worsen(job, TN_EXIT_LIMIT);
    tn_diagnostics_clear(list);
    tn_diagnostics_init(list, &job->opened.compilation.sources);
}

void tn_job_show(tn_job *job)
{
    if (job->settings->diagnostics == 0)
        show(job);
}

static void close_file(tn_job *job)
{
    const tn_sources *sources = &job->opened.compilation.sources;
    for (size_t i = 0; job->read && i < sources->count; i++)
        tn_files_read_add(job->read, sources->files[i].path);
    tn_close(&job->opened);
}

void tn_job_next(tn_job *job)
{
    show(job);
    close_file(job);
    tn_diagnostics_init(tn_job_diagnostics(job), &job->opened.compilation.sources);
}

bool tn_job_reopen(tn_job *job, const char *path)
{
    tn_job_next(job);
    return tn_job_open(job, path);
}

int tn_job_end(tn_job *job)
{
    say_what_is_missing(job);
    show(job);
    close_file(job);
    if (job->errors || (job->warnings && job->settings->werror))
        worsen(job, TN_EXIT_INVALID);
    return job->exit_code;
}

bool tn_job_draws(const char *path)
{
    tn_canvas_format format;
    tn_error error;
    return path && strrchr(path, '.') && tn_canvas_format_of(path, &format, &error) == TN_OK;
}

bool tn_job_takes_text(tn_job *job, const char *path)
{
    if (!tn_job_draws(path))
        return true;
    tn_diagnostic *d = tn_job_usage(job, "%.200s is the name of a picture, and this output is text", path);
    tn_help(tn_job_diagnostics(job), d, "end its name otherwise; plans and rules are drawn by `tartan draw`");
    return false;
}

bool tn_job_output(tn_job *job, const char *path, tn_output *output)
{
    if (!tn_job_takes_text(job, path))
        return false;
    tn_error error;
    if (tn_output_open(path ? path : "-", output, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

void tn_job_commit(tn_job *job, tn_output *output)
{
    tn_error error;
    if (tn_output_commit(output, &error) != TN_OK)
        tn_job_fail(job, &error);
}

void tn_job_close(tn_job *job, tn_output *output, bool complete)
{
    if (complete || !output->replaces)
        tn_job_commit(job, output);
    else
        tn_output_discard(output);
}
