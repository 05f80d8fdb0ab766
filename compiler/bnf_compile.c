/* A .bnf text as a module of its own. */
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compiler/bnf.h"
#include "runtime/vm/utf8.h"

static tn_status build(tn_compilation *c, uint32_t file, tn_builder *builder, tn_error *error)
{
    const tn_source *source = &c->sources.files[file];
    tn_status status = tn_bnf_compile(&c->sources, file, &c->diagnostics, c->arena, builder, error);
    if (status != TN_OK)
        return status;
    tn_builder_add_SOURCE(builder, &(tn_source_record){.path = tn_builder_string(builder, source->path),
                                                       .text = tn_builder_string_n(builder, source->text, source->size)});
    tn_builder_add_PRODUCER(builder, &(tn_producer_record){.version = tn_builder_string(builder, "tartan " TARTAN_VERSION),
                                                           .sources_hash = (int64_t)XXH3_64bits(source->text, source->size)});
    return tn_builder_finish(builder, &c->module, &c->module_size, error);
}

static tn_status compile(const char *path, const char *text, size_t size, tn_compilation *c, tn_error *error)
{
    uint32_t file;
    c->arena = tn_arena_new();
    tn_builder *builder = tn_builder_new();
    tn_status status = c->arena && builder ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_sources_add(&c->sources, path, text, size, &file, error);
    if (status == TN_OK && !tn_is_utf8(text, size)) {
        tn_report(&c->diagnostics, E_INVALID_UTF8, (tn_span){file, 0, 0}, "the file is not UTF-8 text");
        status = TN_INVALID;
    } else if (status == TN_OK) {
        status = build(c, file, builder, error);
    }
    tn_builder_free(builder);
    return status;
}

tn_status tn_bnf_compile_text(const char *path, const char *text, size_t size, const tn_compile_options *options,
                              tn_compilation *compilation)
{
    tn_error error = {0};
    *compilation = (tn_compilation){0};
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    tn_status status = compile(path, text, size, compilation, &error);
    if (status != TN_OK && compilation->diagnostics.error_count == 0)
        tn_report_error(&compilation->diagnostics, &error, path, NULL, 0);
    bool refused = options->warnings_are_errors && compilation->diagnostics.warning_count;
    return status == TN_OK && refused ? TN_INVALID : status;
}
