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

static tn_status compile_input(tn_file_analysis *analysis, const tn_input *input, const tn_compile_options *options)
{
    return tn_compile_text(tn_notation_or_first(input->name, input->text, input->size), input, options,
                           &analysis->compilation);
}

static tn_status compile_served(tn_file_analysis *analysis, const tn_input *input, const tn_analysis_texts *texts)
{
    tn_served_files files;
    tn_served_begin(&files, texts->served, texts->overlay, texts->context);
    const tn_compile_options options = {
        .resolver = tn_served_resolver(&files), .attachments = tn_served_attachments(&files), .partial = true};
    tn_status status = compile_input(analysis, input, &options);
    tn_served_clear(&files);
    return status;
}

static tn_status compile_file(tn_file_analysis *analysis, const tn_input *input, const tn_analysis_texts *texts)
{
    tn_files files;
    tn_files_begin(&files, texts->stdlib);
    files.kept.overlay = texts->overlay;
    files.kept.overlay_context = texts->context;
    const tn_compile_options options = {
        .resolver = tn_files_resolver(&files), .attachments = tn_file_attachments, .partial = true};
    tn_status status = compile_input(analysis, input, &options);
    tn_files_clear(&files);
    return status;
}

tn_file_analysis *tn_analysis_new(const char *path, const char *text, size_t size, const tn_analysis_texts *texts)
{
    tn_file_analysis *analysis = calloc(1, sizeof *analysis);
    if (!analysis)
        return NULL;
    const tn_input input = {.text = text, .size = size, .name = path};
    tn_status status = texts->served ? compile_served(analysis, &input, texts) : compile_file(analysis, &input, texts);
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
