/* The growth sections of a listing. */
#ifndef TARTAN_GROWTH_LIST_H
#define TARTAN_GROWTH_LIST_H

#include <stdio.h>

#include "runtime/module/module.h"

/* The rewrite system: labels, seed, each rule with its successors as the constant templates that they are, and the
 * study. */
void tn_disassemble_growth(const tn_module *module, FILE *out);

#endif
