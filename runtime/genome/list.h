/* Lists the settings of an evolution as a study writes them. A part of disassembling. */
#ifndef TARTAN_GENOME_LIST_H
#define TARTAN_GENOME_LIST_H

#include <stdio.h>

#include "runtime/module/module.h"

void tn_disassemble_settings(const tn_module *module, FILE *out);

#endif
