/* Reads what a terminal of a connection grammar says: 'Move(0,3,0)'. */
#ifndef TARTAN_COMPILER_PCFG_TERMINAL_H
#define TARTAN_COMPILER_PCFG_TERMINAL_H

#include "compiler/pcfg/ast.h"

/* Sets the item's step, or reports what is wrong and marks it as unknown. Warns about what is probably wrong. */
void tn_pcfg_read_terminal(tn_arena *arena, tn_diagnostics *diagnostics, tn_pcfg_item *item);

#endif
