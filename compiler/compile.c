/* Compiles a text: hands it to its notation's front end, and reports what fails without a place of its own. */
#include "compiler/compile.h"

#include <stdlib.h>

#include "compiler/common/number_ranges.h"

/* Values are given to params of a text that can have none. */
static tn_status refuse_settings(tn_compilation *compilation, const tn_compile_options *options)
{
    tn_diagnostic *d =
        tn_report_bare(&compilation->diagnostics, TN_ERROR, E_USAGE, "--set %.200s: %.200s has no params",
                       options->params.items[0], compilation->input->name);
    tn_help(&compilation->diagnostics, d, "only .plan files have them: leave --set out");
    return TN_INVALID;
}

static tn_status gather_ranges(tn_compilation *compilation, tn_error *error)
{
    tn_number_ranges *ranges = TN_NEW(compilation->arena, tn_number_ranges);
    if (!ranges)
        return tn_fail_memory(error);
    ranges->arena = compilation->arena;
    compilation->ranges = compilation->diagnostics.ranges = ranges;
    return TN_OK;
}

tn_status tn_compile_text(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                          tn_compilation *compilation)
{
    tn_error error = {0};
    uint32_t file;
    *compilation = (tn_compilation){.notation = notation, .input = input};
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    compilation->arena = tn_arena_new();
    tn_status status = compilation->arena
                           ? tn_sources_add(&compilation->sources, input->name, input->text, input->size, &file, &error)
                           : tn_fail_memory(&error);
    if (status == TN_OK)
        status = gather_ranges(compilation, &error);
    if (status == TN_OK)
        status = tn_watch_check(options->watch, &error);
    if (status == TN_OK && options->params.count > 0 && !notation->front->settable)
        status = refuse_settings(compilation, options);
    else if (status == TN_OK)
        status = notation->front->compile(compilation, options, &error);
    if (status != TN_OK && status != TN_INVALID && tn_watch_stopped(options->watch))
        status = tn_fail_stopped(options->watch, &error); /* a front end takes that for want of memory */
    if (status != TN_OK && status != TN_INVALID)
        tn_report_error(&compilation->diagnostics, &error, input->name, NULL, 0);
    tn_diagnostics_sort(&compilation->diagnostics);
    compilation->input = NULL;
    return status;
}

void tn_compilation_clear(tn_compilation *compilation)
{
    tn_diagnostics_clear(&compilation->diagnostics);
    tn_sources_clear(&compilation->sources);
    tn_arena_free(compilation->arena);
    free(compilation->module);
    *compilation = (tn_compilation){0};
}
