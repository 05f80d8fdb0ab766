/* Compiles a .bnf text, already among the sources, into a module under construction: one GRAMMAR record, its
 * NONTERMINAL and PRODUCTION records, and their code. What is wrong is in the diagnostics; nothing is added to the
 * builder where there is an error. */
#ifndef TARTAN_COMPILER_BNF_BNF_H
#define TARTAN_COMPILER_BNF_BNF_H

#include "compiler/bnf/ast.h"
#include "compiler/common/arena.h"
#include "compiler/common/compilation.h"
#include "runtime/module/builder.h"

/* What a study says about the grammar that it names. */
typedef struct tn_bnf_study {
    uint32_t data[TN_BNF_DATA]; /* numbers of a data set that GE_RANGE can name, where the file does not say them; 0:
                                   not known */
    bool says_mapping, position_independent; /* in place of what the file says */
    tn_span mapping_span;
} tn_bnf_study;

/* study: or NULL. TN_OK, TN_INVALID if there are errors, TN_MEMORY. */
tn_status tn_bnf_compile(tn_sources *sources, uint32_t file, const tn_bnf_study *study, tn_diagnostics *diagnostics,
                         tn_arena *arena, tn_builder *builder, tn_error *error);

/* Does the grammar's text ask for numbers of a data set? */
bool tn_bnf_asks_data(const char *text, size_t size);

#endif
