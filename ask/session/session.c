/* What a session says and keeps. */
#include "ask/session/session.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/house/judge.h"
#include "driver/open/open.h"
#include "runtime/base/crew.h"
#include "runtime/plan/match/vm.h"

static tn_diagnostics *said(tn_session *session)
{
    return &session->opened->compilation.diagnostics;
}

static void forget_library(tn_session *session)
{
    tn_library_close(&session->library);
    session->library = (tn_ready_library){0};
}

void tn_session_forget(tn_session *session)
{
    forget_library(session);
    tn_boxed_free(&session->explainer);
    tn_boxed_free(&session->grammar);
    tn_boxed_free(&session->breeding);
}

tn_status tn_session_fail(tn_session *session, const tn_error *error)
{
    if (error->status != TN_STOPPED)
        tn_finding_error(session->opened, error);
    return error->status;
}

tn_status tn_session_bad_text(tn_session *session, tn_error *error, const char *name, const char *text)
{
    if (error->status != TN_INVALID)
        return tn_session_fail(session, error);
    tn_error_place(error, error->column ? 1 : 0, error->column, error->column_end);
    tn_report_error(said(session), error, name, text, strlen(text));
    return error->status;
}

tn_status tn_session_refuse(tn_session *session, const char *help, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tn_diagnostic *d = tn_report_bare_list(said(session), TN_ERROR, E_USAGE, format, args);
    va_end(args);
    if (help)
        tn_help(said(session), d, "%s", help);
    return TN_INVALID;
}

tn_status tn_session_no_rank(tn_session *session, const tn_library *library, const tn_library_record *record,
                             const char *rank)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    tn_status status = tn_session_no_rank_of(session, record, kept, (const char *const[2]){"plan", "plans"}, rank);
    mpz_clear(kept);
    return status;
}

tn_status tn_session_no_rank_of(tn_session *session, const tn_library_record *record, const mpz_t kept,
                                const char *const what[2], const char *rank)
{
    char *digits = mpz_get_str(NULL, 10, kept);
    tn_diagnostic *past = tn_report_bare(said(session), TN_ERROR, E_NOT_IN_LIBRARY, "`%s` has no %s of rank %.80s",
                                         tn_text(session->opened->module, record->name), what[0], rank);
    if (mpz_sgn(kept) == 0)
        tn_help(said(session), past, "it holds no %s", what[1]);
    else
        tn_help(said(session), past, "it holds %s %s; ranks start at 0", digits ? digits : "?", what[1]);
    free(digits);
    return TN_INVALID;
}

tn_status tn_session_open_text(tn_session *session, const char *text, size_t size, const tn_questions *questions,
                               tn_opened *opened)
{
    const char *path = session->opened->compilation.sources.files[0].path;
    const tn_text_opener *opener = session->opener;
    tn_param_values params;
    tn_error error;
    *opened = (tn_opened){0};
    tn_status status = tn_opened_params(session->opened, &params);
    if (status == TN_OK)
        status = opener ? opener->open(opener->context, path, text, size, questions, opened)
                        : tn_open_source(path, text, size, questions, params, opened);
    free((void *)(uintptr_t)params.items);
    if (status == TN_OK || status == TN_INVALID)
        return status;
    tn_open_error(opened, status, &error);
    return tn_session_fail(session, &error);
}

void tn_session_note(tn_session *session, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tn_report_bare_list(said(session), TN_NOTE, TN_CODE_NONE, format, args);
    va_end(args);
}

void tn_session_begins(const tn_session *session, const char *work)
{
    if (session->listener.begins)
        session->listener.begins(session->listener.context, work);
}

void tn_session_ends(const tn_session *session)
{
    if (session->listener.ends)
        session->listener.ends(session->listener.context);
}

void tn_session_shows(const tn_session *session)
{
    if (session->listener.shows)
        session->listener.shows(session->listener.context);
}

