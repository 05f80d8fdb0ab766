/* Writes a checked .plan program into a module. */
#include "compiler/plan/emit/emit.h"

#include <string.h>

#include "compiler/common/import.h"
#include "compiler/common/limits.h"

void tn_emit_begin(tn_emit *emit, uint32_t schema)
{
    emit->around = emit->schema;
    emit->schema = schema;
    emit->begin = tn_builder_offset(emit->builder);
    emit->depth = emit->stack_max = 0;
}

void tn_emit_op(tn_emit *emit, tn_span span, tn_opcode opcode, int64_t first, int64_t second)
{
    if (++emit->instructions > TN_INSTRUCTIONS_MAX)
        return; /* tn_emit_module reports it */
    const tn_opcode_info *info = tn_opcode_describe((uint8_t)opcode);
    uint32_t offset = tn_builder_emit(emit->builder, opcode, first, second);
    tn_builder_add_SOURCE_MAP(emit->builder, &(tn_source_map_record){offset, span.file, span.begin, span.end});
    emit->depth += info->pushes;
    emit->depth -= info->pops;
    if (emit->depth > emit->stack_max)
        emit->stack_max = emit->depth;
}

uint32_t tn_emit_end(tn_emit *emit, const char *name, tn_function_kind kind)
{
    uint32_t function = tn_builder_add_FUNCTION(emit->builder, &(tn_function_record){
                                                                   .name = tn_builder_string(emit->builder, name),
                                                                   .kind = kind,
                                                                   .schema = emit->schema,
                                                                   .code_begin = emit->begin,
                                                                   .code_end = tn_builder_offset(emit->builder),
                                                                   .stack_max = emit->stack_max,
                                                               });
    emit->schema = emit->around;
    return function;
}

/* The sources' texts and paths, and a hash over the texts: paths of the standard library are recorded as they are
 * everywhere. */
tn_status tn_emit_module(tn_arena *arena, const tn_checked *checked, const tn_imports *imports,
                         tn_diagnostics *diagnostics, uint8_t **bytes, size_t *size, tn_error *error)
{
    tn_emit emit = {.arena = arena, .builder = tn_builder_new(), .checked = checked, .imports = imports};
    if (!emit.builder)
        return tn_fail_memory(error);
    tn_emit_sources(emit.builder, imports, diagnostics->sources);
    tn_emit_schemas(&emit);
    tn_emit_forms(&emit);
    tn_emit_rules(&emit);
    tn_emit_libraries(&emit);
    tn_emit_measures(&emit);
    tn_emit_said(&emit);
    tn_status status = TN_OK;
    if (emit.instructions > TN_INSTRUCTIONS_MAX) {
        status =
            tn_fail(error, TN_LIMIT, E_MODULE_TOO_LARGE, "the rules need %zu instructions, more than the limit of %u",
                    emit.instructions, TN_INSTRUCTIONS_MAX);
        tn_error_help(error, "split the file, or give parts that are written out often a name of their own");
    } else if (tn_arena_failed(arena)) { /* parts may be missing */
        status = tn_fail_memory(error);
    } else {
        status = tn_builder_finish(emit.builder, bytes, size, error);
    }
    tn_builder_free(emit.builder);
    return status;
}
