/* The texts that a module was made of, and what made it, as records of the module. */
#include "compiler/common/emit_sources.h"

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
