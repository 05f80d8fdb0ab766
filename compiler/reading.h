/* Reading a text of any notation for its tokens: what formatting and editors need. */
#ifndef TARTAN_COMPILER_COMMON_READING_H
#define TARTAN_COMPILER_COMMON_READING_H

#include "compiler/common/diagnostic.h"
#include "compiler/common/token.h"
#include "compiler/notation.h"

typedef struct tn_reading {
    uint32_t file;
    tn_tokens tokens;
    void *tree; /* .plan: tn_ast_file, .hemls: tn_hemls_file, .bnf: tn_bnf_reader; .study: tn_study_file, or NULL where
                   it has an evolution block */
} tn_reading;

/* Reads source `file`, which is UTF-8 text, into the arena; what is wrong is in the diagnostics. False where out of
 * memory. */
bool tn_read(tn_arena *arena, tn_diagnostics *diagnostics, tn_notation notation, uint32_t file, tn_reading *reading);

#endif
