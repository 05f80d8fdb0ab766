/* Diagnostics, and the quick fixes that their helps offer. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lsp/features.h"

/* Where something in a file that is used is shown: at the first `use`, or at the start. */
static tn_span place_of_use(const tn_file_analysis *analysis)
{
    const tn_imports *imports = analysis->compilation.imports;
    const tn_ast_file *tree = imports && imports->count ? imports->units[imports->count - 1]->tree : NULL;
    if (tree)
        for (TN_EACH(const tn_ast_top, item, tree->items))
            if (item->kind == TN_ITEM_USE)
                return item->node.span;
    return (tn_span){0};
}

/* At least one character, so that there is something to underline. */
static tn_span visible(const tn_file_analysis *analysis, tn_span span)
{
    const tn_source *source = &analysis->compilation.sources.files[span.file];
    if (span.end > span.begin || source->size == 0)
        return span;
    if (span.begin >= source->size)
        span.begin = (uint32_t)source->size - 1;
    span.end = span.begin + 1;
    return span;
}

/* With the notes that have no place of their own, and the help. */
static json_t *message_of(tn_file_analysis *analysis, const tn_diagnostic *item, bool elsewhere)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    if (elsewhere) {
        tn_place at = tn_sources_place(&analysis->compilation.sources, item->span);
        fprintf(out, "%s:%zu: ", at.path, at.line);
    }
    fprintf(out, "%s", item->message ? item->message : "");
    for (size_t i = 0; i < item->note_count; i++)
        if (!item->notes[i].has_span && item->notes[i].text)
            fprintf(out, "\nnote: %s", item->notes[i].text);
    if (item->help)
        fprintf(out, "\nhelp: %s", item->help);
    fclose(out);
    json_t *message = text ? json_string(text) : NULL;
    free(text);
    return message;
}

static json_t *related(tn_document *document, const tn_diagnostic *item)
{
    json_t *list = json_array();
    for (size_t i = 0; i < item->note_count; i++)
        if (item->notes[i].has_span && item->notes[i].text)
            json_array_append_new(list, json_pack("{s:o,s:s}", "location",
                                                  tn_analysis_location(document, item->notes[i].span), "message",
                                                  item->notes[i].text));
    return list;
}

static json_t *to_json(tn_document *document, tn_file_analysis *analysis, const tn_diagnostic *item)
{
    char code[8] = "";
    bool elsewhere = item->has_span && item->span.file != 0;
    tn_span span = item->has_span && !elsewhere ? visible(analysis, item->span) : place_of_use(analysis);
    int severity = item->severity == TN_ERROR ? 1 : item->severity == TN_WARNING ? 2 : 3;
    if (item->code != TN_CODE_NONE)
        tn_code_name(item->code, code);
    json_t *result =
        json_pack("{s:o,s:i,s:s,s:s,s:o}", "range", tn_analysis_range(analysis, span), "severity", severity, "code",
                  code, "source", "tartan", "message", message_of(analysis, item, elsewhere));
    json_t *notes = related(document, item);
    if (elsewhere)
        json_array_append_new(notes, json_pack("{s:o,s:s}", "location", tn_analysis_location(document, item->span),
                                               "message", item->message ? item->message : ""));
    if (json_array_size(notes) > 0)
        json_object_set(result, "relatedInformation", notes);
    json_decref(notes);
    return result;
}

/* Links the code to its page. */
static void link_code(json_t *diagnostic, const char *pages)
{
    const char *code = json_string_value(json_object_get(diagnostic, "code"));
    size_t size = strlen(pages);
    if (code && code[0])
        json_object_set_new(
            diagnostic, "codeDescription",
            json_pack("{s:o}", "href",
                      json_sprintf("%s%serrors/%s.html", pages, size && pages[size - 1] == '/' ? "" : "/", code)));
}

