/* Compiles a .bnf text, already among the sources, into a module under construction: one GRAMMAR record, its NONTERMINAL and
 * PRODUCTION records, and their code. What is wrong is in the diagnostics; nothing is added to the builder where there is an
 * error. */
#ifndef TARTAN_COMPILER_BNF_H
#define TARTAN_COMPILER_BNF_H

#include "compiler/arena.h"
#include "compiler/compile.h"
#include "runtime/vm/builder.h"

/* TN_OK, TN_INVALID where there are errors, TN_MEMORY. */
tn_status tn_bnf_compile(tn_sources *sources, uint32_t file, tn_diagnostics *diagnostics, tn_arena *arena, tn_builder *builder,
                         tn_error *error);

/* A whole compilation of a .bnf text, as tn_compile_text does it for files of that extension. */
tn_status tn_bnf_compile_text(const char *path, const char *text, size_t size, const tn_compile_options *options,
                              tn_compilation *compilation);

#endif
