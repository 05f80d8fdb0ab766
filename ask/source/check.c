/* check, format: what there is to say of a file that compiles, and its text in the canonical layout. */
#include "ask/source/check.h"

#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "compiler/format.h"
#include "driver/grammar/grammar_report.h"
#include "driver/house/analysis.h"
#include "driver/plan/analysis.h"
#include "driver/plan/tests.h"
#include "driver/solid/solid.h"
#include "runtime/base/crew.h"
#include "runtime/base/utf8.h"

/* ---- where something stands in a text */

/* From the beginning of the text; a byte order mark is no part of it. */
static uint64_t utf16_offset(const tn_source *source, size_t offset)
{
    size_t mark = strncmp(source->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (offset > source->size)
        offset = source->size;
    return offset > mark ? tn_utf16_units(source->text + mark, offset - mark) : 0;
}

bool tn_text_place_of(tn_sources *sources, bool has_span, tn_span span, tn_text_place *to)
{
    if (!has_span || span.file >= sources->count)
        return true;
    const tn_source *source = &sources->files[span.file];
    const tn_place place = tn_sources_place(sources, span);
    to->has_file = to->has_line = to->has_column = to->has_end_line = to->has_end_column = true;
    to->has_utf16_begin = to->has_utf16_end = true;
    to->line = place.line;
    to->column = place.column;
    to->end_line = place.end_line;
    to->end_column = place.end_column;
    to->utf16_begin = utf16_offset(source, span.begin);
    to->utf16_end = utf16_offset(source, span.end > span.begin ? span.end : span.begin);
    to->file = place.path ? strdup(place.path) : NULL;
    return to->file || !place.path;
}

/* ---- format */

/* The first of what is said where laying out fails; a text that compiles has no errors of syntax. */
static tn_status fail(tn_session *session, const tn_diagnostics *said, tn_status status)
{
    tn_error error;
    if (status == TN_MEMORY || said->count == 0)
        return tn_session_fail(session, (tn_fail_memory(&error), &error));
    tn_fail(&error, status, said->items[0].code, "%.479s", said->items[0].message);
    if (said->items[0].help)
        tn_error_help(&error, "%.319s", said->items[0].help);
    return tn_session_fail(session, &error);
}

/* The caller frees *text. */
static tn_status lay_out(tn_session *session, const tn_source *source, char **text, size_t *size)
{
    tn_sources sources = {0};
    tn_diagnostics said;
    tn_diagnostics_init(&said, &sources);
    tn_status status = tn_format_text(&said, tn_notation_or_first(source->path, source->text, source->size),
                                      source->path, source->text, source->size, text, size);
    if (status != TN_OK)
        status = fail(session, &said, status);
    tn_diagnostics_clear(&said);
    tn_sources_clear(&sources);
    return status;
}

tn_status tn_ask_format(tn_session *session, const tn_format_request *request, tn_reply *answer)
{
    const tn_opened *opened = session->opened;
    char *text = NULL;
    size_t size = 0;
    tn_error error;
    *answer = (tn_reply){0};
    if (!opened->compiled)
        return tn_session_refuse(session, "name the rule file that it was built from",
                                 "%.200s is a module, and only the text of a rule file is laid out", opened->path);
    const tn_source *source = &opened->compilation.sources.files[0];
    tn_status status = tn_reply_new(&tn_message_laid_out, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    status = lay_out(session, source, &text, &size);
    if (status != TN_OK)
        return status;
    tn_laid_out *to = answer->value;
    to->same = size == source->size && memcmp(text, source->text, size) == 0;
    to->has_text = !request->no_text;
    to->text = text; /* freed with the answer, also where it is not shown */
    return TN_OK;
}

/* ---- found */

/* What is found goes to the diagnostics. */
static tn_status analyse(tn_opened *opened, const tn_check_request *request, const tn_library *library)
{
    const tn_plan_analysis_options options = {.max_states = (uint32_t)request->max_states,
                                              .library = library,
                                              .threads = request->has_threads ? (unsigned)request->threads
                                                                              : tn_crew_default()};
    tn_plan_analyses analyses;
    tn_error error;
    tn_status status = tn_tests_check(opened, &error);
    if (status != TN_OK) {
        tn_finding_error(opened, &error);
        return status;
    }
    status = tn_plan_analyse(opened, &options, &analyses);
    tn_plan_analyses_free(&analyses);
    return status == TN_OK ? tn_house_analyse(opened, (uint32_t)request->max_states) : status;
}

static tn_status find(tn_session *session, const tn_check_request *request, const tn_library *library)
{
    tn_opened *opened = session->opened;
    const tn_module *module = opened->module;
    tn_error error;
    if (tn_module_has_grammar(module)) {
        tn_status status = tn_grammar_report(opened, request->figures, &error);
        return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
    }
    if (tn_notation_of_module(module) == TN_NOTATION(pcfg))
        return TN_OK;
    if (module->SOLID_count > 0)
        return tn_solid_report(opened, (uint32_t)request->max_boxes);
    if (tn_notation_of_module(module))
        return analyse(opened, request, library);
    tn_session_note(session, "there is nothing in %.200s", opened->path);
    return TN_OK;
}

/* ---- the answer */

static bool give_text(const char *text, char **to)
{
    *to = text ? strdup(text) : NULL;
    return *to || !text;
}

static tn_status give_finding(tn_sources *sources, const tn_diagnostic *from, tn_check_finding *to, tn_error *error)
{
    char code[8];
    tn_code_name(from->code, code);
    to->severity = tn_severity_text(from->severity);
    to->has_code = from->code != TN_CODE_NONE;
    to->has_help = from->help != NULL;
    to->has_replacement = from->replacement != NULL;
    bool given = give_text(to->has_code ? code : NULL, &to->code) &&
                 give_text(from->message ? from->message : "out of memory", &to->message) &&
                 give_text(from->help, &to->help) && give_text(from->replacement, &to->replacement) &&
                 tn_text_place_of(sources, from->has_span, from->span, &to->place);
    for (size_t i = 0; given && i < from->note_count; i++) {
        const tn_diagnostic_note *note = &from->notes[i];
        tn_check_note *added = TN_ADD(check_note, to->notes, error);
        given = added && give_text(note->text ? note->text : "out of memory", &added->message) &&
                tn_text_place_of(sources, note->has_span, note->span, &added->place);
    }
    return given ? TN_OK : tn_fail_memory(error);
}

/* What was added to the diagnostics since there were so many, in the order of the text. */
static tn_status give_findings(tn_diagnostics *list, size_t before, tn_checked_file *to, tn_error *error)
{
    tn_status status = TN_OK;
    tn_diagnostics_sort(list);
    for (size_t i = 0; status == TN_OK && i < list->count; i++) {
        if (list->items[i].order < before)
            continue;
        tn_check_finding *added = TN_ADD(check_finding, to->findings, error);
        status = added ? give_finding(list->sources, &list->items[i], added, error) : TN_MEMORY;
        to->notes += list->items[i].severity == TN_NOTE;
    }
    return status == TN_OK && list->failed ? tn_fail_memory(error) : status;
}

tn_status tn_check_beside(tn_session *session, const tn_check_request *request, const tn_library *library,
                          tn_reply *answer)
{
    tn_diagnostics *list = &session->opened->compilation.diagnostics;
    size_t before = list->count, errors = list->error_count, warnings = list->warning_count;
    tn_error error;
    *answer = (tn_reply){0};
    if (request->figures && !tn_module_has_grammar(session->opened->module))
        return tn_session_refuse(session, NULL, "--figures is about grammars, and %.200s is not one",
                                 session->opened->path);
    tn_status status = find(session, request, library);
    if (status != TN_OK && status != TN_INVALID)
        return status;
    status = tn_reply_new(&tn_message_checked_file, answer, &error);
    if (status == TN_OK) {
        tn_checked_file *to = answer->value;
        to->errors = list->error_count - errors;
        to->warnings = list->warning_count - warnings;
        status = give_findings(list, before, to, &error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

tn_status tn_ask_check(tn_session *session, const tn_check_request *request, tn_reply *answer)
{
    return tn_check_beside(session, request, NULL, answer);
}
