#include "cli/session.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
    case TN_INTERNAL:
        break;
    }
    return TN_EXIT_INTERNAL;
}

static void worsen(tn_session *session, int exit_code)
{
    if (exit_code > session->exit_code)
        session->exit_code = exit_code;
}

void tn_session_begin(tn_session *session, const tn_settings *settings)
{
    *session = (tn_session){.settings = settings};
    tn_diagnostics_init(&session->opened.compilation.diagnostics, &session->opened.compilation.sources);
}

bool tn_session_open(tn_session *session, const char *path)
{
    worsen(session, tn_exit_code(tn_open(path, session->settings->werror, &session->opened)));
    return session->opened.module != NULL;
}

void tn_session_status(tn_session *session, tn_status status)
{
    worsen(session, tn_exit_code(status));
}

tn_diagnostics *tn_session_diagnostics(tn_session *session)
{
    return &session->opened.compilation.diagnostics;
}

void tn_session_fail(tn_session *session, const tn_error *error)
{
    if (error->code == E_CLOSED_PIPE) {
        session->reader_gone = true;
        return;
    }
    tn_finding_error(&session->opened, error);
    worsen(session, error->code == E_USAGE ? TN_EXIT_USAGE : tn_exit_code(error->status));
}

tn_diagnostic *tn_session_usage(tn_session *session, const char *format, ...)
{
    char text[480];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    worsen(session, TN_EXIT_USAGE);
    return tn_report_bare(tn_session_diagnostics(session), TN_ERROR, E_USAGE, "%s", text);
}

void tn_session_note(tn_session *session, const char *format, ...)
{
    char text[480];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tn_report_bare(tn_session_diagnostics(session), TN_NOTE, TN_CODE_NONE, "%s", text);
}

static bool wants_colour(void)
{
    const char *no_colour = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && !(no_colour && *no_colour) && !(terminal && strcmp(terminal, "dumb") == 0);
}

static void show(tn_session *session)
{
    tn_diagnostics *list = tn_session_diagnostics(session);
    tn_show_options options = {.json = session->settings->diagnostics == 1, .colour = wants_colour()};
    tn_diagnostics_sort(list);
    session->errors += list->error_count;
    session->warnings += list->warning_count;
    if (list->count || options.json)
        tn_diagnostics_show(list, &options, stderr);
    if (list->failed)
        fputs("tartan: out of memory while collecting diagnostics\n", stderr);
    tn_diagnostics_clear(list);
    tn_diagnostics_init(list, &session->opened.compilation.sources);
}

void tn_session_show(tn_session *session)
{
    if (session->settings->diagnostics == 0)
        show(session);
}

bool tn_session_reopen(tn_session *session, const char *path)
{
    show(session);
    tn_close(&session->opened);
    return tn_session_open(session, path);
}

int tn_session_end(tn_session *session)
{
    show(session);
    tn_close(&session->opened);
    if (session->errors || (session->warnings && session->settings->werror))
        worsen(session, TN_EXIT_INVALID);
    return session->exit_code;
}

bool tn_session_output(tn_session *session, const char *path, tn_output *output)
{
    tn_error error;
    if (tn_output_open(path ? path : "-", output, &error) == TN_OK)
        return true;
    tn_session_fail(session, &error);
    return false;
}

void tn_session_commit(tn_session *session, tn_output *output)
{
    tn_error error;
    if (tn_output_commit(output, &error) != TN_OK)
        tn_session_fail(session, &error);
}

void tn_session_close(tn_session *session, tn_output *output, bool complete)
{
    if (complete || !output->temporary)
        tn_session_commit(session, output);
    else
        tn_output_discard(output);
}
