/* Laying out .plan files. Clauses without a name are called by the line they stand on (`drop ... by require@12`), and
 * formatting moves lines. */
#ifndef TARTAN_COMPILER_PLAN_FORMAT_CLAUSES_H
#define TARTAN_COMPILER_PLAN_FORMAT_CLAUSES_H

#include "compiler/common/layout.h"
#include "compiler/plan/syntax/ast.h"

/* Lays out a .plan file. */
void tn_format_plan(tn_format *format);

/* After the file was laid out: gives the tokens that name clauses of this file's libraries by their lines the names
 * that these have now, in `tokens`, from which the file can be laid out again. True where one changed. */
bool tn_format_clause_names(tn_arena *arena, const tn_source *source, const tn_ast_file *tree, const tn_format *format,
                            tn_format_token *tokens);

/* The text with the newer words for those that are called otherwise now, zero-ended, and in *said which these are;
 * NULL: it has none of them. Out of memory is the arena's to remember. */
const char *tn_format_newer_words(tn_arena *arena, const tn_source *source, const tn_tokens *tokens, const char **said);

#endif
