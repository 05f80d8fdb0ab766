/* A .bnf text as a module of its own. */
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compiler/bnf/bnf.h"
#include "compiler/common/lexical.h"

static tn_status build(tn_compilation *c, uint32_t file, tn_builder *builder, tn_error *error)
{
    const tn_source *source = &c->sources.files[file];
    tn_status status = tn_bnf_compile(&c->sources, file, &c->diagnostics, c->arena, builder, error);
    if (status != TN_OK)
        return status;
    tn_builder_add_SOURCE(builder,
                          &(tn_source_record){.path = tn_builder_string(builder, source->path),
                                              .text = tn_builder_string_n(builder, source->text, source->size)});
    tn_builder_add_PRODUCER(builder,
                            &(tn_producer_record){.version = tn_builder_string(builder, "tartan " TARTAN_VERSION),
                                                  .sources_hash = (int64_t)XXH3_64bits(source->text, source->size)});
    return tn_builder_finish(builder, &c->module, &c->module_size, error);
}

bool tn_is_bnf(const char *path)
{
    size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".bnf") == 0;
}

tn_status tn_bnf_compile_module(const tn_compile_options *options, tn_compilation *compilation, tn_error *error)
{
    if (!tn_text_check(&compilation->diagnostics, 0))
        return TN_INVALID;
    tn_builder *builder = tn_builder_new();
    tn_status status = builder ? build(compilation, 0, builder, error) : tn_fail_memory(error);
    tn_builder_free(builder);
    if (status == TN_OK && options->warnings_are_errors && compilation->diagnostics.warning_count > 0) {
        free(compilation->module);
        compilation->module = NULL;
        return TN_INVALID;
    }
    return status;
}