json_t *tn_lsp_diagnostics(tn_document *document, tn_file_analysis *analysis, const char *pages)
{
    const tn_diagnostics *found = &analysis->compilation.diagnostics;
    json_t *list = json_array();
    for (size_t i = 0; i < found->count && analysis->compilation.sources.count > 0; i++) {
        json_t *diagnostic = to_json(document, analysis, &found->items[i]);
        if (pages)
            link_code(diagnostic, pages);
        json_array_append_new(list, diagnostic);
    }
    return json_pack("{s:s,s:I,s:o}", "uri", document->uri, "version", document->version, "diagnostics", list);
}

/* ---- quick fixes */

static json_t *edit_at(tn_document *document, tn_file_analysis *analysis, tn_span span, const char *text)
{
    json_t *edits = json_pack("[{s:o,s:s}]", "range", tn_analysis_range(analysis, span), "newText", text);
    json_t *changes = json_object();
    json_object_set_new(changes, document->uri, edits);
    return json_pack("{s:o}", "changes", changes);
}

static json_t *replacement_action(tn_document *document, tn_file_analysis *analysis, const tn_diagnostic *item)
{
    return json_pack("{s:o,s:s,s:b,s:[o],s:o}", "title", json_sprintf("Replace with %s", item->replacement), "kind",
                     "quickfix", "isPreferred", 1, "diagnostics", to_json(document, analysis, item), "edit",
                     edit_at(document, analysis, item->span, item->replacement));
}

/* The rule, library or form in which a place of the document is. */
static const tn_symbol *owner_of(const tn_file_analysis *analysis, tn_span span)
{
    for (const tn_symbol *s = analysis->index.first; s; s = s->next)
        if ((s->kind == TN_SYMBOL_RULE || s->kind == TN_SYMBOL_LIBRARY || s->kind == TN_SYMBOL_FORM) &&
            s->span.file == span.file && s->span.begin <= span.begin && span.end <= s->span.end)
            return s;
    return NULL;
}

/* Where `allow W012` goes: in a rule before its `=`, in a library or form before its `}`; or after codes allowed
 * already. */
static bool allowance(const tn_file_analysis *analysis, const tn_symbol *owner, const char *code, tn_span *place,
                      char *text, size_t size)
{
    if (owner->kind == TN_SYMBOL_LIBRARY || owner->kind == TN_SYMBOL_FORM) {
        *place = (tn_span){0, owner->span.end - 1, owner->span.end - 1};
        snprintf(text, size, "  allow %s\n", code);
        return true;
    }
    const tn_ast_rule *rule = (const tn_ast_rule *)owner->ast;
    const tn_ast_word *last = rule->using ? rule->using : rule->doc ? rule->doc : rule->name;
    bool more = rule->allow.last != NULL;
    uint32_t at = more ? rule->allow.last->span.end : last->node.span.end;
    *place = (tn_span){0, at, at};
    snprintf(text, size, more ? ", %s" : " allow %s", code);
    return at < analysis->compilation.sources.files[0].size;
}

static json_t *allow_action(tn_document *document, tn_file_analysis *analysis, const tn_diagnostic *item)
{
    char code[8], text[32];
    tn_span place;
    const tn_symbol *owner = owner_of(analysis, item->span);
    tn_code_name(item->code, code);
    if (!owner || !allowance(analysis, owner, code, &place, text, sizeof text))
        return NULL;
    return json_pack("{s:o,s:s,s:[o],s:o}", "title", json_sprintf("Allow %s in %s", code, owner->name), "kind",
                     "quickfix", "diagnostics", to_json(document, analysis, item), "edit",
                     edit_at(document, analysis, place, text));
}

void tn_lsp_fixes(tn_document *document, tn_file_analysis *analysis, size_t begin, size_t end, json_t *list)
{
    const tn_diagnostics *found = &analysis->compilation.diagnostics;
    for (size_t i = 0; i < found->count; i++) {
        const tn_diagnostic *item = &found->items[i];
        if (!item->has_span || item->span.file != 0 || item->span.begin > end || item->span.end < begin)
            continue;
        if (item->replacement)
            json_array_append_new(list, replacement_action(document, analysis, item));
        json_t *allow = item->severity == TN_WARNING ? allow_action(document, analysis, item) : NULL;
        if (allow)
            json_array_append_new(list, allow);
    }
}
