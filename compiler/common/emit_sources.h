/* The texts that a module was made of, and what made it, as records of the module. */
#ifndef TARTAN_COMPILER_COMMON_EMIT_SOURCES_H
#define TARTAN_COMPILER_COMMON_EMIT_SOURCES_H

#include "compiler/common/import.h"
#include "runtime/module/builder.h"

/* Adds a SOURCE record for every source, under the path that importing recorded for it, and the PRODUCER record. */
void tn_emit_sources(tn_builder *builder, const tn_imports *imports, const tn_sources *sources);

#endif
