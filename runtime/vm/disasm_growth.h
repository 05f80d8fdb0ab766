/* The growth sections of a listing. */
#ifndef TARTAN_VM_DISASM_GROWTH_H
#define TARTAN_VM_DISASM_GROWTH_H

#include <stdio.h>

#include "runtime/vm/module.h"

/* The rewrite system: labels, seed, each rule with its successors as the constant templates that they are, and the
 * study. */
void tn_disassemble_growth(const tn_module *module, FILE *out);

#endif
