/* The texts that a module was made of, and what made it, as records of the module. */
#ifndef TARTAN_COMPILER_COMMON_EMIT_SOURCES_H
#define TARTAN_COMPILER_COMMON_EMIT_SOURCES_H

#include "compiler/common/import.h"
#include "runtime/module/builder.h"

/* A builder with the compilation's sources, for a front end to add the rest; NULL where out of memory. */
tn_builder *tn_compilation_begin(const tn_compilation *compilation, const tn_imports *imports, tn_error *error);

/* Makes it the compilation's module where the rest was added well (status), and frees it. Returns what became of it. */
tn_status tn_compilation_finish(tn_compilation *compilation, tn_builder *builder, tn_status status, tn_error *error);

/* Adds a SOURCE record for every source, under the path that importing recorded for it, and the PRODUCER record. */
void tn_emit_sources(tn_builder *builder, const tn_imports *imports, const tn_sources *sources);

/* A path that a file names starts at that file's folder. The module holds it from the folder of the whole, file `root`,
 * on, so that both can be moved together; a file that is used lies below that folder's name or is told from the root.
 * In the arena, which remembers where memory ran out. */
const char *tn_emit_path(tn_arena *arena, const tn_sources *sources, uint32_t file, const char *path, uint32_t root);

#endif
