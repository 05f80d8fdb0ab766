/* Laying out .pcfg files. */
#ifndef TARTAN_COMPILER_PCFG_FORMAT_H
#define TARTAN_COMPILER_PCFG_FORMAT_H

#include "compiler/common/format_tokens.h"
#include "compiler/pcfg/ast.h"

/* A line a line, one blank between tokens. A probability that a blank behind it makes void gets the [0] that the
 * program reads there: without the blank it would count. */
void tn_format_pcfg(tn_format *format);

/* Do the two have the same rules in the same order, with the same probabilities? */
bool tn_format_pcfg_same(const tn_pcfg_reader *one, const tn_pcfg_reader *other);

#endif
