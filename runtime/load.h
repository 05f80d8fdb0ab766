/* Loading and listing modules with all engines of this program (engines.def). */
#ifndef TARTAN_RUNTIME_LOAD_H
#define TARTAN_RUNTIME_LOAD_H

#include <stdio.h>

#include "runtime/module/module.h"

struct tn_engines;

/* All engines, in the order of engines.def. */
const struct tn_engines *tn_engines_all(void);

/* Loads and verifies a module. `limits` may be NULL (defaults). On success the caller owns *module. */
tn_status tn_module_load(const void *bytes, size_t size, const tn_module_limits *limits, tn_module **module,
                         tn_error *error);

/* Writes a listing to `out`; false if writing failed or memory ran out. Texts from the module are shortened and
 * cleaned of what would upset a terminal. */
bool tn_module_disassemble(const tn_module *module, FILE *out);

/* The same, but only a rule (an index of the RULE records) and the functions that it needs. */
bool tn_module_disassemble_rule(const tn_module *module, uint32_t rule, FILE *out);

#endif
