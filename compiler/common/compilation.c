/* Begins compilations, and frees what they made. */
#include "compiler/common/compilation.h"

#include <stdlib.h>

static tn_status gather_ranges(tn_compilation *compilation, tn_error *error)
{
    tn_number_ranges *ranges = TN_NEW(compilation->arena, tn_number_ranges);
    if (!ranges)
        return tn_fail_memory(error);
    ranges->arena = compilation->arena;
    compilation->ranges = compilation->diagnostics.ranges = ranges;
    return TN_OK;
}

tn_status tn_compilation_start(tn_compilation *compilation, const struct tn_notation *notation, const tn_input *input,
                               tn_error *error)
{
    uint32_t file;
    *compilation = (tn_compilation){.notation = notation, .input = input};
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    compilation->arena = tn_arena_new();
    tn_status status = compilation->arena
                           ? tn_sources_add(&compilation->sources, input->name, input->text, input->size, &file, error)
                           : tn_fail_memory(error);
    return status == TN_OK ? gather_ranges(compilation, error) : status;
}

void tn_compilation_clear(tn_compilation *compilation)
{
    tn_diagnostics_clear(&compilation->diagnostics);
    tn_sources_clear(&compilation->sources);
    tn_arena_free(compilation->arena);
    free(compilation->module);
    *compilation = (tn_compilation){0};
}
