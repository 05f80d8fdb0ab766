/* Compiles a text and indexes it for the questions of an editor. */
#include "lsp/analysis.h"

#include <stdlib.h>

#include "compiler/common/lexical.h"
#include "compiler/compile.h"
#include "driver/open/attached.h"

void tn_analysis_free(tn_file_analysis *analysis)
{
    if (!analysis)
        return;
    for (size_t i = 0; analysis->lines && i < analysis->compilation.sources.count; i++)
        tn_lines_clear(&analysis->lines[i]);
    free(analysis->lines);
    tn_compilation_clear(&analysis->compilation);
    free(analysis);
}

/* The compilation has read the tokens and forgotten them. */
static void read_tokens(tn_file_analysis *analysis)
{
    tn_compilation *c = &analysis->compilation;
    tn_diagnostics scratch;
    tn_reading reading;
    tn_diagnostics_init(&scratch, &c->sources);
    if (tn_text_check(&scratch, 0) && tn_read(c->arena, &scratch, c->notation, 0, &reading))
        analysis->tokens = reading.tokens;
    tn_diagnostics_clear(&scratch);
}

tn_file_analysis *tn_analysis_new(const char *path, const char *text, size_t size, const tn_stdlib_dirs *stdlib,
                                  tn_overlay *overlay, void *context)
{
    tn_file_analysis *analysis = calloc(1, sizeof *analysis);
    if (!analysis)
        return NULL;
    tn_files files;
    tn_files_begin(&files, stdlib);
    files.overlay = overlay;
    files.overlay_context = context;
    tn_compile_options options = {
        .resolver = tn_files_resolver(&files), .attachments = tn_file_attachments, .partial = true};
    tn_input input = {.text = text, .size = size, .name = path};
    tn_status status =
        tn_compile_text(tn_notation_or_first(path, text, size), &input, &options, &analysis->compilation);
    tn_files_clear(&files);
    analysis->lines = calloc(analysis->compilation.sources.count + 1, sizeof *analysis->lines);
    if (analysis->compilation.sources.count > 0 && analysis->compilation.arena) {
        read_tokens(analysis);
        if (analysis->compilation.imports)
            tn_index_build(&analysis->index, &analysis->compilation);
    }
    if (analysis->lines && status != TN_MEMORY)
        return analysis;
    tn_analysis_free(analysis);
    return NULL;
}

const tn_lines *tn_analysis_lines(tn_file_analysis *analysis, uint32_t file)
{
    if (file >= analysis->compilation.sources.count)
        return NULL;
    tn_lines *lines = &analysis->lines[file];
    const tn_source *source = &analysis->compilation.sources.files[file];
    if (!lines->starts && !tn_lines_make(lines, source->text, source->size))
        return NULL;
    return lines;
}

json_t *tn_analysis_range(tn_file_analysis *analysis, tn_span span)
{
    const tn_lines *lines = tn_analysis_lines(analysis, span.file);
    return lines ? tn_lines_range(lines, span.begin, span.end) : json_null();
}
