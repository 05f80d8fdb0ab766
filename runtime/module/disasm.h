/* Lists a module in text: tables, then each function's code beside the source lines it comes from. */
#ifndef TARTAN_MODULE_DISASM_H
#define TARTAN_MODULE_DISASM_H

#include <stdio.h>

#include "runtime/module/module.h"

/* Writes the listing to `out`; false where writing failed or memory ran out. Texts from the module are shortened and
 * cleaned of what would upset a terminal. */
bool tn_module_disassemble(const tn_module *module, FILE *out);

/* The same, but only a rule (an index of the RULE records) and the functions that it needs. */
bool tn_module_disassemble_rule(const tn_module *module, uint32_t rule, FILE *out);

#endif
