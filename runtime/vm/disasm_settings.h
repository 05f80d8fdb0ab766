/* Lists the settings of an evolution as a study writes them. A part of disassembling. */
#ifndef TARTAN_VM_DISASM_SETTINGS_H
#define TARTAN_VM_DISASM_SETTINGS_H

#include <stdio.h>

#include "runtime/vm/module.h"

void tn_disassemble_settings(const tn_module *module, FILE *out);

#endif
