/* Turns an engine's finding, a code offset, into a message at its place in the source. */
#include "driver/open/findings.h"

#include <string.h>

bool tn_code_span(const tn_opened *opened, uint32_t offset, tn_span *span)
{
    const tn_source_map_record *map =
        opened->module && offset != TN_NO_OFFSET ? tn_module_place(opened->module, offset) : NULL;
    if (!map || map->file >= opened->compilation.sources.count)
        return false;
    *span = (tn_span){map->file, map->begin, map->end};
    return true;
}

bool tn_code_place(const tn_opened *opened, uint32_t offset, tn_place *where)
{
    tn_span span;
    if (!tn_code_span(opened, offset, &span))
        return false;
    tn_sources *sources = (tn_sources *)(uintptr_t)&opened->compilation.sources; /* finds its lines late */
    *where = tn_sources_place(sources, span);
    return true;
}

static void place(const tn_opened *opened, const tn_error *error, tn_diagnostic *diagnostic)
{
    diagnostic->has_span = tn_code_span(opened, error->code_offset, &diagnostic->span);
}

tn_diagnostic *tn_finding_error(tn_opened *opened, const tn_error *error)
{
    tn_diagnostic *diagnostic = tn_report_error(&opened->compilation.diagnostics, error, NULL, NULL, 0);
    place(opened, error, diagnostic);
    return diagnostic;
}

tn_diagnostic *tn_finding_note(tn_opened *opened, const tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostic *diagnostic = tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "%s", error->message);
    place(opened, error, diagnostic);
    if (error->help[0])
        tn_help(list, diagnostic, "%s", error->help);
    return diagnostic;
}

tn_diagnostic *tn_finding_limit(tn_opened *opened, const tn_error *error, const tn_span *otherwise)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_span span;
    bool has_span = tn_code_span(opened, error->code_offset, &span);
    if (!has_span && otherwise) {
        span = *otherwise;
        has_span = true;
    }
    for (size_t i = 0; i < list->count; i++) {
        tn_diagnostic *known = &list->items[i];
        if (known->limit && known->message && strcmp(known->message, error->message) == 0 &&
            known->has_span == has_span && (!has_span || memcmp(&known->span, &span, sizeof span) == 0))
            return known;
    }
    tn_diagnostic *note = tn_finding_note(opened, error);
    note->limit = true;
    note->has_span = has_span;
    if (has_span)
        note->span = span;
    return note;
}

tn_diagnostic *tn_finding_uncounted(tn_opened *opened, const char *clause, const tn_error *error)
{
    tn_error note;
    tn_fail(&note, error->status, error->code, "what only `%.80s` keeps out is not counted: %.360s", clause,
            error->message);
    tn_error_help(&note, "%s", error->help);
    note.code_offset = error->code_offset;
    return tn_finding_limit(opened, &note, NULL);
}
