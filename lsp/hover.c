/* Hover: what a name is, in the words of the file that says so. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/format.h"
#include "lsp/facts.h"
#include "lsp/features.h"

enum { SHOWN_MAX = 4096 }; /* bytes of a definition that are shown */

static const char *kind_name(const tn_symbol *symbol)
{
    static const char *const names[] = {
        [TN_SYMBOL_SCHEMA] = "schema",     [TN_SYMBOL_FIELD] = "field",     [TN_SYMBOL_VALUE] = "value",
        [TN_SYMBOL_RULE] = "rule",         [TN_SYMBOL_LIBRARY] = "library", [TN_SYMBOL_CLAUSE] = "clause",
        [TN_SYMBOL_MEASURE] = "measure",   [TN_SYMBOL_FORM] = "form",       [TN_SYMBOL_STOREY] = "storey",
        [TN_SYMBOL_FUNCTION] = "function", [TN_SYMBOL_OPENING] = "opening", [TN_SYMBOL_TILE] = "tile",
        [TN_SYMBOL_CHOICE] = "choice",     [TN_SYMBOL_PARAM] = "param",     [TN_SYMBOL_LAYER] = "layer"};
    return names[symbol->kind];
}

static const char *code_of(const tn_file_analysis *analysis, tn_span span, int *size)
{
    const tn_source *source = &analysis->compilation.sources.files[span.file];
    size_t bytes = span.end - span.begin;
    *size = (int)(bytes < SHOWN_MAX ? bytes : SHOWN_MAX);
    return source->text + span.begin;
}

static json_t *text_of(const tn_document *document, tn_file_analysis *analysis, const tn_symbol *symbol)
{
    int size;
    const char *code = code_of(analysis, symbol->span, &size);
    const char *path = analysis->compilation.sources.files[symbol->span.file].path, *slash = strrchr(path, '/');
    char of[300] = "", where[300] = "";
    if (symbol->parent)
        snprintf(of, sizeof of, " of %s `%.200s`", kind_name(symbol->parent), symbol->parent->name);
    if (symbol->span.file != 0)
        snprintf(where, sizeof where, ", from `%.200s`", slash ? slash + 1 : path);
    char *facts = tn_facts_text(document->facts, symbol);
    json_t *text = json_sprintf("```plan\n%.*s\n```\n%s%s%s%s`%s`%s%s%s%s", size, code, symbol->doc ? symbol->doc : "",
                                symbol->doc ? "\n\n" : "", kind_name(symbol), " ", symbol->name, of, where,
                                facts ? "\n\n" : "", facts ? facts : "");
    free(facts);
    return text;
}

/* A word of the language, and its sentence. */
static json_t *hover_word(tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    tn_span span;
    const char *sentence = tn_lsp_word(document, analysis, offset, &span);
    if (!sentence)
        return json_null();
    int size = (int)(span.end - span.begin);
    return json_pack("{s:{s:s,s:o},s:o}", "contents", "kind", "markdown", "value",
                     json_sprintf("`%.*s`: %s", size, document->text + span.begin, sentence), "range",
                     tn_analysis_range(analysis, span));
}

json_t *tn_lsp_hover(tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    const tn_occurrence *found = tn_index_at(&analysis->index, 0, offset);
    if (!found)
        return hover_word(document, analysis, offset);
    return json_pack("{s:{s:s,s:o},s:o}", "contents", "kind", "markdown", "value",
                     text_of(document, analysis, found->symbol), "range", tn_analysis_range(analysis, found->span));
}

/* ---- formatting */

json_t *tn_lsp_format(tn_document *document)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    char *text;
    size_t size;
    json_t *edits = json_array();
    tn_diagnostics_init(&diagnostics, &sources);
    const tn_notation *notation = tn_notation_or_first(document->path, document->text, document->size);
    tn_format_text(&diagnostics, notation, document->path, document->text, document->size, &text, &size);
    tn_lines lines;
    if (text && strcmp(text, document->text) != 0 && tn_lines_make(&lines, document->text, document->size)) {
        json_array_append_new(
            edits, json_pack("{s:o,s:s}", "range", tn_lines_range(&lines, 0, document->size), "newText", text));
        tn_lines_clear(&lines);
    }
    free(text);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    return edits;
}
