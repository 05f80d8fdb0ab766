/* Lists a module in text: tables, then each function's code beside the source lines it comes from. runtime/load.h does
 * it with all engines. */
#ifndef TARTAN_MODULE_DISASM_H
#define TARTAN_MODULE_DISASM_H

#include <stdio.h>

#include "runtime/module/engine.h"

/* Writes the listing to `out`; false where writing failed or memory ran out. */
bool tn_module_list(const tn_module *module, const tn_engines *engines, FILE *out);

/* The same, but only a record and the functions that it needs. */
bool tn_module_list_record(const tn_module *module, const tn_engines *engines, tn_section section, uint32_t index,
                           FILE *out);

#endif
