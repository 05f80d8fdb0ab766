/* The texts that a module was made of, and what made it, as records of the module. */
#include "compiler/common/emit_sources.h"

#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

void tn_emit_sources(tn_builder *builder, const tn_imports *imports, const tn_sources *sources)
{
    uint64_t hash = 0;
    for (size_t i = 0; i < sources->count; i++) {
        const tn_source *source = &sources->files[i];
        const char *path = source->path;
        for (size_t u = 0; u < imports->count; u++)
            if (imports->units[u]->file == i)
                path = imports->units[u]->recorded;
        tn_builder_add_SOURCE(builder, &(tn_source_record){tn_builder_string(builder, path),
                                                           tn_builder_string_n(builder, source->text, source->size)});
        hash = XXH3_64bits_withSeed(source->text, source->size, hash);
    }
    tn_builder_add_PRODUCER(builder,
                            &(tn_producer_record){tn_builder_string(builder, "tartan " TARTAN_VERSION), (int64_t)hash});
}

static size_t folder_size(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

const char *tn_emit_path(tn_arena *arena, const tn_sources *sources, uint32_t file, const char *path, uint32_t root)
{
    const char *user = sources->files[file].path, *whole = sources->files[root].path;
    size_t below = folder_size(whole), folder = path[0] == '/' ? 0 : folder_size(user);
    size_t name = strlen(path), skip = below <= folder && memcmp(user, whole, below) == 0 ? below : 0;
    char *resolved = tn_arena_alloc(arena, folder - skip + name + 1);
    if (!resolved)
        return path;
    memcpy(resolved, user + skip, folder - skip);
    memcpy(resolved + folder - skip, path, name + 1);
    return resolved;
}

tn_builder *tn_compilation_begin(const tn_compilation *compilation, const tn_imports *imports, tn_error *error)
{
    tn_builder *builder = tn_builder_new();
    if (builder)
        tn_emit_sources(builder, imports, &compilation->sources);
    else
        tn_fail_memory(error);
    return builder;
}

tn_status tn_compilation_finish(tn_compilation *compilation, tn_builder *builder, tn_status status, tn_error *error)
{
    if (status == TN_OK)
        status = tn_builder_finish(builder, &compilation->module, &compilation->module_size, error);
    tn_builder_free(builder);
    return status;
}
