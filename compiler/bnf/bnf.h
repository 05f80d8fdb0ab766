/* Compiles a .bnf text, already among the sources, into a module under construction: one GRAMMAR record, its
 * NONTERMINAL and PRODUCTION records, and their code. What is wrong is in the diagnostics; nothing is added to the
 * builder where there is an error. */
#ifndef TARTAN_COMPILER_BNF_BNF_H
#define TARTAN_COMPILER_BNF_BNF_H

#include "compiler/common/arena.h"
#include "compiler/common/compilation.h"
#include "runtime/module/builder.h"

/* data: the numbers of a data set that GE_RANGE can name, as far as the file does not say them (TN_BNF_DATA of ast.h;
 * 0: not known), or NULL. TN_OK, TN_INVALID where there are errors, TN_MEMORY. */
tn_status tn_bnf_compile(tn_sources *sources, uint32_t file, const uint32_t *data, tn_diagnostics *diagnostics,
                         tn_arena *arena, tn_builder *builder, tn_error *error);

/* Does the grammar's text ask for numbers of a data set? */
bool tn_bnf_asks_data(const char *text, size_t size);

#endif
