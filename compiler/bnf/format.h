/* What formatting .bnf files needs besides laying them out. */
#ifndef TARTAN_COMPILER_BNF_FORMAT_H
#define TARTAN_COMPILER_BNF_FORMAT_H

#include "compiler/bnf/ast.h"
#include "compiler/common/format_tokens.h"

/* Lays out a .bnf file. */
void tn_format_bnf(tn_format *format);

/* Leaves out the white space around alternatives of the dialect ge; in genr8 there are no such texts. */
void tn_format_bnf_trim(const tn_source *source, tn_tokens *tokens);

/* A directive with one blank between its words. */
tn_format_spell tn_format_bnf_directive;

/* Do the two mean the same? Makes the terminals of both, so that they are of no use afterwards. False also where out of
 * memory, which the arena remembers. */
bool tn_format_bnf_same(tn_bnf_reader *one, tn_bnf_reader *other);

#endif
