/* What each engine does, run on a module from anywhere within small limits: the functions of the column `fuzz` of
 * runtime/engines.def. A run that breaks a promise of its engine aborts. */
#ifndef TARTAN_TESTS_FUZZ_ENGINES_H
#define TARTAN_TESTS_FUZZ_ENGINES_H

#include "runtime/module/module.h"

#define ENGINE(NAME, FUZZ) void FUZZ(const tn_module *module);
#include "runtime/engines.def"

/* Lists the module and runs every engine on it. */
void fuzz_engines(const tn_module *module);

#endif