tn_status tn_session_plan_line(tn_session *session, const tn_schema *schema, const char *text, size_t max_length,
                               tn_plan *plan)
{
    tn_error error;
    size_t size = strlen(text);
    tn_status status = text[strspn(text, " ")] == '{'
                           ? tn_plan_parse_json(schema, text, size, max_length, plan, &error)
                           : tn_plan_parse_line(schema, text, size, max_length, plan, &error);
    if (status == TN_OK)
        return TN_OK;
    tn_error_place(&error, 1, error.column, error.column_end);
    tn_report_error(said(session), &error, "PLAN", text, size);
    return status;
}

/* ---- what is asked of a library */

bool tn_session_of_houses(const tn_session *session, const tn_library_asked *asked)
{
    return asked->library && tn_house_library_find(session->opened->module, asked->library) != TN_NO_RECORD;
}

unsigned tn_asked_threads(const tn_library_asked *asked)
{
    return asked->has_threads ? (unsigned)asked->threads : tn_crew_default();
}

size_t tn_asked_length(const tn_library_asked *asked)
{
    return asked->has_max_length ? (size_t)asked->max_length : TN_VM_LENGTH_DEFAULT;
}

tn_library_options tn_asked_options(const tn_library_asked *asked)
{
    return (tn_library_options){.max_states = (uint32_t)asked->max_states,
                                .override_trays = asked->has_trays,
                                .trays_min = (uint32_t)asked->trays.from,
                                .trays_max = (uint32_t)asked->trays.to,
                                .max_length = (uint32_t)asked->max_length,
                                .threads = tn_asked_threads(asked)};
}

/* ---- the library that is kept */

static bool same_options(const tn_library_options *a, const tn_library_options *b)
{
    return a->max_states == b->max_states && a->override_trays == b->override_trays && a->trays_min == b->trays_min &&
           a->trays_max == b->trays_max && a->max_length == b->max_length && a->threads == b->threads &&
           a->all_generated == b->all_generated;
}

static bool is_kept(const tn_session *session, const char *name, const tn_library_options *options)
{
    if (!session->library.library || !same_options(&session->options, options) ||
        (tn_library_apart(session->library.library) != SIZE_MAX && !options->only_counted))
        return false;
    return name ? strcmp(name, tn_text(session->opened->module, session->library.record->name)) == 0
                : session->only_one;
}

/* limit: as in tn_library_ready_or_searched; NULL: it is not searched. */
static tn_status make_ready(tn_session *session, const char *name, const tn_library_options *options,
                            const tn_ready_library **ready, tn_error *limit)
{
    *ready = &session->library;
    if (is_kept(session, name, options))
        return TN_OK;
    forget_library(session);
    session->options = *options;
    session->only_one = !name;
    tn_session_begins(session, "clauses combined");
    tn_status status =
        limit ? tn_library_ready_or_searched(session->opened, name, options, &session->library, limit)
              : tn_library_ready(session->opened, name, options, &session->library);
    tn_session_ends(session);
    return status;
}

tn_status tn_session_library(tn_session *session, const tn_library_asked *asked, const tn_ready_library **ready)
{
    const tn_library_options options = tn_asked_options(asked);
    return make_ready(session, asked->library, &options, ready, NULL);
}

tn_status tn_session_searched(tn_session *session, const tn_library_asked *asked, bool all_generated,
                              const tn_ready_library **ready, tn_error *limit)
{
    tn_library_options options = tn_asked_options(asked);
    options.all_generated = all_generated;
    return make_ready(session, asked->library, &options, ready, limit);
}

tn_status tn_session_counted(tn_session *session, const tn_library_asked *asked, const tn_ready_library **ready)
{
    tn_library_options options = tn_asked_options(asked);
    options.only_counted = true;
    return make_ready(session, asked->library, &options, ready, NULL);
}

tn_status tn_session_generated(tn_session *session, const tn_library_asked *asked, const tn_ready_library **ready)
{
    tn_library_options options = tn_asked_options(asked);
    options.all_generated = true;
    return make_ready(session, asked->library, &options, ready, NULL);
}
